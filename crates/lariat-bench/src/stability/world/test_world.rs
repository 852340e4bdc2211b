//! A world with its cables, and how bodies and ropes are added.

use super::convert::{from_rapier, to_rapier};
use super::engine::rapier::prelude::*;
use super::engine::{AttachmentHandle, AttachmentKind, CableHandle, CableSet, Error};
use super::materials::{all_effects, torsion};
use super::monitor::Monitor;
use super::peers::{End, Joints, PeerRope};
use crate::stability::host::{CableModel, Host};
use lariat_ancf::{At, Cable, CableBuilder, Method, Snapshot, Vector3};

/// Any error of a case.
pub type Fault = Box<dyn std::error::Error + Send + Sync>;

/// Bodies that the coupling adds to joints are heavier than this, in kg, and belong to no scene.
pub const HEAVIEST_BODY: f64 = 1e8;

/// A host step that ended in an error.
#[derive(Debug, thiserror::Error)]
#[error("{error}")]
pub struct StepError {
    /// The error of the coupling.
    pub error: Error,
    /// Whether the cables that failed and the bodies on them are bitwise what they were before the
    /// Rapier step that failed.
    pub state_kept: bool,
}

impl StepError {
    /// Returns whether the error says which cable or body failed.
    pub fn names_culprit(&self) -> bool {
        match &self.error {
            Error::StepRefused { cables, .. } => cables.iter().all(|cable| cable.starts_with("rope ")),
            _ => false,
        }
    }
}

/// A rope of a world.
pub enum Rope {
    /// A cable of the set.
    Cable(CableHandle),
    /// One of Rapier's own.
    Peer(PeerRope),
}

/// A world, its cables, and what is measured on them.
pub struct TestWorld {
    pub physics: PhysicsWorld,
    pub set: CableSet,
    pub model: CableModel,
    pub host: Host,
    /// Host steps done.
    pub steps_done: usize,
    /// Time in s.
    pub time: f64,
    pub ropes: Vec<Rope>,
    pub attachments: Vec<AttachmentHandle>,
    pub monitor: Monitor,
    /// Constant forces of Rapier in N on bodies, whose work is from outside.
    pub known_forces: Vec<(RigidBodyHandle, Vector3<f64>)>,
}

/// Cables and bodies, to the bit.
struct SavedState {
    cables: Vec<(CableHandle, Snapshot, Vec<u64>)>,
    bodies: Vec<(RigidBodyHandle, [u64; 13])>,
}

impl SavedState {
    /// Returns whether every cable and body is in `other`, in the same state.
    fn is_part_of(&self, other: &SavedState) -> bool {
        self.cables.iter().all(|cable| other.cables.contains(cable))
            && self.bodies.iter().all(|body| other.bodies.contains(body))
    }
}

impl TestWorld {
    /// Creates an empty world with the settings of a host.
    pub fn new(host: Host, model: CableModel) -> Self {
        let mut physics = PhysicsWorld::new();
        let mut set = CableSet::new();
        // Rapier's own ropes get the same split of the host step as a set of cables has by default
        let steps = if model == CableModel::Lariat { 1 } else { set.settings.rapier_steps };
        physics.integration_parameters.dt = 1.0 / (host.rate as Real * steps as Real);
        physics.integration_parameters.num_solver_iterations = host.iterations;
        set.settings.sleep_speed = 2e-3;
        TestWorld {
            physics,
            set,
            model,
            host,
            steps_done: 0,
            time: 0.0,
            ropes: Vec::new(),
            attachments: Vec::new(),
            monitor: Monitor::default(),
            known_forces: Vec::new(),
        }
    }

    /// Returns the host's regular step in s.
    pub fn dt(&self) -> f64 {
        1.0 / f64::from(self.host.rate)
    }

    /// Switches gravity off.
    pub fn remove_gravity(&mut self) {
        self.physics.gravity = Vector::ZERO;
    }

