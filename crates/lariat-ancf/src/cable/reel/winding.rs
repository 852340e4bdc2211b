//! The state of a reel.

use crate::element::variable_length::Extent;
use crate::error::{Error, require};
use crate::system::MotorState;
use serde::{Deserialize, Serialize};

/// The state of a reel, beside the coordinates of its cable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Winding {
    /// The element at the eye: length in m, rate in m/s, acceleration in m/s^2.
    pub extent: [f64; 3],
    /// Length in m at the beginning of the last step of the integrator.
    pub length_before: f64,
    /// Length in m that came through the eye so far, on balance.
    pub passed: f64,
    /// Length in m of the same cable beyond a sheave when nothing had come through: a reel at the
    /// other end counts it as out.
    #[serde(default)]
    pub beyond: f64,
    /// Work of the winch and of entering material in J.
    pub work: f64,
    /// Energy in J that merging and splitting elements added.
    pub remeshed: f64,
    pub splits: u64,
    pub merges: u64,
    pub stopped: bool,
    /// Mean pull in N over the last step of the discrete gradient.
    pub pull: Option<f64>,
    /// What a motor of limited force was left in; `None` without one.
    #[serde(default)]
    pub motor: Option<MotorState>,
    /// Whether the stock rides with the body at the eye.
    #[serde(default)]
    pub rides: bool,
    /// What it does in a host step that is taken in several steps.
    #[serde(default)]
    pub(super) plan: Option<Plan>,
}

impl Winding {
    /// A reel that stands, with an element of this length in m at its eye.
    pub fn new(length: f64) -> Self {
        Winding { extent: [length, 0.0, 0.0], length_before: length, ..Winding::default() }
    }

    /// Returns the extent of the element at the eye.
    pub fn extent(&self) -> Extent {
        let [length, rate, acceleration] = self.extent;
        Extent { length, rate, acceleration }
    }

    /// Refuses numbers that make no reel: for snapshots that come from a file.
    pub fn check(&self) -> Result<(), Error> {
        let [length, rate, acceleration] = self.extent;
        require("length of the element at the eye (m)", length, length > 0.0, "> 0")?;
        let Winding { length_before, passed, beyond, work, remeshed, .. } = *self;
        for x in [rate, acceleration, length_before, passed, beyond, work, remeshed, self.pull.unwrap_or(0.0)] {
            require("number of a reel", x, true, "a number")?;
        }
        for x in self.plan.iter().flat_map(Plan::numbers) {
            require("number of a reel", x, true, "a number")?;
        }
        self.motor.map_or(Ok(()), |motor| motor.check())
    }
}

/// The rate of a host step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Plan {
    /// Times in s at which the host step begins and ends.
    pub(super) begin: f64,
    pub(super) end: f64,
    /// Rate in m/s at its end; without meaning for a motor.
    pub(super) rate: f64,
    /// Whether an end of the cable stops it.
    pub stopped: bool,
}

impl Plan {
    /// Returns what is left in s of the host step for a step of `h` (s) at `time` (s) and those
    /// after it; `None` if it has ended.
    pub fn left(&self, time: f64, h: f64) -> Option<f64> {
        let left = self.end - time;
        // the last one ends with the host step, which is a sum with rounding
        (time >= self.begin && left > 0.5 * h).then_some(if left < 1.5 * h { h } else { left })
    }

    /// Returns the acceleration in m/s^2 of a step from a rate in m/s, of which so much in s is
    /// left.
    pub fn acceleration(&self, rate: f64, left: f64) -> f64 {
        (self.rate - rate) / left
    }

    /// Returns the numbers, to check them.
    pub fn numbers(&self) -> [f64; 3] {
        [self.begin, self.end, self.rate]
    }
}
