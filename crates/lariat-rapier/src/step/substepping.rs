//! The number of Rapier steps of a host step.
//!
//! # Equation
//! ```text
//! h w <= 0.6                      w^2 = k/m,   k = n.K n,   K that of the taut cables of a body
//! h w <= 0.6                      w^2 = rho g A/m of a body that floats, A its area at the surface
//! h |w|/(2 N) <= 1.2              in N solver iterations
//! h |w|/(2 N) <= 0.005            of a body on impulse joints
//! h |w1 - w0|/4 <= 0.01           of a body on joints, from one end of a Rapier step to the other
//! |p.w| + p.I^-1 p/2 <= 0.01 E    of a body with added mass by axes, p what Munk's moment lacks
//! h v <= l/2                      of a body that collides at v, l the elements at its pins
//! h v <= r                        of one whose cables have contact, or that cables press on, r their radius
//! h v <= l/3                      of a reel at the rate v, l the element at its eye
//! ```
//! *Vibration.* Between two Rapier steps the reaction estimate of a body in contact is constant. If
//! h is long compared with the period of the body on its taut cables, the estimate comes too late:
//! two jammed bodies of 1 kg under 1 kN oscillate by half of it, and a body that is released
//! suddenly is thrown by the old estimate (a gap of F h^2/2m). Therefore the host step is split
//! finer where a body that is near others, or has a reaction estimate, hangs on a cable that is
//! taut or may become so ([`stiffness`](super::stiffness)). n is a direction in which something
//! pushes it: that of the estimate, and the normals of the contacts that it has or is about to
//! have. Joints push in all directions, and so does friction. The plank of a bridge under a foot
//! without friction is soft, where its ropes are stiff along them. A cable that sags gives way: the
//! force F of a shallow catenary of length L and chord c varies as (L - c)^-1/2, its stiffness F/(2
//! (L - c)) as (L - c)^-3/2, which does not double while the chord grows by less than 1 - 2^(-2/3)
//! = 0.37 of L - c. The growth is bounded by the present motion, a collision's change of velocity
//! (2 v h), and a reaction estimate r that is wrong altogether (r h^2/2m). A cable that stays slack
//! by that asks for no split: of a body that it pulls into a stop, r = F, h w <= 0.61.
//!
//! *Heave.* The force of water on a float is constant over a Rapier step
//! ([`water`](crate::water)): in steps beyond half a period it keeps its energy, but what should
//! damp within them does not. At 0.6 its period is off by 3 %, (h w)^2/12.
//!
//! *Blows.* A cable follows a body that deviates by its linear response. A collision displaces an
//! end by v h at most, v that of the points that collide; by more than half an element it would
//! fold that. A cable that touches what it is tied to is found there by where the body was
//! expected: displaced by more than its radius its centre line would be inside, or on the other
//! side of an edge.
//!
//! *Turns.* A mechanism is predicted as it is halfway of a Rapier step, at the velocities with
//! which that begins. If they change in it, by a line that snaps taut, bodies on joints have turned
//! otherwise by the left side of the fourth line, by which share the directions in which they can
//! move are wrong. Then the step is predicted anew, divided. So it is where a rope changes the
//! moment that turns a body across its way in water: what that lacks makes energy. Impulse joints
//! turn a velocity by removing what they do not allow of it, in each substep the share (w h/N)^2/2,
//! which is the left side of the third line per radian.
//!
//! *Long host steps.* What is estimated of a body on joints from step to step, and the directions
//! in which it can move, are of the length of a Rapier step; one of 1.9 s, 32 in a minute, made
//! 1e14 J of 800 kg on a hinge. A host step of more than 1/30 s is therefore taken for as many
//! pieces: bodies on joints have four Rapier steps in each, and each may have as many as the
//! settings allow.
//!
//! The collisions and the taut cables of the whole coming host step count
//! ([`crate::body::proximity`]). All is evaluated again before each Rapier step, and the rest of
//! the host step is split finer.
//!
//! # Validity
//! Measured with 1 kg, jams of 1 and 5 kN, host steps of 1/30 to 1/240 s: h w = 2.6 fails, 1.8
//! holds, 0.9 fails where two bodies hang on each other and the cable hardly damps, 0.6 holds. A
//! cube of 1 kg drawn into its stop at 0.05 m/s by a steel wire, 1/30 s: a gap of 7e-6 m; 2.0 mm
//! where only cables that are taut when the host step begins count. A light ball that hits another
//! at 11 m/s: a gap of 113 mm without a look at the collisions to come.
//!
//! # Alternatives considered
//! A fine split always: a pile of 500 boxes costs 0.5 ms in each Rapier step. A bound of the gap
//! that a collision at v opens before the cable follows, h v g/(1 + g) <= 1 mm with g = 0.1 h^2
//! k/m: with 32 steps at most, h w <= 0.6 asks for more of them below 50 m/s.

