//! A method with its step control.

use super::error_norm::ErrorNorm;
use super::method::Method;
use super::one_step::OneStep;
use super::work_limit::WorkLimit;
use crate::error::{Error, require};
use crate::scales::integrate::{ADAPTIVE_TOLERANCE, LITTLE_DISSIPATION};
use serde::{Deserialize, Serialize};

/// How the length of the integration steps within a host step is chosen. The last one always ends
/// exactly with the host step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StepControl {
    /// Position error in m per host step; steps are chosen, rejected and retried to keep it.
    Tolerance(f64),
    /// The same, of the errors that a norm selects.
    ToleranceOf(f64, ErrorNorm),
    /// This many equal steps per host step.
    Substeps(u32),
    /// The fewest equal steps no longer than this, in s. A host step that exceeds a multiple of it
    /// by no more than the rounding of single precision takes no additional step.
    MaxStep(f64),
    /// Discrete gradient: 1, 2, 4 or 8 equal steps in 1/60 s, by an estimate of the position error.
    /// 1 and 2 are taken where they keep this error in m per 1/60 s, in proportion for cables
    /// shorter than 1 m; 8 where 4 err by 3e-3 m and 8 halve that. What has contact, twists, runs
    /// off a reel or was changed by the host takes at least 4. Nothing is rejected for its error in
    /// steps of 1/240 s or less, so the error of violent motion has no bound.
    Adaptive(f64),
    /// Explicit methods: the fewest equal steps within this share (0 to 1) of the stability limit.
    Stable(f64),
}

/// A method and its step control. The method is one of the library by its name, or an
/// implementation of [`OneStep`] of your own, with which
/// [`Cable::step_with`](crate::Cable::step_with) steps.
///
/// ```
/// use lariat_ancf::{Integrator, Method, StepControl};
/// let fine = Integrator::tolerance(Method::Esdirk4, 1e-8)?;
/// assert_eq!(fine.method, Integrator::default().method);
/// assert!(Integrator::tolerance(Method::Verlet, 1e-6).is_err()); // no error estimate
/// # Ok::<(), lariat_ancf::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Integrator<M = Method> {
    /// The method.
    pub method: M,
    /// How steps are chosen.
    pub control: StepControl,
}

impl Default for Integrator {
    /// Error-controlled ESDIRK4, 1e-6 m per host step of the [motion](ErrorNorm::Motion).
    fn default() -> Self {
        Integrator { method: Method::Esdirk4, control: StepControl::ToleranceOf(1e-6, ErrorNorm::Motion) }
    }
}

impl Integrator {
    /// The discrete gradient of games in [`Adaptive`](StepControl::Adaptive) steps, 1e-4 m in 1/60
    /// s, with the dissipation 1/16; 1/256 in steps longer than 1/240 s. Calm ropes take one or two
    /// of these where [`Fidelity::Game`](super::Fidelity::Game) takes four.
    pub const ADAPTIVE: Integrator =
        Integrator { method: Method::DiscreteGradient, control: StepControl::Adaptive(ADAPTIVE_TOLERANCE) };

    /// What [`Fidelity::Engineering`](super::Fidelity::Engineering) is where contact, torsion,
    /// clutches, sheaves or drums need the discrete gradient: 1e-5 m per host step of the free
    /// bodies, or of the motion of a cable without any, with the dissipation 1/256.
    pub const COUPLED: Integrator = Integrator {
        method: Method::DiscreteGradientWith { dissipation: LITTLE_DISSIPATION },
        control: StepControl::ToleranceOf(1e-5, ErrorNorm::Bodies),
    };

    /// Returns a method with a tolerance in m of position error per host step.
    ///
    /// # Errors
    /// [`Error::NoErrorEstimate`] if the method has no error estimate, [`Error::InvalidValue`] for
    /// a bad tolerance.
    pub fn tolerance(method: Method, tolerance: f64) -> Result<Self, Error> {
        Integrator { method, control: StepControl::Tolerance(tolerance) }.checked()
    }

