//! Small motions and stability: eigenfrequencies, buckling loads, waves.

mod common;

use common::{dense, reference_json, rule};
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::linalg::{Definiteness, Factorisation};
use lariat_ancf::{At, Cable, CableBuilder, Integrator, Method, Rule, Section, Vector3};
use nalgebra::DMatrix;
use std::f64::consts::{FRAC_PI_2, PI};

/// A straight weightless rod of unstretched length `length` along x, evenly stretched by f.
fn rod(length: f64, f: f64, section: Section, elements: usize, rule: Rule) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(f * length, 0.0, 0.0)])
        .length(length)
        .section(section)
        .elements(elements)
        .gravity(Vector3::zeros())
        .rule(rule)
}

/// A straight rod pressed to the even stretch f < 1: built between points nearer than its length it would start as an
/// arc.
fn squeeze(mut cable: Cable, f: f64) -> Cable {
    let q: Vec<f64> = cable.node_arc_lengths().iter().flat_map(|s| [f * s, 0.0, 0.0, f, 0.0, 0.0]).collect();
    cable.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
    if cable.support(At::End).unwrap().position.is_some() {
        cable.fix(At::End).unwrap();
    }
    cable
}

/// Which coordinate of (x, y, z) vibrates.
#[derive(Clone, Copy)]
enum Along {
    X,
    Y,
}

/// Ascending angular frequencies in rad/s of the motion along one axis, supports in place; at the straight state the
/// axes are uncoupled.
fn frequencies(cable: &mut Cable, along: Along) -> Vec<f64> {
    let (mut k, mut m) = (cable.stiffness_matrix(), cable.mass_matrix());
    cable.apply_supports(&mut k);
    cable.apply_supports(&mut m);
    let (k, m) = (dense(&k), dense(&m));
    let axis = along as usize;
    // a held coordinate has become a row of the identity in both
    let free: Vec<usize> = (0..k.nrows())
        .filter(|i| i % 3 == axis)
        .filter(|&i| !(k[(i, i)] == 1.0 && k.row(i).sum() == 1.0 && m[(i, i)] == 1.0 && m.row(i).sum() == 1.0))
        .collect();
    let part = |a: &DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |r, c| a[(free[r], free[c])]);
    let inverse = part(&m).cholesky().expect("mass is positive definite").l().try_inverse().unwrap();
    let mut squares: Vec<f64> =
        (&inverse * part(&k) * inverse.transpose()).symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares.into_iter().map(|x| x.max(0.0).sqrt()).collect()
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// EA = 1e5 N, EI = 2 N m^2, 0.5 kg/m, the section of both reference files.
fn reference_section() -> Section {
    Section::from_stiffness(1e5, 2.0, 0.5).unwrap()
}

/// First four bending frequencies of a cantilever and of a beam on two pins, 4, 8, 16 elements.
///
/// *Source.* `D03_eigenfrequencies.json`: the discrete values of an independent code (exact axial, full curvature), and
/// Euler-Bernoulli's (beta L)^2 sqrt(EI/m)/L^2, cosh cos = -1 for the cantilever. Projected strain is the same here: an
/// unstressed straight cable bends without axial energy.
#[test]
fn cantilever_and_pinned_beam_have_the_frequencies_of_the_reference() {
    let file = reference_json("D03_eigenfrequencies.json");
    let mut worst = 0.0f64;
    for (name, elements) in
        ["G5-3", "exact-2", "projected-3", "ST2"].into_iter().flat_map(|n| [4usize, 8, 16].map(|e| (n, e)))
    {
        let discrete = &file["ancf"][elements.to_string()];
        let straight = || rod(1.0, 1.0, reference_section(), elements, rule(name));
        let mut cantilever = straight().clamp(At::Start).build().unwrap();
        let mut pinned = straight().fix(At::Start).fix(At::End).build().unwrap();
        for (cable, key) in [(&mut cantilever, "cantilever"), (&mut pinned, "pinned")] {
            let found = frequencies(cable, Along::Y);
            let (discrete, analytic) = (numbers(&discrete[key]), numbers(&file[format!("{key}_omega")]));
            for mode in 0..4 {
                let off = (found[mode] / discrete[mode] - 1.0).abs();
                worst = worst.max(off);
                assert!(
                    off < 1e-6,
                    "{name}, {elements} elements, {key} mode {mode}: {} {}",
                    found[mode],
                    discrete[mode]
                );
                // the elements are too stiff, by the reference's own error
                let error = found[mode] / analytic[mode] - 1.0;
                let allowed = discrete[mode] / analytic[mode] - 1.0;
                assert!(error > 0.0 && error < allowed + 1e-6, "{name}, {key} mode {mode}: {error:e}");
            }
        }
    }
    println!("largest relative difference from the discrete reference {worst:.1e}");
}

