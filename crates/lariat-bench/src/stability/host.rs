//! How a host runs a case: its step, Rapier's solver iterations, the precision of the bodies, and what makes the cables.

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
    /// Of the bodies.
    pub precision: Precision,
    /// Whether cables have all effects: damping, drag in a wind, buoyancy and added mass, a rest shape, a line load, scaled gravity.
    pub effects: bool,
}

/// Host steps per second of the suite.
pub const RATES: [u32; 4] = [30, 60, 240, 1000];
/// Solver iterations of the suite.
pub const ITERATIONS: [usize; 3] = [1, 4, 8];

impl Host {
    /// All hosts of the suite, without effects: rates, iterations, precisions.
    pub fn all() -> Vec<Host> {
        let mut all = Vec::new();
        for rate in RATES {
            for iterations in ITERATIONS {
                for precision in [Precision::Single, Precision::Double] {
                    all.push(Host { rate, iterations, precision, effects: false });
                }
            }
        }
        all
    }

    /// The hosts with all effects: 4 iterations, every rate, both precisions.
    pub fn with_effects() -> Vec<Host> {
        Host::all().into_iter().filter(|h| h.iterations == 4).map(|h| Host { effects: true, ..h }).collect()
    }
}

impl fmt::Display for Host {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bits = if self.precision == Precision::Single { 32 } else { 64 };
        let effects = if self.effects { " effects" } else { "" };
        write!(f, "1/{} s x {} f{bits}{effects}", self.rate, self.iterations)
    }
}

/// What makes the cables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Make {
    /// This library.
    Lariat,
    /// Rapier's soft rope, with edges of 1e6 Hz, what Rapier's joints have.
    SoftRope,
    /// Capsules on spherical impulse joints.
    Capsules,
    /// Capsules on spherical multibody joints.
    Multibody,
}

impl Make {
    /// What Rapier itself offers.
    pub const RIVALS: [Make; 3] = [Make::SoftRope, Make::Capsules, Make::Multibody];

    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Make::Lariat => "Lariat",
            Make::SoftRope => "soft rope",
            Make::Capsules => "capsules, impulse joints",
            Make::Multibody => "capsules, multibody",
        }
    }
}
