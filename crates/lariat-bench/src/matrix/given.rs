//! Runs to a given error beside each other feature: what is claimed holds, or it is told.

use super::draft::Draft;
use super::feature::Feature;
use super::laws::{Ended, STEP, apart};
use super::scene::{Fault, Scene};
use crate::stability::outcome::Check;
use lariat_ancf::study::{Outcome, Record, Resolution, Study, StudyError};
use lariat_ancf::{Fidelity, Integrator, Vector3};

/// Simulated time in s.
const DURATION: f64 = 0.2;
/// Error that is asked for, in m.
const ASKED: f64 = 0.02;
/// Most elements of a run.
const LIMIT: usize = 32;
/// Elements of the run that the claim is compared with, over those of the drawing.
const FINER: usize = 6;

/// Runs a feature to a given error.
///
/// # Errors
/// [`Ended`].
pub fn run(feature: Feature) -> Result<Vec<Check>, Ended> {
    let draft = Draft::of(&[feature], false);
    let coupled = draft.needs_discrete_gradient();
    let once = |resolution: &Resolution, record: &mut Record| -> Result<Vec<Vector3<f64>>, Fault> {
        let elements = resolution.elements_of(draft.elements, draft.elements);
        let mut scene = Scene::new(STEP / f64::from(resolution.parts), false);
        scene.add_meshed(&draft, elements, Some(Fidelity::Custom(resolution.integrator())))?;
        if feature == Feature::Statics {
            scene.set.equilibrium(&mut scene.physics)?;
        }
        while scene.time < DURATION - 0.25 * STEP {
            for _ in 0..resolution.parts {
                scene.step()?;
            }
            if feature == Feature::Snapshot && (scene.time - 0.5 * DURATION).abs() < 0.5 * STEP {
                scene.save_and_restore()?;
            }
            record.frame(scene.time);
            scene.set.iter().for_each(|(_, cable)| {
                record.cable(cable);
            });
        }
        Ok(scene.positions())
    };
    let study = Study::new(DURATION, STEP, once).coupled(coupled);
    let proof = match study.error(ASKED).limit(LIMIT).run() {
        Ok(proof) => proof,
        Err(StudyError::Run { source, .. }) => return Err(Ended::Refused(source.to_string())),
        Err(error) => return Err(Ended::Refused(error.to_string())),
    };
    if proof.claim.outcome != Outcome::Proven {
        // told, and no claim: nothing is measured
        return Ok(Vec::new());
    }
    // what engineering is for contact and reels
    let fine = if coupled { Fidelity::Custom(Integrator::COUPLED) } else { Fidelity::Engineering };
    let mut finer = Scene::new(STEP / 8.0, false);
    let failed = |fault: Fault| Ended::Failed(0.0, format!("the finer run: {fault}"));
    finer.add_meshed(&draft, FINER * draft.elements, Some(fine)).map_err(failed)?;
    if feature == Feature::Statics {
        finer.set.equilibrium(&mut finer.physics).map_err(|error| failed(error.into()))?;
    }
    finer.run_to(DURATION).map_err(failed)?;
    let off = apart(&proof.world, &finer.positions());
    Ok(vec![Check::at_most("off what is claimed, m", off, ASKED, "a finer run")])
}
