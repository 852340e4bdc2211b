//! Warnings of a cable about itself: by its sizes, its present state, and the host steps that it has made.

mod common;

use common::Random;
use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::warning::{Passage, Through, fold, name_of};
use lariat_ancf::{
    At, AxialLaw, Cable, CableBuilder, Contact, Damping, Drag, Effects, Fidelity, Flow, Integrator, Level, Method,
    PointLoad, Reel, RopeMaterial, Section, StepControl, Strength, Vector3, Warning,
};
use std::f64::consts::PI;

const GRAVITY: f64 = 9.81;

/// A rope that hangs from the origin, `angle` rad from the vertical, and its small-angle frequency as a rigid body in rad/s. The last tenth is
/// `heavy` times as heavy as the rest.
fn swing(length: f64, heavy: f64, angle: f64) -> (CableBuilder, f64) {
    let end = Vector3::new(angle.sin(), -angle.cos(), 0.0) * length;
    let rope = Section::from_stiffness(1e5, 1e-3, 0.2).unwrap();
    let weight = Section { mass_per_length: 0.02 * heavy + 0.2, ..rope };
    let line = Cable::builder().points([Vector3::zeros(), end]).section(rope).section_from(0.9 * length, weight);
    let share = 0.1 * heavy;
    let moment = 0.2 * length * length * (0.5 + 0.5 * share * (1.0 - 0.81));
    let inertia = 0.2 * length.powi(3) / 3.0 * (1.0 + share * (1.0 - 0.729));
    (line.fix(At::Start).elements(10), (GRAVITY * moment / inertia).sqrt())
}

fn watched(builder: CableBuilder, integrator: Integrator) -> Cable {
    let mut cable = builder.integrator(integrator).build().unwrap();
    cable.set_watched(true);
    cable
}

fn long_steps(cable: &Cable) -> Option<(f64, f64, f64)> {
    cable.warnings().into_iter().find_map(|warning| match warning {
        Warning::LongSteps { error_m, step_s, enough_s, .. } => Some((error_m, step_s, enough_s)),
        _ => None,
    })
}

/// Swings of lengths from 0.1 to 50 m, light and heavy at the end, of small and large angles, with the three methods of second order: the
/// error of one oscillation is within a factor of five of what is told, steps as long as is advised have no warning, and a tolerance has none.
///
/// *Source.* The same mesh with error control at 1e-8 of the length.
#[test]
fn steps_that_are_too_long_for_a_swing_are_told_with_its_error() {
    let mut random = Random::new(3);
    let mut ratios = Vec::new();
    for case in 0..24 {
        let length = 10f64.powf(0.35 + 1.35 * random.next());
        let heavy = [0.0, 20.0, 300.0][case % 3];
        let angle = 0.6 + 0.4 * random.next();
        let method = [Method::DiscreteGradient, Method::Midpoint, Method::Trapezoid][case / 3 % 3];
        let (builder, omega) = swing(length, heavy, angle);
        let turn = 0.5 + 0.2 * random.next(); // omega h
        let dt = turn / omega;
        let steps = (2.5 * PI / turn).ceil() as usize;
        let fixed = Integrator { method, control: StepControl::Substeps(1) };
        let mut coarse = watched(builder.clone(), fixed);
        let fine = Integrator::tolerance(Method::Esdirk4, 1e-8 * length).unwrap();
        let mut fine = watched(builder.clone(), fine);
        let mut off: f64 = 0.0;
        let failed = (0..steps).any(|_| {
            fine.step(dt).unwrap();
            let failed = coarse.step(dt).is_err();
            for node in 0..coarse.nodes() {
                off = off.max((coarse.node_position(node) - fine.node_position(node)).norm());
            }
            failed
        });
        assert_eq!(long_steps(&fine), None);
        let told = long_steps(&coarse);
        let (share, error) = (off / length, told.map_or(0.0, |(error, ..)| error / length));
        println!(
            "{method:?}: {length:.2} m, {heavy}, {angle:.2} rad, omega h = {turn:.2}: off by {share:.4} L, told {error:.4} L"
        );
        // the check of the energy divides steps, and refuses those that it cannot
        if failed || coarse.diagnostics().steps > steps as u64 {
            assert_ne!(method, Method::DiscreteGradient);
            continue;
        }
        let Some((_, _, enough)) = told else {
            assert!(share < 4e-3, "{share}");
            continue;
        };
        ratios.push(error / share);
        let mut enough_steps = watched(builder, Integrator { method, control: StepControl::MaxStep(enough) });
        (0..steps).for_each(|_| enough_steps.step(dt).unwrap());
        assert_eq!(long_steps(&enough_steps), None, "{:?}", enough_steps.warnings());
    }
    ratios.sort_by(f64::total_cmp);
    println!("told over true: {ratios:.2?}");
    assert!(ratios.len() >= 8 && ratios[0] > 0.2 && ratios[ratios.len() - 1] < 5.0, "{ratios:?}");
}

