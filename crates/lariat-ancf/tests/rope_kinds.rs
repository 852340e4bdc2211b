//! Damping of ropes by name, against the logarithmic decrement of their motion.

use lariat_ancf::{At, Cable, Damping, Error, Integrator, Make, Method, RopeKind, Rule, Section, Vector3};
use std::f64::consts::{PI, TAU};

/// Returns the logarithmic decrement of the energy of a cable that is released with velocities, per period of `omega`
/// damped by `ratio`, over `periods` of it.
fn decrement(mut cable: Cable, velocities: &[f64], omega: f64, ratio: f64, periods: u32) -> f64 {
    let q = cable.positions().to_vec();
    cable.set_coordinates(&q, velocities).unwrap();
    cable.set_integrator(Integrator::tolerance(Method::Esdirk4, 1e-13).unwrap()).unwrap();
    let (before, period) = (cable.energy().total(), TAU / (omega * (1.0 - ratio * ratio).sqrt()));
    for _ in 0..periods {
        cable.step(period).unwrap();
    }
    0.5 * (before / cable.energy().total()).ln() / f64::from(periods)
}

/// A straight cable of `n` elements from pin to pin, without gravity.
fn straight(section: Section, length: f64, n: usize, kind: RopeKind) -> Cable {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::x() * length])
        .section(section)
        .elements(n)
        .gravity(Vector3::zeros())
        .fix(At::Start)
        .fix(At::End)
        .damped_as(kind)
        .build()
        .unwrap()
}

/// The lowest axial mode, and bending in ten half waves, decay by the ratio that the name stands for.
///
/// *Source.* Linear vibration: decrement 2 pi zeta/sqrt(1 - zeta^2). Frequencies (k pi/L) sqrt(EA/m) of the bar, (k pi/L)^2
/// sqrt(EI/m) of the beam on two pins; amplitudes of 1e-6 and less of the length.
#[test]
fn named_damping_is_the_logarithmic_decrement_of_the_named_modes() {
    let (length, n) = (10.0, 40);
    for kind in RopeKind::ALL {
        let ratio = kind.damping_ratio();
        let expected = TAU * ratio / (1.0 - ratio * ratio).sqrt();
        // about no tension, where a rope would not push
        let section = Section { make: Make::Unknown, ..Section::wire_rope(0.01).unwrap() };
        let wave = |number: f64, axis: usize, size: f64| -> Vec<f64> {
            let k = number * PI / length;
            let mut v = vec![0.0; 6 * (n + 1)];
            for (i, v) in v.chunks_exact_mut(6).enumerate() {
                let x = length * i as f64 / n as f64;
                (v[axis], v[3 + axis]) = (size * (k * x).sin(), size * k * (k * x).cos());
            }
            v
        };
        let axial = PI / length * (section.axial_stiffness / section.mass_per_length).sqrt();
        let found = decrement(straight(section, length, n, kind), &wave(1.0, 0, 1e-5 * axial), axial, ratio, 5);
        assert!((found / expected - 1.0).abs() < 0.01, "{kind}, axial: {found} of {expected}");
        // thick, so that tension is nothing beside bending
        let rod = Section::from_stiffness(1e4, 100.0, 1.0).unwrap();
        let bending = (10.0 * PI / length).powi(2) * 10.0;
        let cable = straight(rod, length, n, kind);
        let found = decrement(cable, &wave(10.0, 1, 1e-6 * bending), bending, ratio, 2);
        println!("{kind}, bending: {found} of {expected}");
        assert!((found / expected - 1.0).abs() < 0.02, "{kind}, bending: {found} of {expected}");
    }
}

/// A name gives the same times by builder, by section and length, and by frequencies; none for bending of a limp cable; pieces
/// of two sections count by the time that a wave takes. An unknown name is an error that suggests the nearest.
///
/// *Source.* The formulas of `rope_kind.rs`.
#[test]
fn a_kind_gives_the_same_damping_everywhere() {
    let section = Section::wire_rope(0.008).unwrap();
    let of = |rule: Rule| {
        let points = [Vector3::zeros(), Vector3::x() * 3.0];
        Cable::builder().points(points).section(section).rule(rule).damped_as(RopeKind::WireRope).build().unwrap()
    };
    let damping = RopeKind::WireRope.damping(&section, 3.0).unwrap();
    assert_eq!(RopeKind::WireRope.damping(&section, -1.0).ok(), None);
    let built = of(Rule::default()).effects().damping.unwrap();
    assert!((built.axial / damping.axial - 1.0).abs() < 1e-12 && (built.bending / damping.bending - 1.0).abs() < 1e-12);
    let limp = of("projected-none".parse().unwrap()).effects().damping.unwrap();
    assert!((limp.axial / damping.axial - 1.0).abs() < 1e-12 && limp.bending == 0.0);
    let axial = PI / 3.0 * (section.axial_stiffness / section.mass_per_length).sqrt();
    let at = RopeKind::WireRope.damping_at(axial, 7.0).unwrap();
    assert!(
        (at.axial / damping.axial - 1.0).abs() < 1e-12
            && (at.bending - Damping::from_ratio(0.02, 7.0).unwrap().bending).abs() < 1e-15
    );
    for kind in RopeKind::ALL {
        assert_eq!(kind.to_string().parse::<RopeKind>().unwrap(), kind);
    }
    // as `RopeMaterial` is written
    assert_eq!("wire_rope".parse::<RopeKind>().unwrap(), RopeKind::WireRope);
    let Err(Error::UnknownRopeKind { suggestion, .. }) = "wire_rop".parse::<RopeKind>() else { panic!("no error") };
    assert_eq!(suggestion.as_deref(), Some("wire-rope"));
}

/// Ropes by name that fall from a straight or slack line come to the end of a second under error control, whatever their mesh, thickness and
/// damping, with no energy made: their force jumps where they become taut or slack.
///
/// *Source.* Conservation of energy, to the 0.5 % that a run under error control is let go with.
#[test]
fn ropes_by_name_fall_under_error_control() {
    for elements in [8, 12, 16, 20, 30] {
        for (diameter, length) in [(0.004, 2.2), (0.008, 2.0), (0.016, 2.2)] {
            for damping in [Damping { axial: 0.0, bending: 0.0 }, Damping { axial: 0.002, bending: 0.01 }] {
                let rope = Cable::builder().points([Vector3::zeros(), Vector3::x() * 2.0]).length(length);
                let section = Section::wire_rope(diameter).unwrap();
                let rope = rope.section(section).damping(damping).elements(elements).fix(At::Start);
                let mut rope = rope.build().unwrap();
                let (start, weight) = (rope.energy().total(), section.mass_per_length * 9.81 * length);
                for _ in 0..30 {
                    let fell = rope.step(1.0 / 60.0);
                    assert!(fell.is_ok(), "{elements} elements, {diameter} m, {length} m, {damping:?}: {fell:?}");
                }
                let made = rope.energy().total() - start;
                assert!(made <= 0.005 * weight * length, "{elements} elements, {diameter} m, {length} m: {made} J");
            }
        }
    }
}
