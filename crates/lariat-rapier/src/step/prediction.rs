//! Parameters of a Rapier step, and the buffers of an island from its prediction to its
//! reconciliation.

use crate::body::SavedBody;
use crate::error::Error;
use crate::mechanism::{Group, Mechanism};
use crate::step::budget::Remaining;
use crate::step::refused::HeldBodies;
use crate::step::sleep::SleepState;
use ::nalgebra::Vector3;
use lariat_ancf::island::{CoupledInertia, Impedance, PinAccount, RigidBody};
use lariat_ancf::warning::balance::CableTerms;
use lariat_ancf::{Integrator, Snapshot};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{AngVector, Vector};

/// Parameters of a Rapier step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepParameters {
    /// Time step in s.
    pub h: f64,
    /// Length of the host step in s.
    pub host: f64,
    /// Number of equal pieces of the host step, each of which is one Rapier step, or more.
    pub rapier_steps: u32,
    /// Share of the host step at which it begins and ends, 0 to 1.
    pub share: (f64, f64),
    /// Speed in m/s of the fastest body that is awake.
    pub fastest: f64,
    /// Speed in m/s below which bodies may sleep.
    pub sleep_speed: f64,
}

/// The prediction of an island for one Rapier step. Buffers only: nothing in them is state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Prediction {
    /// By cable, its state before the step.
    pub snapshots: Vec<Snapshot>,
    /// By member, its state before the step.
    pub start: Vec<RigidBody>,
    /// By member, its predicted state after the step.
    pub end: Vec<RigidBody>,
    /// By member, the bodies that joints move together with it.
    pub mechanisms: Vec<Option<Mechanism>>,
    /// The members that are bodies of one mechanism, for each mechanism.
    pub groups: Vec<Group>,
    /// What couples them.
    pub coupled: Vec<CoupledInertia>,
    /// By member, the motion given to Rapier.
    pub applied: Vec<Option<AppliedMotion>>,
    /// By cable, its response to impulses at pins on and next to deviating members.
    pub impedances: Vec<Impedance>,
    /// The integrator of an island that is ready to be integrated, or was.
    pub integrator: Option<Integrator>,
    /// Number of equal parts in which it is integrated.
    pub parts: u32,
    /// What is left of the budget, and whether accuracy was reduced because nothing was.
    pub budget: Remaining,
    pub degraded: bool,
    /// Why the island cannot step.
    pub error: Option<Error>,
    /// By sheave, its predicted state after the step.
    pub wheels: Vec<lariat_ancf::island::Sheave>,
    /// By pin, what it transmitted in the predicted step.
    pub accounts: Vec<PinAccount>,
    /// Indices of the members that may deviate from the prediction.
    pub deviating: Vec<usize>,
    /// Indices of their pins, and of the [next ones](crate::step::next_pins).
    pub near: Vec<usize>,
    /// Nodes of a cable, and those that driven bodies hold: buffers.
    pub nodes: Vec<usize>,
    pub driven: Vec<usize>,
    /// By pin, whether its motors are on.
    pub motors: Vec<bool>,
    /// By pin, the impulse of its motors in N s, and of what they did at other pins.
    pub impulses: Vec<Vector3<f64>>,
    /// By pin, what the motors at other pins did there, in N s: a buffer.
    pub passed: Vec<Vector3<f64>>,
    /// By node of an impedance, the impulse on it in N s: a buffer.
    pub impulses_at: Vec<Vector3<f64>>,
    /// What its energy balance compares with.
    pub energy: StepEnergy,
    pub sleep: SleepState,
    /// Whether the island could not step, and the bodies that are held meanwhile.
    pub refused: bool,
    pub held: HeldBodies,
}

/// The motion that Rapier was given for a body, and what to restore afterwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AppliedMotion {
    pub linvel: Vector,
    pub angvel: AngVector,
    /// Whether it touches nothing and no joint holds it.
    pub isolated: bool,
    /// Velocity in m/s that balanced forces add and remove within Rapier's step.
    pub balanced_velocity: f64,
    /// Whether Rapier's step took it where it was predicted.
    pub landed: bool,
    pub saved: SavedBody,
}

/// A body in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyStep<'a> {
    pub handle: RigidBodyHandle,
    /// Its state before the step.
    pub start: &'a RigidBody,
    /// Its predicted state after the step.
    pub end: &'a RigidBody,
    pub mechanism: Option<&'a Mechanism>,
    /// Time step in s.
    pub h: f64,
}

impl Prediction {
    /// Returns member `m`, the body `handle`, in a step of `h` (s).
    pub fn body_step(&self, m: usize, handle: RigidBodyHandle, h: f64) -> BodyStep<'_> {
        BodyStep { handle, start: &self.start[m], end: &self.end[m], mechanism: self.mechanisms[m].as_ref(), h }
    }
}

/// What the energy balance of an island has when a step begins.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepEnergy {
    /// Terms of all cables; `None` if the island is not judged.
    pub start: Option<CableTerms>,
    /// By pin, its gap in m.
    pub gaps: Vec<Vector3<f64>>,
    pub buffer: Vec<f64>,
}
