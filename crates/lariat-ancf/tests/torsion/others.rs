//! Torsion beside everything else: what goes together, what is refused, and what is warned of.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::{
    At, Cable, CableBuilder, Contact, Damping, Effects, EndSpin, Error, Fidelity, Integrator, Method, Section,
    StepControl, Torsion, Vector3, Warning,
};

fn twisted(turns: f64) -> Torsion {
    Torsion { initial_twist: turns, ..Torsion::new(0.02) }
}

/// A slack cable of 1.1 m over 1 m.
fn slack(torsion: Option<Torsion>) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.5, -0.2, 0.0), Vector3::x()])
        .section(Section::from_stiffness(1e4, 0.03, 0.1).unwrap())
        .elements(8)
        .effects(Effects { torsion, ..Effects::default() })
        .integrator(Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) })
}

fn clamped(torsion: Option<Torsion>) -> CableBuilder {
    slack(torsion).clamp(At::Start).clamp(At::End)
}

fn run(cable: &mut Cable, frames: usize) {
    (0..frames).for_each(|_| cable.step(1.0 / 60.0).unwrap());
}

/// Other methods are refused by name.
///
/// *Source.* The contract.
#[test]
fn what_does_not_carry_torsion_is_refused() {
    for method in [Method::Esdirk3, Method::Midpoint, Method::Verlet] {
        let other = Integrator { method, control: StepControl::MaxStep(1e-3) };
        let error = clamped(Some(twisted(1.0))).integrator(other).build().unwrap_err();
        assert!(matches!(&error, Error::TorsionPlace { .. }), "{error}");
        assert!(error.to_string().contains("discrete-gradient"), "{error}");
    }
}

/// Fidelity engineering steps a cable with torsion, as built or given it later: by the discrete
/// gradient with control of the error. A sagging cable that a motor winds up is off by less than the
/// tolerance of all host steps, and makes no energy.
///
/// *Source.* The same run in 256 steps per host step, to which those in 32 and 64 converge with
/// order 2.
#[test]
fn fidelity_engineering_steps_torsion_within_its_tolerance() {
    let frames = 60;
    let damping = Some(Damping { axial: 2e-3, bending: 5e-2 });
    let motor = EndSpin::Motor { rate: 1.0, from: 0.0, until: 1.0 };
    let effects =
        Effects { torsion: Some(Torsion { damping: 0.05, end: motor, ..twisted(0.0) }), damping, ..Effects::default() };
    let after = |builder: CableBuilder, effects: Option<Effects>| {
        let mut cable = builder.build().unwrap();
        if let Some(effects) = effects {
            cable.set_effects(effects).unwrap();
        }
        cable.equilibrium().unwrap();
        run(&mut cable, frames);
        cable
    };
    let built = || clamped(None).effects(effects.clone()).rule(Fidelity::Engineering.rule());
    let divided = |parts| {
        let integrator = Integrator { control: StepControl::Substeps(parts), ..Integrator::COUPLED };
        after(built().integrator(integrator), None)
    };
    let fine = divided(256);
    let off = |cable: &Cable| {
        let pairs = cable.positions().chunks(6).zip(fine.positions().chunks(6));
        pairs.map(|(a, b)| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()).fold(0.0, f64::max)
    };
    let cable = after(built().fidelity(Fidelity::Engineering), None);
    let apart = [divided(32), divided(64), cable.clone()].map(|cable| off(&cable));
    println!("{apart:?} m off, {:?}", cable.energy_law());
    assert_eq!(cable.integrator(), Integrator::COUPLED);
    assert!(apart[2] < 1e-5 * frames as f64, "{apart:?}");
    assert!(apart[0] / apart[1] > 3.5 && apart[0] < 1e-6, "{apart:?}");
    assert!(cable.torsion()[0].twist > 6.0 && cable.energy_law().made == 0.0, "{:?}", cable.energy_law());
    let later = after(clamped(None).fidelity(Fidelity::Engineering), Some(effects.clone()));
    assert_eq!(later.positions(), cable.positions());
}

/// Numbers that are no stiffness, twist, time or motor are refused.
///
/// *Source.* The contract.
#[test]
fn bad_numbers_are_refused() {
    let motor = |rate, from, until| Torsion { end: EndSpin::Motor { rate, from, until }, ..twisted(0.0) };
    for torsion in [
        Torsion::new(0.0),
        Torsion::new(-1.0),
        Torsion::new(f64::NAN),
        Torsion { initial_twist: f64::INFINITY, ..twisted(0.0) },
        Torsion { damping: -1.0, ..twisted(0.0) },
        motor(f64::NAN, 0.0, 1.0),
        motor(1.0, 2.0, 1.0),
    ] {
        let error = clamped(Some(torsion.clone())).build().unwrap_err();
        assert!(matches!(error, Error::InvalidValue { .. }), "{torsion:?}: {error}");
    }
    assert!(Torsion::round(1.0, 0.6).is_err() && Torsion::round(1.0, -1.0).is_err());
    assert_eq!(Torsion::round(3.0, 0.5).unwrap().stiffness, 2.0);
}

