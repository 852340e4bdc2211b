//! [Impact](super::super::impact) of cables on each other and on themselves.
//!
//! # Equation
//!
//! As for an obstacle, with the rate of the slip for the velocity beside it: that is what the force
//! of the contact works on. An impulse R on it acts as the force does, on both places and on both
//! slopes, so momentum is kept exactly. Normals and slips are those of the matrix, since the normal
//! of a pair turns with it: G is so much more than the masses that an impulse along another would
//! throw the cables aside.
//!
use super::super::impact::When;
use super::step::PairStep;
use nalgebra::Vector3;

impl PairStep {
    /// Finds the velocities beside contacts that push, at the end of the step, and returns the
    /// energy in J of those that they oppose. `mass` is that of an element of a strand per length,
    /// `velocity` that of a nodal vector's combination in one, when the step begins or ends.
    pub fn find_impacts(
        &mut self,
        mass: impl Fn(usize, usize) -> f64,
        velocity: impl Fn(When, usize, usize, &[f64; 4]) -> Vector3<f64>,
    ) -> f64 {
        let mut energy = 0.0;
        for pair in &mut self.points {
            let [one, other] = pair.ends.map(|end| mass(end.strand, end.element));
            let reduced = one * other / (one + other);
            pair.point.clear_impact();
            if pair.point.may_leave() {
                let rate = |when: When| pair.rate(|c, e, shape| velocity(when, c, e, shape));
                let (normal, beside) = (pair.point.linear.tangents.across, rate(When::End));
                let came = if pair.point.restitution > 0.0 { (-normal.dot(&rate(When::Begin))).max(0.0) } else { 0.0 };
                energy += pair.point.find_impact(normal, [beside, Vector3::zeros()], came, (self.h, self.leg, reduced));
            }
        }
        energy
    }

    /// Returns whether any gives velocity by its restitution.
    pub fn gives_velocity(&self) -> bool {
        self.points.iter().any(|pair| pair.point.impact.acts() && pair.point.impact.gives)
    }

    /// Passes what the linear solve sees of them to `add`, by strand and element.
    pub fn pass_impacts(&self, mut add: impl FnMut(usize, usize, &[f64; 12])) {
        for pair in self.points.iter().filter(|pair| pair.point.impact.acts()) {
            let forces = pair.linear_forces(&pair.point.impact.row);
            for (end, force) in pair.ends.iter().zip(&forces) {
                add(end.strand, end.element, force);
            }
        }
    }

    /// Sets the impulses to those of the velocities that are left; `taken` are the changes of
    /// velocities by the linear solve. Returns whether another solve sees more of them.
    pub fn settle_impacts(&mut self, taken: impl Fn(usize, usize, &[f64; 4]) -> Vector3<f64>, first: bool) -> bool {
        let mut changed = false;
        for pair in self.points.iter_mut().filter(|pair| pair.point.impact.acts()) {
            let taken = pair.rate(&taken);
            changed |= pair.point.settle_impact(&taken, self.h, first);
        }
        changed
    }
}
