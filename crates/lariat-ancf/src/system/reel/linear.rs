//! Derivatives of the [law of a motor](super::law) about an iterate of a step.
//!
//! # Equation
//!
//! An acceleration da changes the length at the end of a step of length h by `h^2/2 da`, the mean length by half of that, and the mean rate by `h/2
//! da`. No other element feels it, so the column c is that of the element at the eye alone. Its strains are derived in
//! [dual numbers](crate::dual); what their forces change through both stiffnesses, in which they are linear, is proportional to them. Forces with a potential, of strains or of their rates, and drag are symmetric: in the row they
//! are -2 b/h^2 times their part of the column, b the coefficient of the one-leg formula. Inertia is not: both its parts are derived by themselves.
//!
//! Material that runs through the element without a change of its strains meets no stiffness: the far node moves by `-d1/3` per length, and what the matrix and the row say of that
//! must cancel with the column and with the derivative by the length, although each is as large as the axial stiffness. The matrix is that of the control vectors at the length at
//! which the step begins, and the row symmetric to first order of the step; both are off by a share of about `l' h/l`, which is more than the inertia of a light load. So the column is
//! that of the matrix as it is, and the row is changed along the chord, such that both are exact for this motion.
//!
//! # Validity
//!
//! Exact for the motion above, else to first order of the step; but for drag, whose coefficients in the step are those of the iterate before, and for its dependence on the length.

use super::effects::drift;
use super::feeds::control;
use super::step::StepMotion;
use super::work::strain_on_length;
use super::{FeedElement, Source};
use crate::dual::{Dual, constant};
use crate::effect::acts::Single;
use crate::element::gram::Control;
use crate::element::kernel::Stiffness;
use crate::element::step::ElementStep;
use crate::element::variable_length::{Extent, dot};
use crate::model::Model;
use crate::one_leg::BETA;
use crate::simd::dispatch;
use crate::state::State;
use crate::system::StepVectors;
use crate::system::{Equations, System};

/// Increment of an acceleration in m/s^2 by which tangents of inertia are read.
const PROBE: f64 = 1e-3;
/// Share of the length of the element by which tangents of strain energy are read.
const STRAIN_PROBE: f64 = 1e-7;

/// Derivatives by the length at the end of a step.
struct OfLength {
    /// Of the impulse of strains on the coordinates.
    impulse: [f64; 12],
    /// The same, with what the far node does in the matrix if the strains stay, and not what it does.
    impulse_in_matrix: [f64; 12],
    /// Of the mean force of strains on the length; with the far node moved such that the strains stay.
    on_length: [f64; 2],
    /// Movement of the far node for that, over the length.
    far: [f64; 3],
}

impl Equations<'_> {
    /// Linearises feed `k` about the present iterate, whose motors have been [read](Self::read_motors), and writes the column c to `out`.
    pub fn linearise_law(&mut self, k: usize, state: &State, b: &StepVectors, out: &mut Vec<f64>) {
        dispatch!(self.system.level => self.linearise_in_lanes(k, state, b, out));
    }

    #[inline(always)]
    fn linearise_in_lanes(&mut self, k: usize, state: &State, b: &StepVectors, out: &mut Vec<f64>) {
        let feed = self.system.feeds.list[k];
        let Some(mut law) = feed.law else { return };
        let (model, system, h) = (self.model, &*self.system, b.h);
        let (mean, _) = feed.over(state.time, h);
        let motion = StepMotion::of(&feed, state, b);
        let [q, v, a] = self.motion_of_step(&feed, state, b);
        let before = feed.side.gather(&b.change_before);
        let strains = system.strains_by_length(model, &feed, (&motion, state.time, h), (&before, b.kept));
        let points = system.points_by_acceleration(&feed, model, state.time + 0.5 * h, h, [&q, &v]);
        let moved =
            FeedElement { extent: Extent { acceleration: feed.extent.acceleration + PROBE, ..feed.extent }, ..feed };
        let impulses = [&feed, &moved].map(|feed| feed.impulse(model, (state.time, h), true));
        let by_acceleration = impulses[0].derivative(&impulses[1], PROBE).of(&motion);
        let dead = feed.dead_by_length(model, mean.length);
        let (element, weight) = (feed.with(model, mean), feed.dead(model));
        let (moved, _) = moved.over(state.time, h);
        let of_moved = feed.with(model, moved).length_force([&q, &v, &a], &weight);
        let motors =
            [(mean, feed.on_length.inertial), (moved, of_moved)].map(|(at, force)| feed.motor(model, at, &q, force));
        let [by_q, by_v, by_a] = element.length_force_gradient([&q, &v, &a], &weight);
        let [of_square, _] = feed.kind.momentum(mean.rate);
        let thrust = 2.0 * of_square * element.inertia * mean.rate * mean.rate;
        let (mut row, mut column) = ([0.0; 12], [0.0; 12]);
        for i in 0..12 {
            let symmetric = -(0.5 * h * h * strains.impulse[i] + h * points[i]);
            let in_matrix = -(0.5 * h * h * strains.impulse_in_matrix[i] + h * points[i]);
            column[i] = in_matrix - 0.25 * h * h * h * dead[i] - by_acceleration[i];
            let of_stretch = if i < 9 { 0.0 } else { thrust * q[i] };
            let motor = -0.5 * BETA * h * (by_q[i] + of_stretch) - BETA * by_v[i] - by_a[i] / h;
            row[i] = motor - 2.0 * BETA / (h * h) * symmetric;
        }
        out.clear();
        out.resize(b.rhs.len(), 0.0);
        feed.side.add(&column, out);
        let [on_length, at_strains] = strains.on_length;
        // by the strains, the row has b times the impulse, and the far node the velocity h/2b times its movement
        let along: f64 = (0..3).map(|x| strains.impulse[x] * strains.far[x]).sum();
        let square: f64 = strains.far.iter().map(|x| x * x).sum();
        let missed = (h * (on_length - at_strains) - along) * BETA / square.max(f64::MIN_POSITIVE);
        for x in 0..3 {
            row[x] += missed * strains.far[x];
            row[6 + x] -= missed * strains.far[x];
        }
        law.row = row;
        law.own = (motors[1] - motors[0]) / PROBE - 0.5 * h * h * on_length + dot(&drift(&q, mean.length), &points);
        self.system.feeds.list[k].law = Some(law);
    }
}