/// Where a ball, a pin or a swivel holds an end, torsion does nothing: the run is that without it,
/// to the bit, no twist is evaluated, and it is warned of.
///
/// *Source.* The contract.
#[test]
fn without_two_holds_torsion_does_nothing_and_says_so() {
    let swivel = Torsion { end: EndSpin::Swivel, ..twisted(2.0) };
    for (builder, torsion) in [(slack as fn(_) -> CableBuilder, twisted(2.0)), (|torsion| clamped(torsion), swivel)] {
        let [with, without] = [Some(torsion), None].map(|torsion| {
            let mut cable = builder(torsion).clamp(At::Start).build().unwrap();
            run(&mut cable, 30);
            cable
        });
        assert_eq!(with.positions(), without.positions());
        assert_eq!(with.diagnostics().effects.torsion, 0);
        assert!(with.torsion().is_empty() && with.energy().torsion == 0.0);
        let told = |cable: &Cable| cable.warnings().iter().any(|w| matches!(w, Warning::IdleTorsion { .. }));
        assert!(told(&with) && !told(&without));
    }
}

/// As GJ goes to zero, the run goes to that without torsion.
///
/// *Source.* The same run without it; the difference is in proportion to GJ.
#[test]
fn a_vanishing_stiffness_gives_the_run_without_torsion() {
    let end = |stiffness: Option<f64>| {
        let torsion = stiffness.map(|stiffness| Torsion { stiffness, ..twisted(0.5) });
        let mut cable = clamped(torsion).build().unwrap();
        run(&mut cable, 20);
        cable.positions().to_vec()
    };
    let without = end(None);
    let off = [1e-4, 1e-5].map(|stiffness| {
        let off = end(Some(stiffness)).iter().zip(&without).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        println!("GJ {stiffness}: {off:.2e} m off");
        off
    });
    assert!(off[1] < 1e-4 && (off[0] / off[1] / 10.0 - 1.0).abs() < 0.2, "{off:?}");
}

/// A cut takes the twist of the part that loses a hold, and leaves that between other holds.
///
/// *Source.* Torque needs two holds.
#[test]
fn a_cut_takes_the_twist_of_its_segment_alone() {
    let mut cable = clamped(Some(twisted(1.0))).build().unwrap();
    cable.clamp(At::Node(4)).unwrap();
    run(&mut cable, 5);
    let before = cable.torsion();
    assert_eq!(before.len(), 2);
    let tail = cable.cut(At::Node(6)).unwrap();
    assert_eq!(cable.torsion().len(), 1);
    assert_eq!(cable.torsion()[0].twist, before[0].twist);
    assert!(tail.torsion().is_empty() && tail.energy().torsion == 0.0);
    run(&mut cable, 5);
}

/// An element that is split leaves the twist of its segment, and the run is nearly that without the
/// split.
///
/// *Source.* The twist belongs to the material; the mesh is fine enough.
#[test]
fn refinement_keeps_the_twist() {
    let [plain, refined] = [false, true].map(|split| {
        let mut cable = clamped(Some(twisted(1.0))).elements(16).build().unwrap();
        run(&mut cable, 10);
        if split {
            let before = cable.torsion()[0];
            cable.insert_node(0.4 * cable.length()).unwrap();
            let after = cable.torsion()[0];
            assert_eq!((before.twist, after.nodes), (after.twist, [0, 17]));
            assert!((after.torque / before.torque - 1.0).abs() < 1e-12);
        }
        run(&mut cable, 10);
        cable.torsion()[0].torque
    });
    assert!((plain / refined - 1.0).abs() < 1e-3, "{plain} {refined}");
}

/// A snapshot in the middle of a run continues it to the bit.
///
/// *Source.* The contract.
#[test]
fn a_snapshot_continues_to_the_bit() {
    let motor = EndSpin::Motor { rate: 1.0, from: 0.1, until: 2.0 };
    let mut cable = clamped(Some(Torsion { end: motor, ..twisted(0.3) })).build().unwrap();
    run(&mut cable, 13);
    let text = serde_json::to_string(&cable.snapshot()).unwrap();
    run(&mut cable, 20);
    let (q, twist) = (cable.positions().to_vec(), cable.torsion()[0].twist);
    cable.restore(serde_json::from_str(&text).unwrap()).unwrap();
    run(&mut cable, 20);
    assert_eq!((cable.positions(), cable.torsion()[0].twist), (&q[..], twist));
}

