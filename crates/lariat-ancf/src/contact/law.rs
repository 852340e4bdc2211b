//! The laws of contact: normal force by depth, friction by return mapping.
//!
//! # Equation
//!
//! ```text
//! p(d) = k d^2/(2 delta) below delta, k (d - delta/2) above, 0 outside          N/m, delta = r/50
//! t = k_t (u0 + s) + r s;  |t| <= c: f = -t, else f = -c t/|t|;   u = (r u0 - f)/(k_t + r)     k_t = k w/10
//! r = 10 w sqrt(k m/10)/h
//! ```
//!
//! s is the slip of a step of length h, c the bound of friction, m the mass per length. The spring
//! u has a damper beside it, of five times the critical damping of what it carries: the same part
//! as that of the [normal law](super::rebound). The cone bounds the sum of both. So a load that is
//! put on at once stretches the spring to its own force, and not to twice that, which would slip.
//! Where it slips steadily, or rests, u does not change, and the force is that of Coulomb's law.
//! The tangents `-df/ds` are `(k_t + r) P` while it sticks and `c (k_t + r)/|t| (P - e e^T)`, e =
//! t/|t|, while it slips: both positive semi-definite.
//!
//! # Energy
//!
//! With `-f = k_t u + r D u` and what slips, `s - D u = (t + f)/(k_t + r)`, along -f,
//!
//! ```text
//! -f . s = D (k_t u^2/2) + k_t D u^2/2 + r D u^2 - f . (s - D u)
//! ```
//!
//! of which all but the first term is lost, and at least zero, for any bound.
//!
//! # Validity
//!
//! The mass is that of the cable alone: under a heavier body, which rides on it, the spring would
//! be damped by less, in the root of the masses. On bodies that move freely the spring has no
//! damper: docs/decisions/restitution.md.
//!
//! # References
//!
//! Simo & Hughes, Computational Inelasticity, 1998, section 1.7 (return mapping with viscosity).

use crate::effect::Contact;
use crate::scales::contact::{RAMP, RISE, TANGENTIAL};
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
    /// Force in N on what is beneath, that of spring and damper.
    pub force: Vector3<f64>,
    /// Spring at the end in m.
    pub spring: Vector3<f64>,
    /// Direction in which it slips.
    pub slides: Option<Vector3<f64>>,
    /// Share of the trial force that is left; 1 while it sticks.
    share: f64,
    /// Stiffness in N/m of spring and damper in the step.
    stiffness: f64,
    /// Energy in J that it loses.
    pub loss: f64,
}

/// What friction is made of in a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Stick {
    /// Stiffness in N/m of the contact along its normal.
    pub stiffness: f64,
    /// Damping over the length of the step, r in N/m.
    pub damping: f64,
    /// Largest friction in N.
    pub bound: f64,
    /// Whether that is ignored.
    pub sticks: bool,
}

/// Returns the damping per length in N s/m^2 beside the spring of friction, for a contact of the
/// normal stiffness `stiffness` (N/m^2) and a mass per length (kg/m).
pub(in crate::contact) fn stick_damping(stiffness: f64, mass: f64) -> f64 {
    (TANGENTIAL * stiffness * mass).sqrt() / RISE
}

/// Returns friction on a surface with the unit normal `normal`; `before` is the spring at the
/// beginning (m), `slip` the motion beside the surface.
#[inline]
pub(in crate::contact) fn friction(
    stick: &Stick,
    normal: &Vector3<f64>,
    before: &Vector3<f64>,
    slip: &Vector3<f64>,
) -> Friction {
    let k = TANGENTIAL * stick.stiffness;
    let stiffness = k + stick.damping;
    let tangential = |x: &Vector3<f64>| x - normal * normal.dot(x);
    let (slip, start) = (tangential(slip), tangential(before));
    let trial = start * k + slip * stiffness;
    let (share, slides) = if trial.norm_squared() <= stick.bound * stick.bound || stick.sticks {
        (1.0, None)
    } else {
        let size = trial.norm();
        (stick.bound / size, Some(trial / size))
    };
    let force = trial * share;
    let spring = (force + start * stick.damping) / stiffness;
    let loss = force.dot(&slip) - 0.5 * k * (spring.norm_squared() - before.norm_squared());
    Friction { force, spring, slides, share, stiffness, loss }
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
    /// bound, and it loses energy for any bound, damping and slip.
    ///
    /// *Source.* Central differences; the definition.
    #[test]
    fn friction_has_its_exact_tangent_and_loses_energy() {
        let (k, normal) = (1e6, Vector3::new(0.0, 0.6, 0.8));
        let before = Vector3::new(1e-5, 2e-5, -1.5e-5);
        let sign = |i: usize, k: u32| if (i >> k) & 1 == 1 { 1.0 } else { -1.0 };
        for (bound, damping) in [0.0, 0.3, 5.0, 1e3].into_iter().flat_map(|b| [0.0, 3e4, 3e6].map(|d| (b, d))) {
            for i in 0..8 {
                let slip = 3e-5 * Vector3::new(sign(i, 0), 0.8 * sign(i, 1), 0.3 * sign(i, 2));
                let stick = Stick { stiffness: k, damping, bound, sticks: false };
                let at = |slip: &Vector3<f64>| friction(&stick, &normal, &before, slip);
                let f = at(&slip);
                assert!(f.loss >= -1e-18, "{bound} {damping} {slip:?} {}", f.loss);
                assert!(f.force.norm() <= bound * (1.0 + 1e-12));
                let stored = spring_energy(k, &f.spring) - spring_energy(k, &before);
                assert!((f.force.dot(&slip) - stored - f.loss).abs() < 1e-12, "{bound} {damping} {slip:?}");
                for c in 0..3 {
                    let d = 1e-9 * Vector3::ith(c, 1.0);
                    let slope = (at(&(slip + d)).force - at(&(slip - d)).force) / 2e-9;
                    let stiffness = TANGENTIAL * k + damping;
                    assert!((slope - f.tangent(&normal).column(c)).norm() < 1e-4 * stiffness, "{bound} {slip:?}");
                }
            }
        }
    }
}
