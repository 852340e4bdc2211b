//! Errors of the coupling, with the names of the scene.

use super::Physics;
use crate::error::Error;
use crate::scene::Scene;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;

impl Physics {
    /// Converts an error of the coupling, with the names of the scene.
    pub(super) fn explain(&self, scene: &Scene, time: f64, error: lariat_rapier::Error) -> Error {
        let name = |handle: RigidBodyHandle| {
            self.bodies.iter().position(|b| *b == handle).map(|i| scene.bodies[i].name.clone())
        };
        match error {
            lariat_rapier::Error::StepRefused { cause, .. } => self.explain(scene, time, *cause),
            lariat_rapier::Error::Cable(source) => Error::mechanics(time, source),
            lariat_rapier::Error::BodyNotFinite { body, quantity, time } => {
                let name = name(body).unwrap_or_default();
                Error::Body { time, body: name, problem: format!("its {quantity} is not finite") }
            }
            lariat_rapier::Error::JointInStatics { body, reason } => {
                let problem = format!("its equilibrium is not computed: {reason}; run the scene until it rests");
                Error::Body { time, body: name(body).unwrap_or_default(), problem }
            }
            lariat_rapier::Error::ContactInStatics { body, other } => {
                let other = other.and_then(name).map_or("a collider".to_string(), |other| format!("body {other:?}"));
                let problem = format!(
                    "statics compute no contacts of bodies, it touches {other}, and in 30 s of motion not all comes to rest, or something changes with time: run the scene until it rests"
                );
                Error::Body { time, body: name(body).unwrap_or_default(), problem }
            }
            lariat_rapier::Error::NotHeldInStatics { bodies, .. } => {
                let names: Vec<String> = bodies.iter().filter_map(|body| name(*body)).collect();
                let others = match &names[..] {
                    [_, others @ ..] if !others.is_empty() => format!(", nor {}", others.join(", ")),
                    _ => String::new(),
                };
                let problem = format!(
                    "nothing holds it{others}: attach one of its cables to what stays where it is, or put something below on which it comes to rest"
                );
                Error::Body { time, body: names.into_iter().next().unwrap_or_default(), problem }
            }
            lariat_rapier::Error::CableTouchesInStatics { cable, collider, arc_length, depth } => {
                let body = self.world.colliders.get(collider).and_then(|c| name(c.parent()?)).unwrap_or_default();
                let problem = format!(
                    "cable {cable:?} would run through it, {depth:.1e} m deep at {arc_length:.4} m: statics compute contact at samples, which do \
                     not see sharp edges and thin things between them: use more elements, or run the scene until it rests"
                );
                Error::Body { time, body, problem }
            }
            lariat_rapier::Error::CablePassesBodyInStatics { cable, body, arc_length, by_motion } => {
                let why = if by_motion {
                    "in motion from there, too: use more elements where it bends around the body, or a stiffness of contact"
                } else {
                    "statics compute no contact of cables with bodies that they move, and in 30 s of motion not all comes to rest: run the scene until it rests"
                };
                let problem = format!(
                    "cable {cable:?} would be in it or pass through it, near {arc_length:.4} m, from where it is drawn to where it would rest: {why}"
                );
                Error::Body { time, body: name(body).unwrap_or_default(), problem }
            }
            source => Error::Coupling { time, source },
        }
    }
}
