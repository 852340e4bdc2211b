//! Why a cable cannot have both features of a pair: a reason of physics for each, in one sentence.

use super::feature::{Feature, Pair};

/// Returns the reason for which a pair is none; `None` for a pair that must run.
pub fn reason(pair: Pair) -> Option<&'static str> {
    let both = |among: &[Feature]| pair.both().iter().all(|feature| among.contains(feature));
    match pair {
        _ if both(&[Feature::HookeLaw, Feature::RopeLaw, Feature::CurveLaw]) => Some("a cable has one axial law"),
        _ if both(&[Feature::Drag, Feature::Current]) => Some("a fluid rests or flows"),
        _ if both(&[Feature::Game, Feature::Engineering]) => Some("a cable has one integrator"),
        _ => None,
    }
}
