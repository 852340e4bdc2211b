//! Drag and forces per length on the element at an eye.
//!
//! # Equation
//!
//! The velocity of the material is a cubic like that of the nodes, because `w = S_l e` is one:
//!
//! ```text
//! v = S e' + l' w = S (e' + l' e_w)        e_w = (0, 0, -t, -r'') at the eye
//! ```
//!
//! An effect that is given the nodal velocities `e' + l' e_w` acts on the velocity of the material.
//! With its force f per length and `F = int S^T f dy`, virtual work `int f . (S de + w dl) dy` says
//! how it acts on the length, and what its power is:
//!
//! ```text
//! Q = e_w . F        P = F . (e' + l' e_w) = int f . v dy        B becomes B - Q
//! ```
//!
//! # Validity
//!
//! Exact for the discretised cable, with the Gauss points of the effect, forces per length of the
//! user's own among them. Stock is neither dragged nor loaded. Added mass is refused: it acts in
//! all directions alike, and material that comes out along itself would have to set fluid in
//! motion.
//!
//! # References
//!
//! Own derivation, checked against the power of the force along the path of its points
//! (tests/reels/fluid.rs).

use super::{FeedElement, Feeds};
use crate::dual::{Dual, constant};
use crate::effect::acts::{ForceInput, PointForce};
use crate::element::shape;
use crate::element::variable_length::{Extent, dot};
use crate::model::Model;
use crate::state::State;
use crate::system::StepVectors;
use crate::system::System;

/// Returns e_w of coordinates seen from the far node.
pub(super) fn drift(q: &[f64; 12], length: f64) -> [f64; 12] {
    let bend = shape::second_derivative(1.0, length);
    core::array::from_fn(|i| match i {
        0..6 => 0.0,
        6..9 => -q[i + 3],
        _ => -(0..4).map(|k| bend[k] * q[3 * k + i - 9]).sum::<f64>(),
    })
}

impl FeedElement {
    /// Makes of the velocities of a cable those of the material of this element.
    fn add_drift(&self, extent: &Extent, q: &[f64], v: &mut [f64]) {
        let own = drift(&self.side.gather(q), extent.length);
        self.side.add(&own.map(|x| extent.rate * x), v);
    }

    /// Returns the force on the length in N of forces on the nodes of a cable with coordinates `q`.
    fn on_length(&self, length: f64, q: &[f64], force: &[f64]) -> f64 {
        dot(&drift(&self.side.gather(q), length), &self.side.gather(force))
    }

    /// Returns the constant force per length on the element in N/m, its weight among them.
    pub(super) fn dead(&self, model: &Model) -> [f64; 3] {
        (model.weight(&model.elements[self.element(model)]) + model.line_force()).into()
    }
}

