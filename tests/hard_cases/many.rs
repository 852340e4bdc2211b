//! Many cables, many bodies, nets, loops. The cases: `crates/lariat-bench/src/stability/cases/many.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: statics, conservation of momentum.
#[test]
fn many_cables_and_bodies_hold() {
    check(Family::Many);
}
