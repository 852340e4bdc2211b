//! Bodies that hang above half-spaces.

use super::G;
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableSet, Rope};

/// A body of any shape that hangs clear of a half-space, level or inclined, near or far, is found by its forces; one that is
/// drawn in it is not taken for clear.
///
/// *Source.* Its lowest point is at the clearance above the plane; it hangs straight below its support by the length of the rope
/// and its stretch.
#[test]
fn bodies_hang_clear_of_a_half_space() {
    let shapes: [(SharedShape, f64); 4] = [
        (SharedShape::ball(0.3), 0.3),
        (SharedShape::cuboid(0.3, 0.3, 0.3), 0.3 * 3.0f64.sqrt()),
        (SharedShape::capsule_y(0.2, 0.2), 0.4),
        (SharedShape::cylinder(0.3, 0.2), 0.3f64.hypot(0.2)),
    ];
    for (shape, reach) in &shapes {
        for (tilt, clearance) in
            [(0.0, 0.02), (0.0, 0.5), (0.0, 20.0), (0.5, 0.02), (-0.4, 3.0), (0.5, 300.0), (0.3, -0.2)]
        {
            let mut world = PhysicsWorld::new();
            let normal = Vector3::new(f64::sin(tilt), f64::cos(tilt), 0.0);
            // the plane is as far below the body as its shape reaches in any direction, and the clearance
            let down = 2.0 * (1.0 + 10.0 * G / 1e5) + 0.3;
            let at = Vector3::new(0.0, -down, 0.0) - normal * (reach + clearance);
            let plane =
                ColliderBuilder::new(SharedShape::halfspace(Vector::new(normal.x as Real, normal.y as Real, 0.0)));
            let plane = plane.translation(Vector::new(at.x as Real, at.y as Real, 0.0));
            let ground = world.insert_body(RigidBodyBuilder::fixed());
            world.insert_collider(plane, Some(ground));
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -2.3, 0.0));
            let (body, _) = world.insert(body, ColliderBuilder::new(shape.clone()).mass(10.0));
            let mut set = CableSet::new();
            let rope = Rope::new(Section::from_stiffness(1e5, 0.01, 0.01).unwrap());
            set.add_rope(&world, [0.0, 0.0, 0.0], (body, [0.0, -2.0, 0.0]), rope).unwrap();
            let found = set.equilibrium(&mut world);
            if clearance > 0.0 {
                let found = found.unwrap_or_else(|e| panic!("{shape:?}, tilt {tilt}, clearance {clearance}: {e}"));
                assert!(found.relaxed.is_none() && found.is_stable(), "{tilt}, {clearance}: {found:?}");
                let place = vector(world.bodies[body].translation());
                assert!((place + Vector3::new(0.0, down, 0.0)).norm() < 2e-4, "{tilt}, {clearance}: {place}");
            } else {
                assert!(found.is_err() || found.is_ok_and(|found| found.relaxed.is_some()));
            }
        }
    }
}
