//! A cable that breaks by its load, and what its parts keep.

use approx::assert_relative_eq;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{
    At, Break, BreakCause, Cable, Damping, Energy, Error, Fidelity, PointLoad, RestPiece, RestShape, Section, Strength,
    Vector3,
};
use nalgebra::Matrix3;

const STEP: f64 = 1.0 / 240.0;

/// A cable of `mass` (kg/m) and 2 m that hangs at rest, pulled at its end by a force that grows by `rate` (N/s).
fn pulled(mass: f64, rate: f64, elements: usize) -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -2.0, 0.0)])
        .section(Section::from_stiffness(2.0e4, 0.01, mass).unwrap())
        .elements(elements)
        .damping(Damping { axial: 2e-3, bending: 0.0 })
        .fidelity(Fidelity::Engineering)
        .fix(At::Start)
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    cable.add_load(PointLoad { ramp: 100.0, ..PointLoad::force(2.0, [0.0, -100.0 * rate, 0.0]) }).unwrap();
    cable
}

/// Steps a cable until it breaks; returns the rest, the break and the time.
fn break_it(cable: &mut Cable) -> (Cable, Break, f64) {
    for _ in 0..4000 {
        cable.step(STEP).unwrap();
        if let Some((rest, how)) = cable.break_overloaded().unwrap() {
            return (rest, how, cable.time());
        }
    }
    panic!("it did not break");
}

/// *Source.* Statics: the tension at the top is the pull and the weight below, T = F + rho A L g; the pull is slow beside the wave speed.
/// The strain of the material law is that of T = EA (f^2 - 1)/2 f. The top is held, so the cable breaks at the next node.
#[test]
fn a_pulled_cable_breaks_at_its_limit_at_the_node_next_to_the_largest_load() {
    for (mass, rate, limit, elements) in
        [(0.4, 20.0, 40.0, 10), (0.05, 100.0, 90.0, 7), (1.0, 40.0, 60.0, 16), (0.01, 200.0, 300.0, 9)]
    {
        for by_strain in [false, true] {
            let mut cable = pulled(mass, rate, elements);
            // T = EA e (1 + e)(1 + e/2) with the stretch 1 + e, solved by Newton's iteration
            let mut e = limit / 2.0e4;
            for _ in 0..20 {
                e -= (2.0e4 * e * (1.0 + e) * (1.0 + 0.5 * e) - limit) / (2.0e4 * (1.0 + 3.0 * e));
            }
            let strength = if by_strain { Strength::strain(e) } else { Strength::tension(limit) };
            cable.set_strength(strength).unwrap();
            let (rest, how, time) = break_it(&mut cable);
            let load = rate * time + mass * 9.81 * 2.0;
            assert!((load / limit - 1.0).abs() < 0.02, "{load} N of {limit} N");
            assert!((how.tension / limit - 1.0).abs() < 0.02, "{how:?}");
            assert_eq!(how.cause, if by_strain { BreakCause::Strain } else { BreakCause::Tension });
            assert_relative_eq!(how.arc_length, 2.0 / elements as f64, epsilon = 1e-12);
            assert_relative_eq!(cable.length(), how.arc_length, epsilon = 1e-12);
            assert_eq!((cable.loads().len(), rest.loads().len()), (0, 1));
            assert_eq!(rest.strength(), strength);
        }
    }
}

fn total(parts: &[&Cable]) -> (Energy, Vector3<f64>, Vector3<f64>, f64) {
    let mut sum = (Energy::default(), Vector3::zeros(), Vector3::zeros(), 0.0);
    for part in parts {
        let momentum = part.momentum();
        sum.0 += part.energy();
        sum.1 += momentum.linear;
        sum.2 += momentum.angular;
        sum.3 += part.length();
    }
    sum
}

