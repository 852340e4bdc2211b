//! What winch and entering material do: pull, power, and work over a step.
//!
//! # Equation
//!
//! With B the [force on the length](crate::element::variable_length), less that of
//! [effects](super::effects) and with that of [torsion](crate::effect::torsion), w the weight per
//! length, f the stretch and v the velocity of the material at the eye r:
//!
//! ```text
//! drum      pull = -B - 1/2 rho l'^2 (f^2 - 1)        power = l' (B + 1/2 rho v.v - w.r)
//! bag       pull = -B - 1/2 rho l'^2 f^2
//! coil      pull = -B - rho l'^2 f^2 + u_0            u_0 the axial energy per length at the eye, by its law
//! ```
//!
//! With stock that rides with the body at the eye, which is a part of the system, the power is `l'
//! (B + 1/2 rho l'^2 f^2)`.
//!
//! What holds an eye that moves does the work of the force at its section over its own motion: in
//! axes that move with a velocity V the energies differ by V times momentum and by V^2/2 times
//! mass, and the laws above give the same B and pull.
//!
//! Stock leaves a drum with the rate of the reel. In a bag it lies at rest and is set in motion
//! without loss; in a coil by an inelastic impact, so that a falling chain obeys `m g = d(m v)/dt`.
//! Both differ from a drum while cable is paid out.
//!
//! # References
//!
//! Cayley, Proc. R. Soc. 8 (1857) 506 (the coil); Irschik & Holl, Appl. Mech. Rev. 57 (2004) 145
//! (variable mass).
//!
//! # Validity
//!
//! The account of energy is exact for any step of the discrete gradient but for its kinetic part,
//! of the second order; for other methods to the order of two points of Gauss, where the velocities
//! at the ends of a step are those of the motion. Methods that leave modes ringing which the steps
//! do not resolve, if they have no estimate of their error, as the midpoint rule, are refused with
//! a reel by [`Error::ReelMethod`](crate::Error::ReelMethod).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/reels.md.

use super::feeds::{OnLength, control};
use super::step::StepMotion;
use super::{FeedElement, Source};
use crate::Real;
use crate::effect::acts::Single;
use crate::effect::work::{POINTS, hermite};
use crate::element::kernel::{DiscreteGradientForce, Load};
use crate::element::variable_length::{Extent, VariableLength};
use crate::model::Model;
use crate::real::Over;
use crate::reel::Feed;
use crate::simd::dispatch;
use crate::state::State;
use crate::system::Equations;
use crate::system::{StepVectors, System};

/// What a reel does, at an instant.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FeedForce {
    /// Pull of the winch on the cable in N.
    pub pull: f64,
    /// Power in W that winch and entering material bring, without that against internal damping.
    pub power: f64,
    /// The latter.
    pub damping: f64,
}

impl System {
    /// Returns pull and power of a winch at the coordinates, velocities and accelerations of its
    /// element.
    pub fn feed_force(&self, model: &Model, feed: &FeedElement, time: f64, motion: [&[f64; 12]; 3]) -> FeedForce {
        let extent = feed.at(time);
        let (element, weight) = (feed.with(model, extent), feed.weight(model));
        let [q, v, _] = motion;
        let [strain, damping] = self.strain_length_force(model, feed, &extent, [q, v]);
        let others =
            element.length_force(motion, &feed.dead(model)) + strain - self.points_on_length(model, feed, time, [q, v]);
        let on_length = others + damping;
        FeedForce {
            pull: self.pull(model, feed, &element, q, on_length),
            power: extent.rate * (others + entering(&element, &weight, q, v)),
            damping: extent.rate * damping,
        }
    }
}