impl Feeds {
    /// Returns an evaluation with velocities as internal damping sees them, and one with those of
    /// the material.
    pub fn velocities<'a>(&'a mut self, at: ForceInput<'a>) -> [ForceInput<'a>; 2] {
        if self.list.is_empty() || at.v.is_empty() {
            return [at; 2];
        }
        let [mut strain, mut material] = core::mem::take(&mut self.velocities);
        for v in [&mut strain, &mut material] {
            v.clear();
            v.extend_from_slice(at.v);
        }
        self.strain_velocity(at.time, at.q, &mut strain);
        self.list.iter().for_each(|feed| feed.add_drift(&feed.at(at.time), at.q, &mut material));
        self.velocities = [strain, material];
        let [strain, material] = &self.velocities;
        [strain, material].map(|v| ForceInput { v, ..at })
    }

    /// Makes of the mean velocities of a step of the discrete gradient those of the material; its
    /// lengths are those of the present iterate from now on if the equations are made linear about
    /// it.
    pub fn add_drift_over_step(&mut self, state: &State, b: &mut StepVectors, linearise: bool) {
        let [middle, velocity, middle_before, velocity_before] = &mut b.means;
        for feed in &mut self.list {
            if linearise {
                feed.linearised = feed.extent.acceleration;
            }
            let acceleration = if feed.law.is_some() { feed.linearised } else { feed.extent.acceleration };
            let about = FeedElement { extent: Extent { acceleration, ..feed.extent }, ..*feed };
            feed.add_drift(&feed.over(state.time, b.h).0, middle, velocity);
            feed.add_drift(&about.over(state.time, b.h).0, middle_before, velocity_before);
        }
    }

    /// Notes the forces on the lengths of mean forces on the nodes over a step of the discrete
    /// gradient from `time` of length `h` (s), in whose middle the coordinates are `middle`.
    pub fn note_point_forces(&mut self, (time, h): (f64, f64), middle: &[f64], force: &[f64]) {
        for feed in &mut self.list {
            feed.of_points = feed.on_length(feed.over(time, h).0.length, middle, force);
        }
    }

    /// Returns the work in J that constant forces on the nodes do through the changes of lengths in
    /// a step of the discrete gradient.
    pub fn work_on_lengths(&self, state: &State, b: &StepVectors, force: &[f64]) -> f64 {
        let work = |feed: &FeedElement| {
            let mean = feed.over(state.time, b.h).0;
            b.h * mean.rate * feed.on_length(mean.length, &b.means[0], force)
        };
        self.list.iter().map(work).sum()
    }
}

impl System {
    /// Returns the force on the length in N of effects at Gauss points, at the coordinates and
    /// velocities of an element at an eye; the lengths must be [set](System::set_feeds) to `time`
    /// (s).
    pub(super) fn points_on_length(
        &self,
        model: &Model,
        feed: &FeedElement,
        time: f64,
        [q, v]: [&[f64; 12]; 2],
    ) -> f64 {
        if !self.forces.act_at_points() {
            return 0.0;
        }
        let extent = feed.at(time);
        let drift = drift(q, extent.length);
        let material = core::array::from_fn(|i| constant(v[i] + extent.rate * drift[i]));
        dot(&drift, &self.points_of_feed(model, feed, time, q, &material).map(|f| f.value))
    }

    /// Returns the forces in N of effects at Gauss points on the coordinates of an element at an
    /// eye, at these and the velocities of the material.
    pub(super) fn points_of_feed(
        &self,
        model: &Model,
        feed: &FeedElement,
        time: f64,
        q: &[f64; 12],
        material: &[Dual; 12],
    ) -> [Dual; 12] {
        let turned = |x: &dyn Fn(usize) -> f64| {
            let mut out = [0.0; 12];
            feed.side.add(&core::array::from_fn(x), &mut out);
            out
        };
        let [value, slope] = [turned(&|i| material[i].value), turned(&|i| material[i].slope)];
        let v = core::array::from_fn(|i| Dual { value: value[i], slope: slope[i] });
        let mut force = [constant(0.0); 12];
        let q = turned(&|i| q[i]).map(constant);
        self.forces.at_points.add_dual(feed.element(model), time, &q, &v, &mut force);
        if let Some(densities) = &self.forces.densities {
            densities.add_dual(feed.element(model), time, &q, &v, &mut force);
        }
        let [value, slope] = [force.map(|f| f.value), force.map(|f| f.slope)].map(|x| feed.side.gather(&x));
        core::array::from_fn(|i| Dual { value: value[i], slope: slope[i] })
    }
}

