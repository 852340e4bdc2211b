//! The laws of contact: normal force by depth, friction by return mapping.
//!
//! # Equation
//!
//! ```text
//! p(d) = k d^2/(2 delta) below delta, k (d - delta/2) above, 0 outside          N/m, delta = r/50
//! t = u0 + s;  k_t |t| <= c: u = t, else u = c/k_t t/|t|;   f = -k_t u           k_t = k w/10
//! ```
//!
//! c is the bound of friction. The tangents `-df/ds` are `k_t P` while it sticks and `c k_t/|k_t t|
//! (P - e e^T)` while it slips: both positive semi-definite.

use crate::effect::Contact;
use crate::scales::contact::{RAMP, TANGENTIAL};
use crate::section::Section;
use nalgebra::{Matrix3, Vector3};

/// The normal law, per length.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NormalLaw {
    /// Stiffness k in N/m^2.
    pub(in crate::contact) stiffness: f64,
    /// Depth delta in m of its start.
    ramp: f64,
}

/// Force per length in N/m, its derivative by the depth in N/m^2, and the energy per length in J/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::contact) struct Pressure {
    pub force: f64,
    pub slope: f64,
    pub energy: f64,
}

impl NormalLaw {
    /// Of a cable of this section.
    pub fn of(contact: &Contact, section: &Section) -> Self {
        NormalLaw::new(contact.stiffness_of(section), contact.radius_of(section))
    }

    /// For a cable of radius `radius` (m).
    pub fn new(stiffness: f64, radius: f64) -> Self {
        NormalLaw { stiffness, ramp: RAMP * radius }
    }

    /// Returns the law that is so soft and smooth that `force` per length (N/m) has `depth` (m);
    /// itself if it is as soft.
    pub(in crate::contact) fn softened(self, force: f64, depth: f64) -> Self {
        let stiffness = force / depth;
        if stiffness < self.stiffness { NormalLaw { stiffness, ramp: depth.max(self.ramp) } } else { self }
    }

    /// Returns the law of two cables that touch each other.
    pub(in crate::contact) fn in_series(one: NormalLaw, other: NormalLaw) -> Self {
        let (a, b) = (one.stiffness, other.stiffness);
        NormalLaw { stiffness: a * b / (a + b), ramp: 0.5 * (one.ramp + other.ramp) }
    }

    /// Returns the force at a depth (m).
    pub(in crate::contact) fn at(&self, depth: f64) -> Pressure {
        let NormalLaw { stiffness: k, ramp: delta } = *self;
        if depth <= 0.0 {
            Pressure { force: 0.0, slope: 0.0, energy: 0.0 }
        } else if depth < delta {
            let slope = k * depth / delta;
            Pressure { force: 0.5 * slope * depth, slope, energy: slope * depth * depth / 6.0 }
        } else {
            let x = depth - delta;
            let energy = k * (delta * delta / 6.0 + 0.5 * x * delta + 0.5 * x * x);
            Pressure { force: k * (0.5 * delta + x), slope: k, energy }
        }
    }

    /// Returns the depth at which the energy per length is `energy` >= 0 (J/m).
    pub(in crate::contact) fn depth_of_energy(&self, energy: f64) -> f64 {
        let NormalLaw { stiffness: k, ramp: delta } = *self;
        if energy < k * delta * delta / 6.0 {
            (6.0 * delta * energy / k).cbrt()
        } else {
            0.5 * delta + (2.0 * energy / k - delta * delta / 12.0).sqrt()
        }
    }

    /// Returns the depth at which the force per length is `force` > 0 (N/m).
    pub(in crate::contact) fn depth_of(&self, force: f64) -> f64 {
        let NormalLaw { stiffness: k, ramp: delta } = *self;
        if force < 0.5 * k * delta { (2.0 * delta * force / k).sqrt() } else { 0.5 * delta + force / k }
    }
}

/// Friction over a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Friction {
    /// Spring at the end in m.
    pub spring: Vector3<f64>,
    /// Stiffness k_t in N/m.
    pub stiffness: f64,
    /// Direction in which it slips.
    pub slides: Option<Vector3<f64>>,
    /// Share `c/(k_t |t|)` of the trial force that is left; 1 while it sticks.
    share: f64,
    /// Energy in J that it loses.
    pub loss: f64,
}

