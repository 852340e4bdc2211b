//! The energy balance of cables on dynamic bodies: closed with error control, whatever Rapier and the user do to the bodies; what integration makes or
//! takes is told.

use super::common::{add_cube, cable, run, soft, weightless};
use lariat_rapier::lariat_ancf::warning::EnergyBalance;
use lariat_rapier::lariat_ancf::{
    At, Contact, Fidelity, Integrator, Method, Reel, Section, StepControl, Vector3, Warning as CableWarning,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

/// Returns the balance of the first cable of a set that has one, and the largest share that any made and lost.
fn balance(set: &CableSet, case: &str) -> (f64, f64) {
    let all: Vec<EnergyBalance> = set.iter().filter_map(|(_, cable)| cable.energy_balance()).collect();
    let (made, lost) = all.iter().fold((0.0f64, 0.0f64), |most, b| (most.0.max(b.made()), most.1.max(b.lost())));
    println!("{case}: made {made:.1e}, lost {lost:.1e}, {:?}", all[0]);
    assert!(all.iter().any(|b| b.scale_j > 0.0), "{case}: no balance");
    (made, lost)
}

fn controlled() -> Integrator {
    Integrator::tolerance(Method::Esdirk4, 1e-6).unwrap()
}

fn ball(world: &mut PhysicsWorld, mass: Real, at: [Real; 3]) -> RigidBodyHandle {
    let body = RigidBodyBuilder::dynamic().translation(Vector::from(at));
    world.insert(body, ColliderBuilder::ball(0.1).mass(mass)).0
}

/// Returns a world with a rope of 2 m that hangs aslant from a point, with a box at its end.
fn swing(mass: Real, integrator: impl Into<Fidelity>) -> (PhysicsWorld, CableSet, CableHandle, RigidBodyHandle) {
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    let rope = cable([0.0; 3], [1.2, -1.6, 0.0], soft()).elements(12).integrator(integrator).fix(At::Start);
    let rope = set.insert(rope.build().unwrap());
    let load = add_cube(&mut world, mass, 0.1, [1.2, -1.7, 0.0]);
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    (world, set, rope, load)
}

/// A load swings; the user pushes it, puts it elsewhere and takes it off and on again; a floor stops it, and friction brakes it.
///
/// *Source.* The work-energy theorem.
#[test]
fn the_balance_of_a_load_closes_whatever_moves_it() {
    for (what, mass) in [
        ("swings", 0.7),
        ("swings", 30.0),
        ("is pushed", 3.0),
        ("is struck", 3.0),
        ("falls on a floor", 8.0),
        ("falls on a floor", 1.5),
        ("falls on a floor", 60.0),
        ("is damped", 5.0),
        ("is detached", 4.0),
        ("turns", 6.0),
    ] {
        let (mut world, mut set, rope, load) = swing(mass, controlled());
        match what {
            "falls on a floor" => {
                world.insert_collider(
                    ColliderBuilder::cuboid(5.0, 0.1, 5.0).translation(Vector::new(0.0, -2.0, 0.0)),
                    None,
                );
            }
            "is damped" => world.bodies[load].set_linear_damping(0.8),
            "turns" => world.bodies[load].set_angvel(Vector::new(3.0, 5.0, -2.0), true),
            _ => {}
        }
        for step in 0..90 {
            match (what, step) {
                ("is pushed", _) => {
                    world.bodies[load].reset_forces(true);
                    world.bodies[load].add_force(Vector::new(3.0 * mass, 0.0, 2.0 * mass), true);
                }
                ("is struck", 20 | 50) => world.bodies[load].apply_impulse(Vector::new(mass, mass, 0.0), true),
                ("is detached", 40) => {
                    let handle = set.attachments().next().unwrap().0;
                    set.detach(&mut world, handle).unwrap();
                }
                ("is detached", 50) => {
                    let at = to_vector(&set.get(rope).unwrap().sample(2.0).unwrap().position);
                    let body = RigidBodyBuilder::dynamic().translation(at);
                    let other = world.insert(body, ColliderBuilder::ball(0.05).mass(mass)).0;
                    set.attach(&world, rope, At::End, other, Vector::ZERO, AttachmentKind::Ball).unwrap();
                }
                _ => {}
            }
            run(&mut world, &mut set, 1);
        }
        // what the floor does is known to the first order of the step
        let most = if what == "falls on a floor" { 1e-3 } else { 1e-4 };
        let (made, lost) = balance(&set, &format!("{mass} kg that {what}"));
        assert!(made < 0.5 * most && lost < most, "{what}");
    }
}

/// A load swings on a rope for 1.5 s: the work that is read at its attachment is what it gained.
///
/// *Source.* The work-energy theorem.
#[test]
fn the_work_at_an_attachment_is_what_its_body_gained() {
    for mass in [0.7, 30.0] {
        for integrator in
            [controlled(), Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) }]
        {
            let (mut world, mut set, _, load) = swing(mass, integrator);
            let energy = |world: &PhysicsWorld| {
                let body = &world.bodies[load];
                f64::from(body.kinetic_energy()) + f64::from(mass * body.center_of_mass().y) * 9.81
            };
            let (before, mut most, mut size) = (energy(&world), 0.0f64, 0.0f64);
            let hook = set.attachments().next().unwrap().0;
            for _ in 0..90 {
                run(&mut world, &mut set, 1);
                let gained = energy(&world) - before;
                most = most.max((set.attachment(hook).unwrap().work() - gained).abs());
                size = size.max(f64::from(world.bodies[load].kinetic_energy()));
            }
            println!("{mass} kg, {:?}: off by {most:.1e} J, kinetic energy {size:.1} J", integrator.method);
            assert!(most < 5e-4 * size, "{mass} kg, {:?}: off by {most:.1e} J of {size:.1}", integrator.method);
        }
    }
}

