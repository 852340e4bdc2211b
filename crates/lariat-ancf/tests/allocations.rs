//! Steps after the first do not allocate, and a cable holds little between them.

mod common;
mod counting;

use common::pendulum;
use counting::{HELD, allocations};
use lariat_ancf::contact::{Cuboid, HalfSpace, Obstacle};
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{
    At, Contact, Damping, Drag, Effects, EndSpin, Fidelity, Flow, Integrator, LineLoad, Method, PointLoad, RestShape,
    StepControl, Torsion, Vector3, step_all,
};

/// The counter counts an allocation.
///
/// *Source.* A vector on the heap.
#[test]
fn the_counter_sees_an_allocation() {
    assert_eq!(allocations(|| drop(std::hint::black_box(vec![1.0f64; 100]))), 1);
}

/// A hundred host steps of every method, fixed and error controlled, after ten to warm up: no
/// allocation.
///
/// *Source.* The contract; a real-time host cannot wait for an allocator.
#[test]
fn a_warm_cable_steps_without_allocating() {
    for method in Method::ALL {
        for control in [StepControl::Substeps(40), StepControl::Tolerance(1e-4)] {
            let integrator = Integrator { method, control };
            if integrator.checked().is_err() {
                continue;
            }
            let load = PointLoad::force(1.3, Vector3::new(0.0, -1.0, 0.5));
            let mut cable = pendulum(10).load(load).integrator(integrator).build().unwrap();
            let mut run = |steps: usize| (0..steps).for_each(|_| cable.step(1.0 / 240.0).unwrap());
            run(10);
            assert_eq!(allocations(|| run(100)), 0, "{method}, {control:?}");
        }
    }
}

/// The same of a twisted cable that a motor winds up, and reads itself, by the discrete gradient
/// and by a method that evaluates forces.
///
/// *Source.* The contract.
#[test]
fn a_warm_twisted_cable_steps_without_allocating() {
    let end = EndSpin::Motor { rate: 0.2, from: 0.0, until: 10.0 };
    let torsion = Some(Torsion { initial_twist: 0.5, damping: 0.01, end, ..Torsion::new(0.05) });
    let effects = Effects { torsion, ..Effects::default() };
    for fidelity in [Fidelity::Game, Fidelity::Custom(Integrator::default())] {
        let built = pendulum(10).clamp(At::Start).clamp(At::End).effects(effects.clone()).fidelity(fidelity).build();
        let mut cable = built.unwrap();
        cable.set_watched(true);
        let mut run = |steps: usize| (0..steps).for_each(|_| cable.step(1.0 / 240.0).unwrap());
        run(10);
        assert_eq!(allocations(|| run(100)), 0, "{}", fidelity.name());
    }
}

/// All effects that a step evaluates.
fn effects() -> Effects {
    let flow = Flow::power_law(Vector3::new(1.0, 0.0, 0.3), Vector3::y(), 1.0, 0.14, 10.0)
        .with_history([[0.0, 0.5], [1.0, 1.0]]);
    Effects {
        damping: Some(Damping { axial: 1e-3, bending: 1e-3 }),
        drag: Some(Drag::new(1.2, 1.2, 0.01, flow)),
        rest_shape: Some(RestShape::curved(0.01)),
        line_loads: Some(LineLoad::uniform(Vector3::x()).into()),
        ..Effects::default()
    }
}

/// The same with effects, for a cable alone and one with a body.
///
/// *Source.* The contract.
#[test]
fn a_warm_cable_with_effects_steps_without_allocating() {
    for method in Method::ALL.into_iter().filter(|m| m.properties().implicit) {
        let integrator = Integrator { method, control: StepControl::Substeps(40) };
        let mut cable = pendulum(10).effects(effects()).integrator(integrator).build().unwrap();
        let mut run = |steps: usize| (0..steps).for_each(|_| cable.step(1.0 / 240.0).unwrap());
        run(10);
        assert_eq!(allocations(|| run(100)), 0, "{method}");
        let mut cable = pendulum(10).effects(effects()).build().unwrap();
        let node = cable.attach(At::End).unwrap();
        let body = RigidBody::new(1.0, nalgebra::Matrix3::identity(), Vector3::new(2.0, -0.1, 0.0)).unwrap();
        let pins = [PinConstraint { cable: 0, node, body: 0, anchor: Vector3::new(0.0, 0.1, 0.0), direction: None }];
        let (mut bodies, mut island) = ([body], Island::default());
        let mut run = |steps: usize| {
            (0..steps)
                .for_each(|_| island.step(&mut [&mut cable], &mut bodies, &pins, integrator, 1.0 / 240.0).unwrap())
        };
        run(10);
        assert_eq!(allocations(|| run(100)), 0, "island, {method}");
    }
}

