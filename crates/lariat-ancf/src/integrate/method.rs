//! The methods by name, and what each is good for.

use super::dirk::Tableau;
use super::explicit::Composition;
use super::generalised_alpha::GeneralisedAlpha;
use super::{OneStep, esdirk3, esdirk4, midpoint, rkn, tr_bdf2, trapezoid, verlet};
use crate::error::{Error, require};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Newton's iteration of generalised-alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum NewtonMode {
    /// To convergence.
    #[default]
    Converged,
    /// One iteration, checked; more where it does not contract.
    Once,
}

/// A time integrator. See [`Method::properties`] for what each is good for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Method {
    /// Implicit midpoint rule.
    Midpoint,
    /// Trapezoidal rule.
    Trapezoid,
    /// Generalised-alpha.
    GeneralisedAlpha {
        /// Spectral radius at infinity, 0 to 1.
        rho: f64,
        /// One Newton iteration, or to convergence.
        newton: NewtonMode,
    },
    /// TR-BDF2.
    TrBdf2,
    /// ESDIRK of order 3.
    Esdirk3,
    /// ESDIRK of order 4.
    Esdirk4,
    /// Velocity Verlet.
    Verlet,
    /// Symplectic Runge-Kutta-Nystrom of order 4.
    Rkn4,
    /// Symplectic Runge-Kutta-Nystrom of order 6.
    Rkn6,
}

/// What a method can do and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// A method ready to step.
pub(crate) enum Stepper {
    Dirk(&'static Tableau),
    Alpha(GeneralisedAlpha),
    Explicit(&'static Composition),
}

impl Stepper {
    pub(crate) fn one_step(&self) -> &dyn OneStep {
        match self {
            Stepper::Dirk(tableau) => *tableau,
            Stepper::Alpha(alpha) => alpha,
            Stepper::Explicit(composition) => *composition,
        }
    }
}

impl Method {
    /// One of every method, for tables and tests.
    pub const ALL: [Method; 11] = [
        Method::Midpoint,
        Method::Trapezoid,
        Method::GeneralisedAlpha { rho: 0.0, newton: NewtonMode::Converged },
        Method::GeneralisedAlpha { rho: 0.5, newton: NewtonMode::Converged },
        Method::GeneralisedAlpha { rho: 0.5, newton: NewtonMode::Once },
        Method::TrBdf2,
        Method::Esdirk3,
        Method::Esdirk4,
        Method::Verlet,
        Method::Rkn4,
        Method::Rkn6,
    ];

    pub(crate) fn stepper(&self) -> Stepper {
        match *self {
            Method::Midpoint => Stepper::Dirk(&midpoint::TABLEAU),
            Method::Trapezoid => Stepper::Alpha(trapezoid::METHOD),
            Method::GeneralisedAlpha { rho, newton } => Stepper::Alpha(GeneralisedAlpha { rho, newton }),
            Method::TrBdf2 => Stepper::Dirk(&tr_bdf2::TABLEAU),
            Method::Esdirk3 => Stepper::Dirk(&esdirk3::TABLEAU),
            Method::Esdirk4 => Stepper::Dirk(&esdirk4::TABLEAU),
            Method::Verlet => Stepper::Explicit(&verlet::METHOD),
            Method::Rkn4 => Stepper::Explicit(&rkn::ORDER_4),
            Method::Rkn6 => Stepper::Explicit(&rkn::ORDER_6),
        }
    }

    /// Order, stability, cost and range of the method.
    pub fn properties(&self) -> Properties {
        let implicit = |order, stages, estimate_order, stability, validity| Properties {
            order,
            stages,
            implicit: true,
            estimate_order,
            stability,
            validity,
        };
        let explicit = |order, stages, validity| Properties {
            order,
            stages,
            implicit: false,
            estimate_order: None,
            stability: "explicit, symplectic; h omega_max below its limit",
            validity,
        };
        match *self {
            Method::Midpoint => {
                implicit(2, 1, None, "A-stable, symplectic", "soft cables; rings on stiff ones at coarse steps")
            }
            Method::Trapezoid => {
                implicit(2, 1, Some(3), "A-stable", "soft cables; rings on stiff ones at coarse steps")
            }
            Method::GeneralisedAlpha { newton: NewtonMode::Once, .. } => {
                implicit(2, 1, Some(3), "A-stable; linearly implicit, checked", "games, h <= 1/240 s (fidelity game)")
            }
            Method::GeneralisedAlpha { rho: 0.0, .. } => {
                implicit(2, 1, Some(3), "L-stable", "stiff cables at coarse fixed steps; loses energy")
            }
            Method::GeneralisedAlpha { .. } => {
                implicit(2, 1, Some(3), "A-stable, damps above 1/h", "soft cables; spurious tension on steel at 1/60 s")
            }
            Method::TrBdf2 => implicit(2, 2, Some(3), "L-stable", "any stiffness, coarse tolerance"),
            Method::Esdirk3 => implicit(3, 3, Some(3), "L-stable", "any stiffness, coarse steps"),
            Method::Esdirk4 => implicit(4, 5, Some(4), "L-stable", "any stiffness (fidelity engineering, the default)"),
            Method::Verlet => explicit(2, 1, "soft cables, many small steps"),
            Method::Rkn4 => explicit(4, 6, "soft cables, fine accuracy (fidelity reference)"),
            Method::Rkn6 => explicit(6, 11, "soft cables, errors in time near rounding"),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Method::Midpoint => f.write_str("midpoint"),
            Method::Trapezoid => f.write_str("trapezoid"),
            Method::GeneralisedAlpha { rho, newton: NewtonMode::Converged } => write!(f, "generalised-alpha-{rho}"),
            Method::GeneralisedAlpha { rho, newton: NewtonMode::Once } => write!(f, "generalised-alpha-{rho}-once"),
            Method::TrBdf2 => f.write_str("tr-bdf2"),
            Method::Esdirk3 => f.write_str("esdirk3"),
            Method::Esdirk4 => f.write_str("esdirk4"),
            Method::Verlet => f.write_str("verlet"),
            Method::Rkn4 => f.write_str("rkn4"),
            Method::Rkn6 => f.write_str("rkn6"),
        }
    }
}

impl FromStr for Method {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let name = text.to_ascii_lowercase();
        if let Some(rest) = name.strip_prefix("generalised-alpha-") {
            let (rho, newton) = match rest.strip_suffix("-once") {
                Some(rho) => (rho, NewtonMode::Once),
                None => (rest, NewtonMode::Converged),
            };
            if let Ok(rho) = rho.parse::<f64>() {
                require("rho of generalised-alpha", rho, (0.0..=1.0).contains(&rho), "between 0 and 1")?;
                return Ok(Method::GeneralisedAlpha { rho, newton });
            }
        }
        Method::ALL.into_iter().find(|m| m.to_string() == name).ok_or_else(|| Error::UnknownIntegrator {
            name: text.to_string(),
            expected: Method::ALL.map(|m| m.to_string()).join(", ")
                + " (generalised-alpha with any spectral radius from 0 to 1)",
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
