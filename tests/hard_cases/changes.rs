//! What users do to a running world. The cases: `crates/lariat-bench/src/stability/cases/changes.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: the contract; conservation of energy after it.
#[test]
fn whatever_a_user_does_the_cable_goes_on() {
    check(Family::Changes);
}
