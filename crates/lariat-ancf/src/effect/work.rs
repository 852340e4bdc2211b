//! Work that effects do on a cable over a step.
//!
//! # Equation
//!
//! ```text
//! damping = -int 2R dt          drag = int F_drag . q' dt          line_loads = F_line . (q(t) - q(0))
//! ```
//!
//! R is the dissipation function of [`damping`](super::damping), F_drag the generalised force of
//! [`drag`](super::drag). The integrals are taken step by step with two Gauss points on the cubic
//! through positions and velocities at both ends of the step: order 4, like the best implicit
//! method here. In a step that does not resolve the velocities they are taken with the mean
//! velocity: force times increment.
//!
//! # Validity
//!
//! As accurate as the step: what the *integrator* itself dissipates is not in it, so the total
//! [`Energy`](crate::Energy) less the work of all effects is constant up to the error in time.
//!
//! # References
//!
//! Rayleigh 1873 (dissipation function); Hermite interpolation.
//!
//! # Alternatives considered
//!
//! - Differences of the total energy: they count the integrator's loss as the effect's.
//! - Velocities from accelerations at both ends: in a stiff transient h q'' is no velocity that the
//!   cable has, and the work a hundred times too large.

/// Coefficient: the two Gauss points of a unit step.
pub(crate) const POINTS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Returns the weights of (x0, h x0', x1, h x1') in Hermite's cubic, and in its derivative times h,
/// at a share of a step.
pub(crate) fn hermite(s: f64) -> ([f64; 4], [f64; 4]) {
    let r = 1.0 - s;
    let value = [r * r * (1.0 + 2.0 * s), s * r * r, s * s * (3.0 - 2.0 * s), -s * s * r];
    let slope = 6.0 * s * r;
    (value, [-slope, r * (1.0 - 3.0 * s), slope, s * (3.0 * s - 2.0)])
}
