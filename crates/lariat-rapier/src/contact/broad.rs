//! Which colliders a cable can reach in a Rapier step, by Rapier's tree, and how they move.
//!
//! # Validity
//!
//! A cable is boxed by eight elements at a time, each box grown by its way in the step and by that
//! of the fastest dynamic body, the radius and Rapier's prediction distance. The tree holds the
//! boxes of Rapier's last step: kinematic bodies that move are looked up besides, with the box that
//! they sweep. Before Rapier's first step, and while it does not know all colliders, every one of
//! them is looked at.

use super::neighbours::Neighbours;
use super::{Surfaces, key};
use crate::body::prescribed_motion::PrescribedMotions;
use crate::contents::Contents;
use crate::contents::rules::{ContactFilter, ContactRules};
use crate::convert::{rotation, to_vector, vector};
use crate::events::Event;
use crate::handle::CableHandle;
use crate::islands::{Island, Member};
use crate::scales::contact::{CHUNK, HELD, IGNORED, MARGIN, SWEEP};
use ::nalgebra::{UnitQuaternion, Vector3};
use lariat_ancf::contact::{LARGEST_RESTITUTION, Mount, Obstacle, RigidMotion, Surface};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Cable, Warning};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Aabb, BoundingVolume, Collider, ColliderHandle};
use rapier::math::Real;
use rapier::pipeline::{PhysicsWorld, QueryFilter};

/// Buffers and surfaces. Nothing in them is state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Finder {
    surfaces: Surfaces,
    boxes: Vec<Aabb>,
    found: Vec<ColliderHandle>,
    /// Colliders of kinematic bodies that move in the step, with the boxes that they sweep.
    moving: Vec<(ColliderHandle, Aabb)>,
    /// Whether these are all.
    listed: bool,
    /// Largest speed in m/s of a point of a dynamic body that is awake.
    fastest: f64,
    /// Cables and the dynamic bodies that they can reach in the present Rapier step, in ascending
    /// order.
    pub touching: Vec<(usize, RigidBodyHandle)>,
    /// Cables that can reach each other in it.
    pub neighbours: Neighbours,
    pub filter: Option<ContactFilter>,
}

impl Finder {
    /// Begins a Rapier step: finds the colliders that move as prescribed, and the dynamic bodies
    /// that cables can reach. Does nothing if no cable has contact.
    pub fn begin(&mut self, contents: &Contents, world: &PhysicsWorld, h: f64) {
        self.moving.clear();
        self.touching.clear();
        self.neighbours.begin(contents, h);
        if contents.cables.values().all(|slot| slot.cable.effects().contact.is_none()) {
            return;
        }
        self.surfaces.retain(|collider| world.colliders.contains(collider));
        self.listed = contents.listed == Some(world.colliders.len());
        self.fastest = fastest(world);
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
        for (index, slot) in contents.cables.iter().filter(|(_, slot)| slot.cable.effects().contact.is_some()) {
            self.find(world, &slot.cable, h);
            for i in 0..self.found.len() {
                let handle = self.found[i];
                let Some(collider) = self.touched(world, CableHandle(index as u32), &slot.rules, handle) else {
                    continue;
                };
                let body = collider.parent().filter(|body| crate::body::is_integrated(world, *body));
                let Some(body) = body else { continue };
                let own = collider.shared_shape();
                if !self.touching.contains(&(index, body)) && self.surfaces.of(handle, own).is_some() {
                    self.touching.push((index, body));
                }
            }
        }
        self.touching.sort_unstable_by_key(|(cable, body)| (*cable, body.into_raw_parts()));
    }

