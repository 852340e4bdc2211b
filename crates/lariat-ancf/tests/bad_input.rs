//! Bad input: typed errors that carry the value and the name of the cable, and the cable is
//! unchanged.

mod common;

use common::pendulum;
use lariat_ancf::integrate::OneStep;
use lariat_ancf::{
    At, Cable, CableBuilder, Drag, Effects, Error, ErrorNorm, Fidelity, Flow, GravityScale, Integrator, Method, Motion,
    PointLoad, Rule, Section, SlopeSupport, StepControl, Support, Vector3,
};

/// Numbers that are never accepted where a positive finite number is needed.
const NOT_POSITIVE: [f64; 5] = [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// Checks that the error is `InvalidValue` with the bad number, in its message too.
fn assert_names<T: std::fmt::Debug>(result: Result<T, Error>, bad: f64, context: &str) {
    let error = result.expect_err(context);
    let Error::InvalidValue { value, .. } = &error else { panic!("{context}: {error}") };
    assert!(*value == bad || value.is_nan() && bad.is_nan(), "{context}: {error}");
    assert!(error.to_string().contains(&bad.to_string()), "{context}: {error}");
}

/// Every number of a section is checked.
///
/// *Source.* The contract: errors carry the value.
#[test]
fn sections_reject_numbers_that_are_not_positive_and_finite() {
    for bad in NOT_POSITIVE {
        assert_names(Section::round(bad, 1e9, 1e3), bad, "diameter");
        assert_names(Section::square(bad, 1e9, 1e3), bad, "side");
        assert_names(Section::tube(bad, 0.0, 1e9, 1e3), bad, "outer diameter");
        assert_names(Section::round(0.01, bad, 1e3), bad, "modulus");
        assert_names(Section::round(0.01, 1e9, bad), bad, "density");
        assert_names(Section::from_stiffness(bad, 1.0, 1.0), bad, "EA");
        assert_names(Section::from_stiffness(1.0, 1.0, bad), bad, "mass per length");
    }
    assert!(Section::from_stiffness(1.0, 0.0, 1.0).is_ok(), "EI may be zero");
    assert_names(Section::from_stiffness(1.0, -1e-3, 1.0), -1e-3, "EI");
    assert_names(Section::tube(0.01, 0.02, 1e9, 1e3), 0.02, "inner diameter above the outer");
    // each number is valid, their product overflows
    assert!(matches!(Section::round(1e200, 1e9, 1e3), Err(Error::InvalidValue { .. })));
}

/// Points, length, elements, section, gravity, velocities and loads are checked.
///
/// *Source.* The contract: errors carry the value.
#[test]
fn builders_reject_descriptions_that_are_not_a_cable() {
    let build = |f: &dyn Fn(CableBuilder) -> CableBuilder| f(pendulum(4)).build();
    let error = |f: &dyn Fn(CableBuilder) -> CableBuilder| build(f).expect_err("not a cable");
    let (x, cable) = (Vector3::x, || "pendulum".to_string());
    assert_eq!(error(&|b| b.points(Vec::<Vector3<f64>>::new())), Error::TooFewPoints { cable: cable(), count: 0 });
    assert_eq!(error(&|b| b.points([x()])), Error::TooFewPoints { cable: cable(), count: 1 });
    assert_eq!(error(&|b| b.points([x(), x()])), Error::CoincidentPoints { cable: cable(), index: 0, point: x() });
    let coincident = Error::CoincidentPoints { cable: cable(), index: 1, point: x() };
    assert_eq!(error(&|b| b.points([Vector3::zeros(), x(), x(), 2.0 * x()])), coincident);
    for count in [0, 1_000_001, usize::MAX] {
        assert_eq!(error(&|b| b.elements(count)), Error::ElementCount { cable: cable(), count, most: 1_000_000 });
    }
    assert_eq!(error(&|b| b.fix(At::Node(2))), Error::NodeBeforeMesh { cable: cable(), node: 2 });
    let bare = Cable::builder().points([Vector3::zeros(), x()]).build().unwrap_err();
    assert_eq!(bare, Error::NoSection { cable: "cable".to_string() });
    for bad in NOT_POSITIVE {
        assert_names(build(&|b| b.length(bad)), bad, "length");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        let v = Vector3::new(0.0, bad, 0.0);
        assert_names(build(&|b| b.points([Vector3::zeros(), v])), bad, "point");
        assert_names(build(&|b| b.gravity(v)), bad, "gravity");
        assert_names(build(&|b| b.velocity(v)), bad, "velocity");
        assert_names(build(&|b| b.angular_velocity(v)), bad, "angular velocity");
        assert_names(build(&|b| b.load(PointLoad::force(1.0, v))), bad, "force");
        assert_names(build(&|b| b.load(PointLoad::moment(1.0, v))), bad, "moment");
    }
}

/// Arc lengths and nodes that are not on the cable are errors, before and after it is built.
///
/// *Source.* The contract: errors carry the value and the limit.
#[test]
fn arc_lengths_off_the_cable_are_errors_with_the_limit() {
    for s in [-0.1, 2.1, f64::NAN, f64::INFINITY] {
        for builder in [
            pendulum(4).fix(s),
            pendulum(4).clamp(s),
            pendulum(4).node_at(s),
            pendulum(4).load(PointLoad::force(s, Vector3::x())),
            pendulum(4).section_from(s, Section::round(0.01, 1e9, 1e3).unwrap()),
        ] {
            let error = builder.build().expect_err("off the cable");
            let Error::OutOfRange { value, limit, .. } = error else { panic!("{s}: {error}") };
            assert!((value == s || s.is_nan()) && limit == 2.0);
        }
        let mut cable = pendulum(4).build().unwrap();
        assert!(matches!(cable.sample(s), Err(Error::OutOfRange { limit: 2.0, .. })), "{s}");
        assert!(matches!(cable.node(s), Err(Error::OutOfRange { .. })), "{s}");
        assert!(matches!(cable.add_load(PointLoad::force(s, Vector3::x())), Err(Error::OutOfRange { .. })), "{s}");
    }
    let mut cable = pendulum(4).build().unwrap();
    assert!(matches!(cable.fix(At::Node(5)), Err(Error::OutOfRange { value: 5.0, limit: 4.0, .. })));
    let no_node = Error::NoNode { cable: "pendulum".to_string(), arc_length: 0.3, nearest: 0.5 };
    assert_eq!(cable.fix(0.3), Err(no_node));
}

/// Unknown names, rank deficient rules and step controls that a method does not support are errors.
///
/// *Source.* The contract: the error carries what was given and what is accepted.
#[test]
fn unknown_and_unsuitable_rules_and_integrators_are_errors() {
    let error = "G3-99".parse::<Rule>().unwrap_err();
    assert!(matches!(&error, Error::UnknownRule { rule, .. } if rule == "G3-99"), "{error}");
    assert!(matches!(Rule::gauss(0, 3), Err(Error::UnknownRule { .. })));
    let error = "euler".parse::<Method>().unwrap_err();
    assert!(error.to_string().contains("esdirk3"), "{error}");
    assert!(matches!(&error, Error::UnknownIntegrator { name, suggestion: None, .. } if name == "euler"), "{error}");
    assert_names("generalised-alpha-1.5".parse::<Method>(), 1.5, "rho");
    assert!("generalised-alpha-NaN".parse::<Method>().is_err());
    for name in ["G2-2", "mean-3", "G1-none", "projected-1"] {
        let rule = common::rule(name);
        let error = pendulum(4).rule(rule).build().unwrap_err();
        assert!(matches!(&error, Error::RankDeficient { rule, .. } if rule == name), "{error}");
        assert!(pendulum(4).rule(rule).allow_rank_deficient().build().is_ok());
    }
    for method in Method::ALL {
        let (estimates, explicit) = (method.properties().estimate_order.is_some(), !method.properties().implicit);
        assert_eq!(Integrator::tolerance(method, 1e-5).is_ok(), estimates, "{method}");
        assert_eq!(Integrator { method, control: StepControl::Stable(0.5) }.checked().is_ok(), explicit, "{method}");
        assert!(matches!(Integrator::substeps(method, 0), Err(Error::InvalidValue { .. })));
    }
    for bad in NOT_POSITIVE {
        assert_names(Integrator::tolerance(Method::Esdirk3, bad), bad, "tolerance");
        assert_names(
            Integrator { method: Method::Verlet, control: StepControl::MaxStep(bad) }.checked(),
            bad,
            "max step",
        );
        assert_names(Integrator { method: Method::Verlet, control: StepControl::Stable(bad) }.checked(), bad, "share");
    }
    assert_names(Integrator { method: Method::Verlet, control: StepControl::Stable(1.5) }.checked(), 1.5, "share");
    let alpha = Method::GeneralisedAlpha { rho: -0.1 };
    assert_names(Integrator::substeps(alpha, 1), -0.1, "rho");
    // a builder checks its integrator too
    let verlet = Integrator { method: Method::Verlet, control: StepControl::Tolerance(1e-3) };
    assert_eq!(
        pendulum(4).integrator(verlet).build().err(),
        Some(Error::NoErrorEstimate { method: "verlet".to_string() })
    );
    // a norm that the estimate of the method does not have is refused, not ignored
    let method = Method::DiscreteGradientWith { dissipation: 1.0 / 256.0 };
    for norm in ErrorNorm::ALL {
        let checked = Integrator { method, control: StepControl::ToleranceOf(1e-4, norm) }.checked();
        let refused = Error::NoErrorNorm { method: method.name(), norm: norm.name() };
        assert_eq!(checked.err(), (norm != ErrorNorm::Bodies).then_some(refused));
    }
}

/// Bad numbers given to a built cable are errors that carry them and the cable's name, and change
/// nothing.
///
/// *Source.* The contract: no error loses the last good state.
#[test]
fn bad_numbers_leave_a_built_cable_unchanged() {
    let mut cable = pendulum(4).build().unwrap();
    cable.step(0.01).unwrap();
    let before = cable.snapshot().clone();
    for bad in [-1e-3, f64::NAN, f64::INFINITY, 5e-324] {
        assert_names(cable.step(bad), bad, "dt");
    }
    let (q, v) = (cable.positions().to_vec(), cable.velocities().to_vec());
    let mut broken = q.clone();
    broken[7] = f64::NAN;
    assert_names(cable.set_coordinates(&broken, &v), f64::NAN, "coordinate");
    let short = Error::WrongCount { cable: "pendulum".to_string(), what: "coordinates", count: 29, expected: 30 };
    assert_eq!(cable.set_coordinates(&q[1..], &v), Err(short));
    let support = |position, slope| Support { position, slope, ..Support::default() };
    let nan = Motion::fixed(Vector3::new(0.0, f64::NAN, 0.0));
    assert!(cable.set_support(At::End, support(Some(nan), SlopeSupport::Free)).is_err());
    assert!(cable.set_support(At::End, support(None, SlopeSupport::Prescribed(nan))).is_err());
    let long = SlopeSupport::Direction(Vector3::new(2.0, 0.0, 0.0));
    assert_names(cable.set_support(At::End, support(None, long)), 2.0, "direction");
    assert!(cable.set_support(At::End, support(None, SlopeSupport::Direction(Vector3::zeros()))).is_err());
    let ramp = PointLoad { ramp: -1.0, ..PointLoad::force(1.0, Vector3::x()) };
    assert_names(cable.add_load(ramp), -1.0, "ramp");
    assert_eq!(*cable.snapshot(), before);
    assert!(cable.loads().is_empty() && cable.support(At::End).unwrap().is_free());
    cable.step(0.01).unwrap();
}

/// The error of a misspelt name proposes the nearest one; a name that is near none proposes none.
///
/// *Source.* One letter changed, missing, added or exchanged.
#[test]
fn misspelt_names_are_answered_with_the_nearest_name() {
    for (text, near) in
        [("esdirc4", "esdirk4"), ("tr-bdf", "tr-bdf2"), ("trapezoidal", "trapezoid"), ("Verlett", "verlet")]
    {
        let error = text.parse::<Method>().unwrap_err();
        assert!(matches!(&error, Error::UnknownIntegrator { suggestion: Some(s), .. } if s == near), "{error}");
        assert!(error.to_string().contains(&format!("did you mean {near:?}?")), "{error}");
    }
    for (text, near) in [("G5_3", "G5-3"), ("ST22", "ST2"), ("projected3", "projected-3"), ("exact-non", "exact-none")]
    {
        let error = text.parse::<Rule>().unwrap_err();
        assert!(matches!(&error, Error::UnknownRule { suggestion: Some(s), .. } if s == near), "{error}");
    }
    let error = "engneering".parse::<Fidelity>().unwrap_err();
    let suggestion = Some("engineering".to_string());
    assert_eq!(error, Error::UnknownFidelity { name: "engneering".to_string(), suggestion });
    let error = "rk4 of Kutta".parse::<Fidelity>().unwrap_err();
    assert!(matches!(error, Error::UnknownFidelity { suggestion: None, .. }), "{error}");
}

/// An error about a number of a cable carries the cable's name.
///
/// *Source.* The contract.
#[test]
fn errors_about_numbers_of_a_cable_carry_its_name() {
    let nan = Vector3::new(f64::NAN, 0.0, 0.0);
    let mut cable = pendulum(4).build().unwrap();
    let drag = Drag::new(-1.0, 1.0, 0.1, Flow::default());
    let support = Support { position: Some(Motion::fixed(nan)), ..Support::default() };
    for error in [
        pendulum(4).length(-1.0).build().err(),
        pendulum(4)
            .effects(Effects { gravity_scale: Some(GravityScale(f64::NAN)), ..Effects::default() })
            .build()
            .err(),
        cable.step(-1.0).err(),
        cable.set_gravity(nan).err(),
        cable.set_drag(drag).err(),
        cable.add_load(PointLoad::force(1.0, nan)).err(),
        cable.set_support(At::End, support).err(),
    ] {
        let error = error.expect("a bad number");
        assert!(matches!(&error, Error::InvalidValue { cable: Some(name), .. } if name == "pendulum"), "{error:?}");
        assert!(error.to_string().starts_with("cable \"pendulum\": "), "{error}");
    }
}

/// Presets and their integrators are always valid.
///
/// *Source.* Their own checks, for any frequency.
#[test]
fn presets_give_valid_integrators() {
    for fidelity in [Fidelity::Game, Fidelity::Engineering, Fidelity::Reference] {
        for frequency in [0.0, 1.0, 1e5, 1e9, f64::INFINITY] {
            assert!(fidelity.integrator(frequency).checked().is_ok(), "{fidelity:?}, {frequency}");
        }
    }
}
