//! Which colliders a cable can reach in a Rapier step, by Rapier's tree, and how they move.
//!
//! # Validity
//!
//! A cable is boxed by eight elements at a time, each box grown by its way in the step, the radius and Rapier's prediction distance. The tree holds
//! the boxes of Rapier's last step: kinematic bodies that move are looked up besides, with the box that they sweep. Before Rapier's first step,
//! and while it does not know all colliders, every one of them is looked at.

use super::{Surfaces, key, rules::ContactFilter};
use crate::contents::Contents;
use crate::convert::{rotation, to_vector, vector};
use crate::error::Error;
use crate::events::Event;
use crate::handle::CableHandle;
use crate::step::prediction::StepParameters;
use crate::step::prescribed_motion::{PrescribedMotions, reference};
use ::nalgebra::{UnitQuaternion, Vector3};
use lariat_ancf::Cable;
use lariat_ancf::contact::{Obstacle, Overlap, RigidMotion};
use rapier::geometry::{Aabb, BoundingVolume, Collider, ColliderHandle};
use rapier::math::Real;
use rapier::pipeline::{PhysicsWorld, QueryFilter};

/// Number of elements in a box.
const CHUNK: usize = 8;
/// Radii of a cable by which its boxes are grown: features are looked for from four on.
const MARGIN: f64 = 6.0;
/// Factor on the way of a cable in a step.
const SWEEP: f64 = 2.0;

/// Buffers and surfaces. Nothing in them is state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Finder {
    surfaces: Surfaces,
    boxes: Vec<Aabb>,
    found: Vec<ColliderHandle>,
    /// Colliders of kinematic bodies that move in the step, with the boxes that they sweep.
    moving: Vec<(ColliderHandle, Aabb)>,
    /// Number of colliders that Rapier's tree knows; `None` before its first step.
    known: Option<usize>,
    /// Whether these are all.
    listed: bool,
    pub filter: Option<ContactFilter>,
}

impl Finder {
    /// Begins a Rapier step: finds the colliders that move as prescribed. Does nothing if no cable has contact.
    pub fn begin(&mut self, contents: &Contents, world: &PhysicsWorld, h: f64) {
        self.moving.clear();
        if contents.cables.values().all(|slot| slot.cable.effects().contact.is_none()) {
            return;
        }
        self.surfaces.retain(|collider| world.colliders.contains(collider));
        self.listed = self.known == Some(world.colliders.len());
        for (_, body) in world.bodies.iter().filter(|(_, body)| body.is_kinematic() && body.is_enabled()) {
            let still = body.next_position() == body.position()
                && body.linvel() == Default::default()
                && body.angvel() == Default::default();
            for &handle in body.colliders().iter().filter(|_| !still) {
                let Some(collider) = world.colliders.get(handle) else { continue };
                let now = collider.compute_aabb();
                let reach = f64::from(body.linvel().length()) * h
                    + f64::from((body.next_position().translation - body.position().translation).length())
                    + f64::from((now.maxs - now.mins).length());
                self.moving.push((handle, now.loosened(reach as Real)));
            }
        }
    }

    /// Ends a Rapier step: its tree knows all colliders.
    pub fn end(&mut self, world: &PhysicsWorld) {
        self.known = Some(world.colliders.len());
    }

    /// Gives a cable the colliders that it can reach as obstacles, and returns whether one moves, or one that it touched is gone. A dynamic body in
    /// which the cable is found is an event, once.
    pub fn gather(
        &mut self,
        contents: &mut Contents,
        world: &PhysicsWorld,
        index: usize,
        (motions, step): (&PrescribedMotions, &StepParameters),
        events: &mut Vec<Event>,
    ) -> Result<bool, lariat_ancf::Error> {
        let Some(slot) = contents.cables.get(index) else { return Ok(false) };
        let Some(contact) = slot.cable.effects().contact else { return Ok(false) };
        self.find(world, &slot.cable, step.h);
        let (cable, time) = (CableHandle(index as u32), slot.cable.time());
        let own = |body| contents.attachments.values().any(|a| a.cable == cable && a.body == body);
        let (rules, mut obstacles, mut ignored) = (slot.rules, Vec::new(), Vec::new());
        for &handle in &self.found {
            let Some(collider) = world.colliders.get(handle).filter(|collider| rules.allow(collider)) else { continue };
            if self.filter.as_ref().is_some_and(|filter| !filter.allows(cable, handle)) {
                continue;
            }
            let dynamic = collider.parent().filter(|b| crate::body::is_integrated(world, *b));
            let surface = self.surfaces.of(handle, collider.shared_shape());
            let (Some(surface), None) = (surface, dynamic) else {
                let known = slot.ignored.contains(&key(handle)) || dynamic.is_some_and(own);
                if !known && is_inside(&slot.cable, collider) {
                    ignored.push(handle);
                }
                continue;
            };
            obstacles.push(Obstacle {
                key: key(handle),
                surface,
                motion: motion(world, collider, motions, step, time),
                friction: rules.friction(contact.friction, collider),
                skin: f64::from(collider.contact_skin()),
            });
        }
        let Some(slot) = contents.cables.get_mut(index) else { return Ok(false) };
        for collider in ignored {
            let name = slot.cable.name();
            log::warn!(
                "cable {name:?} passes through collider {collider:?}: cables touch fixed and kinematic colliders only"
            );
            slot.ignored.push(key(collider));
            events.push(Event::ContactIgnored { cable, collider });
        }
        obstacles.sort_unstable_by_key(|obstacle| obstacle.key);
        let still = |o: &Obstacle| [o.motion.velocity, o.motion.angular_velocity] == [Vector3::zeros(); 2];
        let there = |key: u64| obstacles.iter().any(|o| o.key == key);
        let changed = slot.touched.iter().any(|(key, _)| !there(*key)) || !obstacles.iter().all(still);
        slot.cable.set_obstacles(obstacles)?;
        Ok(changed)
    }