/// A rod under a tension of 200 N, pins at its stretched length.
///
/// *Source.* `D03_eigenfrequencies.json`, "taut": discrete values of an independent code, and m omega^2 = EA eps k^2 +
/// EI k^4/f^4 (the Green law in material coordinates; the textbook beam of stretched length and thinned mass differs in
/// the fourth digit, since the law does).
#[test]
fn taut_rod_has_the_frequencies_of_the_reference() {
    let file = &reference_json("D03_eigenfrequencies.json")["taut"];
    let f = file["stretch_green"].as_f64().unwrap();
    for (name, elements) in ["G5-3", "exact-2", "projected-3"].into_iter().flat_map(|n| [4usize, 8, 16].map(|e| (n, e)))
    {
        let mut cable =
            rod(1.0, f, reference_section(), elements, rule(name)).fix(At::Start).fix(At::End).build().unwrap();
        let tension = cable.sample(0.3).unwrap().tension;
        assert!((tension - 200.0).abs() < 1e-6, "{tension}");
        let found = frequencies(&mut cable, Along::Y);
        let discrete = numbers(&file["ancf"][elements.to_string()]["omega"]);
        let analytic = numbers(&file["omega_material_exact"]);
        for mode in 0..4 {
            let off = (found[mode] / discrete[mode] - 1.0).abs();
            println!(
                "{name}, {elements} elements, mode {mode}: {:.8} discrete {:.8} ({off:.1e}) analytic {:.8}",
                found[mode], discrete[mode], analytic[mode]
            );
            // projected strain is softer in bending under tension than exact strain: closer to the beam, or as close
            if name != "projected-3" {
                assert!(off < 1e-6, "{name}, {elements} elements, mode {mode}: {off:e}");
            }
            let error = (found[mode] / analytic[mode] - 1.0).abs();
            assert!(error < (discrete[mode] / analytic[mode] - 1.0) * 1.01 + 1e-7, "{name}: {error:e}");
        }
    }
}

/// Largest compressive force (N) at which a straight rod is still stable, by bisection of its even stretch.
fn buckling_load(supports: fn(CableBuilder) -> CableBuilder, elements: usize, rule: Rule) -> f64 {
    let section = reference_section();
    let load = |f: f64| -section.axial_stiffness * f * (f * f - 1.0) / 2.0;
    let stable = |f: f64| {
        let mut cable = squeeze(supports(rod(1.0, 1.0, section, elements, rule)).build().unwrap(), f);
        let mut k = cable.stiffness_matrix();
        cable.apply_supports(&mut k);
        let kind = Factorisation::default().factor(fearless_simd::Level::new(), &k);
        matches!(kind, Ok(Definiteness::PositiveDefinite))
    };
    let (mut low, mut high) = (0.99, 1.0);
    assert!(stable(high) && !stable(low));
    for _ in 0..60 {
        let f = 0.5 * (low + high);
        if stable(f) { high = f } else { low = f }
    }
    load(0.5 * (low + high))
}

