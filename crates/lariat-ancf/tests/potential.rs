//! Terms from outside the crate: springs from points of cables to points of the world, in motion, in statics, on an island, beside contact.

use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{self, Island, Links, PinConstraint, RigidBody};
use lariat_ancf::{
    At, Cable, CableBuilder, Contact, Effects, EquilibriumFailure, EquilibriumOptions, Error, Integrator, Method,
    PointLoad, Potential, Reel, Section, StepControl, Vector3,
};
use nalgebra::Matrix3;
use std::sync::Arc;

/// A spring from a point of a cable to a point of the world, that stiffens with its length: `V = k/2 |d|^2 (1 + |d|^2/2)`.
#[derive(Debug)]
struct Spring {
    to: Vector3<f64>,
    stiffness: f64,
}

impl Potential for Spring {
    fn energy(&self, x: &Vector3<f64>) -> f64 {
        let square = (x - self.to).norm_squared();
        0.5 * self.stiffness * square * (1.0 + 0.5 * square)
    }

    fn gradient(&self, x: &Vector3<f64>) -> Vector3<f64> {
        let d = x - self.to;
        self.stiffness * (1.0 + d.norm_squared()) * d
    }

    fn hessian(&self, x: &Vector3<f64>) -> Matrix3<f64> {
        let d = x - self.to;
        self.stiffness * ((1.0 + d.norm_squared()) * Matrix3::identity() + 2.0 * d * d.transpose())
    }
}

fn spring(stiffness: f64, to: [f64; 3]) -> Arc<Spring> {
    Arc::new(Spring { to: to.into(), stiffness })
}

fn rope() -> CableBuilder {
    let section = Section::from_stiffness(2e4, 0.02, 0.3).unwrap();
    Cable::builder().points([Vector3::zeros(), Vector3::new(1.5, 0.0, 0.0)]).section(section).elements(6)
}

fn game() -> Integrator {
    Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) }
}

/// Returns the energy of cables and bodies with what the method holds, less the works and with the losses of the energy law, and the size of the energies.
fn account(cables: &[&Cable], bodies: &[RigidBody]) -> (f64, f64) {
    let (mut sum, mut size) = (0.0, 0.0);
    for cable in cables {
        let (energy, law) = (cable.energy(), cable.energy_law());
        sum += energy.total() + cable.energy_in_store() + cable.contact_energy() + law.numerical + law.rescaled;
        sum += law.shortened;
        sum += law.contacts - law.supports - law.loads - law.obstacles - law.residual;
        size += energy.kinetic + energy.potentials.abs() + energy.gravity.abs();
    }
    for body in bodies {
        sum += body.kinetic_energy() + body.energy_in_store() - body.force.dot(&body.position);
        size += body.kinetic_energy();
    }
    (sum, size)
}

/// With a spring at its end and at its middle a rope rests where the same forces, as point loads, hold it; all forces balance.
///
/// *Source.* Statics: equal forces, equal shape; the sum of reaction, weight and springs.
#[test]
fn statics_know_it() {
    let springs = [(At::End, spring(40.0, [1.2, 0.3, 0.4])), (At::ArcLength(0.8), spring(15.0, [0.5, -1.0, -0.2]))];
    let mut sprung = rope().fix(At::Start).build().unwrap();
    springs.iter().for_each(|(at, own)| sprung.add_potential(*at, own.clone()).unwrap());
    sprung.equilibrium().unwrap();
    let mut loaded = rope().fix(At::Start).build().unwrap();
    let mut sum = Vector3::new(0.0, -9.81 * 0.3 * 1.5, 0.0);
    for (at, own) in &springs {
        let s = sprung.arc_length(*at).unwrap();
        let force = -own.gradient(&sprung.sample(s).unwrap().position);
        loaded.add_load(PointLoad::force(s, force)).unwrap();
        sum += force;
    }
    loaded.equilibrium().unwrap();
    let apart = (0..7).map(|node| (sprung.node_position(node) - loaded.node_position(node)).norm()).fold(0.0, f64::max);
    let reaction = sprung.reactions().unwrap()[0].force;
    println!("apart {apart:.1e} m, unbalanced {:.1e} N", (sum + reaction).norm());
    assert!(apart < 1e-8 && (sum + reaction).norm() < 1e-6 * reaction.norm());
}

