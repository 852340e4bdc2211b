//! A winch lifts a box from the ground: slack, taut, hanging.

use super::common::{add_cube, cable, gap, soft, tension, wire};
use lariat_rapier::lariat_ancf::{At, Damping, Section};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// Lifts a box of 10 kg from the ground: the winch takes up 2 cm of slack at 1 cm/s, lifts at 20
/// cm/s, and stops. At rest on the ground nothing moves; hanging, the rope carries the weight, and
/// the height is that of winch, slack and stretch.
fn hoist(section: Section) {
    let mut world = PhysicsWorld::new();
    let ground = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.5, 0.0));
    world.insert(ground, ColliderBuilder::cuboid(5.0, 0.5, 5.0));
    let load = add_cube(&mut world, 10.0, 0.1, [0.0, 0.1, 0.0]);
    let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(0.0, 2.1, 0.0)));
    let mut set = CableSet::new();
    // a tenth of critical damping for the bounce of the box; bending damping, or the rope would
    // keep on oscillating from when it was bowed
    let bounce = (section.axial_stiffness / (1.92 * 10.0)).sqrt();
    let losses = Damping { axial: 0.2 / bounce, bending: 0.5 };
    let builder = cable([0.0, 2.1, 0.0], [0.0, 0.2, 0.0], section).length(1.92).damping(losses);
    let rope = set.insert(builder.build().unwrap());
    set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    let smooth = |t: Real| t.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * t.clamp(0.0, 1.0));
    let (mut jitter, mut widest, mut held): (Real, f64, Vec<f64>) = (0.0, 0.0, Vec::new());
    for k in 0..1440 {
        let time = k as Real / 60.0;
        // 1 cm/s from 2 s on, until the box is in the air; 20 cm/s from 7 s on, 0 from 9 s on
        let speed = 0.01 * smooth(time - 2.0) + 0.19 * smooth(time - 7.0) - 0.2 * smooth(time - 9.0);
        world.bodies[winch].set_linvel(Vector::new(0.0, speed, 0.0), true);
        set.step(&mut world).unwrap();
        widest = widest.max(gap(&set));
        if (1.0..2.0).contains(&time) {
            jitter = jitter.max(world.bodies[load].linvel().length());
        }
        if time > 23.0 {
            held.push(tension(&set, rope, 1.92));
        }
    }
    let (low, high) = held.iter().fold((f64::MAX, f64::MIN), |a, x| (a.0.min(*x), a.1.max(*x)));
    assert!(jitter < 1e-3, "before lift-off: {jitter:.1e} m/s");
    assert!(low > 98.1 * 0.995 && high < 98.1 * 1.005, "{low} to {high} N");
    assert!(widest < 1e-3, "{widest:.1e} m");
    let lift = f64::from(world.bodies[load].translation().y) - 0.1;
    let winch = f64::from(world.bodies[winch].translation().y) - 2.1;
    let stretch = 1.92 * 9.81 * (10.0 + 0.5 * 1.92 * section.mass_per_length) / section.axial_stiffness;
    assert!((lift - (winch - 0.02 - stretch)).abs() < 1e-4, "{lift} m, winch {winch} m");
}

/// Reference: the weight, 98.10 N; the axial stiffness of the rope.
#[test]
fn a_soft_rope_lifts_a_box_from_the_ground() {
    hoist(soft());
}

/// Reference: as above.
#[test]
fn a_steel_wire_lifts_a_box_from_the_ground() {
    hoist(wire());
}