/// A watched cable counts its warnings once each, and goes on doing so after it was saved; one that is not costs nothing and judges the
/// present.
#[test]
fn warnings_are_counted_once_and_saved_with_the_cable() {
    let build = || {
        Cable::builder()
            .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
            .section(Section::square(0.01, 1.0e8, 4000.0).unwrap())
            .fix(At::Start)
            .elements(3)
            .build()
            .unwrap()
    };
    let (mut watched, mut plain) = (build(), build());
    watched.set_watched(true);
    assert!(watched.warnings().is_empty() && plain.warnings().is_empty());
    for step in 0..200 {
        watched.step(0.01).unwrap();
        plain.step(0.01).unwrap();
        if step == 60 {
            let saved = serde_json::to_string(&watched).unwrap();
            let read: Cable = serde_json::from_str(&saved).unwrap();
            assert_eq!((read.warnings(), read.diagnostics()), (watched.warnings(), watched.diagnostics()));
            watched = read;
        }
    }
    assert_eq!(watched.positions(), plain.positions());
    assert!(matches!(&watched.warnings()[..], [Warning::CoarseMesh { elements: 3, .. }]), "{:?}", watched.warnings());
    assert_eq!((watched.diagnostics().warnings, plain.diagnostics().warnings), (1, 0));
    // a part is watched, too, and follows its own readings
    let rest = watched.cut(At::Node(1)).unwrap();
    assert!(rest.is_watched() && watched.is_watched());
    watched.set_watched(false);
    assert_eq!(plain.is_watched(), watched.is_watched());
}

/// Sizes and materials in other units, by the section alone.
#[test]
fn sizes_in_other_units_are_told() {
    let told = |section: Section, length: f64| {
        let line = Cable::builder().points([Vector3::zeros(), Vector3::x() * length]).section(section).fix(At::Start);
        line.build().unwrap().warnings()
    };
    assert!(matches!(&told(Section::round(4.0, 2e11, 7850.0).unwrap(), 5.0)[..], [Warning::Stubby { .. }]));
    assert!(matches!(&told(Section::square(3.0, 2e11, 7850.0).unwrap(), 50.0)[..], [Warning::Thick { .. }]));
    let soft = Section::tube(0.02, 0.01, 210.0, 7850.0).unwrap();
    assert!(matches!(&told(soft, 5.0)[..], [Warning::SoftMaterial { youngs_modulus_pa: 210.0, .. }]));
    assert_eq!(told(Section::tube(0.02, 0.01, 2.1e11, 7850.0).unwrap(), 5.0), []);
    assert_eq!(told(Section::wire_rope(0.02).unwrap(), 5.0), []);
}

