//! The continuum that the elements approximate, solved by shooting: nothing here uses the crate under test.
//!
//! A planar rod with the energy per unstretched length EA (f^2 - 1)^2/8 + EI kappa^2/2, f = |r'|, kappa = theta'/f the
//! curvature per deformed length. With the force n carried by the section and the moment M:
//!
//! ```text
//! M = dW/dtheta' = EI theta'/f^2      n.t = dW/df = EA f (f^2 - 1)/2 - M^2 f/EI      M' = -f (n.nu)      r' = f t
//! ```

/// The hanging cable without bending stiffness; the accuracy report uses it too.
#[path = "../../../lariat-bench/src/report/catenary_reference.rs"]
mod catenary_reference;

#[allow(unused_imports)] // each test binary uses a part
pub use catenary_reference::{Catenary, stretch};

/// A rod clamped at the origin along x under a dead force (`fx`, `fy`) at its tip, no distributed load.
#[derive(Clone, Copy, Debug)]
pub struct Elastica {
    /// EA in N.
    pub axial: f64,
    /// EI in N m^2.
    pub bending: f64,
    /// Unstretched length in m.
    pub length: f64,
    /// Tip force in N.
    pub force: [f64; 2],
}

/// Where a shooting run ends.
#[derive(Clone, Copy, Debug)]
pub struct Tip {
    /// x in m.
    pub x: f64,
    /// y in m.
    pub y: f64,
    /// Angle of the tangent in rad.
    pub angle: f64,
    /// Moment in N m.
    pub moment: f64,
}

impl Elastica {
    /// Integrates from the clamp with root moment `m0` by the classical Runge-Kutta method in 1000 steps.
    pub fn shoot(&self, m0: f64) -> Tip {
        let [fx, fy] = self.force;
        let rate = |y: [f64; 4]| {
            let [_, _, angle, m] = y;
            let (s, c) = angle.sin_cos();
            let f = stretch(self.axial, fx * c + fy * s, m * m / self.bending);
            [f * c, f * s, m * f * f / self.bending, -f * (fy * c - fx * s)]
        };
        let steps = 1000;
        let h = self.length / f64::from(steps);
        let mut y = [0.0, 0.0, 0.0, m0];
        let plus = |y: [f64; 4], k: [f64; 4], h: f64| core::array::from_fn(|i| y[i] + h * k[i]);
        for _ in 0..steps {
            let k1 = rate(y);
            let k2 = rate(plus(y, k1, 0.5 * h));
            let k3 = rate(plus(y, k2, 0.5 * h));
            let k4 = rate(plus(y, k3, h));
            y = core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
        Tip { x: y[0], y: y[1], angle: y[2], moment: y[3] }
    }

    /// The shape whose tip carries no moment, by bisection of the root moment between 0 and |F| L.
    pub fn tip(&self) -> (Tip, f64) {
        let reach = self.force[0].hypot(self.force[1]) * self.length * 1.5;
        let (mut low, mut high) = if self.force[1] >= 0.0 { (0.0, reach) } else { (-reach, 0.0) };
        assert!(self.shoot(low).moment * self.shoot(high).moment < 0.0);
        let sign = self.shoot(high).moment.signum();
        for _ in 0..60 {
            let m = 0.5 * (low + high);
            if self.shoot(m).moment * sign > 0.0 { high = m } else { low = m }
        }
        let m = 0.5 * (low + high);
        (self.shoot(m), m)
    }
}
