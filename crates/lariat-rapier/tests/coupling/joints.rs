//! Bodies on joints, links of multibodies, motors, limits, CCD, locked axes.

use super::arms::{Elbow, add_links};
use super::common::{add_cube, cable, gap, l_stable_integrator, run, soft, tension, weightless, wire};
use lariat_rapier::convert::{rotation, vector};
use lariat_rapier::lariat_ancf::{At, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// Lets a winch pull `load` along x by a rope until it carries `pull` (N), and stop. Returns the
/// lowest and highest tension, the largest gap, and the largest speed of the load afterwards.
fn pull(
    world: &mut PhysicsWorld,
    load: RigidBodyHandle,
    section: Section,
    pull: f64,
    rapier_steps: u32,
) -> (f64, f64, f64, f64) {
    let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
    let mut set = CableSet::new();
    (set.settings.rapier_steps, set.settings.max_rapier_steps) = (rapier_steps, rapier_steps);
    let rope = cable([0.0; 3], [-2.0, 0.0, 0.0], section).integrator(l_stable_integrator()).gravity(Vector3::zeros());
    let rope = set.insert(rope.build().unwrap());
    set.attach(world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach_here(world, rope, At::End, load, AttachmentKind::Ball).unwrap();
    let compliance = 2.0 / section.axial_stiffness + 1e-8;
    let (mut low, mut high, mut widest, mut fastest) = (f64::MAX, 0.0f64, 0.0f64, 0.0f64);
    for k in 0..720 {
        let missing = (pull - tension(&set, rope, 1.0)) * compliance;
        let speed = if k < 600 { (5.0 * missing).clamp(-0.02, 0.02) } else { 0.0 };
        world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
        set.step(world).unwrap();
        if k >= 600 {
            let now = tension(&set, rope, 1.0);
            (low, high) = (low.min(now), high.max(now));
            widest = widest.max(gap(&set));
            fastest = fastest.max(f64::from(world.bodies[load].linvel().length()));
        }
    }
    (low, high, widest, fastest)
}

/// A body of 1 kg and 100 kg, welded to the world by a fixed impulse joint, is pulled to 5 kN.
///
/// Reference: statics: the tension at which the winch stopped.
#[test]
fn a_body_on_a_fixed_joint_holds_the_tension_at_which_the_winch_stopped() {
    for section in [soft(), wire()] {
        for mass in [1.0, 100.0] {
            let mut world = weightless();
            let load = add_cube(&mut world, mass, 0.1, [-2.1, 0.0, 0.0]);
            let anchor = world.insert_body(RigidBodyBuilder::fixed().translation(Vector::new(-2.1, 0.0, 0.0)));
            world.insert_impulse_joint(anchor, load, FixedJointBuilder::new());
            let (low, high, gap, speed) = pull(&mut world, load, section, 5e3, 4);
            let case = format!(
                "EA {:.1e} N, {mass} kg: {low:.1} to {high:.1} N, gap {gap:.1e} m, {speed:.1e} m/s",
                section.axial_stiffness
            );
            println!("{case}");
            assert!(low > 0.999 * 5e3 && high < 1.001 * 5e3 && gap < 1e-5, "{case}");
        }
    }
}

/// Two cubes on one rope, the far one behind posts; a winch pulls the near one by another rope to 1
/// kN.
///
/// Reference: statics: both ropes carry it.
#[test]
fn two_cables_in_series_carry_the_same_tension_if_the_last_body_is_jammed() {
    for section in [soft(), wire()] {
        let mut world = weightless();
        for y in [-0.35, 0.35] {
            let post = RigidBodyBuilder::fixed().translation(Vector::new(-4.05, y, 0.0));
            world.insert(post, ColliderBuilder::cuboid(0.1, 0.3, 1.0));
        }
        let near = add_cube(&mut world, 1.0, 0.1, [-2.1, 0.0, 0.0]);
        let far = add_cube(&mut world, 1.0, 0.1, [-4.3, 0.0, 0.0]);
        let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
        let mut set = CableSet::new();
        let ropes = [([0.0; 3], [-2.0, 0.0, 0.0]), ([-2.2, 0.0, 0.0], [-4.2, 0.0, 0.0])].map(|(a, b)| {
            set.insert(
                cable(a, b, section).integrator(l_stable_integrator()).gravity(Vector3::zeros()).build().unwrap(),
            )
        });
        set.attach(&world, ropes[0], At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, ropes[0], At::End, near, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, ropes[1], At::Start, near, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, ropes[1], At::End, far, AttachmentKind::Ball).unwrap();
        let compliance = 4.0 / section.axial_stiffness + 3e-6;
        let (mut held, mut widest) = (Vec::new(), 0.0f64);
        for k in 0..900 {
            let missing = (1e3 - tension(&set, ropes[0], 1.0)) * compliance;
            let speed = if k < 60 { 0.05 } else { (5.0 * missing).clamp(-0.05, 0.05) };
            let speed = if k < 780 { speed } else { 0.0 };
            world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
            set.step(&mut world).unwrap();
            if k >= 780 {
                held.extend(ropes.map(|r| tension(&set, r, 1.0)));
                widest = widest.max(gap(&set));
            }
        }
        let (low, high) = held.iter().fold((f64::MAX, f64::MIN), |a, x| (a.0.min(*x), a.1.max(*x)));
        let case = format!("EA {:.1e} N: {low:.2} to {high:.2} N, gap {widest:.1e} m", section.axial_stiffness);
        println!("{case}");
        assert!(low > 999.5 && high < 1000.5 && widest < 1e-5, "{case}");
    }
}

/// Runs an arm of three links of 1 kg and 0.5 m, hinged to the world at its shoulder, its tip held
/// by a rope from above. The links are welded to each other, or hinged with a limit that keeps them
/// straight; by impulse joints or as a multibody. After 1 s an `impulse` (N s) acts on the middle
/// link. Returns the mean, lowest and highest force of the rope over two seconds after another 4,
/// and the gap.
fn arm(multibody: bool, limits: bool, iterations: usize, rate: usize, impulse: f64) -> (f64, f64, f64, f64) {
    let mut world = PhysicsWorld::new();
    world.integration_parameters.num_solver_iterations = iterations;
    world.integration_parameters.dt = 1.0 / rate as Real;
    let elbow = if limits { Elbow::Limited } else { Elbow::Welded };
    let links = add_links(&mut world, &[1.0; 3], elbow, multibody);
    let mut set = CableSet::new();
    let rope = cable([1.5, 1.0, 0.0], [1.5, 0.0, 0.0], soft())
        .fix(At::Start)
        .integrator(l_stable_integrator())
        .build()
        .unwrap();
    let rope = set.insert(rope);
    let held = set.attach_here(&world, rope, At::End, links[2], AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, rate);
    world.bodies[links[1]].apply_impulse(Vector::new(0.0, impulse as Real, 0.3 * impulse as Real), true);
    run(&mut world, &mut set, 4 * rate);
    let (mut mean, mut low, mut high) = (0.0, f64::MAX, f64::MIN);
    for _ in 0..2 * rate {
        set.step(&mut world).unwrap();
        let pull = set.attachment(held).unwrap().force().y;
        (mean, low, high) = (mean + pull / (2 * rate) as f64, pull.min(low), pull.max(high));
    }
    (mean, low, high, gap(&set))
}

/// A rope holds the tip of an arm, for any joints between its links, host steps from 1/30 to 1/240
/// s, and one solver iteration or four: the loads on the links are predicted with the rope, and
/// leave Rapier's joints nothing to do. A limit bears load like a weld.
///
/// Reference: moments about the shoulder: 14.715 N. At limits the force ripples: at 1/30 s in
/// single precision by 0.6 % on a multibody (one iteration) and 0.3 % on impulse joints (four),
/// elsewhere by less than 0.1 %.
#[test]
fn a_rope_carries_half_the_weight_of_an_arm() {
    for (multibody, limits) in [(true, false), (true, true), (false, false), (false, true)] {
        for (iterations, rate) in [(1, 30), (4, 30), (1, 60), (4, 60), (1, 240)] {
            let (mean, low, high, gap) = arm(multibody, limits, iterations, rate, 0.0);
            let case = format!(
                "multibody {multibody}, limits {limits}, {iterations} iterations, 1/{rate} s: mean {mean:.3}, {low:.3} to {high:.3} N, gap {gap:.1e} m"
            );
            println!("{case}");
            assert!((mean / 14.715 - 1.0).abs() < 2e-3 && gap < 1e-5, "{case}");
            let ripple = if limits && rate == 30 { 1e-2 } else { 2e-3 };
            assert!(low > (1.0 - ripple) * 14.715 && high < (1.0 + ripple) * 14.715, "{case}");
        }
    }
}

/// The same arm after an impulse on its middle link: its elbows open and close again. A straight
/// arm moves along itself only by its bends; when the corrections of Rapier's joints along that
/// direction entered the reaction estimate, it blew up within ten steps.
///
/// Reference: as above; every step succeeds.
#[test]
fn an_arm_struck_open_closes_again() {
    for impulse in [0.5, -0.3] {
        let (mean, low, high, gap) = arm(false, true, 4, 240, impulse);
        let case = format!("{impulse} N s: mean {mean:.3}, {low:.3} to {high:.3} N, gap {gap:.1e} m");
        println!("{case}");
        assert!((mean / 14.715 - 1.0).abs() < 0.02 && gap < 1e-3, "{case}");
    }
}

/// An arm of two links whose elbow is at its limit is lifted by a rope at its wrist, and the elbow
/// opens: a limit that the rope pulls away from is not active.
///
/// Reference: statics: the wrist hangs a rope's length below the winch.
#[test]
fn a_rope_lifts_an_arm_off_its_limit() {
    for multibody in [false, true] {
        let mut world = PhysicsWorld::new();
        let mut before = world.insert_body(RigidBodyBuilder::fixed());
        for k in 0..2 {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.25 + 0.5 * k as Real, 0.0, 0.0));
            let body = body.can_sleep(false).linear_damping(1.0).angular_damping(1.0);
            let link = world.insert(body, ColliderBuilder::cuboid(0.2, 0.05, 0.05).mass(1.0)).0;
            let at = Vector::new(if k == 0 { 0.0 } else { 0.25 }, 0.0, 0.0);
            let hinge =
                RevoluteJointBuilder::new(Vector::Z).local_anchor1(at).local_anchor2(Vector::new(-0.25, 0.0, 0.0));
            let joint: GenericJoint = if k == 0 {
                FixedJointBuilder::new().local_anchor2(Vector::new(-0.25, 0.0, 0.0)).into()
            } else {
                hinge.limits([0.0, 1.5]).into()
            };
            if multibody {
                world.multibody_joints.insert(before, link, joint, true).unwrap();
            } else {
                world.insert_impulse_joint(before, link, joint);
            }
            before = link;
        }
        let winch =
            world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(1.0, 1.0, 0.0)));
        let mut set = CableSet::new();
        let rope = cable([1.0, 1.0, 0.0], [1.0, 0.0, 0.0], soft()).integrator(l_stable_integrator()).build().unwrap();
        let rope = set.insert(rope);
        set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, rope, At::End, before, AttachmentKind::Ball).unwrap();
        // the forearm comes to rest on its limit, then the winch lifts by 0.2 m
        run(&mut world, &mut set, 60);
        world.bodies[winch].set_linvel(Vector::new(0.0, 0.2, 0.0), true);
        run(&mut world, &mut set, 60);
        world.bodies[winch].set_linvel(Vector::ZERO, true);
        run(&mut world, &mut set, 120);
        let wrist = vector(*world.bodies[before].position() * Vector::new(0.25, 0.0, 0.0));
        let hangs = set.get(rope).unwrap().node_position(0) - wrist;
        let case = format!("multibody {multibody}: wrist {wrist:?}, gap {:.1e} m", gap(&set));
        println!("{case}");
        assert!((hangs.norm() - 1.0).abs() < 2e-3 && wrist.y > 0.18 && gap(&set) < 1e-3, "{case}");
    }
}