    /// Adds a dynamic ball.
    pub fn ball(&mut self, mass: f64, radius: f64, at: [f64; 3]) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic().translation(to_rapier(at)).can_sleep(false);
        self.physics.insert(body, ColliderBuilder::ball(radius as Real).mass(mass as Real)).0
    }

    /// Adds a dynamic cube of half side `half`.
    pub fn cube(&mut self, mass: f64, half: f64, at: [f64; 3]) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic().translation(to_rapier(at)).can_sleep(false);
        let half = half as Real;
        self.physics.insert(body, ColliderBuilder::cuboid(half, half, half).mass(mass as Real)).0
    }

    /// Adds a fixed box.
    pub fn post(&mut self, at: [f64; 3], half: [f64; 3]) -> RigidBodyHandle {
        let half = to_rapier(half);
        let body = RigidBodyBuilder::fixed().translation(to_rapier(at));
        self.physics.insert(body, ColliderBuilder::cuboid(half.x, half.y, half.z)).0
    }

    /// Adds a kinematic body that is moved by its velocity.
    pub fn winch(&mut self, at: [f64; 3]) -> RigidBodyHandle {
        self.physics.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(to_rapier(at)))
    }

    /// Sets the velocity of a body.
    pub fn set_velocity(&mut self, body: RigidBodyHandle, velocity: [f64; 3]) {
        self.physics.bodies[body].set_linvel(to_rapier(velocity), true);
    }

    /// Returns the position of a body's origin in m.
    pub fn position(&self, body: RigidBodyHandle) -> Vector3<f64> {
        from_rapier(self.physics.bodies[body].translation())
    }

    /// Returns the velocity of a body in m/s.
    pub fn velocity(&self, body: RigidBodyHandle) -> Vector3<f64> {
        from_rapier(self.physics.bodies[body].linvel())
    }

    /// Counts the work of a constant force in N on a body, such as that of a saturated motor, as
    /// work from outside.
    pub fn count_work_of(&mut self, body: RigidBodyHandle, force: Vector3<f64>) {
        self.known_forces.push((body, force));
    }

    /// Adds a rope of the model of this world between two ends, and returns its number.
    pub fn rope(&mut self, builder: CableBuilder, start: End, end: End) -> Result<usize, Fault> {
        let mut builder = builder;
        for (at, end) in [(At::Start, start), (At::End, end)] {
            builder = match end {
                End::Fixed => builder.fix(at),
                End::Clamped => builder.clamp(at),
                _ => builder,
            };
        }
        let mut cable = builder.name(format!("rope {}", self.ropes.len())).build()?;
        if self.host.effects {
            let own = cable.effects().clone();
            let mut effects = all_effects(9.81 * cable.elements()[0].section.mass_per_length);
            effects.damping = own.damping.or(effects.damping);
            let is_clamp = |end: End| matches!(end, End::Clamped | End::ClampedOn(..));
            if is_clamp(start) && is_clamp(end) && cable.integrator().method == Method::DiscreteGradient {
                effects.torsion = torsion(cable.elements()[0].section.bending_stiffness);
            }
            cable.set_effects(effects)?;
        }
        let world = &mut self.physics;
        let rope = match self.model {
            CableModel::Lariat => Rope::Cable(self.attach(cable, start, end)?),
            CableModel::SoftRope => Rope::Peer(PeerRope::soft(world, &cable, [start, end], 1e6, None)),
            CableModel::CapsuleChain => {
                Rope::Peer(PeerRope::capsules(world, &cable, [start, end], Joints::Impulse, None))
            }
            CableModel::Multibody => {
                Rope::Peer(PeerRope::capsules(world, &cable, [start, end], Joints::Multibody, None))
            }
        };
        self.ropes.push(rope);
        Ok(self.ropes.len() - 1)
    }

    fn attach(&mut self, cable: Cable, start: End, end: End) -> Result<CableHandle, Fault> {
        let handle = self.set.insert(cable);
        for (at, end) in [(At::Start, start), (At::End, end)] {
            let (body, anchor, kind) = match end {
                End::On(body, anchor) => (body, anchor, AttachmentKind::Ball),
                End::ClampedOn(body, anchor) => (body, anchor, AttachmentKind::Clamp),
                _ => continue,
            };
            self.attachments.push(self.set.attach(&self.physics, handle, at, body, to_rapier(anchor), kind)?);
        }
        Ok(handle)
    }

    /// Returns a cable of the set; `None` for one of Rapier's own ropes.
    pub fn cable(&self, rope: usize) -> Option<&Cable> {
        match self.ropes.get(rope) {
            Some(Rope::Cable(handle)) => self.set.get(*handle).ok(),
            _ => None,
        }
    }

    /// Returns the handle of a cable of the set.
    pub fn cable_handle(&self, rope: usize) -> Result<CableHandle, Fault> {
        match self.ropes.get(rope) {
            Some(Rope::Cable(handle)) => Ok(*handle),
            _ => Err("not a cable of the set".into()),
        }
    }

    /// Returns a cable of the set, to change it.
    pub fn cable_mut(&mut self, rope: usize) -> Result<&mut Cable, Fault> {
        let handle = self.cable_handle(rope)?;
        Ok(self.set.get_mut(handle)?)
    }

    /// Returns the tension of a cable at an arc length in N; NaN for Rapier's own ropes, which do
    /// not tell it.
    pub fn tension(&self, rope: usize, s: f64) -> f64 {
        self.cable(rope).and_then(|c| c.sample(s).ok()).map_or(f64::NAN, |sample| sample.tension)
    }

    /// Returns the force of an attachment at the last step in N.
    pub fn force(&self, attachment: usize) -> Vector3<f64> {
        let attachment = self.attachments.get(attachment).and_then(|a| self.set.attachment(*a).ok());
        attachment.map_or(Vector3::repeat(f64::NAN), |a| a.force())
    }

    /// Advances by one host step.
    ///
    /// The host step of a set is taken apart here as [`CableSet::step`] does it, to compare the
    /// state that an error leaves with the state before the Rapier step that failed.
    pub fn step(&mut self) -> Result<(), StepError> {
        if self.model != CableModel::Lariat {
            (0..self.set.settings.rapier_steps).for_each(|_| self.physics.step());
            return Ok(());
        }
        let error = |error| StepError { error, state_kept: false };
        let mut host = self.set.begin(&mut self.physics).map_err(error)?;
        let mut failed = None;
        while host.is_unfinished() {
            let all = |_: CableHandle| true;
            let before = failed.is_none().then(|| self.saved_state(&all));
            self.set.predict_next(&mut self.physics, &mut host).map_err(error)?;
            self.physics.step();
            self.set.reconcile(&mut self.physics);
            if let (Some(before), Some(failure)) = (before, self.set.failures().first().cloned()) {
                let now = self.saved_state(&|cable| failure.cables.contains(&cable));
                failed = Some(StepError { error: failure.error, state_kept: now.is_part_of(&before) });
            }
        }
        let finished = self.set.finish(&mut self.physics, host);
        failed.map_or_else(|| finished.map_err(error), Err)
    }

    /// Saves the chosen cables and the bodies on them.
    fn saved_state(&self, chosen: &dyn Fn(CableHandle) -> bool) -> SavedState {
        let bits = |cable: &Cable| {
            cable.positions().iter().chain(cable.velocities()).chain([&cable.time()]).map(|x| x.to_bits()).collect()
        };
        let cables = self.set.iter().filter(|(handle, _)| chosen(*handle));
        let cables = cables.map(|(handle, cable)| (handle, cable.snapshot().clone(), bits(cable))).collect();
        let attached =
            |body: RigidBodyHandle| self.set.attachments().any(|(_, a)| a.body() == body && chosen(a.cable()));
        let bodies = self.physics.bodies.iter().filter(|(handle, _)| attached(*handle));
        let state = |b: &RigidBody| {
            let (x, r, v, w) = (b.translation(), b.rotation(), b.linvel(), b.angvel());
            let state = [x.x, x.y, x.z, r.x, r.y, r.z, r.w, v.x, v.y, v.z, w.x, w.y, w.z];
            state.map(|x| f64::from(x).to_bits())
        };
        SavedState { cables, bodies: bodies.map(|(handle, b)| (handle, state(b))).collect() }
    }
}
