//! A scene: the world that a drawing becomes, its steps, and what is read from it.

mod build;
mod read;

use super::feature::Feature;
use crate::single::convert::to_rapier;
use build::{Swing, Turning};
use lariat_ancf::{Level, Motion, Vector3, Warning};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableHandle, CableSet, Event};
pub use read::Ledger;
use std::sync::Arc;

/// An error of a scene.
pub type Fault = Box<dyn std::error::Error + Send + Sync>;

/// Bodies that the coupling adds are heavier than this, in kg, and belong to no scene.
const HEAVIEST_BODY: f64 = 1e8;

/// Whether a warning tells that the motion is off in steps of this length.
fn is_of_steps(warning: &Warning) -> bool {
    matches!(
        warning,
        Warning::LongSteps { .. }
            | Warning::NotResolved { .. }
            | Warning::EnergyLost { .. }
            | Warning::CutShort { .. }
            | Warning::UnsolvedSteps { .. }
            | Warning::FrictionLags { .. }
    )
}

/// A world with cables.
#[derive(Default)]
pub struct Scene {
    /// The bodies.
    pub physics: PhysicsWorld,
    /// The cables.
    pub set: CableSet,
    /// Time in s.
    pub time: f64,
    /// Events so far, as far as they tell of energy that was made.
    pub made: Vec<String>,
    /// See [`told_of_steps`](Self::told_of_steps).
    steps: usize,
    /// Cables that are cut, and when in s.
    cuts: Vec<(CableHandle, f64)>,
    /// When the force density of the ropes begins, in s, if they have one.
    forced: Option<f64>,
    /// Bodies that turn on a path.
    turning: Vec<Turning>,
    /// Work of loads that vary, in J.
    load_work: f64,
}

impl Scene {
    /// Returns an empty world whose host steps have a length in s.
    pub fn new(dt: f64, floats: bool) -> Scene {
        let mut scene = Scene { physics: PhysicsWorld::new(), set: CableSet::new(), ..Scene::default() };
        scene.physics.integration_parameters.dt = dt as Real;
        scene.set.settings.warn_level = Some(Level::Coarse);
        if floats {
            scene.physics.gravity = Vector::ZERO;
        }
        scene
    }

    /// Advances by one host step, after the cuts that are due.
    ///
    /// # Errors
    /// Those of the crates.
    pub fn step(&mut self) -> Result<(), Fault> {
        let due = self.cuts.extract_if(.., |(_, time)| *time < self.time + 1e-4).collect::<Vec<_>>();
        for (cable, _) in due {
            let half = 0.5 * self.set.get(cable)?.length();
            self.set.cut(cable, half)?;
        }
        let dt = f64::from(self.physics.integration_parameters.dt);
        for turning in &self.turning {
            turning.lead(&mut self.physics, self.time + dt);
        }
        let loads = self.set.iter().any(|(_, cable)| cable.loads().iter().any(|load| !load.history.is_empty()));
        let middle = self.time + 0.5 * dt;
        let before = if loads { self.potential_of_loads(middle)? } else { 0.0 };
        self.set.step(&mut self.physics)?;
        self.time += dt;
        if loads {
            self.load_work += self.potential_of_loads(middle)? - before;
        }
        for event in self.set.take_events() {
            let Event::Warning { warning, .. } = &event else { continue };
            match warning {
                Warning::EnergyMade { .. } => self.made.push(warning.to_string()),
                warning if is_of_steps(warning) => self.steps += 1,
                _ => {}
            }
        }
        Ok(())
    }

    /// Returns how many warnings, so far and at the end of a run, tell that the motion is off in
    /// steps of this length.
    pub fn told_of_steps(&self) -> usize {
        let now = self.set.warnings(&self.physics);
        let of_steps = |told: &&lariat_rapier::Warning| match told {
            lariat_rapier::Warning::Cable { warning, .. } => is_of_steps(warning),
            _ => false,
        };
        self.steps + now.iter().filter(of_steps).count()
    }

    /// Returns the first cable that is no other one across it.
    ///
    /// # Errors
    /// None for a scene with one.
    pub fn rope(&self) -> Result<CableHandle, Fault> {
        self.named("rope").next().ok_or_else(|| "no rope".into())
    }

    /// Returns the cables whose names begin with a word.
    fn named<'a>(&'a self, word: &'a str) -> impl Iterator<Item = CableHandle> + 'a {
        self.set.iter().filter(move |(_, cable)| cable.name().starts_with(word)).map(|(handle, _)| handle)
    }

    /// Moves, pushes or turns the bodies and the cable that a feature brought to a scene that
    /// hangs.
    pub fn disturb(&mut self, feature: Feature) {
        let bodies: Vec<RigidBodyHandle> = self.physics.bodies.iter().map(|(handle, _)| handle).collect();
        for handle in bodies {
            let body = &mut self.physics.bodies[handle];
            let loose = body.gravity_scale() == 0.0;
            if f64::from(body.mass()) > HEAVIEST_BODY {
                continue;
            }
            match feature {
                Feature::KinematicBody | Feature::TouchesMoving if body.is_kinematic() => {
                    body.set_linvel(to_rapier([0.2, 0.0, 0.0]), true);
                }
                Feature::FixedBody if body.is_fixed() => {
                    let to = body.translation() + to_rapier([0.02, 0.0, 0.01]);
                    body.set_translation(to, true);
                }
                Feature::DynamicBody | Feature::ClampedBody | Feature::ImpulseJoint | Feature::MultibodyJoint
                    if body.is_dynamic() =>
                {
                    body.add_force(to_rapier([0.5, 5.0, 0.0]), true);
                }
                Feature::TouchesLoose if body.is_dynamic() && loose => {
                    body.set_linvel(to_rapier([1.0, 0.0, 0.0]), true);
                }
                Feature::Drum if body.locked_axes().contains(LockedAxes::ROTATION_LOCKED) => {
                    let free = LockedAxes::all() & !LockedAxes::ROTATION_LOCKED_Z;
                    body.set_locked_axes(free, true);
                }
                _ => {}
            }
        }
        let across = self.named("across").next();
        if feature == Feature::TouchesCable
            && let Some(cable) = across.and_then(|handle| self.set.get_mut(handle).ok())
        {
            for node in [0, cable.nodes() - 1] {
                let motion = Motion::uniform(self.time, cable.node_position(node), Vector3::x() * 0.3);
                // the ends are held: they take a motion
                let _ = cable.set_motion(node, motion);
            }
        }
    }

    /// Steps to a time in s.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn run_to(&mut self, time: f64) -> Result<(), Fault> {
        while self.is_before(time) {
            self.step()?;
        }
        Ok(())
    }

    /// Returns whether a step brings it nearer to a time in s, whatever its length.
    pub fn is_before(&self, time: f64) -> bool {
        self.time < time - 0.5 * f64::from(self.physics.integration_parameters.dt)
    }

    /// Saves the state and reads it back; the functions of a program are attached anew.
    ///
    /// # Errors
    /// Those of the format.
    pub fn save_and_restore(&mut self) -> Result<(), Fault> {
        let saved = bincode::serialize(&(&self.physics, &self.set))?;
        (self.physics, self.set) = bincode::deserialize(&saved)?;
        // parts that were cut off have the function, too
        let ropes: Vec<CableHandle> = self.named("rope").collect();
        if let Some(from) = self.forced {
            for cable in ropes {
                self.set.get_mut(cable)?.add_force_density(Arc::new(Swing { from }))?;
            }
        }
        Ok(())
    }
}
