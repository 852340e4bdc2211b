//! Bodies in contact while a cable pulls: jams, friction, impacts.

use super::common::{
    add_cube, cable, gap, is_left_out_in_double, l_stable_integrator, run, soft, steel, tension, weightless, wire,
};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, CableBuilder, Damping, Drag, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet, Event};

/// A cube 5 cm behind two posts, on a rope to a winch that draws it against them.
struct Jam {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    winch: RigidBodyHandle,
    rope: CableHandle,
    hook: AttachmentHandle,
}

impl Jam {
    /// A cube of `mass` (kg), on `rope` from the origin to (-2, 0, 0).
    fn new(mass: Real, rope: CableBuilder) -> Self {
        let mut world = weightless();
        for y in [-0.35, 0.35] {
            let post = RigidBodyBuilder::fixed().translation(Vector::new(-1.85, y, 0.0));
            world.insert(post, ColliderBuilder::cuboid(0.1, 0.3, 1.0));
        }
        let load = add_cube(&mut world, mass, 0.1, [-2.1, 0.0, 0.0]);
        // the winch is near the origin, where single precision resolves the stretch of steel
        let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
        let mut set = CableSet::new();
        let rope = set.insert(rope.gravity(Vector3::zeros()).build().unwrap());
        set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let hook = set.attach(&world, rope, At::End, load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        Jam { world, set, load, winch, rope, hook }
    }

    /// Makes a host step in which the winch moves at `speed` (m/s).
    fn draw(&mut self, speed: f64) {
        self.world.bodies[self.winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
        self.set.step(&mut self.world).unwrap();
    }

    /// Returns the speed in m/s at which the winch closes the difference to `pull` (N) at a rate of 5/s, after 5 cm/s in the first 60 host steps.
    fn speed(&self, k: usize, pull: f64, compliance: f64) -> f64 {
        let missing = (pull - tension(&self.set, self.rope, 1.0)) * compliance;
        if k < 60 { 0.05 } else { (5.0 * missing).clamp(-0.05, 0.05) }
    }
}

/// Returns the rope of a jam.
fn rope(section: Section) -> CableBuilder {
    cable([0.0; 3], [-2.0, 0.0, 0.0], section)
}

/// A winch draws a cube against its posts until the rope carries 5 kN, and stops.
fn jam(section: Section, mass: Real) {
    const PULL: f64 = 5e3;
    let mut jam = Jam::new(mass, rope(section).integrator(l_stable_integrator()));
    // of the rope and of Rapier's contact, 15 mm for 5 kN on 1 kg
    let compliance = 2.0 / section.axial_stiffness + 3e-6 / f64::from(mass);
    let (mut widest, mut held) = (0.0f64, Vec::new());
    for k in 0..720 {
        jam.draw(if k < 600 { jam.speed(k, PULL, compliance) } else { 0.0 });
        if k >= 600 {
            widest = widest.max(gap(&jam.set));
            held.push(tension(&jam.set, jam.rope, 1.0));
        }
    }
    let (low, high) = held.iter().fold((f64::MAX, f64::MIN), |a, x| (a.0.min(*x), a.1.max(*x)));
    let case = format!("EA {:.2e} N, {mass} kg: {low:.2} to {high:.2} N, gap {widest:.1e} m", section.axial_stiffness);
    println!("{case}");
    // a body of 1 kg vibrates faster on the bar than 32 Rapier steps resolve
    let within = if section.axial_stiffness > 1e7 && mass < 10.0 { 2e-3 } else { 1e-3 };
    assert!(low > (1.0 - within) * PULL && high < (1.0 + within) * PULL, "{case}");
    assert!(high - low < 1e-3 * PULL && widest < 1e-6, "{case}");
    let speed = jam.world.bodies[jam.load].linvel();
    assert!(speed.length() < 1e-4, "{case}, {speed}");
}

/// A light and a heavy cube jammed between posts, on a soft rope, a steel wire of 3 mm and a steel
/// bar of 1 cm: the tension is constant, the gap closed, and nothing moves.
///
/// Reference: statics: the tension at which the winch stopped, within 0.1 %, of the light cube on the bar 0.2 %.
#[test]
fn a_jammed_cube_holds_the_tension_at_which_the_winch_stopped() {
    for section in [soft(), wire(), steel()] {
        for mass in [1.0, 100.0] {
            jam(section, mass);
        }
    }
}

/// A cube of 1 kg that a damped wire of 3 mm jams at 1 kN, with twice and with 20 times the critical damping of its first mode: what is read
/// at the cube is right to 0.1 %, the tension along the wire to what the motors carry of the load.
///
/// Reference: statics: the tension at which the winch stopped.
#[test]
fn a_damped_wire_jams_a_cube() {
    for (fidelity, damping, within) in [
        (Fidelity::Game, 1e-3, 2e-3),
        (Fidelity::Engineering, 1e-3, 1e-3),
        (Fidelity::Game, 1e-2, 1.2e-2),
        (Fidelity::Engineering, 1e-2, 1e-3),
    ] {
        let damping = Damping { axial: damping, bending: 1e-3 };
        let mut jam = Jam::new(1.0, rope(wire()).fidelity(fidelity).elements(10).damping(damping));
        (0..300).for_each(|k| jam.draw(jam.speed(k, 1e3, 4.4e-6)));
        let read = jam.set.attachment(jam.hook).unwrap().force().x;
        let near = tension(&jam.set, jam.rope, 1.9);
        let case = format!("{fidelity:?}, {:.0e} s: read {read:.2} N, tension near it {near:.2} N", damping.axial);
        println!("{case}");
        assert!((read / 1e3 - 1.0).abs() < 1e-3 && (near / 1e3 - 1.0).abs() < within, "{case}");
    }
}

/// Cubes in series on wires of 2 m, the last one behind posts; a winch draws them to `pull` (N) in 8 s and stops. Returns the lowest and the highest
/// tension in the 4 s after, the largest speed in m/s along the wires then, and whether a wire was integrated with less accuracy than asked for.
fn series(masses: &[Real], section: Section, damping: f64, pull: f64) -> ([f64; 3], bool) {
    let (mut world, mut set) = (weightless(), CableSet::new());
    let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
    let (mut wires, mut last) = (Vec::new(), winch);
    for (i, mass) in masses.iter().enumerate() {
        let x = -2.2 * i as Real;
        let load = add_cube(&mut world, *mass, 0.1, [x - 2.1, 0.0, 0.0]);
        let wire = cable([f64::from(x), 0.0, 0.0], [f64::from(x) - 2.0, 0.0, 0.0], section).gravity(Vector3::zeros());
        let wire = wire.fidelity(Fidelity::Engineering).elements(10).damping(Damping { axial: damping, bending: 0.0 });
        let mut wire = wire.build().unwrap();
        // a wire buckles whenever its load runs ahead of it, and nothing else would damp how it swings across from then on
        wire.set_drag(Drag { diameter: Some(0.01), ..Drag::new(1000.0, 1.2, 0.0, Default::default()) }).unwrap();
        let wire = set.insert(wire);
        set.attach_here(&world, wire, At::Start, last, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, wire, At::End, load, AttachmentKind::Ball).unwrap();
        wires.push(wire);
        last = load;
    }
    for y in [-0.35, 0.35] {
        let x = 0.35 - 2.2 * masses.len() as Real;
        let post = RigidBodyBuilder::fixed().translation(Vector::new(x, y, 0.0));
        world.insert(post, ColliderBuilder::cuboid(0.1, 0.3, 1.0));
    }
    let compliance = 2.0 * masses.len() as f64 / section.axial_stiffness + 3e-6;
    let (mut seen, mut degraded) = ([f64::MAX, f64::MIN, 0.0], false);
    for k in 0..720 {
        let missing = (pull - tension(&set, wires[0], 1.0)) * compliance;
        let speed = if k < 60 { 0.05 } else { (5.0 * missing).clamp(-0.05, 0.05) };
        let speed = if k < 480 { speed } else { 0.0 };
        world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
        set.step(&mut world).unwrap();
        if k < 480 {
            continue;
        }
        degraded |= set.events().iter().any(|event| matches!(event, Event::Degraded { .. }));
        for &wire in &wires {
            let now = tension(&set, wire, 1.0);
            let nodes = set.get(wire).unwrap().velocities().as_chunks::<6>().0.iter();
            let fastest = nodes.fold(0.0f64, |most, v| most.max(v[0].abs()));
            seen = [seen[0].min(now), seen[1].max(now), seen[2].max(fastest)];
        }
    }
    (seen, degraded)
}

/// Undamped wires, light bodies of which 32 Rapier steps do not resolve the vibration, and a heavy rope: error control resolves waves of the cables
/// that grow by the corrections of Rapier's steps. Without the least damping of cables on bodies in contact 1 kg on an undamped wire reaches a speed of
/// 2 m/s along the wire; without the discrete gradient for light bodies 100 g and 50 g swing by half of the tension, damped or not.
///
/// Reference: statics: what the winch holds does not change when it stops.
#[test]
fn waves_between_jammed_bodies_do_not_grow_under_error_control() {
    if is_left_out_in_double() {
        return;
    }
    let rope = Section::round(0.003, 2e9, 1e5).unwrap();
    for (masses, section, damping, pull, told) in [
        (&[1.0][..], wire(), 0.0, 1e3, false),
        (&[1.0], wire(), 2e-4, 1e3, false),
        (&[1.0, 1.0], wire(), 0.0, 1e3, false),
        (&[0.1, 0.1], wire(), 0.0, 1e3, true),
        (&[0.1, 0.1], wire(), 1e-5, 1e3, true),
        (&[1.0, 0.05], wire(), 2e-4, 1e3, true),
        (&[0.1, 0.1, 0.1], wire(), 2e-4, 1e3, true),
        (&[0.2], wire(), 0.0, 300.0, true),
        (&[6.0], rope, 0.0, 200.0, false),
        (&[0.5], rope, 0.0, 200.0, false),
    ] {
        let ([low, high, speed], degraded) = series(masses, section, damping, pull);
        let case =
            format!("{masses:?} kg, {damping:.0e} s: {low:.2} to {high:.2} N, {speed:.1e} m/s, degraded {degraded}");
        println!("{case}");
        assert!(high - low < 1e-3 * pull && speed < 0.03 && degraded == told, "{case}");
    }
}

/// A cube of 20 kg on the ground, friction 0.5; a winch increases the tension by 1 N per frame. The
/// cube holds until the tension is mu m g, then slides.
///
/// Reference: Coulomb friction, 98.10 N; the pull grows by 1 N in each host step.
#[test]
fn a_cube_slides_when_the_pull_reaches_the_friction_limit() {
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
        let rope = cable([0.0, 0.1, 0.0], [-2.0, 0.1, 0.0], section)
            .integrator(l_stable_integrator())
            .gravity(Vector3::zeros());
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
        // the stretch of the rope under mu m g is a third of the winch's displacement, sliding the
        // rest
        let wound = speed * 5.0;
        println!(
            "friction EA {:.1e}: peak {peak:.2} N, crept {crept:.1e} m, slid {slid:.1e} of {wound:.1e} m",
            section.axial_stiffness
        );
        assert!(peak > 98.0 && peak < 99.5, "peak {peak} N of {grip}");
        assert!(crept < 0.05 * wound, "crept {crept:.1e} m of {wound:.1e}");
        assert!((slid / wound - 0.67).abs() < 0.1, "slid {slid:.1e} m of {wound:.1e}");
    }
}

/// A cube of 1 kg is drawn into its stop by a steel wire, so slowly that the wire is slack, in host
/// steps of 1/30 s: the gap stays below 0.3 mm. It opened by 2 mm when the number of Rapier steps
/// was chosen only once per host step, by cables that were taut already.
///
/// Reference: the contract of an attachment.
#[test]
fn the_gap_stays_closed_at_the_first_contact_of_a_body() {
    for iterations in [1, 4] {
        let mut jam = Jam::new(1.0, rope(wire()).integrator(l_stable_integrator()));
        jam.world.integration_parameters.dt = 1.0 / 30.0;
        jam.world.integration_parameters.num_solver_iterations = iterations;
        let (mut widest, mut pulled) = (0.0f64, 0.0f64);
        for _ in 0..36 {
            jam.draw(0.05);
            widest = widest.max(gap(&jam.set));
            pulled = pulled.max(tension(&jam.set, jam.rope, 1.0));
        }
        println!("{iterations} iterations: gap {widest:.1e} m, pull {pulled:.0} N");
        assert!(pulled > 1e3, "no contact with the stop: {pulled} N");
        assert!(widest < 3e-4, "{iterations} iterations: {widest:.1e} m");
    }
}

/// A light ball on a taut rope hits another at 12 m/s. It moves 10 cm in a Rapier step of 1/120 s,
/// so Rapier lists no pair before: the gap stays below 1 cm. It opened by 10 cm without a look at
/// the collisions to come.
///
/// Reference: the contract of an attachment, at the speed of the impact.
#[test]
fn the_gap_stays_closed_when_a_body_flies_into_another() {
    let mut world = weightless();
    world.integration_parameters.dt = 1.0 / 30.0;
    let ball = RigidBodyBuilder::dynamic().translation(Vector::new(1.0, 0.0, 0.0)).linvel(Vector::new(0.0, 12.0, 0.0));
    let (ball, _) = world.insert(ball, ColliderBuilder::ball(0.06).mass(0.1));
    let far = (0.9 * (1.0f64).sin(), 0.9 * (1.0f64).cos());
    let block = RigidBodyBuilder::dynamic().translation(Vector::new(far.1 as Real, far.0 as Real, 0.0));
    let (block, _) = world.insert(block, ColliderBuilder::ball(0.06).mass(10.0));
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [1.0, 0.0, 0.0], soft())
        .integrator(l_stable_integrator())
        .gravity(Vector3::zeros())
        .fix(At::Start);
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, ball, Vector::ZERO, AttachmentKind::Ball).unwrap();
    let mut widest = 0.0f64;
    for _ in 0..12 {
        set.step(&mut world).unwrap();
        widest = widest.max(gap(&set));
    }
    println!("gap {widest:.1e} m, the other at {:.2} m/s", world.bodies[block].linvel().length());
    assert!(world.bodies[block].linvel().length() > 0.05, "they never collided");
    assert!(widest < 1e-2, "{widest:.1e} m");
}