#[cfg(test)]
mod tests {
    use super::super::some;
    use super::*;
    use crate::effect::Profile;
    use crate::element::side::Side;
    use crate::element::variable_length::feed_weights;
    use crate::quadrature::gauss_legendre;
    use crate::{At, Cable, Drag, Flow as Fluid, Integrator, Method, Reel, Section, StepControl};
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    /// The generalised forces of drag, times the rates of all coordinates and lengths, are the
    /// power of the force per length on the particles, at random states of a cable with a reel at
    /// each end.
    ///
    /// *Source.* Morison's formula at the Gauss points, and the velocity of the particles by
    /// [`feed_weights`], which is checked against differences in time.
    #[test]
    fn generalised_forces_of_drag_have_its_power() {
        let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };
        let mut cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
            .section(Section::from_stiffness(1e4, 0.02, 0.4).unwrap())
            .elements(4)
            .integrator(integrator)
            .build()
            .unwrap();
        let profile = Profile { up: Vector3::y(), rows: vec![[-3.0, 0.5], [3.0, 2.0]] };
        let fluid = Fluid { profile: Some(profile), ..Fluid::uniform(Vector3::new(0.4, -0.2, 0.9)) };
        let drag = Drag { diameter: Some(0.02), ..Drag::new(1000.0, 1.2, 0.07, fluid.clone()) };
        cable.set_drag(drag).unwrap();
        for at in [At::Start, At::End] {
            cable.add_reel(at, Reel::default()).unwrap();
        }
        for seed in 0..20 {
            let q: Vec<f64> = (0..30).map(|i| 0.6 * (i / 6) as f64 + some(31 * seed + i)).collect();
            let v: Vec<f64> = (0..30).map(|i| 2.0 * some(77 * seed + i + 5)).collect();
            let lengths = Side::BOTH.map(|side| 0.5 + 0.25 * some(seed + side as usize));
            let rates = Side::BOTH.map(|side| 3.0 * some(13 * seed + 7 * side as usize));
            for feed in &mut cable.system.feeds.list {
                let side = feed.side as usize;
                feed.extent = Extent { length: lengths[side], rate: rates[side], acceleration: 0.0 };
            }
            let Cable { model, system, .. } = &mut cable;
            system.set_feeds(model, 0.0);
            let mut force = vec![0.0; 30];
            let at = ForceInput { time: 0.0, q: &q, v: &v, dv_dq: 0.0, scale: 1.0 };
            let [_, material] = system.feeds.velocities(at);
            let mut counts = Default::default();
            system.forces.at_points.add(system.level, material, &mut force, None, (4, &mut counts));
            let mut power: f64 = force.iter().zip(&v).map(|(f, v)| f * v).sum();
            for feed in &system.feeds.list {
                let (q, v) = (feed.side.gather(&q), feed.side.gather(&v));
                let own = system.points_on_length(model, feed, 0.0, [&q, &v]);
                assert_relative_eq!(own, feed.on_length(lengths[feed.side as usize], at.q, &force), epsilon = 1e-9);
                power += own * rates[feed.side as usize];
            }
            let mut physical = 0.0;
            for e in 0..4 {
                let side = if e == 0 { Some(Side::Start) } else { (e == 3).then_some(Side::End) };
                let length = side.map_or(0.5, |side| lengths[side as usize]);
                let of = |x: &[f64], s: [f64; 4], own: &[f64; 12]| -> Vector3<f64> {
                    let x = if side == Some(Side::Start) { own } else { &x[6 * e..6 * e + 12] };
                    Vector3::from_fn(|c, _| (0..4).map(|k| s[k] * x[3 * k + c]).sum())
                };
                let [q_own, v_own] = [&q, &v].map(|x| Side::Start.gather(x));
                for (xi, weight) in gauss_legendre(3) {
                    let place = of(&q, shape::position(xi, length), &q_own);
                    let mut speed = of(&v, shape::position(xi, length), &v_own);
                    if let Some(side) = side {
                        speed += rates[side as usize] * of(&q, feed_weights(xi, length)[0], &q_own);
                    }
                    let along = of(&q, shape::slope(xi, length), &q_own).normalize();
                    let relative = speed - fluid.at(0.0, &place);
                    let (tangential, k) = (relative.dot(&along) * along, 0.5 * 1000.0 * 0.02);
                    let normal = relative - tangential;
                    let f = -k * (1.2 * normal.norm() * normal + 0.07 * tangential.norm() * tangential);
                    physical += weight * length * f.dot(&speed);
                }
            }
            assert_relative_eq!(power, physical, max_relative = 1e-12);
        }
    }
}
