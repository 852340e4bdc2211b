//! Bodies in contact while a cable pulls: jams and friction.

use super::bench::{add_cube, cable, damping, gap, run, soft, steel, tension, v, weightless, wire};
use lariat_rapier::lariat_ancf::{At, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A cube behind two posts, 5 cm away; a winch pulls until the cable carries 5 kN, and stops.
fn jam(section: Section, mass: Real) {
    const PULL: f64 = 5e3;
    let mut world = weightless();
    for y in [-0.35, 0.35] {
        let post = RigidBodyBuilder::fixed().translation(Vector::new(-1.85, y, 0.0));
        world.insert(post, ColliderBuilder::cuboid(0.1, 0.3, 1.0));
    }
    let load = add_cube(&mut world, mass, 0.1, [-2.1, 0.0, 0.0]);
    // the winch near the origin, where single precision resolves what stretches steel
    let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [-2.0, 0.0, 0.0], section).integrator(damping()).gravity(Vector3::zeros());
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach(&world, rope, At::End, load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
    // the rope's, and that of Rapier's contacts, 15 mm for 5 kN on 1 kg
    let compliance = 2.0 / section.axial_stiffness + 3e-6 / f64::from(mass);
    let (mut widest, mut held) = (0.0f64, Vec::new());
    for k in 0..720 {
        // the winch makes up what is missing at a rate of 5/s, 5 cm/s at first, then stops
        let missing = (PULL - tension(&set, rope, 1.0)) * compliance;
        let speed = if k < 60 { 0.05 } else { (5.0 * missing).clamp(-0.05, 0.05) };
        let speed = if k < 600 { speed } else { 0.0 };
        world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
        set.step(&mut world).unwrap();
        if k >= 600 {
            widest = widest.max(gap(&set));
            held.push(tension(&set, rope, 1.0));
        }
    }
    let (low, high) = held.iter().fold((f64::MAX, f64::MIN), |a, x| (a.0.min(*x), a.1.max(*x)));
    let case = format!("EA {:.2e} N, {mass} kg: {low:.2} to {high:.2} N, gap {widest:.1e} m", section.axial_stiffness);
    println!("{case}");
    assert!(low > 0.98 * PULL && high < 1.02 * PULL, "{case}");
    assert!(high - low < 1e-3 * PULL && widest < 1e-6, "{case}");
    assert!(world.bodies[load].linvel().length() < 1e-4, "{case}, {}", world.bodies[load].linvel());
}

/// A light and a heavy cube jammed between posts; the winch stops at 5 kN: the tension stays, the pin is closed, and nothing
/// moves. A soft rope, a steel wire of 3 mm, a steel bar of 1 cm.
///
/// *Source.* Statics: the tension is what the winch was stopped at; 2 % for the contact to settle.
#[test]
fn a_jammed_cube_holds_what_the_winch_pulls() {
    for section in [soft(), wire(), steel()] {
        for mass in [1.0, 100.0] {
            jam(section, mass);
        }
    }
}

/// A cube of 20 kg on the ground, friction 0.5; the winch stretches the rope by one newton per frame. The cube holds until the pull
/// is mu m g, then slides at it.
///
/// *Source.* Coulomb: 98.10 N, within 2 %.
#[test]
fn a_cube_starts_to_slide_when_the_pull_is_friction_times_weight() {
    let grip = 0.5 * 20.0 * 9.81;
    for section in [soft(), wire()] {
        let mut world = PhysicsWorld::new();
        let ground = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.5, 0.0));
        world.insert(ground, ColliderBuilder::cuboid(20.0, 0.5, 5.0).friction(0.5));
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(-2.1, 0.1, 0.0));
        let (load, _) = world.insert(body, ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(20.0).friction(0.5));
        let winch = RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(0.0, 0.1, 0.0));
        let winch = world.insert_body(winch);
        let mut set = CableSet::new();
        let rope = cable([0.0, 0.1, 0.0], [-2.0, 0.1, 0.0], section).integrator(damping()).gravity(Vector3::zeros());
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::End, load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        run(&mut world, &mut set, 60);
        let from = world.bodies[load].translation().x;
        let speed = 60.0 * 2.0 / section.axial_stiffness;
        world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
        let (mut crept, mut peak) = (0.0, 0.0f64);
        for _ in 0..300 {
            set.step(&mut world).unwrap();
            peak = peak.max(tension(&set, rope, 1.9));
            if peak < 0.95 * grip {
                crept = f64::from(world.bodies[load].translation().x - from).abs();
            }
        }
        let slid = f64::from(world.bodies[load].translation().x - from);
        // a rope under mu m g takes up a third of what the winch pulled in, the cube the rest
        let wound = speed * 5.0;
        println!(
            "friction EA {:.1e}: peak {peak:.2} N, crept {crept:.1e} m, slid {slid:.1e} of {wound:.1e} m",
            section.axial_stiffness
        );
        assert!(peak > 0.98 * grip && peak < 1.02 * grip, "peak {peak} N of {grip}");
        assert!(crept < 0.05 * wound, "crept {crept:.1e} m of {wound:.1e}");
        assert!((slid / wound - 0.67).abs() < 0.1, "slid {slid:.1e} m of {wound:.1e}");
    }
}

