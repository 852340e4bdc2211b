//! Drag of a fluid or wind on the moving cable: Morison's formula, normal and tangential.
//!
//! # Equation
//!
//! ```text
//! f = -1/2 rho_f d (C_n |v_n| v_n + C_t |v_t| v_t)        F = int S^T f ds
//! v = r' - u(r, t)      v_t = (v.e) e      v_n = v - v_t      e = t/|t|
//! -df/dv = k_n (|v_n| (I - e e^T) + v_n v_n^T/|v_n|) + 2 k_t |v.e| e e^T                               k = 1/2 rho_f d C
//! df/dt = (1/|t|) [k_n (|v_n| (e v_n^T + c P) + c v_n v_n^T/|v_n|) - k_t (2 |c| e v_n^T + |c| c P)]         c = v.e, P = I - e e^T
//! ```
//!
//! (here r' is the velocity, t the slope dr/ds.) f is a force per length of the unstretched cable, integrated at three Gauss points.
//! Both coefficients refer to the diameter.
//!
//! The derivative by velocity is exact and symmetric. By the slope the formula above is exact, of which the step takes the symmetric
//! half (its matrix is stored by one triangle); the gradient of the flow in space is left out. Newton's iteration is then linear with
//! a small factor, which its stopping test knows. The exact derivative is [`Cable::jacobians`](crate::Cable::jacobians)'s.
//!
//! # Validity
//!
//! A slender cable, stretch near 1; steady coefficients; no lift, no shedding of vortices; added mass is
//! [`buoyancy`](super::buoyancy)'s.
//!
//! # References
//!
//! Morison, O'Brien, Johnson & Schaaf 1950; Faltinsen 1990, ch. 7 (the cross-flow principle).
//!
//! # Alternatives considered
//!
//! - Drag on nodes: the force on a coarse cable is wrong, and slopes get none.
//! - The exact, unsymmetric tangent in Newton's iteration: it saves 0 to 2 % of the iterations up to 5 m/s of water, 36 % at 20 m/s on a
//!   2 mm line at fidelity game, 2 % of the same under error control, and an unsymmetric matrix costs every iteration.

mod lanes;
mod over_step;

pub(crate) use lanes::DragTable;

use super::acts::{Acts, Nothing};
use super::flow::Flow;
use super::{Cut, Effect, Target};
use crate::Real;
use crate::element::gram::dot;
use crate::error::{Error, Requirement, require};
use serde::{Deserialize, Serialize};

/// Gauss points of an element.
pub(crate) const POINTS: usize = 3;
/// Avoids 0/0 at zero relative velocity; far below any speed that matters.
const LEAST_SPEED: f64 = 1e-100;

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

impl Effect for Drag {
    const DISSIPATIVE: bool = true;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        require("fluid density (kg/m^3)", self.fluid_density, self.fluid_density > 0.0, "> 0")?;
        require("normal drag coefficient", self.normal, self.normal >= 0.0, ">= 0")?;
        require("tangential drag coefficient", self.tangential, self.tangential >= 0.0, ">= 0")?;
        if let Some(diameter) = self.diameter {
            require("drag diameter (m)", diameter, diameter > 0.0, "> 0")?;
        }
        self.flow.check()?;
        let samples = self.flow.samples.len();
        if samples != 0 && samples != cable.nodes() {
            let (cable, expected) = (cable.name.to_string(), cable.nodes());
            return Err(Error::WrongCount { cable, what: "samples of the flow", count: samples, expected });
        }
        if self.diameter.is_none() && cable.elements.iter().any(|e| e.section.diameter.is_none()) {
            return Err(cable.missing("drag", Requirement::Diameter));
        }
        Ok(())
    }

    fn depends_on_velocity(&self) -> bool {
        true
    }

    fn has_exact_tangent(&self) -> bool {
        false
    }

    fn needs_implicit_integrator(&self) -> bool {
        false
    }

    fn cut(&self, Cut { node, .. }: Cut<'_>) -> [Option<Self>; 2] {
        let [mut head, mut tail] = [self.clone(), self.clone()];
        if !self.flow.samples.is_empty() {
            head.flow.samples.truncate(node + 1);
            tail.flow.samples.drain(..node);
        }
        [Some(head), Some(tail)]
    }

    fn refine(&mut self, element: usize, xi: f64) {
        let samples = &mut self.flow.samples;
        if !samples.is_empty() {
            let between = samples[element] * (1.0 - xi) + samples[element + 1] * xi;
            samples.insert(element + 1, between);
        }
    }
}

impl Acts for Drag {
    type InElement = Nothing;
    type AtPoints = DragTable;

    fn at_points(&self, cable: &Target<'_>) -> Option<DragTable> {
        Some(DragTable::new(self, cable))
    }
}

/// Velocity relative to the fluid, split by the cable's direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split<T> {
    /// e = t/|t|.
    along: [T; 3],
    /// 1/|t|.
    inverse: T,
    /// c = v.e.
    speed: T,
    /// v_n and its length.
    normal: [T; 3],
    size: T,
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
        let ratio = kn / (size + LEAST_SPEED);
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
