//! Cables that start inside bodies, and that pass through them.

use super::Physics;
use crate::scene::Scene;
use crate::warning::Warning;
use lariat_rapier::convert::{to_vector, vector};
use lariat_rapier::rapier::geometry::{Aabb, BoundingVolume};

/// Depth in m, besides half the thickness of the cable, that is not taken for touching.
const TOUCHING: f64 = 1e-3;

impl Physics {
    /// Returns a warning for each cable and body, not attached to each other, with a node of the cable inside the body.
    pub fn inside(&mut self, scene: &Scene) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for (c, (_, cable)) in self.cables.iter().enumerate() {
            let thick = 0.5 * scene.cables[c].section.diameter.unwrap_or(0.0);
            let arc_lengths = cable.node_arc_lengths();
            for (b, body) in scene.bodies.iter().enumerate() {
                if scene.attachments.iter().any(|a| a.cable == c && a.body == Some(b)) {
                    continue;
                }
                let mut deepest = (0.0, TOUCHING.max(thick));
                for &collider in self.world.bodies[self.bodies[b]].colliders() {
                    let collider = &self.world.colliders[collider];
                    for (node, &s) in arc_lengths.iter().enumerate() {
                        let point = cable.node_position(node);
                        let surface = collider.shape().project_point(collider.position(), to_vector(&point), false);
                        let depth = (vector(surface.point) - point).norm();
                        if surface.is_inside && depth > deepest.1 {
                            deepest = (s, depth);
                        }
                    }
                }
                if deepest.1 > TOUCHING.max(thick) {
                    self.passed.push((c, b));
                    let (cable, body) = (scene.cables[c].name.clone(), body.name.clone());
                    warnings.push(Warning::StartsInside { cable, body, at_m: deepest.0, depth_m: deepest.1 });
                }
            }
        }
        warnings
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
