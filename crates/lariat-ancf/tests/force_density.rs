//! Forces per length written outside the crate: consistent derivatives, energy, statics, errors, cutting, reading back.

mod common;

use common::{Random, implicit, largest_difference, soft_cable};
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{
    At, Cable, CablePoint, Error, ForceDensity, ForceDerivatives, Integrator, LineLoad, Method, StepFailure, Vector3,
};
use nalgebra::{DMatrix, DVector, Matrix3};
use std::sync::Arc;

/// A spring towards a line, viscous in a sheared flow: every argument matters, and no derivative is symmetric.
#[derive(Debug)]
struct Everything {
    /// Whether it gives its derivatives.
    derivatives: bool,
}

impl Everything {
    fn stiffness() -> Matrix3<f64> {
        Matrix3::new(-3.0, 0.5, 0.0, -0.2, -1.0, 0.3, 0.1, 0.0, -2.0)
    }

    fn viscosity() -> Matrix3<f64> {
        Matrix3::new(-0.5, 0.2, 0.0, 0.0, -0.4, 0.1, -0.1, 0.0, -0.6)
    }
}

impl ForceDensity for Everything {
    fn force(&self, at: &CablePoint) -> Vector3<f64> {
        let wave = Vector3::new(at.position.y.sin(), at.arc_length, at.time);
        Self::stiffness() * at.position + Self::viscosity() * at.velocity + wave
    }

    fn depends_on_velocity(&self) -> bool {
        true
    }

    fn derivatives(&self, at: &CablePoint) -> Option<ForceDerivatives> {
        let mut position = Self::stiffness();
        position[(0, 1)] += at.position.y.cos();
        self.derivatives.then(|| ForceDerivatives { position, velocity: Self::viscosity() })
    }
}

/// The potential `strength |r - centre|^4/4` per length.
#[derive(Debug)]
struct Well {
    centre: Vector3<f64>,
    strength: f64,
}

impl Well {
    fn new() -> Arc<Self> {
        Arc::new(Well { centre: Vector3::new(0.4, -0.3, 0.2), strength: 100.0 })
    }

    /// Energy of a cable in the well in J, by Simpson's rule on samples.
    fn energy(&self, cable: &Cable) -> f64 {
        let n = 600;
        let at = |i: usize| {
            let r = cable.sample(cable.length() * i as f64 / n as f64).unwrap().position - self.centre;
            0.25 * self.strength * r.norm_squared().powi(2)
        };
        let weight = |i: usize| if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
        (0..=n).map(|i| weight(i) * at(i)).sum::<f64>() * cable.length() / (3.0 * n as f64)
    }
}

impl ForceDensity for Well {
    fn force(&self, at: &CablePoint) -> Vector3<f64> {
        let away = at.position - self.centre;
        away * (-self.strength * away.norm_squared())
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }
}

/// A constant force, or one that is not a number from a time (s) on.
#[derive(Debug)]
struct Constant {
    force: Vector3<f64>,
    until: f64,
}

impl ForceDensity for Constant {
    fn force(&self, at: &CablePoint) -> Vector3<f64> {
        if at.time > self.until { Vector3::repeat(f64::NAN) } else { self.force }
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }
}

fn constant(force: Vector3<f64>) -> Arc<Constant> {
    Arc::new(Constant { force, until: f64::INFINITY })
}

