//! Elements at eyes over a step of the [discrete gradient](crate::integrate::discrete_gradient):
//! see [`feed`](super).

use super::feeds::Impulse;
use super::{FeedElement, Feeds, Source};
use crate::Real;
use crate::element::mass;
use crate::element::variable_length::{Table, add_product};
use crate::model::Model;
use crate::one_leg::OneLeg;
use crate::simd::dispatch;
use crate::state::State;
use crate::system::Equations;
use crate::system::StepVectors;

/// True iterates of an eye: change, linearised, change of the step before.
type Iterates = [[f64; 3]; 3];

impl Equations<'_> {
    /// Sets the lengths of a step of the discrete gradient, and moves the eyes in its iterates to
    /// where they are on elements of the lengths at the beginning; returns the true iterates by
    /// feed.
    pub fn begin_feed_step(&mut self, state: &State, b: &mut StepVectors) -> [Iterates; 2] {
        let mut saved = [Iterates::default(); 2];
        for (k, saved) in (0..self.system.feeds.list.len()).zip(&mut saved) {
            let (mean, [l0, l1]) = self.system.feeds.list[k].over(state.time, b.h);
            self.system.set_each_length(self.model, k, [l0, mean.length, 0.5 * (1.0 / l0 + 1.0 / l1)]);
            let feed = &self.system.feeds.list[k];
            if feed.stands() {
                continue;
            }
            let [far, eye] = feed.side.nodes(self.model.nodes()).map(|node| 6 * node);
            let lists = [&mut b.change, &mut b.linearised, &mut b.change_before];
            for (i, (list, saved)) in lists.into_iter().zip(saved).enumerate().filter(|(_, (list, _))| !list.is_empty())
            {
                // the other end of the step: its end, or the beginning of the one before
                let (sign, other) = if i < 2 { (1.0, l1) } else { (-1.0, feed.length_before) };
                for x in 0..3 {
                    saved[x] = list[eye + x];
                    let at_far = state.q[far + x] + sign * list[far + x];
                    let at_eye = state.q[eye + x] + sign * list[eye + x];
                    list[eye + x] = sign * (at_far + l0 / other * (at_eye - at_far) - state.q[eye + x]);
                }
            }
        }
        saved
    }

    /// Ends what [`begin_feed_step`](Self::begin_feed_step) began, and scales the forces of the
    /// elements on the eyes in the residual.
    pub fn end_feed_step(&mut self, state: &State, b: &mut StepVectors, saved: [Iterates; 2]) {
        for (feed, saved) in self.system.feeds.list.iter_mut().zip(saved) {
            let (_, [l0, l1]) = feed.over(state.time, b.h);
            let share = 0.5 * (1.0 + l0 / l1);
            let [far, eye] = feed.side.nodes(self.model.nodes()).map(|node| 6 * node);
            if feed.stands() {
                feed.eye_force = core::array::from_fn(|x| b.rhs[eye + x] / b.h);
                continue;
            }
            for (list, saved) in [&mut b.change, &mut b.linearised, &mut b.change_before].into_iter().zip(saved) {
                if !list.is_empty() {
                    list[eye..eye + 3].copy_from_slice(&saved);
                }
            }
            for x in 0..3 {
                let force = b.rhs[eye + x];
                feed.eye_force[x] = force / b.h;
                b.rhs[eye + x] = share * force;
                b.rhs[far + x] += (1.0 - share) * force;
            }
        }
    }

    /// Adds the forces of the feeds over a step of the discrete gradient to those without
    /// potential, and their derivatives to the matrix if it is asked for.
    pub fn add_feeds_over_step(&mut self, state: &State, b: &mut StepVectors, matrix: bool) {
        let (model, system) = (self.model, &mut *self.system);
        let (step, rate) = ((state.time, b.h), 1.0 / b.h);
        let Feeds { list, impulses, .. } = &mut system.feeds;
        impulses.resize(list.len(), Impulse::default());
        for (feed, impulse) in list.iter().zip(impulses).filter(|(feed, _)| !feed.stands()) {
            let motion = StepMotion::of(feed, state, b);
            let own = dispatch!(system.level => {
                // a given rate does not change within a step
                if matrix || feed.law.is_some() || impulse.step != step {
                    *impulse = Impulse { step, tables: feed.impulse(model, step, feed.extent.acceleration, false) };
                }
                motion.impulse(&impulse.tables)
            });
            feed.side.add(&own.map(|x| rate * x), &mut b.external);
            if matrix {
                let table = feed.impulse_table(model, impulse, b.leg);
                feed.add_symmetric(model, &mut system.step.matrix, |r, c| table[r][c]);
            }
        }
    }
}

impl Feeds {
    /// Moves the eyes in the change of coordinates over the last step to where they would be on
    /// elements of the present lengths.
    pub fn shift_eyes_before(&self, q: &[f64], change: &mut [f64]) {
        for feed in &self.list {
            let [far, eye] = feed.side.nodes(q.len() / 6).map(|node| 6 * node);
            let ratio = feed.extent.length / feed.length_before;
            for x in 0..3 {
                let [at_far, at_eye] = [far, eye].map(|node| q[node + x] - change[node + x]);
                change[eye + x] = q[eye + x] - at_far - ratio * (at_eye - at_far);
            }
        }
    }
}

