//! The interface of a mechanical system to the integrators.

use crate::error::StepFailure;
use crate::state::State;

/// An implicit stage: find z with `M z = c2 F(base + z, velocity_base + dv_dq z, time)`, `z = y -
/// base`.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// Time of the stage in s.
    pub time: f64,
    /// Square of the implicit step in s^2: `z = c2 acceleration`.
    pub c2: f64,
    /// Derivative of the stage's velocity with respect to its position in 1/s.
    pub dv_dq: f64,
    /// Newton's iteration ends when the next increment is predicted to be below this size in m.
    pub newton_tolerance: f64,
    /// Whether the tangent of the stage before may be tried first.
    pub reuse: bool,
}

/// A mechanical system `M q'' = F(q, q', t)` with constant M, of which some coordinates may be
/// prescribed in time.
///
/// Coordinates, velocities and accelerations are flat slices of [`size`](Dynamics::size) numbers.
/// Every method leaves its outputs unspecified when it fails; no integrator uses them then.
pub trait Dynamics {
    /// Returns the number of coordinates.
    fn size(&self) -> usize;

    /// Overwrites prescribed coordinates and velocities by their values at `time`.
    fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]);

    /// Puts prescribed coordinates and velocities in place at the beginning of a host step. What
    /// that does to kinetic energy is work of the supports.
    fn place(&mut self, state: &mut State) {
        self.prescribe(state.time, &mut state.q, &mut state.v);
    }

    /// Computes the acceleration at a state, prescribed components included.
    ///
    /// # Errors
    /// If a force is not finite or the mass matrix is singular.
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), StepFailure>;

    /// Solves an implicit stage. On entry `base` and `velocity_base` hold the explicit part and
    /// `acceleration` a guess; on return `y` holds the position and `acceleration` the acceleration
    /// of the stage. Prescribed components of `base` and `velocity_base` are changed so that they
    /// come out as prescribed.
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

    /// Damps the stiff part of a position error: `e <- (M + c2 K)^-1 M e` with the matrix of the
    /// last stage.
    fn filter(&mut self, error: &mut [f64]);

    /// Returns the size of a position error in m.
    fn norm(&self, error: &[f64]) -> f64;

    /// Is called once for every accepted step of length `h` (s), with the states at both ends;
    /// accelerations are known in both. What the system remembers beside them goes into the memory
    /// of the last.
    fn step_accepted(&mut self, _before: &State, _after: &mut State, _h: f64) {}

    /// Is called with the state at the beginning of a host step and after every accepted step;
    /// accelerations are valid.
    fn state_reached(&mut self, _state: &State) {}

    /// Returns the spurious energy of a step of length `h` (s) in J, that is the change of energy
    /// minus the external work, and the kinetic and strain energy to compare it with; `None` where
    /// that work is not known.
    fn spurious_energy(&mut self, _before: &State, _after: &State, _h: f64) -> Option<(f64, f64)> {
        None
    }

    /// Takes `energy` (J) from the velocities of a state, or as much of it as changes no velocity
    /// by more than `largest` (m/s), and leaves the momenta that nothing holds. Returns what was
    /// taken. Default: nothing.
    fn take_energy(&mut self, _state: &mut State, _energy: f64, _largest: f64) -> f64 {
        0.0
    }

    /// Returns whether nothing but the known work changes the energy. Default true; false for an
    /// island, whose bodies an engine or a user moves besides. A method with an error estimate is
    /// then not checked for spurious energy.
    fn is_isolated(&self) -> bool {
        true
    }

    /// Returns the number of Newton iterations so far, to limit the work of a step. Default 0: they
    /// are not counted.
    fn newton_iterations(&self) -> u64 {
        0
    }

    /// Returns whether accelerations depend on velocities.
    fn depends_on_velocity(&self) -> bool {
        false
    }

    /// Returns whether the matrix that Newton's iteration factors is the exact derivative.
    fn has_exact_tangent(&self) -> bool {
        true
    }

    /// Returns an upper bound of the angular frequencies of the system in rad/s, near its present
    /// state.
    fn frequency_bound(&self) -> f64;
}
