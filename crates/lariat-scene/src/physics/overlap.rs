//! Cables that start inside bodies, and that pass through them.

use super::Physics;
use crate::scene::Scene;
use crate::warning::Warning;
use lariat_rapier::convert::to_vector;
use lariat_rapier::rapier::geometry::{Aabb, BoundingVolume};

/// Depth in m, besides half the thickness of the cable, that is not taken for touching.
const TOUCHING: f64 = 1e-3;

impl Physics {
    /// Returns a warning for each cable and body, not attached to each other, with a node of the cable inside the body.
    pub fn inside(&mut self, scene: &Scene) -> Vec<Warning> {
        let mut deepest: Vec<(usize, usize, f64, f64)> = Vec::new();
        for warning in self.cables.warnings(&self.world) {
            if let lariat_rapier::Warning::InCollider { cable, collider, arc_length, depth, .. } = warning
                && let Some(c) = self.handles.iter().position(|handle| *handle == cable)
                && let Some(parent) = self.world.colliders.get(collider).and_then(|collider| collider.parent())
                && let Some(b) = self.bodies.iter().position(|body| *body == parent)
            {
                match deepest.iter_mut().find(|found| (found.0, found.1) == (c, b)) {
                    Some(found) if found.3 < depth => (found.2, found.3) = (arc_length, depth),
                    Some(_) => {}
                    None => deepest.push((c, b, arc_length, depth)),
                }
            }
        }
        self.passed.extend(deepest.iter().map(|&(c, b, ..)| (c, b)));
        let name = |(c, b, at_m, depth_m): (usize, usize, f64, f64)| {
            let (cable, body) = (scene.cables[c].name.clone(), scene.bodies[b].name.clone());
            Warning::StartsInside { cable, body, at_m, depth_m }
        };
        deepest.into_iter().map(name).collect()
    }

    /// Returns a warning for each cable and body, not attached to each other, when a cable without contact is first found in the body. Once for each;
    /// a cable that starts inside has its own warning.
    pub fn passing(&mut self, scene: &Scene, time: f64) -> Vec<Warning> {
        let mut found = Vec::new();
        for (part, (_, cable)) in self.cables.iter().enumerate() {
            let Some(&c) = self.sources.get(part) else { continue };
            let radius = cable.contact_radius().max(0.5 * scene.cables[c].section.diameter.unwrap_or(0.0));
            if cable.effects().contact.is_some() {
                continue;
            }
            let places = || (0..cable.nodes()).map(|node| to_vector(&cable.node_position(node)));
            let mut around = Aabb::new_invalid();
            places().for_each(|x| around.take_point(x));
            for b in 0..scene.bodies.len() {
                let attached = scene.attachments.iter().any(|a| a.cable == c && a.body == Some(b));
                if attached || self.passed.contains(&(c, b)) {
                    continue;
                }
                let colliders = self.world.bodies[self.bodies[b]].colliders().iter();
                let inside = colliders.map(|c| &self.world.colliders[*c]).any(|collider| {
                    collider.compute_aabb().intersects(&around)
                        && places().any(|x| {
                            let depth = -f64::from(collider.shape().distance_to_point(collider.position(), x, false));
                            depth > TOUCHING.max(radius)
                        })
                });
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
