//! Sheaves in a world.

use super::common::{add_cube, cable, run};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Error as Mechanics, Section};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Error, SheaveOptions};

const G: f64 = 9.81;

fn section() -> Section {
    Section::from_stiffness(1e5, 1e-3, 0.005).unwrap()
}

/// Adds a rope between points of bodies, given by the body, its anchor and the point.
fn rope(set: &mut CableSet, world: &PhysicsWorld, ends: [(RigidBodyHandle, Vector, [Real; 3]); 2]) -> CableHandle {
    let rope = cable(ends[0].2.map(f64::from), ends[1].2.map(f64::from), section());
    let rope = set.insert(rope.elements(6).damping(Damping { axial: 5e-3, bending: 5e-3 }).build().unwrap());
    for (at, (body, anchor, _)) in [At::Start, At::End].into_iter().zip(ends) {
        set.attach(world, rope, at, body, anchor, AttachmentKind::Ball).unwrap();
    }
    rope
}

/// Two crates on one rope over a fixed or kinematic block, without and with friction: both move as the equation says. Detaching an end from
/// the block ends the sheave, and cutting the rope does not.
///
/// *Source.* `(m_1 + m_2) a = (m_2 - m_1) g`, and with the capstan `(m_2 + k m_1) a = (m_2 - k m_1) g`, k = exp(mu pi).
#[test]
fn crates_on_a_rope_over_a_block_move_as_their_equation_says() {
    for (kinematic, friction) in [(false, 0.0), (false, 0.1), (true, 0.1)] {
        let mut world = PhysicsWorld::new();
        let block = if kinematic { RigidBodyBuilder::kinematic_velocity_based() } else { RigidBodyBuilder::fixed() };
        let block = world.insert_body(block);
        let crates = [(10.0, -3.0), (17.0, -1.0)].map(|(mass, y)| add_cube(&mut world, mass, 0.1, [0.0, y - 0.1, 0.0]));
        let mut set = CableSet::new();
        let top = (block, Vector::ZERO, [0.0; 3]);
        let hook = |i: usize, y: Real| (crates[i], Vector::new(0.0, 0.1, 0.0), [0.0, y, 0.0]);
        let ropes = [[hook(0, -3.0), top], [top, hook(1, -1.0)]].map(|ends| rope(&mut set, &world, ends));
        let options = SheaveOptions { friction, ..SheaveOptions::default() };
        let sheave = set.add_sheave((ropes[0], At::End), (ropes[1], At::Start), options).unwrap();
        run(&mut world, &mut set, 15);
        let speeds = |world: &PhysicsWorld| crates.map(|c| f64::from(world.bodies[c].linvel().y));
        let before = speeds(&world);
        run(&mut world, &mut set, 24);
        let after = speeds(&world);
        let k = (friction * std::f64::consts::PI).exp();
        let expected = (17.0 - k * 10.0) / (17.0 + k * 10.0) * G * 24.0 / 60.0;
        let gained = [after[0] - before[0], before[1] - after[1]].map(|gained| gained / expected);
        let state = set.sheave(sheave).unwrap();
        println!("{gained:?} of the speed, {state:?}");
        assert!(gained.iter().all(|gained| (gained - 1.0).abs() < 0.01), "{gained:?}");
        assert!((state.lost() > 1e-3) == (friction > 0.0) && state.passed() > 0.1, "{state:?}");
        // a cut of the falling side leaves the sheave to the part at it
        let rest = set.cut(ropes[1], 0.7).unwrap();
        assert_eq!(set.sheave(sheave).unwrap().ends()[1].0, ropes[1]);
        assert!(set.get(rest).unwrap().reel(At::Start).is_none());
        let held =
            set.attachments().find(|(_, a)| a.cable() == ropes[0] && a.body() == block).map(|(handle, _)| handle);
        set.detach(&mut world, held.unwrap()).unwrap();
        assert_eq!(set.sheave(sheave).unwrap_err(), Error::NoSheave(sheave));
        assert!(set.get(ropes[1]).unwrap().reel(At::Start).is_none());
        run(&mut world, &mut set, 3);
    }
}

