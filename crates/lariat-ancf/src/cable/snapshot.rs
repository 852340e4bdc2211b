//! Everything that changes while a cable moves, as plain data.

use super::reel::Winding;
use crate::effect::EffectWork;
use crate::state::State;
use crate::strength::LoadRecord;
use crate::support::Prescription;
use crate::system::System;
use crate::term::EnergyLaw;
use serde::{Deserialize, Serialize};

/// Everything that changes while a cable moves, as plain data: clone it, serialise it,
/// [restore](crate::Cable::restore) it, and the run continues bitwise the same. Not in it: the
/// description (supports, but what is [prescribed](crate::Cable::prescribe); loads, effects),
/// samples of a flow, and functions of [your own](crate::ForceDensity), which stay with the cable.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    pub(crate) state: State,
    /// Work of effects so far.
    #[serde(default)]
    pub(crate) work: EffectWork,
    /// The energy law of the discrete gradient so far.
    #[serde(default)]
    pub(crate) law: EnergyLaw,
    /// Elastic energy in J that inserted nodes added so far.
    #[serde(default)]
    pub(crate) inserted_energy: f64,
    /// The load of a cable with limits since it was compared with them.
    #[serde(default)]
    pub(crate) load: LoadRecord,
    /// The reels, by end.
    #[serde(default)]
    pub(crate) windings: [Option<Winding>; 2],
    /// Points that are led.
    #[serde(default)]
    pub(crate) prescribed: Vec<Prescription>,
}

impl Clone for Snapshot {
    fn clone(&self) -> Self {
        let Snapshot { state, work, law, inserted_energy, load, windings, prescribed } = self;
        Snapshot {
            state: state.clone(),
            work: *work,
            law: *law,
            inserted_energy: *inserted_energy,
            load: *load,
            windings: *windings,
            prescribed: prescribed.clone(),
        }
    }

    /// Copies `other` into the existing vectors.
    fn clone_from(&mut self, other: &Self) {
        let Snapshot { state, work, law, inserted_energy, load, windings, prescribed } = other;
        self.state.copy_from(state);
        (self.work, self.law, self.inserted_energy) = (*work, *law, *inserted_energy);
        (self.load, self.windings) = (*load, *windings);
        self.prescribed.clone_from(prescribed);
    }
}

impl Snapshot {
    /// Returns the nodal coordinates, flat, as [`Cable::positions`](crate::Cable::positions) does.
    pub fn positions(&self) -> &[f64] {
        &self.state.q
    }

    /// Adds the work of effects in a host step that succeeded; `before` are the positions when it
    /// began.
    pub(crate) fn add_work_of_step(&mut self, system: &mut System, before: &[f64]) {
        self.work += core::mem::take(&mut system.meter.work);
        self.load = system.load;
        self.law.merge(&core::mem::take(&mut system.meter.law));
        for (winding, work) in self.windings.iter_mut().zip(core::mem::take(&mut system.meter.feed_work)) {
            winding.iter_mut().for_each(|winding| winding.work += work);
        }
        // with a reel, the lengths on which they act change: it is in the work of the steps
        if system.feeds.is_empty() {
            system.loads.of_effects.add_work(before, &self.state.q, &mut self.work);
        }
    }
}
