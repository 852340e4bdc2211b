//! Bodies in contact while a cable pulls: jams and friction.

use super::bench::{add_cube, cable, damping, gap, run, soft, steel, tension, weightless, wire};
use lariat_rapier::lariat_ancf::{At, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableSet, Pin};

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
    set.attach(&world, rope, At::Start, winch, Vector::ZERO, Pin::Ball).unwrap();
    set.attach(&world, rope, At::End, load, Vector::new(0.1, 0.0, 0.0), Pin::Ball).unwrap();
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
        set.attach(&world, rope, At::Start, winch, Vector::ZERO, Pin::Ball).unwrap();
        set.attach(&world, rope, At::End, load, Vector::new(0.1, 0.0, 0.0), Pin::Ball).unwrap();
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