/// A rope that hangs on springs alone comes to rest, by itself and on an island: they carry its
/// weight. Without them it is not held.
///
/// *Source.* Balance of forces.
#[test]
fn springs_alone_hold_a_rope() {
    let springs = [(At::Start, spring(30.0, [0.0, 0.5, 0.0])), (At::End, spring(80.0, [1.2, 0.6, 0.2]))];
    let weight = 9.81 * 0.3 * 1.5;
    let mut alone = rope().build().unwrap();
    assert!(matches!(alone.equilibrium(), Err(Error::NoEquilibrium { failure: EquilibriumFailure::NotHeld, .. })));
    springs.iter().for_each(|(at, own)| alone.add_potential(*at, own.clone()).unwrap());
    let mut on_island = alone.clone();
    alone.equilibrium().unwrap();
    island::equilibrium(&mut [&mut on_island], &mut [], Links::default(), EquilibriumOptions::default()).unwrap();
    for cable in [&alone, &on_island] {
        let pulls = springs.iter().map(|(at, own)| {
            let s = cable.arc_length(*at).unwrap();
            -own.gradient(&cable.sample(s).unwrap().position)
        });
        let missed = (pulls.sum::<Vector3<f64>>() - Vector3::new(0.0, weight, 0.0)).norm();
        println!("unbalanced {missed:.1e} N");
        assert!(missed < 1e-6 * weight);
    }
}

/// The energy law closes with the energies of springs in it, at the steps of games and far beyond, whatever their stiffness.
///
/// *Source.* The energy law of the method.
#[test]
fn motion_keeps_the_energy_law() {
    for (stiffness, h) in [(5.0, 1.0 / 240.0), (300.0, 1.0 / 60.0), (3e4, 1.0 / 30.0)] {
        let control = StepControl::MaxStep(h);
        let mut cable = rope().fix(At::Start).integrator(Integrator { control, ..game() }).build().unwrap();
        cable.add_potential(At::End, spring(stiffness, [1.0, 0.5, 0.3])).unwrap();
        cable.add_potential(At::ArcLength(0.7), spring(0.3 * stiffness, [0.7, -0.4, 0.0])).unwrap();
        let (start, mut size) = account(&[&cable], &[]);
        for _ in 0..90 {
            cable.step(1.0 / 30.0).unwrap();
            let (now, held) = account(&[&cable], &[]);
            size = held.max(size);
            let made = now - start;
            assert!(made.abs() < 1e-8 * size, "{stiffness} N/m, {h} s: {made:.1e} of {size} J");
        }
        // steps that were divided have lost of what the method held
        assert_eq!(cable.energy_law().shortened > 0.0, cable.diagnostics().split_steps > 0);
        assert!(cable.energy_law().made <= 1e-9 * size);
        assert!(stiffness > 100.0 || cable.diagnostics().split_steps == 0);
    }
}

/// A rope with a spring moves as with an error-controlled method of another family.
///
/// *Source.* ESDIRK4 at a tolerance of 1e-8 m, and the conservation of energy; order 2 of the discrete gradient.
#[test]
fn methods_agree() {
    let run = |integrator: Integrator| {
        let mut cable = rope().fix(At::Start).integrator(integrator).build().unwrap();
        cable.add_potential(At::End, spring(20.0, [1.6, 0.0, 0.2])).unwrap();
        let start = cable.energy().total();
        (0..30).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        (cable.node_position(6), cable.energy().total() - start)
    };
    let (exact, made) = run(Integrator::tolerance(Method::Esdirk4, 1e-8).unwrap());
    assert!(made.abs() < 1e-5, "{made:e} J");
    let error = |substeps| (run(Integrator::substeps(Method::DiscreteGradient, substeps).unwrap()).0 - exact).norm();
    let (coarse, fine) = (error(16), error(32));
    println!("{coarse:.1e} m, {fine:.1e} m");
    assert!(fine < 1e-3 && fine < 0.35 * coarse);
}