impl Equations<'_> {
    /// Returns the work of winch and entering material over a step of a method with accelerations,
    /// by the two points of Gauss on the cubics of velocity, and against internal damping by the
    /// mean velocity if that is [not resolved](crate::system::energy_balance); `range` is the
    /// cable's part of the states.
    pub fn feed_work(
        &mut self,
        feed: &FeedElement,
        before: &State,
        after: &State,
        h: f64,
        range: core::ops::Range<usize>,
    ) -> f64 {
        let of = |x: &[f64]| feed.side.gather(&x[range.clone()]);
        let [q0, v0, a0] = [&before.q, &before.v, &before.memory.acceleration].map(|x| of(x));
        let [q1, v1, a1] = [&after.q, &after.v, &after.memory.acceleration].map(|x| of(x));
        let (mut work, mut along) = (0.0, 0.0);
        for s in POINTS {
            let (cubic, slope) = hermite(s);
            let mix = |w: [f64; 4], x0: &[f64; 12], d0: &[f64; 12], x1: &[f64; 12], d1: &[f64; 12]| -> [f64; 12] {
                core::array::from_fn(|k| w[0] * x0[k] + h * w[1] * d0[k] + w[2] * x1[k] + h * w[3] * d1[k])
            };
            let q = mix(cubic, &q0, &v0, &q1, &v1);
            let (v, a) = (mix(cubic, &v0, &a0, &v1, &a1), mix(slope, &v0, &a0, &v1, &a1).map(|x| x / h));
            self.system.set_feeds(self.model, before.time + s * h);
            let force = self.system.feed_force(self.model, feed, before.time + s * h, [&q, &v, &a]);
            work += 0.5 * h * force.power;
            along += 0.5 * h * force.damping;
        }
        if along == 0.0 {
            return work;
        }
        let middle = core::array::from_fn(|k| 0.5 * (q0[k] + q1[k]) + h / 8.0 * (v0[k] - v1[k]));
        let velocity = core::array::from_fn(|k| (q1[k] - q0[k]) / h);
        let extent = feed.at(before.time + 0.5 * h);
        let [_, damping] = self.system.strain_length_force(self.model, feed, &extent, [&middle, &velocity]);
        let mean = h * extent.rate * damping;
        work + if (along - mean).abs() <= mean.abs() { along } else { mean }
    }

    /// Returns the mean forces on the length over a step of the discrete gradient.
    pub(super) fn on_length_of_step(&self, feed: &FeedElement, state: &State, b: &StepVectors) -> OnLength {
        let (model, system) = (self.model, &*self.system);
        let (mean, [l0, l1]) = feed.over(state.time, b.h);
        let motion = StepMotion::of(feed, state, b);
        let [middle, velocity, acceleration] = &motion.mean(b.h);
        let [first, last] = [control(&motion.q[0], l0), control(&motion.end(), l1)];
        let energy = |d, l| system.feed_energy(model, feed, d, l);
        let begin = feed.on_length.begin.filter(|_| feed.law.is_some()).unwrap_or_else(|| energy(&first, l0));
        let end = energy(&last, l1);
        let of_eye: f64 = (0..3).map(|x| feed.eye_force[x] * (middle[6 + x] - middle[x])).sum();
        let elastic = strain_on_length([begin, end], [l0, l1], of_eye)
            + system.rest_on_length(model, feed, [&first, &last], [l0, l1]);
        let (element, dead) = (feed.with(model, mean), feed.dead(model));
        let inertial = dispatch!(system.level => element.length_force([middle, velocity, acceleration], &dead));
        OnLength { force: elastic + inertial - feed.of_points + feed.of_twist, begin: Some(begin), end }
    }

    /// Returns what entering material brings in N beside the force on the length, in the mean of a
    /// step of the discrete gradient.
    fn entering_in_step(&self, feed: &FeedElement, element: &VariableLength, [q, v, _]: &[[f64; 12]; 3]) -> f64 {
        let rate = element.extent.rate;
        match feed.source {
            Source::Outside => entering(element, &feed.weight(self.model), q, v),
            // the stock, or the other cable, is a part of the system
            Source::Stock(_) | Source::Cable => 0.5 * element.inertia * rate * rate * square_of_stretch(q),
        }
    }

    /// Adds the work of winches and entering material over a step of the discrete gradient, and
    /// notes its lengths for the next one.
    pub fn end_feeds_of_step(&mut self, state: &State, b: &StepVectors) {
        for k in 0..self.system.feeds.list.len() {
            let feed = &self.system.feeds.list[k];
            let (mean, [l0, l1]) = feed.over(state.time, b.h);
            let force = match feed.law {
                Some(_) => feed.on_length.force,
                None => self.on_length_of_step(feed, state, b).force,
            };
            let (element, motion) = (feed.with(self.model, mean), StepMotion::of(feed, state, b).mean(b.h));
            let work = (l1 - l0) * (force + self.entering_in_step(feed, &element, &motion));
            let pull = self.system.pull(self.model, feed, &element, &motion[0], force);
            let own = &mut self.system.feeds.list[k];
            (own.length_before, own.pull) = (l0, Some(pull));
            self.system.meter.feed_work[own.side as usize] += work;
        }
    }
}

