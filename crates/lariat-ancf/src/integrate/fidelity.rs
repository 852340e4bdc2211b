//! A method with its step control, and the three choices that most users need: [`Fidelity`].
//!
//! The figures at each choice are those of `docs/accuracy/fidelity.csv`, which `lariat report` measures; a test of `lariat-bench` holds
//! them to that file.

use super::method::{Method, NewtonMode, Stepper};
use crate::error::{Error, require};
use crate::rule::Rule;
use serde::{Deserialize, Serialize};

/// How the length of the integration steps inside a host step is chosen. Each lands exactly on the host's step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StepControl {
    /// Position error in m per host step; steps are chosen, rejected and retried to keep it.
    Tolerance(f64),
    /// This many equal steps per host step.
    Substeps(u32),
    /// The fewest equal steps no longer than this, in s (by more than single precision: a host's own step may be so).
    MaxStep(f64),
    /// Explicit methods: the fewest equal steps within this share (0 to 1) of the stability limit.
    Stable(f64),
}

/// A method and its step control.
///
/// ```
/// use lariat_ancf::{Integrator, Method, StepControl};
/// assert_eq!(Integrator::default(), Integrator::tolerance(Method::Esdirk4, 1e-6)?);
/// assert!(Integrator::tolerance(Method::Verlet, 1e-6).is_err()); // no error estimate
/// # Ok::<(), lariat_ancf::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Integrator {
    /// The method.
    pub method: Method,
    /// How steps are chosen.
    pub control: StepControl,
}

impl Default for Integrator {
    /// That of [`Fidelity::Engineering`]: error-controlled ESDIRK4, 1e-6 m per host step.
    fn default() -> Self {
        Integrator { method: Method::Esdirk4, control: StepControl::Tolerance(1e-6) }
    }
}

/// Three choices of accuracy against time.
///
/// Each measured on three scenes, with its own integrator, the default rule, and so many elements (`docs/accuracy`, CPU time of one
/// thread): *pendulum*, the paper's, 2 s, against the real beam; *payload*, a crate of 50 kg in Rapier on a cable, 1 s, against an
/// independent code; *taut steel*, a plucked cable of 10 mm, 0.1 s, against its analytic modes (amplitude 1e-4 m). The payload's
/// cable rings undamped, and a tolerance follows that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fidelity {
    /// One-iteration generalised-alpha 0.5 at h <= 1/240 s, with full Newton where a step does not contract.
    ///
    /// | scene | elements | error m | CPU ms |
    /// |---|---:|---:|---:|
    /// | pendulum | 10 | 4.7e-3 | 2.18 |
    /// | payload | 10 | 7.2e-3 | 4.27 |
    /// | taut steel | 10 | 2.0e-4 | 0.11 |
    Game,
    /// Error-controlled ESDIRK4, 1e-6 m per host step: the default.
    ///
    /// | scene | elements | error m | CPU ms |
    /// |---|---:|---:|---:|
    /// | pendulum | 20 | 3.7e-4 | 10.6 |
    /// | payload | 10 | 8.7e-4 | 137 |
    /// | taut steel | 20 | 5.6e-5 | 0.91 |
    Engineering,
    /// Symplectic explicit of order 4 at half its stable step where the cable is soft enough (omega_max below 5e4 rad/s), else ESDIRK4 at
    /// 1e-9 m per host step.
    ///
    /// | scene | elements | error m | CPU ms |
    /// |---|---:|---:|---:|
    /// | pendulum | 80 | 4.0e-6 | 1210 |
    /// | payload | 10 | 1.3e-4 | 256 |
    /// | taut steel | 80 | 2.0e-8 | 201 |
    Reference,
}

/// Above this frequency in rad/s the reference fidelity is implicit: of the scenes of `docs/accuracy`, the payload (3.4e4 rad/s) is cheaper
/// explicit, the pendulum with 80 elements (8.7e4 rad/s) implicit.
const EXPLICIT_FREQUENCY: f64 = 5e4;

