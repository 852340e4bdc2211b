//! Cables and rigid bodies pinned together, integrated as one system.
//!
//! An island is a set of cables and the bodies their nodes are pinned to. It is a [`Dynamics`], so every integrator of this crate
//! drives it, to the same order and with the same error control as a cable alone. A pinned position is not a coordinate: it
//! follows its body,
//!
//! ```text
//! r = x + rho + gap (1 - 3 s^2 + 2 s^3),   rho = R a        r'' = x'' + omega' x rho + omega x (omega x rho) + gap'' ...
//! ```
//!
//! where `gap` is what pin and node were apart when the step began (of a wide one the part that closes at 10 m/s) and s its elapsed share (`kinematics`, for clamps too). Virtual work carries the cable's
//! residual to the body: force f_p and torque rho x f_p. So no multiplier, no penalty, and no drift. In Newton's iteration each
//! cable is condensed on its pins (`condense`), the bodies are solved together (`dense`), and the cables follow; the tangent
//! includes the geometric stiffness of the lever, `-[f_p]x [rho]x`, without which light bodies on taut cables converge badly.
//!
//! *Validity.* Bodies that turn by less than a full turn in a step; tens of bodies (`dense` is cubic). *Rejected.* Bodies as
//! points with directors (constant mass, but flat bodies make it singular), staggered solution (blows up for light bodies).
//!
//! [`Dynamics`]: crate::integrate::Dynamics

mod account;
mod body;
mod clamp;
mod condense;
mod dense;
mod impedance;
mod kinematics;
mod made;
mod memory;
mod rotation;
mod stage;
mod system;
mod workspace;

pub use account::PinAccount;
pub use body::RigidBody;
pub use impedance::Impedance;
pub use memory::BodyMemory;
pub use workspace::CLOSING_SPEED;

use crate::cable::{At, Cable, SHORTEST_STEP, check_integrator};
use crate::effect::EffectWork;
use crate::error::{Error, PinProblem, require, require_finite};
use crate::integrate::{Integrator, IntegratorRef, Scratch, State, step_control};
use crate::support::{SlopeSupport, Support};
use nalgebra::Vector3;
use system::Work;
use workspace::Workspace;

/// A node of a cable held to a point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinConstraint {
    /// Index of the cable in the island.
    pub cable: usize,
    /// Node of the cable; it must be [attached](Cable::attach).
    pub node: usize,
    /// Index of the body in the island.
    pub body: usize,
    /// Point of the body in body axes, from the centre of mass, in m.
    pub anchor: Vector3<f64>,
    /// For a clamp, the direction of the tangent in body axes, a unit vector; the node must be
    /// [attached so](Cable::attach_clamped).
    pub direction: Option<Vector3<f64>>,
}

/// Buffers of an island, reused from step to step; nothing in them is state.
#[derive(Clone, Debug, Default)]
pub struct Island {
    workspace: Workspace,
    scratch: Scratch,
    phase: State,
}

impl Island {
    /// Advances `cables` and `bodies`, held together by `pins`, by `dt` (s) with `integrator`.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the step cannot be done, [`Error::OutOfRange`] or [`Error::InvalidShape`] for a pin that fits
    /// no cable, body or attached node. Cables and bodies are then exactly as before.
    pub fn step(
        &mut self,
        cables: &mut [&mut Cable],
        bodies: &mut [RigidBody],
        pins: &[PinConstraint],
        integrator: Integrator,
        dt: f64,
    ) -> Result<(), Error> {
        require("dt (s)", dt, dt == 0.0 || dt >= SHORTEST_STEP, "0, or >= 1e-100")?;
        let integrator = IntegratorRef::from(&integrator);
        integrator.check()?;
        check(cables, bodies, pins)?;
        cables.iter().try_for_each(|cable| check_integrator(&cable.model, integrator.method))?;
        if dt == 0.0 {
            return Ok(());
        }
        cables.iter_mut().for_each(|cable| cable.system.work = EffectWork::default());
        let Island { workspace, scratch, phase } = self;
        workspace.begin(cables, bodies, pins, dt);
        gather(cables, bodies, phase);
        memory::recall(cables, bodies, pins, phase, workspace);
        let mut system = Work { cables: &mut *cables, bodies: &*bodies, pins, workspace: &mut *workspace };
        if let Err(failure) = system.meet(phase) {
            return Err(cables[0].step_failed(phase.time, 0.0, failure));
        }
        let (counts, outcome) = step_control::advance(&mut system, integrator, phase, dt, scratch);
        for cable in cables.iter_mut() {
            let diagnostics = cable.diagnostics_mut();
            diagnostics.steps += counts.steps;
            diagnostics.rejected_steps += counts.rejected;
        }
        if let Err(refusal) = outcome {
            return Err(cables[0].step_failed(refusal.time, refusal.step, refusal.failure));
        }
        memory::keep(cables, bodies, pins, phase);
        scatter(cables, bodies, phase, workspace);
        Ok(())
    }

    /// What passed through each pin during the last step.
    pub fn accounts(&self) -> &[PinAccount] {
        &self.workspace.accounts
    }
}

