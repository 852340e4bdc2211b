//! Reading a cable: position, slope, tension, curvature and moment at any arc length.
//!
//! # Equation
//!
//! Tension is `N = EA eps f`, f = |r'|, with eps the Green strain *projected on a linear function
//! inside the element*. Under bending the raw strain of this element oscillates inside it (a bent
//! cubic cannot be inextensible everywhere); the linear projection is what the oscillation leaves
//! unchanged, and converges one order faster. Curvature is `|r' x r''|/|r'|^3`, moment `EI kappa`
//! about the binormal; the curvature is read raw. A rest shape and damping change both: `N = EA
//! (eps - eps_0 + tau eps') f`, `EI (kappa - kappa_0 + tau kappa')`.
//!
//! What a force along the tangent is, the equilibrium of the nodes says better than the strain
//! (`system/carried.rs`): the force is read at both nodes of an element, with its bulge between
//! them, and its part along the tangent is the tension. EA eps f is read where something touches or
//! pulls the element between its nodes, at the eyes of reels, with torsion, and with contact
//! between cables.
//!
//! There N jumps at the nodes between elements by its error, which is of first order under bending,
//! antisymmetric about the middle of each element, and in proportion to the element's length. The
//! tension that is read is averaged there, with weights that make this error vanish, `(h_2 N_1 +
//! h_1 N_2)/(h_1 + h_2)`, and what is added to reach the averages is quadratic in the element and
//! vanishes in its middle, which is right already; at an end, and at a node where the tension
//! itself jumps (a support, a point load, another section), it is the opposite of what is added at
//! the other node. That makes it second order (`tests/tension.rs`); the jump is given as its
//! uncertainty.
//!
//! The tension that is read is the force along the tangent. From it N differs by `M kappa`, for `EI
//! kappa^2/2` is an energy of a curvature per deformed length (with rule T1, of |r''|, by `-M
//! kappa`), so that is taken off. At an end and at such a node itself, tension and moment are those
//! of equilibrium (`system/carried.rs`), which with the other side of the node make the
//! [reaction](Cable::reactions). What is added to the moment beside them to reach it is `P_2(2 xi -
//! 1)` times a linear function, which vanishes at the Gauss points. Where equilibrium is not known,
//! all is as beside these nodes, and the moment is raw. Where a load or a held point bends the
//! cable within less than an element, the moment there is that of the elastica
//! (`cable/carried.rs`).
//!
//! # References
//!
//! Barlow 1976 (superconvergent points). Averages at nodes: Hinton and Campbell 1974.

use super::Cable;
use crate::effect::acts::SampledPoint;
use crate::element::bending::regularisation::RegularisedPower;
use crate::element::shape::{self, combine};
use crate::element::variable_length::feed_weights;
use crate::error::Error;
use crate::rule::BendingRule;
use crate::scales::cable::AT_NODE;
use crate::system::{Carried, NodeTension, Pull, Reading, missing_at_ends};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A cable at one point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Sample {
    /// Position in m.
    pub position: Vector3<f64>,
    /// Velocity in m/s.
    pub velocity: Vector3<f64>,
    /// Slope vector dr/ds; its length is the stretch.
    pub slope: Vector3<f64>,
    /// Green strain (r'.r' - 1)/2, projected on linear functions inside the element.
    pub green_strain: f64,
    /// Tension in N, the force along the tangent, by the equilibrium of the nodes; at one that is
    /// held or loaded, where both sides differ, on the side of smaller arc lengths. Where an
    /// element is touched or pulled between its nodes, and with torsion or contact between cables,
    /// `EA eps f - M kappa`, averaged at nodes. Negative = compression.
    pub tension: f64,
    /// Curvature vector (r' x r'')/|r'|^3 in 1/m: along the binormal.
    pub curvature: Vector3<f64>,
    /// Bending moment EI kappa in N m: along the binormal, and by equilibrium beside nodes that are
    /// held, loaded or ends; of an elastica under the forces there, where a node that is loaded or
    /// held, and free to turn, has elements longer than what bends there. Where |r'| < 1/2, the
    /// continued power of the bending rule.
    pub moment: Vector3<f64>,
    /// Uncertainty of the tension in N: what the strain misses to that of equilibrium; where the
    /// strain is read, the larger of its jumps at the nodes of the element before averaging; all of
    /// the tension where nothing can judge.
    pub tension_uncertainty: f64,
}

