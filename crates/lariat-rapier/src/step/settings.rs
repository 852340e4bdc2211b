//! Settings of a set.

use crate::scales::TIME_ROUNDING;
use crate::scales::step::{LONGEST_PIECE, MAX_RAPIER_STEPS, RAPIER_STEPS, SLEEP_SPEED};
use crate::step::budget::Budget;
use lariat_ancf::{Fidelity, Level};
use serde::{Deserialize, Serialize};

/// How a [`CableSet`](crate::CableSet) steps. All of its cables share one number of Rapier steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Smallest number of Rapier steps per host step. Default 1. Rapier's cost, of the whole world,
    /// grows in proportion.
    pub rapier_steps: u32,
    /// Largest number of Rapier steps per host step. More than `rapier_steps` are taken where a
    /// light body in contact hangs on a stiff, taut cable, enough to resolve its vibration, and for
    /// as long as it does. Default 32. A value of `rapier_steps` or less fixes the number at
    /// `rapier_steps`. A host step of more than 1/30 s may have as many in each 1/30 s.
    #[serde(default = "max_rapier_steps")]
    pub max_rapier_steps: u32,
    /// Speed in m/s below which cables and the bodies on them may fall asleep, if the forces
    /// between them are steady. Default 2e-3; 0 disables sleep.
    pub sleep_speed: f64,
    /// Fidelity of the cables that are inserted without a chosen integrator. Default: game, whose
    /// cost per step is bounded and which cannot make energy.
    #[serde(default = "fidelity")]
    pub fidelity: Fidelity,
    /// Whether cables that are inserted from now on are [watched](lariat_ancf::Cable::set_watched):
    /// each warning is an event. Default true; each cable is then read once per host step.
    #[serde(default = "watch")]
    pub watch: bool,
    /// Up to which level warnings are told. Default: of each cable up to
    /// [`Cable::warn_level`](lariat_ancf::Cable::warn_level), which leaves out what is coarse with
    /// the steps of fidelity game. What only warnings beyond it need is not read: those that a
    /// program asks a cable for are then of its present shape.
    #[serde(default)]
    pub warn_level: Option<Level>,
    /// The largest amount of work in a host step; `None` for no limit. Default: [that of
    /// games](Budget::Games), which bounds the host steps of islands with fidelity game.
    #[serde(default = "budget")]
    pub budget: Option<Budget>,
}

impl Settings {
    /// Returns the largest number of Rapier steps in a host step of `dt` (s).
    pub(crate) fn most_rapier_steps(&self, dt: f64) -> u32 {
        let pieces = f64::from(pieces(dt)) * f64::from(self.max_rapier_steps);
        // a number that is too large becomes the largest
        if self.max_rapier_steps <= self.rapier_steps { self.rapier_steps.max(1) } else { pieces as u32 }
    }
}

/// Returns the number of pieces of a host step of `dt` (s) that are no longer than
/// [`LONGEST_PIECE`].
pub(crate) fn pieces(dt: f64) -> u32 {
    (dt / LONGEST_PIECE * (1.0 - TIME_ROUNDING)).ceil().max(1.0) as u32
}

fn watch() -> bool {
    true
}

fn fidelity() -> Fidelity {
    Fidelity::Game
}

fn budget() -> Option<Budget> {
    Some(Budget::Games)
}

fn max_rapier_steps() -> u32 {
    MAX_RAPIER_STEPS
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            rapier_steps: RAPIER_STEPS,
            max_rapier_steps: max_rapier_steps(),
            sleep_speed: SLEEP_SPEED,
            fidelity: fidelity(),
            watch: watch(),
            warn_level: None,
            budget: budget(),
        }
    }
}
