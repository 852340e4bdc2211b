//! Torsion by methods that evaluate forces: Runge-Kutta, Newmark, explicit ones.

use super::motion::random;
use core::f64::consts::TAU;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{
    At, Cable, CableBuilder, Effects, EndSpin, Error, Integrator, Method, Reel, Section, SlopeSupport, StepControl,
    StepFailure, Support, Torsion, Vector3,
};
use nalgebra::{Rotation3, Unit};

/// A slack cable of 1.1 m over 1 m, soft in its axis, that is let go with a turn and a half of
/// twist.
fn let_go(torsion: Torsion, integrator: Integrator) -> CableBuilder {
    let torsion = Some(Torsion { initial_twist: 1.5, ..torsion });
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.5, -0.2, 0.1), Vector3::x()])
        .section(Section::from_stiffness(200.0, 0.03, 0.1).unwrap())
        .elements(8)
        .effects(Effects { torsion, ..Effects::default() })
        .integrator(integrator)
        .clamp(At::Start)
        .clamp(At::End)
}

/// The same that a motor winds up.
fn wound_up(damping: f64, integrator: Integrator) -> Cable {
    let end = EndSpin::Motor { rate: 2.0, from: 0.0, until: 10.0 };
    let_go(Torsion { damping, end, ..Torsion::new(0.02) }, integrator).build().unwrap()
}

