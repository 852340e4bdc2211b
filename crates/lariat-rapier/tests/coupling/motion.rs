//! Kinematic and fixed bodies carry a cable's end; users push bodies between steps.

use super::bench::{add_cube, cable, damping, gap, run, soft, v, weightless};
use lariat_rapier::lariat_ancf::{At, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// Both kinds of kinematic body, moving and turning for 2 s, the anchor off their axis: the cable's end is on it to single precision.
///
/// *Source.* The motion that was prescribed: 0.2 m/s, 2 rad/s.
#[test]
fn kinematic_bodies_carry_the_end_exactly() {
    for position_based in [false, true] {
        let mut world = PhysicsWorld::new();
        let builder = if position_based {
            RigidBodyBuilder::kinematic_position_based()
        } else {
            RigidBodyBuilder::kinematic_velocity_based()
        };
        let arm = world.insert_body(builder);
        let mut set = CableSet::new();
        let rope = set.insert(cable([0.3, 0.0, 0.0], [1.3, 0.0, 0.0], soft()).build().unwrap());
        set.attach(&world, rope, At::Start, arm, Vector::new(0.3, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        let mut worst = 0.0f64;
        for k in 1..=120 {
            if position_based {
                let t = k as Real / 60.0;
                let pose = Pose::new(Vector::new(0.2 * t, 0.0, 0.1 * t), Vector::new(0.0, 0.0, 2.0 * t));
                world.bodies[arm].set_next_kinematic_position(pose);
            } else {
                world.bodies[arm].set_linvel(Vector::new(0.2, 0.0, 0.1), true);
                world.bodies[arm].set_angvel(Vector::new(0.0, 0.0, 2.0), true);
            }
            set.step(&mut world).unwrap();
            let anchor = *world.bodies[arm].position() * Vector::new(0.3, 0.0, 0.0);
            worst = worst.max((set.get(rope).unwrap().node_position(0) - v(anchor)).norm());
        }
        assert!(worst < 5e-7, "position based {position_based}: {worst:.1e} m");
        assert!((world.bodies[arm].translation() - Vector::new(0.4, 0.0, 0.2)).length() < 1e-4);
    }
}

/// A drum whose velocity is set to 150 and 300 rad/s: Rapier turns it by a linearised rotation in each substep, by pi/4 in a step at
/// most, and the cable's end, 0.1 m off its axis, is where it turned to.
///
/// *Source.* The pose of the body.
#[test]
fn an_end_is_where_rapier_turns_a_fast_body_to() {
    for iterations in [1, 4] {
        for speed in [150.0, 300.0] {
            let mut world = weightless();
            world.integration_parameters.num_solver_iterations = iterations;
            let drum = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
            let mut set = CableSet::new();
            let lash = cable([0.1, 0.0, 0.0], [0.6, 0.0, 0.0], soft()).gravity(Vector3::zeros()).integrator(damping());
            let lash = set.insert(lash.build().unwrap());
            set.attach(&world, lash, At::Start, drum, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
            let (mut worst, mut turned) = (0.0f64, 0.0f64);
            for k in 0..30 {
                let before = *world.bodies[drum].rotation();
                world.bodies[drum].set_angvel(Vector::new(0.0, 0.0, speed * (k as Real / 20.0).min(1.0)), true);
                set.step(&mut world).unwrap();
                worst = worst.max(gap(&set));
                turned =
                    turned.max(f64::from((before.inverse() * *world.bodies[drum].rotation()).to_scaled_axis().z.abs()));
            }
            assert!(turned > 1.0, "{turned}");
            assert!(worst < 1e-6, "{iterations} iterations, {speed} rad/s: {worst:.1e} m");
        }
    }
}

/// A cube with a rope at 0.1 m from its centre spins at 20 to 200 rad/s, two turns in a host step, with one solver iteration and with four:
/// Rapier's linearised rotation, and its limit of pi/4 in a step, leave no gap.
///
/// *Source.* The contract of an attachment.
#[test]
fn a_spinning_body_lands_where_it_was_predicted() {
    for iterations in [1, 4] {
        for speed in [20.0, 200.0] {
            let mut world = weightless();
            world.integration_parameters.num_solver_iterations = iterations;
            let load = add_cube(&mut world, 5.0, 0.1, [0.0; 3]);
            world.bodies[load].set_angvel(Vector::new(0.0, 0.0, speed), true);
            let mut set = CableSet::new();
            let lash = cable([0.1, 0.0, 0.0], [0.3, 0.0, 0.0], soft()).gravity(Vector3::zeros()).integrator(damping());
            let lash = set.insert(lash.elements(2).build().unwrap());
            set.attach(&world, lash, At::Start, load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
            let (mut worst, mut turned) = (0.0f64, 0.0f64);
            for _ in 0..10 {
                let before = *world.bodies[load].rotation();
                set.step(&mut world).unwrap();
                worst = worst.max(gap(&set));
                turned =
                    turned.max(f64::from((before.inverse() * *world.bodies[load].rotation()).to_scaled_axis().z.abs()));
            }
            println!("{iterations} iterations, {speed} rad/s: turned {turned:.2}, gap {worst:.1e} m");
            assert!(turned > 0.2, "{turned}");
            assert!(worst < 1e-6, "{iterations} iterations, {speed} rad/s: {worst:.1e} m");
            assert!(!world.bodies[load].is_fast_rotation_allowed());
        }
    }
}

/// Forces, damping, the gyroscopic flag, gravity's scale and the time step are after half a second what the user set.
///
/// *Source.* The contract.
#[test]
fn what_a_user_set_is_untouched_by_a_step() {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 5.0, 0.1, [2.0, -0.1, 0.0]);
    let body = &mut world.bodies[load];
    body.add_force(Vector::new(1.0, 2.0, 3.0), true);
    body.add_torque(Vector::new(0.1, -0.2, 0.3), true);
    body.set_linear_damping(0.3);
    body.set_angular_damping(0.4);
    body.enable_gyroscopic_forces(false);
    body.set_gravity_scale(0.5, true);
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [2.0, 0.0, 0.0], soft()).fix(At::Start).build().unwrap());
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    let dt = world.integration_parameters.dt;
    run(&mut world, &mut set, 30);
    let body = &world.bodies[load];
    assert_eq!(body.user_force(), Vector::new(1.0, 2.0, 3.0));
    assert_eq!(body.user_torque(), Vector::new(0.1, -0.2, 0.3));
    assert_eq!((body.linear_damping(), body.angular_damping(), body.gravity_scale()), (0.3, 0.4, 0.5));
    assert!(!body.gyroscopic_forces_enabled());
    assert_eq!(world.integration_parameters.dt, dt);
}

/// Between steps a user sets the velocity or the spin of a body, or strikes it: the system goes on with it. The body holds to a free
/// cable, whose end follows at once, so momentum grows by the 0.02 kg of cable at the pin.
///
/// *Source.* m v and p of the user; conservation afterwards.
#[test]
fn impulses_and_velocities_between_steps_act() {
    let fly = |change: &dyn Fn(&mut RigidBody)| {
        let mut world = weightless();
        let load = add_cube(&mut world, 5.0, 0.1, [0.0; 3]);
        let mut set = CableSet::new();
        let rope = cable([0.1, 0.0, 0.0], [1.1, 0.0, 0.0], soft()).gravity(Vector3::zeros());
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::Start, load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        run(&mut world, &mut set, 10);
        change(&mut world.bodies[load]);
        let momentum = |world: &PhysicsWorld, set: &CableSet| {
            v(world.bodies[load].linvel()) * 5.0 + set.get(rope).unwrap().momentum().linear
        };
        run(&mut world, &mut set, 1);
        let first = momentum(&world, &set);
        run(&mut world, &mut set, 30);
        assert!((momentum(&world, &set) - first).norm() < 1e-5, "{first:?}, {:?}", momentum(&world, &set));
        assert!(gap(&set) < 1e-6);
        (first, v(world.bodies[load].angvel()))
    };
    let push = Vector::new(1.0, 2.0, 0.5);
    for (moved, _) in [fly(&|b| b.set_linvel(push, true)), fly(&|b| b.apply_impulse(push * 5.0, true))] {
        assert!((moved - v(push) * 5.0).norm() < 0.01 * 5.0 * v(push).norm(), "{moved:?}");
    }
    let (_, spin) = fly(&|b| b.set_angvel(Vector::new(0.0, 0.0, 1.0), true));
    assert!(spin.z > 0.5 && spin.z < 1.0, "{spin:?}");
}