/// The exact derivatives of the force, and those of the step matrix, are its differences, whether the function gives its derivatives or not.
///
/// # References
///
/// Central differences, Richardson-extrapolated. The step matrix holds the symmetric part of what the force adds.
#[test]
fn derivatives_of_a_force_are_its_differences() {
    for derivatives in [true, false] {
        let mut bare = soft_cable().build().unwrap();
        let mut random = Random::new(3);
        let q: Vec<f64> = bare.positions().iter().map(|x| x + 0.05 * random.next()).collect();
        let v: Vec<f64> = q.iter().map(|_| random.next()).collect();
        bare.set_coordinates(&q, &v).unwrap();
        let mut cable = bare.clone();
        cable.add_force_density(Arc::new(Everything { derivatives })).unwrap();
        let exact = cable.jacobians();
        for (by_velocity, matrix) in [(false, &exact.stiffness), (true, &exact.damping)] {
            let mut expected = DMatrix::zeros(q.len(), q.len());
            for i in 0..q.len() {
                let mut force = |h: f64| {
                    let (mut q, mut v) = (q.clone(), v.clone());
                    if by_velocity {
                        v[i] += h
                    } else {
                        q[i] += h
                    }
                    cable.set_coordinates(&q, &v).unwrap();
                    DVector::from_vec(cable.force())
                };
                let mut central = |h: f64| (force(-h) - force(h)) / (2.0 * h);
                let (coarse, fine) = (central(1e-3), central(5e-4));
                expected.set_column(i, &((4.0 * fine - coarse) / 3.0));
            }
            let error = (matrix - &expected).amax();
            assert!(
                error < 3e-7 * expected.amax() + 1e-8,
                "derivatives {derivatives}, velocity {by_velocity}: {error:e}"
            );
        }
        cable.set_coordinates(&q, &v).unwrap();
        let symmetric = |m: DMatrix<f64>| (&m + m.transpose()) * 0.5;
        let stored = [
            common::dense(&cable.stiffness_matrix()) - common::dense(&bare.stiffness_matrix()),
            common::dense(&cable.damping_matrix()),
        ];
        let added = [exact.stiffness - bare.jacobians().stiffness, exact.damping];
        for (stored, added) in stored.into_iter().zip(added) {
            assert!((stored - symmetric(added.clone())).amax() < 1e-8 * (1.0 + added.amax()));
        }
    }
}

/// A constant force of one's own moves a cable as a line load does, with every method.
///
/// # References
///
/// The run with [`LineLoad`]; three Gauss points integrate its weights exactly.
#[test]
fn a_constant_force_is_a_line_load_for_every_method() {
    let force = Vector3::new(0.3, -0.5, 0.8);
    for method in Method::ALL {
        let builder = soft_cable().fix(At::Start).integrator(Integrator::substeps(method, 20).unwrap());
        let mut expected = builder.clone().build().unwrap();
        expected.add_line_load(LineLoad::uniform(force)).unwrap();
        let mut cable = builder.force_density(constant(force)).build().unwrap();
        for _ in 0..10 {
            expected.step(1.0 / 60.0).unwrap();
            cable.step(1.0 / 60.0).unwrap();
        }
        // Newton's iteration ends within its tolerance in both
        let error = largest_difference(cable.positions(), expected.positions());
        assert!(error < 2e-6, "{method}: {error:e}");
        let work = [cable.effect_work().force_densities, expected.effect_work().line_loads];
        assert!((work[0] - work[1]).abs() < 1e-4 * work[1].abs(), "{method}: {work:?}");
    }
}

/// A cable in a potential well keeps its energy to the error of the method, implicit or explicit, and the work of the well is the change
/// of its potential to the error of three Gauss points.
///
/// # References
///
/// Conservation of energy; the potential integrated on samples. Work reaches 1.6 J.
#[test]
fn a_conservative_force_keeps_the_energy() {
    for (method, substeps, bound) in [
        (Method::Esdirk4, 32, 5e-5),
        (Method::Trapezoid, 160, 2e-4),
        (Method::Verlet, 160, 3e-4),
        (Method::Rkn4, 32, 3e-7),
        (Method::Rkn6, 32, 1e-7),
    ] {
        let well = Well::new();
        let integrator = Integrator::substeps(method, substeps).unwrap();
        let builder = soft_cable().elements(8).fix(At::Start).force_density(well.clone());
        let mut cable = builder.integrator(integrator).build().unwrap();
        let (start, potential) = (cable.energy().total(), well.energy(&cable));
        let mut largest = 0.0f64;
        for _ in 0..30 {
            cable.step(1.0 / 60.0).unwrap();
            let work = cable.effect_work().force_densities;
            let lost = potential - well.energy(&cable);
            assert!((work - lost).abs() < 1e-4, "{method}: work {work:e} J, potential {lost:e} J");
            let drift = cable.energy().total() - work - start;
            assert!(drift.abs() < bound, "{method}: {drift:e} J");
            largest = largest.max(work.abs());
        }
        assert!(largest > 1.5, "{method}: {largest} J");
        assert_eq!(cable.effect_work().total(), cable.effect_work().force_densities);
    }
}

