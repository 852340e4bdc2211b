//! Warnings about cables in their world, beside those that a cable has by itself.
//!
//! Cables of a set are watched ([`Settings::watch`](crate::Settings::watch)): each warning of [`lariat_ancf::warning`] is an
//! [`Event::Warning`] once, after the host step in which it came up. [`CableSet::warnings`] returns all at any time.

use crate::contents::Contents;
use crate::events::Event;
use crate::handle::CableHandle;
use crate::inside::deepest_inside;
use crate::set::CableSet;
use rapier::geometry::ColliderHandle;
use rapier::pipeline::PhysicsWorld;

/// A warning about a cable of a set; its text says what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// What the cable says about itself.
    #[error("{warning}")]
    Cable {
        /// The cable.
        cable: CableHandle,
        /// Its warning.
        warning: lariat_ancf::Warning,
    },
    /// A cable runs through a collider of a body that it is not attached to.
    #[error(
        "cable {name:?}: at {arc_length:.4} m it is {depth:.2e} m inside a collider: contact does not push it out, and without contact it \
         passes through; check the points of the cable and the place of the collider"
    )]
    InCollider {
        /// The cable.
        cable: CableHandle,
        /// Its name.
        name: String,
        /// The collider.
        collider: ColliderHandle,
        /// Arc length of the deepest place in m.
        arc_length: f64,
        /// Its distance from the surface in m; where no point that is tested is inside, half the length inside.
        depth: f64,
    },
    /// A cable that touches bodies would bounce off a collider, if contacts of cables had restitution.
    #[error(
        "cable {name:?}: contacts of cables have no restitution, and a collider that it may touch has {restitution}: the cable does not bounce \
         off it"
    )]
    Restitution {
        /// The cable.
        cable: CableHandle,
        /// Its name.
        name: String,
        /// The collider with the largest restitution.
        collider: ColliderHandle,
        /// That restitution.
        restitution: f64,
    },
}

impl CableSet {
    /// Returns the warnings about all cables: those that the cables have
    /// ([`Cable::warnings`](lariat_ancf::Cable::warnings)), places inside colliders, and restitution that contacts of cables ignore. Worth a
    /// look when a world has been built.
    pub fn warnings(&self, world: &PhysicsWorld) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for (cable, slot) in self.contents.cables.iter() {
            let handle = CableHandle(cable as u32);
            warnings.extend(slot.cable.warnings().into_iter().map(|warning| Warning::Cable { cable: handle, warning }));
            for (collider, shape) in world.colliders.iter().filter(|(_, collider)| !collider.is_sensor()) {
                let attached = self.contents.attachments.values();
                if attached.into_iter().any(|a| a.cable == handle && Some(a.body) == shape.parent()) {
                    continue;
                }
                if let Some((arc_length, depth)) = deepest_inside(&slot.cable, shape) {
                    let name = slot.cable.name().to_string();
                    warnings.push(Warning::InCollider { cable: handle, name, collider, arc_length, depth });
                }
            }
            if slot.cable.effects().contact.is_some() {
                let touched = world.colliders.iter().filter(|(_, c)| c.restitution() > 0.0 && slot.rules.allow(c));
                if let Some((collider, shape)) = touched.max_by(|a, b| a.1.restitution().total_cmp(&b.1.restitution()))
                {
                    let (name, restitution) = (slot.cable.name().to_string(), f64::from(shape.restitution()));
                    warnings.push(Warning::Restitution { cable: handle, name, collider, restitution });
                }
            }
        }
        warnings
    }
}

/// Reads the cables at the end of a host step, and tells them first whether nothing else acts on them and by how much what holds them was rounded;
/// what is new is an event.
pub(crate) fn note(contents: &mut Contents, world: &PhysicsWorld, events: &mut Vec<Event>) {
    let dt = f64::from(world.integration_parameters.dt);
    let Contents { cables, attachments, junctions, sheaves, drums, records, .. } = contents;
    for slot in cables.values_mut() {
        (slot.alone, slot.rounding) = (slot.cable.effects().contact.is_none(), 0.0);
    }
    let at_junctions = junctions.values().flat_map(|junction| &junction.nodes).map(|(cable, _)| *cable);
    let at_sheaves = sheaves.values().flat_map(|sheave| sheave.ends()).map(|(cable, _)| cable);
    let at_drums = drums.iter().map(|drum| drum.cable);
    for cable in at_junctions.chain(at_sheaves).chain(at_drums) {
        if let Some(slot) = cables.get_mut(cable.0 as usize) {
            slot.alone = false;
        }
    }
    for attachment in attachments.values() {
        let Some(slot) = cables.get_mut(attachment.cable.0 as usize) else { continue };
        slot.alone &= !world.bodies.get(attachment.body).is_some_and(|body| body.is_dynamic());
        slot.rounding = records.rounding(world, attachment.body, &attachment.anchor, dt).max(slot.rounding);
    }
    for index in 0..cables.len() {
        let Some(slot) = cables.get_mut(index).filter(|slot| !slot.asleep) else { continue };
        let cable = CableHandle(index as u32);
        slot.cable.set_end_rounding(slot.rounding, dt);
        slot.cable.note_host_step(slot.alone, |warning| events.push(Event::Warning { cable, warning }));
    }
}
