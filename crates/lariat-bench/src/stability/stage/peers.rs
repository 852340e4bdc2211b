//! What Rapier itself offers for a rope: a soft rope, and capsules with spherical joints, laid along the nodes of the cable.

use super::super::engine::rapier::prelude::*;
use super::{End, Hold, Stage, Strand, from, to};
use crate::stability::host::Make;
use lariat_ancf::{Cable, Vector3};

fn places(cable: &Cable) -> Vec<Vector3<f64>> {
    (0..cable.nodes()).map(|k| cable.node_position(k)).collect()
}

fn mass(cable: &Cable) -> f64 {
    cable.elements().iter().map(|e| e.length * e.section.mass_per_length).sum()
}

fn hold(end: End, at: &Vector3<f64>) -> Hold {
    match end {
        End::Free => Hold::None,
        End::Fixed | End::Clamped => Hold::World((*at).into()),
        End::On(body, anchor) | End::ClampedOn(body, anchor) => Hold::Body(body, anchor),
    }
}

/// Particles at the nodes, edges as long as the elements, those of fixed ends pinned, of others attached to their bodies.
pub fn soft_rope(world: &mut PhysicsWorld, cable: &Cable, start: End, end: End) -> Strand {
    let nodes = places(cable);
    let last = nodes.len() - 1;
    let part = (mass(cable) / last as f64) as Real;
    let mut masses = vec![part; last + 1];
    (masses[0], masses[last]) = (0.5 * part, 0.5 * part);
    let material = SoftBodyMaterial { edge_softness: SpringCoefficients::new(1e6, 1.0), ..SoftBodyMaterial::default() };
    // laid straight, so that edges have their rest length, then moved to where the nodes are
    let length = cable.length();
    let along = |k: usize| nodes[0] + Vector3::x() * (length * k as f64 / last as f64);
    let pinned = [(0, start), (last, end)].into_iter().filter(|(_, e)| matches!(e, End::Fixed | End::Clamped));
    let rope = SoftBodyBuilder::rope(to(along(0).into()), to(along(last).into()), last + 1)
        .masses(masses)
        .material(material)
        .pinned_particles(pinned.map(|(k, _)| k as u32))
        .no_surface_collider()
        .can_sleep(false);
    let handle = world.insert_soft_body(rope);
    let rope = &mut world.soft_bodies[handle];
    for (k, at) in nodes.iter().enumerate() {
        rope.set_particle_position(k, to((*at).into()));
        let v = &cable.velocities()[6 * k..6 * k + 3];
        rope.set_particle_velocity(k, to([v[0], v[1], v[2]]));
    }
    for (k, e) in [(0, start), (last, end)] {
        if let End::On(body, _) | End::ClampedOn(body, _) = e {
            world.soft_bodies[handle].attach_particle(k as _, body, &world.bodies);
        }
    }
    Strand::Soft(handle, length, [hold(start, &nodes[0]), hold(end, &nodes[last])], mass(cable) / last as f64)
}