/// Every implicit method keeps its order with a force that depends on everything and gives no derivatives.
///
/// # References
///
/// The method of order 4 with ten times the steps; the order that each method claims.
#[test]
fn implicit_methods_keep_their_order_with_a_force_that_depends_on_everything() {
    let run = |method, substeps| {
        let force = Arc::new(Everything { derivatives: false });
        let builder = soft_cable().fix(At::Start).force_density(force);
        let mut cable = builder.integrator(Integrator::substeps(method, substeps).unwrap()).build().unwrap();
        (0..6).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        cable.positions().to_vec()
    };
    let reference = run(Method::Esdirk4, 640);
    for method in implicit() {
        let [coarse, fine] = [40, 80].map(|substeps| largest_difference(&run(method, substeps), &reference));
        let order = (coarse / fine).log2();
        println!("{method}: {coarse:e} {fine:e}, order {order:.2}");
        assert!(fine < 1e-9 || order > f64::from(method.properties().order) - 0.4, "{method}: {coarse:e} {fine:e}");
        assert!(fine < 1e-3, "{method}: {fine:e}");
    }
}

/// In equilibrium the supports balance weight and force, and the cable is at rest.
///
/// # References
///
/// Static balance.
#[test]
fn statics_balance_a_force_against_the_supports() {
    let force = Vector3::new(0.0, 2.0, 7.0);
    let mut cable = soft_cable().fix(At::Start).fix(At::End).force_density(constant(force)).build().unwrap();
    let report = cable.equilibrium().unwrap();
    let reaction: Vector3<f64> = cable.reactions().unwrap().iter().map(|r| r.force).sum();
    let loads = force * cable.length() + Vector3::new(0.0, -9.81, 0.0);
    assert!((reaction + loads).norm() < 1e-6, "{reaction:?} {loads:?}");
    assert!(report.residual < 1e-7 && cable.speed() == 0.0);
    assert_eq!(cable.effect_work().total(), 0.0);
}

/// A force that becomes NaN fails the step with cable, time and cause; the cable is as before.
///
/// # References
///
/// The contract: a typed error, never a NaN.
#[test]
fn a_force_that_is_not_a_number_is_an_error() {
    for method in [Method::Esdirk4, Method::Rkn4] {
        let force = Arc::new(Constant { force: Vector3::x(), until: 0.05 });
        let integrator = Integrator::substeps(method, 20).unwrap();
        let mut cable = soft_cable().force_density(force).integrator(integrator).build().unwrap();
        (0..3).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        let before = cable.snapshot().clone();
        match cable.step(1.0 / 60.0) {
            Err(Error::StepFailed { cable, time, failure, .. }) => {
                assert_eq!((cable.as_str(), time), ("soft", before_time(&before)), "{method}");
                assert!(matches!(failure, StepFailure::NotFinite { what: "force density", .. }), "{method}: {failure}");
            }
            other => panic!("{method}: {other:?}"),
        }
        assert_eq!(*cable.snapshot(), before, "{method}");
    }
}

fn before_time(snapshot: &lariat_ancf::Snapshot) -> f64 {
    let mut cable = soft_cable().build().unwrap();
    cable.restore(snapshot.clone()).unwrap();
    cable.time()
}

