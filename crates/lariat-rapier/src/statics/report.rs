//! What a search for equilibrium returns.

use crate::body::is_integrated;
use crate::body::ledger::is_ledger;
use crate::contents::Contents;
use crate::handle::CableHandle;
use crate::scales::statics::{RELAXATION_STEP, STILL_STEPS};
use lariat_ancf::EquilibriumReport;
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// How cables and bodies came to rest by their motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Relaxed {
    /// Host steps of 1/60 s that it took.
    pub host_steps: u32,
    /// The largest way in m of a point in the last quarter of a second from rest.
    pub way: f64,
}

impl Relaxed {
    /// Returns the force in N that a mass (kg) is out of balance by at most.
    pub(super) fn residual(&self, mass: f64) -> f64 {
        2.0 * mass * self.way / (f64::from(STILL_STEPS) * RELAXATION_STEP).powi(2)
    }
}

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
    /// How all of the world came to rest by its motion, where statics have no law for what touches:
    /// bodies that rest on others, cables that touch each other, themselves, or bodies that they
    /// move. `None` where the forces alone were searched.
    pub relaxed: Option<Relaxed>,
}

/// Returns the attached bodies that are held where they are.
pub(super) fn held(contents: &Contents, world: &PhysicsWorld) -> Vec<RigidBodyHandle> {
    let mut held = Vec::new();
    for body in contents.attachments.values().map(|a| a.body).filter(|body| !is_integrated(world, *body)) {
        if !held.contains(&body) {
            held.push(body);
        }
    }
    held
}

impl Equilibrium {
    pub(super) fn by_motion(contents: &Contents, world: &PhysicsWorld, relaxed: Relaxed) -> Self {
        let report = |(index, slot): (usize, &crate::contents::Slot)| {
            let mass =
                slot.cable.elements().iter().map(|element| element.length * element.section.mass_per_length).sum();
            let residual = relaxed.residual(mass);
            (CableHandle(index as u32), EquilibriumReport::new(relaxed.host_steps as usize, residual, true))
        };
        let moved = world.bodies.iter().filter(|(handle, body)| is_integrated(world, *handle) && !is_ledger(body));
        Equilibrium {
            cables: contents.cables.iter().map(report).collect(),
            moved: moved.map(|(handle, _)| handle).collect(),
            held: held(contents, world),
            unattached: Vec::new(),
            relaxed: Some(relaxed),
        }
    }

    /// Returns whether all islands are stable.
    pub fn is_stable(&self) -> bool {
        self.cables.iter().all(|(_, report)| report.stable)
    }
}
