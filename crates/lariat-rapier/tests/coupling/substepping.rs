//! The number of Rapier steps per host step, and of solver iterations.

use super::common::{add_cube, cable, gap, l_stable_integrator, run, soft, tension, weightless, wire};
use lariat_ancf::coupling::Coupling;
use lariat_rapier::lariat_ancf::{At, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet, Rope};

/// A cube of `mass` wedged between posts is pulled to 5 kN and held. Returns the lowest and highest
/// tension, and the largest gap.
fn jam(section: Section, mass: Real, steps: (u32, u32), iterations: usize, dt: Real) -> (f64, f64, f64) {
    let mut world = weightless();
    world.integration_parameters.dt = dt;
    world.integration_parameters.num_solver_iterations = iterations;
    for y in [-0.35, 0.35] {
        let post = RigidBodyBuilder::fixed().translation(Vector::new(-1.85, y, 0.0));
        world.insert(post, ColliderBuilder::cuboid(0.1, 0.3, 1.0));
    }
    let load = add_cube(&mut world, mass, 0.1, [-2.1, 0.0, 0.0]);
    let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
    let mut set = CableSet::new();
    (set.settings.rapier_steps, set.settings.max_rapier_steps) = steps;
    let rope = cable([0.0; 3], [-2.0, 0.0, 0.0], section).integrator(l_stable_integrator()).gravity(Vector3::zeros());
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach(&world, rope, At::End, load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
    let compliance = 2.0 / section.axial_stiffness + 3e-6 / f64::from(mass);
    let (mut low, mut high, mut widest) = (f64::MAX, f64::MIN, 0.0f64);
    for k in 0..720 {
        let missing = (5e3 - tension(&set, rope, 1.0)) * compliance;
        let speed = if k < 60 { 0.05 } else { (5.0 * missing).clamp(-0.05, 0.05) };
        let speed = if k < 600 { speed } else { 0.0 };
        world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
        set.step(&mut world).unwrap();
        if k >= 600 {
            let now = tension(&set, rope, 1.0);
            (low, high, widest) = (low.min(now), high.max(now), widest.max(gap(&set)));
        }
    }
    (low, high, widest)
}

/// Jams at 5 kN with one Rapier step per host step, and with one solver iteration in each of four:
/// the tension is steady within 2 %, the gap below 1e-3 m.
///
/// Reference: statics.
#[test]
fn a_jam_holds_with_one_rapier_step_or_one_solver_iteration() {
    for section in [soft(), wire()] {
        for mass in [1.0, 100.0] {
            for (steps, iterations) in [(1, 4), (4, 1)] {
                let (low, high, widest) = jam(section, mass, (steps, steps), iterations, 1.0 / 60.0);
                let case = format!(
                    "EA {:.1e} N, {mass} kg, {steps} steps of {iterations}: {low:.1} to {high:.1} N, gap {widest:.1e} m",
                    section.axial_stiffness
                );
                println!("{case}");
                assert!(low > 0.98 * 5e3 && high < 1.02 * 5e3 && widest < 1e-3, "{case}");
            }
        }
    }
}

/// A body of 1 kg on a steel wire oscillates at 134 Hz. Four Rapier steps in a host step of 1/30 s
/// do not resolve it, so more are taken. With one step and one solver iteration it escapes.
///
/// Reference: statics.
#[test]
fn a_host_step_is_split_finely_enough_for_a_light_body() {
    for iterations in [1, 4] {
        let (low, high, widest) = jam(wire(), 1.0, (4, 32), iterations, 1.0 / 30.0);
        let case = format!("{iterations} iterations: {low:.1} to {high:.1} N, gap {widest:.1e} m");
        println!("{case}");
        assert!(low > 0.98 * 5e3 && high < 1.02 * 5e3 && widest < 1e-4, "{case}");
    }
    let (low, high, widest) = jam(wire(), 1.0, (1, 1), 1, 1.0 / 30.0);
    println!("unsplit: {low:.1} to {high:.1} N, gap {widest:.1e} m");
    assert!(low < 0.98 * 5e3 || high > 1.02 * 5e3 || widest > 1e-3, "{low} {high} {widest}");
}

/// A cube of 1 kg lies on the ground. On a straight steel rope of 3 mm and 1 m it would vibrate within a host step of 1/60 s, which is
/// therefore split; on one that sags by its slack it cannot, and takes one Rapier step.
///
/// Reference: h w/0.6 = 18 of the straight rope; the sagging one carries its weight of 0.3 N, and F/(2 (L - c)) = 3 N/m.
#[test]
fn a_slack_cable_does_not_split_the_host_step() {
    for (slack, expected) in [(0.0, 18), (0.05, 1)] {
        let mut world = PhysicsWorld::new();
        world.insert(
            RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.6, 0.0)),
            ColliderBuilder::cuboid(5.0, 0.5, 5.0),
        );
        let load = add_cube(&mut world, 1.0, 0.1, [0.0; 3]);
        world.bodies[load].activation_mut().normalized_linear_threshold = -1.0;
        let mut set = CableSet::new();
        set.settings.sleep_speed = 0.0;
        let rope = Rope::steel(0.003).slack(slack);
        set.add_rope(&world, [0.0, 1.1, 0.0], (load, [0.0, 0.1, 0.0]), rope).unwrap();
        run(&mut world, &mut set, 60);
        let (mut host, mut steps) = (set.begin(&mut world).unwrap(), 0);
        while host.is_unfinished() {
            set.predict_next(&mut world, &mut host).unwrap();
            world.step();
            set.reconcile(&mut world);
            steps += 1;
        }
        set.finish(&mut world, host).unwrap();
        println!("slack {slack}: {steps} Rapier steps");
        assert_eq!(steps, expected);
    }
}

