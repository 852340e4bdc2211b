//! Runs of a scene to a given error.

use super::fine::Meshes;
use super::output::Output;
use super::{Done, Open, Options, Recorded, simulate};
use crate::error::Error;
use crate::scene::body::{BodyKind, BodyScene};
use crate::scene::elements::Fine;
use crate::scene::load::BodyLoadScene;
use crate::scene::{Engine, Purpose, Scene};
use crate::warning::Warning;
use lariat_ancf::study::{Claim, FailedRun, Outcome, Proof, Quantity, Record, Resolution, Study, StudyError, Target};
use lariat_ancf::{Fidelity, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Elements that a cable gets at most, unless the scene has a quarter as many itself.
const LIMIT: usize = 160;
/// Least error over the length of the longest cable: beyond, statics and steps are rounding errors.
const LEAST: f64 = 1e-8;
/// Least error with Rapier's bodies, over their distance from the origin, which is counted as at least 1 m: 84 units in the last place of
/// single precision.
const LEAST_SINGLE: f64 = 1e-5;

/// Least error of what cables carry, as a share: that to which statics and steps are solved; and with Rapier's bodies.
const LEAST_SHARE: f64 = 1e-6;
const LEAST_SHARE_SINGLE: f64 = 1e-4;

/// What `summary.json` says about the error that was asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ErrorClaim {
    /// What is claimed.
    #[serde(flatten)]
    pub claim: Claim,
    /// Why the run failed that ended the study, if one did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed_because: Option<String>,
    /// Number of elements of each cable.
    pub elements_of: BTreeMap<String, usize>,
    /// What the claim does not cover.
    pub not_covered: Vec<String>,
}

impl ErrorClaim {
    fn of(scene: &Scene, claim: Claim, purpose: Purpose, jumps: bool, failures: &[(FailedAt, String)]) -> Self {
        let mut not_covered = vec!["the model: theory of thin rods, rule, law and effects, measured data"];
        if scene.engine == Engine::Rapier {
            not_covered.push("single precision of bodies");
            if purpose != Purpose::Static {
                not_covered.push(match scene.is_coupled() {
                    // runs differ in the host step
                    true => "Rapier's model of contacts and joints",
                    false => "the host step of Rapier: its contacts, joints and free bodies",
                });
            }
        }
        let kinematic = scene.bodies.iter().any(|body| body.kind == BodyKind::Kinematic);
        if kinematic && purpose != Purpose::Static {
            not_covered.push("motion of kinematic bodies within a host step");
        }
        let varies = |load: &BodyLoadScene| load.load.ramp > 0.0 || !load.load.history.is_empty();
        if purpose != Purpose::Static && scene.body_loads.iter().any(varies) {
            not_covered.push("loads on bodies that change within a host step, which has their mean");
        }
        if jumps {
            not_covered.push("what buckles when velocities jump");
        }
        if purpose == Purpose::Static {
            not_covered.push("equilibria other than the one that all meshes found");
        }
        let mut elements_of = BTreeMap::new();
        for cable in &scene.cables {
            // all parts of one
            *elements_of.entry(cable.name.clone()).or_insert(0) += cable.elements;
        }
        let not_covered = not_covered.into_iter().map(String::from).collect();
        let failed = claim.failed.map(|run| (run.elements, run.tolerance_m, run.parts));
        let reason = failures.iter().rev().find(|(run, _)| Some(*run) == failed);
        let failed_because = reason.map(|(_, reason)| reason.clone());
        ErrorClaim { claim, failed_because, elements_of, not_covered }
    }

    fn warning(&self) -> Option<Warning> {
        let Claim { outcome, horizon_s, other_branch, elements, elements_needed, .. } = self.claim;
        let failed = self.claim.failed.map(|run| failure(&run, self.failed_because.as_deref()));
        if let Some(forces) = self.claim.forces.clone().filter(|_| outcome != Outcome::Proven) {
            let (asked, quantity) = (forces.asked, forces.quantity);
            let target = Target { quantity, error: asked, relative: forces.relative };
            let estimate = forces.mesh.map(|mesh| mesh + forces.time);
            let needed = elements_needed;
            return Some(Warning::ForcesNotProven {
                target,
                estimate,
                elements,
                elements_needed: needed,
                horizon_s,
                other_branch,
                failed,
            });
        }
        let asked_m = self.claim.asked_m?;
        let estimate_m = self.claim.mesh_m.zip(self.claim.time_m).map(|(mesh, time)| mesh + time);
        match outcome {
            Outcome::Proven => None,
            Outcome::NoConvergence => {
                let steps = self.claim.steps_apart;
                Some(Warning::NoConvergence { asked_m, estimate_m, elements, steps, horizon_s, other_branch, failed })
            }
            Outcome::ElementLimit => Some(Warning::ErrorNotReached {
                asked_m,
                estimate_m,
                elements,
                elements_needed,
                horizon_s,
                other_branch,
            }),
        }
    }
}