    /// Returns a method with a fixed number of equal steps per host step.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for zero steps.
    pub fn substeps(method: Method, substeps: u32) -> Result<Self, Error> {
        Integrator { method, control: StepControl::Substeps(substeps) }.checked()
    }
}

impl<M: OneStep> Integrator<M> {
    /// Returns the same, if the method supports the step control.
    ///
    /// # Errors
    /// [`Error::NoErrorEstimate`], [`Error::NoStabilityLimit`] or [`Error::InvalidValue`].
    pub fn checked(self) -> Result<Self, Error> {
        IntegratorRef::from(&self).check().map(|()| self)
    }
}

/// An [`Integrator`] of any method, borrowed, with a limit to its work: what an
/// [`island`](crate::island::Island::step_with) takes. `&Integrator` converts to it.
#[derive(Clone, Copy, Debug)]
pub struct IntegratorRef<'a> {
    /// The method.
    pub method: &'a dyn OneStep,
    /// How steps are chosen.
    pub control: StepControl,
    /// The largest amount of work, if there is a limit.
    pub limit: Option<&'a WorkLimit>,
}

impl<'a, M: OneStep> From<&'a Integrator<M>> for IntegratorRef<'a> {
    fn from(integrator: &'a Integrator<M>) -> Self {
        IntegratorRef { method: &integrator.method, control: integrator.control, limit: None }
    }
}

impl<'a> IntegratorRef<'a> {
    /// Returns the same with this limit to its work.
    pub fn within(self, limit: Option<&'a WorkLimit>) -> Self {
        IntegratorRef { limit, ..self }
    }
}

impl IntegratorRef<'_> {
    /// Checks that the method supports the step control.
    ///
    /// # Errors
    /// [`Error::NoErrorEstimate`], [`Error::NoErrorNorm`], [`Error::NoStabilityLimit`] or
    /// [`Error::InvalidValue`].
    pub fn check(&self) -> Result<(), Error> {
        self.method.check()?;
        match self.control {
            StepControl::Tolerance(tolerance) | StepControl::ToleranceOf(tolerance, _) => {
                require("tolerance (m)", tolerance, tolerance > 0.0, "> 0")?;
                if self.method.estimate_order().is_none() {
                    return Err(Error::NoErrorEstimate { method: self.method.name() });
                }
                if let StepControl::ToleranceOf(_, norm @ (ErrorNorm::Every | ErrorNorm::Motion)) = self.control
                    && self.method.uses_discrete_gradients()
                {
                    return Err(Error::NoErrorNorm { method: self.method.name(), norm: norm.name() });
                }
            }
            StepControl::Substeps(substeps) => {
                require("substeps", f64::from(substeps), substeps > 0, "> 0")?;
            }
            StepControl::Adaptive(tolerance) => {
                require("adaptive (m)", tolerance, tolerance > 0.0, "> 0")?;
                if !self.method.uses_discrete_gradients() {
                    return Err(Error::NoErrorEstimate { method: self.method.name() });
                }
            }
            StepControl::MaxStep(step) => require("max_step (s)", step, step > 0.0, "> 0")?,
            StepControl::Stable(share) => {
                require("share of the stability limit", share, share > 0.0 && share <= 1.0, "in (0, 1]")?;
                if self.method.stability_limit().is_none() {
                    return Err(Error::NoStabilityLimit { method: self.method.name() });
                }
            }
        }
        Ok(())
    }

    /// Returns which errors the tolerance bounds.
    pub(crate) fn norm(&self) -> ErrorNorm {
        match self.control {
            StepControl::ToleranceOf(_, norm) => norm,
            _ => ErrorNorm::Every,
        }
    }

    /// Returns the tolerance in m per host step, if the error is controlled.
    pub(crate) fn tolerance(&self) -> Option<f64> {
        match self.control {
            StepControl::Tolerance(tolerance) | StepControl::ToleranceOf(tolerance, _) => Some(tolerance),
            _ => None,
        }
    }
}