/// A cube of 1 kg is drawn into its stop by a steel wire, slow enough for the wire to be slack, in host steps of 1/30 s: at no time is the
/// pin open by more than 0.3 mm. Looked at only when the host step begins, and only if the wire is taut, it opened by 2 mm.
///
/// *Source.* The contract of an attachment.
#[test]
fn a_pin_stays_closed_when_its_body_first_meets_another() {
    for iterations in [1, 4] {
        let mut world = weightless();
        world.integration_parameters.dt = 1.0 / 30.0;
        world.integration_parameters.num_solver_iterations = iterations;
        for y in [-0.35, 0.35] {
            let post = RigidBodyBuilder::fixed().translation(Vector::new(-1.85, y, 0.0));
            world.insert(post, ColliderBuilder::cuboid(0.1, 0.3, 1.0));
        }
        let load = add_cube(&mut world, 1.0, 0.1, [-2.1, 0.0, 0.0]);
        let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
        let mut set = CableSet::new();
        let rope = cable([0.0; 3], [-2.0, 0.0, 0.0], wire()).integrator(damping()).gravity(Vector3::zeros());
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::End, load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        let (mut widest, mut pulled) = (0.0f64, 0.0f64);
        for _ in 0..36 {
            world.bodies[winch].set_linvel(Vector::new(0.05, 0.0, 0.0), true);
            set.step(&mut world).unwrap();
            widest = widest.max(gap(&set));
            pulled = pulled.max(tension(&set, rope, 1.0));
        }
        println!("{iterations} iterations: gap {widest:.1e} m, pull {pulled:.0} N");
        assert!(pulled > 1e3, "it never met the stop: {pulled} N");
        assert!(widest < 3e-4, "{iterations} iterations: {widest:.1e} m");
    }
}

/// A light ball on a taut rope is whirled into another at 12 m/s, 10 cm in a Rapier step of 1/120 s, which no pair of Rapier's foretells: the
/// pin stays within 1 cm. Without looking ahead it opened by 10 cm.
///
/// *Source.* The contract of an attachment, at the speed of the blow.
#[test]
fn a_pin_holds_when_its_body_flies_into_another() {
    let mut world = weightless();
    world.integration_parameters.dt = 1.0 / 30.0;
    let ball = RigidBodyBuilder::dynamic().translation(Vector::new(1.0, 0.0, 0.0)).linvel(Vector::new(0.0, 12.0, 0.0));
    let (ball, _) = world.insert(ball, ColliderBuilder::ball(0.06).mass(0.1));
    let far = (0.9 * (1.0f64).sin(), 0.9 * (1.0f64).cos());
    let block = RigidBodyBuilder::dynamic().translation(Vector::new(far.1 as Real, far.0 as Real, 0.0));
    let (block, _) = world.insert(block, ColliderBuilder::ball(0.06).mass(10.0));
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [1.0, 0.0, 0.0], soft()).integrator(damping()).gravity(Vector3::zeros()).fix(At::Start);
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, ball, Vector::ZERO, AttachmentKind::Ball).unwrap();
    let mut widest = 0.0f64;
    for _ in 0..12 {
        set.step(&mut world).unwrap();
        widest = widest.max(gap(&set));
    }
    println!("gap {widest:.1e} m, the other at {:.2} m/s", world.bodies[block].linvel().length());
    assert!(world.bodies[block].linvel().length() > 0.05, "they never met");
    assert!(widest < 1e-2, "{widest:.1e} m");
}

/// Two balls whirl about each other on a taut wire, and strike a third: all momentum there was is there, in steps that do not resolve the
/// turning, so that the pull changes a ball's velocity within each.
///
/// *Source.* Conservation of momentum. 1.7e-3 kg m/s of each ball's 5 are gained; 0.9 where a ball that deviates keeps only a share of what the
/// pull changed its velocity by.
#[test]
fn a_blow_to_whirling_bodies_keeps_the_momentum() {
    let mut world = weightless();
    let mut add = |at: [Real; 3], speed: Real| {
        let ball = RigidBodyBuilder::dynamic().translation(Vector::from(at)).linvel(Vector::new(0.0, speed, 0.0));
        world.insert(ball, ColliderBuilder::ball(0.06).mass(1.0).restitution(0.5)).0
    };
    let ends = [add([0.5, 0.0, 0.0], 5.0), add([-0.5, 0.0, 0.0], -5.0)];
    add([0.3, 0.42, 0.0], 0.0);
    let mut set = CableSet::new();
    let rope = cable([-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], wire()).integrator(damping()).gravity(Vector3::zeros());
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, ends[0], Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach(&world, rope, At::Start, ends[1], Vector::ZERO, AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 1);
    let before = set.momentum(&world).unwrap().linear;
    let spin = v(world.bodies[ends[0]].linvel());
    run(&mut world, &mut set, 30);
    let gained = set.momentum(&world).unwrap().linear - before;
    println!("momentum gained {:.1e} kg m/s, {spin:?} to {:?}", gained.norm(), world.bodies[ends[0]].linvel());
    assert!(world.bodies.iter().any(|(h, b)| !ends.contains(&h) && b.linvel().length() > 0.1), "they never met");
    assert!(gained.norm() < 3e-3, "{:.1e} kg m/s", gained.norm());
}
