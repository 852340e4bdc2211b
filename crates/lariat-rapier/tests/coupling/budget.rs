//! The budget of a host step: no frame waits for an island, whatever it does.

use super::common::{add_cube, bits, cable, is_left_out_in_double, run, steel};
use lariat_rapier::lariat_ancf::{At, Fidelity, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, Budget, CableSet, Event};

/// Steel cables from the origin along directions `a` to loads of 1, 10, 100 kg; thrown at random, tight and slack.
fn thrown(fidelity: Fidelity, budget: Option<Budget>) -> (PhysicsWorld, CableSet) {
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    set.settings.budget = budget;
    set.settings.fidelity = fidelity;
    for (i, (mass, speed)) in [(1.0, 15.0), (10.0, -8.0), (100.0, 4.0)].into_iter().enumerate() {
        let z = 2.0 * i as f64;
        let load = add_cube(&mut world, mass, 0.1, [2.0, 0.0, z as Real]);
        world.bodies[load].set_linvel(Vector::new(speed, 3.0, speed), true);
        let rope = cable([0.0, 0.0, z], [1.9, 0.0, z], steel()).fix(At::Start);
        let rope = rope.velocity(Vector3::new(0.0, 0.2 * f64::from(speed), 0.0)).build().unwrap();
        let rope = set.insert(rope);
        set.attach(&world, rope, At::End, load, Vector::new(-0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
    }
    (world, set)
}

/// Runs half a second; returns most Newton iterations of an island in a host step, the number of events `Degraded`, and the energy made as
/// a share of that of the start.
fn measure((mut world, mut set): (PhysicsWorld, CableSet)) -> (u64, usize, f64) {
    let iterations = |set: &CableSet| set.iter().map(|(_, c)| c.diagnostics().newton_iterations).collect::<Vec<_>>();
    let kinetic = set.energy(&world).unwrap().total();
    let (mut most, mut degraded, mut highest) = (0, 0, f64::NEG_INFINITY);
    for _ in 0..30 {
        let before = iterations(&set);
        set.step(&mut world).unwrap();
        most = iterations(&set).iter().zip(&before).map(|(now, before)| now - before).fold(most, u64::max);
        degraded += set.events().iter().filter(|event| matches!(event, Event::Degraded { .. })).count();
        highest = highest.max(set.energy(&world).unwrap().total());
    }
    (most, degraded, (highest - kinetic) / kinetic.abs())
}

/// Thrown loads on steel cables: without a budget a host step takes hundreds of iterations and more; with one of 20 it takes no more than
/// what the page of [`WorkLimit`](lariat_rapier::lariat_ancf::integrate::WorkLimit) says, is reported, and makes no energy.
///
/// Reference: the bound by counting: the stages of one step (8 iterations in each of 5), then a step of the discrete gradient for each
/// 1/240 s, and three for each of six divisions of each Rapier step. Energy: the law, and single precision of the bodies.
#[test]
fn no_host_step_exceeds_its_budget() {
    if is_left_out_in_double() {
        return;
    }
    for fidelity in [Fidelity::Engineering, Fidelity::Game] {
        let (free, none, _) = measure(thrown(fidelity, None));
        assert_eq!(none, 0);
        let (most, degraded, made) = measure(thrown(fidelity, Some(Budget::NewtonIterations(20))));
        println!(
            "{fidelity:?}: {free} iterations without a budget, {most} with, {degraded} reports, energy made {made:.1e}"
        );
        assert!(most <= 20 + 40 + 4 + 18, "{fidelity:?}: {most}");
        assert!(made < 1e-3, "{fidelity:?}: {made:.1e}");
        if fidelity == Fidelity::Engineering {
            assert!(free > 400 && degraded > 10, "{free} {degraded}");
        }
    }
    let (_, degraded, made) = measure(thrown(Fidelity::Engineering, Some(Budget::Time(0.0))));
    assert!(degraded == 90 && made < 1e-3, "{degraded} {made:.1e}");
}

/// A budget that is not spent changes nothing, to the bit.
#[test]
fn a_budget_that_is_not_spent_changes_nothing() {
    if is_left_out_in_double() {
        return;
    }
    for fidelity in [Fidelity::Engineering, Fidelity::Game] {
        let end = |budget| {
            let (mut world, mut set) = thrown(fidelity, budget);
            run(&mut world, &mut set, 10);
            bits(&world, &set)
        };
        assert!(end(None) == end(Some(Budget::NewtonIterations(1_000_000))));
        assert!(end(None) == end(Some(Budget::Time(1e6))));
    }
}

/// The budget that games have by default is not spent by an ordinary host step, and changes nothing, to the bit; error control has none.
#[test]
fn the_budget_of_games_changes_no_ordinary_step() {
    assert_eq!(CableSet::new().settings.budget, Some(Budget::Games));
    for (fidelity, steps) in [(Fidelity::Engineering, 2), (Fidelity::Game, 30)] {
        let end = |budget| {
            let (mut world, mut set) = thrown(fidelity, budget);
            for _ in 0..steps {
                set.step(&mut world).unwrap();
                assert!(!set.events().iter().any(|event| matches!(event, Event::Degraded { .. })));
            }
            bits(&world, &set)
        };
        assert!(end(None) == end(Some(Budget::Games)));
    }
}

/// What a budget cuts short is told: by an event with the cost of the island, and by a warning that counts the steps; the run goes the
/// same way to the bit again.
#[test]
fn what_is_cut_short_is_told_and_replays() {
    let end = || {
        let (mut world, mut set) = thrown(Fidelity::Game, Some(Budget::NewtonIterations(3)));
        let mut most = 0;
        for _ in 0..20 {
            set.step(&mut world).unwrap();
            let of_event = |event: &Event| if let Event::Degraded { iterations, .. } = event { *iterations } else { 0 };
            most = set.events().iter().map(of_event).fold(most, u64::max);
        }
        let told = set.warnings(&world);
        let told = told.iter().filter(|w| w.to_string().contains("the limit to the work was reached")).count();
        assert!(most > 3 && told > 0, "{most} {told}");
        bits(&world, &set)
    };
    assert!(end() == end());
}
