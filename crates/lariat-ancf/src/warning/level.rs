//! How much depends on a warning, and what is read of it to order and fold it.

use core::fmt::{Debug, Display};
use serde::{Deserialize, Serialize};

/// How much depends on a warning, from the one to look at first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// What was said is probably not what was meant: another unit, a place inside a body, an
    /// effect that does nothing.
    Setup,
    /// The result is off, and not by its accuracy alone: it made energy, went through something,
    /// or came off what holds it.
    Wrong,
    /// Mesh or steps are coarse: positions and energies are less accurate than they could be.
    Coarse,
}

impl Level {
    /// All levels, in their order.
    pub const ALL: [Level; 3] = [Level::Setup, Level::Wrong, Level::Coarse];

    /// Returns the name: `setup`, `wrong` or `coarse`.
    pub fn name(self) -> &'static str {
        match self {
            Level::Setup => "setup",
            Level::Wrong => "wrong",
            Level::Coarse => "coarse",
        }
    }
}

impl core::str::FromStr for Level {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let found = Level::ALL.into_iter().find(|level| level.name() == text);
        found.ok_or_else(|| format!("no level {text:?}: choose setup, wrong or coarse"))
    }
}

/// Returns the name of the kind of a warning, that of its variant, as `CoarseMesh`.
pub fn name_of(warning: &impl Debug) -> String {
    let text = format!("{warning:?}");
    text.split([' ', '(']).next().unwrap_or_default().to_string()
}

/// What a warning is a sign of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// A section or material in another unit.
    Sizes,
    /// Cable and body that start with different velocities.
    Shock,
    /// A cable inside a body.
    Inside,
    /// A cable that its drawn shape throws.
    Corner,
    /// Cable and anchor apart.
    Gap,
    /// A tension beyond the law.
    Strain,
    /// Integration makes energy.
    EnergyMade,
    /// Integration takes energy.
    EnergyLost,
    /// A cable went through something.
    Crossing,
    /// Steps too long.
    Steps,
    /// Elements too long.
    Mesh,
    /// A cable deep in what it touches.
    Depth,
    /// Twist that is lost.
    Twist,
}

/// What is read of a warning to order and fold it.
pub trait Judged: Display {
    /// How much depends on it.
    fn level(&self) -> Level;
    /// What it is a sign of, if it may be a cause or a symptom.
    fn sign(&self) -> Option<Sign>;
    /// Whether another one is of the same kind.
    fn same_kind(&self, other: &Self) -> bool;
    /// Its time in s; `None` if it holds from the start.
    fn time(&self) -> Option<f64>;
    /// A number that is larger the worse it is, among warnings of one kind.
    fn severity(&self) -> f64;
}
