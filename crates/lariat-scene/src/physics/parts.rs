//! A world taken apart, for a program that steps it itself.

use super::{Physics, Script};
use crate::error::Error;
use crate::scene::Scene;
use lariat_ancf::{Cable, Level};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::math::Real;
use lariat_rapier::rapier::prelude::PhysicsWorld;
use lariat_rapier::{AttachmentHandle, CableHandle, CableSet, SheaveHandle};

/// The bodies and cables of a scene at its start, with what the scene calls them.
///
/// A step of the scene is [`Script::set`] with the times at its ends, and then [`CableSet::step`] on
/// the bodies.
///
/// ```
/// use lariat_scene::{Purpose, Scene, run::Parts};
///
/// let scene = Scene::parse("payload.toml", r#"
/// engine = "rapier"
/// duration = 1.0
/// [[body]]
/// name = "crate"
/// shape = { cuboid = [0.1, 0.1, 0.1] }
/// mass = 50.0
/// position = [2.0, -0.1, 0.0]
/// [[cable]]
/// name = "sling"
/// points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
/// section = { square = 0.01 }
/// density = 4000.0
/// youngs_modulus = 1.0e9
/// [[attachment]]
/// cable = "sling"
/// at = "start"
/// body = "world"
/// [[attachment]]
/// cable = "sling"
/// at = "end"
/// body = "crate"
/// anchor = [0.0, 0.1, 0.0]
/// "#, &[], Purpose::Run)?;
/// let Parts { mut world, mut cables, bodies, mut script, .. } = Parts::of(&scene)?;
/// let mut time = 0.0;
/// while time < scene.duration {
///     script.set(&mut world, time, time + scene.dt);
///     cables.step(&mut world).expect("steps");
///     time += scene.dt;
/// }
/// assert!(world.bodies[bodies[0].1].translation().y < -1.0);
/// # Ok::<(), lariat_scene::Error>(())
/// ```
#[non_exhaustive]
pub struct Parts {
    /// The bodies; their step is the host step of the scene.
    pub world: PhysicsWorld,
    /// The cables, and the water that bodies are in.
    pub cables: CableSet,
    /// Names of bodies, in the order of the scene.
    pub bodies: Vec<(String, RigidBodyHandle)>,
    /// Names of cables, in the order of the scene; a cable over sheaves is several.
    pub ropes: Vec<(String, CableHandle)>,
    /// Names of the attachments to bodies, in the order of the scene; those to the world are
    /// supports of their cables.
    pub attachments: Vec<(String, AttachmentHandle)>,
    /// Names of sheaves, in the order of the scene.
    pub sheaves: Vec<(String, SheaveHandle)>,
    /// Paths of kinematic bodies, and loads on bodies.
    pub script: Script,
    /// What the start of the scene tells, a line for each kind of warning.
    pub told: Vec<String>,
}

impl Physics {
    /// Puts the cables of a scene without bodies into a world.
    ///
    /// # Errors
    /// As [`build`](Self::build) and [`take`](Self::take).
    pub fn of_cables(scene: &Scene, cables: Vec<Cable>) -> Result<Self, Error> {
        let mut physics = Physics::build(scene)?;
        // no body needs shorter ones
        physics.rapier_steps = 1;
        physics.take(scene, cables, &[])?;
        Ok(physics)
    }

    /// Takes the world apart, for a program that steps it itself. The cables are watched, as those
    /// of any set.
    pub fn into_parts(self, scene: &Scene) -> Parts {
        let Physics { mut world, bodies, mut cables, handles, attachments, sheaves, mut script, rapier_steps, .. } =
            self;
        script.leave_resting();
        world.integration_parameters.dt = scene.dt as Real;
        cables.settings.rapier_steps = rapier_steps;
        cables.settings.watch = true;
        // the run chooses what it tells of
        cables.settings.warn_level = Some(Level::Coarse);
        for handle in &handles {
            if let Ok(cable) = cables.get_mut(*handle) {
                cable.set_watched(true);
            }
        }
        let attached = scene.attachments.iter().zip(attachments);
        Parts {
            world,
            cables,
            bodies: scene.bodies.iter().map(|body| body.name.clone()).zip(bodies).collect(),
            ropes: scene.cables.iter().map(|cable| cable.name.clone()).zip(handles).collect(),
            attachments: attached.filter_map(|(own, handle)| Some((own.name.clone(), handle?))).collect(),
            sheaves: scene.sheaves.iter().map(|sheave| sheave.name.clone()).zip(sheaves).collect(),
            script,
            told: Vec::new(),
        }
    }
}