/// Returns friction with the bound `bound` (N) on a surface with the unit normal `normal`, for a
/// contact of the normal stiffness `stiffness` (N/m); `before` is the spring at the beginning (m),
/// `slip` the motion beside the surface. With `sticks` the bound is ignored.
#[inline]
pub(in crate::contact) fn friction(
    stiffness: f64,
    bound: f64,
    normal: &Vector3<f64>,
    before: &Vector3<f64>,
    slip: &Vector3<f64>,
    sticks: bool,
) -> Friction {
    let k = TANGENTIAL * stiffness;
    let tangential = |x: &Vector3<f64>| x - normal * normal.dot(x);
    let (slip, trial) = (tangential(slip), tangential(&(before + slip)));
    let (spring, share, slides) = if k * k * trial.norm_squared() <= bound * bound || sticks {
        (trial, 1.0, None)
    } else {
        let size = k * trial.norm();
        (trial * (bound / size), bound / size, Some(trial * (k / size)))
    };
    let loss = k * (spring.dot(&slip) - 0.5 * (spring.norm_squared() - before.norm_squared()));
    Friction { spring, stiffness: k, slides, share, loss }
}

impl Friction {
    /// Returns minus the derivative of the force by the slip, on a surface with the unit normal
    /// `normal`.
    pub fn tangent(&self, normal: &Vector3<f64>) -> Matrix3<f64> {
        let mut plane = Matrix3::identity() - normal * normal.transpose();
        if let Some(e) = self.slides {
            plane -= e * e.transpose();
        }
        plane * (self.stiffness * self.share)
    }
}

/// Returns the energy in J of a spring of friction (m).
pub(in crate::contact) fn spring_energy(stiffness: f64, spring: &Vector3<f64>) -> f64 {
    0.5 * TANGENTIAL * stiffness * spring.norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Force and slope are the derivatives of energy and force, and the depth of a force is the
    /// inverse.
    ///
    /// *Source.* Central differences.
    #[test]
    fn the_normal_law_is_the_derivative_of_its_energy() {
        let law = NormalLaw::new(1e9, 5e-3);
        for depth in [1e-6, 4e-5, 1.2e-4, 2e-3] {
            let d = 1e-4 * depth;
            let (low, high, at) = (law.at(depth - d), law.at(depth + d), law.at(depth));
            assert!(((high.energy - low.energy) / (2.0 * d) / at.force - 1.0).abs() < 1e-7);
            assert!(((high.force - low.force) / (2.0 * d) / at.slope - 1.0).abs() < 1e-7);
            assert!((law.depth_of(at.force) / depth - 1.0).abs() < 1e-14);
            assert!((law.depth_of_energy(at.energy) / depth - 1.0).abs() < 1e-14);
        }
        assert_eq!(law.at(-1e-3), Pressure { force: 0.0, slope: 0.0, energy: 0.0 });
    }

    /// The tangents of stick and slip are the derivatives of the force, friction stays within its
    /// bound, and it loses energy for any bound and any slip.
    ///
    /// *Source.* Central differences; the definition.
    #[test]
    fn friction_has_its_exact_tangent_and_loses_energy() {
        let (k, normal) = (1e6, Vector3::new(0.0, 0.6, 0.8));
        let before = Vector3::new(1e-5, 2e-5, -1.5e-5);
        let sign = |i: usize, k: u32| if (i >> k) & 1 == 1 { 1.0 } else { -1.0 };
        for bound in [0.0, 0.3, 5.0, 1e3] {
            for i in 0..8 {
                let slip = 3e-5 * Vector3::new(sign(i, 0), 0.8 * sign(i, 1), 0.3 * sign(i, 2));
                let at = |slip: &Vector3<f64>| friction(k, bound, &normal, &before, slip, false);
                let f = at(&slip);
                assert!(f.loss >= -1e-18, "{bound} {slip:?} {}", f.loss);
                assert!(f.stiffness * f.spring.norm() <= bound * (1.0 + 1e-12) || f.slides.is_none());
                for c in 0..3 {
                    let d = 1e-9 * Vector3::ith(c, 1.0);
                    let slope = (at(&(slip + d)).spring - at(&(slip - d)).spring) * (f.stiffness / 2e-9);
                    assert!((slope - f.tangent(&normal).column(c)).norm() < 1e-4 * f.stiffness, "{bound} {slip:?}");
                }
            }
        }
    }
}
