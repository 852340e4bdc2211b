//! Joints, motors, limits, CCD, locked axes, kinematic bodies. The cases: `crates/lariat-bench/src/stability/cases/mechanisms.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: statics, the contracts of Rapier's joints.
#[test]
fn mechanisms_carry_their_ropes() {
    check(Family::Mechanisms);
}