/// Euler's loads, found as the force at which the stiffness stops being positive definite.
///
/// *Source.* `D05_buckling.json`: discrete values of an independent code, the continuum with the Green law (19.7509 N
/// and 4.93553 N), and Euler's pi^2 EI/L^2 and pi^2 EI/(4 L^2), from which that differs by the shortening before
/// buckling.
#[test]
fn rod_buckles_at_the_load_of_the_reference() {
    let file = reference_json("D05_buckling.json");
    for (key, supports) in [
        ("pinned", (|b: CableBuilder| b.fix(At::Start).fix(At::End)) as fn(CableBuilder) -> CableBuilder),
        ("cantilever", |b| b.clamp(At::Start)),
    ] {
        let continuum = file[format!("P_{key}_ancf_continuum_exact")].as_f64().unwrap();
        let euler = file[format!("P_{key}")].as_f64().unwrap();
        for elements in [2usize, 4, 8, 16] {
            let discrete = file["ancf"][elements.to_string()][key].as_f64().unwrap();
            let found = buckling_load(supports, elements, rule("G5-3"));
            let default = buckling_load(supports, elements, Rule::default());
            println!(
                "{key}, {elements} elements: {found:.8} N, reference {discrete:.8}, default rule {default:.8}, \
                 continuum {continuum:.8}, Euler {euler:.8}"
            );
            assert!((found / discrete - 1.0).abs() < 1e-6, "{key}, {elements}: {found} {discrete}");
            assert!((default / continuum - 1.0).abs() < 1.05 * (discrete / continuum - 1.0) + 1e-7, "{key}: {default}");
            if elements == 16 {
                assert!((found / continuum - 1.0).abs() < 3e-6 && (found / euler - 1.0).abs() < 1e-3, "{found}");
            }
        }
    }
}

/// Relative error of an axial frequency of a bar of 2 m held at one end, against (2 k + 1) pi/2 sqrt(EA/m)/L.
fn bar_error(name: &str, elements: usize, mode: usize) -> f64 {
    let section = reference_section();
    let c = (section.axial_stiffness / section.mass_per_length).sqrt();
    let mut bar = rod(2.0, 1.0, section, elements, rule(name)).fix(At::Start).build().unwrap();
    let k = (2.0 * mode as f64 + 1.0) * FRAC_PI_2 / 2.0;
    // T1 and T2 also resist a gradient of the stretch: EA u_ss - EI u_ssss
    let gradient = if name == "ST2" { section.bending_stiffness / section.axial_stiffness * k * k } else { 0.0 };
    let theory = k * c * (1.0 + gradient).sqrt();
    let error = frequencies(&mut bar, Along::X)[mode] / theory - 1.0;
    println!("{name}, {elements} elements, mode {mode}: relative error {error:.1e}");
    error
}

/// Longitudinal frequencies of a bar held at one end, exact strain: order 6.
///
/// *Source.* Any text on waves in bars.
#[test]
fn bar_held_at_one_end_has_the_axial_frequencies_of_theory() {
    for name in ["G5-3", "G3-3", "exact-3", "ST2"] {
        for (mode, allowed) in [1e-8, 1e-6, 2e-5].into_iter().enumerate() {
            let error = bar_error(name, 8, mode);
            assert!(error.abs() < allowed, "{name}, mode {mode}: {error:e}");
        }
    }
    let order = (bar_error("G5-3", 8, 2) / bar_error("G5-3", 16, 2)).log2();
    assert!(order > 5.5, "order {order}");
}

