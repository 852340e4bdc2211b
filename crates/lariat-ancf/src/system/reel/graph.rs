//! The law of an unknown rate: a monotone graph of force over acceleration, for motors, brakes,
//! free spools, sheaves and drums alike.
//!
//! # Equation
//!
//! The acceleration a of a length over a step is unknown. F is the force that the system has on it
//! beyond the inertia, P the largest force of motor or friction, a_0 the acceleration at which that
//! does not slip, and N the reaction of the stops:
//!
//! ```text
//! F(a) in P (Sign(a - a_0) + Sign(a - a_1))/2 + N(a)
//! N <= 0 at the least a, N >= 0 at the largest one, else N = 0
//! P = grip max(0, min(F_1, F_2) - lift) + limit
//! ```
//!
//! a_1 is the acceleration at which the slip is zero in the mean of the step, so that F is P of one
//! sign only where slips in the mean and at the end have it, and 0 where the slip turns back but not
//! as far as it came: friction loses energy in every step, `F times the mean slip >= 0`, and what
//! stands stays. Of a motor a_1 = a_0: it has energy to give.
//!
//! | law | F | P | a_0 | a_1 |
//! |---|---|---|---|---|
//! | [motor](super::law), brake, free spool | pull less inertia | largest force | that of the commanded rate | a_0 |
//! | [sheave](super::wheel) | difference of both pulls, less inertia | capstan and bearing | that which stops it | twice that |
//! | [drum](super::drum) | what its spin leaves, with its torque eliminated | 0: the stops alone | none | none |
//!
//! F and the pulls are linear in a within a Newton iteration, and F falls, so the graph is met
//! exactly by one of seven points: two that slip, two corners, one between these, two stops.
//!
//! # Validity
//!
//! With a grip, P grows with the pulls and there can be two points: one that runs on, and one that
//! stops what runs at once with pulls that press it enough. The first is taken if it does not turn
//! back.
//!
//! # References
//!
//! Moreau, Unilateral contact and dry friction in finite freedom dynamics, 1988 (laws as monotone
//! graphs).

/// A number that is linear in the change x of an acceleration: `value - stiffness x`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    pub value: f64,
    pub stiffness: f64,
}

impl Line {
    fn at(&self, x: f64) -> f64 {
        self.value - self.stiffness * x
    }
}

/// The largest force of a law in N, `grip max(0, pull - lift) + limit`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bound {
    pub limit: f64,
    pub grip: f64,
    pub lift: f64,
}

impl Bound {
    /// Returns it under a pull in N.
    pub fn under(&self, pull: f64) -> f64 {
        self.grip * (pull - self.lift).max(0.0) + self.limit
    }
}

/// Accelerations of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Graph {
    pub least: f64,
    /// That which does not slip at the end.
    pub wanted: f64,
    /// That which does not slip in the mean.
    pub balanced: f64,
    pub largest: f64,
}

impl Graph {
    /// Returns the acceleration that is nearest to one, within the stops.
    pub fn bounded(&self, acceleration: f64) -> f64 {
        acceleration.max(self.least).min(self.largest)
    }

    /// Returns the acceleration of a stop, if this one is that or goes beyond it.
    pub fn stop(&self, acceleration: f64) -> Option<f64> {
        let rounding = 1e-9 * (1.0 + acceleration.abs());
        if acceleration > self.largest - rounding {
            Some(self.largest)
        } else {
            (acceleration < self.least + rounding).then_some(self.least)
        }
    }

    /// Returns the two corners, the lower one first.
    fn corners(&self) -> [f64; 2] {
        [self.wanted.min(self.balanced), self.wanted.max(self.balanced)]
    }

