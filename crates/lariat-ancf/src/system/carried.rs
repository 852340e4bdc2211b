//! Tension and moment that an element carries at its ends, by equilibrium.
//!
//! # Equation
//!
//! ```text
//! g = dU/dq - F + M q''        T = +- g_r . t/|t|        m = +- t x g_t        + at the last node of the element, - at its first
//! ```
//!
//! over the coordinates of one element: U its energy, F what acts within it (effects, weight, loads
//! and contacts between its nodes), M its mass. The sum of g over the elements at a node is what
//! acts on the node itself, so T and m are those of the neighbours, of the support and of the load
//! there, and the reaction is their sum.
//!
//! Between two elements of lengths a and b where nothing acts on the node, the force is the mean of
//! what both carry there, with the weights b and a by which errors of the accelerations cancel, for
//! inertia is in both with opposite signs. Within an element in which nothing pulls at a point it
//! is quadratic, with the force along the chord, `dU/dr_2 = int 6 xi (1 - xi) F dxi`, for its
//! bulge:
//!
//! ```text
//! F(xi) = (1 - xi) F_1 + xi F_2 - 5 xi (1 - xi) ((F_1 + F_2)/2 - dU/dr_2)
//! ```
//!
//! and the tension is its part along the tangent. The strain says the same where EA eps resolves
//! it: its error is EA times a power of the element, which in a slack rope exceeds the tension.
//!
//! # Validity
//!
//! At nodes. The nodal forces of a beam have the order of its energy, twice that of its curvature:
//! for a beam under tension that is clamped, the moment is right to 5 % with elements of 3.7
//! sqrt(EI/T), and that of the polynomial with elements of 1.0 sqrt(EI/T) (`tests/end_moment.rs`).
//! Elements at eyes of reels, which change their length, cables that touch cables, and cables with
//! torsion are not read so.
//!
//! # References
//!
//! Wheeler 1974 and Carey 1982 (fluxes from nodal residuals); Tong 1969 (exact nodal values).
//!
//! # Alternatives considered
//!
//! The polynomial of the element at its end, which does not know its equilibrium: at a clamp of a
//! taut cable it shows a tenth of the moment with elements of 37 sqrt(EI/T).

use super::Reading;
use super::jacobian::{control_force, element_force};
use super::project_vector;
use crate::dual::{Dual, constant};
use crate::element::assembly::add_force;
use crate::element::{mass, shape};
use crate::load::moment_on_slope;
use crate::scales::cable::AT_NODE;
use crate::state::ContactMemory;
use nalgebra::Vector3;

/// What an element carries at one of its ends, on the side of larger arc lengths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried {
    /// Slope of the node.
    pub slope: Vector3<f64>,
    /// Force in N, and its part along the slope.
    pub force: Vector3<f64>,
    pub tension: f64,
    /// Moment in N m, about the binormal.
    pub moment: Vector3<f64>,
}