/// One rope over three eyes, put along it one after the other, moves two crates as their equation says, is counted along all of its parts, and carries an attachment with its material;
/// what cannot be is refused and changes nothing.
///
/// *Source.* `m_1 v_1' + m_2 v_2' = (m_2 - m_1) g`; lengths of parts sum to that of the rope.
#[test]
fn one_rope_runs_over_sheaves_along_it() {
    let mut world = PhysicsWorld::new();
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    let crates = [(10.0, 0.0, -3.0), (17.0, 3.0, -1.0)]
        .map(|(mass, x, y): (Real, Real, Real)| add_cube(&mut world, mass, 0.1, [x, y - 0.1, 0.0]));
    let mut set = CableSet::new();
    let corners = [[0.0, -3.0, 0.0], [0.0; 3], [1.5, 0.5, 0.0], [3.0, 0.0, 0.0], [3.0, -1.0, 0.0]];
    let eyes = [1, 2, 3].map(|k| Vector::from(corners[k].map(|x| x as Real)));
    let drawn = corners.map(lariat_rapier::lariat_ancf::Vector3::from);
    let places: Vec<f64> = drawn
        .windows(2)
        .scan(0.0, |s, pair| {
            *s += (pair[1] - pair[0]).norm();
            Some(*s)
        })
        .collect();
    let rope = lariat_rapier::lariat_ancf::Cable::builder().points(drawn).section(section()).elements(24);
    let rope = places[..3].iter().fold(rope, |rope, &s| rope.node_at(s));
    let rope = set.insert(rope.damping(Damping { axial: 5e-3, bending: 5e-3 }).build().unwrap());
    let hook = Vector::new(0.0, 0.1, 0.0);
    for (at, crate_) in [At::Start, At::End].into_iter().zip(crates) {
        set.attach(&world, rope, at, crate_, hook, AttachmentKind::Ball).unwrap();
    }
    let options = SheaveOptions::default();
    let at = |s: f64| (rope, At::ArcLength(s));
    let far = set.add_sheave_at(&world, at(places[0] + 0.2), (ground, eyes[0]), options);
    assert!(matches!(far, Err(Error::GapTooLong { .. })), "{far:?}");
    let end = set.add_sheave_at(&world, (rope, At::Start), (crates[0], hook), options);
    assert!(matches!(end, Err(Error::AlreadyAttached { .. })), "{end:?}");
    assert_eq!((set.parts(rope).unwrap(), set.attachments().count()), (vec![rope], 2));
    let sheaves = [0, 1, 2].map(|k| set.add_sheave_at(&world, at(places[k]), (ground, eyes[k]), options).unwrap());
    let twice = set.add_sheave_at(&world, at(places[1]), (ground, eyes[1]), options);
    assert!(matches!(twice, Err(Error::AlreadyAttached { .. })), "{twice:?}");
    let parts = set.parts(rope).unwrap();
    assert_eq!((parts.len(), parts[0]), (4, rope));
    assert!(parts.iter().all(|&part| set.parts(part).unwrap() == parts));
    let whole = |set: &CableSet| parts.iter().map(|&part| set.get(part).unwrap().length()).sum::<f64>();
    assert!((whole(&set) - places[3]).abs() < 1e-9, "{} m", whole(&set));
    assert_eq!(set.part_at(rope, places[1] + 0.4).unwrap().0, parts[2]);
    run(&mut world, &mut set, 12);
    let speeds = |world: &PhysicsWorld| crates.map(|c| f64::from(world.bodies[c].linvel().y));
    let before = speeds(&world);
    run(&mut world, &mut set, 18);
    let after = speeds(&world);
    // the sum of momenta along the rope, in which its tension is not
    let gained = (10.0 * (after[0] - before[0]) + 17.0 * (before[1] - after[1])) / (7.0 * G * 18.0 / 60.0);
    let passed = sheaves.map(|sheave| set.sheave(sheave).unwrap().passed());
    println!("{gained} of the momentum, {passed:?} m");
    assert!((gained - 1.0).abs() < 5e-3, "{gained}");
    // a part between two of them is stretched by 2 mm
    assert!(passed[0] > 0.1 && passed.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 3e-3), "{passed:?}");
    assert!((whole(&set) - places[3]).abs() < 1e-9, "{} m", whole(&set));
    set.remove_sheave(sheaves[1]).unwrap();
    assert_eq!(set.parts(rope).unwrap(), parts[..2]);
    run(&mut world, &mut set, 3);
}