impl Fidelity {
    /// All, from the cheapest.
    pub const ALL: [Fidelity; 3] = [Fidelity::Game, Fidelity::Engineering, Fidelity::Reference];

    /// Name: `game`, `engineering` or `reference`.
    pub fn name(self) -> &'static str {
        match self {
            Fidelity::Game => "game",
            Fidelity::Engineering => "engineering",
            Fidelity::Reference => "reference",
        }
    }

    /// The force strategy: the default one for all three. It has the least error for its time in `docs/accuracy`.
    pub fn rule(self) -> Rule {
        Rule::default()
    }

    /// Advice: a number of elements whose error of mesh is about that of time, for a cable that swings and bends as the pendulum
    /// of `docs/accuracy` does. A taut cable needs fewer, one with sharper bends more.
    pub fn elements(self) -> usize {
        match self {
            Fidelity::Game => 10,
            Fidelity::Engineering => 20,
            Fidelity::Reference => 80,
        }
    }

    /// The integrator, for a cable whose frequencies stay below `frequency_bound` (rad/s).
    pub fn integrator(self, frequency_bound: f64) -> Integrator {
        match self {
            Fidelity::Game => Integrator {
                method: Method::GeneralisedAlpha { rho: 0.5, newton: NewtonMode::Once },
                control: StepControl::MaxStep(1.0 / 240.0),
            },
            Fidelity::Engineering => Integrator::default(),
            Fidelity::Reference if frequency_bound < EXPLICIT_FREQUENCY => {
                Integrator { method: Method::Rkn4, control: StepControl::Stable(0.5) }
            }
            Fidelity::Reference => Integrator { method: Method::Esdirk4, control: StepControl::Tolerance(1e-9) },
        }
    }
}

impl Integrator {
    /// A method with a tolerance in m of position error per host step.
    ///
    /// # Errors
    /// [`Error::UnsupportedControl`] if the method has no error estimate, [`Error::InvalidValue`] for a bad tolerance.
    pub fn tolerance(method: Method, tolerance: f64) -> Result<Self, Error> {
        Integrator { method, control: StepControl::Tolerance(tolerance) }.checked()
    }

    /// A method with a fixed number of equal steps per host step.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for zero steps.
    pub fn substeps(method: Method, substeps: u32) -> Result<Self, Error> {
        Integrator { method, control: StepControl::Substeps(substeps) }.checked()
    }

    /// The same, if the method can do what the control asks.
    ///
    /// # Errors
    /// [`Error::UnsupportedControl`] or [`Error::InvalidValue`].
    pub fn checked(self) -> Result<Self, Error> {
        if let Method::GeneralisedAlpha { rho, .. } = self.method {
            require("rho of generalised-alpha", rho, (0.0..=1.0).contains(&rho), "between 0 and 1")?;
        }
        let unsupported = |reason| Err(Error::UnsupportedControl { method: self.method.to_string(), reason });
        match self.control {
            StepControl::Tolerance(tolerance) => {
                require("tolerance (m)", tolerance, tolerance > 0.0, "> 0")?;
                if self.method.properties().estimate_order.is_none() {
                    return unsupported("it does not estimate its error; give substeps, max_step, or another method");
                }
            }
            StepControl::Substeps(substeps) => {
                require("substeps", f64::from(substeps), substeps > 0, "> 0")?;
            }
            StepControl::MaxStep(step) => require("max_step (s)", step, step > 0.0, "> 0")?,
            StepControl::Stable(share) => {
                require("share of the stability limit", share, share > 0.0 && share <= 1.0, "in (0, 1]")?;
                if !matches!(self.method.stepper(), Stepper::Explicit(_)) {
                    return unsupported("only explicit methods have a stability limit; give a tolerance or substeps");
                }
            }
        }
        Ok(self)
    }
}
