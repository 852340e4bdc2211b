//! The cases, a file per family.

mod changes;
mod collapse;
mod compression;
mod jam;
mod long;
mod many;
mod mass_ratio;
mod mechanisms;
mod prelude;
pub mod random;
mod reels;
mod scale;
mod snatch;
mod stiffness;
mod whip;
mod zero_bending;

use super::world::case::Case;
use crate::stability::family::Family;

/// Returns the cases of a family.
pub fn of(family: Family) -> Vec<Case> {
    match family {
        Family::MassRatio => mass_ratio::cases(),
        Family::Stiffness => stiffness::cases(),
        Family::Snatch => snatch::cases(),
        Family::Whip => whip::cases(),
        Family::Compression => compression::cases(),
        Family::Collapse => collapse::cases(),
        Family::ZeroBending => zero_bending::cases(),
        Family::Jam => jam::cases(),
        Family::Changes => changes::cases(),
        Family::Long => long::cases(),
        Family::Scale => scale::cases(),
        Family::Many => many::cases(),
        Family::Mechanisms => mechanisms::cases(),
        Family::Reels => reels::cases(),
        Family::Random => random::cases(),
    }
}