impl Reading<'_> {
    /// Returns what an element carries at both ends, with these nodal accelerations; `None` where
    /// it is not known.
    pub fn carried(
        &self,
        e: usize,
        acceleration: impl Fn(usize) -> f64,
        contacts: &[ContactMemory],
    ) -> Option<[Carried; 2]> {
        if !self.knows_forces() || self.model.is_at_eye(e) {
            return None;
        }
        let element = &self.model.elements[e];
        let mut g = self.inner_force(e, contacts).map(|f| -f);
        let m = mass::consistent(self.model.inertia(element), element.length);
        for (i, g) in g.iter_mut().enumerate() {
            *g += (0..4).map(|k| m[i / 3][k] * acceleration(6 * e + 3 * k + i % 3)).sum::<f64>();
        }
        let vector = |x: &[f64], at: usize| Vector3::from_column_slice(&x[at..at + 3]);
        let end = |k: usize, sign: f64| {
            let slope = vector(self.q, 6 * (e + k) + 3);
            let direction = slope.try_normalize(0.0)?;
            let force = sign * vector(&g, 6 * k);
            let moment = sign * slope.cross(&vector(&g, 6 * k + 3));
            Some(Carried { slope, force, tension: force.dot(&direction), moment })
        };
        Some([end(0, -1.0)?, end(1, 1.0)?])
    }

    /// Returns whether all that acts between the nodes of an element is known, and is distributed
    /// along it.
    pub fn is_evenly_loaded(&self, e: usize, contacts: &[ContactMemory]) -> bool {
        let touches = |touch: &ContactMemory| touch.element as usize == e && touch.force != 0.0;
        if !self.knows_forces() || self.model.is_at_eye(e) || contacts.iter().any(touches) {
            return false;
        }
        let begin = self.begin(e);
        let (end, near) = (begin + self.model.elements[e].length, AT_NODE * self.model.length());
        !self.model.pulled_points().any(|s| s > begin + near && s < end - near)
    }

    /// Returns the arc length in m at which an element begins.
    fn begin(&self, e: usize) -> f64 {
        self.model.elements[..e].iter().map(|element| element.length).sum()
    }

    /// Returns the force in N of the strain of an element along its chord.
    pub fn chord_force(&self, e: usize) -> Vector3<f64> {
        let of = |x: &[f64]| -> [Dual; 12] { core::array::from_fn(|i| constant(x.get(6 * e + i).map_or(0.0, |x| *x))) };
        let (force, scale) = control_force(&self.system.forces, e, [&of(self.q), &of(self.v)]);
        Vector3::from(force[1].map(|f| f.value * scale))
    }

    /// Returns the accelerations of the nodes in the present state; `None` where they are not
    /// known.
    pub fn acceleration(&self, contacts: &[ContactMemory]) -> Option<Vec<f64>> {
        let (model, system) = (self.model, self.system);
        if !self.knows_forces() || !system.feeds.is_empty() {
            return None;
        }
        let mut force = vec![0.0; self.q.len()];
        for e in 0..model.elements.len() {
            let inner = self.inner_force(e, contacts);
            force[6 * e..6 * e + 12].iter_mut().zip(inner).for_each(|(sum, f)| *sum += f);
        }
        self.add_nodal_forces(&mut force);
        let mut acceleration = vec![0.0; self.q.len()];
        for (node, support) in &model.supports {
            acceleration[6 * node..6 * node + 6].copy_from_slice(&support.acceleration(self.time));
        }
        let mut inertia = vec![0.0; self.q.len()];
        system.mass.multiply(system.level, &acceleration, &mut inertia);
        force.iter_mut().zip(&inertia).for_each(|(f, m)| *f -= m);
        project_vector(model, &mut force);
        system.mass.solve(system.level, &mut force);
        acceleration.iter_mut().zip(&force).for_each(|(a, f)| *a += f);
        Some(acceleration)
    }

    /// Returns whether all forces on the elements are forces of their own: those between cables are
    /// known to one of both.
    fn knows_forces(&self) -> bool {
        let effects = &self.model.effects;
        effects.torsion.is_none() && !effects.contact.is_some_and(|contact| contact.itself || contact.cables)
    }

    /// Adds what acts on nodes themselves.
    fn add_nodal_forces(&self, force: &mut [f64]) {
        let (model, near) = (self.model, AT_NODE * self.model.length());
        for (node, s) in model.node_arc_lengths().enumerate() {
            let [position, slope] = [6 * node, 6 * node + 3].map(|at| Vector3::from_column_slice(&self.q[at..at + 3]));
            let mut add = |at: usize, f: Vector3<f64>| (0..3).for_each(|x| force[6 * node + at + x] += f[x]);
            for load in model.loads.iter().filter(|load| (load.arc_length - s).abs() <= near) {
                let factor = load.factor(self.time);
                add(0, factor * load.force);
                if load.moment != Vector3::zeros() {
                    add(3, factor * moment_on_slope(&load.moment, &slope).0);
                }
            }
            for own in model.potentials.list.iter().filter(|own| (own.arc_length - s).abs() <= near) {
                own.potential.iter().for_each(|potential| add(0, -potential.gradient(&position)));
            }
        }
    }

    /// Returns the generalised force on an element of what acts between its nodes.
    fn inner_force(&self, e: usize, contacts: &[ContactMemory]) -> [f64; 12] {
        let (model, length) = (self.model, self.model.elements[e].length);
        let of = |x: &[f64]| -> [Dual; 12] { core::array::from_fn(|i| constant(x[6 * e + i])) };
        let mut force = element_force(&self.system.forces, e, self.time, &of(self.q), &of(self.v)).map(|f| f.value);
        add_force(&mut force, 0, &mass::load_weights(length), &model.weight(&model.elements[e]));
        let begin = self.begin(e);
        for load in model.effects.line_loads.iter().flat_map(|loads| &loads.0) {
            load.add_on(begin, length, &mut force);
        }
        let inside = |s: f64| {
            let near = AT_NODE * model.length();
            (s > begin + near && s < begin + length - near).then(|| (s - begin) / length)
        };
        let at = |xi: f64, weights: fn(f64, f64) -> [f64; 4]| {
            let weights = weights(xi, length);
            (shape::combine(self.q, e, &weights), weights)
        };
        for load in &model.loads {
            let (Some(xi), factor) = (inside(load.arc_length), load.factor(self.time)) else { continue };
            add_force(&mut force, 0, &shape::position(xi, length), &(factor * load.force));
            if load.moment != Vector3::zeros() {
                let (slope, weights) = at(xi, shape::slope);
                add_force(&mut force, 0, &weights, &(factor * moment_on_slope(&load.moment, &slope).0));
            }
        }
        for own in &model.potentials.list {
            let (Some(xi), Some(potential)) = (inside(own.arc_length), &own.potential) else { continue };
            let (position, weights) = at(xi, shape::position);
            add_force(&mut force, 0, &weights, &-potential.gradient(&position));
        }
        for touch in contacts.iter().filter(|touch| touch.element as usize == e) {
            let weights = shape::position(touch.xi, length);
            add_force(&mut force, 0, &weights, &touch.force_on_cable());
        }
        force
    }
}
