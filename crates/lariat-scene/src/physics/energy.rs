//! Energy of bodies, and the work on them.

use super::{Physics, RAPIER_STEPS};
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::body::BodyKind;
use lariat_ancf::Vector3;
use lariat_ancf::island::RigidBody;
use lariat_rapier::CableHandle;
use lariat_rapier::convert::{rotation, vector};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::water::BodiesInWater;
use nalgebra::UnitQuaternion;

/// Energy of a dynamic body and work on it, in J.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct BodyTerms {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Potential of gravity, without its added mass.
    pub gravity: f64,
    /// Work of loads and of water on it, less what the substeps of Rapier take.
    pub loads: f64,
    /// Work of its cables on it.
    pub cables: f64,
    /// True if the energy law of a cable has the work of gravity and loads on it.
    pub in_law: bool,
    /// True if nothing but cables, gravity and loads moves it.
    pub free: bool,
    /// Whether a collider is near one of its own.
    pub near: bool,
}

/// Centre of mass (m), rotation, and force (N) and moment (N m) of the loads on a body.
pub struct Place {
    centre: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

impl Physics {
    /// Returns the places of the bodies that the scene loads, with the forces of the coming step.
    pub(super) fn places(&self, scene: &Scene) -> Vec<(usize, Place)> {
        let mut places: Vec<(usize, Place)> = Vec::new();
        for index in scene.body_loads.iter().map(|load| load.body) {
            if places.iter().any(|(body, _)| *body == index) {
                continue;
            }
            let body = &self.world.bodies[self.bodies[index]];
            let place = Place {
                centre: vector(body.center_of_mass()),
                rotation: rotation(*body.rotation()),
                force: vector(body.user_force()),
                moment: vector(body.user_torque()),
            };
            places.push((index, place));
        }
        places
    }

    /// Adds the work of the loads over a step that began with `before`.
    pub(super) fn add_load_work(&mut self, scene: &Scene, before: &[(usize, Place)]) {
        for ((index, start), (_, end)) in before.iter().zip(self.places(scene)) {
            let turned = (end.rotation * start.rotation.inverse()).scaled_axis();
            self.load_work[*index] += start.force.dot(&(end.centre - start.centre)) + start.moment.dot(&turned);
        }
    }

    /// Appends the terms of the dynamic bodies, and returns the work in J of the present forces of cables on them over the rounding errors of a host step.
    /// The cables have the work of all other bodies.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for an attachment of the scene.
    pub fn bodies_balance(&self, scene: &Scene, time: f64, terms: &mut Vec<BodyTerms>) -> Result<f64, Error> {
        let mut on_body = vec![(0.0, 0.0); scene.bodies.len()];
        let mut rounding = 0.0;
        for (k, attachment) in scene.attachments.iter().enumerate() {
            let dynamic = attachment.body.filter(|body| scene.bodies[*body].kind == BodyKind::Dynamic);
            let (Some(body), Some(reading)) = (dynamic, self.reading(k, time)?) else { continue };
            on_body[body].0 += reading.work;
            let origin = vector(self.world.bodies[self.bodies[body]].translation()).norm();
            let place = origin + attachment.anchor.map_or(0.0, |anchor| anchor.norm());
            on_body[body].1 += reading.force.norm() * place * f64::from(RAPIER_STEPS) * f64::from(f32::EPSILON);
        }
        let of_water = |water: &BodiesInWater, body| Some(water.work(body)? - water.lost_in_substeps(body)?);
        let water = |body| self.cables.water().and_then(|water| of_water(water, body)).unwrap_or(0.0);
        // added mass has no weight
        let added = |body| self.cables.water().map_or(0.0, |water| water.added_mass(body));
        for (index, _) in scene.bodies.iter().enumerate().filter(|(_, body)| body.kind == BodyKind::Dynamic) {
            let handle = self.bodies[index];
            let Some(rigid) = lariat_rapier::rigid_body(&self.world, handle) else { continue };
            let joined = scene.joints.iter().any(|joint| joint.body == index || joint.to == Some(index));
            // the reel has the work of its drum
            let wound = scene.cables.iter().any(|cable| cable.drum.is_some_and(|drum| drum.body == index));
            let near = self.is_near_another(handle);
            let free = !joined && !wound && !near;
            let (cables, of_rounding) = on_body[index];
            rounding += if free { 0.0 } else { of_rounding };
            terms.push(BodyTerms {
                kinetic: rigid.kinetic_energy() + self.further_kinetic(handle, &rigid),
                gravity: (added(handle) - rigid.mass) * scene.gravity.dot(&rigid.position),
                loads: self.load_work[index] + water(handle),
                cables,
                in_law: wound
                    || scene.attachments.iter().any(|a| a.body == Some(index) && self.has_law(self.handles[a.cable])),
                free,
                near,
            });
        }
        Ok(rounding)
    }

    /// Returns the kinetic energy of a body in J by the added mass that is not in its mass.
    pub(super) fn further_kinetic(&self, handle: RigidBodyHandle, body: &RigidBody) -> f64 {
        let further = self.cables.water().and_then(|water| water.further_mass(&self.world, handle));
        further.map_or(0.0, |further| 0.5 * body.velocity.dot(&(further * body.velocity)))
    }

    /// Returns whether a cable steps by the discrete gradient.
    fn has_law(&self, cable: CableHandle) -> bool {
        self.cables.steps_by_discrete_gradient(cable).unwrap_or(false)
    }

    /// Returns whether all cables step by the discrete gradient.
    pub fn all_have_law(&self) -> bool {
        self.handles.iter().all(|cable| self.has_law(*cable))
    }

    /// Returns the weight of the dynamic bodies in N.
    pub fn weight(&self, scene: &Scene) -> f64 {
        scene.gravity.norm() * self.dynamic(scene).map(|(_, body)| body.mass).sum::<f64>()
    }

    /// Returns whether the box around a collider of a body overlaps that of another body's.
    fn is_near_another(&self, body: RigidBodyHandle) -> bool {
        let colliders = self.world.bodies[body].colliders();
        colliders.iter().any(|collider| self.world.narrow_phase.contact_pairs_with(*collider).next().is_some())
    }
}