/// A body on a rail (a prismatic impulse joint with a motor) pulls a rope.
///
/// Reference: statics: the maximum force of the motor.
#[test]
fn a_motor_pulls_a_rope_with_its_maximum_force() {
    let mut world = weightless();
    let rail = world.insert_body(RigidBodyBuilder::fixed());
    let slider = add_cube(&mut world, 2.0, 0.1, [0.0, 0.0, 0.0]);
    let joint = PrismaticJointBuilder::new(Vector::X).motor_velocity(0.2, 1e4).motor_max_force(50.0);
    world.insert_impulse_joint(rail, slider, joint);
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [-2.0, 0.0, 0.0], soft())
        .gravity(Vector3::zeros())
        .fix(At::End)
        .integrator(l_stable_integrator());
    let rope = set.insert(rope.build().unwrap());
    let held = set.attach(&world, rope, At::Start, slider, Vector::ZERO, AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 600);
    let force = set.attachment(held).unwrap().force();
    assert!((force.x / -50.0 - 1.0).abs() < 0.02, "{force:?}");
    assert!(gap(&set) < 1e-3);
}

/// A small fast body with CCD and a rope is thrown at a thin wall, in space or along a floor that it touches: it does not pass, and the rope
/// stays on it.
///
/// Reference: the contract of CCD.
#[test]
fn a_body_with_ccd_and_a_rope_stops_at_a_thin_wall() {
    for floor in [false, true] {
        let mut world = weightless();
        let wall = RigidBodyBuilder::fixed().translation(Vector::new(1.0, 0.0, 0.0));
        world.insert(wall, ColliderBuilder::cuboid(0.005, 1.0, 1.0));
        if floor {
            let floor = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.52, 0.0));
            world.insert(floor, ColliderBuilder::cuboid(5.0, 0.5, 5.0).friction(0.0));
        }
        let body = RigidBodyBuilder::dynamic().linvel(Vector::new(30.0, 0.0, 0.0)).ccd_enabled(true);
        let (bullet, _) = world.insert(body, ColliderBuilder::ball(0.02).mass(0.1).friction(0.0));
        let mut set = CableSet::new();
        let tail = cable([0.0; 3], [0.0, 0.5, 0.0], Section::from_stiffness(1e4, 0.1, 0.01).unwrap());
        let tail = tail.gravity(Vector3::zeros()).velocity(Vector3::new(30.0, 0.0, 0.0)).elements(4).build().unwrap();
        let tail = set.insert(tail);
        set.attach(&world, tail, At::Start, bullet, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let mut farthest = 0.0;
        for _ in 0..30 {
            set.step(&mut world).unwrap();
            farthest = world.bodies[bullet].translation().x.max(farthest);
        }
        println!("floor {floor}: {farthest} m, gap {:.1e} m", gap(&set));
        assert!(farthest > 0.5 && farthest < 1.0, "floor {floor}: {farthest}");
        assert!(gap(&set) < 1e-3, "floor {floor}: {:.1e}", gap(&set));
        assert!(set.get(tail).unwrap().positions().iter().all(|x| x.is_finite()));
    }
}

