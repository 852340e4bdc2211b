//! Motors that turn an end by a course, and what is told of holds that were lost.

use super::rod;
use lariat_ancf::{
    At, Cable, Effects, EndSpin, EquilibriumFailure, Error, Fidelity, Section, SlopeSupport, Support, Torsion, Vector3,
    Warning,
};
use nalgebra::{Rotation3, Unit};
use std::f64::consts::TAU;

const STIFFNESS: f64 = 0.02; // GJ in N m^2

fn by(end: EndSpin) -> Torsion {
    Torsion { end, damping: 0.1, ..Torsion::new(STIFFNESS) }
}

/// A motor whose course is a parabola twists the cable by that parabola, to rounding, and holds
/// behind the last row; damping takes what the rate of the twist makes it take.
///
/// *Source.* Phi = 2 pi t^2/8; the loss is GJ tau/L times the integral of the rate 2 pi t/4 squared,
/// (2 pi)^2/16 T^3/3, of which steps of h leave out h^2/4T^2.
#[test]
fn a_motor_turns_an_end_by_its_course() {
    let rows = [0.0, 0.5, 1.1, 2.0].map(|t: f64| [t, t * t / 8.0]);
    let mut cable = rod(by(EndSpin::Course(rows.to_vec()))).build().unwrap();
    let (twist, steps) = (|t: f64| TAU * t * t / 8.0, 120);
    for k in 1..=steps {
        cable.step(1.0 / 60.0).unwrap();
        let (own, exact) = (cable.torsion()[0].twist, twist(f64::from(k) / 60.0));
        assert!((own - exact).abs() < 1e-12, "{k}: {own} {exact}");
    }
    let lost = -cable.effect_work().torsion;
    let exact = STIFFNESS * 0.1 * TAU * TAU / 16.0 * 8.0 / 3.0;
    println!("{lost} of {exact} J");
    assert!((lost / exact - 1.0).abs() < 1e-4, "{lost} {exact}");
    (0..30).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    assert!((cable.torsion()[0].twist - twist(2.0)).abs() < 1e-12);
}

/// Two rows are a constant rate: the run is that of such a motor.
///
/// *Source.* The same run by `EndSpin::Motor`; the angles differ by rounding.
#[test]
fn a_course_of_two_rows_is_a_motor_of_constant_rate() {
    let end = |spin: EndSpin| {
        let mut cable = rod(by(spin)).build().unwrap();
        (0..90).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        (cable.torsion()[0].twist, cable.torsion()[0].torque)
    };
    let course = end(EndSpin::Course(vec![[0.25, 1.0], [1.25, 1.5]]));
    let motor = end(EndSpin::Motor { rate: 0.5, from: 0.25, until: 1.25 });
    assert!((course.0 - motor.0).abs() < 1e-12 && (course.0 - 0.5 * TAU).abs() < 1e-12, "{course:?} {motor:?}");
}

/// A snapshot in the middle of a course continues bitwise.
///
/// *Source.* The contract.
#[test]
fn a_course_is_part_of_the_description() {
    let rows = vec![[0.0, 0.0], [0.5, 0.3], [1.0, -0.2], [2.0, 0.4]];
    let mut cable = rod(by(EndSpin::Course(rows))).build().unwrap();
    (0..40).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let snapshot = cable.snapshot().clone();
    let end = |cable: &mut Cable| {
        (0..60).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        (cable.torsion()[0].twist, cable.positions().to_vec())
    };
    let one = end(&mut cable);
    cable.restore(snapshot).unwrap();
    assert_eq!(end(&mut cable), one);
}

/// Courses that are none are refused.
///
/// *Source.* The contract.
#[test]
fn courses_that_are_none_are_refused() {
    for rows in [vec![], vec![[0.0, 0.0], [0.0, 1.0]], vec![[1.0, 0.0], [0.5, 1.0]], vec![[0.0, f64::NAN]]] {
        let error = rod(by(EndSpin::Course(rows.clone()))).build().unwrap_err();
        assert!(matches!(error, Error::InvalidValue { .. }), "{rows:?}: {error}");
    }
}

