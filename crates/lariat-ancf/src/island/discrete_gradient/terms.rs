//! The list of what acts in a step of an island.

use super::IslandStep;
use super::angular::Momentum;
use super::bodies::Bodies;
use super::cables::Cables;
use super::contacts::Contacts;
use super::pins::Pins;
use super::reels::Reels;
use super::torsion::Torsion;
use crate::term::StepTerm;

/// All terms, in the order in which they begin a step and are balanced; they are accepted in
/// reverse. A [term](crate::term) that is not in the list does not exist.
pub(super) type Terms = (Momentum, (Cables, (Torsion, (Bodies, (Reels, (Pins, Contacts))))));

/// Returns the names of all terms, in their order: `cables`, `bodies` and so on. A test that must
/// hold for each asks for them here.
pub fn terms() -> Vec<&'static str> {
    let mut names = Vec::new();
    <Terms as StepTerm<IslandStep<'_, '_>>>::name(&mut names);
    names
}