/// A bead that may move along x only is tied to a point above its rail and pushed: it oscillates on
/// the rail, without rotation.
///
/// Reference: the contract; conservation of energy.
#[test]
fn locked_axes_of_a_body_stay_locked() {
    let mut world = weightless();
    let body = RigidBodyBuilder::dynamic()
        .linvel(Vector::new(1.0, 0.0, 0.0))
        .lock_rotations()
        .enabled_translations(true, false, false);
    let (bead, _) = world.insert(body, ColliderBuilder::ball(0.05).mass(1.0));
    let mut set = CableSet::new();
    let rope = cable([0.0, 1.0, 0.0], [0.0; 3], soft()).fix(At::Start).gravity(Vector3::zeros());
    let rope = set.insert(rope.fidelity(Fidelity::Engineering).build().unwrap());
    set.attach(&world, rope, At::End, bead, Vector::ZERO, AttachmentKind::Ball).unwrap();
    let (mut farthest, energy) = (0.0, set.energy(&world).unwrap().total());
    for _ in 0..120 {
        set.step(&mut world).unwrap();
        farthest = vector(world.bodies[bead].translation()).x.abs().max(farthest);
    }
    let at = vector(world.bodies[bead].translation());
    assert!(farthest > 0.05 && at.y.abs() < 1e-6 && at.z.abs() < 1e-6, "{farthest} {at:?}");
    assert!(gap(&set) < 1e-6);
    assert!((set.energy(&world).unwrap().total() / energy - 1.0).abs() < 0.02);
    assert!(vector(world.bodies[bead].rotation().to_scaled_axis()).norm() == 0.0);
}