    /// Returns a collider if a cable may touch it.
    pub(crate) fn touched<'a>(
        &self,
        world: &'a PhysicsWorld,
        cable: CableHandle,
        rules: &ContactRules,
        handle: ColliderHandle,
    ) -> Option<&'a Collider> {
        let filtered = self.filter.as_ref().is_some_and(|filter| !filter.allows(cable, handle));
        world.colliders.get(handle).filter(|collider| !filtered && rules.allow(collider))
    }

    /// Gives a cable of an island the colliders that it can reach in a Rapier step of `h` (s), at a
    /// share of the host step, as obstacles, and returns whether one moves, or one that it touched
    /// is gone. A collider with a shape of the program's own in which the cable is found is an
    /// event, once.
    pub fn gather(
        &mut self,
        contents: &mut Contents,
        world: &PhysicsWorld,
        (index, island): (usize, &Island),
        (motions, share, h): (&PrescribedMotions, (f64, f64), f64),
        events: &mut Vec<Event>,
    ) -> Result<bool, lariat_ancf::Error> {
        let Some(slot) = contents.cables.get(index) else { return Ok(false) };
        let Some(contact) = slot.cable.effects().contact else { return Ok(false) };
        self.find(world, &slot.cable, h);
        let (cable, time) = (CableHandle(index as u32), slot.cable.time());
        let (mut obstacles, mut ignored, mut high) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..self.found.len() {
            let handle = self.found[i];
            let Some(collider) = self.touched(world, cable, &slot.rules, handle) else { continue };
            let Some(surface) = self.surfaces.of(handle, collider.shared_shape()) else {
                if !slot.ignored.contains(&key(handle)) && is_inside(&slot.cable, collider) {
                    ignored.push(handle);
                }
                continue;
            };
            let restitution = slot.rules.restitution(contact.restitution, collider);
            if restitution > LARGEST_RESTITUTION && !slot.ignored.contains(&key(handle)) {
                high.push((key(handle), restitution));
            }
            let depth = |anchor: &Vector3<f64>| -surface.nearest(anchor).distance;
            let except = held_pieces(contents, cable, collider, slot.cable.contact_radius(), depth);
            obstacles.push(Obstacle {
                key: key(handle),
                surface,
                motion: motion(world, collider, (motions, share, h), time),
                mount: collider.parent().and_then(|body| mount(world, collider, island, body)),
                friction: slot.rules.friction(contact.friction, collider),
                restitution: restitution.min(LARGEST_RESTITUTION),
                skin: f64::from(collider.contact_skin()),
                except,
            });
        }
        let Some(slot) = contents.cables.get_mut(index) else { return Ok(false) };
        for collider in ignored {
            let name = slot.cable.name();
            log::warn!("cable {name:?} passes through collider {collider:?}, whose shape is the program's own");
            slot.ignored.push(key(collider));
            events.push(Event::ContactIgnored { cable, collider });
        }
        for (key, restitution) in high {
            slot.ignored.push(key);
            let warning = Warning::HighRestitution { cable: slot.cable.name().to_string(), restitution };
            events.push(Event::Warning { cable, warning });
        }
        obstacles.sort_unstable_by_key(|obstacle| obstacle.key);
        let still = |o: &Obstacle| [o.motion.velocity, o.motion.angular_velocity] == [Vector3::zeros(); 2];
        let there = |key: u64| obstacles.iter().any(|o| o.key == key);
        let changed = slot.touched.iter().any(|(key, _)| !there(*key)) || !obstacles.iter().all(still);
        slot.cable.set_obstacles(obstacles)?;
        Ok(changed)
    }

    /// Gives a cable whose statics are solved the colliders of all bodies that stay where they are
    /// as obstacles: fixed, kinematic, and dynamic ones that do not move with cables.
    pub fn gather_for_statics(
        &mut self,
        contents: &Contents,
        world: &PhysicsWorld,
        (index, cable): (usize, &mut Cable),
        moving: &[RigidBodyHandle],
    ) -> Result<(), lariat_ancf::Error> {
        let mut obstacles = Vec::new();
        let slot = contents.cables.get(index).filter(|_| cable.effects().contact.is_some());
        for (found, collider) in slot.iter().flat_map(|_| world.colliders.iter()) {
            let touched = slot.and_then(|slot| self.touched(world, CableHandle(index as u32), &slot.rules, found));
            if touched.is_some() && !collider.parent().is_some_and(|body| moving.contains(&body)) {
                let except = |surface: &dyn Surface| {
                    let depth = |anchor: &Vector3<f64>| -surface.nearest(anchor).distance;
                    held_pieces(contents, CableHandle(index as u32), collider, cable.contact_radius(), depth)
                };
                let friction = |own: f64| slot.map_or(0.0, |slot| slot.rules.friction(own, collider));
                obstacles.extend(self.still_obstacle((found, collider), cable, friction, except));
            }
        }
        cable.set_obstacles(obstacles)
    }

    /// Gives a cable that is in no set all colliders of a world as obstacles, as they stand.
    pub fn gather_still(&mut self, world: &PhysicsWorld, cable: &mut Cable) -> Result<(), lariat_ancf::Error> {
        let mut obstacles = Vec::new();
        if cable.effects().contact.is_some() {
            let rules = ContactRules::default();
            for (found, collider) in world.colliders.iter().filter(|(_, collider)| rules.allow(collider)) {
                let friction = |own: f64| rules.friction(own, collider);
                obstacles.extend(self.still_obstacle((found, collider), cable, friction, |_| Vec::new()));
            }
        }
        cable.set_obstacles(obstacles)
    }

    /// Returns a collider as an obstacle of a cable that stands still, with the friction that it
    /// has with one of a coefficient of its own: statics read it, and do without.
    fn still_obstacle(
        &mut self,
        (found, collider): (ColliderHandle, &Collider),
        cable: &Cable,
        friction: impl FnOnce(f64) -> f64,
        except: impl FnOnce(&dyn Surface) -> Vec<[f64; 2]>,
    ) -> Option<Obstacle> {
        let surface = self.surfaces.of(found, collider.shared_shape())?;
        Some(Obstacle {
            key: key(found),
            except: except(&*surface),
            surface,
            motion: still(collider, cable.time()),
            mount: None,
            friction: cable.effects().contact.map_or(0.0, |contact| friction(contact.friction)),
            restitution: 0.0,
            skin: f64::from(collider.contact_skin()),
        })
    }

    /// Finds the colliders that a cable can reach in a step of `h` (s).
    fn find(&mut self, world: &PhysicsWorld, cable: &Cable, h: f64) {
        let Finder { boxes, found, moving, listed, fastest, .. } = self;
        found.clear();
        boxes.clear();
        let margin = f64::from(world.integration_parameters.prediction_distance())
            + MARGIN * cable.contact_radius()
            + SWEEP * h * *fastest;
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
        distance < IGNORED * cable.contact_radius()
    })
}

