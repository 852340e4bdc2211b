//! Whips and spins. The cases: `crates/lariat-bench/src/stability/cases/whip.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: conservation of energy and angular momentum, rigid rotation.
#[test]
fn whips_crack_and_spins_hold() {
    check(Family::Whip);
}