/// Capsules as long as the elements are drawn, as thick as the cable. They meet nothing, not even each other.
pub fn links(world: &mut PhysicsWorld, cable: &Cable, start: End, end: End, make: Make) -> Strand {
    let nodes = places(cable);
    let last = nodes.len() - 1;
    let joined = |world: &mut PhysicsWorld, a: RigidBodyHandle, b: RigidBodyHandle, frames: (Pose, Pose)| {
        let joint = SphericalJointBuilder::new().local_frame1(frames.0).local_frame2(frames.1).contacts_enabled(false);
        if make == Make::Capsules {
            world.insert_impulse_joint(a, b, joint);
        } else {
            // a loop cannot be a multibody: it stays open
            world.insert_multibody_joint(a, b, joint);
        }
    };
    let thick = cable.elements()[0].section.diameter.unwrap_or(0.01);
    let mut before: Option<(RigidBodyHandle, Pose)> = match hold(start, &nodes[0]) {
        Hold::None => None,
        Hold::World(at) => Some((world.insert_body(RigidBodyBuilder::fixed().translation(to(at))), Pose::IDENTITY)),
        Hold::Body(body, anchor) => Some((body, Pose::from_translation(to(anchor)))),
    };
    let mut links = Vec::with_capacity(last);
    for k in 0..last {
        let (a, b) = (nodes[k], nodes[k + 1]);
        let half = 0.5 * (b - a).norm();
        let turn = nalgebra::UnitQuaternion::rotation_between(&Vector3::y(), &(a - b))
            .unwrap_or_else(|| nalgebra::UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        let v = |k: usize| Vector3::from_column_slice(&cable.velocities()[6 * k..6 * k + 3]);
        let spin = (b - a).cross(&(v(k + 1) - v(k))) / (4.0 * half * half).max(1e-12);
        let body = RigidBodyBuilder::dynamic()
            .translation(to((0.5 * (a + b)).into()))
            .rotation(to(turn.scaled_axis().into()))
            .linvel(to((0.5 * (v(k) + v(k + 1))).into()))
            .angvel(to(spin.into()))
            .can_sleep(false);
        let radius = (0.5 * thick).min(0.45 * half);
        let element = &cable.elements()[k];
        let shape = ColliderBuilder::capsule_y((half - radius) as Real, radius as Real)
            .mass((element.length * element.section.mass_per_length) as Real)
            .collision_groups(InteractionGroups::none());
        let (link, _) = world.insert(body, shape);
        let top = Pose::from_translation(Vector::Y * half as Real);
        if let Some((body, frame)) = before {
            // multibody joints begin without rotation between their frames, wherever the bodies are
            let relative = world.bodies[body].rotation().inverse() * *world.bodies[link].rotation();
            let frame = Pose { rotation: relative, ..frame };
            joined(world, body, link, (frame, top));
        }
        before = Some((link, Pose::from_translation(-Vector::Y * half as Real)));
        links.push((link, half));
    }
    if let Some((link, frame)) = before {
        let target = match hold(end, &nodes[last]) {
            Hold::None => None,
            Hold::World(at) => Some((world.insert_body(RigidBodyBuilder::fixed().translation(to(at))), [0.0; 3])),
            Hold::Body(body, anchor) => Some((body, anchor)),
        };
        if let Some((body, anchor)) = target {
            let relative = world.bodies[body].rotation().inverse() * *world.bodies[link].rotation();
            let own = Pose { rotation: relative, ..Pose::from_translation(to(anchor)) };
            joined(world, link, body, (frame, own));
        }
    }
    Strand::Links(links, cable.length(), [hold(start, &nodes[0]), hold(end, &nodes[last])])
}

/// Places of the points of a rival's rope: particles, or the ends of links.
fn points(stage: &Stage, strand: &Strand) -> Vec<Vector3<f64>> {
    match strand {
        Strand::Soft(handle, ..) => match stage.world.soft_bodies.get(*handle) {
            Some(rope) => rope.particle_positions().map(from).collect(),
            None => Vec::new(),
        },
        Strand::Links(links, ..) => {
            let end = |(link, half): &(RigidBodyHandle, f64), side: f64| {
                let body = stage.world.bodies.get(*link)?;
                Some(from(*body.position() * (Vector::Y * (side * half) as Real)))
            };
            let tops = links.iter().map(|l| end(l, 1.0));
            tops.chain([links.last().and_then(|l| end(l, -1.0))]).flatten().collect()
        }
        Strand::Cable(_) => Vec::new(),
    }
}

fn anchor(stage: &Stage, hold: &Hold) -> Option<Vector3<f64>> {
    match hold {
        Hold::None => None,
        Hold::World(at) => Some(Vector3::from(*at)),
        Hold::Body(body, anchor) => Some(from(*stage.world.bodies.get(*body)?.position() * to(*anchor))),
    }
}

/// Length over rest length, less 1, from anchor to anchor, so that gaps count.
pub fn stretch(stage: &Stage, strand: &Strand) -> f64 {
    let (Strand::Soft(_, length, holds, _) | Strand::Links(_, length, holds)) = strand else { return 0.0 };
    let mut all: Vec<Vector3<f64>> = anchor(stage, &holds[0]).into_iter().collect();
    all.extend(points(stage, strand));
    all.extend(anchor(stage, &holds[1]));
    all.windows(2).map(|p| (p[1] - p[0]).norm()).sum::<f64>() / length - 1.0
}

/// Widest gap between the ends of the rivals' ropes and what they hold to in m.
pub fn gap(stage: &Stage) -> f64 {
    let gaps = stage.strands.iter().flat_map(|strand| {
        let (Strand::Soft(_, _, holds, _) | Strand::Links(_, _, holds)) = strand else { return [0.0; 2] };
        let all = points(stage, strand);
        let apart = |hold: &Hold, end: Option<&Vector3<f64>>| match (anchor(stage, hold), end) {
            (Some(a), Some(b)) => (a - b).norm(),
            _ => 0.0,
        };
        [apart(&holds[0], all.first()), apart(&holds[1], all.last())]
    });
    gaps.fold(0.0, f64::max)
}

/// Total and kinetic energy of soft ropes in J; what their edges store is not known.
pub fn soft_energy(stage: &Stage) -> (f64, f64) {
    let gravity = from(stage.world.gravity);
    let mut sum = (0.0, 0.0);
    for strand in &stage.strands {
        let Strand::Soft(handle, _, _, part) = strand else { continue };
        let Some(rope) = stage.world.soft_bodies.get(*handle) else { continue };
        let last = rope.num_particles() - 1;
        for (k, (x, v)) in rope.particle_positions().zip(rope.particle_velocities()).enumerate() {
            let mass = if k == 0 || k == last { 0.5 * part } else { *part };
            let kinetic = 0.5 * mass * from(v).norm_squared();
            sum = (sum.0 + kinetic - mass * gravity.dot(&from(x)), sum.1 + kinetic);
        }
    }
    sum
}

/// Whether the particles are numbers.
pub fn soft_is_finite(stage: &Stage) -> bool {
    stage.strands.iter().all(|strand| match strand {
        Strand::Soft(..) => points(stage, strand).iter().all(|p| p.iter().all(|x| x.is_finite())),
        _ => true,
    })
}