/// The price of projected strain: one axial mode of the whole cable, in which the stretch of all nodes oscillates
/// against that between them, is held by the share delta of exact strain alone. Its frequency is 0.21 c/l whatever the
/// length, so axial waves are right only below it: the second axial frequency of this bar needs 32 elements.
///
/// *Source.* The bar of theory; the mode is G2-2's zero-energy mode (see `conformance.rs`), lifted by sqrt(delta).
#[test]
fn projected_strain_has_one_soft_axial_mode_and_is_right_below_it() {
    let (first, second) = (bar_error("projected-3", 16, 0), bar_error("projected-3", 32, 0));
    assert!(first.abs() < 1e-4 && second.abs() < 5e-6, "{first:e} {second:e}");
    assert!(bar_error("projected-3", 32, 1).abs() < 2e-4);
    let section = reference_section();
    let c = (section.axial_stiffness / section.mass_per_length).sqrt();
    for elements in [4, 8, 16] {
        let length = 2.0;
        let mut bar = rod(length, 1.0, section, elements, rule("projected-3")).fix(At::Start).build().unwrap();
        let mut exact = rod(length, 1.0, section, elements, rule("exact-3")).fix(At::Start).build().unwrap();
        let (found, theory) = (frequencies(&mut bar, Along::X), frequencies(&mut exact, Along::X));
        // the mode that has no neighbour among the true ones
        let nearest = |x: f64| theory.iter().map(|t| (x / t - 1.0).abs()).fold(f64::INFINITY, f64::min);
        let soft = found.iter().copied().find(|x| nearest(*x) > 0.02).expect("a soft mode");
        let share = soft * length / elements as f64 / c;
        println!(
            "{elements} elements: soft mode {soft:.2} rad/s = {share:.3} c/l, first axial frequency {:.2} rad/s",
            theory[0]
        );
        assert!((0.15..0.3).contains(&share), "{elements} elements: {share} c/l");
    }
}

/// Transverse frequencies of a limp taut string: k pi/L sqrt(EA eps/m), in unstretched length and mass.
///
/// *Source.* d'Alembert's equation in material coordinates: m y_tt = (N/f) y_ss, N = EA eps f.
#[test]
fn taut_string_has_the_harmonics_of_its_wave_speed() {
    let section = Section::from_stiffness(1e4, 0.0, 0.1).unwrap();
    let f = 1.02;
    let speed = (1e4 * (f * f - 1.0) / 2.0 / 0.1f64).sqrt();
    for name in ["projected-none", "G5-none", "G3-none"] {
        let mut string = rod(2.0, f, section, 20, rule(name)).fix(At::Start).fix(At::End).build().unwrap();
        let found = frequencies(&mut string, Along::Y);
        for mode in 0..4 {
            let theory = (mode as f64 + 1.0) * PI / 2.0 * speed;
            assert!((found[mode] / theory - 1.0).abs() < 2e-5, "{name}, mode {mode}: {} {theory}", found[mode]);
        }
    }
}

/// A hump on a taut string splits into two that travel at sqrt(EA eps/m) (unstretched lengths per second) and come back
/// upside down.
///
/// *Source.* d'Alembert: after half a round trip, t = L/c, the string is its own mirror image, upside down. The hump is
/// 1e-3 of the length high, so the tension changes by 1e-4. ESDIRK4 at a tolerance of 1e-9 m, so that the mesh and the
/// hump's height are the only errors.
#[test]
fn hump_on_a_taut_string_travels_at_the_wave_speed() {
    let section = Section::from_stiffness(1e4, 0.0, 0.1).unwrap();
    let (length, f, elements) = (2.0, 1.02, 64);
    let speed = (1e4 * (f * f - 1.0) / 2.0 / 0.1f64).sqrt();
    let mut string =
        rod(length, f, section, elements, rule("projected-none")).fix(At::Start).fix(At::End).build().unwrap();
    // y = a sin^4(pi (s - s0)/w) on (s0, s0 + w)
    let (a, s0, w) = (1e-3, 0.3, 0.8);
    let hump = |s: f64| {
        let x = PI * (s - s0) / w;
        if s <= s0 || s >= s0 + w {
            (0.0, 0.0)
        } else {
            (a * x.sin().powi(4), a * 4.0 * PI / w * x.sin().powi(3) * x.cos())
        }
    };
    let mut q = string.positions().to_vec();
    for (i, s) in string.node_arc_lengths().into_iter().enumerate() {
        (q[6 * i + 1], q[6 * i + 4]) = hump(s);
    }
    string.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
    string.set_integrator(Integrator::tolerance(Method::Esdirk4, 1e-9).unwrap()).unwrap();
    let steps = 50;
    for _ in 0..steps {
        string.step(length / speed / f64::from(steps)).unwrap();
    }
    let off = string
        .node_arc_lengths()
        .into_iter()
        .enumerate()
        .fold(0.0f64, |worst, (i, s)| worst.max((string.node_position(i).y + hump(length - s).0).abs()));
    println!("mirror image off by {:.2e} of the height", off / a);
    assert!(off < 0.02 * a, "{off:e} m");
}

