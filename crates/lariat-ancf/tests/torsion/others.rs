//! Torsion beside everything else: what goes together, what is refused, and what is warned of.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::{
    At, Cable, CableBuilder, Contact, Damping, Effects, EndSpin, Error, Fidelity, Integrator, Method, PointLoad,
    Section, StepControl, Torsion, Vector3, Warning,
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

/// Coordinates that a program changes in one call twist the cable as in many along the same great
/// circles; what turns too far is counted, and told.
///
/// *Source.* The area of a geodesic quadrilateral is the sum of those of its parts.
#[test]
fn coordinates_that_are_set_twist_as_in_parts() {
    let mut cable = clamped(Some(twisted(0.5))).build().unwrap();
    run(&mut cable, 20);
    let start = cable.snapshot().clone();
    let q0 = cable.positions().to_vec();
    let vector = |q: &[f64], at: usize| Vector3::new(q[at], q[at + 1], q[at + 2]);
    let length = |e: usize| cable.elements()[e].length;
    let lengths: Vec<f64> = (0..8).map(length).collect();
    // slopes of nodes and of the middles, which positions follow
    let nodes: Vec<Vector3<f64>> = (0..9).map(|n| vector(&q0, 6 * n + 3)).collect();
    let middles: Vec<Vector3<f64>> = (0..8)
        .map(|e| (vector(&q0, 6 * e + 6) - vector(&q0, 6 * e)) * (1.5 / lengths[e]) - (nodes[e] + nodes[e + 1]) * 0.25)
        .collect();
    let axis = Vector3::new(0.1, 0.8, 0.5);
    let turned = |d: &Vector3<f64>, angle: f64| {
        let across = (axis - d * (axis.dot(d) / d.norm_squared())).normalize();
        nalgebra::UnitQuaternion::from_scaled_axis(across * angle) * d
    };
    let at = |angle: f64, folded: f64| {
        let (mut r, mut q) = (vector(&q0, 0), Vec::new());
        for n in 0..9 {
            let of = |n: usize| turned(&nodes[n], if n == 4 { folded } else { angle });
            q.extend(r.iter().chain(of(n).iter()));
            if n < 8 {
                r += (turned(&middles[n], angle) + (of(n) + of(n + 1)) * 0.25) * (lengths[n] / 1.5);
            }
        }
        q
    };
    let set = |cable: &mut Cable, parts: u32, degrees: f64, folded: f64| {
        cable.restore(start.clone()).unwrap();
        cable.diagnostics_mut().reset();
        for k in 1..=parts {
            let share = f64::from(k) / f64::from(parts);
            let q = at(degrees.to_radians() * share, folded.to_radians() * share);
            cable.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
        }
        (cable.torsion()[0].twist, cable.diagnostics().twist_slips)
    };
    for degrees in [60.0, 150.0, 175.0] {
        let [once, twice, often] = [1, 2, 40].map(|parts| set(&mut cable, parts, degrees, degrees));
        println!("{degrees}: {once:?} {twice:?} {often:?}");
        assert!((once.0 - often.0).abs() < 1e-12 && (twice.0 - often.0).abs() < 1e-12);
        assert_eq!([once.1, twice.1, often.1], [0; 3]);
    }
    assert!(set(&mut cable, 1, 0.0, 170.0).1 > 0);
    assert!(cable.warnings().iter().any(|w| matches!(w, Warning::TwistSlips { .. })), "{:?}", cable.warnings());
}

/// A moment about the tangent of a bent cable does nothing, and that is told, with torsion and
/// without; not of one across, nor of one that a clamp takes.
///
/// *Source.* The virtual work of a moment on a section is that on the rotation of its tangent; the
/// slope in the middle of the sag is along x.
#[test]
fn a_moment_about_the_tangent_is_told() {
    let told = |torsion: Option<Torsion>, at: f64, moment: Vector3<f64>| {
        let mut cable = clamped(torsion).build().unwrap();
        cable.add_load(PointLoad::moment(at * cable.length(), moment)).unwrap();
        let now = cable.warnings();
        cable.set_watched(true);
        run(&mut cable, 10);
        let along = |warnings: Vec<Warning>| {
            warnings
                .into_iter()
                .find_map(|w| if let Warning::MomentAlong { part_nm, .. } = w { Some(part_nm) } else { None })
        };
        let [now, then] = [now, cable.warnings()].map(along);
        assert_eq!(now.is_some(), then.is_some(), "{now:?} {then:?}");
        now
    };
    let swivel = Torsion { end: EndSpin::Swivel, ..twisted(0.0) };
    for torsion in [None, Some(twisted(0.5))] {
        let part = told(torsion.clone(), 0.5, Vector3::new(0.05, 0.0, 0.02)).unwrap();
        assert!((part - 0.05).abs() < 1e-6, "{part}");
        assert_eq!(told(torsion.clone(), 0.5, Vector3::new(0.0, 0.0, 0.05)), None);
        assert_eq!(told(torsion, 1.0, Vector3::new(0.05, 0.0, 0.0)), None);
    }
    assert!(told(Some(swivel), 1.0, Vector3::new(0.05, 0.0, 0.0)).is_some());
}