/// A rope between two free bodies with a spring at its middle keeps the energy law of all, and gains the momentum of the spring.
///
/// *Source.* The energy law; momentum theorem, the force of the spring at the middle of short steps.
#[test]
fn an_island_knows_it() {
    let mut cable = rope().gravity(Vector3::zeros()).integrator(game()).build().unwrap();
    let own = spring(30.0, [0.75, 0.6, 0.2]);
    cable.add_potential(At::ArcLength(0.75), own.clone()).unwrap();
    let pins = [(At::Start, 0), (At::End, 1)].map(|(at, body)| {
        let node = cable.attach(at).unwrap();
        PinConstraint { cable: 0, node, body, anchor: Vector3::zeros(), direction: None }
    });
    let body = |x: f64| RigidBody::new(0.5, Matrix3::identity() * 1e-3, Vector3::new(x, 0.0, 0.0)).unwrap();
    let (mut bodies, mut island) = ([body(0.0), body(1.5)], Island::default());
    let momentum = |cable: &Cable, bodies: &[RigidBody]| {
        bodies.iter().fold(cable.momentum().linear, |sum, body| sum + body.mass * body.velocity)
    };
    let ((start, mut size), mut given) = (account(&[&cable], &bodies), Vector3::zeros());
    for _ in 0..480 {
        let before = cable.sample(0.75).unwrap().position;
        island.step(&mut [&mut cable], &mut bodies, &pins, game(), 1.0 / 240.0).unwrap();
        given -= own.gradient(&(0.5 * (before + cable.sample(0.75).unwrap().position))) / 240.0;
        let (now, held) = account(&[&cable], &bodies);
        size = held.max(size);
        assert!((now - start).abs() < 1e-8 * size, "{:.1e} of {size} J", now - start);
    }
    let gained = momentum(&cable, &bodies);
    assert!((gained - given).norm() < 1e-3 * given.norm().max(1.0), "{gained} {given}");
}

/// A rope on the floor that a spring lifts and drags keeps the energy law beside contact and friction, where steps are divided, too.
///
/// *Source.* The energy law.
#[test]
fn contact_goes_with_it() {
    let contact = Contact::with_friction(0.4).with_radius(0.01);
    let start = Vector3::new(0.0, 0.01, 0.0);
    let mut cable = rope()
        .points([start, start + Vector3::new(1.5, 0.0, 0.0)])
        .effects(Effects { contact: Some(contact), ..Effects::default() })
        .integrator(game())
        .build()
        .unwrap();
    cable.set_obstacles([Obstacle::new(1, HalfSpace { normal: Vector3::y() }, Vector3::zeros(), 0.4)]).unwrap();
    cable.add_potential(At::ArcLength(0.6), spring(6.0, [1.4, 0.6, 0.5])).unwrap();
    let (mut last, mut size) = account(&[&cable], &[]);
    for _ in 0..480 {
        cable.step(1.0 / 240.0).unwrap();
        let (now, held) = account(&[&cable], &[]);
        size = held.max(size);
        assert!((now - last).abs() < 1e-8 * size, "{:.1e} of {size} J", now - last);
        last = now;
    }
    assert!(cable.energy_law().contacts > 1e-3 && cable.sample(0.6).unwrap().position.y > 0.05);
}

/// A cable that was read back refuses to step until its potential is added again, then it goes on to the bit; a cut leaves it on its part.
///
/// *Source.* The same cable that was not saved.
#[test]
fn it_is_added_again_after_a_file_and_stays_with_its_part() {
    let own = spring(20.0, [1.0, 0.5, 0.3]);
    let mut cable = rope().fix(At::Start).integrator(game()).build().unwrap();
    cable.add_potential(At::ArcLength(1.2), own.clone()).unwrap();
    (0..5).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let mut read: Cable = serde_json::from_str(&serde_json::to_string(&cable).unwrap()).unwrap();
    assert!(matches!(read.step(1.0 / 60.0), Err(Error::MissingForceDensities { count: 1, .. })));
    read.add_potential(At::Start, own).unwrap();
    for cable in [&mut cable, &mut read] {
        (0..5).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    }
    assert_eq!(cable.positions(), read.positions());
    let tail = cable.cut(At::Node(3)).unwrap();
    assert_eq!(cable.potentials().count(), 0);
    let places: Vec<f64> = tail.potentials().collect();
    assert!((places[0] - (1.2 - 0.75)).abs() < 1e-12 && places.len() == 1, "{places:?}");
}

/// With a reel at the start a potential stays with its material, and none is put on the element at the eye.
///
/// *Source.* Its place from the end, which no material enters.
#[test]
fn it_moves_with_the_material_of_a_reel() {
    let mut cable = rope().fix(At::Start).integrator(game()).build().unwrap();
    cable.add_reel(At::Start, Reel::with_rate(0.4)).unwrap();
    assert!(matches!(cable.add_potential(At::ArcLength(0.1), spring(1.0, [0.0; 3])), Err(Error::NotWithReel { .. })));
    cable.add_potential(At::ArcLength(1.2), spring(5.0, [1.0, 0.5, 0.3])).unwrap();
    (0..60).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let place = cable.potentials().next().unwrap();
    assert!(cable.length() > 1.6 && (cable.length() - place - 0.3).abs() < 1e-9, "{} {place}", cable.length());
}