impl Cable {
    /// Gives the position of a node to an island: it will follow the body that a [`PinConstraint`] names.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn attach(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        let node = self.node(at)?;
        let mut support = self.support(At::Node(node))?;
        support.position = None;
        support.attached = true;
        self.set_support(At::Node(node), support)?;
        Ok(node)
    }

    /// Frees a node that was attached: its position, and its tangent if that was clamped to the body.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn detach(&mut self, at: impl Into<At>) -> Result<(), Error> {
        let node = self.node(at)?;
        let mut support = self.support(At::Node(node))?;
        support.attached = false;
        support.position = None;
        if let SlopeSupport::Attached(_) = support.slope {
            support.slope = SlopeSupport::Free;
        }
        self.set_support(At::Node(node), support)
    }

    /// Gives the position of a node and the direction of its tangent to an island, for a [`PinConstraint`] with a direction.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::InvalidShape`] if the tangent has no length.
    pub fn attach_clamped(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        let node = self.node(at)?;
        let Some(tangent) = workspace::vector(&self.positions()[6 * node + 3..]).try_normalize(1e-9) else {
            return Err(Error::NoTangent { cable: self.name().to_string(), node });
        };
        let support = Support { position: None, slope: SlopeSupport::Attached(tangent), attached: true };
        self.set_support(At::Node(node), support)?;
        Ok(node)
    }
}

fn check(cables: &[&mut Cable], bodies: &[RigidBody], pins: &[PinConstraint]) -> Result<(), Error> {
    let Some(time) = cables.first().map(|cable| cable.time()) else { return Err(Error::EmptyIsland) };
    if let Some(other) = cables.iter().find(|c| c.time() != time) {
        let cable = other.name().to_string();
        return Err(Error::TimeMismatch { cable, time: other.time(), expected: time });
    }
    let problem = |cable: &Cable, node: usize, problem: PinProblem| {
        Err(Error::Pin { cable: cable.name().to_string(), node, problem })
    };
    for (i, pin) in pins.iter().enumerate() {
        for (what, index, count) in [("cables", pin.cable, cables.len()), ("bodies", pin.body, bodies.len())] {
            if index >= count {
                return Err(Error::NotInIsland { pin: i, what, index, count });
            }
        }
        let cable = &cables[pin.cable];
        require_finite("anchor of a pin (m)", &pin.anchor).map_err(|e| e.of_cable(cable.name()))?;
        if pin.node >= cable.nodes() {
            let (cable, limit) = (cable.name().to_string(), (cable.nodes() - 1) as f64);
            return Err(Error::OutOfRange { cable, what: "node", value: pin.node as f64, limit });
        }
        let Some(support) = cable.model.support(pin.node).filter(|s| s.attached) else {
            return problem(cable, pin.node, PinProblem::NotAttached);
        };
        if matches!(support.slope, SlopeSupport::Attached(_)) != pin.direction.is_some() {
            return problem(cable, pin.node, PinProblem::ClampMismatch);
        }
        if let Some(d) = &pin.direction {
            require("length of a clamp's direction", d.norm(), (d.norm() - 1.0).abs() < 1e-6, "1")?;
        }
        if pins[..i].iter().any(|p| p.cable == pin.cable && p.node == pin.node) {
            return problem(cable, pin.node, PinProblem::Duplicate);
        }
    }
    for (c, cable) in cables.iter().enumerate() {
        for (node, support) in &cable.model.supports {
            if support.attached && !pins.iter().any(|p| p.cable == c && p.node == *node) {
                return problem(cable, *node, PinProblem::Missing);
            }
        }
    }
    Ok(())
}

/// Coordinates of cables, then of bodies (position, rotation vector from the present attitude).
fn gather(cables: &[&mut Cable], bodies: &[RigidBody], phase: &mut State) {
    phase.q.clear();
    phase.v.clear();
    for cable in cables {
        phase.q.extend_from_slice(cable.positions());
        phase.v.extend_from_slice(cable.velocities());
    }
    for body in bodies {
        phase.q.extend(body.position.iter().chain(&[0.0; 3]));
        phase.v.extend(body.velocity.iter().chain(body.angular_velocity.iter()));
    }
    phase.time = cables[0].time();
    phase.memory.step = cables.iter().map(|c| c.state.phase.memory.step).fold(f64::INFINITY, f64::min);
}

fn scatter(cables: &mut [&mut Cable], bodies: &mut [RigidBody], phase: &State, workspace: &Workspace) {
    let mut at = 0;
    for cable in cables.iter_mut() {
        let n = cable.positions().len();
        let own = &mut cable.state.phase;
        let mut before = core::mem::take(&mut cable.system.rhs);
        core::mem::swap(&mut before, &mut own.q);
        own.q.copy_from_slice(&phase.q[at..at + n]);
        own.v.copy_from_slice(&phase.v[at..at + n]);
        own.time = phase.time;
        cable.settle(&before);
        cable.system.rhs = before;
        cable.diagnostics_mut().host_steps += 1;
        at += n;
    }
    for (i, body) in bodies.iter_mut().enumerate() {
        let at = at + 6 * i;
        let motion = workspace.motion(i, &phase.q[at..at + 6], &phase.v[at..at + 6]);
        body.position = motion.position;
        body.rotation = motion.rotation;
        body.velocity = motion.velocity;
        body.angular_velocity = motion.spin;
    }
}
