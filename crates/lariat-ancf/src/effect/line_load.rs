//! Constant forces per length on pieces of the cable: snow, a marker line, marine growth.
//!
//! # Equation
//!
//! ```text
//! F = int_from^to S(s)^T f ds
//! ```
//!
//! f in N per m of unstretched cable, in world axes, constant: a dead load with potential -f . int
//! r ds. The integral over Hermite's functions is exact, also for pieces that end inside an
//! element. It enters a constant vector: no work in a step.
//!
//! # Validity
//!
//! Dead loads; wind that follows the direction of the cable is [`drag`](super::drag).
//!
//! # Alternatives considered
//!
//! Lumping on the nodes: it loses the moments on the slopes, and with them an order of the static
//! shape.

use super::acts::{Acts, Nothing};
use super::{Cut, Effect, Target};
use crate::element::{mass, shape};
use crate::error::{Error, require, require_finite};
use crate::point::Point;
use crate::quadrature::gauss_legendre;
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
    /// Creates a force per length (N/m) on the whole cable.
    pub fn uniform(force: impl Into<Point>) -> Self {
        LineLoad { from: 0.0, to: f64::MAX, force: force.into().0 }
    }

    /// Adds its generalised force on an element of a length in m that begins at an arc length in m.
    pub(crate) fn add_on(&self, begin: f64, length: f64, force: &mut [f64]) {
        let at = |s: f64| ((s - begin) / length).clamp(0.0, 1.0);
        let (a, b) = (at(self.from), at(self.to));
        if a == b {
            return;
        }
        let weights = if (a, b) == (0.0, 1.0) { mass::load_weights(length) } else { partial_weights(length, a, b) };
        for (i, f) in force.iter_mut().enumerate() {
            *f += weights[i / 3] * self.force[i % 3];
        }
    }
}

/// Constant forces per length; they add up where they overlap.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LineLoads(pub Vec<LineLoad>);

impl LineLoads {
    /// Returns the sum in N/m of loads that are on the whole cable.
    pub(crate) fn sum(&self) -> Vector3<f64> {
        self.0.iter().map(|load| load.force).sum()
    }

    /// Makes loads that reach the end of a cable of a length in m those of all cable that is paid
    /// out there.
    pub(crate) fn extend(&mut self, length: f64) {
        self.0.iter_mut().filter(|load| load.to >= length * (1.0 - 1e-12)).for_each(|load| load.to = f64::MAX);
    }

    /// Returns whether all are on the whole cable, however long it is.
    pub(crate) fn are_whole(&self) -> bool {
        self.0.iter().all(|load| load.from == 0.0 && load.to == f64::MAX)
    }
}

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

    fn is_steady(&self, _from: f64, _to: f64) -> bool {
        true
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

impl Acts for LineLoads {
    type InElement = Nothing;
    type AtPoints = Nothing;

    fn dead_force(&self, cable: &Target<'_>) -> Vec<f64> {
        let mut force = vec![0.0; 6 * cable.nodes()];
        for load in &self.0 {
            let mut begin = 0.0;
            for (e, element) in cable.elements.iter().enumerate() {
                load.add_on(begin, element.length, &mut force[6 * e..6 * e + 12]);
                begin += element.length;
            }
        }
        force
    }

    fn add_resultant(&self, cable: &Target<'_>, sum: &mut Vector3<f64>, size: &mut f64) {
        for load in &self.0 {
            let force = (load.to.min(cable.length()) - load.from) * load.force;
            *sum += force;
            *size += force.norm();
        }
    }
}

/// Weights of a load per length on the piece from `a` to `b` (fractions of the length) of an
/// element.
fn partial_weights(length: f64, a: f64, b: f64) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for (x, w) in gauss_legendre(2) {
        let at = shape::position(a + (b - a) * x, length);
        for k in 0..4 {
            sum[k] += w * (b - a) * length * at[k];
        }
    }
    sum
}