/// Two balls rotate about each other on a taut wire and hit a third. The steps do not resolve the
/// rotation, so the tension changes the velocity of a ball within each.
///
/// Reference: conservation of momentum. The error is 1.7e-3 kg m/s of the 5 of each ball; it was
/// 0.9 when a ball that deviated kept only a share of the velocity change by the tension.
#[test]
fn an_impact_conserves_the_momentum_of_rotating_bodies() {
    let mut world = weightless();
    let mut add = |at: [Real; 3], speed: Real| {
        let ball = RigidBodyBuilder::dynamic().translation(Vector::from(at)).linvel(Vector::new(0.0, speed, 0.0));
        world.insert(ball, ColliderBuilder::ball(0.06).mass(1.0).restitution(0.5)).0
    };
    let ends = [add([0.5, 0.0, 0.0], 5.0), add([-0.5, 0.0, 0.0], -5.0)];
    add([0.3, 0.42, 0.0], 0.0);
    let mut set = CableSet::new();
    let rope =
        cable([-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], wire()).integrator(l_stable_integrator()).gravity(Vector3::zeros());
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, ends[0], Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach(&world, rope, At::Start, ends[1], Vector::ZERO, AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 1);
    let before = set.momentum(&world).unwrap().linear;
    let spin = vector(world.bodies[ends[0]].linvel());
    run(&mut world, &mut set, 30);
    let gained = set.momentum(&world).unwrap().linear - before;
    println!("momentum gained {:.1e} kg m/s, {spin:?} to {:?}", gained.norm(), world.bodies[ends[0]].linvel());
    assert!(world.bodies.iter().any(|(h, b)| !ends.contains(&h) && b.linvel().length() > 0.1), "they never collided");
    assert!(gained.norm() < 3e-3, "{:.1e} kg m/s", gained.norm());
}
