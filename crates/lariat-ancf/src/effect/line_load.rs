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

use super::{Cut, Effect, Target};
use crate::error::{Error, require, require_finite};
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

/// Constant forces per length; they add up where they overlap.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LineLoads(pub Vec<LineLoad>);

impl From<LineLoad> for LineLoads {
    fn from(load: LineLoad) -> Self {
        LineLoads(vec![load])
    }
}

impl Effect for LineLoads {
    const DISSIPATIVE: bool = false;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        self.0.iter().try_for_each(|load| {
            let on_cable = load.from >= 0.0 && load.from < cable.length();
            require("begin of a line load (m)", load.from, on_cable, "on the cable")?;
            require("end of a line load (m)", load.to, load.to > load.from, "> its begin")?;
            require_finite("line load (N/m)", &load.force)
        })
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn has_exact_tangent(&self) -> bool {
        true
    }

    fn needs_implicit_integrator(&self) -> bool {
        false
    }

    fn cut(&self, cut: Cut<'_>) -> [Option<Self>; 2] {
        let s = cut.arc_length();
        let behind = |load: &LineLoad| {
            let to = load.to - s;
            (to > 0.0).then(|| LineLoad { from: (load.from - s).max(0.0), to, ..*load })
        };
        let head: Vec<LineLoad> = self.0.iter().copied().filter(|load| load.from < s).collect();
        let tail: Vec<LineLoad> = self.0.iter().filter_map(behind).collect();
        [head, tail].map(|loads| (!loads.is_empty()).then_some(LineLoads(loads)))
    }

    fn refine(&mut self, _: usize, _: f64) {}
}