/// A flywheel on the axle of a multibody, which a slack rope holds in its middle, turns for two seconds.
///
/// Reference: its angle is the sum of its angular velocities. Where these were corrected for the rotation that Rapier gives bodies without
/// joints, it was ahead by 1e-4 at 30 rad/s, (w h/2)^2/3 in substeps of h.
#[test]
fn a_flywheel_of_a_multibody_turns_as_fast_as_it_spins() {
    for speed in [10.0, 30.0, 60.0] {
        let mut world = weightless();
        let frame = world.insert_body(RigidBodyBuilder::fixed());
        let wheel = add_cube(&mut world, 20.0, 0.3, [0.0, 0.0, 0.0]);
        world.insert_multibody_joint(frame, wheel, RevoluteJointBuilder::new(Vector::Z)).unwrap();
        world.step();
        let link = *world.multibody_joints.rigid_body_link(wheel).unwrap();
        let multibody = world.multibody_joints.get_multibody_mut(link.multibody).unwrap();
        multibody.damping_mut().fill(0.0);
        multibody.generalized_velocity_mut()[0] = speed as Real;
        world.bodies[wheel].set_angvel(Vector::new(0.0, 0.0, speed as Real), true);
        let mut set = CableSet::new();
        let rope = cable([0.0; 3], [0.0, 0.0, 1.0], soft()).gravity(Vector3::zeros()).fidelity(Fidelity::Reference);
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::Start, wheel, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let (mut angle, mut expected) = (0.0, 0.0);
        for _ in 0..120 {
            let (before, spin) = (*world.bodies[wheel].rotation(), world.bodies[wheel].angvel().z);
            set.step(&mut world).unwrap();
            let turn = rotation(*world.bodies[wheel].rotation()) * rotation(before).inverse();
            angle += turn.scaled_axis().z;
            expected += 0.5 * f64::from((spin + world.bodies[wheel].angvel().z) * world.integration_parameters.dt);
        }
        let error = angle / expected - 1.0;
        println!("{speed} rad/s: {angle:.5} rad, {error:.1e} off");
        assert!(error.abs() < 5e-6, "{speed} rad/s: {error:.1e}");
    }
}