    /// Refuses the static shape of a cable with contact that is in something that it can touch.
    pub fn check_statics(
        &mut self,
        contents: &Contents,
        world: &PhysicsWorld,
        index: usize,
        cable: &mut Cable,
    ) -> Result<(), Error> {
        let Some(slot) = contents.cables.get(index).filter(|_| cable.effects().contact.is_some()) else {
            return Ok(());
        };
        self.find(world, cable, 0.0);
        let handle = CableHandle(index as u32);
        let mut obstacles = Vec::new();
        for &found in &self.found {
            let Some(collider) = world.colliders.get(found).filter(|collider| slot.rules.allow(collider)) else {
                continue;
            };
            let filtered = self.filter.as_ref().is_some_and(|filter| !filter.allows(handle, found));
            let dynamic = collider.parent().is_some_and(|b| crate::body::is_integrated(world, b));
            if let (false, false, Some(surface)) = (filtered, dynamic, self.surfaces.of(found, collider.shared_shape()))
            {
                obstacles.push(Obstacle {
                    key: key(found),
                    surface,
                    motion: still(collider, cable.time()),
                    friction: 0.0,
                    skin: f64::from(collider.contact_skin()),
                });
            }
        }
        cable.set_obstacles(obstacles)?;
        match cable.overlap() {
            None => Ok(()),
            Some(Overlap { obstacle, arc_length, depth }) => Err(Error::CableTouchesInStatics {
                cable: cable.name().to_string(),
                collider: super::collider(obstacle),
                arc_length,
                depth,
            }),
        }
    }

    /// Finds the colliders that a cable can reach in a step of `h` (s).
    fn find(&mut self, world: &PhysicsWorld, cable: &Cable, h: f64) {
        let Finder { boxes, found, moving, listed, .. } = self;
        found.clear();
        boxes.clear();
        let margin = f64::from(world.integration_parameters.prediction_distance()) + MARGIN * cable.contact_radius();
        let (q, v, elements) = (cable.positions(), cable.velocities(), cable.elements());
        for first in (0..elements.len()).step_by(CHUNK) {
            let last = (first + CHUNK).min(elements.len());
            let mut low = Vector3::repeat(f64::INFINITY);
            let mut high = -low;
            for node in first..=last {
                let at = |x: &[f64], k: usize| Vector3::from_column_slice(&x[6 * node + k..6 * node + k + 3]);
                let length = elements[node.min(elements.len() - 1)].length;
                let size = at(q, 3).norm() * length / 3.0 + SWEEP * h * (at(v, 0).norm() + at(v, 3).norm() * length);
                let x = at(q, 0);
                (low, high) = (low.inf(&x.add_scalar(-size)), high.sup(&x.add_scalar(size)));
            }
            boxes.push(Aabb::new(to_vector(&low.add_scalar(-margin)), to_vector(&high.add_scalar(margin))));
        }
        for own in boxes.iter() {
            if *listed {
                let near = world.intersect_aabb_conservative(*own, QueryFilter::default());
                found.extend(near.map(|(handle, _)| handle));
            } else {
                let near = world.colliders.iter().filter(|(_, c)| c.compute_aabb().intersects(own));
                found.extend(near.map(|(handle, _)| handle));
            }
            found.extend(moving.iter().filter(|(_, swept)| swept.intersects(own)).map(|(handle, _)| *handle));
        }
        found.sort_unstable_by_key(|handle| handle.into_raw_parts());
        found.dedup();
    }
}

/// Returns whether a node of a cable is within a collider, deeper than it may touch.
fn is_inside(cable: &Cable, collider: &Collider) -> bool {
    let (origin, axes) = (vector(collider.translation()), rotation(collider.rotation()));
    (0..cable.nodes()).any(|node| {
        let y = to_vector(&(axes.inverse() * (cable.node_position(node) - origin)));
        let distance = f64::from(collider.shape().distance_to_local_point(y, true));
        distance < 0.5 * cable.contact_radius()
    })
}

/// Returns the motion of a collider over a Rapier step that begins at a time (s) of the cables.
fn motion(
    world: &PhysicsWorld,
    collider: &Collider,
    motions: &PrescribedMotions,
    step: &StepParameters,
    time: f64,
) -> RigidMotion {
    let (Some(parent), Some(local)) = (collider.parent(), collider.position_wrt_parent()) else {
        return still(collider, time);
    };
    if !world.bodies.get(parent).is_some_and(|body| body.is_kinematic() && body.is_enabled()) {
        return still(collider, time);
    }
    let [((from, attitude), _), ((to, turned), _)] = motions.ends(world, parent, step.share, step.h);
    let point = reference(world, parent);
    let (offset, tilt): (Vector3<f64>, UnitQuaternion<f64>) = (vector(local.translation), rotation(local.rotation));
    let mut out = RigidMotion {
        start: time,
        centre: tilt.inverse() * (point - offset),
        position: from + attitude * point,
        rotation: attitude * tilt,
        velocity: (to + turned * point - from - attitude * point) / step.h,
        angular_velocity: Vector3::zeros(),
    };
    if turned != attitude {
        out.angular_velocity = (turned * attitude.inverse()).scaled_axis() / step.h;
    } else if to == from {
        out.velocity = Vector3::zeros();
    }
    out
}

/// Returns no motion.
fn still(collider: &Collider, time: f64) -> RigidMotion {
    RigidMotion {
        start: time,
        position: vector(collider.translation()),
        rotation: rotation(collider.rotation()),
        ..RigidMotion::default()
    }
}