/// Counts of evaluations: none without a function, one per element and force evaluation with one.
///
/// # References
///
/// The counters of the elements.
#[test]
fn evaluations_are_counted() {
    let mut cable = soft_cable().build().unwrap();
    cable.step(0.01).unwrap();
    assert_eq!(cable.diagnostics().effects, Default::default());
    cable.add_force_density(Well::new()).unwrap();
    let before = *cable.diagnostics();
    cable.step(0.01).unwrap();
    let counted = cable.diagnostics().since(&before);
    assert_eq!(counted.effects.force_densities, counted.element_evaluations());
    cable.clear_force_densities().unwrap();
    assert_eq!(cable.force_densities().count(), 0);
}

/// After a cut the force acts on both parts as on the whole: the rest knows where it was.
///
/// # References
///
/// The generalised force of the whole; the nodes at the cut share theirs.
#[test]
fn a_cut_keeps_the_arc_length_of_a_force() {
    let force = Arc::new(Everything { derivatives: false });
    let mut head = soft_cable().force_density(force).build().unwrap();
    let mut whole = head.clone();
    let node = whole.insert_node(0.4).unwrap();
    let mut tail = head.cut(0.4).unwrap();
    let (whole, head, tail) = (whole.force(), head.force(), tail.force());
    assert_eq!(&whole[..6 * node], &head[..6 * node]);
    assert_eq!(whole[6 * node + 6..].len(), tail[6..].len());
    assert!(largest_difference(&whole[6 * node + 6..], &tail[6..]) < 1e-12);
}

/// A cable that was read back refuses to step until its functions are attached again, and then goes on bitwise; a restored snapshot
/// goes on bitwise too.
///
/// # References
///
/// The run that was not interrupted.
#[test]
fn a_run_goes_on_bitwise_after_functions_are_attached_again() {
    let well = Well::new();
    let mut cable = soft_cable().fix(At::Start).force_density(well.clone()).build().unwrap();
    (0..5).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let (text, snapshot) = (serde_json::to_string(&cable).unwrap(), cable.snapshot().clone());
    let mut read: Cable = serde_json::from_str(&text).unwrap();
    (0..5).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let missing = |error: Error| matches!(error, Error::MissingForceDensities { count: 1, .. });
    assert!(missing(read.step(1.0 / 60.0).unwrap_err()));
    assert!(missing(read.equilibrium().unwrap_err()));
    assert_eq!(serde_json::to_string(&read).unwrap(), text);
    read.add_force_density(well).unwrap();
    (0..5).for_each(|_| read.step(1.0 / 60.0).unwrap());
    assert_eq!(read.positions(), cable.positions());
    assert_eq!(read.effect_work(), cable.effect_work());
    let mut restored = cable.clone();
    restored.restore(snapshot).unwrap();
    (0..5).for_each(|_| restored.step(1.0 / 60.0).unwrap());
    assert_eq!(restored.snapshot(), cable.snapshot());
}

/// A cable that is pinned to a body at rest moves in a force field as one with a support does.
///
/// # References
///
/// The cable alone, to Newton's tolerance.
#[test]
fn an_island_carries_a_force() {
    let integrator = Integrator::substeps(Method::Esdirk4, 10).unwrap();
    let mut alone = soft_cable().fix(At::Start).force_density(Well::new()).integrator(integrator).build().unwrap();
    let mut cable = alone.clone();
    let node = cable.attach(At::Start).unwrap();
    let mut body = RigidBody::new(1.0, Matrix3::identity(), cable.node_position(0)).unwrap();
    body.free = [false; 6];
    let pins = [PinConstraint { cable: 0, node, body: 0, anchor: Vector3::zeros(), direction: None }];
    let (mut bodies, mut island) = ([body], Island::default());
    for _ in 0..12 {
        alone.step(1.0 / 60.0).unwrap();
        island.step(&mut [&mut cable], &mut bodies, &pins, integrator, 1.0 / 60.0).unwrap();
    }
    assert!(largest_difference(alone.positions(), cable.positions()) < 1e-6);
}
