//! A sheave: two reels at one point with opposite feed, and one law for both.
//!
//! # Equation
//!
//! Material runs from the end of one cable, whose element has the length `l_a - u`, to that of another, `l_b + u`. The acceleration of u over
//! a step of the discrete gradient is unknown, as that of a [reel with a motor](super::law). With the pulls F of both, the inertia m of the
//! wheel over the square of its radius, and the friction P
//!
//! ```text
//! m u'' = F_b - F_a - P          u' = 0 and |P| <= b,   or   u' != 0 and P = b sign(u')
//! b = (exp(mu theta) - 1) max(0, min(F_a, F_b) - rho u'^2) + brake
//! ```
//!
//! theta is the angle between the tangents of both cables at the sheave when the step begins, with whole turns added; `rho u'^2` is what the
//! running rope takes off the pressure. A step can have two solutions, since b grows with the pulls: one that runs on, and one that stops
//! it at once with pulls that press it enough. Of a wheel that runs, the first is taken if it does not turn back; otherwise, and for one at
//! rest, the friction that u' = 0 at the end of the step needs decides whether it slips. b is that of the unknown pulls, not of the
//! iterate before. Near the end of a cable u'' is bounded, as for a reel.
//!
//! What leaves one cable enters the other at the same point, so neither row of an eye has an inflow of momentum: the sum of both is the
//! force on what holds the sheave.
//!
//! # Validity
//!
//! A wheel whose two ends are points of what holds it, one density on both sides. What is on the wheel between them has no weight, and its
//! mass is to be counted to the inertia. Friction is that of a rope on a wheel that stands, or of a bearing: with it, the inertia
//! is that of what turns with the rope.
//!
//! # References
//!
//! Euler 1769 (the capstan); Peng, Wei & Zhou, Appl. Math. Mech. 38 (2017) 1785 (cables that run over pulleys).
//!
//! # Alternatives considered
//!
//! The bound from the pulls of the iterate before: the iteration contracts with (exp(mu theta) - 1)/2 and diverges for large angles.

use super::law::rates;
use super::sheave::Sheave;
use super::{FeedElement, Feeds};
use crate::element::side::Side;
use crate::element::variable_length::Extent;
use crate::term::{Account, Balance};

/// Deceleration in m/s^2 with which a cable stops before its end reaches a sheave or the drum that it is on.
pub(crate) const STOP: f64 = 100.0;

/// A sheave in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wheel {
    pub sheave: Sheave,
    /// exp(mu theta) - 1.
    grip: f64,
    /// Mass per length in kg/m times the square of the rate, in N.
    lift: f64,
    /// Accelerations: least, that which stops it, largest.
    planned: [f64; 3],
    /// Unknowns of its feeds.
    pub feeds: [usize; 2],
    /// Acceleration of the iterate before, and the increment that its linear equations asked for.
    before: Option<[f64; 2]>,
}

/// Pulls in N of both cables at a sheave, linear in the increment x of the acceleration: `F - k x`, and the acceleration of the iterate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pulls {
    pub force: [f64; 2],
    pub stiffness: [f64; 2],
    pub acceleration: f64,
}

impl Wheel {
    /// Creates the wheel of a sheave.
    pub fn new(sheave: Sheave) -> Self {
        Wheel { sheave, grip: 0.0, lift: 0.0, planned: [0.0; 3], feeds: [0; 2], before: None }
    }

    /// Begins a step of length `h` (s): `feeds` are those of its cables, `tangents` their tangents there, away from the cables, and
    /// `inertia` the mass per length in kg/m. Returns the acceleration of the first iterate.
    pub fn begin(&mut self, feeds: [&FeedElement; 2], tangents: [[f64; 3]; 2], inertia: f64, h: f64) -> f64 {
        self.before = None;
        let rate = feeds[1].extent.rate;
        let left = feeds.map(|feed| feed.left());
        let [least, largest] = rates(STOP, rate, [left[1], left[0]], h);
        let reach = [feeds[1].reach()[0].max(-feeds[0].reach()[1]), feeds[1].reach()[1].min(-feeds[0].reach()[0])];
        self.planned = [least, 0.0f64.clamp(least, largest), largest].map(|end| (end - rate) / h);
        let planned = self.planned;
        self.planned[0] = planned[0].max(reach[0]).min(reach[1]);
        self.planned[2] = planned[2].min(reach[1]).max(reach[0]);
        let [a, b] = tangents;
        let dot: f64 = (0..3).map(|x| -a[x] * b[x]).sum();
        let norm = |t: [f64; 3]| t.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cosine = dot / (norm(a) * norm(b)).max(f64::MIN_POSITIVE);
        let angle = cosine.clamp(-1.0, 1.0).acos() + self.sheave.turns;
        self.grip = if self.sheave.friction > 0.0 { (self.sheave.friction * angle).exp() - 1.0 } else { 0.0 };
        self.lift = inertia * rate * rate;
        let present = if rate == 0.0 { self.planned[1] } else { feeds[1].extent.acceleration };
        self.bounded(present)
    }

    fn bounded(&self, acceleration: f64) -> f64 {
        acceleration.max(self.planned[0]).min(self.planned[2])
    }