impl System {
    /// Returns the pull of the winch from the force on the length.
    #[inline(always)]
    pub(super) fn pull<T: Real, U: Over<T>>(
        &self,
        model: &Model,
        feed: &FeedElement,
        element: &VariableLength<T>,
        q: &[U; 12],
        on_length: U,
    ) -> U
    where
        Single: Load<U>,
    {
        let (rate, square) = (element.extent.rate, square_of_stretch(q));
        // what entering material takes over rho l'^2: the factor of f^2, and the rest
        let [of_square, constant] = match feed.kind {
            Feed::Bag if rate.is_above(0.0) => [0.5, 0.0],
            Feed::Coil if rate.is_above(0.0) => [1.0, 0.0],
            _ => [0.5, -0.5],
        };
        let pull = -on_length - (square * of_square + constant) * (rate * element.inertia * rate);
        if feed.kind != Feed::Coil || !rate.is_above(0.0) {
            return pull;
        }
        // stock from a coil loses its strain energy
        let (e, strain) = (feed.element(model), (square - 1.0) * 0.5);
        let stiffness = model.elements[e].section.axial_stiffness;
        let lost = pull + strain * (0.5 * stiffness) * strain;
        let Some(effects) = &self.forces.in_element else { return lost };
        let mut energy = square.splat(0.0);
        effects.add_rest_energy(square, &Single(e), &mut energy);
        lost + energy * stiffness
    }
}

/// Returns the mean force of strains on the length over a step: D U at fixed coordinates over D l,
/// for `(1/l1 - 1/l0)/(l1 - l0) = -1/(l0 l1)`, from axial and bending energies at both ends and the
/// product of mean chord and mean force on the eye.
fn strain_on_length([u0, u1]: [(f64, f64); 2], [l0, l1]: [f64; 2], of_eye: f64) -> f64 {
    0.5 * (u0.0 / l0 + u1.0 / l1) - (0.5 * (u0.1 * l0 + u1.1 * l1) - l0 * of_eye) / (l0 * l1)
}

/// Returns the square of the stretch at the eye.
#[inline(always)]
fn square_of_stretch<T: Real>(q: &[T; 12]) -> T {
    q[9] * q[9] + q[10] * q[10] + q[11] * q[11]
}

/// Returns what entering material brings beside the force on the length, in N: its kinetic energy
/// and its weight at the eye.
fn entering(element: &VariableLength, weight: &[f64; 3], q: &[f64; 12], v: &[f64; 12]) -> f64 {
    let Extent { rate, .. } = element.extent;
    let mut sum = 0.0;
    for x in 0..3 {
        let speed = v[6 + x] - rate * q[9 + x];
        sum += 0.5 * element.inertia * speed * speed - weight[x] * q[6 + x];
    }
    sum
}
