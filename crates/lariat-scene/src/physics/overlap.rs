//! Cables that start inside bodies, and that pass through them.

use super::Physics;
use crate::scene::Scene;
use crate::warning::Warning;
use lariat_ancf::coupling::Coupling;
use lariat_rapier::{collider_of, deepest_inside};

/// Depth in a body, as a share of the length, beyond which a cable is not in equilibrium on it: the error of position that is told of a mesh.
const SUNK: f64 = 2e-3;

impl Physics {
    /// Returns a warning for each cable and body where the cable runs through the body, beyond what an attachment needs.
    pub fn inside(&mut self, scene: &Scene) -> Vec<Warning> {
        let mut deepest: Vec<(usize, usize, f64, f64, bool)> = Vec::new();
        for warning in self.cables.warnings(&self.world) {
            if let lariat_rapier::Warning::InCollider { cable, collider, arc_length, depth, own, .. } = warning
                && let Some(c) = self.handles.iter().position(|handle| *handle == cable)
                && let Some(parent) = self.world.colliders.get(collider).and_then(|collider| collider.parent())
                && let Some(b) = self.bodies.iter().position(|body| *body == parent)
            {
                match deepest.iter_mut().find(|found| (found.0, found.1) == (c, b)) {
                    Some(found) if found.3 < depth => (found.2, found.3) = (arc_length, depth),
                    Some(_) => {}
                    None => deepest.push((c, b, arc_length, depth, own)),
                }
            }
        }
        self.passed.extend(deepest.iter().map(|&(c, b, ..)| (c, b)));
        let name = |(c, b, at_m, depth_m, own): (usize, usize, f64, f64, bool)| {
            let (cable, body) = (scene.cables[c].name.clone(), scene.bodies[b].name.clone());
            Warning::StartsInside { cable, body, at_m, depth_m, own }
        };
        deepest.into_iter().map(name).collect()
    }

    /// Returns the warnings of [`inside`](Self::inside) about cables in equilibrium that contact should keep out, and that are
    /// deeper than an error of position that is told, or in a body that they are attached to, which squeezes them against the attachment: their
    /// equilibrium is none.
    pub fn sunk(&mut self, scene: &Scene) -> Vec<Warning> {
        let found = self.inside(scene);
        let limit = |name: &str| {
            let (_, cable) = self.cables.iter().find(|(_, cable)| cable.name() == name)?;
            cable.effects().contact.map(|_| (SUNK * cable.length()).max(cable.contact_radius()))
        };
        let sunk = |warning: &Warning| match warning {
            Warning::StartsInside { own: true, .. } => true,
            Warning::StartsInside { cable, depth_m, .. } => limit(cable).is_some_and(|limit| *depth_m > limit),
            _ => false,
        };
        found.into_iter().filter(sunk).collect()
    }

    /// Returns the name of the body that a cable knows as an obstacle by a key.
    pub fn name_of_obstacle(&self, scene: &Scene, key: u64) -> Option<String> {
        let parent = self.world.colliders.get(collider_of(key))?.parent()?;
        let body = self.bodies.iter().position(|body| *body == parent)?;
        Some(scene.bodies[body].name.clone())
    }

    /// Returns a warning for each cable and body, not attached to each other, when a cable without contact is first found in the body. Once for each;
    /// a cable that starts inside has its own warning.
    pub fn passing(&mut self, scene: &Scene, time: f64) -> Vec<Warning> {
        let mut found = Vec::new();
        for (part, (_, cable)) in self.cables.iter().enumerate() {
            let Some(&c) = self.sources.get(part) else { continue };
            if cable.effects().contact.is_some() {
                continue;
            }
            for b in 0..scene.bodies.len() {
                let attached = scene.attachments.iter().any(|a| a.cable == c && a.body == Some(b));
                if attached || self.passed.contains(&(c, b)) {
                    continue;
                }
                let colliders = self.world.bodies[self.bodies[b]].colliders().iter();
                let inside = colliders.map(|c| &self.world.colliders[*c]).any(|c| deepest_inside(cable, c).is_some());
                if inside && !found.contains(&(c, b)) {
                    found.push((c, b));
                }
            }
        }
        self.passed.extend(&found);
        let warn = |(c, b): (usize, usize)| Warning::PassesThrough {
            cable: scene.cables[c].name.clone(),
            body: scene.bodies[b].name.clone(),
            time_s: time,
        };
        found.into_iter().map(warn).collect()
    }
}