/// A swinging, damped, pre-curved cable breaks or is cut anywhere: momentum, length and energy of the parts are those of the whole,
/// but for the energy that is reported. Then the parts move on, and their momentum changes by weight and support alone.
///
/// *Source.* Conservation.
#[test]
fn momentum_and_energy_of_the_parts_are_those_of_the_whole() {
    let mut whole = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.4, 0.0), Vector3::new(2.0, 0.0, 0.3)])
        .section(Section::square(0.01, 1.0e8, 4000.0).unwrap())
        .damping(Damping { axial: 1e-4, bending: 1e-4 })
        .fix(At::Start)
        .build()
        .unwrap();
    let mut effects = whole.effects().clone();
    effects.rest_shape = Some(RestShape { pieces: vec![RestPiece { from: 0.0, stretch: 1.01, curvature: 0.2 }] });
    whole.set_effects(effects).unwrap();
    for _ in 0..40 {
        whole.step(STEP).unwrap();
    }
    let before = total(&[&whole]);
    let size = before.0.kinetic + before.0.axial + before.0.bending;
    for place in [None, Some(0.2), Some(0.61), Some(1.97)] {
        let mut head = whole.clone();
        let (mut tail, how) = match place {
            None => {
                // above every strain of the present state
                head.set_strength(Strength::strain(1e-9)).unwrap();
                head.break_overloaded().unwrap().unwrap()
            }
            Some(s) => head.break_at(s).unwrap(),
        };
        let after = total(&[&head, &tail]);
        assert!((after.0.total() - before.0.total() - how.inserted_energy).abs() < 1e-9 * size, "{place:?} {how:?}");
        assert!(place.is_some() || how.inserted_energy == 0.0);
        assert_relative_eq!(how.strain_energy, before.0.axial + before.0.bending, max_relative = 1e-12);
        assert_relative_eq!(after.1, before.1, epsilon = 1e-11);
        assert_relative_eq!(after.2, before.2, epsilon = 1e-11);
        assert_relative_eq!(after.3, before.3, epsilon = 1e-12);
        let (free, steps) = (tail.momentum().linear, 30);
        for _ in 0..steps {
            head.step(STEP).unwrap();
            tail.step(STEP).unwrap();
        }
        let fallen = 0.4 * tail.length() * 9.81 * STEP * f64::from(steps);
        assert_relative_eq!(tail.momentum().linear, free - Vector3::new(0.0, fallen, 0.0), epsilon = 1e-9);
    }
}

#[test]
fn limits_that_make_no_sense_are_typed_errors_and_change_nothing() {
    let mut cable = pulled(0.4, 10.0, 4);
    for limit in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for strength in [Strength::tension(limit), Strength::strain(limit)] {
            assert!(matches!(cable.set_strength(strength), Err(Error::InvalidValue { .. })), "{limit}");
        }
    }
    assert_eq!(cable.strength(), Strength::default());
    assert!(cable.break_overloaded().unwrap().is_none());
    let mut one = pulled(0.4, 10.0, 1);
    assert_eq!(one.set_strength(10.0), Err(Error::OneElement { cable: "cable".to_string() }));
    one.set_strength(None).unwrap();
    // parts of one element bear everything
    cable.set_strength(1e-3).unwrap();
    let (mut rest, how) = cable.break_overloaded().unwrap().unwrap();
    assert_relative_eq!(how.arc_length, 0.5, epsilon = 1e-12);
    assert!(cable.break_overloaded().unwrap().is_none());
    // the pull at its end breaks the rest again, once that has recoiled
    assert!(rest.break_overloaded().unwrap().is_none());
    let again = (0..240).find_map(|_| rest.step_and_break(STEP).unwrap().into_iter().next()).unwrap().1;
    assert!((again.arc_length / 0.5).fract() < 1e-9, "{again:?}");
}

/// A mass is caught by a rope of any stiffness, at any speed and damping: the rope breaks at the strain at which the elastic tension reaches the
/// limit, with what damping bears beside it told apart.
///
/// *Source.* The law of the material, T = EA e (1 + e)(1 + e/2). What it may exceed the limit by: the strain that grows in a step, and a wave that
/// comes back from the fixed end, twice v sqrt(EA m).
#[test]
fn a_rope_breaks_at_one_strain_however_it_is_damped() {
    for (stiffness, mass, speed) in [(1e4, 80.0, 6.0), (1e5, 80.0, 6.0), (5e5, 500.0, 4.0)] {
        for damping in [0.0, 1e-3, 1e-2] {
            let (length, line) = (4.0, 0.06);
            let mut rope = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(0.0, -length, 0.0)])
                .section(Section::from_stiffness(stiffness, 1e-3, line).unwrap())
                .elements(8)
                .damping(Damping { axial: damping, bending: 0.0 })
                .fidelity(Fidelity::Game)
                .fix(At::Start)
                .build()
                .unwrap();
            rope.attach(At::End).unwrap();
            let limit = 0.05 * stiffness;
            rope.set_strength(limit).unwrap();
            let mut body = RigidBody::new(mass, Matrix3::identity(), Vector3::new(0.0, -length, 0.0)).unwrap();
            body.velocity = Vector3::new(0.0, -speed, 0.0);
            body.force = Vector3::new(0.0, -9.81 * mass, 0.0);
            let (mut island, integrator, host) = (Island::default(), rope.integrator(), 1e-3);
            let pin = PinConstraint { cable: 0, node: 8, body: 0, anchor: Vector3::zeros(), direction: None };
            let mut bodies = [body];
            let mut step = || {
                island.step(&mut [&mut rope], &mut bodies, &[pin], integrator, host).unwrap();
                rope.break_overloaded().unwrap()
            };
            let (_, how) = (0..600).find_map(|_| step()).expect("a rope that breaks");
            let case = format!("EA {stiffness:.0e} N, {mass} kg at {speed} m/s, {damping} s: {how:?}");
            let e = how.strain;
            let elastic = stiffness * e * (1.0 + e) * (1.0 + 0.5 * e);
            println!("{case}");
            assert!((how.tension / elastic - 1.0).abs() < 0.02, "{case}");
            let above = 2.0 * speed * (stiffness * line).sqrt() + 2.0 * stiffness * speed / length * host;
            assert!((limit..limit + above).contains(&how.tension), "{case}: at most {above} N above {limit}");
            let rate = speed / length;
            assert!(how.damping.abs() <= 4.0 * stiffness * damping * rate + 1e-9, "{case}");
            assert_eq!(how.damping == 0.0, damping == 0.0, "{case}");
        }
    }
}