/// Two wheels on one axle, on impulse joints, with an angular damping of 1/s each; a rope ends in the middle of the first. After a second
/// both have 1/e of their speed.
///
/// Reference: w' = -w, within 1 %.
#[test]
fn bodies_on_joints_are_damped_as_the_user_says() {
    let mut world = weightless();
    let post = world.insert_body(RigidBodyBuilder::fixed());
    let wheels = [0.0, 0.5].map(|x| {
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.0, 0.0)).angvel(Vector::new(4.0, 0.0, 0.0));
        world.insert(body.angular_damping(1.0), ColliderBuilder::ball(0.1).mass(1.0)).0
    });
    world.insert_impulse_joint(post, wheels[0], RevoluteJointBuilder::new(Vector::X));
    let axle = RevoluteJointBuilder::new(Vector::X).local_anchor1(Vector::new(0.5, 0.0, 0.0));
    world.insert_impulse_joint(wheels[0], wheels[1], axle);
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [0.0, 2.0, 0.0], soft()).gravity(Vector3::zeros()).build().unwrap());
    set.attach(&world, rope, At::Start, wheels[0], Vector::ZERO, AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 60);
    for wheel in wheels {
        let spin = f64::from(world.bodies[wheel].angvel().x);
        println!("{spin} rad/s");
        assert!((spin * 1f64.exp() / 4.0 - 1.0).abs() < 1e-2, "{spin} rad/s");
    }
}

