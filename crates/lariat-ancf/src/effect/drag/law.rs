//! The law of drag: a cable's numbers, and the velocity relative to the fluid by directions.
//! Equation: [`drag`](super).

use crate::Real;
use crate::effect::flow::Flow;
use crate::element::gram::dot;
use crate::scales::SMALLEST;
use serde::{Deserialize, Serialize};

/// Drag of a fluid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// Density of the fluid in kg/m^3, > 0.
    pub fluid_density: f64,
    /// Normal coefficient C_n on the diameter, >= 0.
    pub normal: f64,
    /// Tangential coefficient C_t on the diameter, >= 0.
    pub tangential: f64,
    /// Diameter in m. Default: that of the section.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// Velocity of the fluid. Default: at rest.
    #[serde(default)]
    pub flow: Flow,
}

impl Drag {
    /// Creates drag in a fluid of this density (kg/m^3) that moves by `flow`.
    pub fn new(fluid_density: f64, normal: f64, tangential: f64, flow: Flow) -> Self {
        Drag { fluid_density, normal, tangential, diameter: None, flow }
    }
}

/// Velocity relative to the fluid, split by the cable's direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split<T> {
    /// e = t/|t|.
    pub(super) along: [T; 3],
    /// 1/|t|.
    pub(super) inverse: T,
    /// c = v.e.
    pub(super) speed: T,
    /// v_n and its length.
    pub(super) normal: [T; 3],
    pub(super) size: T,
}

impl<T: Real> Split<T> {
    /// Splits the relative velocity `v` by the slope `t`.
    #[inline(always)]
    pub fn new(v: &[T; 3], t: &[T; 3]) -> Self {
        let inverse = v[0].splat(1.0) / dot(t, t).sqrt();
        let along = [t[0] * inverse, t[1] * inverse, t[2] * inverse];
        let speed = dot(v, &along);
        let normal = [v[0] - speed * along[0], v[1] - speed * along[1], v[2] - speed * along[2]];
        Split { along, inverse, speed, normal, size: dot(&normal, &normal).sqrt() }
    }

    /// Returns the force for k_n and k_t.
    #[inline(always)]
    pub fn force(&self, kn: T, kt: T) -> [T; 3] {
        let (n, t) = (kn * self.size, kt * self.speed.abs() * self.speed);
        let mut f = self.normal;
        for i in 0..3 {
            f[i] = -(n * self.normal[i]) - t * self.along[i];
        }
        f
    }

    /// Returns the symmetric matrix D of `f = -D v` for k_n and k_t, `[row][column]`.
    #[inline(always)]
    pub fn resistance(&self, kn: T, kt: T) -> [[T; 3]; 3] {
        let (n, t) = (kn * self.size, kt * self.speed.abs());
        let e = &self.along;
        let mut out = [[n; 3]; 3];
        for r in 0..3 {
            for c in 0..3 {
                let outer = (t - n) * (e[r] * e[c]);
                out[r][c] = if r == c { n + outer } else { outer };
            }
        }
        out
    }

    /// Returns `-df/dv` and `df/dt`, `[row][column]`.
    #[inline(always)]
    pub fn tangents(&self, kn: T, kt: T) -> [[[T; 3]; 3]; 2] {
        let Split { along: e, inverse, speed: c, normal: v, size } = *self;
        let ratio = kn / (size + SMALLEST);
        let (isotropic, axial) = (kn * size, kt * c.abs() * 2.0);
        let mixed = inverse * (isotropic - axial);
        let transverse = inverse * c * (isotropic - kt * c.abs());
        let outer = inverse * c * ratio;
        let zero = c.splat(0.0);
        let mut out = [[[zero; 3]; 3]; 2];
        for r in 0..3 {
            for s in 0..3 {
                let ee = e[r] * e[s];
                let vv = v[r] * v[s];
                let p = if r == s { -ee + 1.0 } else { -ee };
                out[0][r][s] = isotropic * p + ratio * vv + axial * ee;
                out[1][r][s] = mixed * (e[r] * v[s]) + transverse * p + outer * vv;
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::Split;

    #[test]
    fn tangents_are_the_derivatives_of_the_force_by_velocity_and_slope() {
        let (kn, kt) = (3.0, 0.7);
        let force = |v: [f64; 3], t: [f64; 3]| Split::new(&v, &t).force(kn, kt);
        for (v, t) in [([0.3, -1.2, 0.8], [0.9, 0.2, -0.4]), ([-2.0, 0.1, 0.5], [0.1, 1.1, 0.3])] {
            let [dv, dt] = Split::new(&v, &t).tangents(kn, kt);
            let moved = |x: [f64; 3], i: usize, h: f64| core::array::from_fn(|k| if k == i { x[k] + h } else { x[k] });
            for i in 0..3 {
                let h = 1e-5;
                let (a, b) = (force(moved(v, i, h), t), force(moved(v, i, -h), t));
                let (c, d) = (force(v, moved(t, i, h)), force(v, moved(t, i, -h)));
                for r in 0..3 {
                    assert!(((a[r] - b[r]) / (2.0 * h) + dv[r][i]).abs() < 1e-8, "velocity {r} {i}");
                    assert!(((c[r] - d[r]) / (2.0 * h) - dt[r][i]).abs() < 1e-8, "slope {r} {i}");
                }
            }
        }
    }

    #[test]
    fn a_cable_at_rest_in_a_fluid_at_rest_has_no_force_and_finite_tangents() {
        let split = Split::new(&[0.0; 3], &[1.0, 0.0, 0.0]);
        assert_eq!(split.force(1.0, 1.0), [0.0; 3]);
        assert_eq!(split.tangents(1.0, 1.0), [[[0.0; 3]; 3]; 2]);
    }
}
