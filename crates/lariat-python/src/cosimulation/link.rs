//! A cable whose nodes are held to bodies that another program moves: one step.
//!
//! # Equation
//!
//! Each body follows the cubic between the velocities at both ends of the step, and a node of the cable is held to it
//! (`lariat_ancf::island`, driven bodies).

use lariat_ancf::coupling::Coupling;
use lariat_ancf::integrate::OneStep;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{self as ancf, At, Error, Vector3};
use nalgebra::{Matrix3, UnitQuaternion};
use serde::{Deserialize, Serialize};

/// Largest distance in m of a node from its body, as in a world.
const LARGEST_GAP: f64 = 1e-3;

/// Pose and velocity of the reference point of a body.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Motion {
    pub position: Vector3<f64>,
    pub rotation: UnitQuaternion<f64>,
    pub velocity: Vector3<f64>,
    pub spin: Vector3<f64>,
}

/// A node of the cable that a body of the host holds.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct End {
    pub node: usize,
    /// Whether that is the last node, and the nodes that a reel at the start had added: reels add and remove nodes.
    pub is_last: bool,
    pub from_start: i64,
    /// Point of the body in its axes, from the reference point, in m.
    pub anchor: Vector3<f64>,
    /// Direction of the tangent in the axes of the body, for a clamp.
    pub direction: Option<Vector3<f64>>,
    pub motion: Motion,
}

/// What the cable does to a body over a step: mean force in N, mean moment about the reference point in N m, force at the end of the step in
/// N, and work in J.
pub(super) struct Wrench {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
    pub end_force: Vector3<f64>,
    pub work: f64,
}

/// The ends, in the order in which they were attached.
#[derive(Default)]
pub(super) struct Link {
    island: Island,
    pub ends: Vec<End>,
}

impl End {
    /// Returns velocity and angular velocity of the uniform motion of a step to `to`.
    fn mean_rates(&self, to: &Motion, h: f64) -> [Vector3<f64>; 2] {
        let from = &self.motion;
        [(to.position - from.position) / h, (to.rotation * from.rotation.inverse()).scaled_axis() / h]
    }

    /// Returns the driven body of a step to `to`.
    fn body(&self, to: &Motion, h: f64) -> Result<RigidBody, Error> {
        let from = &self.motion;
        let mut body = RigidBody::new(1.0, Matrix3::identity(), from.position)?;
        body.rotation = from.rotation;
        let mean = self.mean_rates(to, h);
        [body.velocity, body.angular_velocity] = mean;
        body.unsteadiness = [from, to].map(|end| [end.velocity - mean[0], end.spin - mean[1]]);
        body.free = [false; 6];
        Ok(body)
    }
}

impl Link {
    pub(super) fn new(ends: Vec<End>) -> Self {
        Link { ends, ..Link::default() }
    }

    /// Splits and merges elements at reels, and finds the nodes of the ends anew.
    fn remesh(&mut self, cable: &mut ancf::Cable) -> Result<(), Error> {
        if !cable.has_reel() {
            return Ok(());
        }
        cable.remesh_reel()?;
        let [start, end] = [At::Start, At::End].map(|at| cable.reel_description(at).is_some());
        for own in &mut self.ends {
            own.node = match own.node {
                _ if own.is_last && end => cable.nodes() - 1,
                0 if start => 0,
                node => node.saturating_add_signed((cable.nodes_from_start() - own.from_start) as isize),
            };
            own.from_start = cable.nodes_from_start();
        }
        Ok(())
    }

    /// Refuses a cable whose ends are not where their bodies are: somebody else has moved it.
    fn check(&self, cable: &ancf::Cable) -> Result<(), lariat_rapier::Error> {
        for end in self.ends.iter().filter(|end| end.node < cable.nodes()) {
            let place = end.motion.position + end.motion.rotation * end.anchor;
            let gap = (cable.node_position(end.node) - place).norm();
            if gap > LARGEST_GAP {
                let cable = cable.name().to_string();
                return Err(lariat_rapier::Error::GapTooLong { cable, gap, limit: LARGEST_GAP });
            }
        }
        Ok(())
    }

    /// Returns the forces on the bodies at the end of a step of `h` (s) in which they moved `to` there; `None` for those that the step itself
    /// knows there, and of contacts and reels, which have forces over steps alone.
    fn end_forces(
        &mut self,
        cable: &mut ancf::Cable,
        to: &[Motion],
        pins: &[PinConstraint],
        bodies: &[RigidBody],
        h: f64,
    ) -> Result<Vec<Option<Vector3<f64>>>, Error> {
        let by_impulses = cable.effects().contact.is_some() || cable.has_reel();
        if by_impulses || !cable.integrator().method.uses_discrete_gradients() {
            return Ok(vec![None; pins.len()]);
        }
        let (mut bodies, mut accelerations) = (bodies.to_vec(), Vec::new());
        for ((body, end), to) in bodies.iter_mut().zip(&self.ends).zip(to) {
            let mean = end.mean_rates(to, h);
            // that of the cubic: 2 and 4 are the derivatives of its rates at the end of the step
            let of = |mean: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>| {
                ((from - mean) * 2.0 + (to - mean) * 4.0) / h
            };
            accelerations.push([of(mean[0], end.motion.velocity, to.velocity), of(mean[1], end.motion.spin, to.spin)]);
            (body.position, body.rotation) = (to.position, to.rotation);
            (body.velocity, body.angular_velocity) = (to.velocity, to.spin);
        }
        let forces = self.island.forces_now(&mut [cable], &bodies, pins, &accelerations)?;
        Ok(forces.into_iter().map(|[force, _]| Some(force)).collect())
    }

    /// Advances the cable by `h` (s) while the bodies move `to` there.
    pub(super) fn step(
        &mut self,
        cable: &mut ancf::Cable,
        to: &[Motion],
        h: f64,
    ) -> Result<Vec<Wrench>, lariat_rapier::Error> {
        self.remesh(cable)?;
        self.check(cable)?;
        let mut bodies = self.ends.iter().zip(to).map(|(end, to)| end.body(to, h)).collect::<Result<Vec<_>, _>>()?;
        let pins: Vec<PinConstraint> = self
            .ends
            .iter()
            .enumerate()
            .map(|(body, end)| PinConstraint {
                cable: 0,
                node: end.node,
                body,
                anchor: end.anchor,
                direction: end.direction,
            })
            .collect();
        let integrator = cable.integrator();
        self.island.step(&mut [cable], &mut bodies, &pins, integrator, h)?;
        cable.note_host_step(false, |_| ());
        let accounts = self.island.accounts().to_vec();
        let end_forces = self.end_forces(cable, to, &pins, &bodies, h).unwrap_or_else(|_| vec![None; pins.len()]);
        let wrenches = self.ends.iter_mut().zip(to).zip(accounts).zip(end_forces);
        Ok(wrenches
            .map(|(((end, to), account), end_force)| {
                let levers = [&end.motion, to].map(|motion| motion.rotation * end.anchor);
                let force = account.impulse / h;
                let moment = account.angular_impulse / h + (0.5 * (levers[0] + levers[1])).cross(&force);
                end.motion = *to;
                Wrench { force, moment, end_force: end_force.unwrap_or(account.force), work: account.work }
            })
            .collect())
    }
}
