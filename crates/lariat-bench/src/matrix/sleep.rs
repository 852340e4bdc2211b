//! Sleep beside each other feature: what acts on a cable and changes wakes it, or it never sleeps.
//!
//! # Equation
//!
//! A weight of 0.25 kg hangs at rest on a damped rope, with the feature in its quiet form. At
//! `CHANGE` it changes: a flow rises, a reel turns, an obstacle moves. The world that may sleep is
//! then where the world that may not is.
//!
//! # Alternatives considered
//!
//! Asking whether the cable is awake: a cable that woke too late would pass.

use super::draft::{Draft, Hold, Kind, LENGTH, Wound, varying, water, waving};
use super::feature::Feature;
use super::laws::{Ended, STEP, apart};
use super::scene::{Fault, Scene};
use crate::stability::outcome::Check;
use lariat_ancf::{
    At, Buoyancy, Damping, Effects, Flow, GravityScale, LineLoad, Motion, PointLoad, Reel, RestShape, Strength, Vector3,
};
use lariat_rapier::CableHandle;

/// When the feature changes, in s.
const CHANGE: f64 = 6.0;
/// Time in s that is run from then on.
const AFTER: f64 = 0.75;
/// Mass of the weight in kg.
const MASS: f64 = 0.25;
/// Moment of inertia in kg m^2 of the weight, a cube of 8 cm: m a^2/6.
const INERTIA: f64 = MASS * 0.08 * 0.08 / 6.0;
/// Largest difference in m of the world that may sleep: what sleep leaves out is slower than
/// 2 mm/s, for this time.
const DIFFERENCE: f64 = 2e-3 * AFTER;
/// Least motion in m by which a change counts as one.
const MOVES: f64 = 2e-3;

/// Returns the drawing of a feature in its quiet form.
fn draft(feature: Feature) -> Draft {
    let mut draft = Draft::of(&[feature], false);
    draft.hangs = true;
    // what touches itself, too, hangs as a line: a coil never rests in this time
    (draft.coil, draft.elements) = (false, 6);
    let damping = draft.effects.damping.get_or_insert(Damping { axial: 0.0, bending: 0.0 });
    (damping.axial, damping.bending) = (0.03, 0.03);
    if !matches!(draft.end, Hold::Body(_)) {
        draft.end = Hold::Body(Kind::Dynamic);
    }
    if let Some(Wound::Reel(reel)) = &mut draft.wound[0] {
        let rate = reel.rate.first().map_or(0.0, |row| row[1]);
        reel.rate = vec![[CHANGE, rate]];
        // strong enough to hold the weight until it changes
        reel.max_force = reel.max_force.map(|_| 20.0);
    }
    if feature == Feature::Current {
        let flow = Flow::uniform(Vector3::new(0.5, 0.0, 0.5)).with_history([[CHANGE, 0.0], [CHANGE + 0.1, 1.0]]);
        draft.effects.drag.iter_mut().for_each(|drag| drag.flow = flow.clone());
    }
    if feature.is_water() {
        // at rest until it changes
        let flows = draft.water.iter_mut().map(|water| &mut water.flow);
        for flow in flows.chain(draft.effects.drag.iter_mut().map(|drag| &mut drag.flow)) {
            flow.velocity = Vector3::zeros();
            flow.surface.iter_mut().for_each(|surface| surface.wave = None);
        }
    }
    if feature == Feature::PointLoad {
        draft.loads = vec![PointLoad { start: CHANGE, ..PointLoad::force(0.8, Vector3::new(0.0, 0.0, 1.0)) }];
    }
    if feature == Feature::LoadHistory {
        draft.loads = vec![varying(CHANGE)];
    }
    if matches!(feature, Feature::LineLoad | Feature::Buoyancy | Feature::RestShape | Feature::GravityScale) {
        // given when it changes
        let damping = draft.effects.damping.take();
        draft.effects = Effects { damping, ..Effects::default() };
    }
    // a weight that turns on its rope rests soonest if its damping is critical; of that of a stranded rope the
    // share GJ/(GJ + k^2 EA) acts, so its GJ is ten times the rest
    if let Some(torsion) = &mut draft.effects.torsion {
        let lay = torsion.torque_per_tension.powi(2) * Draft::section().axial_stiffness;
        torsion.stiffness = torsion.stiffness.max(10.0 * lay);
        torsion.damping = 2.0 * (INERTIA * LENGTH / torsion.stiffness).sqrt();
        // a quarter of a turn from where it rests under the weight: it has 6 s
        let unlaid = torsion.torque_per_tension * MASS * 9.81 * LENGTH / torsion.stiffness;
        torsion.initial_twist = 0.25 - unlaid / std::f64::consts::TAU;
    }
    if matches!(feature, Feature::Break | Feature::Prescribed) {
        draft.strength = None;
        draft.start = Hold::World;
    }
    draft.from = CHANGE;
    draft
}

