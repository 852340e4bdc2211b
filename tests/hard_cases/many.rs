//! Many cables, many bodies, nets, loops. The cases: `crates/lariat-lab/src/stability/cases/many.rs`.

use super::suite::check;
use lariat_lab::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: statics, conservation of momentum.
#[test]
fn many_cables_and_bodies_hold() {
    check(Family::Many);
}
