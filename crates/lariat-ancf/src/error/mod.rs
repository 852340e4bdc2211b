//! The errors of this crate: [`Error`] for every public function, with [`StepFailure`] and
//! [`EquilibriumFailure`] for the reason why a time step or a static solution failed.
//!
//! No input makes the crate panic, and no error loses the last good state.

mod failure;
mod nearest;
mod range;

pub use failure::{EquilibriumFailure, PinProblem, Requirement, StepFailure};
pub(crate) use nearest::nearest;
pub(crate) use range::{require, require_finite};
use thiserror::Error as ThisError;

/// The error type of this crate.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// A number outside its range, infinite or NaN.
    #[error("{}{what} is {value}: must be finite and {expected}", prefix(.cable))]
    InvalidValue {
        /// Name of the cable, if the number belongs to one.
        cable: Option<String>,
        /// Name of the quantity with its unit.
        what: String,
        /// The value given.
        value: f64,
        /// The accepted range.
        expected: &'static str,
    },
    /// A list that does not have one entry per node, coordinate or the like.
    #[error("cable {cable:?}: got {count} {what}, needs {expected}")]
    WrongCount {
        /// Name of the cable.
        cable: String,
        /// What is counted.
        what: &'static str,
        /// The number given.
        count: usize,
        /// The number needed.
        expected: usize,
    },
    /// A start shape of fewer than two points.
    #[error("cable {cable:?}: needs at least 2 points, got {count}")]
    TooFewPoints {
        /// Name of the cable.
        cable: String,
        /// The number given.
        count: usize,
    },
    /// Two successive points of a start shape that coincide.
    #[error("cable {cable:?}: points {index} and {} coincide at {:?}", .index + 1, .point.as_slice())]
    CoincidentPoints {
        /// Name of the cable.
        cable: String,
        /// Number of the first of them, from 0.
        index: usize,
        /// Where they are, in m.
        point: nalgebra::Vector3<f64>,
    },
    /// No elements, or too many.
    #[error("cable {cable:?}: needs 1 to {most} elements, got {count}")]
    ElementCount {
        /// Name of the cable.
        cable: String,
        /// The number given.
        count: usize,
        /// The largest accepted number.
        most: usize,
    },
    /// A cable of one element that is to break: it has no inner node to break at.
    #[error("cable {cable:?}: has one element, and breaks at inner nodes: give it 2 elements or more")]
    OneElement {
        /// Name of the cable.
        cable: String,
    },
    /// An explicit method for a cable with a reel.
    #[error(
        "cable {cable:?}: the mass of a reeled cable changes in a step, which the explicit integrator {method} does not carry; use an implicit one"
    )]
    ExplicitReel {
        /// Name of the cable.
        cable: String,
        /// Name of the method.
        method: String,
    },
    /// A reel under a method that does not solve for its rate, or by which the account of its work
    /// does not close.
    #[error("cable {cable:?}: a reel under the integrator {method}: {reason}")]
    ReelMethod {
        /// Name of the cable.
        cable: String,
        /// Name of the method.
        method: String,
        /// The reason, and what to use.
        reason: &'static str,
    },
    /// A reel where none can be.
    #[error("cable {cable:?}: reel: {reason}")]
    ReelPlace {
        /// Name of the cable.
        cable: String,
        /// Why not.
        reason: &'static str,
    },
    /// A step of an island in which too much of the element at an eye would pass.
    #[error(
        "cable {cable:?}: its reel moves {share:.2} of the element at its eye in a step of an island, and at most {most} of it can pass: take shorter steps, or longer elements"
    )]
    FastReel {
        /// Name of the cable.
        cable: String,
        /// Share of the length of the element.
        share: f64,
        /// The largest that can pass.
        most: f64,
    },
    /// Something that a cable with a reel does not carry.
    #[error("cable {cable:?}: a reel does not go with {what}")]
    NotWithReel {
        /// Name of the cable.
        cable: String,
        /// What is refused.
        what: &'static str,
    },
    /// A cable without a section at its start.
    #[error("cable {cable:?}: needs a section from arc length 0 on")]
    NoSection {
        /// Name of the cable.
        cable: String,
    },
    /// A node named by its number while the cable is not built yet.
    #[error("cable {cable:?}: node {node} is not placed before the cable is built: give an arc length")]
    NodeBeforeMesh {
        /// Name of the cable.
        cable: String,
        /// Number of the node.
        node: usize,
    },
    /// Supports of a description that are not in ascending order of their nodes, or not on the
    /// cable.
    #[error("cable {cable:?}: the support of node {node} is out of order or off the cable, which has {nodes} nodes")]
    SupportOrder {
        /// Name of the cable.
        cable: String,
        /// Node of the first such support.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// An effect that needs what the cable does not have.
    #[error("cable {cable:?}: {effect} needs {requirement}")]
    MissingForEffect {
        /// Name of the cable.
        cable: String,
        /// The effect.
        effect: &'static str,
        /// What it needs.
        requirement: Requirement,
    },
    /// A cable that was read back without its forces per length or potentials of the user's own:
    /// functions are not serialised.
    #[error("cable {cable:?}: {count} force densities or potentials must be added again: functions are not serialised")]
    MissingForceDensities {
        /// Name of the cable.
        cable: String,
        /// The number that is missing.
        count: usize,
    },
    /// Two obstacles with the same key.
    #[error("cable {cable:?}: two obstacles have the key {key}")]
    ObstacleKey {
        /// Name of the cable.
        cable: String,
        /// The key.
        key: u64,
    },
    /// An obstacle on a body that the island does not have, or outside an island.
    #[error(
        "cable {cable:?}: its obstacle {key} is carried by body {body}, but {bodies} bodies step with the cable; use `Island::step`"
    )]
    ObstacleBody {
        /// Name of the cable.
        cable: String,
        /// Key of the obstacle.
        key: u64,
        /// Index of its body.
        body: usize,
        /// Number of bodies in the island.
        bodies: usize,
    },
    /// Contact with a method that does not carry it.
    #[error("cable {cable:?}: {method} cannot step contact: use discrete-gradient")]
    ContactMethod {
        /// Name of the cable.
        cable: String,
        /// Name of the method.
        method: String,
    },
    /// Torsion where it is not carried.
    #[error("cable {cable:?}: torsion is not carried {by}")]
    TorsionPlace {
        /// Name of the cable.
        cable: String,
        /// By what it is not carried.
        by: String,
    },
    /// A piece of a rest shape that covers no element.
    #[error("cable {cable:?}: no element has its middle in the piece of the rest shape that begins at {from} m")]
    EmptyRestPiece {
        /// Name of the cable.
        cable: String,
        /// Arc length in m at which the piece begins.
        from: f64,
    },
    /// A name that is no rule.
    #[error("unknown rule {rule:?}: {}expected {expected}", did_you_mean(.suggestion))]
    UnknownRule {
        /// The text given.
        rule: String,
        /// What is accepted.
        expected: &'static str,
        /// The nearest name, if one is near.
        suggestion: Option<String>,
    },
    /// A name that is no integration method.
    #[error("unknown integrator {name:?}: {}expected one of {expected}", did_you_mean(.suggestion))]
    UnknownIntegrator {
        /// The text given.
        name: String,
        /// What is accepted.
        expected: String,
        /// The nearest name, if one is near.
        suggestion: Option<String>,
    },
    /// A name that is no kind of rope.
    #[error("unknown kind of rope {name:?}: {}expected one of {expected}", did_you_mean(.suggestion))]
    UnknownRopeKind {
        /// The text given.
        name: String,
        /// What is accepted.
        expected: String,
        /// The nearest name, if one is near.
        suggestion: Option<String>,
    },
    /// A name that is no fidelity.
    #[error("unknown fidelity {name:?}: {}expected game, engineering or reference", did_you_mean(.suggestion))]
    UnknownFidelity {
        /// The text given.
        name: String,
        /// The nearest name, if one is near.
        suggestion: Option<String>,
    },
    /// A name that is no error norm.
    #[error("unknown norm {name:?}: {}expected every, motion or bodies", did_you_mean(.suggestion))]
    UnknownNorm {
        /// The text given.
        name: String,
        /// The nearest name, if one is near.
        suggestion: Option<String>,
    },
    /// A tolerance for a method that does not estimate its error.
    #[error("integrator {method}: it does not estimate its error; give substeps, max_step, or another method")]
    NoErrorEstimate {
        /// Name of the method.
        method: String,
    },
    /// A norm that the estimate of a method does not have.
    #[error(
        "integrator {method}: its tolerance bounds the errors of free bodies, without any those of the motion, \
         which is the norm \"bodies\", not {norm:?}"
    )]
    NoErrorNorm {
        /// Name of the method.
        method: String,
        /// Name of the norm.
        norm: &'static str,
    },
    /// A share of the stability limit for an implicit method, which has none.
    #[error("integrator {method}: only explicit methods have a stability limit; give a tolerance or substeps")]
    NoStabilityLimit {
        /// Name of the method.
        method: String,
    },
    /// Internal damping with an explicit method.
    #[error(
        "cable {cable:?}: internal damping lowers the stability limit of the explicit integrator {method} far below \
         practical steps; use an implicit one"
    )]
    ExplicitDamping {
        /// Name of the cable.
        cable: String,
        /// Name of the method.
        method: String,
    },
    /// A pair of rules with deformation modes that have no energy.
    #[error("rule {rule} is rank deficient: {reason}")]
    RankDeficient {
        /// The rule.
        rule: String,
        /// Which modes, and what to use instead.
        reason: &'static str,
    },
    /// A node or an arc length that is not on the cable, or another number beyond its limit.
    #[error("cable {cable:?}: {what} {value} is outside [0, {limit}]")]
    OutOfRange {
        /// Name of the cable.
        cable: String,
        /// The quantity: node number or arc length in m.
        what: &'static str,
        /// The value given.
        value: f64,
        /// The largest accepted value.
        limit: f64,
    },
    /// An arc length at which there is no node.
    #[error(
        "cable {cable:?}: no node at arc length {arc_length} m, the nearest is at {nearest} m: \
         ask for one with `CableBuilder::node_at`"
    )]
    NoNode {
        /// Name of the cable.
        cable: String,
        /// Arc length given, in m.
        arc_length: f64,
        /// Arc length of the nearest node in m.
        nearest: f64,
    },
    /// A step or statics of a cable alone of which a node is
    /// [attached](crate::coupling::Coupling::attach) to a body.
    #[error("cable {cable:?}: node {node} is attached to a body: only an island can move it")]
    Attached {
        /// Name of the cable.
        cable: String,
        /// The attached node.
        node: usize,
    },
    /// A clamp at a node whose slope has length zero.
    #[error("cable {cable:?}: node {node} has no tangent to clamp")]
    NoTangent {
        /// Name of the cable.
        cable: String,
        /// The node.
        node: usize,
    },
    /// A pin that does not fit its node, or an attached node without a pin.
    #[error("cable {cable:?}: node {node} {problem}")]
    Pin {
        /// Name of the cable.
        cable: String,
        /// The node.
        node: usize,
        /// What is wrong.
        problem: PinProblem,
    },
    /// A pin that names a cable or a body that its island does not have.
    #[error("pin {pin}: the island has {count} {what}, there is none with index {index}")]
    NotInIsland {
        /// Index of the pin.
        pin: usize,
        /// What it names: "cables" or "bodies".
        what: &'static str,
        /// The index given.
        index: usize,
        /// How many the island has.
        count: usize,
    },
    /// An island without cables.
    #[error("an island needs at least 1 cable, got 0")]
    EmptyIsland,
    /// Cables of one island that are at different times.
    #[error("cable {cable:?}: is at t = {time} s, another cable of its island is at {expected} s")]
    TimeMismatch {
        /// Name of the cable.
        cable: String,
        /// Its time in s.
        time: f64,
        /// Time of the first cable of the island in s.
        expected: f64,
    },
    /// A time step that failed. The cable is as it was at `time`.
    #[error("cable {cable:?}: step failed at t = {at} s (step {step:.3e} s), state kept at t = {time} s: {failure}")]
    StepFailed {
        /// Name of the cable.
        cable: String,
        /// Time in s of the state that the cable has now: that before the host step.
        time: f64,
        /// Time in s within the host step at which it failed.
        at: f64,
        /// The last step tried in s.
        step: f64,
        /// The reason.
        failure: StepFailure,
    },
    /// No static equilibrium was found. The cable is as it was.
    #[error(
        "cable {cable:?}: no equilibrium at t = {time} s: {failure}; residual force {residual:.3e} N after \
         {iterations} iterations"
    )]
    NoEquilibrium {
        /// Name of the cable.
        cable: String,
        /// Time of the cable in s.
        time: f64,
        /// The reason.
        failure: EquilibriumFailure,
        /// Largest residual force in N.
        residual: f64,
        /// Iterations done.
        iterations: usize,
    },
}

impl Error {
    /// Adds the name of the cable to an error about a number that does not carry it yet.
    pub(crate) fn of_cable(mut self, name: &str) -> Self {
        if let Error::InvalidValue { cable: cable @ None, .. } = &mut self {
            *cable = Some(name.to_string());
        }
        self
    }
}

/// The beginning of a message about a cable.
fn prefix(cable: &Option<String>) -> String {
    cable.as_ref().map_or(String::new(), |name| format!("cable {name:?}: "))
}

/// The question with which a message proposes the nearest name.
fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map_or(String::new(), |name| format!("did you mean {name:?}? "))
}
