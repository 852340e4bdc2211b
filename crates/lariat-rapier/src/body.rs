//! Rapier's bodies as the mechanics sees them, and what is remembered of each between steps.

use crate::Error;
use crate::convert::{matrix, rotation, vector};
use ::nalgebra::Vector3;
use lariat_ancf::island::{BodyMemory, RigidBody};
use rapier::dynamics::{LockedAxes, RigidBodyHandle};
use rapier::math::{AngVector, Pose, Vector};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// What the coupling remembers of a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Remembered {
    pub handle: RigidBodyHandle,
    /// Learnt force of contacts and joints, in N.
    pub force: Vector3<f64>,
    /// Learnt torque of contacts and joints, in N m.
    pub torque: Vector3<f64>,
    /// The body in `f64`, as long as Rapier's copy is what was written last.
    pub exact: Option<Exact>,
}

/// A body's state in `f64` beside the state in Rapier that stands for it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Exact {
    pub position: Vector3<f64>,
    pub rotation: ::nalgebra::UnitQuaternion<f64>,
    pub velocity: Vector3<f64>,
    pub spin: Vector3<f64>,
    /// Its accelerations at the end of the step that made this state.
    pub accelerations: Option<BodyMemory>,
    /// Centre of mass in body axes and inverse mass, as Rapier had them.
    pub centre: Vector,
    pub inverse_mass: rapier::math::Real,
    pub pose: Pose,
    pub linvel: Vector,
    pub angvel: AngVector,
}

impl Remembered {
    pub fn new(handle: RigidBodyHandle) -> Self {
        Remembered { handle, force: Vector3::zeros(), torque: Vector3::zeros(), exact: None }
    }

    /// Forgets state and reaction: they belong to a body as it was.
    pub fn forget(&mut self) {
        *self = Remembered::new(self.handle);
    }
}

/// True if the coupling integrates this body: dynamic, enabled, of finite mass. Others move the cable and feel nothing.
pub(crate) fn is_integrated(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    world
        .bodies
        .get(handle)
        .is_some_and(|b| b.is_dynamic() && b.is_enabled() && b.mass_properties().local_mprops.inv_mass > 0.0)
}

/// Reads a body: its mass, its state (in `f64` if Rapier's is what was written last), gravity, the user's and the learnt forces. A
/// sleeping one stands still.
pub(crate) fn read(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    memory: &Remembered,
    time: f64,
) -> Result<RigidBody, Error> {
    let body = &world.bodies[handle];
    let properties = body.mass_properties();
    let local = &properties.local_mprops;
    let mass = 1.0 / f64::from(local.inv_mass);
    let free = properties.flags;
    let allowed = |axis: LockedAxes| !free.contains(axis);
    let turns = [
        allowed(LockedAxes::ROTATION_LOCKED_X),
        allowed(LockedAxes::ROTATION_LOCKED_Y),
        allowed(LockedAxes::ROTATION_LOCKED_Z),
    ];
    let rigid = local.inv_principal_inertia;
    let turnable = rigid.x > 0.0 && rigid.y > 0.0 && rigid.z > 0.0;
    let inertia = if turnable { matrix(&local.reconstruct_inertia_matrix()) } else { ::nalgebra::Matrix3::identity() };
    let mut out = RigidBody {
        mass,
        inertia,
        position: vector(body.center_of_mass()),
        rotation: rotation(*body.rotation()),
        velocity: vector(body.linvel()),
        angular_velocity: vector(body.angvel()),
        force: vector(world.gravity) * mass * f64::from(body.gravity_scale())
            + vector(body.user_force())
            + memory.force,
        torque: vector(body.user_torque()) + memory.torque,
        free: [
            allowed(LockedAxes::TRANSLATION_LOCKED_X),
            allowed(LockedAxes::TRANSLATION_LOCKED_Y),
            allowed(LockedAxes::TRANSLATION_LOCKED_Z),
            turns[0] && turnable,
            turns[1] && turnable,
            turns[2] && turnable,
        ],
        carried: None,
        gyroscopic: body.gyroscopic_forces_enabled(),
        memory: None,
    };
    if let Some(exact) = &memory.exact
        && exact.pose == *body.position()
        && exact.centre == body.local_center_of_mass()
        && exact.inverse_mass == local.inv_mass
    {
        out.position = exact.position;
        out.rotation = exact.rotation;
        let (moves, turns) = (exact.linvel == body.linvel(), exact.angvel == body.angvel());
        if moves {
            out.velocity = exact.velocity;
        }
        if turns {
            out.angular_velocity = exact.spin;
        }
        out.memory = exact.accelerations.filter(|_| moves && turns);
    }
    if body.is_sleeping() {
        out.free = [false; 6];
        out.velocity = Vector3::zeros();
        out.angular_velocity = Vector3::zeros();
    }
    let checks: [(&'static str, bool); 4] = [
        ("position", out.position.iter().chain(out.rotation.coords.iter()).all(|x| x.is_finite())),
        ("velocity", out.velocity.iter().chain(out.angular_velocity.iter()).all(|x| x.is_finite())),
        ("force", out.force.iter().chain(out.torque.iter()).all(|x| x.is_finite())),
        ("mass", mass.is_finite() && out.inertia.iter().all(|x| x.is_finite())),
    ];
    match checks.iter().find(|(_, ok)| !ok) {
        None => Ok(out),
        Some((what, _)) => Err(Error::BodyNotFinite { body: handle, what, time }),
    }
}
