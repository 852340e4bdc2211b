//! A fleet: many cables in one call.

mod common;

use common::pendulum;
use lariat_ancf::coupling::{Coupling, cost_of_step, jobs_of_task};
use lariat_ancf::{Cable, Error, Fidelity, Vector3, step_all};

/// Cables of different sizes and initial velocities.
fn fleet() -> Vec<Cable> {
    let cable = |i: usize| {
        let mut cable = pendulum(1 + (7 * i) % 13).build().unwrap();
        let fidelity = if i.is_multiple_of(5) { Fidelity::Engineering } else { Fidelity::Game };
        cable.set_integrator(cable.integrator_for(fidelity)).unwrap();
        let x = i as f64;
        cable.set_rigid_motion(Vector3::zeros(), Vector3::new(0.0, x.sin(), x.cos()) * 3.0).unwrap();
        cable
    };
    (0..40).map(cable).collect()
}

fn bits(cables: &[Cable]) -> Vec<u64> {
    cables.iter().flat_map(|c| c.positions().iter().chain(c.velocities())).map(|x| x.to_bits()).collect()
}

/// Ten host steps on 1, 2 and 4 threads, and one cable after the other, each in a thread of its own and so in fresh buffers: the same bits.
///
/// *Source.* The contract; cables do not act on each other.
#[test]
fn a_fleet_is_bitwise_the_same_on_any_number_of_threads() {
    const STEPS: usize = 10;
    let mut alone = fleet();
    for cable in &mut alone {
        std::thread::scope(|scope| {
            scope.spawn(|| (0..STEPS).for_each(|_| cable.step(1.0 / 60.0).unwrap()));
        });
    }
    for threads in [1, 2, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut cables = fleet();
        pool.install(|| (0..STEPS).for_each(|_| step_all(&mut cables, 1.0 / 60.0).unwrap()));
        assert!(bits(&cables) == bits(&alone), "{threads} threads");
    }
    // references to cables
    let mut cables = fleet();
    let mut references: Vec<&mut Cable> = cables.iter_mut().collect();
    (0..STEPS).for_each(|_| step_all(&mut references, 1.0 / 60.0).unwrap());
    assert!(bits(&cables) == bits(&alone));
}

/// Two of the cables are attached to bodies that are not there: both are named with their errors, are as before, and the others advance.
///
/// *Source.* The contract of [`step_all`].
#[test]
fn cables_that_cannot_step_concern_themselves_alone() {
    let mut cables = fleet();
    for i in [7, 23] {
        cables[i].attach(lariat_ancf::At::End).unwrap();
    }
    let before = [7, 23].map(|i: usize| cables[i].snapshot().clone());
    let failed = step_all(&mut cables, 1.0 / 60.0).unwrap_err();
    let numbers: Vec<usize> = failed.failures.iter().map(|(i, _)| *i).collect();
    assert_eq!(numbers, [7, 23]);
    assert!(failed.failures.iter().all(|(_, error)| matches!(error, Error::Attached { .. })), "{failed}");
    for (i, cable) in cables.iter().enumerate() {
        assert_eq!(cable.time() > 0.0, ![7, 23].contains(&i));
    }
    assert_eq!([7, 23].map(|i: usize| cables[i].snapshot().clone()), before);
}

/// Threads are used where they pay: a task has a thousand evaluations of an element or more. What has fewer is one task; cables that have
/// taken many steps in a host step are shared out earlier than calm ones.
#[test]
fn small_work_is_one_task() {
    for (jobs, cost, of_task) in
        [(10, 300.0, 10), (10, 1999.0, 10), (10, 2000.0, 5), (10, 1e5, 1), (3, 2500.0, 2), (1, 1e6, 1)]
    {
        assert_eq!(jobs_of_task(jobs, cost), of_task, "{jobs} {cost}");
    }
    let mut cables = [fleet()[3].clone(), fleet()[5].clone()];
    let at_first = cables.iter().map(|cable| 2.0 * cable.elements().len() as f64);
    assert!(cables.iter().map(cost_of_step).eq(at_first));
    step_all(&mut cables, 1.0 / 60.0).unwrap();
    let each = cables.iter().map(|cable| cost_of_step(cable) / cable.elements().len() as f64);
    let [game, engineering] = each.collect::<Vec<_>>()[..] else { unreachable!() };
    assert!(game >= 2.0 && engineering > 4.0 * game, "{game} {engineering}");
}