impl Cable {
    /// Returns the state of the cable at an arc length of the unstretched cable, in m.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `arc_length` is not in `[0, length]`, by more than 1e-9 of the
    /// length.
    pub fn sample(&self, arc_length: f64) -> Result<Sample, Error> {
        let (e, xi) = self.model.locate(self.on_cable(arc_length)?);
        Ok(self.smooth_in(e, xi))
    }

    /// Returns the state at a local coordinate of an element, with the tension averaged at nodes,
    /// and tension and moment by equilibrium at those that are held, loaded or ends.
    pub(crate) fn smooth_in(&self, e: usize, xi: f64) -> Sample {
        let raw = self.sample_in(e, xi);
        let by_equilibrium = [e, e + 1].map(|node| self.is_read_by_equilibrium(node, self.arc_length_of(node)));
        let is_exact = by_equilibrium.contains(&true);
        let own = if is_exact { self.carried(e) } else { self.carried_nearly(e) };
        let mut carried = own.filter(|_| is_exact);
        if let Some(known) = carried {
            let layers = [0, 1].map(|k| self.layer_moment(e + k, &known, k == 1).filter(|_| by_equilibrium[k]));
            let both = carried.iter_mut().flatten().zip(layers);
            both.for_each(|(side, layer)| side.moment = layer.unwrap_or(side.moment));
        }
        let moment = carried.map_or(raw.moment, |carried| raw.moment + self.missing_moment(e, xi, carried));
        let near = AT_NODE * self.length() / self.elements()[e].length;
        let node = [xi, 1.0 - xi].into_iter().position(|distance| distance <= near);
        if let (Some(carried), Some(k)) = (&carried, node.filter(|&k| by_equilibrium[k])) {
            let tension = carried[k].tension;
            return Sample { tension, tension_uncertainty: (tension - raw.tension).abs(), moment, ..raw };
        }
        let strained = raw.tension + self.pull_of_bending(&moment, &raw.curvature);
        let force = own.and_then(|own| self.force_in(e, xi, own));
        if let Some((force, tangent)) = force.zip(raw.slope.try_normalize(0.0)) {
            let tension = force.dot(&tangent);
            return Sample { tension, tension_uncertainty: (tension - strained).abs(), moment, ..raw };
        }
        let (from, to) = (self.node_tension(e), self.node_tension(e + 1));
        let jumps = from.into_iter().chain(to).map(|node| node.jump);
        let Some(tension_uncertainty) = jumps.reduce(f64::max) else {
            return Sample { tension: strained, moment, ..raw };
        };
        let [start, end] = missing_at_ends(from, to);
        let missing = (1.0 - xi) * (1.0 - 2.0 * xi) * start + xi * (2.0 * xi - 1.0) * end;
        Sample { tension: strained + missing, tension_uncertainty, moment, ..raw }
    }

    /// Returns the force in N at a local coordinate of an element by the equilibrium of its nodes;
    /// `None` where it is not known.
    fn force_in(&self, e: usize, xi: f64, own: [Carried; 2]) -> Option<Vector3<f64>> {
        let (reading, contacts) = (self.reading(), &self.snapshot.state.memory.contacts[..]);
        if !reading.is_evenly_loaded(e, contacts) {
            return None;
        }
        let elements = self.elements();
        let at = |k: usize| {
            if self.is_read_by_equilibrium(e + k, self.arc_length_of(e + k)) {
                return Some(own[k].force);
            }
            let other = if k == 0 { e - 1 } else { e + 1 };
            if !reading.is_evenly_loaded(other, contacts) {
                return None;
            }
            let (a, b) = (elements[e].length, elements[other].length);
            Some((own[k].force * b + self.carried_nearly(other)?[1 - k].force * a) / (a + b))
        };
        let (from, to) = (at(0)?, at(1)?);
        let bulge = (from + to) * 0.5 - reading.chord_force(e);
        Some(from * (1.0 - xi) + to * xi - bulge * (5.0 * xi * (1.0 - xi)))
    }

