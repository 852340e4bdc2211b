//! The methods by name, with their properties.

use super::discrete_gradient::DiscreteGradient;
use super::dynamics::Dynamics;
use super::generalised_alpha::GeneralisedAlpha;
use super::one_step::{OneStep, Scratch, StepRequest};
use super::{esdirk3, esdirk4, midpoint, rkn, tr_bdf2, trapezoid, verlet};
use crate::error::{Error, StepFailure, nearest};
use crate::state::State;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A time integration method. [`Method::properties`] says what each is suited for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
#[non_exhaustive]
pub enum Method {
    /// Implicit midpoint rule.
    Midpoint,
    /// Trapezoidal rule.
    Trapezoid,
    /// Generalised-alpha.
    GeneralisedAlpha {
        /// Spectral radius at infinity, 0 to 1.
        rho: f64,
    },
    /// TR-BDF2.
    TrBdf2,
    /// ESDIRK of order 3.
    Esdirk3,
    /// ESDIRK of order 4.
    Esdirk4,
    /// Guarded discrete gradient with the dissipation 1/16 of fidelity `game`, the largest.
    DiscreteGradient,
    /// Guarded discrete gradient with a dissipation of its own.
    DiscreteGradientWith {
        /// Dissipation a, 0 to 1/16: in steps of h a motion of angular frequency omega loses the
        /// share a (h omega)^3/2 of its amplitude per radian. With 0 nothing is lost, and
        /// vibrations that steps do not resolve ring on.
        dissipation: f64,
    },
    /// Velocity Verlet.
    Verlet,
    /// Symplectic Runge-Kutta-Nystrom of order 4.
    Rkn4,
    /// Symplectic Runge-Kutta-Nystrom of order 6.
    Rkn6,
}

/// Order, cost, stability and range of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Properties {
    /// Order of convergence in time.
    pub order: u32,
    /// Solves (implicit) or force evaluations (explicit) per step.
    pub stages: u32,
    /// True if each stage solves a system.
    pub implicit: bool,
    /// Exponent of h in the error estimate; `None` if the method has no estimate.
    pub estimate_order: Option<u32>,
    /// Stability in words.
    pub stability: &'static str,
    /// When to use it.
    pub validity: &'static str,
}

impl Method {
    /// One of every method, for tables and tests.
    pub const ALL: [Method; 11] = [
        Method::Midpoint,
        Method::Trapezoid,
        Method::GeneralisedAlpha { rho: 0.0 },
        Method::GeneralisedAlpha { rho: 0.5 },
        Method::TrBdf2,
        Method::Esdirk3,
        Method::Esdirk4,
        Method::DiscreteGradient,
        Method::Verlet,
        Method::Rkn4,
        Method::Rkn6,
    ];

    /// Calls `f` with the implementation of the method.
    fn with_implementation<R>(&self, f: impl FnOnce(&dyn OneStep) -> R) -> R {
        match *self {
            Method::Midpoint => f(&midpoint::TABLEAU),
            Method::Trapezoid => f(&trapezoid::METHOD),
            Method::GeneralisedAlpha { rho } => f(&GeneralisedAlpha { rho }),
            Method::TrBdf2 => f(&tr_bdf2::TABLEAU),
            Method::Esdirk3 => f(&esdirk3::TABLEAU),
            Method::Esdirk4 => f(&esdirk4::TABLEAU),
            Method::DiscreteGradient => f(&DiscreteGradient::default()),
            Method::DiscreteGradientWith { dissipation } => f(&DiscreteGradient { dissipation }),
            Method::Verlet => f(&verlet::METHOD),
            Method::Rkn4 => f(&rkn::ORDER_4),
            Method::Rkn6 => f(&rkn::ORDER_6),
        }
    }

