//! Whether an island may take longer steps than those of games.

use super::IslandStep;
use crate::Cable;
use crate::scales::integrate::LARGEST_SIZE;

impl IslandStep<'_, '_> {
    /// Returns whether something acts, or was changed since the last step, of which the error of
    /// that step says nothing.
    pub(super) fn is_disturbed(&self) -> bool {
        let bodies = self.buffers.bodies.iter().any(|body| body.changed);
        bodies || self.cables.iter().any(|cable| is_disturbed(cable))
    }

    /// Returns the length in m of the shortest cable, and at most 1 m.
    pub(super) fn size_of_shortest(&self) -> f64 {
        self.cables.iter().map(|cable| cable.length()).fold(LARGEST_SIZE, f64::min)
    }
}

/// Returns whether a cable is, for its own.
fn is_disturbed(cable: &Cable) -> bool {
    let memory = &cable.snapshot.state.memory;
    let touches = cable.model.effects.contact.is_some();
    let changed = memory.differences.is_empty() || memory.differences.revision != memory.revision;
    touches || changed || cable.model.effects.torsion.is_some() || !cable.is_reel_still()
}
