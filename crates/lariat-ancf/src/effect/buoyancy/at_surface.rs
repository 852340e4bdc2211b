//! Buoyancy at a free surface: what takes the buoyancy from what is dry, and the inertia of a wave.
//!
//! # Equation
//!
//! ```text
//! f = (1 - s) rho_f A_d g + (1 + C_a) s rho_f A_d u'
//! ```
//!
//! s is the wet share of the [section](crate::water::wet), a circle of the area A_d, g gravity as a
//! vector: added to the weight of the wholly immersed cable, the first term makes that in air. It
//! is integrated at three Gauss points. Over a step of the discrete gradient 1 - s is its mean over
//! the rise of the point, on the surface at the middle of the step: in water at rest the work of
//! this force is then the change of its potential, at any step. u' is that of the wave at the
//! middle.
//!
//! # Validity
//!
//! Elements that are short beside the piece of cable that goes through the surface: three points
//! see no more of it. Below the surface the first term is zero, to the bit. Statics are in water
//! without a wave, and follow the motion to rest, for the cable's energy does not know this
//! potential; the work of it counts as that of the effect.
//!
//! # References
//!
//! Archimedes; Morison et al. 1950 for the inertia (1 + C_a) rho A u'.
//!
//! # Alternatives considered
//!
//! All of buoyancy at Gauss points, with none in the weight: rounding in every step of cables that
//! are deep below.

use crate::dual::Dual;
use crate::effect::Target;
use crate::effect::acts::{ForceInput, PointForce, StepInput};
use crate::element::assembly::add_tangent;
use crate::element::shape;
use crate::error::{Error, require};
use crate::linalg::BlockTridiagonal;
use crate::quadrature::gauss_legendre;
use crate::scales::SAME;
use crate::scales::effect::POINTS;
use crate::water::{Sea, Surface, wet};
use core::f64::consts::PI;
use fearless_simd::Level;
use nalgebra::{Matrix3, Vector3};

/// Checks a surface, and that it is across gravity.
pub(super) fn check(surface: &Surface, cable: &Target<'_>) -> Result<(), Error> {
    surface.check()?;
    let (up, down) = (surface.up / surface.up.norm(), cable.gravity.norm());
    let across = (cable.gravity - up * up.dot(&cable.gravity)).norm();
    let sine = if down > 0.0 { across / down } else { 0.0 };
    require("sine of the angle between gravity and up of a free surface", sine, sine <= SAME, "0")
}

/// Buoyancy at the surface of all elements, as the evaluation needs it.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceTable {
    surface: Surface,
    sea: Sea,
    gravity: Vector3<f64>,
    inertia: f64,
    points: Vec<(f64, f64)>,
    /// Length in m, displaced mass per length in kg/m, radius in m of the displaced area.
    elements: Vec<[f64; 3]>,
}

/// A Gauss point: its shape functions, its weight in m, and what is displaced there.
struct Point {
    shape: [f64; 4],
    weight: f64,
    mass: f64,
    radius: f64,
}

impl Point {
    fn combine(&self, x: &[f64]) -> Vector3<f64> {
        Vector3::from_fn(|c, _| (0..4).map(|k| self.shape[k] * x[3 * k + c]).sum())
    }
}

impl SurfaceTable {
    /// Makes the table for a density of the water in kg/m^3, a coefficient of added mass, and the
    /// displaced area in m^2 if it is not that of the sections.
    pub fn new(surface: &Surface, (density, added_mass, area): (f64, f64, Option<f64>), cable: &Target<'_>) -> Self {
        let elements = cable.elements.iter().map(|element| {
            let area = area.or(element.section.outer_area).unwrap_or(0.0);
            [element.length, density * area, (area / PI).sqrt()]
        });
        SurfaceTable {
            surface: *surface,
            sea: surface.sea(),
            gravity: cable.gravity,
            inertia: 1.0 + added_mass,
            points: gauss_legendre(POINTS),
            elements: elements.collect(),
        }
    }

    fn point(&self, element: usize, k: usize) -> Point {
        let ([length, mass, radius], (xi, weight)) = (self.elements[element], self.points[k]);
        Point { shape: shape::position(xi, length), weight: weight * length, mass, radius }
    }

