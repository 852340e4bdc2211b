//! The shape of a cable between two host steps, for drawing.
//!
//! # Equation
//!
//! `q(f) = (1 - f) q_before + f q_after` of the nodal coordinates, with f the share of a host step
//! that has passed since the last one; between nodes the curve is the cubic of the element.
//!
//! # Validity
//!
//! For display: it lags by one host step.

use bevy_ecs::component::Component;
use lariat_ancf::element::shape::{combine, position};
use lariat_ancf::{Cable, Vector3};
use serde::{Deserialize, Serialize};

/// Keeps the previous nodal coordinates of a cable, so that it can be drawn between host steps.
/// Without it nothing is kept.
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Interpolate {
    before: Vec<f64>,
}

impl Interpolate {
    /// Copies the coordinates before a host step.
    pub(crate) fn copy(&mut self, cable: &Cable) {
        self.before.clear();
        self.before.extend_from_slice(cable.positions());
    }

    /// Returns the nodal coordinates at a fraction of the last host step: 0 = before it, 1 = after
    /// it.
    pub fn positions(&self, cable: &Cable, fraction: f64) -> Vec<f64> {
        let now = cable.positions();
        // nodes were added, or it has not stepped yet
        let before = if self.before.len() == now.len() { &self.before } else { now };
        before.iter().zip(now).map(|(a, b)| a + (b - a) * fraction).collect()
    }

    /// Returns points of the curve in m at a fraction of the last host step: `per_element` for each
    /// element, and the last node.
    pub fn curve(&self, cable: &Cable, fraction: f64, per_element: usize) -> Vec<Vector3<f64>> {
        polyline(cable, &self.positions(cable, fraction), per_element)
    }
}

/// Returns points of a cable's curve in m after the last host step: `per_element` for each element,
/// and the last node.
pub fn curve(cable: &Cable, per_element: usize) -> Vec<Vector3<f64>> {
    polyline(cable, cable.positions(), per_element)
}

fn polyline(cable: &Cable, q: &[f64], per_element: usize) -> Vec<Vector3<f64>> {
    let count = per_element.max(1);
    let mut points = Vec::with_capacity(cable.elements().len() * count + 1);
    for (e, element) in cable.elements().iter().enumerate() {
        for k in 0..count {
            points.push(combine(q, e, &position(k as f64 / count as f64, element.length)));
        }
    }
    points.push(Vector3::from_column_slice(&q[q.len() - 6..q.len() - 3]));
    points
}