/// Green's law is told where its elongations are more than 2 % below Hooke's, with by how much, in statics too; a law that was given is meant, and
/// ropes by name have Hooke's.
///
/// *Source.* Hooke: e = T/EA.
#[test]
fn the_default_law_is_told_where_it_is_off_hookes() {
    let (axial, length) = (1e5, 10.0);
    let hung = |share: f64, law: Option<AxialLaw>| {
        let line = Cable::builder().points([Vector3::zeros(), -Vector3::y() * length]).gravity(Vector3::zeros());
        let line = line.section(Section::from_stiffness(axial, 0.0, 0.1).unwrap()).fix(At::Start);
        let force = PointLoad::force(length, [0.0, -share * axial, 0.0]);
        let mut line = line.load(force).effects(Effects { axial_law: law, ..Effects::default() }).build().unwrap();
        line.equilibrium().unwrap();
        let elongation = -line.sample(length).unwrap().position.y / length - 1.0;
        (elongation, line.warnings())
    };
    for share in [0.001, 0.005, 0.01, 0.0125, 0.015, 0.02, 0.0441, 0.06, 0.2] {
        let (elongation, warnings) = hung(share, None);
        let less = 1.0 - elongation / share;
        println!("{share}: {elongation}, {:.2} % less; {warnings:?}", 100.0 * less);
        match &warnings[..] {
            [] => assert!(less < 0.0201, "{share}"),
            [Warning::GreenStrain { .. }] => {
                assert!(less > 0.0199 && share < 0.05, "{share}");
                let text = format!("elongates it by {:.1} % less than Hooke's", 100.0 * less);
                assert!(warnings[0].to_string().contains(&text), "{}", warnings[0]);
            }
            [Warning::LargeStrain { .. }] => assert!(share > 0.05, "{share}"),
            other => panic!("{share}: {other:?}"),
        }
        let (elongation, warnings) = hung(share, Some(AxialLaw::Hooke));
        assert!((elongation / share - 1.0).abs() < 1e-6 && warnings.is_empty(), "{share} {elongation} {warnings:?}");
    }
    let rope = Cable::builder().points([Vector3::zeros(), -Vector3::y() * length]).fix(At::Start);
    let rope = rope.rope(RopeMaterial::Nylon, 0.02).unwrap().gravity(Vector3::zeros());
    let force = 0.03 * RopeMaterial::Nylon.section(0.02).unwrap().axial_stiffness;
    let mut rope = rope.load(PointLoad::force(length, [0.0, -force, 0.0])).build().unwrap();
    rope.equilibrium().unwrap();
    let elongation = -rope.sample(length).unwrap().position.y / length - 1.0;
    assert!((elongation / 0.03 - 1.0).abs() < 1e-6 && rope.warnings().is_empty(), "{elongation}");
}

/// A length in percent, damping in percent, and elements that are thicker than long are told by the cable itself.
#[test]
fn measures_that_were_not_meant_are_told() {
    let damped = |length: f64, elements: usize, damping: Damping| {
        let line = Cable::builder().points([Vector3::zeros(), Vector3::x() * 2.0]).length(length).elements(elements);
        let line = line.section(Section::round(0.02, 1e8, 1000.0).unwrap()).fix(At::Start).fix(At::End);
        line.damping(damping).build().unwrap().warnings()
    };
    let told = |length, elements, axial| damped(length, elements, Damping { axial, bending: 0.0 });
    assert_eq!(told(2.0, 90, 0.9), []);
    assert!(matches!(&told(2.0, 110, 0.9)[..], [Warning::ThickElements { .. }]));
    assert!(matches!(&told(2.0, 10, 2.0)[..], [Warning::SlowStretch { axial_s: 2.0, .. }]));
    let bending = damped(2.0, 10, Damping { axial: 0.0, bending: 10.0 });
    assert!(matches!(&bending[..], [Warning::SlowBending { bending_s: 10.0, .. }]), "{bending:?}");
    let slack = |warning: &Warning| matches!(warning, Warning::MuchSlack { drawn_m: 2.0, .. });
    assert!(told(102.0, 40, 0.1).iter().any(slack) && !told(5.9, 40, 0.1).iter().any(slack));
}

