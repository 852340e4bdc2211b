//! Reading a cable: position, slope, tension, curvature and moment at any arc length.
//!
//! # Equation
//!
//! Tension is `N = EA eps f`, f = |r'|, with eps the Green strain *projected on a linear function inside the element*. Under bending the
//! raw strain of this element oscillates inside it (a bent cubic cannot be inextensible everywhere); the linear projection is what the
//! oscillation leaves unchanged, and converges one order faster. Curvature is `|r' x r''|/|r'|^3`, moment `EI kappa` about the binormal;
//! they are read raw. A rest shape and damping change both: `N = EA (eps - eps_0 + tau eps') f`, `EI (kappa - kappa_0 + tau kappa')`.
//!
//! At the nodes between elements N jumps by its error, which is of first order under bending, antisymmetric about the middle of each element,
//! and in proportion to the element's length. The tension that is read is averaged there, with weights that make this error vanish,
//! `(h_2 N_1 + h_1 N_2)/(h_1 + h_2)`, and what is added to reach the averages is quadratic in the element and vanishes in its middle, which is
//! right already; at an end, and at a node where the tension itself jumps (a support, a point load, another section), it is the opposite of
//! what is added at the other node. That makes it second order (`tests/tension.rs`); the jump is given as its uncertainty.
//!
//! # References
//!
//! Barlow 1976 (superconvergent points). Averages at nodes: Hinton and Campbell 1974.

use super::Cable;
use crate::axial::projected;
use crate::bending::regularisation::RegularisedPower;
use crate::effect::acts::SampledPoint;
use crate::element::flow::flow_weights;
use crate::element::gram::gram_rates;
use crate::element::shape;
use crate::error::Error;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A cable at one point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Position in m.
    pub position: Vector3<f64>,
    /// Velocity in m/s.
    pub velocity: Vector3<f64>,
    /// Slope vector dr/ds; its length is the stretch.
    pub slope: Vector3<f64>,
    /// Green strain (r'.r' - 1)/2, projected on linear functions inside the element.
    pub green_strain: f64,
    /// Tension EA eps f in N, averaged at nodes; negative = compression.
    pub tension: f64,
    /// Curvature vector (r' x r'')/|r'|^3 in 1/m: along the binormal.
    pub curvature: Vector3<f64>,
    /// Bending moment EI kappa in N m: along the binormal. Where |r'| < 1/2, the continued power of the bending rule.
    pub moment: Vector3<f64>,
    /// Uncertainty of the tension in N: the larger of its jumps at the nodes of the element before averaging; all of the tension where no
    /// node can judge.
    pub tension_uncertainty: f64,
}

/// Tension at a node in N: what the elements before and behind it miss to the average, and the jump between them.
#[derive(Clone, Copy)]
struct NodeTension {
    missing: [f64; 2],
    jump: f64,
}

/// A nodal quantity inside element `e`, by the weights of its four node vectors.
pub(in crate::cable) fn combine(x: &[f64], e: usize, weights: [f64; 4]) -> Vector3<f64> {
    let n = &x[6 * e..6 * e + 12];
    (0..4).map(|k| weights[k] * Vector3::new(n[3 * k], n[3 * k + 1], n[3 * k + 2])).sum()
}

impl Cable {
    /// Returns the state of the cable at an arc length of the unstretched cable, in m.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `arc_length` is not in `[0, length]`.
    pub fn sample(&self, arc_length: f64) -> Result<Sample, Error> {
        self.check_arc_length(arc_length)?;
        let (e, xi) = self.model.locate(arc_length);
        Ok(self.smooth_in(e, xi))
    }

    /// Returns the state at a local coordinate of an element, with the tension averaged at nodes.
    pub(crate) fn smooth_in(&self, e: usize, xi: f64) -> Sample {
        let raw = self.sample_in(e, xi);
        let (from, to) = (self.node_tension(e), self.node_tension(e + 1));
        let jumps = from.into_iter().chain(to).map(|node| node.jump);
        let Some(tension_uncertainty) = jumps.reduce(f64::max) else { return raw };
        let [start, end] = [from.map(|node| node.missing[1]), to.map(|node| node.missing[0])];
        let start = start.or(end.map(|end| -end)).unwrap_or(0.0);
        let end = end.unwrap_or(-start);
        let missing = (1.0 - xi) * (1.0 - 2.0 * xi) * start + xi * (2.0 * xi - 1.0) * end;
        Sample { tension: raw.tension + missing, tension_uncertainty, ..raw }
    }