/// A wheel of 0.004 kg m^2, in the middle of which a rope ends, is braked by a motor without a joint, of 0.004 N m s: after a second it has 1/e of
/// its speed.
///
/// Reference: w' = -w, within 1 %.
#[test]
fn a_motor_brakes_a_wheel_that_stays_where_it_is() {
    let mut world = weightless();
    let post = world.insert_body(RigidBodyBuilder::fixed());
    let wheel = RigidBodyBuilder::dynamic().angvel(Vector::new(0.02, 0.0, 0.0));
    let (wheel, _) = world.insert(wheel, ColliderBuilder::ball(0.1).mass(1.0));
    let brake = GenericJointBuilder::new(JointAxesMask::empty()).motor_model(JointAxis::AngX, MotorModel::ForceBased);
    world.insert_impulse_joint(post, wheel, brake.motor_velocity(JointAxis::AngX, 0.0, 0.004));
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [0.0, 2.0, 0.0], soft()).gravity(Vector3::zeros()).build().unwrap());
    set.attach(&world, rope, At::Start, wheel, Vector::ZERO, AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 60);
    let spin = f64::from(world.bodies[wheel].angvel().x);
    println!("{spin} rad/s");
    assert!((spin * 1f64.exp() / 0.02 - 1.0).abs() < 1e-2, "{spin} rad/s");
}

/// A slender bar of 5 kg and 1 m on an impulse joint at its end falls from the level, with a rope
/// of 0.1 kg pinned or clamped to its tip that leads out of the plane: what the joint holds must
/// not spin the bar about its own axis, which would hold it up as a gyroscope.
///
/// Reference: a rod that is released level hangs straight down after K(1/2) sqrt(2 l/(3 g)) =
/// 0.483 s; with the rope as a point at its tip after 0.488 s. Bound: two host steps, and 1 % of the
/// height, of which a host step there is 0.1 %.
#[test]
fn a_bar_on_a_joint_falls_with_the_rope_at_its_tip() {
    let section = Section::from_stiffness(2e5, 0.05, 0.1).unwrap();
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        for kind in [AttachmentKind::Ball, AttachmentKind::Clamp] {
            for is_hinge in [false, true] {
                let mut world = PhysicsWorld::new();
                let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.5, 0.0, 0.0)).can_sleep(false);
                let (bar, _) = world.insert(body, ColliderBuilder::cuboid(0.5, 0.03, 0.03).mass(5.0));
                let post = world.insert_body(RigidBodyBuilder::fixed());
                let at_end = Vector::new(-0.5, 0.0, 0.0);
                if is_hinge {
                    world.insert_impulse_joint(post, bar, RevoluteJointBuilder::new(Vector::Z).local_anchor2(at_end));
                } else {
                    world.insert_impulse_joint(post, bar, SphericalJointBuilder::new().local_anchor2(at_end));
                }
                let mut set = CableSet::new();
                set.settings.fidelity = fidelity;
                let rope = set.insert(cable([1.0, 0.0, 0.0], [1.8, 0.0, 0.6], section).build().unwrap());
                set.attach_here(&world, rope, At::Start, bar, kind).unwrap();
                let (mut lowest, mut at) = (0.0f64, 0);
                for step in 1..=36 {
                    set.step(&mut world).unwrap();
                    let y = f64::from(world.bodies[bar].translation().y);
                    (lowest, at) = if y < lowest { (y, step) } else { (lowest, at) };
                }
                let time = f64::from(at) / 60.0;
                let case = format!("{fidelity:?} {kind:?} hinge {is_hinge}: {lowest:.4} m at {time:.3} s");
                println!("{case}");
                assert!(lowest < -0.495 && (time - 0.488).abs() < 2.0 / 60.0, "{case}");
            }
        }
    }
}