/// Coordinates and velocities of the element at an eye at the beginning of a step, and their
/// changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepMotion {
    pub q: [[f64; 12]; 2],
    pub v: [[f64; 12]; 2],
}

impl StepMotion {
    /// Returns that of the present iterate.
    pub fn of(feed: &FeedElement, state: &State, b: &StepVectors) -> Self {
        let of = |x: &[f64]| feed.side.gather(x);
        StepMotion { q: [of(&state.q), of(&b.change)], v: [of(&state.v), of(&b.velocity_change)] }
    }

    /// Returns the coordinates at the end.
    pub fn end(&self) -> [f64; 12] {
        let [start, change] = &self.q;
        core::array::from_fn(|i| start[i] + change[i])
    }

    /// Returns the middle and the mean rates over the step of length `h` (s).
    pub fn mean(&self, h: f64) -> [[f64; 12]; 3] {
        let ([start, change], [_, velocity_change], rate) = (&self.q, &self.v, 1.0 / h);
        let middle = core::array::from_fn(|i| start[i] + 0.5 * change[i]);
        [middle, change.map(|x| rate * x), velocity_change.map(|x| rate * x)]
    }

    /// Returns the product with tables.
    #[inline(always)]
    pub fn impulse(&self, tables: &[Table; 4]) -> [f64; 12] {
        let mut out = [0.0; 12];
        for (table, x) in tables.iter().zip(self.q.iter().chain(&self.v)) {
            add_product(table, 1.0, x, &mut out);
        }
        out
    }
}

/// Returns a table by its entries.
#[inline(always)]
fn table<T: Real>(entry: impl Fn(usize, usize) -> T) -> Table<T> {
    let mut out = [[entry(0, 0); 4]; 4];
    for a in 0..4 {
        for b in 0..4 {
            out[a][b] = entry(a, b);
        }
    }
    out
}

impl FeedElement {
    /// Returns the impulse of the inertia of the element over a step, `-D p + h l' (G^T v^ + l' K
    /// q_m)` and the momentum of the material that enters at the eye; that of riding stock is a
    /// part of p, and what enters comes from it. Without `all` it is less the part `-M_m D v`,
    /// which the mass matrix has.
    #[inline(always)]
    pub(super) fn impulse<T: Real>(
        &self,
        model: &Model,
        step: (f64, f64),
        acceleration: T,
        all: bool,
    ) -> [Table<T>; 4] {
        let (_, h) = step;
        let (mean, [mut first, last]) = self.over_with(step, acceleration);
        let [first_length, last_length] = [first.length, last.length];
        if let Some(rate) = self.left_rate {
            first.rate = first.rate.splat(rate);
        }
        let [of_mean, first, last] = [mean, first, last].map(|extent| self.with(model, extent));
        let inertia = of_mean.inertia;
        let mass = |length: T| {
            let mut mass = mass::consistent(inertia, length);
            mass[2][2] = mass[2][2] + self.stock(length) * inertia;
            mass
        };
        let (mass_first, mass_last) = (mass(first_length), mass(last_length));
        let in_matrix = if all { [[mean.rate.splat(0.0); 4]; 4] } else { mass(mean.length) };
        let (momentum_first, momentum_last) = (first.momentum_matrix(), last.momentum_matrix());
        let [mut by_change, mut by_position] = of_mean.gradient_matrices();
        if self.source == Source::Outside {
            by_change[2][2] = by_change[2][2] + mean.rate * inertia;
            by_position[2][3] = by_position[2][3] - mean.rate * inertia * mean.rate;
        }
        [
            table(|a, b| momentum_first[a][b] - momentum_last[a][b] + by_position[a][b] * h),
            table(|a, b| by_change[a][b] + by_position[a][b] * (0.5 * h) - momentum_last[a][b]),
            table(|a, b| mass_first[a][b] - mass_last[a][b]),
            table(|a, b| in_matrix[a][b] - mass_last[a][b]),
        ]
    }

    /// Returns the negative derivatives of the [impulse](Self::impulse), without the part of the
    /// mass matrix, by the changes of velocity. With riding stock or a sheave it is changed to a
    /// table whose symmetric part has the same sums over the rows of positions: one linear solve
    /// then keeps the momentum.
    fn impulse_table(&self, model: &Model, impulse: &Impulse, leg: OneLeg) -> Table {
        let (time, h) = impulse.step;
        let [_, by_change, _, by_velocity] = &impulse.tables;
        let mut table = table(|a, b| -by_velocity[a][b] - leg.b * h * by_change[a][b]);
        if self.source == Source::Outside {
            return table;
        }
        // the elements put their own mass into the matrix, not that of the stock
        table[2][2] += self.with(model, self.extent).inertia * self.stock(self.over(time, h).0.length);
        let symmetric: Table = core::array::from_fn(|a| core::array::from_fn(|b| 0.5 * (table[a][b] + table[b][a])));
        let missed: [f64; 4] = core::array::from_fn(|b| table[0][b] + table[2][b] - symmetric[0][b] - symmetric[2][b]);
        let mut table = symmetric;
        table[0][0] += missed[0];
        table[2][2] += missed[2];
        for b in [1, 3] {
            table[2][b] += missed[b];
            table[b][2] += missed[b];
        }
        table
    }
}
