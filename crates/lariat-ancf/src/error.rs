//! Everything that can go wrong, as one enum. Nothing here panics on user input, and no error loses the last good state.

use thiserror::Error as ThisError;

/// Why a time step could not be done, at the smallest step that was tried.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum StepFailure {
    /// Newton's iteration did not converge.
    #[error("Newton did not converge in {iterations} iterations, last increment {increment:.3e} m")]
    NotConverged {
        /// Iterations done.
        iterations: usize,
        /// Size of the last increment in m.
        increment: f64,
    },
    /// A force, a tangent or a position became infinite or not a number.
    #[error("{what} is not finite at node {node}")]
    NotFinite {
        /// The quantity.
        what: &'static str,
        /// The first node where it was seen.
        node: usize,
    },
    /// The estimated error stayed above the tolerance.
    #[error("estimated error {estimate:.3e} m above the allowed {allowed:.3e} m")]
    ErrorTooLarge {
        /// Estimated position error of the step in m.
        estimate: f64,
        /// Allowed error of the step in m.
        allowed: f64,
    },
    /// An explicit step beyond the stability limit of the cable.
    #[error(
        "explicit step {step:.3e} s is beyond the stability limit {limit:.3e} s: use more substeps, or an implicit method"
    )]
    Unstable {
        /// Step asked for in s.
        step: f64,
        /// Longest stable step in s.
        limit: f64,
    },
    /// Fixed steps so short that a host step would take more than a million of them.
    #[error("step {step:.3e} s is shorter than a millionth of the host's step, {least:.3e} s")]
    TooShort {
        /// Step asked for in s.
        step: f64,
        /// Shortest step in s.
        least: f64,
    },
    /// The matrix of the step is singular.
    #[error("singular step matrix: {0}")]
    Singular(#[from] crate::linalg::SingularMatrix),
}

/// The error type of this crate.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// A number outside its range, infinite or NaN.
    #[error("{what} is {value}: must be finite and {expected}")]
    InvalidValue {
        /// Name of the quantity with its unit.
        what: String,
        /// The value given.
        value: f64,
        /// The accepted range.
        expected: &'static str,
    },
    /// Points that do not make a cable.
    #[error("cable {cable:?}: {reason}")]
    InvalidShape {
        /// Name of the cable.
        cable: String,
        /// What is wrong, with the value.
        reason: String,
    },
    /// A rule name that is not understood.
    #[error("unknown rule {rule:?}: expected {expected}")]
    UnknownRule {
        /// The text given.
        rule: String,
        /// What is accepted.
        expected: &'static str,
    },
    /// An integrator name that is not understood.
    #[error("unknown integrator {name:?}: expected one of {expected}")]
    UnknownIntegrator {
        /// The text given.
        name: String,
        /// What is accepted.
        expected: String,
    },
    /// An integrator asked for something it cannot do.
    #[error("integrator {method}: {reason}")]
    UnsupportedControl {
        /// Name of the method.
        method: String,
        /// What it cannot do, and what to ask instead.
        reason: &'static str,
    },
    /// A pair of rules that leaves modes of deformation without energy.
    #[error("rule {rule} is rank deficient: {reason}")]
    RankDeficient {
        /// The rule.
        rule: String,
        /// Which modes, and what to use instead.
        reason: &'static str,
    },
    /// A node or an arc length that is not on the cable.
    #[error("cable {cable:?}: {what} {value} is outside [0, {limit}]")]
    OutOfRange {
        /// Name of the cable.
        cable: String,
        /// Node number or arc length in m.
        what: &'static str,
        /// The value given.
        value: f64,
        /// The largest accepted value.
        limit: f64,
    },
    /// A step that could not be done. The cable is as it was at `time`.
    #[error("cable {cable:?}: step refused at t = {at} s (step {step:.3e} s), state kept at t = {time} s: {failure}")]
    StepRefused {
        /// Name of the cable.
        cable: String,
        /// Time in s of the state that the cable has now: that before the host step.
        time: f64,
        /// Time in s inside the host step at which it could not go on.
        at: f64,
        /// The last step tried in s.
        step: f64,
        /// Why.
        failure: StepFailure,
    },
    /// No static equilibrium was found. The cable is as it was.
    #[error("cable {cable:?}: no equilibrium: {reason}; residual force {residual:.3e} N after {iterations} iterations")]
    NoEquilibrium {
        /// Name of the cable.
        cable: String,
        /// Why.
        reason: String,
        /// Largest residual force in N.
        residual: f64,
        /// Newton iterations done.
        iterations: usize,
    },
}

/// A range check: `Err` unless `value` is finite and `ok`.
pub(crate) fn require(what: &str, value: f64, ok: bool, expected: &'static str) -> Result<(), Error> {
    if value.is_finite() && ok { Ok(()) } else { Err(Error::InvalidValue { what: what.to_string(), value, expected }) }
}

/// [`require`] for every component of a vector.
pub(crate) fn require_finite(what: &str, value: &nalgebra::Vector3<f64>) -> Result<(), Error> {
    value.iter().try_for_each(|&x| require(what, x, true, "a number"))
}