fn to_vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x as Real, v.y as Real, v.z as Real)
}

/// Two balls on a cable, one of which the user kicks along it and aside, beside one another and as four on three cables.
///
/// *Source.* The work-energy theorem.
#[test]
fn the_balance_of_kicked_bodies_closes() {
    for (count, kick, stiffness) in [(2, [1.0, 0.5, 0.2], 7e4), (2, [0.0, 2.0, 0.0], 1e4), (4, [-1.0, 1.0, 0.3], 3e4)] {
        let (mut world, mut set) = (weightless(), CableSet::new());
        let balls: Vec<_> =
            (0..count).map(|k| ball(&mut world, 0.6 + 0.7 * k as Real, [2.0 * k as Real, 0.0, 0.0])).collect();
        for k in 1..count {
            let x = 2.0 * k as f64;
            let section = Section::from_stiffness(stiffness, 1e-6 * stiffness, 0.05).unwrap();
            let tie = cable([x - 1.9, 0.0, 0.0], [x - 0.1, 0.0, 0.0], section).elements(8).gravity(Vector3::zeros());
            let tie = set.insert(tie.integrator(controlled()).build().unwrap());
            for (at, body, side) in [(At::Start, balls[k - 1], 0.1), (At::End, balls[k], -0.1)] {
                set.attach(&world, tie, at, body, Vector::new(side, 0.0, 0.0), AttachmentKind::Ball).unwrap();
            }
        }
        run(&mut world, &mut set, 3);
        world.bodies[balls[count - 1]].apply_impulse(Vector::from(kick), true);
        run(&mut world, &mut set, 30);
        let (made, lost) = balance(&set, &format!("{count} balls, {kick:?} N s, EA {stiffness:.0e} N"));
        // of the vibration along the cables the tolerance takes some
        assert!(made < 1e-4 && lost < 1e-3);
    }
}