/// Numbers of contact, breaking, gravity, error control and reels in another measure are told by the cable itself, and none where they are as they
/// should be: a friction of its own or of what is near it, a radius, a breaking strain, which rubber bears, gravity in mm/s^2, a tolerance, and a
/// reel whose eye nothing holds.
#[test]
fn numbers_of_another_measure_are_told() {
    let told = |modulus: f64, change: &dyn Fn(CableBuilder) -> CableBuilder, set: &dyn Fn(&mut Cable)| -> Vec<String> {
        let line = Cable::builder().points([Vector3::zeros(), Vector3::x() * 2.0]).fix(At::Start);
        let line = change(line.section(Section::round(0.01, modulus, 1000.0).unwrap()).fidelity(Fidelity::Game));
        let mut line = line.build().unwrap();
        set(&mut line);
        line.set_watched(true);
        line.step(1e-4).unwrap();
        let names = line.warnings().into_iter().filter(|warning| warning.level() == Level::Setup);
        names.map(|warning| name_of(&warning)).collect()
    };
    let same = |line: CableBuilder| line;
    let contact = |friction: f64, radius: f64, of_ground: f64| {
        move |line: &mut Cable| {
            line.set_contact(Contact { friction, ..Contact::default().with_radius(radius) }).unwrap();
            let ground = HalfSpace { normal: Vector3::y() };
            line.set_obstacles(vec![Obstacle::new(1, ground, -Vector3::y() * 3.0, of_ground)]).unwrap();
        }
    };
    let none = Vec::<&str>::new();
    assert_eq!(told(1e9, &same, &contact(1.5, 0.01, 1.5)), none);
    assert_eq!(told(1e9, &same, &contact(30.0, 0.01, 0.3)), ["RoughContact"]);
    assert_eq!(told(1e9, &same, &contact(0.3, 0.01, 30.0)), ["RoughContact"]);
    assert_eq!(told(1e9, &same, &contact(0.3, 5.0, 0.3)), ["ThickContact"]);
    let breaks = |strain: f64| move |line: &mut Cable| line.set_strength(Strength::strain(strain)).unwrap();
    assert_eq!(told(1e9, &same, &breaks(0.4)), none);
    assert_eq!(told(1e9, &same, &breaks(20.0)), ["StretchyBreak"]);
    assert_eq!(told(1e7, &same, &breaks(5.0)), none);
    let gravity = |size: f64| move |line: CableBuilder| line.gravity([0.0, -size, 0.0]);
    assert_eq!(told(1e9, &gravity(1000.0), &|_| {}), none);
    assert_eq!(told(1e9, &gravity(9810.0), &|_| {}), ["StrongGravity"]);
    let controlled = |tolerance: f64| {
        let control = StepControl::Tolerance(tolerance);
        move |line: CableBuilder| line.integrator(Integrator { control, ..Integrator::default() })
    };
    assert_eq!(told(1e9, &controlled(0.01), &|_| {}), none);
    assert_eq!(told(1e9, &controlled(5.0), &|_| {}), ["LargeTolerance"]);
    let reel = |at: At| move |line: &mut Cable| line.add_reel(at, Reel::with_rate(0.1)).unwrap();
    assert_eq!(told(1e9, &same, &reel(At::Start)), none);
    assert_eq!(told(1e9, &same, &reel(At::End)), ["FreeEye"]);
}

/// A tension that breaks a rope of a known make is told, unless the rope has a strength; so is one of 0.05 EA in a stiff solid, whatever its
/// law. Rubber bears it.
///
/// *Source.* The breaking loads of the catalogues ([`RopeMaterial`]).
#[test]
fn tensions_that_break_a_rope_are_told() {
    let told = |section: Section, law: Option<AxialLaw>, strength: Option<f64>, pull: f64| {
        let line = Cable::builder().points([Vector3::zeros(), Vector3::x() * 2.0]).section(section).gravity([0.0; 3]);
        let line = line.effects(Effects { axial_law: law, ..Effects::default() }).fix(At::Start);
        let mut line = line.load(PointLoad::force(2.0, [pull, 0.0, 0.0])).build().unwrap();
        strength.into_iter().for_each(|limit| line.set_strength(Strength::tension(limit)).unwrap());
        line.equilibrium().unwrap();
        line.warnings().iter().any(|w| matches!(w, Warning::Overloaded { .. }))
    };
    for material in RopeMaterial::ALL {
        let (section, load) = (material.section(0.02).unwrap(), material.breaking_load(0.02).unwrap());
        let of = |strength: Option<f64>, share: f64| told(section, None, strength, share * load);
        assert_eq!([of(None, 0.95), of(None, 1.05), of(Some(2.0 * load), 1.05)], [false, true, false], "{material:?}");
    }
    let hooke = |modulus: f64, share: f64| {
        let section = Section::round(0.01, modulus, 2000.0).unwrap();
        told(section, Some(AxialLaw::Hooke), None, share * section.axial_stiffness)
    };
    assert_eq!([hooke(2e11, 0.04), hooke(2e11, 0.06), hooke(1e7, 0.3)], [false, true, false]);
}

