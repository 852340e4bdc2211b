//! A force per length over a piece of the cable: snow, a paid-out line's lead, marine growth.
//!
//! ```text
//! F = int_from^to S(s)^T f ds
//! ```
//!
//! f in N per m of unstretched cable, in world axes, constant: a dead load with potential -f . int r ds. *Source.* Virtual work;
//! the integral over Hermite's functions is exact, also for pieces that end inside an element. *Validity.* Dead loads; wind that
//! turns with the cable is [`drag`](super::drag). *Rejected.* Lumping on the nodes: it loses the moments on the slopes, and with them
//! an order of the static shape. It enters a constant vector: no work in a step.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A constant force per length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineLoad {
    /// Arc length of the unstretched cable where it begins, in m.
    pub from: f64,
    /// Arc length where it ends, in m; beyond the cable's end = up to there.
    pub to: f64,
    /// Force in N per m of unstretched cable, world axes.
    pub force: Vector3<f64>,
}

impl LineLoad {
    /// A force per length (N/m) on the whole cable.
    pub fn uniform(force: Vector3<f64>) -> Self {
        LineLoad { from: 0.0, to: f64::MAX, force }
    }
}
