//! A cable whose nodes are held to bodies that another program moves: one step.
//!
//! # Equation
//!
//! Each body follows the cubic between the velocities at both ends of the step, and a node of the cable is held to it
//! (`lariat_ancf::island`, driven bodies).

use lariat_ancf::coupling::Coupling;
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
    /// Returns the driven body of a step to `to`.
    fn body(&self, to: &Motion, h: f64) -> Result<RigidBody, Error> {
        let from = &self.motion;
        let mut body = RigidBody::new(1.0, Matrix3::identity(), from.position)?;
        body.rotation = from.rotation;
        body.velocity = (to.position - from.position) / h;
        body.angular_velocity = (to.rotation * from.rotation.inverse()).scaled_axis() / h;
        let mean = [body.velocity, body.angular_velocity];
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
        let wrenches = self.ends.iter_mut().zip(to).zip(self.island.accounts());
        Ok(wrenches
            .map(|((end, to), account)| {
                let levers = [&end.motion, to].map(|motion| motion.rotation * end.anchor);
                let force = account.impulse / h;
                let moment = account.angular_impulse / h + (0.5 * (levers[0] + levers[1])).cross(&force);
                end.motion = *to;
                Wrench { force, moment, end_force: account.force, work: account.work }
            })
            .collect())
    }
}