use crate::body::is_integrated;
use crate::body::proximity;
use crate::body::spatial::split_spatial;
use crate::contact;
use crate::contents::Contents;
use crate::contents::attachment::Attachment;
use crate::scales::body::MAX_HALF_ROTATION;
use crate::scales::step::{DEVIATION_SHARE, JOINTED_STEPS, MAX_LOSS, MAX_PHASE, MAX_REBOUND, MIN_REACTION};
use crate::step::held_bodies::HeldBodies;
use crate::step::settings::{Settings, pieces};
use crate::step::stiffness::{Part, Stiffness, length_and_compliance, parts};
use ::nalgebra::Vector3;
use lariat_ancf::coupling::Coupling;
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Returns the number of Rapier steps for a host step of `dt` (s). `held` is read anew.
pub(crate) fn count(
    contents: &Contents,
    world: &PhysicsWorld,
    settings: &Settings,
    held: &mut HeldBodies,
    dt: f64,
) -> u32 {
    let min = settings.rapier_steps.max(1);
    let max = settings.most_rapier_steps(dt);
    if max <= min {
        return min;
    }
    held.read(contents);
    let mut fastest = None;
    let mut needed = f64::from(min);
    held.for_each(contents, |handle, own| {
        if !is_integrated(world, handle) {
            return;
        }
        let fastest = *fastest.get_or_insert_with(|| proximity::fastest(world));
        let body = Body::new(contents, world, handle, (dt, own.parts));
        // most cables stay slack and hardly move whatever their body meets, and collisions take
        // longer to find
        let most = f64::from(world.bodies[handle].linvel().length()) + fastest;
        let longest = own.attachments().map(|a| max_deviation(contents, a)).fold(f64::INFINITY, f64::min);
        if body.stiffness(most).sum == 0.0 && most * dt <= longest {
            return;
        }
        let collision = proximity::collision(world, handle, (dt, fastest));
        let held = || own.attachments().any(|a| is_held(contents, a));
        let Some(speed) = collision.or_else(|| held().then_some(0.0)) else { return };
        let steps = |stiffness: f64| dt * (stiffness * body.inverse_mass).sqrt() / MAX_PHASE;
        let stiffness = body.stiffness(speed);
        needed = needed.max(speed * dt / longest);
        if steps(stiffness.sum) > needed {
            needed = needed.max(steps(body.pushed(&stiffness, (dt, fastest))));
        }
    });
    if held.bodies().any(|body| is_integrated(world, body) && !proximity::is_unjointed(world, body)) {
        needed = needed.max(JOINTED_STEPS * f64::from(pieces(dt)));
    }
    let fastest = || fastest.unwrap_or_else(|| proximity::fastest(world));
    let swing = contents.water.as_ref().map_or(0.0, |water| dt * water.fastest_motion(world, dt) / MAX_PHASE);
    let needed = needed.max(swing).max(rotation(held.bodies(), world, dt)).max(pressed(contents, world, (dt, fastest)));
    let needed = contents.cables.values().map(|slot| slot.cable.steps_of_reels(dt)).fold(needed, f64::max);
    // a value that is not a number, or too large, gives the maximum
    (needed.ceil().min(f64::from(max)) as u32).max(min)
}

/// Returns the number of steps of `dt` (s) that bodies need which cables press on others, so that
/// none vibrates between them, and none that collides is displaced by more than the radius of the
/// cable. A cable that touches a body is as stiff as one that is attached to it in the middle.
fn pressed(contents: &Contents, world: &PhysicsWorld, (dt, fastest): (f64, impl Fn() -> f64)) -> f64 {
    let mut bodies: Vec<(RigidBodyHandle, f64, f64)> = Vec::new();
    for slot in contents.cables.values() {
        let compliance: f64 = slot.cable.elements().iter().map(|e| e.length / e.section.axial_stiffness).sum();
        let (stiffness, radius) = (4.0 / compliance, slot.cable.contact_radius());
        let mut last = None;
        for touch in slot.cable.contacts() {
            let body = world.colliders.get(contact::collider(touch.obstacle)).and_then(|c| c.parent());
            let Some(body) = body.filter(|body| is_integrated(world, *body) && last != Some(*body)) else { continue };
            last = Some(body);
            match bodies.iter_mut().find(|(known, ..)| *known == body) {
                Some((_, sum, least)) => (*sum, *least) = (*sum + stiffness, least.min(radius)),
                None => bodies.push((body, stiffness, radius)),
            }
        }
    }
    let near = bodies.iter().filter(|(body, ..)| proximity::may_deviate(world, *body));
    let count = |(body, stiffness, radius): &(RigidBodyHandle, f64, f64)| {
        let inverse_mass = f64::from(world.bodies[*body].mass_properties().local_mprops.inv_mass);
        let speed = proximity::collision(world, *body, (dt, fastest())).unwrap_or(0.0);
        (dt * (stiffness * inverse_mass).sqrt() / MAX_PHASE).max(dt * speed / radius)
    };
    near.map(count).fold(0.0, f64::max)
}