/// A torque at which a straight cable goes into a loop is told where it does not touch itself.
///
/// *Source.* Greenhill 1883: `(M/2EI)^2 - T/EI = (pi/L)^2` with EI = 1, T = 30 N, L = 1 m.
#[test]
fn a_cable_that_kinks_through_itself_is_told() {
    let critical = 2.0 * (30.0 + std::f64::consts::PI.powi(2)).sqrt();
    let warnings = |torque: f64, contact: Option<Contact>| {
        let torsion = Some(Torsion { initial_twist: torque / (0.7 * std::f64::consts::TAU), ..Torsion::new(0.7) });
        let mut cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::x()])
            // EA times the Green strain, over the stretch
            .length(1.0 - 30.0 / 1e7)
            .section(Section::from_stiffness(1e7, 1.0, 0.1).unwrap())
            .elements(16)
            .gravity(Vector3::zeros())
            .effects(Effects { torsion, contact, ..Effects::default() })
            .integrator(Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) })
            .clamp(At::Start)
            .clamp(At::End)
            .build()
            .unwrap();
        cable.step(1e-4).unwrap();
        cable.warnings().into_iter().find(|w| matches!(w, Warning::KinksThroughItself { .. }))
    };
    let warning = warnings(1.2 * critical, None).expect("it is told");
    let text = warning.to_string();
    let Warning::KinksThroughItself { torque_nm, tension_n, share, .. } = warning else { unreachable!() };
    assert!((tension_n - 30.0).abs() < 1e-2, "{tension_n}");
    assert!(text.contains(&format!("{torque_nm:.3e} N m at a tension of {tension_n:.3e} N")), "{text}");
    let expected = (0.25 * (1.2 * critical).powi(2) - 30.0).sqrt() / std::f64::consts::PI;
    assert!((torque_nm / (1.2 * critical) - 1.0).abs() < 1e-5, "{torque_nm}");
    assert!((share / expected - 1.0).abs() < 1e-4, "{share} {expected}");
    assert!(warnings(1.01 * critical, None).is_some() && warnings(0.99 * critical, None).is_none());
    let contact = Contact { radius: Some(0.01), ..Contact::default() };
    assert!(warnings(1.2 * critical, Some(contact)).is_some());
    assert!(warnings(1.2 * critical, Some(Contact { itself: true, ..contact })).is_none());
}

/// GJ above EI is told, but of a stranded rope.
///
/// *Source.* GJ = EI/(1 + nu) of a round section of one material.
#[test]
fn torsion_that_is_stiffer_than_bending_is_told() {
    let told = |torsion: Torsion| {
        let cable = clamped(Some(torsion)).build().unwrap();
        cable.warnings().iter().any(|w| matches!(w, Warning::StiffTorsion { .. }))
    };
    assert!(told(Torsion::new(0.0301)) && !told(Torsion::new(0.03)));
    assert!(!told(Torsion::round(0.03, 0.0).unwrap()) && !told(Torsion::stranded(0.04, 0.1, 0.01)));
}

/// A weightless straight rod of 1 m with clamps at both ends and at 0.25 m, which spin as `inner`
/// says.
fn held_between(inner: EndSpin, turns: f64) -> Cable {
    let torsion = Torsion { inner, initial_twist: turns, ..Torsion::new(0.02) };
    super::rod(torsion).clamp(At::ArcLength(0.25)).build().unwrap()
}

/// A swivel between two clamps lets the torque through; a motor there twists one side and turns the
/// other back, and its work is the energy of both.
///
/// *Source.* GJ times the angle over the length, by hand.
#[test]
fn a_clamp_between_can_be_a_swivel_or_a_motor() {
    let mut through = held_between(EndSpin::Swivel, 0.5);
    run(&mut through, 10);
    let [only] = through.torsion()[..] else { panic!("{:?}", through.torsion()) };
    assert_eq!(only.nodes, [0, 8]);
    assert!((only.torque - 0.02 * std::f64::consts::PI).abs() < 1e-12, "{only:?}");
    let mut turned = held_between(EndSpin::Motor { rate: 0.2, from: 0.0, until: 0.5 }, 0.0);
    run(&mut turned, 60);
    let [left, right] = turned.torsion()[..] else { panic!("{:?}", turned.torsion()) };
    let angle = 0.1 * std::f64::consts::TAU;
    println!("{left:?} {right:?}");
    assert!((left.torque - 0.02 * angle / 0.25).abs() < 1e-12 && (right.torque + 0.02 * angle / 0.75).abs() < 1e-12);
    let energy = 0.5 * 0.02 * angle * angle * (1.0 / 0.25 + 1.0 / 0.75);
    assert!((turned.energy().torsion - energy).abs() < 1e-12);
    let law = *turned.energy_law();
    let work = law.supports - law.numerical - law.rescaled + law.residual;
    assert!((work - energy - turned.energy_in_store()).abs() < 1e-10, "{law:?} {energy}");
}