/// The modulus given as EA, a diameter of drag in mm, a wind in km/h and strains of a curve in percent are told by the cable itself; so
/// is a tension beyond the last row of a curve. None is told where they are as they should be.
#[test]
fn forces_and_fluids_that_were_not_meant_are_told() {
    let told = |axial: f64, drag: Drag, law: AxialLaw, pull: f64| -> Vec<&str> {
        let section = Section::from_stiffness(axial, 1e-2, 0.14).unwrap();
        let effects = Effects { drag: Some(drag), axial_law: Some(law), ..Effects::default() };
        let line = Cable::builder().points([Vector3::zeros(), Vector3::x() * 2.0]).section(section).gravity([0.0; 3]);
        let line = line.effects(effects).fix(At::Start).load(PointLoad::force(2.0, [pull, 0.0, 0.0]));
        let mut line = line.build().unwrap();
        line.equilibrium().unwrap();
        let kind = |warning: Warning| match warning {
            Warning::FastWaves { .. } => "modulus",
            Warning::ThickDrag { .. } => "diameter",
            Warning::FastFlow { is_liquid, .. } => ["wind", "current"][usize::from(is_liquid)],
            Warning::SoftCurve { .. } => "percent",
            Warning::BeyondCurve { .. } => "beyond",
            _ => "",
        };
        line.warnings().into_iter().map(kind).filter(|kind| !kind.is_empty()).collect()
    };
    let drag = |density: f64, diameter: f64, speed: f64| {
        let flow = Flow::uniform([0.0, 0.0, 0.1 * speed]).with_history([[0.0, 0.0], [1e3, 0.0], [2e3, 10.0]]);
        Drag { diameter: Some(diameter), ..Drag::new(density, 1.2, 0.0, flow) }
    };
    let fine = || drag(1.2, 0.006, 60.0);
    let curve = |scale: f64| AxialLaw::Curve(vec![[0.0, 0.0], [0.1 * scale, 5e3], [0.2 * scale, 3e4]]);
    let none = Vec::<&str>::new();
    assert_eq!(told(1.6e6, fine(), AxialLaw::Hooke, 1e3), none);
    // 12 mm of steel: 2.1e11 Pa in the place of 1.6e6 N
    assert_eq!(told(2.1e11, fine(), AxialLaw::Hooke, 1e3), ["modulus"]);
    assert_eq!(told(1.6e6, drag(1.2, 6.0, 60.0), AxialLaw::Hooke, 1e3), ["diameter"]);
    assert_eq!(told(1.6e6, drag(1.2, 0.006, 200.0), AxialLaw::Hooke, 1e3), ["wind"]);
    assert_eq!(told(1.6e6, drag(1025.0, 0.006, 30.0), AxialLaw::Hooke, 1e3), ["current"]);
    assert_eq!(told(1.6e6, fine(), curve(1.0), 2.9e4), none);
    assert_eq!(told(1.6e6, fine(), curve(1.0), 3.1e4), ["beyond"]);
    assert_eq!(told(1.6e6, fine(), curve(100.0), 0.0), ["percent"]);
}

/// Random sections: none of those that exist is doubted (0.5 mm to 1.4 m thick, 1e5 to 1e12 Pa, 12 to 1e5 times as long as thick), all that
/// were given in other units are: millimetres read as metres, GPa read as Pa, MPa of metals read as Pa, and rods that are no cables.
///
/// *Source.* Metals: lead 1.6e10 Pa and 11340 kg/m^3 to beryllium copper 1.3e11 and 8250, steel 2.1e11 and 7800, aluminium 7e10 and 2700,
/// titanium 1.1e11 and 4500.
#[test]
fn random_sizes_are_told_where_they_are_wrong_and_only_there() {
    let mut random = Random::new(11);
    let mut between = |low: f64, high: f64| low * (high / low).powf(0.5 + 0.5 * random.next());
    for case in 0..400 {
        let (thick, modulus, density) = (between(5e-4, 1.4), between(1.01e5, 1e12), between(900.0, 2500.0));
        let (ratio, short) = (between(12.0, 1e5), between(0.1, 9.9));
        let section = |thick: f64, modulus: f64| match case % 3 {
            0 => Section::round(thick, modulus, density),
            1 => Section::square(thick, modulus, density),
            _ => Section::tube(thick, 0.8 * thick, modulus, density),
        };
        let told = |thick: f64, modulus: f64, length: f64| {
            let line = Cable::builder().points([Vector3::zeros(), Vector3::x() * length]);
            line.section(section(thick, modulus).unwrap()).fix(At::Start).build().unwrap().warnings()
        };
        let found = format!("{thick} m, {modulus} Pa, {ratio}");
        assert_eq!(told(thick, modulus, ratio * thick), [], "{found}");
        let in_metres = told(1e3 * thick.max(1.6e-3), modulus, ratio * thick);
        assert!(matches!(&in_metres[..], [Warning::Stubby { .. } | Warning::Thick { .. }]), "{found}: {in_metres:?}");
        let in_gpa = told(thick, 1e-9 * modulus, ratio * thick);
        assert!(matches!(&in_gpa[..], [Warning::SoftMaterial { .. }]), "{found}: {in_gpa:?}");
        let metals = [(1.6e10, 11340.0), (1.3e11, 8250.0), (2.1e11, 7800.0), (7e10, 2700.0), (1.1e11, 4500.0)];
        let (metal, heavy) = metals[case % metals.len()];
        let metal = |unit: f64| {
            let section = Section::round(thick, unit * metal, heavy).unwrap();
            let line = Cable::builder().points([Vector3::zeros(), Vector3::x() * ratio * thick]);
            line.section(section).fix(At::Start).build().unwrap().warnings()
        };
        assert_eq!(metal(1.0), [], "{found}");
        assert!(matches!(&metal(1e-6)[..], [Warning::SoftMaterial { .. }]), "{found}");
        let stubby = told(thick, modulus, short * thick);
        assert!(matches!(&stubby[..], [Warning::Stubby { .. }]), "{found}, {short}: {stubby:?}");
    }
}

