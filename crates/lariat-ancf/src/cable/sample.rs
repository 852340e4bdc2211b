//! Reading a cable: position, slope, tension, curvature and moment at any arc length, and reactions at supports.
//!
//! Tension is `N = EA eps f`, f = |r'|, with eps the Green strain *projected on a linear function inside the element*. Under
//! bending the raw strain of this element oscillates inside it (a bent cubic cannot be inextensible everywhere); the linear
//! projection is what the oscillation leaves unchanged, and converges one order faster (Barlow 1976; superconvergent points).
//! Curvature is `|r' x r''|/|r'|^3`, moment `EI kappa` about the binormal; they are read raw. A rest shape and damping change both:
//! `N = EA (eps - eps_0 + tau eps') f`, `EI (kappa - kappa_0 + tau kappa')`.

use super::Cable;
use crate::axial::moment;
use crate::bending::crumple::Inverse;
use crate::effect::damping::gram_rates;
use crate::effect::rest_shape::NaturalCurvature;
use crate::element::gram::{Control, Six, gram};
use crate::element::shape;
use crate::error::Error;
use crate::integrate::Dynamics;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// What a cable is like at one point.
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
    /// Tension EA eps f in N; negative = compression.
    pub tension: f64,
    /// Curvature vector (r' x r'')/|r'|^3 in 1/m: along the binormal.
    pub curvature: Vector3<f64>,
    /// Bending moment EI kappa in N m: along the binormal. Where |r'| < 1/2, the continued power of the bending rule.
    pub moment: Vector3<f64>,
}

/// What a support does to the cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reaction {
    /// Node number.
    pub node: usize,
    /// Force on the cable in N.
    pub force: Vector3<f64>,
    /// Moment on the cable in N m.
    pub moment: Vector3<f64>,
}

/// A nodal quantity inside element `e`, by the weights of its four node vectors.
fn combine(x: &[f64], e: usize, weights: [f64; 4]) -> Vector3<f64> {
    let n = &x[6 * e..6 * e + 12];
    (0..4).map(|k| weights[k] * Vector3::new(n[3 * k], n[3 * k + 1], n[3 * k + 2])).sum()
}

impl Cable {
    /// State of the cable at an arc length of the unstretched cable, in m.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `arc_length` is not in `[0, length]`.
    pub fn sample(&self, arc_length: f64) -> Result<Sample, Error> {
        self.check_arc_length(arc_length)?;
        let (e, xi) = self.model.locate(arc_length);
        Ok(self.sample_in(e, xi))
    }

    /// State at a local coordinate of an element.
    pub(crate) fn sample_in(&self, e: usize, xi: f64) -> Sample {
        let element = &self.model.elements[e];
        let (q, v) = (self.positions(), self.velocities());
        let position = shape::position(xi, element.length);
        let slope = combine(q, e, shape::slope(xi, element.length));
        let second = combine(q, e, shape::second_derivative(xi, element.length));
        let stretch = slope.norm();
        let d = self.system.elements.control(e, q);
        let green_strain = projected_strain(&gram(&d), xi);
        // a collapsed element has no curvature to speak of
        let curvature = if stretch > 0.0 { slope.cross(&second) / stretch.powi(3) } else { Vector3::zeros() };
        // 1/|r'|^3 as the energy has it: finite in a crumpled element
        let regular = slope.cross(&second) * Inverse::of(stretch * stretch).cube().sqrt();
        Sample {
            position: combine(q, e, position),
            velocity: combine(v, e, position),
            slope,
            green_strain,
            tension: element.section.axial_stiffness
                * (green_strain + self.strain_shift(e, xi, &d))
                * (1.0 + 2.0 * green_strain).max(0.0).sqrt(),
            curvature,
            moment: (regular + self.moment_shift(e, xi, &regular, &slope)) * element.section.bending_stiffness,
        }
    }

