//! No bending, no tension, no gravity; then all at once. The cases: `crates/lariat-bench/src/stability/cases/limp.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: no force, no motion; the snatch of a spring.
#[test]
fn limp_and_slack_ropes_stay_and_catch() {
    check(Family::Limp);
}