/// A rope of random stiffness, mass and strength that is pulled from its other end at once breaks within a host step: its parts
/// are then where they are with host steps as long as those of integration.
///
/// *Source.* The steps of integration are the same at all of these host steps.
#[test]
fn a_break_does_not_depend_on_the_host_step() {
    let mut state = 0x5eed_u64;
    let mut random = |from: f64, to: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from * (to / from).powf((state >> 11) as f64 / (1u64 << 53) as f64)
    };
    for _ in 0..12 {
        let (stiffness, line, pull) = (random(1e3, 1e5), random(0.02, 0.5), random(30.0, 300.0));
        let strength = random(0.4, 1.2) * pull;
        let run = |rate: usize| {
            let mut rope = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
                .section(Section::from_stiffness(stiffness, 0.01, line).unwrap())
                .elements(8)
                .fidelity(Fidelity::Game)
                .fix(At::Start)
                .build()
                .unwrap();
            rope.add_load(PointLoad::force(2.0, [pull, 0.0, 0.0])).unwrap();
            rope.set_strength(strength).unwrap();
            let mut parts = vec![rope];
            let mut times = Vec::new();
            for _ in 0..rate / 10 {
                let mut new = Vec::new();
                for part in &mut parts {
                    for (rest, how) in part.step_and_break(1.0 / rate as f64).unwrap() {
                        times.push(how.time);
                        new.push(rest);
                    }
                }
                parts.extend(new);
            }
            times.sort_by(f64::total_cmp);
            (parts, times)
        };
        let (fine, when) = run(240);
        for rate in [30, 60, 120] {
            let (coarse, times) = run(rate);
            let case = format!(
                "EA {stiffness:.0} N, {line:.2} kg/m, {pull:.0} N, {strength:.0} N, {rate} Hz: {times:?} {when:?}"
            );
            println!("{case}");
            assert!(!when.is_empty() && times.len() == when.len(), "{case}");
            let total = |parts: &[Cable]| parts.iter().map(|p| p.momentum().linear).sum::<Vector3<f64>>();
            let (one, two) = (total(&coarse), total(&fine));
            assert!((one - two).norm() < 1e-6 * two.norm(), "{case}: {one} {two}");
            let apart =
                (coarse[0].node_position(coarse[0].nodes() - 1) - fine[0].node_position(fine[0].nodes() - 1)).norm();
            assert!(apart < 1e-6, "{case}: {apart} m");
            assert!(times.iter().zip(&when).all(|(a, b)| (a - b).abs() < 1e-9), "{case}");
        }
    }
}

/// The free part of a rope that broke at its support, pulled ever harder at its other end, breaks again where its own tension
/// exceeds the limit: the recoil, which damping takes away, excuses it no more.
///
/// *Source.* A free rope that is pulled at one end with F accelerates as a whole, T = F s/L at s from its free end; the largest
/// tension at an inner node is that at the last one, F (n - 1)/n.
#[test]
fn a_free_part_breaks_by_the_pull_at_its_end() {
    for (elements, damping, mass) in [(10, 0.01, 0.4), (8, 0.003, 0.4), (16, 0.01, 1.0)] {
        let mut rope = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(0.0, -5.0, 0.0)])
            .section(Section::from_stiffness(2.0e5, 0.0, mass).unwrap())
            .elements(elements)
            .damping(Damping { axial: damping, bending: 0.0 })
            .gravity(Vector3::zeros())
            .fidelity(Fidelity::Engineering)
            .fix(At::Start)
            .build()
            .unwrap();
        rope.add_load(PointLoad { ramp: 3.0, ..PointLoad::force(5.0, [0.0, -600.0, 0.0]) }).unwrap();
        rope.set_strength(300.0).unwrap();
        let mut parts = Vec::new();
        while parts.is_empty() {
            parts = rope.step_and_break(1.0 / 60.0).unwrap();
        }
        let (mut free, first) = parts.remove(0);
        assert!((first.time - 1.5).abs() < 0.02, "{first:?}");
        let again = loop {
            assert!(free.time() < 3.0, "it did not break again");
            if let Some((_, how)) = free.step_and_break(1.0 / 60.0).unwrap().first() {
                break *how;
            }
        };
        let of_end = 200.0 * again.time;
        let n = (elements - 1) as f64;
        println!(
            "{elements} elements: again at {:.3} s, {:.1} N at its end, {:.1} N",
            again.time, of_end, again.tension
        );
        assert!(of_end * (n - 1.0) / n < 300.0 * 1.05, "at {of_end} N");
    }
}