/// Coordinates and twist after 0.1 s.
fn after(damping: f64, method: Method, substeps: u32) -> Vec<f64> {
    let mut cable = wound_up(damping, Integrator { method, control: StepControl::Substeps(substeps) });
    (0..6).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let reading = cable.torsion()[0];
    cable.positions().iter().copied().chain([reading.twist, reading.torque]).collect()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// All methods keep their orders, with and without damping of the twist, and come to the run of the
/// discrete gradient.
///
/// *Source.* The orders of the methods; the discrete gradient, whose torsion is other code.
#[test]
fn methods_keep_their_orders() {
    for (damping, methods) in [
        (0.0, &[Method::Verlet, Method::Rkn4, Method::Rkn6][..]),
        (0.0, &[Method::Midpoint, Method::Trapezoid, Method::GeneralisedAlpha { rho: 0.5 }, Method::TrBdf2]),
        (0.0, &[Method::Esdirk3, Method::Esdirk4]),
        (0.02, &[Method::Trapezoid, Method::TrBdf2, Method::Esdirk3, Method::Esdirk4]),
    ] {
        let finest =
            if damping > 0.0 { after(damping, Method::Esdirk4, 512) } else { after(damping, Method::Rkn6, 96) };
        for method in methods {
            let order = f64::from(method.properties().order);
            let coarse = [256, 64, 24][order as usize / 2 - 1];
            let [first, second] = [coarse, 2 * coarse].map(|n| apart(&after(damping, *method, n), &finest));
            let measured = (first / second).log2();
            println!("{method}, damping {damping} s: {first:.2e}, {second:.2e}, order {measured:.2}");
            assert!(measured > order - 0.25 && second < 1e-3, "{method}: {first:e}, {second:e}: order {measured}");
        }
        let gradient = |n| after(damping, Method::DiscreteGradient, n);
        let [first, second] = [gradient(256), gradient(512)].map(|run| apart(&run, &finest));
        println!("discrete gradient: {first:.2e}, {second:.2e}");
        assert!(second < 1e-3 && first / second > 3.5, "{first:e}, {second:e}");
    }
}

/// The energy that the motor gives and the damping of the twist takes is all that changes that of
/// the cable, in the limit of short steps.
///
/// *Source.* Conservation of energy.
#[test]
fn work_of_motors_and_of_damping_closes_the_account() {
    for damping in [0.0, 0.02] {
        for (method, order) in [(Method::Trapezoid, 2.0), (Method::Esdirk4, 4.0)] {
            let open = |substeps| {
                let mut cable = wound_up(damping, Integrator { method, control: StepControl::Substeps(substeps) });
                let start = cable.energy().total();
                (0..6).for_each(|_| cable.step(1.0 / 60.0).unwrap());
                let (given, taken) = (cable.energy_law().supports, -cable.effect_work().torsion);
                assert!(given > 0.1 && (taken > 1e-3) == (damping > 0.0), "{given} J, {taken} J");
                (cable.energy().total() - start - given + taken).abs()
            };
            let [first, second] = [64, 128].map(open);
            println!("{method}, damping {damping} s: {first:.2e} J, {second:.2e} J");
            assert!(second < 1e-3 && (first / second).log2() > order - 0.5, "{method}: {first:e}, {second:e}");
        }
    }
}

/// The step below which explicit methods are stable knows of torsion: on thrown cables with up to
/// 40 turns, GJ above and below EI, it is never longer than that of the largest frequency there is.
///
/// *Source.* The eigenvalues of stiffness and mass, stable or not.
#[test]
fn the_bound_of_frequencies_has_torsion_in_it() {
    let mut next = random(3);
    let (mut closest, mut raised) = (f64::INFINITY, 0);
    for run in 0..60 {
        let stiffness = 0.03 * 10f64.powf(next());
        let torsion = Torsion { initial_twist: 40.0 * next(), ..Torsion::new(stiffness) };
        let verlet = Integrator { method: Method::Verlet, control: StepControl::Substeps(1) };
        let mut cable = let_go(torsion, verlet).build().unwrap();
        let q: Vec<f64> =
            (0..54).map(|i| cable.positions()[i] + if (6..48).contains(&i) { 0.02 * next() } else { 0.0 }).collect();
        cable.set_coordinates(&q, &[0.0; 54]).unwrap();
        let largest = cable.natural_frequencies().into_iter().fold(0.0, f64::max);
        let bound = cable.frequency_bound();
        let Err(Error::StepFailed { failure: StepFailure::Unstable { limit, .. }, .. }) = cable.step(1.0) else {
            panic!("run {run}: stepped")
        };
        assert!((limit * bound / 2.1 - 1.0).abs() < 1e-9, "run {run}: {limit} s, {bound} rad/s");
        assert!(bound > largest, "run {run}: {bound} of {largest} rad/s");
        closest = closest.min(bound / largest);
        raised += usize::from(bound > 1.05 * let_go(Torsion::new(1e-12), verlet).build().unwrap().frequency_bound());
    }
    println!("{closest:.2} times the largest frequency, {raised} raised");
    assert!(raised > 10);
}

/// An explicit method at nine tenths of that step keeps the energy of a cable that writhes.
///
/// *Source.* Conservation of energy.
#[test]
fn explicit_methods_are_stable_with_torsion() {
    for method in [Method::Verlet, Method::Rkn4] {
        let mut cable =
            let_go(Torsion::new(0.06), Integrator { method, control: StepControl::Stable(0.9) }).build().unwrap();
        let start = cable.energy().total();
        (0..60).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        let off = (cable.energy().total() - start) / start;
        println!("{method}: {off:.2e}, {:?}", cable.energy());
        assert!(off.abs() < 0.02, "{method}: {off:e}");
    }
}

/// Between two steps a clamp turns about any axis, and a motor turns in them: the slope is held
/// where the clamp is, and the twist is that by which the director of the first clamp comes to that
/// of the last, which goes along great circles and with the motor. A snapshot continues to the bit.
///
/// *Source.* The contract of supports and of snapshots.
#[test]
fn the_twist_follows_clamps_that_turn() {
    for method in [Method::DiscreteGradient, Method::Esdirk4, Method::Trapezoid, Method::Rkn4] {
        let mut cable = wound_up(0.0, Integrator { method, control: StepControl::Substeps(128) });
        cable.step(1.0 / 60.0).unwrap();
        let end = cable.length();
        let mut director = cable.stripe(&[end]).unwrap()[0].unwrap();
        for frame in 0..6 {
            let support = cable.support(At::End).unwrap();
            let SlopeSupport::Direction(direction) = support.slope else { panic!("{support:?}") };
            let turned = Rotation3::new(Vector3::new(0.03, -0.06, 0.09)) * direction;
            cable.set_support(At::End, Support { slope: SlopeSupport::Direction(turned), ..support }).unwrap();
            let saved = cable.clone();
            cable.step(1.0 / 60.0).unwrap();
            if frame == 3 {
                let mut twin = saved.clone();
                twin.step(0.01).unwrap();
                twin.restore(saved.snapshot().clone()).unwrap();
                twin.step(1.0 / 60.0).unwrap();
                assert_eq!(twin.snapshot(), cable.snapshot());
            }
            let turn = Rotation3::rotation_between(&direction, &turned).unwrap();
            let spun = Rotation3::from_axis_angle(&Unit::new_normalize(turned), TAU * 2.0 / 60.0);
            director = spun * (turn * director);
            let seen = cable.stripe(&[end]).unwrap()[0].unwrap();
            let slope = cable.sample(end).unwrap().slope.normalize();
            assert!((slope - turned).norm() < 1e-12, "{method}, frame {frame}: {slope:?} {turned:?}");
            assert!((seen - director).norm() < 1e-9, "{method}, frame {frame}: {seen:?} {director:?}");
        }
        assert_eq!(cable.diagnostics().twist_slips, 0);
    }
}

/// With a reel, and on bodies, other methods are refused by name.
///
/// *Source.* The contract.
#[test]
fn reels_and_bodies_refuse_other_methods() {
    let esdirk = || Integrator { method: Method::Esdirk4, control: StepControl::Tolerance(1e-5) };
    let refused = |error: Error| {
        assert!(matches!(&error, Error::TorsionPlace { .. }), "{error}");
        assert!(error.to_string().contains("esdirk4") && error.to_string().contains("discrete-gradient"), "{error}");
    };
    let mut cable = let_go(Torsion::new(0.02), esdirk()).build().unwrap();
    refused(cable.add_reel(At::End, Reel { acceleration: 4.0, ..Reel::default() }).unwrap_err());
    let damped = Torsion { damping: 0.1, ..Torsion::new(0.02) };
    let verlet = Integrator { method: Method::Verlet, control: StepControl::Stable(0.5) };
    assert!(matches!(let_go(damped, verlet).build(), Err(Error::ExplicitDamping { .. })));
}
