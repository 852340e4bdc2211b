//! A sheave: two reels at one point with opposite feed, and one law for both.
//!
//! # Equation
//!
//! Material runs from the end of one cable, whose element has the length `l_a - u`, to that of
//! another, `l_b + u`. The acceleration of u over a step of the discrete gradient is unknown, as
//! that of a [reel with a motor](super::law). With the pulls F of both, the inertia m of the wheel
//! over the square of its radius, and the friction P
//!
//! ```text
//! m u'' = F_b - F_a - P          P in b Sign(u')
//! b = (exp(mu theta) - 1) max(0, min(F_a, F_b) - rho u'^2) + brake
//! ```
//!
//! theta is the angle between the tangents of both cables at the sheave when the step begins, with
//! whole turns added; `rho u'^2` is what the running rope takes off the pressure. The
//! [graph](super::graph) is met at the end of the step; b is that of the unknown pulls, not of the
//! iterate before. Near the end of a cable u'' is bounded, as for a reel.
//!
//! What leaves one cable enters the other at the same point, so neither row of an eye has an inflow
//! of momentum: the sum of both is the force on what holds the sheave.
//!
//! # Validity
//!
//! A wheel whose two ends are points of what holds it, one density on both sides. What is on the
//! wheel between them has no weight, and its mass is to be counted to the inertia. Friction is that
//! of a rope on a wheel that stands, or of a bearing: with it, the inertia is that of what turns
//! with the rope.
//!
//! # References
//!
//! Euler 1769 (the capstan); Peng, Wei & Zhou, Appl. Math. Mech. 38 (2017) 1785 (cables that run
//! over pulleys).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/reels.md.

use super::graph::{Bound, Graph, Line};
use super::law::rates;
use super::sheave::Sheave;
use super::{FeedElement, Feeds};
use crate::element::side::Side;
use crate::element::variable_length::Extent;
use crate::scales::reel::STOP;
use crate::term::{Account, Balance};

/// A sheave in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wheel {
    pub sheave: Sheave,
    /// Friction: the grip is exp(mu theta) - 1, the lift the mass per length times the square of
    /// the rate.
    bound: Bound,
    /// Accelerations: the one that does not slip stops it.
    graph: Graph,
    /// Unknowns of its feeds.
    pub feeds: [usize; 2],
}

impl Wheel {
    /// Creates the wheel of a sheave.
    pub fn new(sheave: Sheave) -> Self {
        Wheel { sheave, bound: Bound::default(), graph: Graph::default(), feeds: [0; 2] }
    }

    /// Begins a step of length `h` (s): `feeds` are those of its cables, `tangents` their tangents
    /// there, away from the cables, and `inertia` the mass per length in kg/m. Returns the
    /// acceleration of the first iterate.
    pub fn begin(&mut self, feeds: [&FeedElement; 2], tangents: [[f64; 3]; 2], inertia: f64, h: f64) -> f64 {
        let rate = feeds[1].extent.rate;
        let left = feeds.map(|feed| feed.left());
        let [least, largest] = rates(STOP, rate, [left[1], left[0]], h);
        let reach = [feeds[1].reach()[0].max(-feeds[0].reach()[1]), feeds[1].reach()[1].min(-feeds[0].reach()[0])];
        let accelerate = |end: f64| (end.clamp(least, largest) - rate) / h;
        let [least, largest] = [least, largest].map(|end| accelerate(end).max(reach[0]).min(reach[1]));
        self.graph = Graph { least, wanted: accelerate(0.0), balanced: accelerate(-rate), largest };
        self.bound = self.sheave.bound(tangents, inertia * rate * rate);
        let present = if rate == 0.0 { self.graph.wanted } else { feeds[1].extent.acceleration };
        self.graph.bounded(present)
    }

    /// Returns the acceleration that meets the law, from the pulls of both cables about the present
    /// one.
    pub(super) fn acceleration_for(&self, present: f64, pulls: &[Line; 2]) -> f64 {
        let ([a, b], inertia) = (pulls, self.sheave.inertia);
        let force =
            Line { value: b.value - a.value - inertia * present, stiffness: b.stiffness - a.stiffness + inertia };
        self.graph.meet(present, force, &self.bound, pulls)
    }

    /// Returns the friction in N of an iterate.
    fn friction(&self, [a, b]: [f64; 2], acceleration: f64) -> f64 {
        b - a - self.sheave.inertia * acceleration
    }

    /// Adds to a balance what friction takes over a step of length `h` (s) from `time`, and by how
    /// much the iterate breaks the law; the feeds hold its pulls. Where that makes friction push,
    /// its work is energy that the step makes.
    pub fn add_balance(&self, feeds: [&FeedElement; 2], (time, h): (f64, f64), balance: &mut Balance) {
        let Extent { rate, acceleration, .. } = feeds[1].over(time, h).0;
        let [a, b] = feeds.map(FeedElement::pull_of_iterate);
        let (friction, bound) = (self.friction([a, b], acceleration), self.bound.under(a.min(b)));
        let taken = friction * rate * h;
        balance.residual += (-taken).max(0.0);
        let entry = balance.to(Account::Reels);
        entry.aside += taken.max(0.0);
        entry.missed += self.graph.violation(acceleration, friction, bound);
        entry.forces += a.abs() + b.abs();
    }

    /// Returns whether friction stops it in the iterate although it runs when the step begins: a
    /// long step may have such a solution beside the one that runs on.
    pub fn stops(&self, feeds: [&FeedElement; 2]) -> bool {
        let wanted = self.graph.wanted;
        self.bound.grip > 0.0 && wanted != 0.0 && feeds[1].extent.acceleration == wanted
    }

    /// Adds an accepted step of length `h` (s) from `time` to what passed and was lost.
    pub fn accept(&mut self, feeds: [&FeedElement; 2], time: f64, h: f64) {
        let Extent { rate, .. } = feeds[1].over(time, h).0;
        self.sheave.force = self.friction(feeds.map(FeedElement::pull_of_iterate), feeds[1].extent.acceleration);
        self.sheave.passed += rate * h;
        self.sheave.lost += self.sheave.force * rate * h;
    }
}

impl Sheave {
    /// Returns its friction between cables with these tangents there, away from the cables; `lift`
    /// in N is what the running rope takes off the pressure.
    fn bound(&self, [a, b]: [[f64; 3]; 2], lift: f64) -> Bound {
        let dot: f64 = (0..3).map(|x| -a[x] * b[x]).sum();
        let norm = |t: [f64; 3]| t.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cosine = dot / (norm(a) * norm(b)).max(f64::MIN_POSITIVE);
        let angle = cosine.clamp(-1.0, 1.0).acos() + self.turns;
        let grip = if self.friction > 0.0 { (self.friction * angle).exp() - 1.0 } else { 0.0 };
        Bound { limit: self.brake, grip, lift }
    }

    /// Returns its friction in N between cables that rest, with these tangents and pulls.
    pub(crate) fn friction_at_rest(&self, tangents: [[f64; 3]; 2], [a, b]: [f64; 2]) -> f64 {
        self.bound(tangents, 0.0).under(a.min(b))
    }
}

impl Feeds {
    /// Returns the feed at an end.
    pub fn at_side(&self, side: Side) -> Option<&FeedElement> {
        self.list.iter().find(|feed| feed.side == side)
    }
}
