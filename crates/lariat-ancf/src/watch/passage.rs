//! What a cable passed through although it can touch it.

use core::fmt;
use serde::{Deserialize, Serialize};

/// When, where and through what a cable passed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Passage {
    /// Time in s at the beginning of the step in which it did.
    pub time_s: f64,
    /// Arc length in m.
    pub arc_length_m: f64,
    /// Through what.
    pub through: Through,
}

/// What a cable passed through.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Through {
    /// The cable itself.
    Itself,
    /// Another cable, by its name.
    Cable(String),
    /// An obstacle, by its key.
    Obstacle(u64),
    /// A body of a scene, by its name.
    Body(String),
}

impl fmt::Display for Through {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Through::Itself => f.write_str("itself"),
            Through::Cable(name) => write!(f, "cable {name:?}"),
            Through::Obstacle(key) => write!(f, "obstacle {key}"),
            Through::Body(name) => write!(f, "body {name:?}"),
        }
    }
}
