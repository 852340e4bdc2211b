//! What is remembered of the numbers of steps that host steps took.

use serde::{Deserialize, Serialize};

/// What [`StepControl::Adaptive`](crate::StepControl::Adaptive) remembers beside the length of the
/// next steps. Plain data, part of a snapshot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Pace {
    /// Estimated error, as a share of the size in 1/60 s, of the last host step whose steps were as
    /// long as those of games, if the next ones were halved for it; else 0.
    pub halved_at: f32,
    /// Whether halves of those steps did not halve that error.
    pub unresolved: bool,
    /// Number of host steps in which the number of steps does not fall.
    pub wary: u8,
}

impl Pace {
    /// Returns that of a system of two parts.
    pub(crate) fn and(self, other: &Pace) -> Pace {
        Pace {
            halved_at: self.halved_at.max(other.halved_at),
            unresolved: self.unresolved || other.unresolved,
            wary: self.wary.max(other.wary),
        }
    }
}