/// Changes what a feature does; nothing for one that changes by itself, or not at all.
fn change(scene: &mut Scene, feature: Feature) -> Result<(), Fault> {
    let rope = scene.rope()?;
    let cable = |scene: &mut Scene, act: &dyn Fn(&mut lariat_ancf::Cable) -> Result<(), lariat_ancf::Error>| {
        Ok::<(), Fault>(act(scene.set.get_mut(rope)?)?)
    };
    match feature {
        Feature::Prescribed | Feature::Held | Feature::Clamped => {
            let to = Vector3::new(0.05, 0.02, 0.0);
            let motion = Motion::hermite(scene.time, 1.0, (Vector3::zeros(), Vector3::zeros()), (to, Vector3::zeros()));
            cable(scene, &|cable| cable.set_motion(0, motion))
        }
        Feature::LineLoad => {
            cable(scene, &|cable| cable.set_line_loads(Some(LineLoad::uniform(Vector3::new(0.0, 0.0, 0.5)).into())))
        }
        Feature::Buoyancy => cable(scene, &|cable| {
            let mut buoyancy = Buoyancy::new(1000.0, 0.0);
            buoyancy.area = Some(1e-3);
            cable.set_buoyancy(Some(buoyancy))
        }),
        Feature::RestShape => cable(scene, &|cable| cable.set_rest_shape(Some(RestShape::stretched(0.97)))),
        feature if feature.is_water() => {
            let moving = if feature == Feature::Wave { waving() } else { water() };
            scene.set.water_mut().ok_or("no water")?.set_water(moving)?;
            Ok(())
        }
        Feature::GravityScale => cable(scene, &|cable| cable.set_gravity_scale(Some(GravityScale(-2.0)))),
        Feature::Break => {
            scene.set.set_strength(rope, Strength::tension(1.0))?;
            Ok(())
        }
        Feature::ReelBrake | Feature::FreeSpool => cable(scene, &|cable| {
            let reel = cable.reel_description(At::Start).cloned().unwrap_or_default();
            let force = if feature == Feature::FreeSpool { 0.0 } else { 1.0 };
            cable.set_reel(At::Start, Reel { max_force: Some(force), ..reel })
        }),
        _ => {
            scene.disturb(feature);
            Ok(())
        }
    }
}

/// Returns whether a feature changes something here.
fn changes(feature: Feature) -> bool {
    let lasts = matches!(
        feature,
        Feature::TouchesItself
            | Feature::AxialDamping
            | Feature::BendingDamping
            | Feature::Drag
            | Feature::Torsion
            | Feature::Stranded
            | Feature::HookeLaw
            | Feature::RopeLaw
            | Feature::CurveLaw
            | Feature::Sheave
            | Feature::HeavySheave
            | Feature::Junction
            | Feature::Kink
            | Feature::TouchesFloor
    );
    !(lasts || feature.is_procedure())
}

/// Runs a feature beside sleep.
///
/// # Errors
/// [`Ended`].
pub fn beside(feature: Feature) -> Result<Vec<Check>, Ended> {
    let (mut runs, mut restored) = (Vec::new(), None);
    for sleeps in [true, false] {
        let mut scene = Scene::new(STEP, false);
        if !sleeps {
            scene.set.settings.sleep_speed = 0.0;
        }
        scene.add(&draft(feature)).map_err(|fault| Ended::Refused(fault.to_string()))?;
        let failed = |time: f64| move |fault: Fault| Ended::Failed(time, fault.to_string());
        if feature == Feature::Statics {
            let found = scene.set.equilibrium(&mut scene.physics);
            found.map_err(|error| Ended::Refused(error.to_string()))?;
        }
        scene.step().map_err(|fault| Ended::Refused(fault.to_string()))?;
        scene.run_to(CHANGE).map_err(failed(CHANGE))?;
        let before = scene.positions();
        let slept = scene.set.iter().map(|(handle, _)| handle).collect::<Vec<CableHandle>>();
        let slept = slept.iter().any(|cable| scene.set.is_asleep(*cable).unwrap_or(false));
        if feature == Feature::Snapshot && sleeps {
            scene.save_and_restore().map_err(failed(CHANGE))?;
            let still = scene.set.iter().all(|(cable, _)| scene.set.is_asleep(cable).unwrap_or(false));
            restored = Some(f64::from(u8::from(still)));
        }
        change(&mut scene, feature).map_err(failed(CHANGE))?;
        scene.run_to(CHANGE + AFTER).map_err(failed(CHANGE + AFTER))?;
        runs.push((before, scene.positions(), slept));
    }
    let [(_, asleep, slept), (before, awake, _)] = runs.as_slice() else { return Ok(Vec::new()) };
    let source = "the same world that may not sleep";
    let moved = if before.len() == awake.len() { apart(before, awake) } else { f64::INFINITY };
    let mut checks = vec![Check::at_most("difference from awake, m", apart(asleep, awake), DIFFERENCE, source)];
    if let Some(restored) = restored {
        checks.push(Check::between("sleeps when read back", restored, (1.0, 1.0), "it slept when it was saved"));
    }
    if changes(feature) {
        checks.push(Check::between("motion after a change, m", moved, (MOVES, f64::INFINITY), "it changes"));
    } else {
        let source = "a damped weight at rest sleeps";
        checks.push(Check::between("sleeps", f64::from(u8::from(*slept)), (1.0, 1.0), source));
    }
    Ok(checks)
}
