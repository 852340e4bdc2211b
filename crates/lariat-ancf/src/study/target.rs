//! What an error is asked of: positions, or what the cables carry.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// What is compared between two runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Positions of cables and bodies.
    #[default]
    Position,
    /// Tension of cables: at their ends, where they are held, attached and loaded, and the largest
    /// along each.
    Tension,
    /// Bending moment there.
    Moment,
}

/// An error that is asked for.
///
/// ```
/// use lariat_ancf::study::{Quantity, Target};
/// assert_eq!("1e-3".parse(), Ok(Target::from(1e-3))); // 1 mm of all positions
/// assert_eq!("tension=1%".parse(), Ok(Target::share(Quantity::Tension, 0.01)));
/// assert_eq!("moment=2Nm".parse(), Ok(Target::absolute(Quantity::Moment, 2.0)));
/// assert!("moment=2N".parse::<Target>().is_err() && "length=1".parse::<Target>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Of what.
    pub quantity: Quantity,
    /// Largest error in m, N or N m; if relative, its share of the largest value of the same cable
    /// in the run.
    pub error: f64,
    /// Whether it is a share; never of positions.
    pub relative: bool,
}

impl Default for Target {
    fn default() -> Self {
        Target::from(1e-3)
    }
}

impl From<f64> for Target {
    /// Returns an error of positions in m.
    fn from(error: f64) -> Self {
        Target::absolute(Quantity::Position, error)
    }
}

impl Target {
    /// Returns an error in m, N or N m.
    pub fn absolute(quantity: Quantity, error: f64) -> Self {
        Target { quantity, error, relative: false }
    }

    /// Returns a share of the largest value of the same cable in the run; of positions, which have
    /// no largest value, an error in m.
    pub fn share(quantity: Quantity, error: f64) -> Self {
        Target { quantity, error, relative: quantity != Quantity::Position }
    }

    /// Returns the error in m, if it is one of positions.
    pub fn of_positions(&self) -> Option<f64> {
        (self.quantity == Quantity::Position).then_some(self.error)
    }

    /// Returns the unit of an error.
    pub fn unit(&self) -> &'static str {
        match (self.relative, self.quantity) {
            (true, _) => "of the largest",
            (_, Quantity::Position) => "m",
            (_, Quantity::Tension) => "N",
            (_, Quantity::Moment) => "N m",
        }
    }

    /// Returns an error of the quantity as text.
    pub fn text(&self, error: f64) -> String {
        let digits = if error == self.error { format!("{error:e}") } else { format!("{error:.1e}") };
        match self.relative {
            true if error == self.error => format!("{} %", 100.0 * error),
            true => format!("{:.2} %", 100.0 * error),
            false => format!("{digits} {}", self.unit()),
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Quantity::Position => "positions",
            Quantity::Tension => "tensions",
            Quantity::Moment => "moments",
        })
    }
}

impl fmt::Display for Target {
    /// As it is written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.quantity {
            Quantity::Position => return write!(f, "{}", self.error),
            Quantity::Tension => "tension",
            Quantity::Moment => "moment",
        };
        match self.relative {
            true => write!(f, "{name}={}%", 100.0 * self.error),
            false => write!(f, "{name}={}{}", self.error, self.unit().replace(' ', "")),
        }
    }
}

/// A text that is no error.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{0:?}; accepted: an error of positions in m (1e-3), of tensions (tension=1%, tension=50N) or of moments (moment=5%, moment=2Nm)"
)]
pub struct InvalidTarget(pub String);

impl FromStr for Target {
    type Err = InvalidTarget;

    fn from_str(text: &str) -> Result<Self, InvalidTarget> {
        let refused = || InvalidTarget(text.to_string());
        let Some((name, amount)) = text.split_once('=') else {
            return text.trim().parse().map(|error: f64| Target::from(error)).map_err(|_| refused());
        };
        let (quantity, unit) = match name.trim() {
            "tension" => (Quantity::Tension, "N"),
            "moment" => (Quantity::Moment, "Nm"),
            _ => return Err(refused()),
        };
        let amount = amount.replace(' ', "");
        let number = |digits: &str| digits.parse::<f64>().map_err(|_| refused());
        if let Some(digits) = amount.strip_suffix('%') {
            return number(digits).map(|percent| Target::share(quantity, percent / 100.0));
        }
        let digits = amount.strip_suffix(unit).ok_or_else(refused)?;
        number(digits).map(|error| Target::absolute(quantity, error))
    }
}
