//! The cases, one file per family.

mod changes;
mod collapse;
mod compression;
mod jam;
mod limp;
mod long;
mod many;
mod mass_ratio;
mod mechanisms;
mod random;
mod scale;
mod snatch;
mod stiffness;
mod whip;

pub use random::scene as random_scene;

use super::stage::Case;
use super::{engine, stage};
use crate::stability::Family;

/// Gravity in m/s^2.
const G: f64 = 9.81;

/// The cases of a family.
pub fn of(family: Family) -> Vec<Case> {
    match family {
        Family::MassRatio => mass_ratio::cases(),
        Family::Stiffness => stiffness::cases(),
        Family::Snatch => snatch::cases(),
        Family::Whip => whip::cases(),
        Family::Compression => compression::cases(),
        Family::Collapse => collapse::cases(),
        Family::Limp => limp::cases(),
        Family::Jam => jam::cases(),
        Family::Changes => changes::cases(),
        Family::Long => long::cases(),
        Family::Scale => scale::cases(),
        Family::Many => many::cases(),
        Family::Mechanisms => mechanisms::cases(),
        Family::Random => random::cases(),
    }
}

/// Stretch f of a cable whose tension follows Green's law, `N = EA (f^2 - 1)/2 f`, at a tension N/EA.
fn green_stretch(share: f64) -> f64 {
    let mut f = 1.0 + share;
    for _ in 0..50 {
        f -= (0.5 * (f * f - 1.0) * f - share) / (1.5 * f * f - 0.5);
    }
    f
}
