//! Derivatives of the [law of a motor](super::law) about an iterate of a step.
//!
//! # Equation
//!
//! An acceleration da changes the length at the end of a step of length h by `h^2/2 da`, the mean
//! length by half of that, and the mean rate by `h/2 da`; a change dv of the velocities changes the
//! coordinates at the end by `b h dv`, b the coefficient of the one-leg formula. No other element
//! feels the length, so the column c of the acceleration and the row of the pull are those of the
//! 13 coordinates of the element at the eye alone. Inertia, entering material and the wheel are
//! derived in [dual numbers](crate::dual) as they stand; so are the forces of strains and of their
//! rates over a step. The mean force of strains on the length, of the energies `a l` of axial
//! strain and `b/l` of bending at both ends, is
//!
//! ```text
//! Y = (a0 + a1)/2 - (b0 + b1)/(2 l0 l1) + (r_j - r_i)_m . f_j/l1
//! ```
//!
//! Material that runs through the element without a change of its strains meets no stiffness: the
//! far node moves by `-d1/3` per length, and what matrix and row say of that must cancel with the
//! column and with the derivative by the length, although each is as large as the axial stiffness.
//! The matrix is symmetric, and that of the control vectors at the length at which the step begins:
//! it is off by a share of about `l' h/l`, which is more than the inertia of a light load. So the
//! column is that of the matrix as it is: both together are exact for this motion.
//!
//! # Validity
//!
//! The row is exact, and so is the column for the motion above, else to first order of the step;
//! but for drag, whose coefficients in the step are those of the iterate before, and for what
//! forces per length depend on by coordinates, length, and the skew part of their derivative by
//! velocity, and for what a natural curvature does as the length changes.

use super::effects::drift;
use super::feeds::control;
use super::step::StepMotion;
use super::{FeedElement, Source};
use crate::Real;
use crate::dual::{Dual, constant};
use crate::effect::acts::Single;
use crate::effect::tables::ElementTables;
use crate::element::gram::Control;
use crate::element::kernel::{ElementState, Kernel, Load, Stiffness};
use crate::element::step::ElementStep;
use crate::element::variable_length::{Extent, dot};
use crate::model::Model;
use crate::one_leg::OneLeg;
use crate::real::Over;
use crate::simd::dispatch;
use crate::state::State;
use crate::system::StepVectors;
use crate::system::elements::Elements;
use crate::system::{Equations, System};

/// A number with its derivatives by the 12 velocity changes of an element.
type ByVelocity = Dual<[f64; 12]>;
/// A number with its derivatives by the nine components of the control vectors at the end of a
/// step, and by the length there.
type ByStrain = Dual<[f64; 10]>;

/// Derivatives by the length at the end of a step, and of the force on it.
struct Strains {
    /// Of the impulse on the coordinates by the length, with what the far node does in the matrix
    /// if the strains stay.
    impulse: [f64; 12],
    /// Of the mean force on the length by the coordinates at the end, and by the length.
    on_length: ([f64; 12], f64),
}

impl Equations<'_> {
    /// Linearises feed `k` about the present iterate, whose motors have been
    /// [read](Self::read_motors), and writes the column c to `out`.
    pub fn linearise_law(&mut self, k: usize, state: &State, b: &StepVectors, out: &mut Vec<f64>) {
        dispatch!(self.system.level => self.linearise_in_lanes(k, state, b, out));
    }

    #[inline(always)]
    fn linearise_in_lanes(&mut self, k: usize, state: &State, b: &StepVectors, out: &mut Vec<f64>) {
        let feed = self.system.feeds.list[k];
        let Some(mut law) = feed.law else { return };
        let (model, system, h) = (self.model, &*self.system, b.h);
        let (step, acceleration) = ((state.time, h), feed.extent.acceleration);
        let (mean, motion) = (feed.over(state.time, h).0, StepMotion::of(&feed, state, b));
        let [q, v, a] = motion.mean(h);
        let before = feed.side.gather(&b.change_before);
        let strains = system.strains_over_step(model, &feed, (&motion, step), (&before, b.kept, b.leg));
        let points = system.points_by_acceleration(&feed, model, state.time + 0.5 * h, h, [&q, &v]);
        let (inertia, inertia_own) = system.motor_by_motion(model, &feed, (step.0, step.1, b.leg), [&q, &v, &a]);
        let moving = Dual { value: acceleration, slope: 1.0 };
        let by_acceleration =
            motion.impulse(&feed.impulse(model, step, moving, true).map(|table| table.map(|row| row.map(|x| x.slope))));
        let dead = feed.dead_by_length(model, mean.length);
        let (by_coordinate, by_length) = strains.on_length;
        let mut column = [0.0; 12];
        for i in 0..12 {
            column[i] =
                -(0.5 * h * h * strains.impulse[i] + h * points[i]) - 0.25 * h * h * h * dead[i] - by_acceleration[i];
            // drag is symmetric
            law.row[i] = inertia[i] - b.leg.b * h * by_coordinate[i] + 2.0 * b.leg.b / h * points[i];
        }
        law.own = inertia_own - 0.5 * h * h * by_length + dot(&drift(&q, mean.length), &points);
        out.clear();
        out.resize(b.rhs.len(), 0.0);
        feed.side.add(&column, out);
        self.system.feeds.list[k].law = Some(law);
    }
}

