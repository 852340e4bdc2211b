//! What Rapier itself offers for a cable: a soft rope, and capsules with spherical joints.

use crate::scene::{HALF, LENGTH, PARTS, SIDE, Scene};
use lariat_rapier::rapier::prelude::*;

/// How capsules hold together.
#[derive(Clone, Copy, PartialEq)]
pub enum Chain {
    /// Impulse joints, Rapier's default.
    Impulse,
    /// Multibody joints: reduced coordinates.
    Multibody,
}

/// A rope of as many edges as the cable has elements, its first particle pinned, its last attached to the box.
pub fn soft_rope(
    scene: &Scene,
    world: &mut PhysicsWorld,
    holder: RigidBodyHandle,
    i: usize,
    frequency: Real,
) -> SoftBodyHandle {
    let part = scene.material.mass() as Real / PARTS as Real;
    let mut masses = vec![part; PARTS + 1];
    (masses[0], masses[PARTS]) = (0.5 * part, 0.5 * part);
    let material =
        SoftBodyMaterial { edge_softness: SpringCoefficients::new(frequency, 1.0), ..SoftBodyMaterial::default() };
    let rope = SoftBodyBuilder::rope(scene.start(i), scene.along(i, 1.0), PARTS + 1)
        .masses(masses)
        .material(material)
        .pinned_particles([0])
        .no_surface_collider()
        .can_sleep(false);
    let handle = world.insert_soft_body(rope);
    world.soft_bodies[handle].attach_particle(PARTS, holder, &world.bodies);
    handle
}

/// Capsules as long as the elements, as thick as the cable, from a fixed body to the box. They meet nothing, not even each other.
pub fn capsules(
    scene: &Scene,
    world: &mut PhysicsWorld,
    holder: RigidBodyHandle,
    i: usize,
    chain: Chain,
) -> Vec<RigidBodyHandle> {
    let half = 0.5 * LENGTH as Real / PARTS as Real;
    let radius = 0.5 * SIDE as Real;
    let joined = |world: &mut PhysicsWorld, a: RigidBodyHandle, b: RigidBodyHandle, joint: SphericalJointBuilder| {
        let joint = joint.contacts_enabled(false);
        match chain {
            Chain::Impulse => drop(world.insert_impulse_joint(a, b, joint)),
            Chain::Multibody => drop(world.insert_multibody_joint(a, b, joint)),
        }
    };
    // capsules lie along their y axis, their lower ends towards the box
    let turn = if scene.swings { std::f32::consts::FRAC_PI_2 } else { 0.0 };
    let fixed = RigidBodyBuilder::fixed().translation(scene.start(i)).rotation(Vector::Z * turn);
    let mut last = world.insert_body(fixed);
    let mut end = Vector::ZERO;
    let mut links = Vec::with_capacity(PARTS);
    for k in 0..PARTS {
        let centre = scene.along(i, (k as f64 + 0.5) / PARTS as f64);
        let body = RigidBodyBuilder::dynamic().translation(centre).rotation(Vector::Z * turn).can_sleep(false);
        let shape = ColliderBuilder::capsule_y(half - radius, radius)
            .mass(scene.material.mass() as Real / PARTS as Real)
            .collision_groups(InteractionGroups::none());
        let (link, _) = world.insert(body, shape);
        let joint = SphericalJointBuilder::new().local_anchor1(end).local_anchor2(Vector::Y * half);
        joined(world, last, link, joint);
        (last, end) = (link, -Vector::Y * half);
        links.push(link);
    }
    // multibody joints begin without rotation between their frames, wherever the bodies are: the box's frame lies as the links do
    let frame = Pose::new(Vector::Y * HALF, Vector::Z * turn);
    joined(world, last, holder, SphericalJointBuilder::new().local_anchor1(end).local_frame2(frame));
    links
}

/// The joints between links, in the middle of their gaps.
pub fn joints(world: &PhysicsWorld, links: &[RigidBodyHandle]) -> Vec<Vector> {
    let half = 0.5 * LENGTH as Real / PARTS as Real;
    let place = |link: &RigidBodyHandle, y: Real| *world.bodies[*link].position() * (Vector::Y * y);
    links.windows(2).map(|pair| (place(&pair[0], -half) + place(&pair[1], half)) * 0.5).collect()
}
