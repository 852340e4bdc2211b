//! Why a cable cannot have both features of a pair: a reason of physics for each, in one sentence.

use super::feature::{Feature, Pair};

/// Returns the reason for which a pair is none; `None` for a pair that must run.
pub fn reason(pair: Pair) -> Option<&'static str> {
    let both = |among: &[Feature]| pair.both().iter().all(|feature| among.contains(feature));
    let winds = |feature: &Feature| feature.is_reel() || matches!(feature, Feature::Sheave | Feature::HeavySheave);
    match pair {
        _ if both(&[Feature::HookeLaw, Feature::RopeLaw, Feature::CurveLaw]) => Some("a cable has one axial law"),
        _ if both(&[Feature::Drag, Feature::Current, Feature::Water, Feature::AddedMass, Feature::Wave]) => {
            Some("a cable is in one fluid")
        }
        _ if both(&[Feature::Game, Feature::Engineering, Feature::Adaptive]) => Some("a cable has one integrator"),
        _ if pair.has(Feature::ErrorTarget)
            && both(&[Feature::ErrorTarget, Feature::Game, Feature::Engineering, Feature::Adaptive]) =>
        {
            Some("a run to a given error chooses the one integrator that a cable has")
        }
        _ if both(&[Feature::Sheave, Feature::HeavySheave]) => Some("a wheel has one friction and one inertia"),
        _ if both(&[Feature::Torsion, Feature::Stranded]) => Some("a cable has one law of torsion"),
        _ if pair.has(Feature::Stranded)
            && both(&[Feature::Stranded, Feature::HookeLaw, Feature::RopeLaw, Feature::CurveLaw]) =>
        {
            Some("a cable has one axial law, and that of a stranded rope has its twist in it")
        }
        _ if pair.has(Feature::Stranded) && pair.both().iter().any(winds) => Some(
            "a stranded rope is wound up with the twist of its load and gives it back, and stock has no memory of twist",
        ),
        _ if pair.has(Feature::FreeSpool) && pair.has(Feature::Statics) => {
            Some("a free spool turns under any pull, so nothing rests")
        }
        // it has added mass
        _ if pair.has(Feature::Buoyancy) && pair.both().iter().any(winds) => {
            Some("added mass acts along a cable as across it, and what comes out along itself moves no fluid")
        }
        _ => None,
    }
}