impl System {
    /// Returns the derivatives of the force of a motor without that of strains, by 12 velocity
    /// changes and by the acceleration.
    #[inline(always)]
    fn motor_by_motion(
        &self,
        model: &Model,
        feed: &FeedElement,
        (time, h, leg): (f64, f64, OneLeg),
        motion: [&[f64; 12]; 3],
    ) -> ([f64; 12], f64) {
        let rates = [0.5 * leg.b * h, leg.b, 1.0 / h];
        let [q, v, a] =
            core::array::from_fn(|k| core::array::from_fn(|i| ByVelocity::along(motion[k][i], i, rates[k])));
        let row = self.motor_of((model, feed), feed.over(time, h).0, [&q, &v, &a]).slope;
        let [q, v, a] = motion.map(|x| x.map(constant::<f64>));
        let moving = Dual { value: feed.extent.acceleration, slope: 1.0 };
        (row, self.motor_of((model, feed), feed.over_with((time, h), moving).0, [&q, &v, &a]).slope)
    }

    /// Returns the force in N of a motor without that of strains, at a mean motion.
    #[inline(always)]
    fn motor_of<T: Real, U: Over<T>>(
        &self,
        (model, feed): (&Model, &FeedElement),
        mean: Extent<T>,
        [q, v, a]: [&[U; 12]; 3],
    ) -> U
    where
        Single: Load<U>,
    {
        let on_length = feed.with(model, mean).length_force([q, v, a], &feed.dead(model));
        self.motor(model, feed, mean, q, on_length)
    }

    /// Returns the derivatives of what strains and internal damping do over a step; `before` is the
    /// change of the coordinates in the step before, and the share of it that counts.
    #[inline(always)]
    fn strains_over_step(
        &self,
        model: &Model,
        feed: &FeedElement,
        (motion, (time, h)): (&StepMotion, (f64, f64)),
        (before, kept, leg): (&[f64; 12], f64, OneLeg),
    ) -> Strains {
        let (start, end) = (&motion.q[0], &motion.end());
        let (_, [l0, l1]) = feed.over(time, h);
        let at_before = control(&core::array::from_fn(|i| start[i] - before[i]), feed.length_before);
        let (d0, d1) = (control(start, l0), control(end, l1));
        let fixed = |x: &Control<f64>, y: &Control<f64>| -> Control<ByStrain> {
            core::array::from_fn(|k| core::array::from_fn(|i| constant(x[k][i] - y[k][i])))
        };
        let mut moving = fixed(&d1, &d0);
        (0..9).for_each(|i| moving[i / 3][i % 3].slope[i] = 1.0);
        let step = ElementStep::new(&d0.map(|d| d.map(constant)), &moving, &fixed(&d0, &at_before), kept);
        let [mean, inverse] = [0.5 * (l0 + l1), 0.5 * (1.0 / l0 + 1.0 / l1)];
        let section = &model.elements[feed.element(model)].section;
        let [axial, bending] = [0.25 * section.axial_stiffness * h, 2.0 * section.bending_stiffness * h];
        let stiffness = Stiffness {
            axial: ByStrain::along(axial * mean, 9, 0.5 * axial),
            bending: ByStrain::along(bending * inverse, 9, -0.5 * bending / (l1 * l1)),
        };
        let (e, effects) = (feed.element(model), self.forces.in_element.as_ref());
        let pull = self.forces.elements.discrete_gradient_of(effects, &Single(e), &step, stiffness, (h, leg));
        // at fixed coordinates the middle control vector, 3 (r_j - r_i)/l, changes by this with the
        // length
        let shrink = d1[1].map(|x| -x / l1);
        let of_strains = |x: &ByStrain| (0..3).map(|i| x.slope[3 + i] * shrink[i]).sum::<f64>();
        let (scale, of_scale, in_matrix) = (3.0 * inverse, -1.5 / (l1 * l1), l1 / l0);
        let mut impulse = [0.0; 12];
        for x in 0..3 {
            let [first, chord, last] = [&pull[0][x], &pull[1][x], &pull[2][x]];
            let along = (3.0 / l0 * in_matrix) * of_strains(chord) + scale * chord.slope[9] + of_scale * chord.value;
            impulse[x] = along;
            impulse[3 + x] = -in_matrix * of_strains(first) - first.slope[9];
            impulse[6 + x] = -along;
            impulse[9 + x] = -in_matrix * of_strains(last) - last.slope[9];
        }
        // the product of mean chord and mean force on the eye, with its derivatives
        let mut of_eye = ByStrain { value: 0.0, slope: [0.0; 10] };
        let (mut eye_force, per_length) = ([0.0; 3], -3.0 / (l0 * h));
        for x in 0..3 {
            let chord = 0.5 * (start[6 + x] - start[x] + end[6 + x] - end[x]);
            of_eye = of_eye + pull[1][x] * (per_length * chord);
            eye_force[x] = per_length * pull[1][x].value;
        }
        let [axial, bending] = self.energy_gradients(model, feed, &d1, l1);
        let by_control =
            |i: usize| (0.5 / l1 * axial[i / 3][i % 3] - 0.5 / l0 * bending[i / 3][i % 3]) + of_eye.slope[i] / l1;
        let (u0, u1) =
            (feed.on_length.begin.unwrap_or_else(|| self.feed_energy(model, feed, &d0, l0)), feed.on_length.end);
        let mut by_length =
            0.5 * (u0.1 / (l1 * l1) + u1.1 / (l0 * l1)) - of_eye.value / (l1 * l1) + of_eye.slope[9] / l1;
        let mut by_coordinate = [0.0; 12];
        for x in 0..3 {
            by_length += by_control(3 + x) * shrink[x];
            let along = 3.0 / l1 * by_control(3 + x) + 0.5 / l1 * eye_force[x];
            by_coordinate[x] = -along;
            by_coordinate[3 + x] = by_control(x);
            by_coordinate[6 + x] = along;
            by_coordinate[9 + x] = by_control(6 + x);
        }
        Strains { impulse, on_length: (by_coordinate, by_length) }
    }