/// A tackle of four with a dynamic block: the load rises with a quarter of the speed with which the crate falls, at the acceleration of its
/// equation.
///
/// *Source.* `P (g - v') = T`, `4 T = W (g + v'/4)`.
#[test]
fn a_tackle_with_a_dynamic_block_divides_the_speed_by_four() {
    let mut world = PhysicsWorld::new();
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    let block = add_cube(&mut world, 24.0, 0.1, [0.0, -3.1, 0.0]);
    let crate_ = add_cube(&mut world, 10.0, 0.1, [0.0, -1.1, 0.0]);
    let mut set = CableSet::new();
    let (above, below) = ((ground, Vector::ZERO, [0.0; 3]), (block, Vector::new(0.0, 0.1, 0.0), [0.0, -3.0, 0.0]));
    let haul = (crate_, Vector::new(0.0, 0.1, 0.0), [0.0, -1.0, 0.0]);
    let ends = [[above, below], [below, above], [above, below], [below, above], [above, haul]];
    let ropes = ends.map(|ends| rope(&mut set, &world, ends));
    for pair in ropes.windows(2) {
        set.add_sheave((pair[0], At::End), (pair[1], At::Start), SheaveOptions::default()).unwrap();
    }
    run(&mut world, &mut set, 18);
    let speeds = |world: &PhysicsWorld| [block, crate_].map(|c| f64::from(world.bodies[c].linvel().y));
    let before = speeds(&world);
    run(&mut world, &mut set, 18);
    let after = speeds(&world);
    let expected = (10.0 - 24.0 / 4.0) / (10.0 + 24.0 / 16.0) * G * 18.0 / 60.0;
    println!("{before:?} {after:?}, {expected}");
    assert!((after[1] / after[0] + 4.0).abs() < 0.05, "{after:?}");
    assert!(((before[1] - after[1]) / expected - 1.0).abs() < 0.015, "{after:?}");
}

/// What makes no sheave is refused by name: an end without an attachment, another place, a method that cannot, a handle of the past.
#[test]
fn what_makes_no_sheave_is_refused_by_name() {
    let mut world = PhysicsWorld::new();
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    let mut set = CableSet::new();
    let top = (ground, Vector::ZERO, [0.0; 3]);
    let side = |x: Real| (ground, Vector::new(x, 0.0, 0.0), [x, 0.0, 0.0]);
    let ropes = [[side(-1.0), top], [top, side(1.0)]].map(|ends| rope(&mut set, &world, ends));
    let inner = set.add_sheave((ropes[0], At::ArcLength(0.5)), (ropes[1], At::Start), SheaveOptions::default());
    assert!(matches!(inner, Err(Error::Cable(Mechanics::ReelPlace { .. }))), "{inner:?}");
    // the second end fails: the first is as before
    let twice = set.add_sheave((ropes[0], At::End), (ropes[0], At::End), SheaveOptions::default());
    assert!(matches!(twice, Err(Error::Cable(Mechanics::ReelPlace { .. }))), "{twice:?}");
    assert!(set.get(ropes[0]).unwrap().reel(At::End).is_none());
    let apart = set.add_sheave((ropes[0], At::Start), (ropes[1], At::Start), SheaveOptions::default()).unwrap();
    assert!(set.step(&mut world).unwrap_err().to_string().contains("not at one point"));
    set.remove_sheave(apart).unwrap();
    assert_eq!(set.remove_sheave(apart), Err(Error::NoSheave(apart)));
    let fine = set.add_sheave((ropes[0], At::End), (ropes[1], At::Start), SheaveOptions::default()).unwrap();
    run(&mut world, &mut set, 5);
    set.remove(&mut world, ropes[0]).unwrap();
    assert_eq!(set.sheave(fine).unwrap_err(), Error::NoSheave(fine));
    run(&mut world, &mut set, 5);
}