    /// Returns the tension at a node between two elements, if it is continuous there.
    fn node_tension(&self, node: usize) -> Option<NodeTension> {
        if node == 0 || node == self.elements().len() || !self.is_smooth_at(node) {
            return None;
        }
        let [a, b] = [node - 1, node].map(|e| self.elements()[e].length);
        let (before, behind) = (self.sample_in(node - 1, 1.0).tension, self.sample_in(node, 0.0).tension);
        let average = (b * before + a * behind) / (a + b);
        Some(NodeTension { missing: [average - before, average - behind], jump: (before - behind).abs() })
    }

    /// Returns the position at an arc length in m, which is on the cable.
    pub(crate) fn position_at(&self, arc_length: f64) -> Vector3<f64> {
        let (e, xi) = self.model.locate(arc_length);
        combine(self.positions(), e, shape::position(xi, self.model.elements[e].length))
    }

    /// Returns the state at a local coordinate of an element.
    pub(crate) fn sample_in(&self, e: usize, xi: f64) -> Sample {
        let element = &self.model.elements[e];
        let length = element.length;
        let (q, v) = (self.positions(), self.velocities());
        let position = shape::position(xi, length);
        let slope = combine(q, e, shape::slope(xi, length));
        let second = combine(q, e, shape::second_derivative(xi, length));
        let stretch = slope.norm();
        let forces = &self.system.forces;
        let mut at = forces.elements.gram_state(e, q, v);
        let mut velocity = combine(v, e, position);
        for flow in self.system.flows.list.iter().filter(|flow| flow.side.element(self.elements().len()) == e) {
            let extent = flow.extent;
            let local = flow.side.gather(q);
            velocity += extent.rate * combine(&local, 0, flow_weights(flow.side.local(xi), length)[0]);
            // the control vector of the chord changes with the length, too
            let d = forces.elements.control(e, q);
            let chord = d[1].map(|x| -x * extent.rate / length);
            let change = gram_rates(&d, &[[0.0; 3], chord, [0.0; 3]]);
            at.rates.iter_mut().flatten().zip(change).for_each(|(rate, change)| *rate += change);
        }
        let green_strain = projected::strain(&at.g, xi);
        // a collapsed element has no curvature
        let curvature = if stretch > 0.0 { slope.cross(&second) / stretch.powi(3) } else { Vector3::zeros() };
        // with 1/|r'|^3 as the energy has it: finite in a crumpled element
        let regular = slope.cross(&second) * RegularisedPower::new(stretch * stretch).cube().sqrt();
        let sampled = SampledPoint {
            element: e,
            xi,
            length,
            at,
            curvature: regular,
            vector_rate: slope.cross(&combine(v, e, shape::second_derivative(xi, length))),
            power: RegularisedPower::new(slope.norm_squared()).cube().sqrt(),
        };
        let stress = (green_strain + forces.strain_of_effects(&sampled)) * (1.0 + 2.0 * green_strain).max(0.0).sqrt();
        let tension = element.section.axial_stiffness * stress;
        Sample {
            position: combine(q, e, position),
            velocity,
            slope,
            green_strain,
            tension,
            tension_uncertainty: tension.abs(),
            curvature,
            moment: (regular + forces.curvature_of_effects(&sampled)) * element.section.bending_stiffness,
        }
    }

    /// Returns the arc length in m where the tension is largest, and the tension there in N: read at both ends of every element, between
    /// which it is linear but for the stretch. A point load inside an element makes the reading overshoot at its ends: place a node there.
    pub fn peak_tension(&self) -> (f64, f64) {
        let mut peak = (0.0, f64::NEG_INFINITY);
        let mut from = 0.0;
        for (e, element) in self.elements().iter().enumerate() {
            for xi in [0.0, 1.0] {
                let tension = self.smooth_in(e, xi).tension;
                if tension > peak.1 {
                    peak = (from + xi * element.length, tension);
                }
            }
            from += element.length;
        }
        peak
    }
}