    /// Returns the derivatives of axial and bending energy of an element at an eye by its control
    /// vectors; not of the energy of a natural curvature, which has no part that its length scales.
    fn energy_gradients(&self, model: &Model, feed: &FeedElement, d: &Control<f64>, length: f64) -> [Control<f64>; 2] {
        let (Stiffness { axial, bending }, e) = (feed.stiffness(model, length), feed.element(model));
        let state = |axial, bending| ElementState { stiffness: Stiffness { axial, bending }, d: *d, velocity: None };
        let Elements { table, bending: rule, .. } = &self.forces.elements;
        let of_bending =
            Kernel { table, bending: rule, effects: &None::<&ElementTables> }.force(&state(0.0, bending), &Single(e));
        [self.feed_gradient(e, &state(axial, 0.0)), of_bending]
    }

    /// Returns the derivatives of the forces of effects at Gauss points by the acceleration,
    /// through the velocity of the material.
    fn points_by_acceleration(
        &self,
        feed: &FeedElement,
        model: &Model,
        time: f64,
        h: f64,
        [q, v]: [&[f64; 12]; 2],
    ) -> [f64; 12] {
        if !self.forces.act_at_points() {
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
    use crate::{
        At, AxialLaw, Cable, Damping, Effects, Feed, Integrator, LineLoad, Method, Reel, Section, StepControl,
    };
    use nalgebra::Vector3;

    /// The row of one element is that of the motor, and where material runs through it without a
    /// change of strain, matrix and column together, and row and derivative, are those of all
    /// residuals and of the motor, at random iterates of a cable with weight, line load and
    /// internal damping, by the laws of Green and of Hooke.
    ///
    /// *Source.* Central differences of the residual of the whole cable and of the force of the
    /// motor.
    #[test]
    fn columns_are_derivatives_of_the_whole_residual() {
        let feeds = [Feed::Drum, Feed::Bag, Feed::Coil];
        // those with kinks have two derivatives there
        let laws = [None, Some(AxialLaw::Hooke)];
        for (trial, at) in [At::Start, At::End].into_iter().cycle().take(24).enumerate() {
            let law = laws[trial / 12].clone();
            let trial = trial % 12;
            let mut cable = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(1.5, -1.0, 0.4)])
                .section(Section::from_stiffness(1e4, 0.02, 0.4).unwrap())
                .elements(5)
                .effects(Effects { axial_law: law, ..Effects::default() })
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
                b.recall(state, h, OneLeg::default());
                for i in 0..b.change.len() {
                    b.velocity_change[i] += 1e-2 * some(31 * trial + i);
                    b.change[i] += 1e-2 * OneLeg::default().b * h * some(31 * trial + i);
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
                                b.change[k] += sign * OneLeg::default().b * h * moved[k];
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
                close("row", &law.row, &row, 1e-5);
                // the far node moves with the length, such that the strains stay
                let mut motion = vec![0.0; b.change.len()];
                let moving = (0..3).map(|x| {
                    let chord = side.gather(&state.q)[6 + x] + side.gather(&b.change)[6 + x]
                        - side.gather(&state.q)[x]
                        - side.gather(&b.change)[x];
                    -chord / end_length * h / (2.0 * OneLeg::default().b)
                });
                let mut local = [0.0; 12];
                local.iter_mut().zip(moving).for_each(|(own, x)| *own = x);
                side.add(&local, &mut motion);
                let along = |b: &mut StepVectors, by: f64| {
                    for k in 0..motion.len() {
                        b.velocity_change[k] += by * motion[k];
                        b.change[k] += by * OneLeg::default().b * h * motion[k];
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