    /// What a rest shape and damping add to the strain that makes stress.
    fn strain_shift(&self, e: usize, xi: f64, d: &Control<f64>) -> f64 {
        let effects = self.effects();
        let mut shift = 0.0;
        if effects.rest_shape.is_some() {
            let stretch = self.model.rest(e).0;
            shift -= 0.5 * (stretch * stretch - 1.0);
        }
        if let Some(damping) = &effects.damping {
            let rates = gram_rates(d, &self.system.elements.control(e, self.velocities()));
            // linear in the Gram numbers, and -1/2 at zero
            shift += damping.axial * (projected_strain(&rates, xi) + 0.5);
        }
        shift
    }

    /// What of the bending moment over EI a rest shape takes and damping adds, for the curvature (1/m) of the bending rule.
    fn moment_shift(&self, e: usize, xi: f64, curvature: &Vector3<f64>, slope: &Vector3<f64>) -> Vector3<f64> {
        let (effects, length) = (self.effects(), self.model.elements[e].length);
        let mut shift = Vector3::zeros();
        if effects.rest_shape.is_some() {
            let natural = NaturalCurvature::new(self.model.rest(e).1, length);
            shift += curvature * (natural.moment_factor(curvature.norm(), length) - 1.0);
        }
        if let Some(damping) = effects.damping.filter(|damping| damping.bending > 0.0) {
            let elements = &self.system.elements;
            let (d, v) = (elements.control(e, self.positions()), elements.control(e, self.velocities()));
            let (scalar, vector) = damping.moment_shares(xi, &gram(&d), &gram_rates(&d, &v));
            let rate = combine(self.velocities(), e, shape::second_derivative(xi, length));
            shift +=
                curvature * scalar + slope.cross(&rate) * (vector * Inverse::of(slope.norm_squared()).cube().sqrt());
        }
        shift
    }

    /// Reactions of all supports, by ascending node: what the supports do to the cable now.
    ///
    /// The force is `M q'' - F` on the position; the moment is `t x (M q'' - F)` of the slope.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the present state has no finite acceleration.
    pub fn reactions(&mut self) -> Result<Vec<Reaction>, Error> {
        let n = self.positions().len();
        let mut residual = vec![0.0; n];
        let mut acceleration = self.state.phase.memory.acceleration.clone();
        self.refresh_memory();
        let known = self.state.phase.memory.valid;
        let (mut equations, phase) = self.equations();
        if !known {
            acceleration.resize(n, 0.0);
            let outcome = equations.acceleration(phase.time, &phase.q, &phase.v, &mut acceleration);
            outcome.map_err(|failure| self.step_failed(self.time(), 0.0, failure))?;
        }
        let (mut equations, phase) = self.equations();
        equations.moving_force(phase.time, &phase.q, &phase.v, -1.0, &mut residual);
        let mut inertia = vec![0.0; n];
        equations.system.multiply_mass(&acceleration, &mut inertia);
        let vector = |x: &[f64], y: &[f64]| Vector3::new(x[0] + y[0], x[1] + y[1], x[2] + y[2]);
        Ok(equations
            .model
            .supports
            .iter()
            .map(|&(node, _)| {
                let i = 6 * node;
                let slope = Vector3::from_column_slice(&phase.q[i + 3..i + 6]);
                Reaction {
                    node,
                    force: vector(&residual[i..i + 3], &inertia[i..i + 3]),
                    moment: slope.cross(&vector(&residual[i + 3..i + 6], &inertia[i + 3..i + 6])),
                }
            })
            .collect())
    }
}

/// Green strain at xi, projected on linear functions: `((a.g - 1) + 12 (d.g) (xi - 1/2))/2`.
fn projected_strain(g: &Six<f64>, xi: f64) -> f64 {
    static MOMENTS: LazyLock<[Six<f64>; 2]> = LazyLock::new(|| [moment(|_| 1.0), moment(|x| x - 0.5)]);
    let [a, d] = &*MOMENTS;
    let dot = |x: &Six<f64>| (0..6).map(|i| x[i] * g[i]).sum::<f64>();
    0.5 * ((dot(a) - 1.0) + 12.0 * dot(d) * (xi - 0.5))
}