/// The damping of a method is told as energy lost; with error control there is none, and a program that strikes the cable makes none.
///
/// *Source.* A pendulum in vacuum keeps its energy.
#[test]
fn energy_that_integration_loses_is_told() {
    let energy = |cable: &Cable| {
        let warnings = cable.warnings().into_iter();
        let told = |w: Warning| match w {
            Warning::EnergyLost { lost_j, scale_j, .. } => Some(-lost_j / scale_j),
            Warning::EnergyMade { made_j, scale_j, .. } => Some(made_j / scale_j),
            _ => None,
        };
        warnings.filter_map(told).next()
    };
    let fixed = |method| Integrator { method, control: StepControl::Substeps(1) };
    let damped = fixed(Method::GeneralisedAlpha { rho: 0.0 });
    let (builder, omega) = swing(2.0, 20.0, 1.0);
    let mut lossy = watched(builder.clone(), damped);
    let (start, mut largest) = (lossy.energy().total(), 0.0_f64);
    for _ in 0..40 {
        lossy.step(0.3 / omega).unwrap();
        largest = largest.max(start - lossy.energy().total());
    }
    let told = energy(&lossy).expect("a loss");
    assert!(told < -1e-2, "{told}");
    let scale = lossy.warnings().into_iter().find_map(|w| match w {
        Warning::EnergyLost { scale_j, .. } => Some(scale_j),
        _ => None,
    });
    assert!((largest + told * scale.unwrap()).abs() < 1e-3 * largest, "{largest} {told}");
    let mut good = watched(builder.clone(), Integrator::tolerance(Method::Esdirk4, 1e-6).unwrap());
    for step in 0..60 {
        if step == 30 {
            // struck by a program
            let (q, v) = (good.positions().to_vec(), good.velocities().iter().map(|v| 2.0 * v).collect::<Vec<_>>());
            good.set_coordinates(&q, &v).unwrap();
        }
        good.step(0.1 / omega).unwrap();
    }
    assert_eq!(energy(&good), None);
}

