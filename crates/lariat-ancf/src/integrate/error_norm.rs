//! Which errors a tolerance is compared with.

use crate::error::{Error, nearest};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Which errors a [tolerance](super::StepControl::ToleranceOf) bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorNorm {
    /// The position of every node and body, vibrations included, in phase. Default.
    #[default]
    Every,
    /// The motion that is slow beside the host step. Vibrations are followed only as far as the
    /// error of one step demands, see [`error_budget`](super::error_budget). In an island the same
    /// as `Every`, because vibrations of cables move the bodies.
    Motion,
    /// The positions of the free bodies of an island; in one without, and for a cable alone, the
    /// same as `Motion`. Vibrations of cables are damped where steps do not resolve them, and the
    /// energy falls with them.
    Bodies,
}

impl ErrorNorm {
    /// All norms, from the strictest.
    pub const ALL: [ErrorNorm; 3] = [ErrorNorm::Every, ErrorNorm::Motion, ErrorNorm::Bodies];

    /// Returns the name: `every`, `motion` or `bodies`.
    pub fn name(self) -> &'static str {
        match self {
            ErrorNorm::Every => "every",
            ErrorNorm::Motion => "motion",
            ErrorNorm::Bodies => "bodies",
        }
    }
}

impl FromStr for ErrorNorm {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        ErrorNorm::ALL.into_iter().find(|norm| norm.name() == text).ok_or_else(|| Error::UnknownNorm {
            name: text.to_string(),
            suggestion: nearest(text, ErrorNorm::ALL.map(|norm| norm.name().to_string())),
        })
    }
}
