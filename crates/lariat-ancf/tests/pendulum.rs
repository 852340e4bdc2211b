//! The falling pendulum of Bulin & Hajzman against an independent solver, exact in time.

mod common;

use common::{EXACT_IN_TIME, history, pendulum, reference, rule, tip};
use lariat_ancf::{Cable, Rule, Vector3};

/// The pendulum without time error.
fn exact(elements: usize, rule: Rule) -> Cable {
    pendulum(elements).rule(rule).allow_rank_deficient().integrator(EXACT_IN_TIME).build().unwrap()
}

/// Tip at 0, 0.01, ... 2 s.
fn tips(elements: usize, rule: Rule) -> Vec<Vector3<f64>> {
    history(&mut exact(elements, rule), 0.01, 200, |cable| tip(cable))
}

/// Largest vertical distance of the tip of 10 elements from the 10-element G10-10 run of the reference file, in m.
fn vertical_difference(name: &str) -> f64 {
    let reference = reference("pendulum_G10-10_10el.csv");
    let difference =
        tips(10, rule(name)).iter().zip(&reference).map(|(p, row)| (p.y - row[2]).abs()).fold(0.0, f64::max);
    println!("{name}: largest vertical difference from G10-10 {difference:.4e} m");
    difference
}

/// Largest distance of the tip from the real beam (160 elements, Richardson-extrapolated), in m.
fn distance_from_real_beam(elements: usize, rule: Rule) -> f64 {
    let reference = reference("pendulum_converged_tip.csv");
    let distance = tips(elements, rule)
        .iter()
        .zip(&reference)
        .map(|(p, row)| (p - Vector3::new(row[4], row[5], row[6])).norm())
        .fold(0.0, f64::max);
    println!("{rule}, {elements} elements: {distance:.4e} m from the real beam");
    distance
}

/// Asserts `value` within a share of `expected`.
fn assert_within(what: &str, value: f64, expected: f64, share: f64) {
    assert!(
        (value - expected).abs() <= share * expected,
        "{what}: {value:.4e}, expected {expected:.4e} within {share}"
    );
}