/// A run of a study that failed: elements of the largest cable, tolerance, and parts of a host step.
type FailedAt = (usize, Option<f64>, u32);

/// Says which run failed, and why.
fn failure(run: &FailedRun, reason: Option<&str>) -> String {
    let tolerance = run.tolerance_m.map_or(String::new(), |tolerance| format!(" and tolerance {tolerance:.1e} m"));
    let parts = if run.parts > 1 { format!(", host steps in {} parts", run.parts) } else { String::new() };
    let reason = reason.map_or(String::new(), |reason| format!(": {reason}"));
    format!("the run with elements = {}{tolerance}{parts} failed{reason}", run.elements)
}

/// Why a run of a study stopped: before it began, with samples on disk, or because the study was interrupted.
enum Stopped {
    Before(Error),
    During(Box<Done>),
    Interrupted,
}

/// Runs a scene until its error is proven, and writes the results of the last run.
pub(super) fn conduct(
    scene: &Scene,
    open: Open<'_>,
    purpose: Purpose,
    target: Target,
    options: &mut Options<'_>,
) -> Result<Recorded, Error> {
    check(scene, target)?;
    // what hinders files is told before the first run, and the folder is held from then on; the rows of runs are kept until
    // it is known which of them is the result
    let files = open(scene)?;
    let in_memory = |scene: &Scene| Ok(Output::in_memory(scene));
    let largest = scene.cables.iter().map(|cable| cable.elements).max().unwrap_or(1);
    let mut meshes: Option<Meshes> = None;
    let mut failures: Vec<(FailedAt, String)> = Vec::new();
    // a run that is interrupted does not fail, and none follows it
    let mut interrupted: Option<Box<Done>> = None;
    let each = |resolution: &Resolution, record: &mut Record| -> Result<(Scene, Done), Stopped> {
        if interrupted.is_some() {
            return Err(Stopped::Interrupted);
        }
        if let Some(pilot) = &mut options.pilot {
            pilot(resolution);
        }
        let own = scene;
        let mut scene = scene.clone();
        for cable in &mut scene.cables {
            cable.elements = resolution.elements_of(cable.elements, largest);
            // few elements cannot be graded as many can
            cable.fine = Fine::Nowhere;
            // a load inside an element is nearer to the nodes of one mesh than to those of the next, and distances say nothing
            cable.nodes_at_loads = true;
            // that of a fidelity goes with its integrator
            if cable.rule_by_fidelity {
                cable.rule = Fidelity::Engineering.rule();
            }
            if purpose != Purpose::Static {
                cable.integrator = resolution.integrator().into();
            }
        }
        if let Some(meshes) = &meshes {
            meshes.give(&mut scene, resolution);
        }
        divide(&mut scene, resolution.parts);
        let recorded = Some((&mut *record, resolution.parts));
        let mut note = |error: &Error| {
            failures.push(((resolution.elements, resolution.tolerance, resolution.parts), error.to_string()));
        };
        let simulated = simulate(&scene, &in_memory, purpose, options, recorded);
        let done = simulated.inspect_err(&mut note).map_err(Stopped::Before)?;
        if velocities_jump(&scene, &done) {
            record.velocities_jump();
        }
        if matches!(done.outcome, Err(Error::Interrupted { .. })) {
            interrupted = Some(Box::new(done));
            return Err(Stopped::Interrupted);
        }
        if let Err(error) = &done.outcome {
            note(error);
            return Err(Stopped::During(Box::new(done)));
        }
        if target.of_positions().is_none() && meshes.is_none() {
            meshes = Some(Meshes::chosen(own, record));
        }
        Ok((scene, done))
    };
    let study = match purpose {
        Purpose::Run | Purpose::Resume => Study::new(scene.duration, scene.dt, each),
        Purpose::Static => Study::of_equilibrium(each),
    };
    let limit = LIMIT.max(4 * largest);
    let outcome = study.error(target).limit(limit).coupled(scene.is_coupled()).run();
    if let Some(mut done) = interrupted {
        done.output = done.output.move_to(scene, files)?;
        return Ok(done.finish(None));
    }
    match outcome {
        Ok(Proof { world: (scene, mut done), claim }) => {
            let jumps = velocities_jump(&scene, &done);
            let claim = ErrorClaim::of(&scene, claim, purpose, jumps, &failures);
            done.output = done.output.move_to(&scene, files)?;
            done.world.warnings.extend(claim.warning());
            if let Some(warn) = &mut options.warn {
                done.world.told().iter().for_each(|line| warn(line));
            }
            Ok(done.finish(Some(claim)))
        }
        Err(StudyError::Run { source: Stopped::During(mut done), .. }) => {
            done.output = done.output.move_to(scene, files)?;
            Ok(done.finish(None))
        }
        Err(StudyError::Run { source: Stopped::Before(error), .. }) => Err(error),
        Err(other) => Err(Error::Study { error: target.to_string(), problem: described(&other) }),
    }
}