    /// Returns by how much the force in N along the tangent is more than EA eps f, by the moment in
    /// N m and the curvature in 1/m.
    fn pull_of_bending(&self, moment: &Vector3<f64>, curvature: &Vector3<f64>) -> f64 {
        let product = moment.dot(curvature);
        match self.model.rule.bending {
            BendingRule::T1 => product,
            _ => -product,
        }
    }

    /// Returns what the moment of an element that is read raw misses to what it carries.
    fn missing_moment(&self, e: usize, xi: f64, carried: [Carried; 2]) -> Vector3<f64> {
        let limp = self.model.rule.bending == BendingRule::None;
        if limp || self.model.elements[e].section.bending_stiffness == 0.0 {
            return Vector3::zeros();
        }
        let [start, end] = [0, 1].map(|k| carried[k].moment - self.sample_in(e, k as f64).moment);
        // zero at both Gauss points, where the curvature of a cubic is right to a higher order
        (1.0 - 6.0 * xi * (1.0 - xi)) * ((1.0 - xi) * start + xi * end)
    }

    /// Returns the present state, to be read.
    pub(crate) fn reading(&self) -> Reading<'_> {
        let (q, v) = (self.positions(), self.velocities());
        let twists = &self.snapshot.state.memory.torsion;
        Reading { model: &self.model, system: &self.system, q, v, time: self.time(), twists }
    }

    /// Returns it at other coordinates, at rest.
    pub(crate) fn reading_at<'a>(&'a self, q: &'a [f64]) -> Reading<'a> {
        Reading { q, v: &[], ..self.reading() }
    }

    /// Returns the tension at a node between two elements, if it is continuous there.
    fn node_tension(&self, node: usize) -> Option<NodeTension> {
        if node == 0 || node == self.elements().len() {
            return None;
        }
        let reading = self.reading();
        reading.at_node(node, self.arc_length_of(node), reading.ends(node - 1)[1], reading.ends(node)[0])
    }

    /// Returns the position at an arc length in m, which is on the cable.
    pub(crate) fn position_at(&self, arc_length: f64) -> Vector3<f64> {
        let (e, xi) = self.model.locate(arc_length);
        combine(self.positions(), e, &shape::position(xi, self.model.elements[e].length))
    }

    /// Returns the state at a local coordinate of an element.
    pub(crate) fn sample_in(&self, e: usize, xi: f64) -> Sample {
        let element = &self.model.elements[e];
        let length = element.length;
        let (q, v) = (self.positions(), self.velocities());
        let position = shape::position(xi, length);
        let slope = combine(q, e, &shape::slope(xi, length));
        let second = combine(q, e, &shape::second_derivative(xi, length));
        let stretch = slope.norm();
        let reading = self.reading();
        let at = reading.state(e, true);
        let Pull { tension, green_strain, .. } = reading.pull(e, xi, &at);
        let mut velocity = combine(v, e, &position);
        for feed in self.system.feeds.list.iter().filter(|feed| feed.side.element(self.elements().len()) == e) {
            let extent = feed.extent;
            let local = feed.side.gather(q);
            velocity += extent.rate * combine(&local, 0, &feed_weights(feed.side.local(xi), length)[0]);
        }
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
            vector_rate: slope.cross(&combine(v, e, &shape::second_derivative(xi, length))),
            power: RegularisedPower::new(slope.norm_squared()).cube().sqrt(),
        };
        Sample {
            position: combine(q, e, &position),
            velocity,
            slope,
            green_strain,
            tension,
            tension_uncertainty: tension.abs(),
            curvature,
            moment: (regular + self.system.forces.curvature_of_effects(&sampled)) * element.section.bending_stiffness,
        }
    }

    /// Returns the arc length in m where the tension is largest, and the tension there in N: read
    /// at both ends of every element, between which it is linear but for the stretch. A point load
    /// inside an element makes the reading overshoot at its ends: place a node there.
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
