//! What is probably not meant in a scene: sizes and materials that no cable has, bodies that nothing holds.

use super::body::{BodyKind, BodyScene, BodyShape};
use super::{CableScene, Purpose, Scene};
use crate::warning::Warning;
use lariat_ancf::Vector3;
use lariat_ancf::warning::sizes;

impl Scene {
    /// Returns warnings about what is probably not meant, as the scene is written.
    pub fn warnings(&self, purpose: Purpose) -> Vec<Warning> {
        let mut warnings: Vec<Warning> = self.cables.iter().flat_map(of_cable).map(Warning::Cable).collect();
        if purpose == Purpose::Run {
            warnings.extend(self.falling());
        }
        warnings
    }

    /// Returns a warning for each dynamic body that nothing holds, loads or stops.
    fn falling(&self) -> Vec<Warning> {
        let Some(down) = self.gravity.try_normalize(f64::MIN_POSITIVE) else { return Vec::new() };
        let fall_m = 0.5 * self.gravity.norm() * self.duration * self.duration;
        let (held, cables_held) = self.held();
        let falls = |b: &BodyScene| Warning::FallsFreely { body: b.name.clone(), fall_m, duration_s: self.duration };
        let mut warnings = Vec::new();
        for (i, body) in self.bodies.iter().enumerate() {
            let loaded = self.body_loads.iter().any(|load| load.body == i);
            // where its horizontal velocity may take it
            let across = body.velocity - down * body.velocity.dot(&down);
            let reach = radius(body) + across.norm() * self.duration;
            let stops = |(j, other): (usize, &BodyScene)| {
                if j == i || !held[j] || matches!(body.shape, BodyShape::None) {
                    return false;
                }
                if let BodyShape::Plane(normal) = other.shape {
                    return (other.rotation * normal).dot(&down) < 0.0;
                }
                let way = other.position - body.position;
                let fits = (way - down * way.dot(&down)).norm() <= reach + radius(other);
                !matches!(other.shape, BodyShape::None) && fits && way.dot(&down) > -reach - radius(other)
            };
            let catches = |(cable, held): (&CableScene, &bool)| {
                let centre = cable.points.iter().sum::<Vector3<f64>>() / cable.points.len() as f64;
                let way = centre - body.position;
                let fits = (way - down * way.dot(&down)).norm() <= reach + cable.length;
                *held && cable.effects.contact.is_some() && fits && way.dot(&down) > -reach - cable.length
            };
            let shape = !matches!(body.shape, BodyShape::None);
            let caught = shape && self.cables.iter().zip(&cables_held).any(catches);
            if !held[i] && !loaded && !caught && !self.bodies.iter().enumerate().any(stops) {
                warnings.push(falls(body));
            }
        }
        warnings
    }

    /// Returns by body, and by cable, whether it is connected to the world, or to anything but weights, through cables and joints.
    fn held(&self) -> (Vec<bool>, Vec<bool>) {
        let mut bodies: Vec<bool> = self.bodies.iter().map(|body| body.kind != BodyKind::Dynamic).collect();
        // loads, flow and buoyancy may carry a cable
        let carried = |(i, cable): (usize, &CableScene)| {
            let effects = &cable.effects;
            let free = effects.present().all(|key| ["damping", "rest_shape", "gravity_scale"].contains(&key));
            !free || self.loads.iter().any(|load| load.cable == i)
        };
        let mut cables: Vec<bool> = self.cables.iter().enumerate().map(carried).collect();
        loop {
            let before = (bodies.clone(), cables.clone());
            for attachment in &self.attachments {
                match attachment.body {
                    None => cables[attachment.cable] = true,
                    Some(body) => join(&mut cables[attachment.cable], &mut bodies[body]),
                }
            }
            for junction in &self.junctions {
                let [(a, _), (b, _)] = junction.points;
                let either = cables[a] || cables[b];
                (cables[a], cables[b]) = (either, either);
            }
            for joint in &self.joints {
                let either = bodies[joint.body] || joint.to.is_none_or(|to| bodies[to]);
                bodies[joint.body] = either;
                if let Some(to) = joint.to {
                    bodies[to] = either;
                }
            }
            if before == (bodies.clone(), cables.clone()) {
                return (bodies, cables);
            }
        }
    }
}

fn join(a: &mut bool, b: &mut bool) {
    (*a, *b) = (*a || *b, *a || *b);
}

/// Returns the radius in m of a sphere about the origin of a body that holds its shape; not for a half space.
fn radius(body: &BodyScene) -> f64 {
    match &body.shape {
        BodyShape::None | BodyShape::Plane(_) => 0.0,
        BodyShape::Cuboid(half) => half.norm(),
        BodyShape::Ball(radius) => *radius,
        BodyShape::Cylinder([half, radius]) => half.hypot(*radius),
        BodyShape::Capsule([half, radius]) => half + radius,
        BodyShape::Mesh(mesh) => mesh.vertices.iter().map(|x| Vector3::from(*x).norm()).fold(0.0, f64::max),
    }
}

fn of_cable(cable: &CableScene) -> impl Iterator<Item = lariat_ancf::Warning> {
    sizes::warnings(&cable.name, &cable.section, cable.length)
}
