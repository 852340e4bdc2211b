//! The models of a cable that are compared, and how a host step is split.

use crate::single::peers::Joints;
use lariat_ancf::{Fidelity, Integrator};

/// The model of the cables of a world.
#[derive(Clone, Copy, PartialEq)]
pub enum CableModel {
    /// No cables: boxes alone.
    None,
    /// Lariat with one of its presets.
    Lariat(Fidelity),
    /// Lariat with an integrator.
    Exact(Integrator),
    /// Rapier's soft rope, with the natural frequency of its edges in Hz.
    SoftRope(f64),
    /// Capsules on spherical joints.
    Capsules(Joints),
}

impl CableModel {
    /// Returns whether the cables are Lariat's.
    pub fn is_lariat(self) -> bool {
        matches!(self, CableModel::Lariat(_) | CableModel::Exact(_))
    }

    /// Returns the name in tables.
    pub fn name(self) -> String {
        match self {
            CableModel::None => "none".to_string(),
            CableModel::Lariat(fidelity) => format!("Lariat, {}", fidelity.name()),
            CableModel::Exact(integrator) => format!("Lariat, {}", integrator.method),
            CableModel::SoftRope(30.0) => "soft rope, 30 Hz (default)".to_string(),
            CableModel::SoftRope(frequency) => format!("soft rope, {frequency:.0e} Hz"),
            CableModel::Capsules(Joints::Impulse) => "10 capsules, impulse joints".to_string(),
            CableModel::Capsules(Joints::Multibody) => "10 capsules, multibody joints".to_string(),
        }
    }
}

/// Rapier steps in a host step, and solver iterations in each of them.
#[derive(Clone, Copy, PartialEq)]
pub struct Split {
    pub steps: u32,
    pub iterations: usize,
}

impl Split {
    /// Returns the name in tables.
    pub fn name(self) -> String {
        format!("{} x {}", self.steps, self.iterations)
    }
}

/// Rapier's default, the default of Lariat, and both with more iterations.
pub const SPLITS: [Split; 4] = [
    Split { steps: 1, iterations: 4 },
    Split { steps: 1, iterations: 16 },
    Split { steps: 4, iterations: 4 },
    Split { steps: 4, iterations: 16 },
];
