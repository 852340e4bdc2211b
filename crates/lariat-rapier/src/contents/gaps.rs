//! Gaps of attachments: cable and anchor that a body does not hold together.
//!
//! # Equation
//!
//! A gap is an error of position. Once an attachment has been closed to within the limit that
//! positions are warned at, 2e-3 of the length of the cable, a larger gap is told; so is an
//! attachment that never closed, at once where its gap is longer than it may begin with.

use crate::scales::contents::OPEN_GAP;
use serde::{Deserialize, Serialize};

/// A gap of an attachment that is longer than its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OpenGap {
    /// Largest distance in m since cable and anchor met, or if they did not, the least.
    pub gap: f64,
    /// Time of the cable in s.
    pub time: f64,
    /// Whether they met.
    pub closed: bool,
}

/// The gap of an attachment so far.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct GapWatch {
    closed: bool,
    /// Length in m with which it may begin.
    #[serde(default)]
    allowed: f64,
    /// Largest gap in m since it closed, or if it did not, the least; and its time in s.
    worst: Option<(f64, f64)>,
    /// Whether it has been told.
    told: bool,
    /// Whether it was told how the attachment begins.
    #[serde(default)]
    introduced: bool,
}

impl GapWatch {
    /// Begins with a gap of a length in m at most.
    pub fn new(allowed: f64) -> Self {
        GapWatch { allowed, ..GapWatch::default() }
    }

    /// Reads a gap in m at the end of a host step at a time in s, with a cable of a length in m.
    /// Returns what to tell: once, a gap that opened after it had closed, or one that was there
    /// before the first step and may not be.
    pub fn note(&mut self, gap: f64, time: f64, length: f64) -> Option<OpenGap> {
        if !self.closed && gap <= OPEN_GAP * length {
            let GapWatch { introduced, allowed, .. } = *self;
            *self = GapWatch { closed: true, introduced, allowed, ..GapWatch::default() };
        }
        let keep = self.worst.is_some_and(|(worst, _)| if self.closed { worst >= gap } else { worst <= gap });
        if !keep {
            self.worst = Some((gap, time));
        }
        let due = |open: &OpenGap| !self.told && (open.closed || open.gap > self.allowed);
        let open = self.open(length).filter(due)?;
        self.told = true;
        Some(open)
    }

    /// Returns whether this is the first call, of an attachment that has not been read.
    pub fn introduce(&mut self) -> bool {
        !core::mem::replace(&mut self.introduced, true) && !self.is_read()
    }

    /// Returns whether it has been read.
    pub fn is_read(&self) -> bool {
        self.worst.is_some()
    }

    /// Returns the gap if it is longer than its limit.
    pub fn open(&self, length: f64) -> Option<OpenGap> {
        let (gap, time) = self.worst.filter(|(gap, _)| *gap > OPEN_GAP * length)?;
        Some(OpenGap { gap, time, closed: self.closed })
    }
}
