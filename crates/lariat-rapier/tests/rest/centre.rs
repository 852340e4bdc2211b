//! Bodies that hang from their centres.

use super::G;
use lariat_rapier::convert::{to_vector, vector};
use lariat_rapier::lariat_ancf::{At, Cable, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A ball that hangs from its centre, to rounding, or from beside it, finds its rest on every mesh: a lever that single precision
/// does not tell from zero turns nothing.
///
/// *Source.* It hangs straight below the support, by the length of the rope and its stretch.
#[test]
fn a_ball_on_a_rope_at_its_centre_rests() {
    for elements in [5, 8, 10, 20, 32] {
        for lever in [0.0, 1e-16, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4, 0.05] {
            for mass in [0.5, 20.0] {
                let mut world = PhysicsWorld::new();
                world.gravity = Vector::new(0.0, -9.81, 0.0);
                let mut set = CableSet::new();
                let (at, offset) = (Vector3::new(2.0, -1.0, 0.0), Vector3::new(lever, 0.0, lever));
                let body = RigidBodyBuilder::dynamic().translation(to_vector(&(at - offset)));
                let (body, _) = world.insert(body, ColliderBuilder::ball(0.1).mass(mass));
                let rope = Cable::builder()
                    .points([Vector3::zeros(), at])
                    .section(Section::from_stiffness(2.0e5, 0.0, 0.1).unwrap())
                    .elements(elements)
                    .fix(At::Start);
                let cable = set.insert(rope.build().unwrap());
                set.attach(&world, cable, At::End, body, offset, AttachmentKind::Ball).unwrap();
                set.equilibrium(&mut world).unwrap_or_else(|e| panic!("{elements} elements, lever {lever}: {e}"));
                let centre = vector(world.bodies[body].translation());
                let below = 5.0f64.sqrt() * (1.0 + f64::from(mass) * G / 2e5) + offset.norm();
                assert!(
                    (centre + Vector3::new(0.0, below, 0.0)).norm() < 1e-4,
                    "{elements}, {lever}, {mass}: {centre}"
                );
            }
        }
    }
}