/// A cable that a motor winds up on itself, with contact: the law closes with the motor's work and
/// the heat of contacts, and it is never made.
///
/// *Source.* The energy law.
#[test]
fn a_wound_up_cable_that_touches_itself_keeps_its_energy_law() {
    let spin = EndSpin::Motor { rate: 2.0, from: 0.0, until: 3.0 };
    let contact = Contact { radius: Some(0.008), itself: true, ..Contact::default() };
    let effects = Effects {
        torsion: Some(Torsion { end: spin, damping: 0.01, ..Torsion::new(0.02) }),
        contact: Some(contact),
        ..Effects::default()
    };
    let mut cable = clamped(None).elements(24).length(1.3).effects(effects).build().unwrap();
    cable.set_watched(true);
    let total = |cable: &Cable| cable.energy().total() + cable.energy_in_store() + cable.contact_energy();
    let start = total(&cable);
    for frame in 0..150 {
        cable.step(1.0 / 60.0).unwrap_or_else(|error| panic!("frame {frame}: {error}"));
    }
    let law = *cable.energy_law();
    let work = law.supports + cable.effect_work().total();
    let gained = total(&cable) - start;
    println!("{gained} J of {work} J, {law:?}, {:?}, {:?}", cable.torsion(), cable.warnings());
    assert!(gained < work + 1e-6 * law.supports.abs(), "{gained} {work}");
    assert!(law.made <= 1e-6 * law.supports.abs(), "{law:?}");
    assert!(law.supports > 0.05, "{law:?}");
}

/// A torque that the mesh does not resolve is told, and the elements that the warning names are
/// enough.
///
/// *Source.* |M| l/EI of the twist.
#[test]
fn a_mesh_too_coarse_for_its_torque_is_told() {
    let built = |elements: usize| {
        let mut cable = clamped(Some(twisted(4.0))).elements(elements).build().unwrap();
        cable.step(1e-4).unwrap();
        cable.warnings().into_iter().find_map(|warning| match warning {
            Warning::CoarseTwist { enough, ratio, .. } => Some((enough, ratio)),
            _ => None,
        })
    };
    let (enough, ratio) = built(5).unwrap();
    let torque = 0.02 * 8.0 * std::f64::consts::PI / clamped(None).build().unwrap().length();
    let exact = torque * clamped(None).build().unwrap().length() / 5.0 / 0.03;
    assert!((ratio / exact - 1.0).abs() < 0.05, "{ratio} {exact}");
    assert_eq!(built(enough), None, "{enough}");
}

/// The line that is painted along a straight cable turns by an even share of its twist, from the
/// first clamp on, which a motor turns; of a slack one it comes to the director of the last clamp.
/// Beside clamps there is none.
///
/// *Source.* A uniform twist; the last clamp stands still.
#[test]
fn a_painted_line_shows_the_twist() {
    let straight = |torsion| {
        slack(torsion)
            .points([Vector3::zeros(), Vector3::x()])
            .gravity(Vector3::zeros())
            .clamp(At::Start)
            .clamp(At::End)
    };
    let angle =
        |axis: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>| from.cross(to).dot(axis).atan2(from.dot(to));
    let line = |cable: &Cable, places: &[f64]| -> Vec<Vector3<f64>> {
        cable.stripe(places).unwrap().into_iter().map(Option::unwrap).collect()
    };
    let mut cable = straight(Some(twisted(0.2))).build().unwrap();
    let seen = line(&cable, &[0.0, 0.125, 0.3, 1.0]);
    for (place, direction) in [0.0, 0.125, 0.3, 1.0].into_iter().zip(&seen) {
        let turned = angle(&Vector3::x(), &seen[0], direction);
        assert!((turned - 0.2 * std::f64::consts::TAU * place).abs() < 1e-9 && (direction.norm() - 1.0).abs() < 1e-12);
    }
    let motor = Torsion { start: EndSpin::Motor { rate: 0.25, from: 0.0, until: 1.0 }, ..twisted(0.2) };
    cable.set_effects(Effects { torsion: Some(motor), ..Effects::default() }).unwrap();
    run(&mut cable, 60);
    let end = line(&cable, &[0.0, 1.0]);
    assert!((angle(&Vector3::x(), &seen[0], &end[0]) - 0.5 * std::f64::consts::PI).abs() < 1e-9);
    assert!((end[1] - seen[3]).norm() < 1e-9, "the last clamp stands still");
    let mut cable = clamped(Some(twisted(0.2))).build().unwrap();
    let before = line(&cable, &[cable.length()])[0];
    run(&mut cable, 60);
    assert!((line(&cable, &[cable.length()])[0] - before).norm() < 1e-9, "the last clamp stands still");
    let free = slack(Some(twisted(0.2))).clamp(At::Start).build().unwrap();
    assert_eq!(free.stripe(&[0.0, 0.5]).unwrap(), [None, None]);
}
