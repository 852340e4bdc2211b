//! How a case is run: host step, solver iterations, precision of the bodies, effects, and the model
//! of the cables.

use std::fmt;

/// Precision of Rapier's bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Precision {
    /// rapier3d, `f32`.
    Single,
    /// rapier3d-f64.
    Double,
}

/// A host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Host {
    /// Host steps per second.
    pub rate: u32,
    /// Rapier's `num_solver_iterations`.
    pub iterations: usize,
    /// Precision of the bodies.
    pub precision: Precision,
    /// Whether cables have all effects: damping, drag in a wind, buoyancy and added mass, a rest
    /// shape, a line load, scaled gravity, and torsion between two clamps.
    pub effects: bool,
}

/// Host steps per second.
pub const RATES: [u32; 4] = [30, 60, 240, 1000];
/// Solver iterations.
pub const ITERATIONS: [usize; 3] = [1, 4, 8];

impl Host {
    /// Returns all hosts: every rate, number of iterations and precision without effects, and with
    /// effects at 4 iterations.
    pub fn all() -> Vec<Host> {
        let mut all = Vec::new();
        for effects in [false, true] {
            for rate in RATES {
                for iterations in ITERATIONS.into_iter().filter(|n| !effects || *n == 4) {
                    for precision in [Precision::Single, Precision::Double] {
                        all.push(Host { rate, iterations, precision, effects });
                    }
                }
            }
        }
        all
    }

    /// Returns whether Rapier's own ropes are compared on this host: single precision, Rapier's
    /// default of 4 iterations, no effects.
    pub fn compares_peers(&self) -> bool {
        self.iterations == 4 && self.precision == Precision::Single && !self.effects
    }
}

impl fmt::Display for Host {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bits = if self.precision == Precision::Single { 32 } else { 64 };
        let effects = if self.effects { " effects" } else { "" };
        write!(f, "1/{} s x {} f{bits}{effects}", self.rate, self.iterations)
    }
}

/// The model of the cables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CableModel {
    /// This library.
    Lariat,
    /// Rapier's soft rope, with edges of 1e6 Hz as in Rapier's joints.
    SoftRope,
    /// Capsules on spherical impulse joints.
    CapsuleChain,
    /// Capsules on spherical multibody joints.
    Multibody,
}

impl CableModel {
    /// All models.
    pub const ALL: [CableModel; 4] =
        [CableModel::Lariat, CableModel::SoftRope, CableModel::CapsuleChain, CableModel::Multibody];

    /// Returns the name in tables.
    pub fn name(self) -> &'static str {
        match self {
            CableModel::Lariat => "Lariat",
            CableModel::SoftRope => "soft rope",
            CableModel::CapsuleChain => "capsules, impulse joints",
            CableModel::Multibody => "capsules, multibody joints",
        }
    }
}
