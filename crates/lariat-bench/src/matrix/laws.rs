//! The laws that every pair must keep, and their bounds.
//!
//! # Equation
//!
//! ```text
//! made   E - W <= E0 + share S        E energy of all, W work from outside less losses, S largest kinetic and strain energy
//! kept   |P - P0|, |L - L0|           of systems that nothing from outside acts on
//! saved  bits after a state was saved and read back = bits of the run that was left alone
//! finer  |x - x'| <= share D          x' at an eighth of the host step, D how far anything moved
//! beside |x - x'|                     x' each feature alone, x both in one world, far apart
//! ```
//!
//! # Validity
//!
//! W has what cables and what touches them lose by the energy law, but not what Rapier's contacts and
//! joints take, so the law says what is made. Contact between what moves is no work from outside. Host
//! steps decide when a cable breaks: the finer run breaks up to one host step before. Where it has
//! other parts, centres of mass are compared.

use super::draft::Draft;
use super::feature::{Feature, Pair};
use super::limits;
use super::scene::{Fault, Scene};
use crate::stability::outcome::Check;
use lariat_ancf::Vector3;

/// Host step in s.
pub const STEP: f64 = 1.0 / 60.0;
/// Simulated time in s.
pub const DURATION: f64 = 0.5;
/// The quantity of the law of finer runs.
pub(super) const FINER_RUN: &str = "difference from a finer run";
/// How many warnings tell that the steps are too long for the motion.
pub(super) const STEPS_TOLD: &str = "warnings of the steps";
/// How many times shorter the host step of the finer run is.
pub(super) const FINER: f64 = 8.0;
/// Distance in m of two scenes that do not act on each other.
const APART: f64 = 12.0;

/// Largest energy made, as a share of the largest kinetic and strain energy: that of the hard
/// cases.
const MADE: f64 = 0.01;
/// Largest change of momentum, as a share: bodies have single precision.
const MOMENTUM: f64 = 1e-4;
/// Largest difference from the finer run, as a share of how far anything moved.
pub(super) const FINE: f64 = 0.05;
/// Least motion in m that differences are compared with: 5 % of it are the 8.8e-3 m by which
/// fidelity `game` is documented to miss a payload that swings.
const LEAST_MOTION: f64 = 0.176;
/// Largest difference in m between features beside each other and each alone: single precision,
/// whose solver takes bodies in another order.
const BESIDE: f64 = 1e-6;
/// Largest motion in m of a scene that starts in equilibrium: positions of bodies are single
/// precision.
const REST: f64 = 1e-5;

/// What a run of a pair does.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plan {
    /// Start in equilibrium.
    pub statics: bool,
}

/// How far a scene came: it was refused before it moved, or failed later.
#[derive(Debug)]
pub enum Ended {
    /// It was not built, or refused its first step.
    Refused(String),
    /// It failed at a time in s.
    Failed(f64, String),
}

/// Returns a scene of some features, before its first step.
///
/// # Errors
/// [`Ended::Refused`].
pub fn built(draft: &Draft, plan: Plan, dt: f64) -> Result<Scene, Ended> {
    let refused = |fault: Fault| Ended::Refused(fault.to_string());
    let mut scene = Scene::new(dt, draft.floats);
    scene.add(draft).map_err(refused)?;
    if plan.statics {
        scene.set.equilibrium(&mut scene.physics).map_err(|error| refused(error.into()))?;
    }
    Ok(scene)
}

/// Runs a scene to its end.
///
/// # Errors
/// [`Ended`].
pub fn finish(scene: &mut Scene) -> Result<(), Ended> {
    finish_and_read(scene, |_| Ok(()))
}

/// Runs a scene to its end, and reads it after each host step.
fn finish_and_read(scene: &mut Scene, mut read: impl FnMut(&Scene) -> Result<(), Fault>) -> Result<(), Ended> {
    while scene.is_before(DURATION) {
        let time = scene.time;
        let failed = |fault: Fault| Ended::Failed(time, fault.to_string());
        scene.step().map_err(|fault| if time == 0.0 { Ended::Refused(fault.to_string()) } else { failed(fault) })?;
        read(scene).map_err(failed)?;
    }
    Ok(())
}

/// Returns the larger of two numbers, NaN if one is.
fn larger(most: f64, x: f64) -> f64 {
    if x <= most { most } else { x }
}

