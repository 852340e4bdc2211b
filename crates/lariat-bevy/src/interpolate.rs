//! Where a cable is between two steps, for drawing.
//!
//! `q(f) = (1 - f) q_before + f q_after` of the nodal coordinates, f the share of a host step that has passed since the last one; the curve
//! is the element's own cubic. *Validity.* For the eye: it lags by one host step.

use crate::cable::Cable;
use bevy_ecs::component::Component;
use lariat_ancf::Vector3;

/// Lets a cable be drawn between steps; absent, nothing is remembered.
#[derive(Component, Clone, Debug, Default)]
pub struct Interpolate {
    before: Vec<f64>,
}

impl Interpolate {
    pub(crate) fn remember(&mut self, cable: &Cable) {
        self.before.clear();
        self.before.extend_from_slice(cable.positions());
    }

    /// Nodal coordinates at a fraction of the last step: 0 = before it, 1 = after it.
    pub fn positions(&self, cable: &Cable, fraction: f64) -> Vec<f64> {
        let now = cable.positions();
        // nodes were added, or it has not stepped yet
        let before = if self.before.len() == now.len() { &self.before } else { now };
        before.iter().zip(now).map(|(a, b)| a + (b - a) * fraction).collect()
    }

    /// Points of the curve in m at a fraction of the last step, `per_element` to an element and the last node.
    pub fn curve(&self, cable: &Cable, fraction: f64, per_element: usize) -> Vec<Vector3<f64>> {
        curve(cable, &self.positions(cable, fraction), per_element)
    }
}

impl Cable {
    /// Points of the curve in m after the last step, `per_element` to an element and the last node: a polyline to draw.
    pub fn curve(&self, per_element: usize) -> Vec<Vector3<f64>> {
        curve(self, self.positions(), per_element)
    }
}

fn curve(cable: &Cable, q: &[f64], per_element: usize) -> Vec<Vector3<f64>> {
    let Ok(core) = cable.core() else { return Vec::new() };
    let vector = |i: usize| Vector3::new(q[i], q[i + 1], q[i + 2]);
    let count = per_element.max(1);
    let mut points = Vec::with_capacity(core.elements().len() * count + 1);
    for (e, element) in core.elements().iter().enumerate() {
        for k in 0..count {
            let weights = lariat_ancf::element::shape::position(k as f64 / count as f64, element.length);
            points.push((0..4).map(|j| weights[j] * vector(6 * e + 3 * j)).sum());
        }
    }
    points.push(vector(q.len() - 6));
    points
}
