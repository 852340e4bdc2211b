//! Reels whose rate is an unknown, in the equations of their cable. Equation: [`law`](super::law).

use super::graph::Graph;
use super::law::Law;
use super::step::StepMotion;
use super::{FeedElement, Feeds};
use crate::Real;
use crate::effect::acts::Single;
use crate::element::kernel::Load;
use crate::element::variable_length::Extent;
use crate::model::Model;
use crate::real::Over;
use crate::reel::Feed;
use crate::state::State;
use crate::system::Equations;
use crate::system::{StepVectors, System};
use crate::term::{Account, Balance};

impl FeedElement {
    /// Returns the pull in N in the last iterate, at a sheave.
    pub(super) fn pull_of_iterate(&self) -> f64 {
        self.law.map_or(0.0, |law| law.force)
    }

    /// Begins a step of length `h` (s) with another rate in m/s, that of a drum.
    pub fn restart(&mut self, rate: f64, h: f64) {
        self.extent.rate = rate;
        if let Some(law) = &mut self.law {
            law.begin(&self.extent, self.start, h);
        }
    }

    /// Sets the acceleration that a drum gives; one beyond the reach of an iterate divides the
    /// step.
    pub fn follow(&mut self, acceleration: f64) {
        let [least, largest] = self.reach();
        self.linearised = self.extent.acceleration;
        self.extent.acceleration = acceleration.max(least).min(largest);
        self.stopped = self.law.is_some_and(|law| law.graph.stop(acceleration).is_some());
    }

    /// Returns whether a motor holds the rate that is asked for, with a force in N of the last
    /// iterate that it has.
    fn sticks(&self) -> bool {
        self.law.is_none_or(|law| {
            let alone = !matches!(self.kind, Feed::Sheave | Feed::BodyDrum);
            alone && self.extent.acceleration == law.bounded(law.graph.wanted) && law.force.abs() <= law.limit
        })
    }

    /// Returns the length in m that it can still take in.
    pub(super) fn left(&self) -> f64 {
        self.law.map_or(0.0, |law| self.extent.length - law.motor.bounds[0])
    }

    /// Returns the accelerations beyond which no iterate goes.
    pub(super) fn reach(&self) -> [f64; 2] {
        self.law.map_or([0.0; 2], |law| law.reach)
    }
}

impl Feeds {
    /// Returns whether all rates that could be unknown are as the last iterate has them: the motors
    /// of all [stick](FeedElement::sticks). If the result of an iteration breaks a law, the next
    /// one solves for the rates.
    pub fn stick(&self) -> bool {
        self.list.iter().all(FeedElement::sticks)
    }
}

impl Law {
    /// Returns the product of the row of a feed and the increments of the velocity changes of its
    /// cable.
    pub(super) fn along_row(&self, feed: &FeedElement, increment: &[f64]) -> f64 {
        self.row.iter().zip(feed.side.gather(increment)).map(|(a, b)| a * b).sum()
    }
}

impl System {
    /// Returns the force in N of the motor of a feed at an extent, from the force on the length.
    #[inline(always)]
    pub(super) fn motor<T: Real, U: Over<T>>(
        &self,
        model: &Model,
        feed: &FeedElement,
        extent: Extent<T>,
        q: &[U; 12],
        on_length: U,
    ) -> U
    where
        Single: Load<U>,
    {
        let element = feed.with(model, extent);
        let mut wheel = extent.length.splat(0.0);
        if let Some(law) = &feed.law {
            wheel = wheel + law.motor.wheel;
            let stock = law.motor.bounds[1];
            if matches!(feed.kind, Feed::Drum | Feed::BodyDrum) && stock.is_finite() {
                wheel = wheel + (-(extent.length - stock)).at_least(0.0) * element.inertia;
            }
        }
        self.pull(model, feed, &element, q, on_length) - wheel * extent.acceleration
    }
}

impl Equations<'_> {
    /// Begins a step of length `h` (s) for reels whose rate is unknown: sets the first iterate.
    pub fn begin_laws(&mut self, time: f64, h: f64) {
        for feed in self.system.feeds.list.iter_mut() {
            if !feed.extent.acceleration.is_finite() {
                // left by the last iterate of a step that failed
                feed.extent.acceleration = 0.0;
            }
            let extent = feed.at(time);
            let Some(law) = &mut feed.law else { continue };
            feed.on_length.begin = None;
            if feed.kind == Feed::BodyDrum && (feed.start != time || feed.left_rate.is_none()) {
                feed.left_rate = Some(extent.rate);
            }
            let slipped = feed.extent.acceleration != law.graph.wanted;
            (feed.start, feed.extent) = (time, extent);
            law.begin(&extent, time, h);
            let Graph { least, wanted, largest, .. } = law.graph;
            feed.extent.acceleration = law.bounded(if slipped { extent.acceleration } else { wanted });
            feed.stopped = wanted == least || wanted == largest;
        }
    }

    /// Computes the forces of the motors of the present iterate.
    pub fn read_motors(&mut self, state: &State, b: &StepVectors) {
        for k in 0..self.system.feeds.list.len() {
            let feed = &self.system.feeds.list[k];
            if feed.law.is_none() {
                continue;
            }
            let on_length = self.on_length_of_step(feed, state, b);
            let (mean, [q, ..]) = (feed.over(state.time, b.h).0, StepMotion::of(feed, state, b).mean(b.h));
            let force = self.system.motor(self.model, feed, mean, &q, on_length.force);
            let feed = &mut self.system.feeds.list[k];
            feed.on_length = on_length;
            feed.law.iter_mut().for_each(|law| law.force = force);
        }
    }

    /// Adds to a balance by how much the motors break their laws.
    pub fn balance_motors(&mut self, state: &State, b: &StepVectors, balance: &mut Balance) {
        self.read_motors(state, b);
        for feed in &self.system.feeds.list {
            if let Some(law) = &feed.law {
                let acceleration = feed.extent.acceleration;
                // a sheave has one law for both of its feeds, and a drum that of its body
                if !matches!(feed.kind, Feed::Sheave | Feed::BodyDrum) {
                    let entry = balance.to(Account::Reels);
                    entry.missed += law.graph.violation(acceleration, law.force, law.limit);
                    entry.forces += law.force.abs();
                }
                if law.reach.contains(&acceleration) {
                    // no law of energy: the step is divided
                    balance.residual = f64::NAN;
                }
            }
        }
    }

    /// Adds an increment to the acceleration of the iterate.
    pub fn add_to_law(&mut self, k: usize, increment: f64) {
        let feed = &mut self.system.feeds.list[k];
        feed.linearised = feed.extent.acceleration;
        feed.extent.acceleration += increment;
    }
}