/// One warning of each kind about a cable.
fn of_each_kind() -> Vec<Warning> {
    let cable = || "rope".to_string();
    let (elements, enough, steps, time_s, step_s) = (8, 16, 3, 1.0, 0.01);
    vec![
        Warning::CoarseMesh { cable: cable(), error_m: 0.1, elements, enough },
        Warning::UntouchedObstacles { cable: cable(), count: 1 },
        Warning::CoarseMotion { cable: cable(), error_m: 0.1, displacement_m: 0.1, elements, enough },
        Warning::CoarseElement { cable: cable(), turn_rad: 1.0, elements, enough },
        Warning::CoarseMoment {
            cable: cable(),
            arc_length_m: 0.0,
            moment_nm: 2.0,
            elastica_nm: 1.0,
            layer_m: 0.01,
            elements,
            enough: Default::default(),
        },
        Warning::CoarseKink { cable: cable(), arc_length_m: 0.5, error_m: 0.1, elements, enough: Default::default() },
        Warning::LongSteps { cable: cable(), time_s, error_m: 0.1, step_s, enough_s: 0.001 },
        Warning::LargeStrain { cable: cable(), time_s, tension_n: 1.0, axial_stiffness_n: 2.0 },
        Warning::GreenStrain { cable: cable(), time_s, tension_n: 1.0, axial_stiffness_n: 40.0 },
        Warning::MuchSlack { cable: cable(), length_m: 4.0, drawn_m: 1.0 },
        Warning::SlowStretch { cable: cable(), axial_s: 2.0 },
        Warning::SlowBending { cable: cable(), bending_s: 2.0 },
        Warning::ThickElements { cable: cable(), element_m: 0.01, diameter_m: 0.02 },
        Warning::ThickDrag { cable: cable(), diameter_m: 12.0 },
        Warning::FastFlow { cable: cable(), speed_m_s: 30.0, density_kg_m3: 1025.0, is_liquid: true },
        Warning::SoftCurve { cable: cable(), strain: 20.0, force_n: 4e4, axial_stiffness_n: 3e5 },
        Warning::ThickContact { cable: cable(), radius_m: 5.0, length_m: 2.0, diameter_m: None },
        Warning::StrongGravity { cable: cable(), gravity_m_s2: 9810.0 },
        Warning::LargeTolerance { cable: cable(), tolerance_m: 5.0, length_m: 2.0 },
        Warning::FreeEye { cable: cable(), arc_length_m: 2.0 },
        Warning::RoughContact { cable: cable(), friction: 30.0 },
        Warning::StretchyBreak { cable: cable(), strain: 2.0, wave_speed_m_s: 2e3 },
        Warning::PriedAttachment { cable: cable(), arc_length_m: 0.5, radius_m: 0.01, force_n: 3.0 },
        Warning::StartsInside { cable: cable(), obstacle: 1, arc_length_m: 0.5, depth_m: 0.1 },
        Warning::BeyondCurve { cable: cable(), time_s, tension_n: 2.0, strain: 0.1, force_n: 1.0 },
        Warning::BreaksAgain { cable: cable(), breaks: 3 },
        Warning::EnergyMade { cable: cable(), time_s, made_j: 1.0, scale_j: 2.0, discrete_gradient: false },
        Warning::EnergyLost { cable: cable(), time_s, lost_j: 1.0, scale_j: 2.0 },
        Warning::FastReel { cable: cable(), time_s, ratio: 0.5, undirected: false },
        Warning::SlowReel { cable: cable(), asked_m: 5.0, given_m: 2.0, rate_m_s: 5.0, acceleration_m_s2: 2.0 },
        Warning::UnseenLoad { cable: cable(), time_s, share: 0.9, reached: 1.1, step_s },
        Warning::RoundedEnds { cable: cable(), time_s, noise_n: 1.0, tension_n: 2.0 },
        Warning::PassedThrough {
            cable: cable(),
            steps,
            first: Some(Passage { time_s, arc_length_m: 0.5, through: Through::Obstacle(7) }),
        },
        Warning::Facets { cable: cable(), time_s, slid_m: 1.0 },
        Warning::NotResolved { cable: cable(), steps },
        Warning::CutShort { cable: cable(), steps },
        Warning::UnsolvedSteps { cable: cable(), steps, hidden_j: 1.0 },
        Warning::Sinks { cable: cable(), arc_length_m: 0.5, share: 0.5, enough },
        Warning::CoarseContact { cable: cable(), arc_length_m: 0.5, turn_rad: 1.0, enough },
        Warning::CoarseTouchdown { cable: cable(), arc_length_m: 0.5, share: 0.01, enough },
        Warning::HighRestitution { cable: cable(), restitution: 1.0 },
        Warning::Overloaded { cable: cable(), time_s, tension_n: 2.0, bears_n: 1.0 },
        Warning::RunsOver { cable: cable(), arc_length_m: 0.5, run_m: 0.1 },
        Warning::FrictionLags { cable: cable(), steps },
        Warning::IdleTorsion { cable: cable() },
        Warning::CoarseTwist { cable: cable(), ratio: 2.0, elements, enough },
        Warning::TwistSlips { cable: cable(), slips: 2 },
        Warning::KinksThroughItself { cable: cable(), torque_nm: 1.0, tension_n: 2.0, share: 1.5 },
        Warning::MomentAlong { cable: cable(), at_m: 0.5, part_nm: 1.0, time_s },
        Warning::StiffTorsion { cable: cable(), ratio: 2.0 },
        Warning::Stubby { cable: cable(), ratio: 2.0, length_m: 1.0, diameter_m: 0.5 },
        Warning::Thick { cable: cable(), diameter_m: 2.0 },
        Warning::LightMaterial { cable: cable(), density_kg_m3: 1.0, wave_speed_m_s: 1e5 },
        Warning::FastWaves { cable: cable(), axial_stiffness_n: 1e9, mass_per_length_kg_m: 0.1, wave_speed_m_s: 1e5 },
        Warning::SoftMaterial { cable: cable(), youngs_modulus_pa: 210.0 },
    ]
}

