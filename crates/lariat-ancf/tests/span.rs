//! Lengths by tension or sag, and sections by name.

use lariat_ancf::{At, Cable, CableBuilder, Error, RopeMaterial, Section, Vector3};

fn line(span: [f64; 2], elements: usize) -> CableBuilder {
    let section = Section::from_stiffness(2e6, 0.0, 1.5).unwrap();
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(span[0], span[1], 0.0)])
        .section(section)
        .elements(elements)
        .fix(At::Start)
        .fix(At::End)
}

/// Horizontal force and length of the elastic catenary with level ends whose sag or middle tension
/// is given, by bisection.
///
/// *Source.* Irvine 1981, section 2.2, with Hooke's law; the Green law of the cable differs by 3/2
/// of the strain, here below 1e-4.
fn catenary(span: f64, weight: f64, axial: f64, miss: impl Fn(f64, f64) -> f64) -> (f64, f64) {
    let of = |force: f64| {
        // length L0 such that the span fits
        let (mut low, mut high) = (0.5 * span, 30.0 * span);
        for _ in 0..200 {
            let l = 0.5 * (low + high);
            let x = force * l / axial + 2.0 * force / weight * (0.5 * weight * l / force).asinh();
            if x < span { low = l } else { high = l }
        }
        let l = 0.5 * (low + high);
        let half = 0.5 * weight * l;
        let sag = half * l / (4.0 * axial) + force / weight * ((1.0 + (half / force).powi(2)).sqrt() - 1.0);
        (l, sag)
    };
    let (mut low, mut high) = (1e-3 * weight * span, axial);
    for _ in 0..200 {
        let force = (low * high).sqrt();
        if miss(force, of(force).1) < 0.0 { low = force } else { high = force }
    }
    (low, of(low).0)
}

#[test]
fn a_length_by_tension_or_sag_is_that_of_the_catenary() {
    let weight = 1.5 * 9.81;
    for sag in [0.5, 2.0, 8.0] {
        let mut cable = line([40.0, 0.0], 30).sag(sag).build().unwrap();
        let (_, length) = catenary(40.0, weight, 2e6, |_, found| sag - found);
        println!("sag {sag}: {} for {length}", cable.length());
        assert!((cable.length() / length - 1.0).abs() < 2e-5, "sag {sag}: {} for {length}", cable.length());
        cable.equilibrium().unwrap();
        assert!((cable.sample(0.5 * cable.length()).unwrap().position.y + sag).abs() < 1e-5 * sag);
    }
    // ropes of several times their span, which bend within a metre
    for sag in [6.0, 12.0] {
        let cable = line([6.0, 0.0], 80).sag(sag).build().unwrap();
        let (_, length) = catenary(6.0, weight, 2e6, |_, found| sag - found);
        println!("sag {sag} of 6: {} for {length}", cable.length());
        assert!((cable.length() / length - 1.0).abs() < 2e-3, "sag {sag}: {} for {length}", cable.length());
    }
    for tension in [300.0, 3e3, 5e4] {
        let mut cable = line([40.0, 0.0], 30).pretension(tension).build().unwrap();
        let (_, length) = catenary(40.0, weight, 2e6, |force, _| force - tension);
        println!("tension {tension}: {} for {length}", cable.length());
        let strain = tension / 2e6;
        // the Green law stretches it by 3/2 of the square of the strain less
        let off = (cable.length() / length - 1.0).abs();
        assert!(off < 1e-6 + 1.6 * strain * strain, "{tension}: {} {length}", cable.length());
        cable.equilibrium().unwrap();
        // what 30 elements read there
        assert!((cable.sample(0.5 * cable.length()).unwrap().tension / tension - 1.0).abs() < 5e-3);
    }
    // ropes of 1.9 to 4.5 times their span; all that is less is refused
    for tension in [143.0, 104.0, 86.0] {
        let cable = line([40.0, 0.0], 80).pretension(tension).build().unwrap();
        let (_, length) = catenary(40.0, weight, 2e6, |force, _| force - tension);
        println!("tension {tension}: {} for {length}", cable.length());
        assert!((cable.length() / length - 1.0).abs() < 5e-5, "{tension}: {} for {length}", cable.length());
    }
    let error = line([40.0, 0.0], 80).pretension(60.0).build().unwrap_err().to_string();
    assert!(error.contains("pretension") && error.contains("at some length"), "{error}");
    // inclined, and without weight
    for gravity in [0.0, 9.81] {
        let build = line([30.0, 20.0], 20).gravity([0.0, -gravity, 0.0]).pretension(4e3);
        let mut cable = build.build().unwrap();
        cable.equilibrium().unwrap();
        // the weight of either half is the same
        let [first, last] = cable.reactions().unwrap()[..] else { panic!("two supports") };
        assert!((0.5 * (first.force - last.force).norm() / 4e3 - 1.0).abs() < 1e-7);
        assert!((cable.sample(0.5 * cable.length()).unwrap().tension / 4e3 - 1.0).abs() < 1e-3);
    }
    for refused in [
        line([40.0, 0.0], 10).sag(0.0),
        line([40.0, 0.0], 10).pretension(f64::NAN),
        line([40.0, 0.0], 10).pretension(1e-3),
    ] {
        assert!(matches!(refused.build(), Err(Error::InvalidValue { .. })));
    }
    assert!(matches!(line([40.0, 0.0], 10).gravity([0.0; 3]).sag(1.0).build(), Err(Error::InvalidValue { .. })));
}

/// Ropes and chains by name have mass, EA and breaking load of their catalogues.
///
/// *Source.* Studless R4 chain of 100 mm: 199 kg/m and 9.86 MN (DNV-OS-E302: 0.0274 d^2 (44 - 0.08
/// d) kN, d in mm); polyester of 1.38 floats no more than its solid does: submerged weight 0.257 of
/// that in air.
#[test]
fn ropes_and_chains_by_name_have_the_numbers_of_their_catalogues() {
    let chain = Section::of(RopeMaterial::Chain, 0.1).unwrap();
    assert!((chain.mass_per_length / 199.0 - 1.0).abs() < 0.01, "{chain:?}");
    let rule = 0.0274e3 * 100.0f64.powi(2) * (44.0 - 0.08 * 100.0);
    assert!((RopeMaterial::Chain.breaking_load(0.1).unwrap() / rule - 1.0).abs() < 0.01);
    let polyester = Section::of(RopeMaterial::Polyester, 0.2).unwrap();
    let floats = 1025.0 * polyester.outer_area.unwrap() / polyester.mass_per_length;
    assert!((1.0 - floats - 0.257).abs() < 2e-3);
    let stiffness = |material: RopeMaterial| material.section(0.1).unwrap().axial_stiffness;
    let order = [RopeMaterial::Nylon, RopeMaterial::Polyester, RopeMaterial::Hmpe, RopeMaterial::WireRope];
    // the stiffer the rope, the stiffer the fibre
    assert!(order.windows(2).all(|pair| stiffness(pair[0]) < stiffness(pair[1])));
    for diameter in [0.0, -1.0, f64::NAN, 20.0] {
        assert!(matches!(RopeMaterial::ALL[0].section(diameter), Err(Error::InvalidValue { .. })));
    }
}