/// A cable that is cut has lost its twist, which is no fault of its description: no part says that
/// its torsion is idle. One that never had two holds says so.
///
/// *Source.* The contract.
#[test]
fn torsion_is_not_idle_because_of_a_cut() {
    let told = |cable: &Cable| cable.warnings().iter().any(|w| matches!(w, Warning::IdleTorsion { .. }));
    let mut cable = rod(Torsion { initial_twist: 0.25, ..Torsion::new(STIFFNESS) }).build().unwrap();
    cable.step(1.0 / 60.0).unwrap();
    let mut tail = cable.cut(0.5).unwrap();
    for part in [&mut cable, &mut tail] {
        part.step(1.0 / 60.0).unwrap();
        assert!(part.torsion().is_empty() && !told(part));
    }
    let mut swivel = rod(by(EndSpin::Swivel)).build().unwrap();
    swivel.step(1.0 / 60.0).unwrap();
    assert!(told(&swivel));
}

/// A clamp that is turned so far that every shape is folded is told as that, with torsion as without.
///
/// *Source.* The failure without torsion; the contract.
#[test]
fn a_folded_shape_is_told_with_torsion_as_without() {
    let mut folded = 0;
    for degrees in [125.0f64, 150.0, 175.0] {
        let failure = |torsion: Option<Torsion>| {
            let mut cable = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(0.5, -0.3, 0.2), Vector3::x()])
                .section(Section::from_stiffness(1e4, 0.02, 0.1).unwrap())
                .elements(8)
                .gravity(Vector3::zeros())
                .effects(Effects { torsion, ..Effects::default() })
                .fidelity(Fidelity::Game)
                .clamp(At::Start)
                .clamp(At::End)
                .build()
                .unwrap();
            cable.equilibrium().unwrap();
            let support = cable.support(At::End).unwrap();
            let SlopeSupport::Direction(direction) = support.slope else { panic!("{support:?}") };
            let axis = Unit::new_normalize(direction.cross(&Vector3::new(0.3, 0.5, -0.7)));
            let turned = Rotation3::from_axis_angle(&axis, degrees.to_radians()) * direction;
            cable.set_support(At::End, Support { slope: SlopeSupport::Direction(turned), ..support }).unwrap();
            match cable.equilibrium() {
                Ok(_) => None,
                Err(Error::NoEquilibrium { failure, .. }) => Some(failure),
                Err(error) => panic!("{error}"),
            }
        };
        let [without, with] = [None, Some(Torsion { initial_twist: 0.5, ..Torsion::new(0.02) })].map(failure);
        println!("{degrees}: {without:?} {with:?}");
        if let Some(EquilibriumFailure::Folded { .. }) = without {
            folded += 1;
            assert!(matches!(with, None | Some(EquilibriumFailure::Folded { .. })), "{degrees}: {with:?}");
        }
    }
    assert!(folded > 0);
}

/// What holds the ends feels the torque of the twist and that of its damping, while the end turns, and that of the twist alone when it
/// stands: at any step, damping and rate.
///
/// *Source.* M = GJ/L (Phi + tau dPhi/dt).
#[test]
fn supports_feel_the_torque_of_damping() {
    for (rate, damping, steps) in [(0.3, 0.1, 100), (1.0, 0.02, 60), (-0.5, 0.5, 30)] {
        let end = EndSpin::Motor { rate, from: 0.0, until: 0.5 };
        let mut cable = rod(Torsion { end, damping, ..Torsion::new(STIFFNESS) }).build().unwrap();
        let dt = 1.0 / f64::from(steps);
        for step in 1..=steps {
            cable.step(dt).unwrap();
            let (time, turns) = (f64::from(step) * dt, std::f64::consts::TAU * rate);
            if (time - 0.5).abs() < 1.5 * dt {
                continue;
            }
            let [twist, speed] = if time < 0.5 { [turns * time, turns] } else { [turns * 0.5, 0.0] };
            let expected = STIFFNESS * (twist + damping * speed);
            let [start, last] = [0, 1].map(|k| cable.reactions().unwrap()[k].moment.x);
            assert!((start + last).abs() < 1e-9, "{start} {last}");
            assert!((last.abs() / expected.abs() - 1.0).abs() < 1e-6, "{time} s: {last} N m of {expected}");
        }
    }
}
