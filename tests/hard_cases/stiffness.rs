//! Young's modulus from 1e5 to 2.1e11 Pa, diameters from 1 to 50 mm, 2 to 200 elements. The cases: `crates/lariat-bench/src/stability/cases/stiffness.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: the pendulum, conservation of energy.
#[test]
fn cables_of_any_stiffness_swing() {
    check(Family::Stiffness);
}