    /// Returns order, stability, cost and range of the method.
    pub fn properties(&self) -> Properties {
        let of = |order, stages, stability, validity| Properties {
            order,
            stages,
            implicit: self.stability_limit().is_none(),
            estimate_order: self.estimate_order(),
            stability,
            validity,
        };
        const SYMPLECTIC: &str = "explicit, symplectic; h omega_max below its limit";
        match *self {
            Method::Midpoint => of(2, 1, "A-stable, symplectic", "soft cables; rings on stiff ones at coarse steps"),
            Method::Trapezoid => of(2, 1, "A-stable", "soft cables; rings on stiff ones at coarse steps"),
            Method::GeneralisedAlpha { rho: 0.0 } => {
                of(2, 1, "L-stable", "stiff cables at coarse fixed steps; loses energy")
            }
            Method::GeneralisedAlpha { .. } => {
                of(2, 1, "A-stable, damps above 1/h", "soft cables; spurious tension on steel at 1/60 s")
            }
            Method::TrBdf2 => of(2, 2, "L-stable", "any stiffness, coarse tolerance"),
            Method::Esdirk3 => of(3, 3, "L-stable", "any stiffness, coarse steps"),
            Method::Esdirk4 => of(4, 5, "L-stable", "any stiffness (fidelity engineering, the default)"),
            Method::DiscreteGradient | Method::DiscreteGradientWith { .. } => of(
                2,
                1,
                "the energy law holds at any step",
                "games, h <= 1/240 s (fidelity game); any stiffness, contact, reels, bodies",
            ),
            Method::Verlet => of(2, 1, SYMPLECTIC, "soft cables, many small steps"),
            Method::Rkn4 => of(4, 6, SYMPLECTIC, "soft cables, fine accuracy (fidelity reference)"),
            Method::Rkn6 => of(6, 11, SYMPLECTIC, "soft cables, errors in time near rounding"),
        }
    }
}

impl OneStep for Method {
    fn name(&self) -> String {
        match self {
            // the trapezoidal rule is generalised-alpha with rho = 1, and has its own name
            Method::Trapezoid => "trapezoid".to_string(),
            _ => self.with_implementation(|method| method.name()),
        }
    }

    fn stages(&self) -> usize {
        self.with_implementation(|method| method.stages())
    }

    fn estimate_order(&self) -> Option<u32> {
        self.with_implementation(|method| method.estimate_order())
    }

    fn stability_limit(&self) -> Option<f64> {
        self.with_implementation(|method| method.stability_limit())
    }

    fn has_algorithmic_acceleration(&self) -> bool {
        self.with_implementation(|method| method.has_algorithmic_acceleration())
    }

    fn uses_discrete_gradients(&self) -> bool {
        self.with_implementation(|method| method.uses_discrete_gradients())
    }

    fn dissipation(&self) -> f64 {
        self.with_implementation(|method| method.dissipation())
    }

    fn check(&self) -> Result<(), Error> {
        self.with_implementation(|method| method.check())
    }

    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        request: StepRequest,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        self.with_implementation(|method| method.step(system, now, request, scratch))
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

impl FromStr for Method {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let name = text.to_ascii_lowercase();
        if let Some(rest) = name.strip_prefix("discrete-gradient-")
            && let Ok(dissipation) = rest.parse::<f64>()
        {
            let method = Method::DiscreteGradientWith { dissipation };
            return method.check().map(|()| method);
        }
        if let Some(rest) = name.strip_prefix("generalised-alpha-")
            && let Ok(rho) = rest.parse::<f64>()
        {
            let method = Method::GeneralisedAlpha { rho };
            return method.check().map(|()| method);
        }
        Method::ALL.into_iter().find(|m| m.to_string() == name).ok_or_else(|| Error::UnknownIntegrator {
            name: text.to_string(),
            expected: Method::ALL.map(|m| m.to_string()).join(", ")
                + " (generalised-alpha with any spectral radius from 0 to 1, discrete-gradient-A with any dissipation A from 0 to 0.0625)",
            suggestion: nearest(text, Method::ALL.map(|m| m.to_string())),
        })
    }
}

impl From<Method> for String {
    fn from(method: Method) -> String {
        method.to_string()
    }
}

impl TryFrom<String> for Method {
    type Error = Error;
    fn try_from(text: String) -> Result<Self, Error> {
        text.parse()
    }
}
