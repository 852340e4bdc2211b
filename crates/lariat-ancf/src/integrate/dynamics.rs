//! What an integrator needs to know of a mechanical system, and nothing else.

use super::State;
use crate::error::StepFailure;

/// How Newton's iteration of an implicit stage ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Newton {
    /// Until the next increment is predicted below this size in m.
    Converge(f64),
    /// One iteration (a linearly implicit step); a second solve with the same factors checks it, and where it does not
    /// contract the iteration goes on to this size in m.
    Once(f64),
}

impl Newton {
    /// The size in m to converge to.
    pub fn tolerance(self) -> f64 {
        match self {
            Newton::Converge(tolerance) | Newton::Once(tolerance) => tolerance,
        }
    }

    /// Whether one checked iteration is enough.
    pub fn once(self) -> bool {
        matches!(self, Newton::Once(_))
    }
}

/// An implicit stage: find z with `M z = c2 F(base + z, velocity_base + rate z, time)`, `z = y - base`.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// Time of the stage in s.
    pub time: f64,
    /// Square of the implicit step in s^2: `z = c2 acceleration`.
    pub c2: f64,
    /// `d velocity / d position` in 1/s.
    pub rate: f64,
    /// When to stop.
    pub newton: Newton,
    /// Whether the tangent of the stage before may be tried first.
    pub reuse: bool,
}

/// A mechanical system `M q'' = F(q, q', t)` with constant M, of which some coordinates may be prescribed in time.
///
/// Coordinates, velocities and accelerations are flat slices of [`size`](Dynamics::size) numbers. Every method leaves its
/// outputs unspecified when it fails; no integrator uses them then.
pub trait Dynamics {
    /// Number of coordinates.
    fn size(&self) -> usize;

    /// Overwrites prescribed coordinates and velocities by their values at `time`.
    fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]);

    /// The acceleration at a state, prescribed components included.
    ///
    /// # Errors
    /// If a force is not finite or the mass matrix is singular.
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), StepFailure>;

    /// Solves an implicit stage. On entry `base` and `velocity_base` hold the explicit part and `acceleration` a guess;
    /// on return `y` holds the position and `acceleration` the acceleration of the stage. Prescribed components of `base`
    /// and `velocity_base` are changed so that they come out as prescribed.
    ///
    /// # Errors
    /// If the iteration does not converge, a quantity is not finite, or the matrix is singular.
    fn solve_stage(
        &mut self,
        stage: &Stage,
        base: &mut [f64],
        velocity_base: &mut [f64],
        y: &mut [f64],
        acceleration: &mut [f64],
    ) -> Result<(), StepFailure>;

    /// Damps the stiff part of a position error: `e <- (M + c2 K)^-1 M e` with the matrix of the last stage.
    fn filter(&mut self, error: &mut [f64]);

    /// Size of a position error in m.
    fn norm(&self, error: &[f64]) -> f64;

    /// Called once for every step of length `h` (s) that was accepted, with the phases at both ends; accelerations are known in both.
    fn accepted(&mut self, _before: &State, _after: &State, _h: f64) {}
    /// Told the phase at the beginning of a host step and after every step that is accepted; accelerations are valid then.
    fn reached(&mut self, _phase: &State) {}

    /// Energy in J that a step of length `h` (s) made beyond the work of what acts from outside, and the kinetic and strain energy to measure it
    /// by; none where that work is not known.
    fn energy_made(&mut self, _before: &State, _after: &State, _h: f64) -> Option<(f64, f64)> {
        None
    }

    /// Newton iterations so far.
    fn iterations(&self) -> u64 {
        0
    }

    /// Whether accelerations depend on velocities.
    fn follows_velocity(&self) -> bool {
        false
    }

    /// Whether the matrix that Newton factors is the exact derivative.
    fn exact_tangent(&self) -> bool {
        true
    }

    /// An upper bound of the angular frequencies of the system in rad/s, near its present state.
    fn frequency_bound(&self) -> f64;
}