/// Two crates that sway on ropes over one sheave with friction: the wheel runs on. Where a step has a second solution, which stops
/// it at once with tensions that press it enough, that one must not be taken.
///
/// *Source.* Rigid crates: once the rope is taut it accelerates with less than g.
#[test]
fn a_running_sheave_does_not_lock() {
    let mut seed = 5u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    for case in 0..20 {
        let friction = if case == 0 { 0.05 } else { 0.15 * random() };
        let light = if case == 0 { 2.0 } else { 1.0 + 3.0 * random() };
        let ratio = if case == 0 { 1.5 } else { (friction * std::f64::consts::PI).exp() * (1.1 + random()) };
        let mut world = PhysicsWorld::new();
        let block = world.insert_body(RigidBodyBuilder::fixed());
        let crates = [(light * ratio, 0.3), (light, -0.3)]
            .map(|(mass, z)| add_cube(&mut world, mass as Real, 0.1, [0.0, -3.1, z]));
        let mut set = CableSet::new();
        let ropes = [0.3, -0.3].map(|z| {
            let section = Section::from_stiffness(2e5, 1e-3, 0.005).unwrap();
            let rope = cable([0.0; 3], [0.0, -3.0, z], section).elements(12);
            set.insert(rope.damping(Damping { axial: 5e-3, bending: 0.0 }).build().unwrap())
        });
        for (rope, crate_) in ropes.into_iter().zip(crates) {
            set.attach(&world, rope, At::Start, block, Vector::ZERO, AttachmentKind::Ball).unwrap();
            set.attach(&world, rope, At::End, crate_, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        }
        let options = SheaveOptions { friction, ..SheaveOptions::default() };
        set.add_sheave((ropes[0], At::Start), (ropes[1], At::Start), options).unwrap();
        let mut before = 0.0;
        for step in 0..48 {
            run(&mut world, &mut set, 1);
            let rate = set.get(ropes[0]).unwrap().reel(At::Start).unwrap().rate;
            assert!(step < 6 || (rate - before).abs() < G / 60.0, "case {case}, step {step}: {before} to {rate} m/s");
            before = rate;
        }
        assert!(before > 0.1, "case {case}: {before} m/s");
    }
}

/// One rope that is drawn around a corner, up to a fold, starts at a sheave there and runs over it as two ropes that are drawn from either
/// side of it.
///
/// *Source.* The two ropes on a sheave between them; a straight rope as long as drawn holds no energy.
#[test]
fn a_rope_drawn_around_a_corner_runs_as_two_ropes_drawn_from_either_side() {
    for (feet, slack) in [
        ([[0.0, -3.0, 0.0], [0.0, -1.0, 0.0]], 1.0),
        ([[-1.0, -2.0, 0.5], [1.0, -2.5, 0.0]], 1.0),
        ([[-0.1, -4.0, 0.0], [0.1, -1.5, 0.0]], 1.0),
        ([[0.0, -2.0, 0.0], [2.0, 0.5, -0.5]], 1.02),
    ] {
        let section = Section::from_stiffness(1e5, 0.5, 0.05).unwrap();
        let damping = Damping { axial: 5e-3, bending: 5e-3 };
        let far = feet.map(|foot: [f64; 3]| foot.iter().map(|x| x * x).sum::<f64>().sqrt());
        let mut ends = Vec::new();
        for one in [true, false] {
            let mut world = PhysicsWorld::new();
            let eye = (world.insert_body(RigidBodyBuilder::fixed()), Vector::ZERO);
            let mut set = CableSet::new();
            let laid = |points: &[[f64; 3]], elements: usize| {
                let drawn: f64 =
                    points.windows(2).map(|p| (0..3).map(|i| (p[1][i] - p[0][i]).powi(2)).sum::<f64>().sqrt()).sum();
                let rope =
                    Cable::builder().points(points.iter().map(|&p| lariat_rapier::lariat_ancf::Vector3::from(p)));
                rope.length(slack * drawn).section(section).damping(damping).elements(elements)
            };
            // so many elements that one falls on each half metre of each side
            let counts = far.map(|far| (far * 3.0).round() as usize);
            let parts = if one {
                let all = laid(&[feet[0], [0.0; 3], feet[1]], (((far[0] + far[1]) * 3.0).round()) as usize);
                let rope = set.insert(all.node_at(slack * far[0]).build().unwrap());
                let at = At::ArcLength(slack * far[0]);
                let sheave = set.add_sheave_at(&world, (rope, at), eye, SheaveOptions::default()).unwrap();
                set.sheave(sheave).unwrap().ends().map(|(part, _)| part)
            } else {
                let up = set.insert(laid(&[feet[0], [0.0; 3]], counts[0]).build().unwrap());
                let down = set.insert(laid(&[[0.0; 3], feet[1]], counts[1]).build().unwrap());
                for (rope, at) in [(up, At::End), (down, At::Start)] {
                    set.attach(&world, rope, at, eye.0, eye.1, AttachmentKind::Ball).unwrap();
                }
                set.add_sheave((up, At::End), (down, At::Start), SheaveOptions::default()).unwrap();
                [up, down]
            };
            assert_eq!(parts.map(|part| set.get(part).unwrap().elements().len()), counts);
            let strain = |part| set.get(part).unwrap().energy();
            let strain: f64 = parts.map(strain).iter().map(|energy| energy.axial + energy.bending).sum();
            for (k, foot) in feet.into_iter().enumerate() {
                let load = add_cube(&mut world, [10.0, 17.0][k], 0.1, foot.map(|x| x as Real));
                let at = [At::Start, At::End][k];
                set.attach(&world, parts[k], at, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
            }
            run(&mut world, &mut set, 20);
            let state = parts.map(|part| set.get(part).unwrap().positions().to_vec()).concat();
            ends.push((strain, state));
        }
        let [(one, of_one), (two, of_two)] = [&ends[0], &ends[1]];
        println!("{feet:?}: {one:.3e} and {two:.3e} J");
        assert!(slack > 1.0 || *one < 1e-9, "{one:e} J");
        assert!((one - two).abs() <= 1e-9 * two + 1e-9, "{one:e} J of {two:e} J");
        let moved = of_one.iter().zip(of_two).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // a slack rope snatches, from where both part by 0.7 mm in 20 steps
        let same_motion = slack > 1.0 || moved < 1e-5;
        assert!(of_one.len() == of_two.len() && same_motion, "{moved:e} m");
    }
}