impl System {
    /// Returns the derivatives of what strains and internal damping do over a step; `before` is the change of the coordinates in the step before,
    /// and the share of it that counts.
    #[inline(always)]
    fn strains_by_length(
        &self,
        model: &Model,
        feed: &FeedElement,
        (motion, time, h): (&StepMotion, f64, f64),
        (before, kept): (&[f64; 12], f64),
    ) -> OfLength {
        let [start, change] = &motion.q;
        let end: &[f64; 12] = &core::array::from_fn(|i| start[i] + change[i]);
        let (_, [l0, l1]) = feed.over(time, h);
        let at_before = control(&core::array::from_fn(|i| start[i] - before[i]), feed.length_before);
        let (d0, d1) = (control(start, l0), control(end, l1));
        let difference = |x: &Control<f64>, y: &Control<f64>| -> Control<f64> {
            core::array::from_fn(|k| core::array::from_fn(|i| x[k][i] - y[k][i]))
        };
        let (change, before) = (difference(&d1, &d0), difference(&d0, &at_before));
        let [mean, inverse] = [0.5 * (l0 + l1), 0.5 * (1.0 / l0 + 1.0 / l1)];
        let section = &model.elements[feed.element(model)].section;
        let [axial, bending] =
            [0.25 * section.axial_stiffness * mean * h, 2.0 * section.bending_stiffness * inverse * h];
        let (elements, effects) = (&self.forces.elements, self.forces.in_element.as_ref());
        let from = Single(feed.element(model));
        let fixed = |x: &Control<f64>| x.map(|vector| vector.map(constant));
        // the middle one of the control vectors is 3 (r_j - r_i)/l
        let mut moving = fixed(&change);
        (0..3).for_each(|x| moving[1][x].slope = -d1[1][x] / l1);
        let step = ElementStep::new(&fixed(&d0), &moving, &fixed(&before), kept);
        let stiffness = Stiffness { axial: constant(axial), bending: constant(bending) };
        let pull = elements.discrete_gradient_of(effects, &from, &step, stiffness, h);
        // the force is linear in both stiffnesses
        let step = ElementStep::new(&d0, &change, &before, kept);
        let of_bending = elements.discrete_gradient_of(effects, &from, &step, Stiffness { axial: 0.0, bending }, h);
        let [of_axial_length, of_inverse] = [0.5 / mean, -0.5 / (l1 * l1 * inverse)];
        let impulse = |slopes: &dyn Fn(usize, usize) -> f64, scale: f64| -> [f64; 12] {
            core::array::from_fn(|i| match (i / 3, i % 3) {
                (0, x) => scale * slopes(1, x),
                (1, x) => -slopes(0, x),
                (2, x) => -scale * slopes(1, x),
                (_, x) => -slopes(2, x),
            })
        };
        // of a change of the strains alone, as it is and in the matrix; and of the length alone
        let of_strains = |k: usize, x: usize| pull[k][x].slope;
        let of_length = |k: usize, x: usize| {
            let of_bending = of_bending[k][x];
            of_axial_length * (pull[k][x].value - of_bending) + of_inverse * of_bending
        };
        let [by_strains, in_matrix] = [3.0 * inverse, 3.0 / l0].map(|scale| impulse(&of_strains, scale));
        let mut by_length = impulse(&of_length, 3.0 * inverse);
        let mut eye = [0.0; 3];
        for x in 0..3 {
            let along = -1.5 / (l1 * l1) * pull[1][x].value;
            by_length[x] += along;
            by_length[6 + x] -= along;
            let chord = 0.5 * (start[6 + x] - start[x] + end[6 + x] - end[x]);
            let scale = -3.0 / (l0 * h);
            eye[0] += scale * pull[1][x].value * chord;
            eye[1] += scale * (of_strains(1, x) + of_length(1, x)) * chord;
            eye[2] += scale * (of_length(1, x) * chord + pull[1][x].value * d1[1][x] / 6.0);
        }
        let probe = STRAIN_PROBE * l1;
        let u0 = feed.on_length.begin.unwrap_or_else(|| self.feed_energy(model, feed, &d0, l0));
        let u1 = feed.on_length.end;
        let present = strain_on_length([u0, u1], [l0, l1], eye[0]);
        let moved = |u1: (f64, f64), by: f64| {
            (strain_on_length([u0, u1], [l0, l1 + probe], eye[0] + probe * by) - present) / probe
        };
        let strained = self.feed_energy(model, feed, &control(end, l1 + probe), l1 + probe);
        let still = (u1.0 * (1.0 + probe / l1), u1.1 / (1.0 + probe / l1));
        OfLength {
            impulse: core::array::from_fn(|i| by_strains[i] + by_length[i]),
            impulse_in_matrix: core::array::from_fn(|i| l1 / l0 * in_matrix[i] + by_length[i]),
            on_length: [moved(strained, eye[1]), moved(still, eye[2])],
            far: d1[1].map(|x| -x / 3.0),
        }
    }