    /// Returns the acceleration at which a force meets the graph, from a present one; the lesser of
    /// both `pulls` presses, without inertia the first one where it slips to larger accelerations.
    pub fn meet(&self, present: f64, force: Line, bound: &Bound, pulls: &[Line; 2]) -> f64 {
        let slip = |sign: f64| {
            let with = |grip: f64, pull: &Line| {
                let stiffness = force.stiffness - sign * grip * pull.stiffness;
                let over = force.value - sign * (grip * (pull.value - bound.lift) + bound.limit);
                over / stiffness.max(f64::MIN_POSITIVE)
            };
            // without inertia that towards which it slips is the larger one
            let [less, more] = if sign < 0.0 { [&pulls[1], &pulls[0]] } else { [&pulls[0], &pulls[1]] };
            let (x, y) = (with(bound.grip, less), with(bound.grip, more));
            let (x, pull) = if less.at(x) > more.at(x) && more.at(y) <= less.at(y) { (y, more) } else { (x, less) };
            present + if pull.at(x) >= bound.lift { x } else { with(0.0, pull) }
        };
        let [low, high] = self.corners();
        if self.wanted != 0.0 {
            let running = -1.0f64.copysign(self.wanted);
            let on = slip(running);
            if (on - if running > 0.0 { high } else { low }) * running > 0.0 {
                return self.bounded(on);
            }
        }
        let needed = |at: f64| force.at(at - present);
        let beyond = |at: f64| needed(at).abs() > bound.under(pulls[0].at(at - present).min(pulls[1].at(at - present)));
        let met = if needed(high) >= 0.0 {
            if beyond(high) { slip(1.0) } else { high }
        } else if needed(low) <= 0.0 {
            if beyond(low) { slip(-1.0) } else { low }
        } else {
            present + force.value / force.stiffness.max(f64::MIN_POSITIVE)
        };
        self.bounded(met)
    }

    /// Returns by how much a force in N at an acceleration is off the graph, whose largest force is
    /// `bound` (N).
    pub fn violation(&self, acceleration: f64, force: f64, bound: f64) -> f64 {
        let rounding = 1e-12 * (1.0 + acceleration.abs());
        let [low, high] = self.corners().map(|corner| acceleration - corner);
        let sign = |slip: f64| if slip.abs() <= rounding { [-1.0, 1.0] } else { [1.0f64.copysign(slip); 2] };
        let ([a, b], [c, d]) = (sign(low), sign(high));
        let [mut least, mut most] = [0.5 * bound * (a + c), 0.5 * bound * (b + d)];
        if acceleration >= self.largest - rounding {
            most = f64::INFINITY;
        }
        if acceleration <= self.least + rounding {
            least = f64::NEG_INFINITY;
        }
        (force - most).max(0.0) + (least - force).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The point that is met is on the graph: of motors, and of sheaves with and without inertia, at
    /// rest and running, with stops near and far. Friction loses energy.
    ///
    /// *Source.* The graph itself: force, bound and stops at the point.
    #[test]
    fn what_is_met_is_on_the_graph() {
        let (mut seen, mut seed) = ([0; 4], 1u64);
        // any number in -1..1
        let mut any = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        for i in 0..20_000 {
            let wanted = if i % 3 == 0 { 0.0 } else { 4.0 * any() };
            // of a motor, or of friction on what runs against it
            let balanced = if i % 4 == 0 { wanted } else { wanted * (1.0 + any().abs()) };
            let graph =
                Graph { least: wanted - 9.0 * any().abs(), wanted, balanced, largest: wanted + 9.0 * any().abs() };
            let pulls = [-1.0, 1.0].map(|sign| {
                let stiffness = sign * (0.1 + any().abs());
                Line { value: 2.0 + 10.0 * any(), stiffness }
            });
            let [a, b] = pulls;
            let present = 5.0 * any();
            let inertia = if i % 5 < 2 { 0.0 } else { 4.0 * any().abs() };
            let force = Line {
                value: b.value - a.value - inertia * present,
                stiffness: b.stiffness - a.stiffness + inertia,
            };
            let grip = if i % 2 == 0 { 0.0 } else { 3.0 * any().abs() };
            let bound = Bound { limit: 3.0 * any().abs(), grip, lift: 0.3 * any().abs() };
            let at = graph.meet(present, force, &bound, &pulls);
            let x = at - present;
            let missed = graph.violation(at, force.at(x), bound.under(a.at(x).min(b.at(x))));
            assert!(missed < 1e-9, "{i}: {missed:e} at {at} of {graph:?}, {force:?}, {bound:?}");
            if at > graph.least && at < graph.largest {
                let power = force.at(x) * (at - balanced);
                assert!(i % 4 == 0 || power > -1e-9, "{i}: {power:e} at {at} of {graph:?}, {force:?}, {bound:?}");
            }
            seen[if at == wanted {
                0
            } else if at == graph.least {
                1
            } else if at == graph.largest {
                2
            } else {
                3
            }] += 1;
        }
        assert!(seen.iter().all(|count| *count > 1000), "{seen:?}");
    }
}