/// Divides host steps into equal parts; probes are sampled as before.
fn divide(scene: &mut Scene, parts: u32) {
    if parts > 1 {
        scene.probes.iter_mut().for_each(|probe| _ = probe.every.get_or_insert(scene.dt));
        scene.dt /= f64::from(parts);
    }
}

fn described(error: &StudyError<Stopped>) -> String {
    match error {
        StudyError::DifferentTimes { time, other } => format!("runs at {time} s and {other} s"),
        _ => "nothing to compare".to_string(),
    }
}

/// Returns whether a cable is set in motion in no time: at the start, or where the path of a body that holds it has a corner.
fn velocities_jump(scene: &Scene, done: &Done) -> bool {
    let corners = |body: &BodyScene| body.course.path.corners().any(|time| 0.0 < time && time < scene.duration);
    let bodies = scene.attachments.iter().filter_map(|attachment| attachment.body);
    done.world.velocities_jump || bodies.into_iter().any(|body| corners(&scene.bodies[body]))
}

/// Refuses an error that rounding does not allow to prove.
fn check(scene: &Scene, target: Target) -> Result<(), Error> {
    let error = target.error;
    let longest = scene.cables.iter().fold(0.0, |longest: f64, cable| longest.max(cable.length));
    let mut least = (LEAST * longest, "double precision");
    if scene.engine == Engine::Rapier {
        let path = |body: &BodyScene| {
            body.course.path.positions.iter().map(|(_, p)| *p).chain([body.course.position]).collect::<Vec<_>>()
        };
        let bodies = scene.bodies.iter().flat_map(path);
        let cables = scene.cables.iter().flat_map(|cable| cable.points.iter().copied());
        let far = bodies.chain(cables).fold(1.0, |far: f64, p: Vector3<f64>| far.max(p.norm()));
        least = (least.0.max(LEAST_SINGLE * far), "the single precision of bodies");
    }
    if target.quantity == Quantity::Moment
        && scene.cables.iter().all(|cable| cable.mean_of(|section| section.bending_stiffness) == 0.0)
    {
        return Err(Error::NoMoment { error: target.to_string() });
    }
    if target.of_positions().is_none() {
        least.0 = match (target.relative, scene.engine == Engine::Rapier) {
            (true, true) => LEAST_SHARE_SINGLE,
            (true, false) => LEAST_SHARE,
            (false, _) => f64::MIN_POSITIVE,
        };
    }
    if error >= least.0 && error.is_finite() {
        return Ok(());
    }
    let unit = target.unit();
    Err(Error::ErrorTooSmall { error: target.to_string(), least: least.0, unit, reason: least.1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run that failed, and ended the study, is named by the warning, with what it said.
    #[test]
    fn the_run_that_failed_is_named() {
        let mut claim = serde_json::json!({
            "asked_m": 0.01, "claimed_m": null, "mesh_m": 1e-3, "time_m": 0.02, "outcome": "no_convergence", "horizon_s": 20.5,
            "other_branch": false, "host_step_limits": false, "elements": 16, "tolerance_m": 1e-6, "runs": 5, "cost": 3.0,
            "failed": { "elements": 32, "tolerance_m": 1e-8, "parts": 1 }, "failed_because": "step failed", "elements_of": { "wire": 16 },
            "not_covered": []
        });
        let told = |claim: &serde_json::Value| {
            let claim: ErrorClaim = serde_json::from_value(claim.clone()).unwrap();
            claim.warning().unwrap().to_string()
        };
        let text = told(&claim);
        assert!(text.contains("not proven from 20.5000 s on"), "{text}");
        assert!(text.ends_with("the run with elements = 32 and tolerance 1.0e-8 m failed: step failed"), "{text}");
        claim["failed"] = serde_json::Value::Null;
        claim["steps_apart"] = serde_json::json!(true);
        assert!(told(&claim).ends_with("runs with shorter steps do not come closer"), "{}", told(&claim));
        claim["steps_apart"] = serde_json::json!(false);
        assert!(told(&claim).ends_with("meshes up to elements = 16 do not come closer"), "{}", told(&claim));
    }
}
