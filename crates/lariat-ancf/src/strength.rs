//! What a cable withstands before it breaks.

use crate::error::{Error, require};
use serde::{Deserialize, Serialize};

/// What a cable withstands; without limits, the default, it does not break. A number converts into a limit of the tension.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Strength {
    /// Largest tension in N. Default: none.
    pub tension: Option<f64>,
    /// Largest strain, stretch over rest stretch less 1. Default: none.
    pub strain: Option<f64>,
}

impl Strength {
    /// Returns the strength of a cable that breaks above a tension in N.
    pub fn tension(limit: f64) -> Self {
        Strength { tension: Some(limit), strain: None }
    }

    /// Returns the strength of a cable that breaks above a strain.
    pub fn strain(limit: f64) -> Self {
        Strength { tension: None, strain: Some(limit) }
    }

    /// Returns whether there is a limit.
    pub fn is_limited(&self) -> bool {
        self.tension.is_some() || self.strain.is_some()
    }

    /// Returns the larger share of its limit that tension (N) and strain reach, and which of them it is.
    pub(crate) fn share(&self, tension: f64, strain: f64) -> (f64, BreakCause) {
        let share = |value: f64, limit: Option<f64>| limit.map_or(f64::NEG_INFINITY, |limit| value / limit);
        let (by_tension, by_strain) = (share(tension, self.tension), share(strain, self.strain));
        if by_tension >= by_strain { (by_tension, BreakCause::Tension) } else { (by_strain, BreakCause::Strain) }
    }

    /// Refuses limits that are not positive numbers.
    pub(crate) fn check(&self) -> Result<(), Error> {
        for (what, limit) in [("breaking tension (N)", self.tension), ("breaking strain", self.strain)] {
            limit.map_or(Ok(()), |limit| require(what, limit, limit > 0.0, "> 0"))?;
        }
        Ok(())
    }
}

impl From<Option<f64>> for Strength {
    fn from(tension: Option<f64>) -> Self {
        Strength { tension, strain: None }
    }
}

impl From<f64> for Strength {
    fn from(tension: f64) -> Self {
        Self::tension(tension)
    }
}

/// Why a cable became two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BreakCause {
    /// The tension exceeded its limit.
    Tension,
    /// The strain exceeded its limit.
    Strain,
    /// It was cut by hand.
    Cut,
}

impl BreakCause {
    /// Returns the name: `tension`, `strain` or `cut`.
    pub fn name(self) -> &'static str {
        match self {
            BreakCause::Tension => "tension",
            BreakCause::Strain => "strain",
            BreakCause::Cut => "cut",
        }
    }
}

/// Where, why and under which load a cable became two.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Break {
    /// Why.
    pub cause: BreakCause,
    /// Arc length of the break in m, unstretched: the new length of the part before it.
    pub arc_length: f64,
    /// Largest tension in N just before; of a cut, the tension at it.
    pub tension: f64,
    /// Strain there, stretch over rest stretch less 1.
    pub strain: f64,
    /// Strain energy in J of both parts at the break. No more than this, and their weight, is set free as motion.
    pub strain_energy: f64,
    /// Change of the total energy in J by the edit itself: zero at a node, else what a node placed there
    /// [adds](crate::Cable::inserted_energy).
    pub inserted_energy: f64,
}