    /// Returns the derivatives of the forces of effects at Gauss points by the acceleration, through the velocity of the material.
    fn points_by_acceleration(
        &self,
        feed: &FeedElement,
        model: &Model,
        time: f64,
        h: f64,
        [q, v]: [&[f64; 12]; 2],
    ) -> [f64; 12] {
        if !self.forces.at_points.any() {
            return [0.0; 12];
        }
        let Extent { length, rate, .. } = feed.over(time - 0.5 * h, h).0;
        let drift = drift(q, length);
        let material = core::array::from_fn(|i| Dual { value: v[i] + rate * drift[i], slope: 0.5 * h * drift[i] });
        self.points_of_feed(model, feed, time, q, &material).map(|f| f.slope)
    }
}

impl FeedElement {
    /// Returns the derivative of weights and line loads on the coordinates by the length, in N/m.
    fn dead_by_length(&self, model: &Model, length: f64) -> [f64; 12] {
        let (dead, weight) = (self.dead(model), self.weight(model));
        let shares = [0.5, length / 6.0, 0.5, -length / 6.0];
        let mut out: [f64; 12] = core::array::from_fn(|i| shares[i / 3] * dead[i % 3]);
        if let Source::Stock(_) = self.source {
            (0..3).for_each(|x| out[6 + x] -= weight[x]);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::super::some;
    use super::*;
    use crate::effect::EffectWork;
    use crate::system::CableStep;
    use crate::{At, Cable, Damping, Feed, Integrator, LineLoad, Method, Reel, Section, StepControl};
    use nalgebra::Vector3;

    /// The row of one element is that of the motor, and where material runs through it without a change of strain, matrix and column together, and row and derivative,
    /// are those of all residuals and of the motor, at random iterates of a cable with weight, line load and internal damping.
    ///
    /// *Source.* Central differences of the residual of the whole cable and of the force of the motor. The secants of the discrete gradient
    /// make the row symmetric to first order of the step only.
    #[test]
    fn columns_are_derivatives_of_the_whole_residual() {
        let feeds = [Feed::Drum, Feed::Bag, Feed::Coil];
        for (trial, at) in [At::Start, At::End].into_iter().cycle().take(12).enumerate() {
            let mut cable = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(1.5, -1.0, 0.4)])
                .section(Section::from_stiffness(1e4, 0.02, 0.4).unwrap())
                .elements(5)
                .damping(Damping { axial: 2e-3, bending: 2e-3 })
                .integrator(Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) })
                .fix(at)
                .build()
                .unwrap();
            cable.add_line_load(LineLoad::uniform(Vector3::new(0.0, 0.3, 1.0))).unwrap();
            let reel = Reel { feed: feeds[trial % 3], stock: Some(5.0), inertia: 0.2, ..Reel::brake(0.5) };
            cable.add_reel(at, reel).unwrap();
            (0..10 + trial).for_each(|_| cable.step(1.0 / 240.0).unwrap());
            let h = 1.0 / 240.0;
            cable.begin_reel(h);
            cable.with_workspace(|cable| {
                let CableStep { mut equations, state, buffers: b } = cable.step_parts();
                equations.begin_laws(state.time, h);
                b.recall(state, h);
                for i in 0..b.change.len() {
                    b.velocity_change[i] += 1e-2 * some(31 * trial + i);
                    b.change[i] += 1e-2 * BETA * h * some(31 * trial + i);
                }
                let side = equations.system.feeds.list[0].side;
                let mut column = Vec::new();
                equations.step_residual(state, b, true, &mut EffectWork::default());
                let matrix = equations.system.step.matrix.clone();
                let feed = equations.system.feeds.list[0];
                let end_length = feed.at(state.time + h).length;
                equations.read_motors(state, b);
                equations.linearise_law(0, state, b, &mut column);
                let law = equations.system.feeds.list[0].law.unwrap();
                let present = equations.system.feeds.list[0].extent.acceleration;
                let mut at = |b: &mut StepVectors, acceleration: f64| {
                    equations.system.feeds.list[0].extent.acceleration = acceleration;
                    equations.step_residual(state, b, false, &mut EffectWork::default());
                    equations.read_motors(state, b);
                    (b.rhs.clone(), equations.system.feeds.list[0].pull_of_iterate())
                };
                let close = |name: &str, own: &[f64], other: &[f64], share: f64| {
                    let scale = other.iter().fold(0.0f64, |most, x| most.max(x.abs()));
                    let worst = own.iter().zip(other).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
                    assert!(worst <= share * scale, "{name} of {trial}: {worst:e} of {scale:e}");
                };
                let probe = 0.2;
                let [(_, least), (_, most)] = [-probe, probe].map(|by| at(b, present + by));
                close("derivative", &[law.own], &[(most - least) / (2.0 * probe)], 1e-5);
                let row: Vec<f64> = (0..12)
                    .map(|i| {
                        let mut local = [0.0; 12];
                        local[i] = 1e-6;
                        let mut moved = vec![0.0; b.change.len()];
                        side.add(&local, &mut moved);
                        let by = |b: &mut StepVectors, sign: f64| {
                            for k in 0..moved.len() {
                                b.velocity_change[k] += sign * moved[k];
                                b.change[k] += sign * BETA * h * moved[k];
                            }
                        };
                        by(b, 1.0);
                        let up = at(b, present).1;
                        by(b, -2.0);
                        let down = at(b, present).1;
                        by(b, 1.0);
                        (up - down) / 2e-6
                    })
                    .collect();
                close("row", &law.row, &row, 0.05);
                // the far node moves with the length, such that the strains stay
                let mut motion = vec![0.0; b.change.len()];
                let moving = (0..3).map(|x| {
                    let chord = side.gather(&state.q)[6 + x] + side.gather(&b.change)[6 + x]
                        - side.gather(&state.q)[x]
                        - side.gather(&b.change)[x];
                    -chord / end_length * h / (2.0 * BETA)
                });
                let mut local = [0.0; 12];
                local.iter_mut().zip(moving).for_each(|(own, x)| *own = x);
                side.add(&local, &mut motion);
                let along = |b: &mut StepVectors, by: f64| {
                    for k in 0..motion.len() {
                        b.velocity_change[k] += by * motion[k];
                        b.change[k] += by * BETA * h * motion[k];
                    }
                };
                let [(low, least), (high, most)] = [-probe, probe].map(|by| {
                    along(b, by);
                    let out = at(b, present + by);
                    along(b, -by);
                    out
                });
                let of_all: Vec<f64> = low.iter().zip(&high).map(|(a, b)| (a - b) / (2.0 * probe)).collect();
                let mut own = vec![0.0; motion.len()];
                matrix.multiply(&motion, &mut own);
                own.iter_mut().zip(&column).for_each(|(own, column)| *own += column);
                let scale = column.iter().fold(0.0f64, |most, x| most.max(x.abs()));
                let worst = own.iter().zip(&of_all).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
                assert!(worst < 1e-3 * scale, "along {trial}: {worst:e} of {scale:e}");
                let row = law.row.iter().zip(side.gather(&motion)).map(|(a, b)| a * b).sum::<f64>() + law.own;
                close("row along it", &[row], &[(most - least) / (2.0 * probe)], 1e-6);
            });
        }
    }
}
