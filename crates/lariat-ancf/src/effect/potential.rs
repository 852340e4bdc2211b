//! A potential of a point of a cable, written outside the crate: any energy of its position.
//!
//! # Equation
//!
//! ```text
//! F = -grad V(x)        x = S q, the point at an arc length
//! ```
//!
//! Statics and implicit stages take the gradient and the Hessian at the point. A step of the
//! discrete gradient from x0 to x1 takes
//!
//! ```text
//! g = grad V(m) + (V1 - V0 - grad V(m) . d) d/|d|^2        m = (x0 + x1)/2, d = x1 - x0
//! ```
//!
//! so that `g . d = V1 - V0` and the energy law holds with V in it, at any step. Its tangent is the
//! symmetric part of dg/dx1.
//!
//! # Validity
//!
//! Two derivatives of V. Explicit methods do not know its stiffness:
//! [`Cable::frequency_bound`](crate::coupling::Linearisation::frequency_bound) is the cable's
//! alone. A [`Snapshot`](crate::Snapshot) holds the state; the function stays with the cable. A
//! *serialised* cable cannot hold a function: read back, it refuses to step until as many
//! potentials are added again, in the same order; they are where they were.
//!
//! # References
//!
//! Gonzalez, J. Nonlinear Sci. 6 (1996) 449 (the discrete gradient).
//!
//! # Alternatives considered
//!
//! The mean of the gradients at both ends: exact for a spring alone, and elsewhere it makes energy.

use crate::scales::effect::{DIFFERENCE, ENERGY_ROUNDING};
use core::fmt::Debug;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// An energy of your own of a point of a cable, for
/// [`Cable::add_potential`](crate::Cable::add_potential).
pub trait Potential: Debug + Send + Sync {
    /// Returns the energy V in J at a position in m, world axes.
    fn energy(&self, position: &Vector3<f64>) -> f64;

    /// Returns its gradient in N: minus the force on the cable.
    fn gradient(&self, position: &Vector3<f64>) -> Vector3<f64>;

    /// Returns its Hessian in N/m. Default: central differences of the gradient over 1e-5 m.
    fn hessian(&self, position: &Vector3<f64>) -> Matrix3<f64> {
        let column = |k: usize| {
            let by = Vector3::ith(k, DIFFERENCE);
            (self.gradient(&(position + by)) - self.gradient(&(position - by))) / (2.0 * DIFFERENCE)
        };
        let of = Matrix3::from_columns(&[column(0), column(1), column(2)]);
        0.5 * (of + of.transpose())
    }
}

/// Returns the discrete gradient over a step that moves the point from `start` by `change`, and the
/// symmetric part of its derivative by the change.
pub(crate) fn over_step(
    potential: &dyn Potential,
    start: &Vector3<f64>,
    change: &Vector3<f64>,
) -> (Vector3<f64>, Matrix3<f64>) {
    let (middle, end) = (start + 0.5 * change, start + change);
    let (gradient, half) = (potential.gradient(&middle), 0.5 * potential.hessian(&middle));
    let [before, after] = [start, &end].map(|x| potential.energy(x));
    let rest = after - before - gradient.dot(change);
    let square = change.norm_squared();
    if square == 0.0 || rest.abs() <= ENERGY_ROUNDING * (before.abs() + after.abs()) {
        return (gradient, half);
    }
    let slope = potential.gradient(&end) - gradient - half * change;
    let outer = change * slope.transpose();
    let turning = Matrix3::identity() - change * change.transpose() * (2.0 / square);
    (gradient + change * (rest / square), half + (0.5 * (outer + outer.transpose()) + turning * rest) / square)
}

/// A potential, and the material that it acts on. Serialised is its place alone.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "[f64; 2]", into = "[f64; 2]")]
pub(crate) struct Attached {
    /// Arc length in m.
    pub arc_length: f64,
    /// That less what had come through the eye of a reel at the start when it was added: it stays.
    origin: f64,
    /// None if it was not added again since the cable was read back.
    pub potential: Option<Arc<dyn Potential>>,
}

impl From<[f64; 2]> for Attached {
    fn from([arc_length, origin]: [f64; 2]) -> Self {
        Attached { arc_length, origin, potential: None }
    }
}

impl From<Attached> for [f64; 2] {
    fn from(own: Attached) -> Self {
        [own.arc_length, own.origin]
    }
}

impl PartialEq for Attached {
    /// Compares functions by identity.
    fn eq(&self, other: &Self) -> bool {
        let same = match (&self.potential, &other.potential) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        same && (self.arc_length, self.origin) == (other.arc_length, other.origin)
    }
}

/// The potentials of a cable.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Potentials {
    pub list: Vec<Attached>,
}

impl Potentials {
    /// Adds one, in place of the first that is missing, where that was; `passed` is the length in m
    /// that came through the eye at the start.
    pub fn add(&mut self, arc_length: f64, passed: f64, potential: Arc<dyn Potential>) {
        match self.list.iter_mut().find(|own| own.potential.is_none()) {
            Some(own) => own.potential = Some(potential),
            None => self.list.push(Attached { arc_length, origin: arc_length - passed, potential: Some(potential) }),
        }
    }

    /// Number of those that were not added again.
    pub fn missing(&self) -> usize {
        self.list.iter().filter(|own| own.potential.is_none()).count()
    }

    /// Puts them where their material is on a cable of this length (m) after so much came through
    /// the eye at the start.
    pub fn move_to(&mut self, passed: f64, length: f64) {
        self.list.iter_mut().for_each(|own| own.arc_length = (own.origin + passed).clamp(0.0, length));
    }

    /// Cuts the cable at an arc length (m): keeps those before it, and returns the others, on a
    /// cable that begins there.
    pub fn cut(&mut self, at: f64) -> Self {
        let (list, mut rest): (_, Vec<_>) =
            core::mem::take(&mut self.list).into_iter().partition(|own| own.arc_length <= at);
        self.list = list;
        for own in &mut rest {
            own.arc_length -= at;
            own.origin = own.arc_length;
        }
        Potentials { list: rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pull towards a point that stiffens with the distance.
    #[derive(Debug)]
    struct Hardening;

    impl Potential for Hardening {
        fn energy(&self, x: &Vector3<f64>) -> f64 {
            3.0 * x.norm_squared().powi(2) + x.x
        }

        fn gradient(&self, x: &Vector3<f64>) -> Vector3<f64> {
            12.0 * x.norm_squared() * x + Vector3::x()
        }
    }

    /// The product of the discrete gradient and the change is the change of the energy, and the
    /// tangent is its derivative.
    ///
    /// *Source.* The energy at both ends; central differences.
    #[test]
    fn the_discrete_gradient_gives_the_change_of_the_energy() {
        let (start, change) = (Vector3::new(0.3, -0.2, 0.5), Vector3::new(0.4, 0.1, -0.3));
        let (gradient, tangent) = over_step(&Hardening, &start, &change);
        let exact = Hardening.energy(&(start + change)) - Hardening.energy(&start);
        assert!((gradient.dot(&change) - exact).abs() < 1e-14, "{} {exact}", gradient.dot(&change));
        let column = |k: usize| {
            let by = Vector3::ith(k, 1e-5);
            let at = |change: Vector3<f64>| over_step(&Hardening, &start, &change).0;
            (at(change + by) - at(change - by)) / 2e-5
        };
        let of = Matrix3::from_columns(&[column(0), column(1), column(2)]);
        let symmetric = 0.5 * (of + of.transpose());
        assert!((symmetric - tangent).norm() < 1e-6 * tangent.norm(), "{symmetric} {tangent}");
    }
}
