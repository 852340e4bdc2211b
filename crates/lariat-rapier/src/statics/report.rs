//! What a search for equilibrium returns.

use crate::handle::CableHandle;
use lariat_ancf::EquilibriumReport;
use rapier::dynamics::RigidBodyHandle;

/// The result of [`CableSet::equilibrium`](crate::CableSet::equilibrium).
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Equilibrium {
    /// By cable, the report of its island: cables of one island share it.
    pub cables: Vec<(CableHandle, EquilibriumReport)>,
    /// Dynamic bodies that were moved to their place.
    pub moved: Vec<RigidBodyHandle>,
    /// Attached bodies that were held where they are: fixed, kinematic, disabled or without mass.
    pub held: Vec<RigidBodyHandle>,
    /// Dynamic bodies that no cable is attached to: they were left where they are, and nothing that
    /// acts on them was looked at.
    pub unattached: Vec<RigidBodyHandle>,
}

impl Equilibrium {
    /// Returns whether all islands are stable.
    pub fn is_stable(&self) -> bool {
        self.cables.iter().all(|(_, report)| report.stable)
    }
}