    /// Returns the largest friction in N under these pulls.
    fn bound(&self, [a, b]: [f64; 2]) -> f64 {
        self.grip * (a.min(b) - self.lift).max(0.0) + self.sheave.brake
    }

    /// Returns the acceleration that meets the law.
    pub(super) fn acceleration_for(&self, pulls: &Pulls) -> f64 {
        let Pulls { force: [a, b], stiffness: [ka, kb], acceleration: present } = *pulls;
        // F_b - F_a - m A - sign (grip (F_low - lift) + brake) = 0; the cable that brakes has the lower pull
        let slip = |sign: f64| {
            let with = |grip: f64| {
                let (of_a, of_b) = if sign > 0.0 { (1.0 + grip, 1.0) } else { (1.0, 1.0 + grip) };
                let force =
                    of_b * b - of_a * a - self.sheave.inertia * present + sign * (grip * self.lift - self.sheave.brake);
                let stiffness = of_b * kb - of_a * ka + self.sheave.inertia;
                (force / stiffness.max(f64::MIN_POSITIVE), if sign > 0.0 { (a, ka) } else { (b, kb) })
            };
            let (x, (low, k)) = with(self.grip);
            present + if low - k * x >= self.lift { x } else { with(0.0).0 }
        };
        let wanted = self.planned[1];
        let running = -1.0f64.copysign(wanted);
        if wanted != 0.0 {
            let on = slip(running);
            if (on - wanted) * running > 0.0 {
                return self.bounded(on);
            }
        }
        let x = wanted - present;
        let at_rest = [a - ka * x, b - kb * x];
        let needed = at_rest[1] - at_rest[0] - self.sheave.inertia * wanted;
        let bound = self.bound(at_rest);
        if needed.abs() <= bound && bound > 0.0 {
            return self.bounded(wanted);
        }
        self.bounded(slip(1.0f64.copysign(needed)))
    }

    /// Returns the increment for an iterate of this acceleration whose linear equations ask for `increment`: by the secant of what they asked
    /// for at the last two iterates. Their matrix is the symmetric part of the derivative, so that on a short element at an eye the
    /// iteration would go too far and diverge; with the whole derivative the secant changes nothing.
    pub(super) fn secant(&mut self, acceleration: f64, increment: f64) -> f64 {
        let before = self.before.replace([acceleration, increment]);
        let asked = acceleration + increment;
        if self.planned.contains(&asked) {
            return increment;
        }
        let slope = before.map_or(-1.0, |[at, then]| (increment - then) / (acceleration - at));
        if slope < -1.0 { -increment / slope } else { increment }
    }

    /// Returns the friction in N of an iterate, and by how much it breaks the law.
    fn violation(&self, force: [f64; 2], acceleration: f64) -> (f64, f64) {
        let [least, wanted, largest] = self.planned;
        let friction = force[1] - force[0] - self.sheave.inertia * acceleration;
        let (bound, rounding) = (self.bound(force), 1e-12 * (1.0 + acceleration.abs()));
        let missed = if (acceleration - wanted).abs() <= rounding {
            // at a stop, that takes what friction does not
            let beyond = if wanted >= largest - rounding { 0.0 } else { (friction - bound).max(0.0) };
            let below = if wanted <= least + rounding { 0.0 } else { (-bound - friction).max(0.0) };
            beyond.max(below)
        } else if acceleration >= largest - rounding {
            (bound - friction).max(0.0)
        } else if acceleration <= least + rounding {
            (bound + friction).max(0.0)
        } else {
            (friction - bound.copysign(acceleration - wanted)).abs()
        };
        (friction, missed)
    }

    /// Adds to a balance by how much the iterate breaks the law; the feeds hold its pulls.
    pub fn add_balance(&self, feeds: [&FeedElement; 2], balance: &mut Balance) {
        let acceleration = feeds[1].extent.acceleration;
        let (_, missed) = self.violation(feeds.map(FeedElement::pull_of_iterate), acceleration);
        let entry = balance.to(Account::Reels);
        entry.missed += missed;
        entry.forces += feeds.iter().map(|feed| feed.pull_of_iterate().abs()).sum::<f64>();
    }

    /// Returns whether friction stops it in the iterate although it runs when the step begins: a long
    /// step may have such a solution beside the one that runs on.
    pub fn stops(&self, feeds: [&FeedElement; 2]) -> bool {
        self.grip > 0.0 && self.planned[1] != 0.0 && feeds[1].extent.acceleration == self.planned[1]
    }

    /// Adds an accepted step of length `h` (s) from `time` to what passed and was lost.
    pub fn accept(&mut self, feeds: [&FeedElement; 2], time: f64, h: f64) {
        let Extent { rate, .. } = feeds[1].over(time, h).0;
        self.sheave.force = self.violation(feeds.map(FeedElement::pull_of_iterate), feeds[1].extent.acceleration).0;
        self.sheave.passed += rate * h;
        self.sheave.lost += self.sheave.force * rate * h;
    }
}

impl Feeds {
    /// Returns the feed at an end.
    pub fn at_side(&self, side: Side) -> Option<&FeedElement> {
        self.list.iter().find(|feed| feed.side == side)
    }
}