/// A rod squeezed beyond Euler's load between two pins buckles, to any side: indifferent, so the report does not call it
/// stable; below the load it stays straight and is stable. A cable pinned at one end without gravity may lie anywhere: not
/// stable either.
///
/// *Source.* Euler's load of the reference section is 19.75 N, at a stretch of 0.99980; the deflection of a half sine wave
/// that takes the rest of the squeeze is (2/pi) sqrt(rest * length).
#[test]
fn unstable_and_indifferent_shapes_are_reported_as_not_stable() {
    let squeezed = |f: f64| {
        squeeze(rod(1.0, 1.0, reference_section(), 8, Rule::default()).fix(At::Start).fix(At::End).build().unwrap(), f)
    };
    let mut below = squeezed(0.9999);
    assert!(below.equilibrium().unwrap().stable);
    let mut beyond = squeezed(0.9995);
    let report = beyond.equilibrium().unwrap();
    let buckled = (0..9).map(|i| beyond.node_position(i).y.hypot(beyond.node_position(i).z)).fold(0.0, f64::max);
    println!("squeezed: {report:?}, deflection {buckled:.2e} m");
    assert!(!report.stable, "{report:?}");
    let expected = 2.0 / std::f64::consts::PI * (0.9998f64 - 0.9995).sqrt();
    assert!((buckled / expected - 1.0).abs() < 0.02, "{buckled:e} m of {expected:e}");
    let mut free = rod(1.0, 1.0, reference_section(), 8, Rule::default()).fix(At::Start).build().unwrap();
    assert!(!free.equilibrium().unwrap().stable);
}

/// All frequencies of a cantilever of 1 m in space at once: the lowest are its first three bending modes, each in two planes; and a ratio
/// given to one of them is the one it decays with.
///
/// *Source.* Euler-Bernoulli: (1.87510, 4.69409, 7.85476)^2 sqrt(EI/(mu L^4)).
#[test]
fn a_cantilever_has_its_frequencies_in_both_planes() {
    let section = Section::round(0.01, 1e9, 1000.0).unwrap();
    let mut cable = rod(1.0, 1.0, section, 12, rule("projected-3")).clamp(At::Start).build().unwrap();
    let all = cable.natural_frequencies();
    assert_eq!(all.len(), cable.positions().len() - 5, "a clamp holds a position and a direction");
    let unit = (section.bending_stiffness / section.mass_per_length).sqrt();
    for (k, beta) in [1.87510f64, 4.69409, 7.85476].into_iter().enumerate() {
        for plane in 0..2 {
            let (found, expected) = (all[2 * k + plane], beta * beta * unit);
            assert!((found / expected - 1.0).abs() < 2e-3, "mode {k}, plane {plane}: {found} rad/s, {expected}");
        }
    }
    let damping = lariat_ancf::Damping::from_ratio(0.05, all[2]).unwrap();
    assert!((damping.bending_ratio(all[2]) - 0.05).abs() < 1e-12);
}