/// Returns the motion of a collider over a Rapier step that begins at a time (s) of the cables.
fn motion(
    world: &PhysicsWorld,
    collider: &Collider,
    (motions, share, h): (&PrescribedMotions, (f64, f64), f64),
    time: f64,
) -> RigidMotion {
    let (Some(parent), Some(local)) = (collider.parent(), collider.position_wrt_parent()) else {
        return still(collider, time);
    };
    if !world.bodies.get(parent).is_some_and(|body| body.is_kinematic() && body.is_enabled()) {
        return still(collider, time);
    }
    let [((from, attitude), _), ((to, turned), _)] = motions.ends(world, parent, share, h);
    // it moves uniformly if nothing accelerates the body
    let point = vector(world.bodies[parent].local_center_of_mass());
    let (offset, tilt): (Vector3<f64>, UnitQuaternion<f64>) = (vector(local.translation), rotation(local.rotation));
    let mut out = RigidMotion {
        start: time,
        centre: tilt.inverse() * (point - offset),
        position: from + attitude * point,
        rotation: attitude * tilt,
        velocity: (to + turned * point - from - attitude * point) / h,
        angular_velocity: Vector3::zeros(),
    };
    if turned != attitude {
        out.angular_velocity = (turned * attitude.inverse()).scaled_axis() / h;
    } else if to == from {
        out.velocity = Vector3::zeros();
    }
    out
}

/// Returns where a collider is on an integrated body of an island.
fn mount(world: &PhysicsWorld, collider: &Collider, island: &Island, parent: RigidBodyHandle) -> Option<Mount> {
    let body = island.members.iter().position(|member| *member == Member::Body(parent))?;
    let local = collider.position_wrt_parent()?;
    let centre = vector(world.bodies[parent].local_center_of_mass());
    Some(Mount { body, position: vector(local.translation) - centre, rotation: rotation(local.rotation) })
}

/// Returns the pieces of a cable at its attachments to the body of a collider, which do not touch
/// it: four radii on both sides, and as much more as an anchor is deep inside; `depth` of a point
/// in the axes of the collider, in m, is negative outside.
pub(crate) fn held_pieces(
    contents: &Contents,
    cable: CableHandle,
    collider: &Collider,
    radius: f64,
    depth: impl Fn(&Vector3<f64>) -> f64,
) -> Vec<[f64; 2]> {
    let (Some(parent), Some(local)) = (collider.parent(), collider.position_wrt_parent()) else { return Vec::new() };
    let own = contents.attachments.values().filter(|a| a.cable == cable && a.body == parent);
    own.map(|a| {
        let anchor = rotation(local.rotation).inverse() * (a.anchor - vector(local.translation));
        let reach = HELD * radius + depth(&anchor).max(0.0);
        [a.arc_length - reach, a.arc_length + reach]
    })
    .collect()
}

/// Returns the largest speed in m/s of a point of a collider of a dynamic body that is awake.
fn fastest(world: &PhysicsWorld) -> f64 {
    let awake = world.bodies.iter().filter(|(_, body)| body.is_dynamic() && body.is_enabled() && !body.is_sleeping());
    let speed = |body: &RigidBody| {
        let spin = f64::from(body.angvel().length());
        let extent = |handle: &ColliderHandle| {
            let size = world
                .colliders
                .get(*handle)
                .map_or(0.0, |c| f64::from(c.shape().compute_local_bounding_sphere().radius));
            let local = world.colliders.get(*handle).and_then(|c| c.position_wrt_parent());
            size + local.map_or(0.0, |p| f64::from((p.translation - body.local_center_of_mass()).length()))
        };
        let size = if spin > 0.0 { body.colliders().iter().map(extent).fold(0.0, f64::max) } else { 0.0 };
        f64::from(body.linvel().length()) + if size.is_finite() { spin * size } else { 0.0 }
    };
    awake.map(|(_, body)| speed(body)).fold(0.0, f64::max)
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
