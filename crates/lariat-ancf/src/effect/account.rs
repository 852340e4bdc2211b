//! What effects took from a cable, or gave it, since it was built.
//!
//! ```text
//! dissipated = int 2R dt                drag = -int F_drag . q' dt                line_load = F_line . (q(t) - q(0))
//! ```
//!
//! R is the dissipation function of [`damping`](super::damping), F_drag the generalised force of [`drag`](super::drag). The integrals are
//! taken step by step with two Gauss points on the cubics through positions, velocities and accelerations at both ends of the step:
//! order 4, like the best implicit method here. *Source.* Rayleigh 1873 (dissipation function); Hermite interpolation. *Validity.* As
//! accurate as the step: what the *integrator* itself dissipates is not in it, so the sum of kinetic, strain and
//! gravity energy, dissipated and drag, less line_load, is constant up to the error in time. *Rejected.* Differences of the total energy: they count the integrator's loss as
//! the effect's.

use serde::{Deserialize, Serialize};

/// Work of effects in J, since the cable was built.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Account {
    /// Energy that internal damping turned into heat; never falls.
    pub damping: f64,
    /// Energy given to the fluid; negative where a flow drives the cable.
    pub drag: f64,
    /// Work that line loads did on the cable.
    pub line_load: f64,
}

impl Account {
    /// Energy that damping and drag took from the cable in J.
    pub fn dissipated(&self) -> f64 {
        self.damping + self.drag
    }

    pub(crate) fn add(&mut self, other: &Account) {
        self.damping += other.damping;
        self.drag += other.drag;
        self.line_load += other.line_load;
    }
}

/// The two Gauss points of a unit step.
const POINTS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Weights of (x0, h x0', x1, h x1') in Hermite's cubic at the Gauss points of a step.
pub(crate) fn hermite() -> [[f64; 4]; 2] {
    POINTS.map(|s| {
        let r = 1.0 - s;
        [r * r * (1.0 + 2.0 * s), s * r * r, s * s * (3.0 - 2.0 * s), -s * s * r]
    })
}