/// The strain that is judged is the one that the rule resists: of a rule with one strain per
/// element not what varies inside it, of all others that, too.
///
/// *Source.* A straight element of chord 1 whose `|r'|` falls from 1.2 to 0.8: the mean of the
/// Green strain is `0.4^2/24`, that in its middle 0, and at its ends it is near 0.22 and -0.18.
#[test]
fn the_strain_that_a_rule_does_not_resist_is_not_told() {
    let ends = [Vector3::zeros(), Vector3::x()];
    let rules =
        [("L2T2", false), ("G1-T1", false), ("projected-3", true), ("ST2", true), ("G2-T1", true), ("G5-3", true)];
    for (rule, resisted) in rules {
        let section = Section::from_stiffness(1e5, 0.0, 0.1).unwrap();
        let cable = Cable::builder().points(ends).section(section).elements(1).rule(rule.parse().unwrap());
        let mut cable = cable.gravity(Vector3::zeros()).build().unwrap();
        let mut q = cable.positions().to_vec();
        (q[3], q[9]) = (1.2, 0.8);
        cable.set_coordinates(&q, &[0.0; 12]).unwrap();
        let told = cable.warnings().iter().any(|w| matches!(w, Warning::LargeStrain { .. }));
        assert_eq!(told, resisted, "{rule}: {:?}", cable.warnings());
    }
}

/// Whatever is warned of, something is told, and nothing that is told explains a warning of an
/// earlier level: causes come first, and no two explain each other.
#[test]
fn no_list_of_warnings_is_silenced() {
    let all = of_each_kind();
    let cable = |warning: &Warning| Some(warning.cable().to_string());
    for a in &all {
        for b in &all {
            for c in &all {
                let mut list = vec![a.clone(), b.clone(), c.clone()];
                fold::sort(&mut list);
                assert!(list.is_sorted_by_key(Warning::level));
                let explained = fold::explained(&list, cable, |_| true);
                for (warning, cause) in list.iter().zip(&explained) {
                    assert!(cause.is_none_or(|cause| list[cause].level() <= warning.level()), "{list:?}");
                }
                // in the end of every chain there is one that nothing explains
                for mut index in 0..list.len() {
                    for _ in 0..list.len() {
                        index = explained[index].unwrap_or(index);
                    }
                    assert_eq!(explained[index], None, "{list:?}");
                }
                assert!(!fold::lines(&list, cable, |_| true).is_empty());
                // what is not told explains nothing
                let wrong = |warning: &Warning| warning.level() == Level::Wrong;
                assert_eq!(fold::lines(&list, cable, wrong).is_empty(), !list.iter().any(wrong), "{list:?}");
            }
        }
    }
}

/// A cause explains its symptoms at its own cable, and from its time on.
#[test]
fn a_cause_explains_what_follows_at_its_cable() {
    let steps = |cable: &str, time_s| Warning::LongSteps {
        cable: cable.into(),
        time_s,
        error_m: 0.1,
        step_s: 0.1,
        enough_s: 0.01,
    };
    let lost = |cable: &str, time_s| Warning::EnergyLost { cable: cable.into(), time_s, lost_j: 1.0, scale_j: 2.0 };
    let cable = |warning: &Warning| Some(warning.cable().to_string());
    for (other, time, expected) in [("a", 2.0, Some(0)), ("b", 2.0, None), ("a", 0.5, None)] {
        let explained = fold::explained(&[steps("a", 1.0), lost(other, time)], cable, |_| true);
        assert_eq!(explained, [None, expected], "{other} {time}");
    }
    // three cables, one kind: one line, of the worst
    let worst = Warning::LongSteps { cable: "c".into(), time_s: 1.0, error_m: 0.3, step_s: 0.1, enough_s: 0.01 };
    let lines = fold::lines(&[steps("a", 1.0), worst.clone(), steps("b", 1.0)], cable, |_| true);
    assert_eq!(lines, [format!("3 times, the worst: {worst}")]);
}
