//! Cables that start inside bodies.

use super::Physics;
use crate::scene::Scene;
use crate::warning::Warning;
use lariat_rapier::convert::{to_vector, vector};

/// Depth in m, besides half the thickness of the cable, that is not taken for touching.
const TOUCHING: f64 = 1e-3;

impl Physics {
    /// Returns a warning for each cable and body, not attached to each other, with a node of the cable inside the body.
    pub fn inside(&self, scene: &Scene) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for (c, cable) in self.cables().into_iter().enumerate() {
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
                    let (cable, body) = (scene.cables[c].name.clone(), body.name.clone());
                    warnings.push(Warning::StartsInside { cable, body, at_m: deepest.0, depth_m: deepest.1 });
                }
            }
        }
        warnings
    }
}
