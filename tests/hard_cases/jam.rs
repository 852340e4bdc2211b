//! Wedged bodies, 5 kN, sudden release. The cases: `crates/lariat-bench/src/stability/cases/jam.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: statics; the energy stored in the rope.
#[test]
fn wedged_bodies_hold_and_fly() {
    check(Family::Jam);
}
