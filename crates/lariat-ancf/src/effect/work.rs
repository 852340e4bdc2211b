//! Work that effects do on a cable over a step.
//!
//! # Equation
//!
//! ```text
//! damping = -int 2R dt          drag = int F_drag . q' dt          line_loads = F_line . (q(t) - q(0))
//! ```
//!
//! R is the dissipation function of [`damping`](super::damping), F_drag the generalised force of [`drag`](super::drag). The integrals are
//! taken step by step with two Gauss points on the cubics through positions, velocities and accelerations at both ends of the step:
//! order 4, like the best implicit method here.
//!
//! # Validity
//!
//! As accurate as the step: what the *integrator* itself dissipates is not in it, so the total [`Energy`](crate::Energy) less the work of all
//! effects is constant up to the error in time.
//!
//! # References
//!
//! Rayleigh 1873 (dissipation function); Hermite interpolation.
//!
//! # Alternatives considered
//!
//! Differences of the total energy: they count the integrator's loss as the effect's.

/// The two Gauss points of a unit step.
pub(crate) const POINTS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Weights of (x0, h x0', x1, h x1') in Hermite's cubic at the Gauss points of a step.
pub(crate) fn hermite() -> [[f64; 4]; 2] {
    POINTS.map(|s| {
        let r = 1.0 - s;
        [r * r * (1.0 + 2.0 * s), s * r * r, s * s * (3.0 - 2.0 * s), -s * s * r]
    })
}