/// Ten elements G10-10: the tip, its velocity, the energies, the pin's reaction and the mid strain, over 2 s.
///
/// *Source.* `pendulum_G10-10_10el.csv`: an independent double-precision solver with shape-function matrices and a time
/// error below 1e-12 m. Its mid strain is the raw Green strain (|r'|^2 - 1)/2 at node 5, not the projected one that
/// `sample` gives.
#[test]
fn ten_element_pendulum_follows_the_independent_solver_through_two_seconds() {
    let rows = reference("pendulum_G10-10_10el.csv");
    let mut worst = [0.0f64; 5];
    let read = |cable: &mut Cable| {
        let (sample, energy) = (cable.sample(2.0).unwrap(), cable.energy());
        let reaction = cable.reactions().unwrap()[0].force;
        let strain = 0.5 * (cable.sample(1.0).unwrap().slope.norm_squared() - 1.0);
        (cable.time(), sample, energy, reaction, strain)
    };
    let ours = history(&mut exact(10, rule("G10-10")), 0.01, 200, read);
    assert_eq!(rows.len(), ours.len());
    for (row, (time, sample, energy, reaction, strain)) in rows.iter().zip(&ours) {
        assert!((row[0] - time).abs() < 1e-12);
        let vector = |k: usize| Vector3::new(row[k], row[k + 1], row[k + 2]);
        let energies = [energy.kinetic, energy.axial, energy.bending, energy.gravity, energy.total()];
        let energy = energies.iter().zip(&row[7..12]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let differences = [
            (sample.position - vector(1)).norm(),
            (sample.velocity - vector(4)).norm(),
            energy,
            (reaction - vector(12)).norm(),
            (strain - row[15]).abs(),
        ];
        worst = core::array::from_fn(|k| worst[k].max(differences[k]));
    }
    println!(
        "position {:.2e} m, velocity {:.2e} m/s, energy {:.2e} J, reaction {:.2e} N, strain {:.2e}",
        worst[0], worst[1], worst[2], worst[3], worst[4]
    );
    let end = ours[200].1.position;
    assert!((end.x - 0.228_119_32).abs() < 1e-6 && (end.y + 1.843_239_78).abs() < 1e-6, "{end}");
    assert!(worst[0] < 1e-6, "tip {:e} m", worst[0]);
    assert!(worst[1] < 1e-7, "tip velocity {:e} m/s", worst[1]);
    assert!(worst[2] < 2e-4, "energy {:e} J", worst[2]);
    assert!(worst[3] < 1e-6, "reaction {:e} N", worst[3]);
    assert!(worst[4] < 1e-9, "strain {:e}", worst[4]);
}

/// A symplectic method on a conservative system: the energy of the exact-in-time run is constant to 1e-6 J of the 8 J
/// that swing.
///
/// *Source.* Energy conservation; the reference run starts with zero energy.
#[test]
fn energy_of_the_exact_in_time_run_is_constant() {
    let mut cable = exact(10, Rule::default());
    let drift = history(&mut cable, 0.01, 200, |cable| cable.energy().total().abs()).into_iter().fold(0.0, f64::max);
    println!("energy drift {drift:.2e} J");
    assert!(drift < 1e-6, "{drift:e} J");
}

/// Table 1 of the paper, exact in time: too few Gauss points change the tip by these amounts.
///
/// *Source.* `table1_reproduction.csv` (independent solver); the paper prints 3.36e-1, 4.16e-3, 1.84e-4, 3.29e-5 and
/// 1.02e-4. Its G5-5 value is the error of its own time integration: five points integrate the axial energy exactly.
#[test]
fn table_1_of_the_paper_exact_in_time() {
    for (name, expected, share) in
        [("G2-2", 3.367e-1, 0.02), ("G3-3", 4.094e-3, 0.02), ("G4-4", 1.604e-4, 0.02), ("ST2", 9.6e-5, 0.05)]
    {
        assert_within(name, vertical_difference(name), expected, share);
    }
    let five = vertical_difference("G5-5");
    assert!(five < 1e-7, "G5-5: {five:e} m");
}

/// L2T2 is our documented number, not the paper's 1.02e-2 m: the text that defines L2 (Berzeri & Shabana 2000) was not
/// available, and our reading (mean Green strain, T2 with its derivative) gives another.
///
/// *Source.* `table1_reproduction.csv`, "mean Green strain const + T2 rms": 1.67e-2 m (independent solver, which drops
/// a derivative of T2).
#[test]
fn l2t2_differs_from_g10_10_by_our_documented_number() {
    assert_within("L2T2", vertical_difference("L2T2"), 1.667e-2, 0.01);
}

/// The full elements against the real beam: membrane locking at 10 elements, then convergence.
///
/// *Source.* `pendulum_converged_tip.csv` and `pendulum_convergence.json`: 1.085e-2, 9.199e-4, 4.548e-5 m (independent
/// solver, 3D distance from 160 elements extrapolated).
#[test]
fn five_point_elements_converge_to_the_real_beam_as_the_independent_solver_says() {
    for (elements, expected) in [(10, 1.1e-2), (20, 9.2e-4), (40, 4.6e-5)] {
        let distance = distance_from_real_beam(elements, rule("G5-5"));
        assert_within(&format!("G5-5, {elements} elements"), distance, expected, 0.03);
    }
}

/// The default rule does not lock: nearer to the real beam than exact strain at each number of elements, and within 1
/// mm with 16 elements or fewer.
///
/// *Source.* The real beam as above; the figures of the default rule from an independent prototype (2.4e-3, 1.0e-3,
/// 3.5e-4, 3.7e-5 m).
#[test]
fn default_rule_is_nearer_to_the_real_beam_than_exact_strain() {
    let exact = [(10, 1.085e-2), (14, 3.6e-3), (20, 9.199e-4), (40, 4.548e-5)];
    for ((elements, locked), expected) in exact.into_iter().zip([2.4e-3, 1.0e-3, 3.5e-4, 3.7e-5]) {
        let distance = distance_from_real_beam(elements, Rule::default());
        assert!(distance < locked, "{elements} elements: {distance:e} m, exact strain {locked:e} m");
        assert_within(&format!("{elements} elements"), distance, expected, 0.05);
    }
    let distance = distance_from_real_beam(16, Rule::default());
    assert!(distance < 1e-3, "16 elements: {distance:e} m");
}
