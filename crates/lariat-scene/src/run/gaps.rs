//! Gaps of attachments: cable and anchor that a body does not hold together.
//!
//! # Equation
//!
//! A gap is an error of position. Once an attachment has been closed to within the limit that positions are warned at, 2e-3 of the length of the
//! cable, a larger gap is told; so is an attachment that never closed.

use super::World;
use crate::error::Error;
use crate::warning::Warning;

/// Largest gap without a warning, as a share of the length of the cable.
const GAP: f64 = 2e-3;

/// The gap of an attachment so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct GapWatch {
    closed: bool,
    /// Largest gap in m since it closed, or if it did not, the least; and its time in s.
    worst: Option<(f64, f64)>,
}

impl GapWatch {
    /// Reads an attachment at a host time.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for an attachment of the scene.
    pub fn note(&mut self, index: usize, world: &World) -> Result<(), Error> {
        // before the first step there is no reading
        let Some(physics) = world.physics.as_ref().filter(|_| world.time() > 0.0) else { return Ok(()) };
        let Some(reading) = physics.reading(index, world.time())? else { return Ok(()) };
        let now = (reading.gap.norm(), world.time());
        if !self.closed && now.0 <= limit(index, world) {
            *self = GapWatch { closed: true, worst: None };
        }
        let keep = self.worst.is_some_and(|(gap, _)| if self.closed { gap >= now.0 } else { gap <= now.0 });
        if !keep {
            self.worst = Some(now);
        }
        Ok(())
    }

    /// Returns the warning about it.
    pub fn warning(&self, index: usize, world: &World) -> Option<Warning> {
        let attachment = world.scene.attachments[index].name.clone();
        let (gap_m, time_s) = self.worst.filter(|(gap, _)| *gap > limit(index, world))?;
        Some(Warning::OpenGap { attachment, time_s, gap_m, closed: self.closed })
    }
}

fn limit(index: usize, world: &World) -> f64 {
    GAP * world.scene.cables[world.scene.attachments[index].cable].length
}
