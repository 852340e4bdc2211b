//! The trait that every integration method implements, inside this crate or outside.

use super::dynamics::Dynamics;
use crate::error::{Error, StepFailure};
use crate::state::State;
use std::fmt;

/// What step control asks of one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepRequest {
    /// Length of the step in s.
    pub h: f64,
    /// Tolerance of Newton's iteration in m.
    pub newton_tolerance: f64,
    /// Whether the error estimate is needed.
    pub estimate: bool,
}

/// Vectors of a method, allocated once and reused for every step. Their contents are unspecified
/// when a step begins.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    /// The result: a method writes positions, velocities and `memory.acceleration` at the end of
    /// the step here, and `memory.algorithmic` if it [has
    /// it](OneStep::has_algorithmic_acceleration).
    pub next: State,
    /// Explicit part of the positions of a stage, for [`Dynamics::solve_stage`].
    pub base: Vec<f64>,
    /// Explicit part of the velocities of a stage.
    pub velocity_base: Vec<f64>,
    /// Estimated position error: a method whose step returns an estimate leaves the vector here.
    pub error: Vec<f64>,
    /// Sum of the estimated errors of the host step, for step control.
    pub(crate) error_sum: Vec<f64>,
    /// Velocities of the stages, at least [`OneStep::stages`] of them.
    pub stage_velocities: Vec<Vec<f64>>,
    /// Accelerations of the stages.
    pub stage_accelerations: Vec<Vec<f64>>,
}

impl Scratch {
    /// Makes room for `size` coordinates and `stages` stages.
    pub(crate) fn resize(&mut self, size: usize, stages: usize) {
        let next = &mut self.next;
        for v in [
            &mut next.q,
            &mut next.v,
            &mut next.memory.acceleration,
            &mut next.memory.algorithmic,
            &mut self.base,
            &mut self.velocity_base,
            &mut self.error,
            &mut self.error_sum,
        ] {
            v.resize(size, 0.0);
        }
        for stages_of in [&mut self.stage_velocities, &mut self.stage_accelerations] {
            if stages_of.len() < stages {
                stages_of.resize(stages, Vec::new());
            }
            stages_of.iter_mut().for_each(|v| v.resize(size, 0.0));
        }
    }
}

/// An integration method: one step of any length on any [`Dynamics`].
///
/// All that [step control](super::step_control) does, it does with every method: landing on the
/// host's time, rejecting and retrying failed steps, and error control where the method has an
/// estimate. A method of another crate steps a cable by
/// [`Cable::step_with`](crate::Cable::step_with), an island by
/// [`Island::step_with`](crate::island::Island::step_with).
///
/// ```
/// use lariat_ancf::integrate::{Dynamics, OneStep, Scratch, State, StepRequest};
/// use lariat_ancf::{At, Cable, Integrator, Section, StepControl, StepFailure, Vector3};
///
/// /// Symplectic Euler: v += h a, q += h v.
/// #[derive(Debug)]
/// struct SymplecticEuler;
///
/// impl OneStep for SymplecticEuler {
///     fn name(&self) -> String {
///         "symplectic-euler".to_string()
///     }
///     fn stability_limit(&self) -> Option<f64> {
///         Some(2.0)
///     }
///     fn step(
///         &self,
///         system: &mut dyn Dynamics,
///         now: &State,
///         request: StepRequest,
///         scratch: &mut Scratch,
///     ) -> Result<Option<f64>, StepFailure> {
///         let (next, h) = (&mut scratch.next, request.h);
///         for i in 0..system.size() {
///             next.v[i] = now.v[i] + h * now.memory.acceleration[i];
///             next.q[i] = now.q[i] + h * next.v[i];
///         }
///         system.prescribe(now.time + h, &mut next.q, &mut next.v);
///         system.acceleration(now.time + h, &next.q, &next.v, &mut next.memory.acceleration)?;
///         Ok(None)
///     }
/// }
///
/// let mut cable = Cable::builder()
///     .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
///     .section(Section::from_stiffness(100.0, 0.0, 0.1)?)
///     .fix(At::Start)
///     .build()?;
/// let integrator = Integrator { method: SymplecticEuler, control: StepControl::Stable(0.5) };
/// cable.step_with(1.0 / 60.0, &integrator)?;
/// assert!(cable.node_position(10).y < 0.0);
/// # Ok::<(), lariat_ancf::Error>(())
/// ```
pub trait OneStep: fmt::Debug {
    /// Returns the name of the method, for error messages.
    fn name(&self) -> String;

    /// Returns the number of stage vectors that the method needs in [`Scratch`]. Default 0.
    fn stages(&self) -> usize {
        0
    }

    /// Returns the exponent of h in the error estimate; `None`, the default, if the method has no
    /// estimate.
    fn estimate_order(&self) -> Option<u32> {
        None
    }

    /// Returns the product h omega below which an explicit method is stable for an oscillator of
    /// angular frequency omega; `None`, the default, for an implicit method.
    fn stability_limit(&self) -> Option<f64> {
        None
    }

    /// Returns whether the method carries an algorithmic acceleration from step to step in
    /// [`Memory::algorithmic`](super::Memory::algorithmic); it is the true one when a run begins.
    /// Default false.
    fn has_algorithmic_acceleration(&self) -> bool {
        false
    }

    /// Returns whether the method steps by discrete gradients of the energy instead of
    /// [`step`](Self::step). Default false; only
    /// [`DiscreteGradient`](super::discrete_gradient::DiscreteGradient) does.
    fn uses_discrete_gradients(&self) -> bool {
        false
    }

    /// Returns the dissipation a of such a method, 0 to 1/16: a motion of angular frequency omega
    /// is damped by the ratio a (h omega)^3/2 in steps of h. Default 1/16.
    fn dissipation(&self) -> f64 {
        crate::scales::integrate::ALPHA
    }

    /// Checks the parameters of the method. Default: nothing to check.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a parameter out of range.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }

    /// Advances `now` by one step into `scratch.next`, and returns the size of the estimated
    /// position error of the step in m, with the vector in `scratch.error`, if the method has an
    /// estimate and the request needs it. `now.memory.acceleration` is valid on entry, that of
    /// `scratch.next` on return; its time is set by the caller.
    ///
    /// # Errors
    /// The failures of the stages and accelerations of `system`.
    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        request: StepRequest,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure>;
}

/// Sets `sum` to `x + factor * y`.
pub(crate) fn set_sum(sum: &mut [f64], x: &[f64], factor: f64, y: &[f64]) {
    for ((sum, x), y) in sum.iter_mut().zip(x).zip(y) {
        *sum = x + factor * y;
    }
}

/// Adds `factor * y` to `x`.
pub(crate) fn add_scaled(x: &mut [f64], factor: f64, y: &[f64]) {
    for (x, y) in x.iter_mut().zip(y) {
        *x += factor * y;
    }
}
