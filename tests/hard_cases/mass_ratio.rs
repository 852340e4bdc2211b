//! Loads from a hundredth to a hundred thousand times the mass of their cable, hanging and swinging. The cases: `crates/lariat-bench/src/stability/cases/mass_ratio.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: statics, Green's law, conservation of energy.
#[test]
fn loads_of_any_mass_hang_and_swing() {
    check(Family::MassRatio);
}