/// The same for a cable that slides over a floor and a box.
///
/// *Source.* The contract.
#[test]
fn a_warm_cable_in_contact_steps_without_allocating() {
    let mut cable = pendulum(10).integrator(Fidelity::Game).build().unwrap();
    cable.set_contact(Contact::default().with_radius(0.005)).unwrap();
    let floor = Obstacle::new(1, HalfSpace { normal: Vector3::y() }, Vector3::new(0.0, -0.5, 0.0), 0.3);
    let block = Cuboid { half_extents: Vector3::repeat(0.1) };
    let block = Obstacle::new(2, block, Vector3::new(0.5, -0.5, 0.0), 0.3);
    let mut run = |steps: usize| {
        for _ in 0..steps {
            cable.set_obstacles([floor.clone(), block.clone()]).unwrap();
            cable.step(1.0 / 60.0).unwrap();
        }
    };
    run(120);
    assert_eq!(allocations(|| run(100)), 0);
    assert!(cable.contacts().count() > 5);
}

/// The same for a cable and a body as one system.
///
/// *Source.* The contract.
#[test]
fn a_warm_island_steps_without_allocating() {
    for method in Method::ALL {
        for control in [StepControl::Substeps(40), StepControl::Tolerance(1e-4)] {
            let integrator = Integrator { method, control };
            if integrator.checked().is_err() {
                continue;
            }
            let mut cable = pendulum(10).build().unwrap();
            let node = cable.attach(At::End).unwrap();
            let body = RigidBody::new(1.0, nalgebra::Matrix3::identity(), Vector3::new(2.0, -0.1, 0.0)).unwrap();
            let pins =
                [PinConstraint { cable: 0, node, body: 0, anchor: Vector3::new(0.0, 0.1, 0.0), direction: None }];
            let (mut bodies, mut island) = ([body], Island::default());
            let mut run = |steps: usize| {
                (0..steps)
                    .for_each(|_| island.step(&mut [&mut cable], &mut bodies, &pins, integrator, 1.0 / 240.0).unwrap())
            };
            run(10);
            assert_eq!(allocations(|| run(100)), 0, "{method}, {control:?}");
        }
    }
}

/// A cable of 16 elements that has stepped, alone or with a body, or that statics have placed: at
/// most 20 kB, the cable itself included. What it needs only while it steps belongs to the thread.
///
/// *Source.* The contract: a fleet of thousands stays in the cache. An allocator that counts.
#[test]
fn a_cable_of_sixteen_elements_takes_at_most_twenty_kibibytes() {
    const LIMIT: i64 = 20 * 1024;
    let held_by = |run: &dyn Fn() -> Box<lariat_ancf::Cable>| {
        // the buffers of the thread
        drop(run());
        let before = HELD.get();
        let cable = run();
        let held = HELD.get() - before;
        drop(cable);
        assert_eq!(HELD.get(), before, "the buffers of the thread grew");
        held
    };
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        let held = held_by(&|| {
            let mut cable = Box::new(pendulum(16).build().unwrap());
            cable.set_integrator(cable.integrator_for(fidelity)).unwrap();
            (0..5).for_each(|_| cable.step(1.0 / 60.0).unwrap());
            cable
        });
        println!("{fidelity:?}: {held} bytes");
        assert!(held <= LIMIT, "{fidelity:?}: {held} bytes");
    }
    let island = std::cell::RefCell::new(Island::default());
    let with_a_body = held_by(&|| {
        let mut cable = Box::new(pendulum(16).build().unwrap());
        let integrator = cable.integrator_for(Fidelity::Game);
        let node = cable.attach(At::End).unwrap();
        let mut bodies = [RigidBody::new(1.0, nalgebra::Matrix3::identity(), Vector3::new(2.0, -0.1, 0.0)).unwrap()];
        let anchor = Vector3::new(0.0, 0.1, 0.0);
        let pins = [PinConstraint { cable: 0, node, body: 0, anchor, direction: None }];
        for _ in 0..5 {
            island.borrow_mut().step(&mut [&mut cable], &mut bodies, &pins, integrator, 1.0 / 60.0).unwrap();
        }
        cable
    });
    assert!(with_a_body <= LIMIT, "with a body: {with_a_body} bytes");
    let at_rest = held_by(&|| {
        let mut cable = Box::new(pendulum(16).build().unwrap());
        cable.equilibrium().unwrap();
        cable.stiffness_matrix();
        cable
    });
    assert!(at_rest <= LIMIT, "at rest: {at_rest} bytes");
}

/// A fleet on one thread.
///
/// *Source.* The contract.
#[test]
fn a_warm_fleet_steps_without_allocating() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut cables: Vec<_> = [3, 10, 5].map(|elements| pendulum(elements).build().unwrap()).into();
    let mut run = |steps: usize| {
        pool.install(|| {
            (0..10).for_each(|_| step_all(&mut cables, 1.0 / 240.0).unwrap());
            allocations(|| (0..steps).for_each(|_| step_all(&mut cables, 1.0 / 240.0).unwrap()))
        })
    };
    assert_eq!(run(100), 0);
}