/// Returns the number of steps of `dt` (s) that attached bodies need so that none rotates by more
/// than Rapier's linearised rotation can in a substep, or its impulse joints can turn a velocity.
fn rotation(bodies: impl Iterator<Item = RigidBodyHandle>, world: &PhysicsWorld, dt: f64) -> f64 {
    let substeps = world.integration_parameters.num_solver_iterations.max(1) as f64;
    let count = |handle: RigidBodyHandle| {
        let spin = world.bodies.get(handle).filter(|body| body.is_dynamic()).map_or(0.0, |body| body.angvel().length());
        let is_link = || world.multibody_joints.rigid_body_link(handle).is_some();
        let turned = proximity::is_unjointed(world, handle) || is_link();
        0.5 * f64::from(spin) * dt / substeps / if turned { MAX_HALF_ROTATION } else { MAX_LOSS }
    };
    bodies.map(count).fold(0.0, f64::max)
}

/// Returns whether the body of an attachment has a reaction estimate against the force there.
fn is_held(contents: &Contents, a: &Attachment) -> bool {
    split_spatial(&contents.records.reaction(a.body)).0.norm() > MIN_REACTION * a.reading.force.norm()
}

/// Returns the way in m by which a collision may displace an attachment in a Rapier step.
fn max_deviation(contents: &Contents, a: &Attachment) -> f64 {
    let Some(slot) = contents.slot(a.cable) else { return f64::INFINITY };
    let elements = slot.cable.elements();
    let next = &elements[a.node.saturating_sub(1).min(elements.len() - 1)..(a.node + 1).min(elements.len())];
    let folds = DEVIATION_SHARE * next.iter().map(|element| element.length).fold(f64::INFINITY, f64::min);
    if slot.cable.effects().contact.is_some() { folds.min(slot.cable.contact_radius()) } else { folds }
}

/// A body that may deviate from its prediction.
struct Body<'a> {
    /// The parts of its cables.
    parts: &'a [Part],
    world: &'a PhysicsWorld,
    handle: RigidBodyHandle,
    /// Of the Rapier step, in s.
    dt: f64,
    /// In 1/kg.
    inverse_mass: f64,
    /// Estimated force of contacts and joints, in N.
    reaction: Vector3<f64>,
}

impl<'a> Body<'a> {
    fn new(
        contents: &Contents,
        world: &'a PhysicsWorld,
        handle: RigidBodyHandle,
        (dt, parts): (f64, &'a [Part]),
    ) -> Self {
        let inverse_mass = f64::from(world.bodies[handle].mass_properties().local_mprops.inv_mass);
        let reaction = split_spatial(&contents.records.reaction(handle)).0;
        Body { parts, world, handle, dt, inverse_mass, reaction }
    }

    /// Returns what its taut cables do if it collides at a speed (m/s).
    fn stiffness(&self, speed: f64) -> Stiffness {
        let dt = self.dt;
        let change = MAX_REBOUND * speed * dt + 0.5 * self.reaction.norm() * self.inverse_mass * dt * dt;
        Stiffness::of(self.parts.iter(), (dt, change))
    }

    /// Returns the largest stiffness in N/m along the directions in which others may push it, if no
    /// other body is faster than the second of `within` (m/s).
    fn pushed(&self, stiffness: &Stiffness, within: (f64, f64)) -> f64 {
        if !proximity::is_unjointed(self.world, self.handle) {
            return stiffness.sum;
        }
        let mut largest = self.reaction.try_normalize(0.0).map_or(0.0, |along| stiffness.along(&along));
        proximity::for_each_push(self.world, self.handle, within, |_, normal| {
            largest = largest.max(normal().map_or(stiffness.sum, |normal| stiffness.along(&normal)));
        });
        largest
    }
}

/// Returns h w in steps of `h` (s) of the body of an attachment that something holds, if that
/// rests: it has less kinetic energy than a strain of its cables by the force there.
pub(super) fn resting_phase(contents: &Contents, world: &PhysicsWorld, a: &Attachment, h: f64) -> Option<f64> {
    let body = world.bodies.get(a.body).filter(|_| is_integrated(world, a.body) && is_held(contents, a))?;
    let on_body = contents.attachments.values().filter(|b| b.body == a.body);
    let of_attachment = |a: &Attachment| {
        let Some(cable) = contents.slot(a.cable).map(|slot| &slot.cable) else { return 0.0 };
        let sum = |[l, c]: [f64; 2], [length, compliance]: [f64; 2]| [l + length, c + compliance];
        let between = |a: usize, b: usize| cable.elements()[a..b].iter().map(length_and_compliance).fold([0.0; 2], sum);
        parts(cable, a, between).map(|part| Stiffness::of([part].iter(), (h, 0.0)).sum).sum()
    };
    let stiffness: f64 = on_body.map(of_attachment).sum();
    let (mass, speed) = (f64::from(body.mass()), f64::from(body.linvel().length()));
    let rests = mass * speed * speed * stiffness < a.reading.force.norm_squared();
    rests.then(|| h * (stiffness / mass).sqrt())
}