/// A plank of 2 kg on two taut ropes bears a box of 50 kg. Along the ropes it vibrates at 160 Hz, which asks for 28 Rapier steps where friction
/// may push it so; the box pushes it down, where it is as soft as T/l. The ends carry the weight in any case.
///
/// *Source.* h w/0.6 with w^2 = 4 EA/(l m) and, with elements of 0.2 m at 2 kN, 4 T/(0.2 m); statics.
#[test]
fn a_plank_is_stepped_finely_only_where_it_is_pushed_along_its_ropes() {
    for (friction, few, most) in [(0.0, 1, 6), (0.5, 28, 30)] {
        let mut world = PhysicsWorld::new();
        let bank = world.insert_body(RigidBodyBuilder::fixed());
        let mut set = CableSet::new();
        set.settings.sleep_speed = 0.0;
        let slippery = |c: ColliderBuilder| c.friction(friction).friction_combine_rule(CoefficientCombineRule::Min);
        let (plank, _) =
            world.insert(RigidBodyBuilder::dynamic(), slippery(ColliderBuilder::cuboid(0.2, 0.02, 0.6).mass(2.0)));
        let mut ends = Vec::new();
        for z in [-0.5, 0.5] {
            let section = Section::from_stiffness(1e6, 0.1, 0.2).unwrap();
            let rope = cable([-2.0, 0.0, z], [2.0, 0.0, z], section).elements(20).length(4.0 * (1.0 - 2e-3));
            let rope = set.insert(rope.build().unwrap());
            set.attach(&world, rope, At::Node(10), plank, Vector::new(0.0, 0.0, z as Real), AttachmentKind::Ball)
                .unwrap();
            for end in [At::Start, At::End] {
                ends.push(set.attach_here(&world, rope, end, bank, AttachmentKind::Ball).unwrap());
            }
        }
        let weight = (50.0 + 2.0 + 2.0 * 4.0 * (1.0 - 2e-3) * 0.2) * 9.81;
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.122, 0.0)).linear_damping(1.0);
        world.insert(body, slippery(ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0)));
        world.bodies[plank].set_linear_damping(1.0);
        let (mut lift, mut steps) = (0.0, 0);
        for k in 0..360 {
            let mut host = set.begin(&mut world).unwrap();
            while host.is_unfinished() {
                set.predict_next(&mut world, &mut host).unwrap();
                world.step();
                set.reconcile(&mut world);
                steps += u32::from(k >= 240);
            }
            set.finish(&mut world, host).unwrap();
            if k >= 240 {
                lift -= ends.iter().map(|end| set.attachment(*end).unwrap().force().y).sum::<f64>() / 120.0;
            }
        }
        let steps = f64::from(steps) / 120.0;
        println!("friction {friction}: {steps} Rapier steps in a host step, the ends carry {lift:.2} N of {weight:.2}");
        assert!(steps >= f64::from(few) && steps <= f64::from(most), "{steps}");
        // the box still bobs by some mm
        assert!((lift / weight - 1.0).abs() < 5e-3, "{lift} N of {weight}");
    }
}

/// A bar on a hinge, a light thread at its tip, spins freely for two turns, in host steps of 1/30 s with one solver iteration.
///
/// Reference: conservation of the angular momentum about the hinge; the thread has 1e-5 of the mass of the bar. Rapier's joints may take 0.005 of it
/// per radian. In four Rapier steps at any speed it lost 10 % at 3 rad/s and 25 % at 10 rad/s.
#[test]
fn a_bar_on_a_hinge_keeps_its_spin() {
    for spin in [3.0, 10.0] {
        let mut world = weightless();
        world.integration_parameters.num_solver_iterations = 1;
        world.integration_parameters.dt = 1.0 / 30.0;
        let post = world.insert_body(RigidBodyBuilder::fixed());
        let bar = RigidBodyBuilder::dynamic().translation(Vector::new(0.5, 0.0, 0.0));
        let bar = bar.linvel(Vector::new(0.0, 0.5 * spin as Real, 0.0)).angvel(Vector::new(0.0, 0.0, spin as Real));
        let (bar, _) = world.insert(bar, ColliderBuilder::cuboid(0.5, 0.02, 0.02).mass(10.0));
        let hinge = RevoluteJointBuilder::new(Vector::Z).local_anchor2(Vector::new(-0.5, 0.0, 0.0));
        world.insert_impulse_joint(post, bar, hinge);
        let mut set = CableSet::new();
        let thread = Section::from_stiffness(1e3, 1e-5, 2e-4).unwrap();
        let thread = cable([1.0, 0.0, 0.0], [1.5, 0.0, 0.0], thread).gravity(Vector3::zeros()).elements(4);
        let thread = set.insert(thread.build().unwrap());
        set.get_mut(thread).unwrap().set_rigid_motion(Vector3::y() * spin, Vector3::z() * spin).unwrap();
        set.attach_here(&world, thread, At::Start, bar, AttachmentKind::Ball).unwrap();
        run(&mut world, &mut set, (4.0 * std::f64::consts::PI / spin * 30.0) as usize);
        let kept = f64::from(world.bodies[bar].angvel().z) / spin;
        println!("{spin} rad/s: {kept:.4} kept");
        assert!(kept > 1.0 - 0.005 * 4.0 * std::f64::consts::PI && kept < 1.0, "{spin} rad/s: {kept:.4}");
    }
}