    /// Returns the force per length in N/m at a position and a time, and its derivative by the
    /// depth, without that of the wave's inertia.
    fn force(&self, point: &Point, time: f64, position: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let at = self.sea.at(time, position);
        let s = at.depth / point.radius;
        let share = wet::share(s);
        let weight = self.gravity * point.mass;
        let inertia = at.acceleration * (self.inertia * share * point.mass);
        (weight * (1.0 - share) + inertia, weight * (-wet::slope(s) / point.radius))
    }

    /// Returns the mean force per length over a step that moves a point by `change` (m) about a
    /// position, and its derivative by the depth at the end.
    fn mean_force(
        &self,
        point: &Point,
        time: f64,
        middle: &Vector3<f64>,
        change: &Vector3<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let at = self.sea.at(time, middle);
        let (s, half) = (at.depth / point.radius, 0.5 * self.sea.up().dot(change) / point.radius);
        let [dry, slope] = wet::mean_dry(s + half, s - half);
        let weight = self.gravity * point.mass;
        let inertia = at.acceleration * (self.inertia * wet::share(s) * point.mass);
        (weight * dry + inertia, weight * (slope / point.radius))
    }

    /// Adds forces and blocks of the elements: `force` returns force per length, and its derivative
    /// by the depth, of a Gauss point.
    fn assemble(
        &self,
        out: &mut [f64],
        mut matrix: Option<&mut BlockTridiagonal>,
        (scale, of_matrix): (f64, f64),
        force: impl Fn(&Point, usize) -> (Vector3<f64>, Vector3<f64>),
    ) {
        let up = self.sea.up();
        for element in 0..self.elements.len() {
            for k in 0..self.points.len() {
                let point = self.point(element, k);
                let (force, by_depth) = force(&point, element);
                for (i, f) in out[6 * element..6 * element + 12].iter_mut().enumerate() {
                    *f += point.shape[i / 3] * force[i % 3] * (scale * point.weight);
                }
                if let Some(matrix) = matrix.as_deref_mut()
                    && by_depth != Vector3::zeros()
                {
                    // depth falls as the point rises
                    let block: Matrix3<f64> = by_depth * up.transpose() * (of_matrix * point.weight);
                    add_tangent(matrix, element, &point.shape, &((block + block.transpose()) * 0.5));
                }
            }
        }
    }
}

impl PointForce for SurfaceTable {
    fn add(&mut self, _: Level, input: ForceInput<'_>, out: &mut [f64], matrix: Option<&mut BlockTridiagonal>) {
        let ForceInput { time, q, scale, .. } = input;
        self.assemble(out, matrix, (scale, scale), |point, element| {
            self.force(point, time, &point.combine(&q[6 * element..6 * element + 12]))
        });
    }

    fn add_over_step(&mut self, _: Level, step: StepInput<'_>, out: &mut [f64], matrix: Option<&mut BlockTridiagonal>) {
        let StepInput { time, middle, velocity, h, leg, .. } = step;
        self.assemble(out, matrix, (1.0, leg.b * h * h), |point, element| {
            let nodes = 6 * element..6 * element + 12;
            let change = point.combine(&velocity[nodes.clone()]) * h;
            self.mean_force(point, time, &point.combine(&middle[nodes]), &change)
        });
    }

    fn add_dual(&self, element: usize, time: f64, q: &[Dual; 12], _: &[Dual; 12], out: &mut [Dual; 12]) {
        for k in 0..self.points.len() {
            let point = self.point(element, k);
            let mix = |part: fn(&Dual) -> f64| point.combine(&q.each_ref().map(part));
            let (position, way) = (mix(|x| x.value), mix(|x| x.slope));
            let (force, by_depth) = self.force(&point, time, &position);
            let slope = by_depth * -self.sea.up().dot(&way);
            for i in 0..12 {
                let f = Dual { value: force[i % 3], slope: slope[i % 3] };
                out[i] = out[i] + f * (point.shape[i / 3] * point.weight);
            }
        }
    }

    fn set_length(&mut self, element: usize, length: f64) {
        self.elements[element][0] = length;
    }

    /// Returns true: the cable's energy does not know the potential.
    fn drives(&self) -> bool {
        true
    }

    fn hold(&mut self, _: f64) {
        self.sea = Surface { wave: None, ..self.surface }.sea();
    }
}