/// Runs a pair by itself: energy, a saved state, a finer run.
///
/// # Errors
/// [`Ended::Refused`] for a pair that does not run; a failure in between is a check that fails.
pub fn together(features: &[Feature], plan: Plan) -> Result<Vec<Check>, Ended> {
    let draft = Draft::of(features, false);
    let mut scene = built(&draft, plan, STEP)?;
    let start = scene.positions();
    let first = scene.ledger().map_err(|fault| Ended::Failed(0.0, fault.to_string()))?;
    let (mut most, mut scale) = (0.0f64, first.scale.max(scene.least_energy()));
    let (mut half, mut middle) = (None, start.clone());
    finish_and_read(&mut scene, |scene| {
        let now = scene.ledger()?;
        scale = scale.max(now.scale);
        if let (Some(now), Some(first)) = (now.kept, first.kept) {
            most = larger(most, now - first);
        }
        if half.is_none() && scene.time > 0.5 * DURATION {
            half = Some(scene.time);
            middle = scene.positions();
        }
        Ok(())
    })?;
    let end = scene.positions();
    let mut checks = vec![
        Check::at_most("energy made", most / scale, MADE, "energy less the work from outside never grows"),
        Check::at_most("warnings of energy made", scene.made.len() as f64, 0.0, "the run's own account"),
    ];
    checks.push(saved(&draft, plan, half.unwrap_or(DURATION), &scene)?);
    if plan.statics && features.iter().all(|feature| feature.rests()) {
        checks.push(Check::at_most("motion at rest, m", apart(&start, &end), REST, "an equilibrium"));
    }
    let mut finer = built(&draft, plan, STEP / FINER)?;
    let moved = apart(&start, &middle).max(apart(&start, &end)).max(LEAST_MOTION);
    finish(&mut finer).map_err(|ended| match ended {
        Ended::Refused(text) => Ended::Failed(0.0, format!("in the finer run: {text}")),
        Ended::Failed(time, text) => Ended::Failed(time, format!("in the finer run: {text}")),
    })?;
    let fine = finer.positions();
    // a rope that shatters has other parts in each run, and one centre of mass
    let same = end.len() == fine.len();
    let difference = if same { apart(&end, &fine) } else { (scene.centre() - finer.centre()).norm() } / moved;
    let finer = Check::at_most(FINER_RUN, difference, FINE, "the same scene at dt/8");
    if same && !finer.holds() {
        checks.push(Check::at_most(STEPS_TOLD, scene.told_of_steps() as f64, f64::INFINITY, "told, not judged"));
        checks.extend(limits::measure(&draft, plan, &fine, moved)?);
    }
    checks.push(finer);
    Ok(checks)
}

/// Compares a run whose state is saved and read back at a time with the one that was left alone.
fn saved(draft: &Draft, plan: Plan, half: f64, alone: &Scene) -> Result<Check, Ended> {
    let source = "a state that was saved and read back";
    let mut scene = built(draft, plan, STEP)?;
    let failed = |time: f64| move |fault: Fault| Ended::Failed(time, format!("with a saved state: {fault}"));
    scene.run_to(half).map_err(failed(half))?;
    scene.save_and_restore().map_err(failed(half))?;
    finish(&mut scene)?;
    let (one, two) = (scene.bits(), alone.bits());
    let differ = one.iter().zip(&two).filter(|(a, b)| a != b).count() + one.len().abs_diff(two.len());
    Ok(Check::at_most("numbers that differ after a snapshot", differ as f64, 0.0, source))
}

/// Returns the largest distance between points, infinite if there are others.
pub fn apart(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, larger)
}

/// Runs a system that nothing from outside acts on: momentum.
///
/// # Errors
/// [`Ended`].
pub fn floating(features: &[Feature]) -> Result<Vec<Check>, Ended> {
    let draft = Draft::of(features, true);
    let mut scene = built(&draft, Plan::default(), STEP)?;
    let before = scene.momentum().map_err(|fault| Ended::Failed(0.0, fault.to_string()))?;
    let (mut most, mut scale) = ([0.0f64; 2], before.map(|p| p.norm()));
    finish_and_read(&mut scene, |scene| {
        let now = scene.momentum()?;
        for k in 0..2 {
            most[k] = larger(most[k], (now[k] - before[k]).norm());
            scale[k] = scale[k].max(now[k].norm());
        }
        Ok(())
    })?;
    let source = "nothing acts from outside";
    Ok(vec![
        Check::at_most("change of momentum", most[0] / scale[0].max(1e-2), MOMENTUM, source),
        Check::at_most("change of angular momentum", most[1] / scale[1].max(1e-2), MOMENTUM, source),
    ])
}

/// Runs both features of a pair in one world, far apart, and each alone.
///
/// # Errors
/// [`Ended`].
pub fn beside(pair: Pair) -> Result<Check, Ended> {
    let drafts = [(pair.0, 0.0), (pair.1, APART)].map(|(feature, z)| {
        let mut draft = Draft::of(&[feature], false);
        draft.origin.z = z;
        draft
    });
    let run = |drafts: &[Draft]| -> Result<Scene, Ended> {
        let mut scene = Scene::new(STEP, false);
        // all cables of a world share one number of Rapier steps
        scene.set.settings.rapier_steps = 4;
        scene.set.settings.max_rapier_steps = 4;
        for draft in drafts {
            scene.add(draft).map_err(|fault| Ended::Refused(fault.to_string()))?;
        }
        finish(&mut scene)?;
        Ok(scene)
    };
    let both = run(&drafts)?;
    let mut alone = Vec::new();
    for draft in drafts {
        alone.extend(run(&[draft])?.positions());
    }
    // cables first and bodies then, in one world; compared without their order
    let distance =
        |a: &Vector3<f64>, all: &[Vector3<f64>]| all.iter().map(|b| (a - b).norm()).fold(f64::INFINITY, f64::min);
    let together = both.positions();
    let count = together.len() == alone.len();
    let most = together.iter().map(|a| distance(a, &alone)).fold(0.0, larger);
    let value = if count { most } else { f64::INFINITY };
    Ok(Check::at_most("difference from each alone, m", value, BESIDE, "what is far apart does not interact"))
}
