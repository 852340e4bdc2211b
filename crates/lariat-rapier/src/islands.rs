//! Which cables and bodies move together: the connected sets over pins to integrated bodies.

use crate::body::is_integrated;
use crate::set::CableSet;
use lariat_ancf::island::{Impedance, Pin, RigidBody};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{AngVector, Vector};
use rapier::pipeline::PhysicsWorld;

/// One island during a Rapier step.
#[derive(Clone, Debug, Default)]
pub(crate) struct IslandStep {
    /// Cables, as indices into the set.
    pub cables: Vec<usize>,
    /// Integrated bodies.
    pub handles: Vec<RigidBodyHandle>,
    /// Pins, with indices into the two lists above.
    pub pins: Vec<Pin>,
    /// The attachment of each pin.
    pub attachments: Vec<usize>,
    /// Bodies as predicted at the end of the step.
    pub bodies: Vec<RigidBody>,
    /// By body, what Rapier was given.
    pub given: Vec<Given>,
    /// By cable, its answer to impulses, where a body of the island is near others.
    pub impedances: Vec<Impedance>,
    /// By pin, whether its motors run.
    pub motors: Vec<bool>,
}

/// What Rapier was given for a body in place of its own state, and what to restore.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Given {
    pub linvel: Vector,
    pub angvel: AngVector,
    pub user_force: Vector,
    pub user_torque: AngVector,
    pub gyroscopic: bool,
    pub linear_damping: rapier::math::Real,
    pub angular_damping: rapier::math::Real,
}

impl CableSet {
    /// Sorts cables into islands, in the order of their handles.
    pub(crate) fn find_islands(&mut self, world: &PhysicsWorld) {
        let held: Vec<(usize, usize, RigidBodyHandle)> = self
            .attachments
            .iter()
            .enumerate()
            .filter_map(|(i, a)| a.as_ref().map(|a| (i, a.cable.0 as usize, a.body)))
            .filter(|(_, _, body)| is_integrated(world, *body))
            .collect();
        let mut seen = vec![false; self.cables.len()];
        self.islands.clear();
        for first in 0..self.cables.len() {
            if seen[first] || self.cables[first].is_none() {
                continue;
            }
            let mut island = IslandStep { cables: vec![first], ..IslandStep::default() };
            seen[first] = true;
            let mut next = 0;
            while next < island.cables.len() {
                let cable = island.cables[next];
                next += 1;
                for (_, _, body) in held.iter().filter(|(_, c, _)| *c == cable) {
                    if island.handles.contains(body) {
                        continue;
                    }
                    island.handles.push(*body);
                    for (_, other, _) in held.iter().filter(|(_, _, b)| b == body) {
                        if !seen[*other] {
                            seen[*other] = true;
                            island.cables.push(*other);
                        }
                    }
                }
            }
            island.cables.sort_unstable();
            island.handles.sort_by_key(|h| h.into_raw_parts());
            for (attachment, cable, body) in &held {
                let Some(cable) = island.cables.iter().position(|c| c == cable) else { continue };
                let body_index =
                    island.handles.iter().position(|b| b == body).expect("bodies of held cables are listed");
                let a = self.attachments[*attachment].as_ref().expect("listed above");
                let local_com = crate::convert::vector(world.bodies[*body].local_center_of_mass());
                island.pins.push(Pin { cable, node: a.node, body: body_index, anchor: a.anchor - local_com });
                island.attachments.push(*attachment);
            }
            self.islands.push(island);
        }
    }
}