/// Two balls on a taut cable of which the user kicks one. Fidelity game takes what vibrates faster than its steps: the balance knows how much, and it is told
/// where it is more than a hundredth; short steps and error control take less.
///
/// *Source.* The energy of cable and bodies, on which nothing acts.
#[test]
fn what_the_steps_of_a_game_take_of_a_kick_is_told() {
    let mut most = 0.0f64;
    for (masses, stiffness, kick) in [
        ([3.37, 0.51], 7.1e4, [0.3, -0.247, 0.204]),
        ([1.22, 7.29], 8.8e4, [13.5, -0.787, 2.916]),
        ([2.0, 2.0], 3e5, [-4.0, 1.0, 0.0]),
        ([0.8, 5.0], 2e4, [6.0, 0.0, -2.0]),
    ] {
        for rate in [60, 960] {
            let (mut world, mut set) = (weightless(), CableSet::new());
            world.integration_parameters.dt = 1.0 / rate as Real;
            let balls = [ball(&mut world, masses[0], [-1.0, 0.0, 0.0]), ball(&mut world, masses[1], [1.0, 0.0, 0.0])];
            let mass = 0.02 * f64::from(masses[0].min(masses[1]));
            let section = Section::from_stiffness(stiffness, 1e-8 * stiffness, mass).unwrap();
            let tie = cable([-0.9, 0.0, 0.0], [0.9, 0.0, 0.0], section).gravity(Vector3::zeros());
            let tie = set.insert(tie.integrator(Fidelity::Game).build().unwrap());
            set.attach(&world, tie, At::Start, balls[0], Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
            set.attach(&world, tie, At::End, balls[1], Vector::new(-0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
            world.bodies[balls[1]].apply_impulse(Vector::from(kick), true);
            let start = set.energy(&world).unwrap().total();
            run(&mut world, &mut set, rate / 2);
            let lost = (start - set.energy(&world).unwrap().total()) / start;
            let case = format!("{masses:?} kg, {rate} Hz");
            let (made, known) = balance(&set, &case);
            most = most.max(lost);
            let law = set.get(tie).unwrap().energy_law();
            println!("{case}: lost {lost:.4} of {start:.3} J, known {known:.4}, {:.4} J by rescaling", law.rescaled);
            let book = set.get(tie).unwrap().energy_balance().unwrap();
            let booked = (book.lost_j + book.dissipated_j) / start;
            // what the method holds in store is the square of a step
            let store = if rate == 60 { 4e-2 } else { 1e-2 };
            assert!(made < 1e-6 && (booked - lost).abs() < store, "{case}: {booked} {book:?}");
            let told = set.get(tie).unwrap().warnings().into_iter().find_map(|warning| match warning {
                CableWarning::EnergyLost { lost_j, .. } => Some(lost_j / start),
                _ => None,
            });
            assert_eq!(told.is_some(), known > 1e-2, "{case}: {told:?}");
        }
    }
    assert!(most > 0.05, "nothing was lost: {most}");
}

/// A load on a stiff, damped rope that is let go out of balance: the alpha method with the strongest damping overshoots in its first step and makes energy; error
/// control does not. In long steps it takes energy of a load that swings.
///
/// *Source.* The balance with error control.
#[test]
fn energy_that_integration_makes_or_takes_of_islands_is_told() {
    let warned = |set: &CableSet, rope| {
        let told = set.get(rope).unwrap().warnings();
        let made = told.iter().any(|w| matches!(w, CableWarning::EnergyMade { .. }));
        (made, told.iter().any(|w| matches!(w, CableWarning::EnergyLost { .. })))
    };
    let alpha =
        |step| Integrator { method: Method::GeneralisedAlpha { rho: 0.0 }, control: StepControl::MaxStep(step) };
    for (integrator, dt, due) in [(alpha(0.03), 0.03, true), (controlled(), 1.0 / 60.0, false)] {
        let (mut world, mut set, rope, _) = swing(2.0, integrator);
        world.integration_parameters.dt = dt;
        run(&mut world, &mut set, 90);
        balance(&set, "swing");
        assert_eq!(warned(&set, rope), (false, due));
    }
    for (integrator, due) in [(alpha(1.0 / 240.0), true), (controlled(), false)] {
        let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
        let section = Section::from_stiffness(2e7, 200.0, 8.0).unwrap();
        let damping = lariat_rapier::lariat_ancf::Damping { axial: 1e-2, bending: 1e-2 };
        // 0.2 % longer than its cable
        let rope = cable([0.0; 3], [2.004, 0.0, 0.0], section).length(2.0).elements(6).integrator(integrator);
        let rope = set.insert(rope.damping(damping).fix(At::Start).build().unwrap());
        let load = ball(&mut world, 20.0, [2.004, 0.0, 0.0]);
        set.attach(&world, rope, At::End, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
        run(&mut world, &mut set, 10);
        balance(&set, "stretched");
        assert_eq!(warned(&set, rope).0, due);
    }
}

/// Neither contact nor a winch keeps an island from being judged, where it has an energy law: a load swings on a rope that meets a bar, or is wound in there.
///
/// *Source.* The energy law of the discrete gradient: no energy is made.
#[test]
fn islands_with_contact_and_winches_are_judged_by_the_law() {
    for (mass, winds) in [(0.7, false), (30.0, false), (5.0, true), (0.9, true)] {
        let (mut world, mut set, rope, _) = swing(mass, Fidelity::Game);
        world.insert_collider(ColliderBuilder::cuboid(0.05, 0.05, 0.5).translation(Vector::new(0.0, -0.8, 0.0)), None);
        set.set_contact(rope, Contact::with_friction(0.3).with_radius(5e-3)).unwrap();
        if winds {
            set.get_mut(rope)
                .unwrap()
                .add_reel(At::Start, Reel { rate: vec![[0.0, -0.2]], ..Reel::default() })
                .unwrap();
        }
        let mut touched = false;
        for _ in 0..150 {
            run(&mut world, &mut set, 1);
            touched |= set.get(rope).unwrap().contacts().next().is_some();
        }
        let (made, _) = balance(&set, &format!("{mass} kg, winds: {winds}"));
        let book = set.get(rope).unwrap().energy_balance().unwrap();
        assert!(touched && made < 1e-6 && book.scale_j > 0.1 * f64::from(mass), "{book:?}");
        assert!((book.dissipated_j > 0.0) && set.get(rope).unwrap().energy_law().contacts > 0.0, "{book:?}");
    }
}
