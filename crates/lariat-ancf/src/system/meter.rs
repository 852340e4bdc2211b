//! What is summed over a host step, and the vectors for it.

use crate::effect::EffectWork;
use crate::term::EnergyLaw;

/// The work of effects in the present host step, and the vectors to compute work and energy.
#[derive(Clone, Debug, Default)]
pub(crate) struct EnergyMeter {
    pub work: EffectWork,
    /// The work of effects in a step of the discrete gradient.
    pub work_of_step: EffectWork,
    /// By end, work of what pays material out, and of the material, in the present host step, in J.
    pub feed_work: [f64; 2],
    /// The energy law of the present host step.
    pub law: EnergyLaw,
    pub(super) q: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) force: Vec<f64>,
    /// Reactions at both ends of a step, and the momentum that the forces at hand miss.
    pub(super) reactions: [Vec<f64>; 2],
    pub(super) missed: Vec<f64>,
}

impl EnergyMeter {
    /// Begins a host step.
    pub fn begin(&mut self) {
        self.work = EffectWork::default();
        self.feed_work = [0.0; 2];
        self.law = EnergyLaw::default();
    }
}
