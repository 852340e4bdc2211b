//! The identities that the energy law rests on, element by element.

use super::*;
use crate::effect::{AxialLaw, Damping, Effects, RestPiece, RestShape};
use crate::linalg::{Definiteness, Factorisation};
use crate::system::System;
use crate::{Cable, Rule, Section, Vector3};

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

const RULES: [&str; 12] = [
    "projected-3",
    "projected-T1",
    "projected-T2",
    "projected-none",
    "exact-5",
    "ST2",
    "L2T2",
    "mean-T1",
    "G1-T1",
    "G3-3",
    "G5-3",
    "G10-10",
];

/// Elements of different length and stiffness, so that a group of lanes and a part of one are
/// filled.
fn cable(rule: &str, effects: Effects) -> Cable {
    let section = Section::from_stiffness(50.0, 0.3, 0.7).unwrap();
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.5, 0.0), Vector3::new(3.0, 0.0, 1.0)])
        .section(section)
        .elements(11)
        .rule(rule.parse::<Rule>().unwrap())
        .effects(effects)
        .build()
        .unwrap()
}

fn effects(rule: &str) -> Vec<Effects> {
    let bends = !rule.ends_with("none");
    let pieces = vec![
        RestPiece { from: 0.0, stretch: 1.02, curvature: 0.0 },
        RestPiece { from: 1.5, stretch: 0.97, curvature: if bends { 2.0 } else { 0.0 } },
    ];
    let damping = Damping { axial: 0.03, bending: if bends { 0.02 } else { 0.0 } };
    vec![
        Effects::default(),
        Effects { rest_shape: Some(RestShape { pieces: pieces.clone() }), ..Effects::default() },
        Effects { damping: Some(damping), ..Effects::default() },
        Effects { damping: Some(damping), rest_shape: Some(RestShape { pieces }), ..Effects::default() },
    ]
}

/// Axial laws, for rules that see all of the axial strain: their tangents have corners.
fn laws(rule: &str) -> Vec<Effects> {
    if rule.starts_with("G1-") || rule.starts_with("G3-") {
        return Vec::new();
    }
    let curve = AxialLaw::Curve(vec![[0.0, 0.0], [0.1, 0.2], [0.2, 2.0]]);
    [AxialLaw::Rope, curve].map(|law| Effects { axial_law: Some(law), ..Effects::default() }).into()
}

/// Coordinates near a straight cable, moved by `size` in m and 1.
fn coordinates(random: &mut Random, n: usize, size: f64) -> Vec<f64> {
    (0..n)
        .map(|i| {
            let straight = if i % 6 == 0 { 0.3 * (i / 6) as f64 } else { f64::from(u8::from(i % 6 == 3)) };
            straight + size * random.next()
        })
        .collect()
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// What the store of a step holds in the elements.
fn store(system: &System, q: &[f64], change: &[f64]) -> f64 {
    let still = vec![0.0; q.len()];
    let mut unused = still.clone();
    let step = CoordinateStep {
        start: q,
        change: &still,
        before: change,
        kept: 1.0,
        linearised: &[],
        h: 1.0,
        leg: OneLeg::default(),
        across: false,
    };
    system.forces.elements.add_discrete_gradient(system.level, None, step, &mut unused).numerical
}

/// The work of the discrete-gradient force over any step is the change of strain energy and store,
/// and the losses, which are not negative: for every rule and effect, from small steps to steps
/// that turn elements inside out. What errors are compared with is that energy.
///
/// *Source.* The energies by their own formulas. Bound: rounding of the largest term.
#[test]
fn the_work_of_the_force_is_the_change_of_energy_and_the_losses() {
    let mut random = Random(1);
    for rule in RULES {
        for effects in effects(rule).into_iter().chain(laws(rule)) {
            let system = cable(rule, effects.clone()).system;
            let mut worst = 0.0f64;
            for size in [1e-9, 1e-4, 0.02, 0.3, 1.5] {
                for before in [0.0, 0.02, 0.5] {
                    let n = 6 * (system.forces.elements.count() + 1);
                    let q = coordinates(&mut random, n, 0.15);
                    let change: Vec<f64> = (0..n).map(|_| size * random.next()).collect();
                    let before: Vec<f64> = (0..n).map(|_| before * random.next()).collect();
                    let end: Vec<f64> = q.iter().zip(&change).map(|(q, d)| q + d).collect();
                    let h = 0.01;
                    let step = CoordinateStep {
                        start: &q,
                        change: &change,
                        before: &before,
                        kept: 1.0,
                        linearised: &[],
                        h,
                        leg: OneLeg::default(),
                        across: false,
                    };
                    let mut force = vec![0.0; n];
                    let loss = system.forces.elements.add_discrete_gradient(
                        system.level,
                        system.forces.in_element.as_ref(),
                        step,
                        &mut force,
                    );
                    assert!(loss.numerical >= 0.0 && loss.effects >= 0.0, "{rule} {effects:?}: {loss:?}");
                    let work = -dot(&force, &change) / h;
                    let [(a0, b0), (a1, b1)] = [&q, &end].map(|q| system.forces.strain_energy(q));
                    // bending of other rules is held in the norm of T1
                    if rule.ends_with("T1") || rule.ends_with("none") {
                        let size = a0.abs() + b0.abs();
                        assert!((loss.strain - a0 - b0).abs() < 1e-12 * size, "{rule} {effects:?}: {}", loss.strain);
                    }
                    let [s0, s1] = [(&q, &before), (&end, &change)].map(|(q, d)| store(&system, q, d));
                    let gained = a1 - a0 + b1 - b0 + s1 - s0 + loss.numerical + loss.effects;
                    let scale =
                        [a0, a1, b0, b1, s0, s1, loss.numerical, loss.effects].map(f64::abs).iter().sum::<f64>();
                    worst = worst.max((work - gained).abs() / scale);
                }
            }
            println!("{rule}: off by {worst:.1e}");
            assert!(worst < 1e-14, "{rule} {effects:?}: {worst:e}");
        }
    }
}

/// The force of a step sums to zero and, without numerical dissipation of bending and damping, has
/// no moment about the mean configuration.
///
/// *Source.* Newton's third law, objectivity.
#[test]
fn the_force_has_no_resultant_and_no_moment_about_the_mean_configuration() {
    let mut random = Random(2);
    for rule in RULES {
        let system = cable(rule, Effects::default()).system;
        let n = 6 * (system.forces.elements.count() + 1);
        let q = coordinates(&mut random, n, 0.1);
        let change: Vec<f64> = (0..n).map(|_| 0.2 * random.next()).collect();
        // no second difference: nothing of bending is dissipated
        let step = CoordinateStep {
            start: &q,
            change: &change,
            before: &change,
            kept: 1.0,
            linearised: &[],
            h: 1.0,
            leg: OneLeg::default(),
            across: false,
        };
        let mut force = vec![0.0; n];
        system.forces.elements.add_discrete_gradient(system.level, None, step, &mut force);
        let mean: Vec<f64> = q.iter().zip(&change).map(|(q, d)| q + 0.5 * d).collect();
        let (mut sum, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (f, x) in force.chunks_exact(6).zip(mean.chunks_exact(6)) {
            let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);
            sum += vector(f);
            moment += vector(x).cross(&vector(f)) + vector(&x[3..]).cross(&vector(&f[3..]));
        }
        let scale = force.iter().fold(0.0f64, |m, f| m.max(f.abs()));
        assert!(sum.norm() < 1e-13 * scale && moment.norm() < 1e-12 * scale, "{rule}: {sum} {moment}");
    }
}

/// At rest, under a tension that is the same everywhere, the tangent is the derivative of the force
/// by the change: that of a difference quotient.
///
/// *Source.* Central differences, error 1e-8 of the largest entry.
#[test]
fn the_tangent_at_rest_is_the_derivative_of_the_force() {
    for rule in RULES {
        for of_cable in effects(rule) {
            // the geometric stiffness of a natural curvature is left out where it is negative
            if of_cable.rest_shape.is_some() {
                continue;
            }
            let system = &mut cable(rule, of_cable.clone()).system;
            let n = 6 * (system.forces.elements.count() + 1);
            // a helix of constant stretch would do; a stretched straight line has all terms but
            // those of bending's own stress
            let q: Vec<f64> = (0..n)
                .map(|i| {
                    let length =
                        3.0 / system.forces.elements.slope_scale((i / 6).min(system.forces.elements.count() - 1));
                    match i % 6 {
                        0 => 1.1 * length * (i / 6) as f64,
                        3 => 1.1,
                        _ => 0.0,
                    }
                })
                .collect();
            let still = vec![0.0; n];
            let h = 0.1;
            let force = |change: &[f64]| {
                let step = CoordinateStep {
                    start: &q,
                    change,
                    before: &still,
                    kept: 1.0,
                    linearised: &[],
                    h,
                    leg: OneLeg::default(),
                    across: false,
                };
                let mut out = vec![0.0; n];
                system.forces.elements.add_discrete_gradient(
                    system.level,
                    system.forces.in_element.as_ref(),
                    step,
                    &mut out,
                );
                out
            };
            let mut columns = Vec::new();
            for j in 0..n {
                let mut change = still.clone();
                change[j] = 1e-6;
                let plus = force(&change);
                change[j] = -1e-6;
                let minus = force(&change);
                columns.push(plus.iter().zip(&minus).map(|(p, m)| -(p - m) / 2e-6).collect::<Vec<f64>>());
            }
            let step = CoordinateStep {
                start: &q,
                change: &still,
                before: &still,
                kept: 1.0,
                linearised: &[],
                h,
                leg: OneLeg::default(),
                across: false,
            };
            let mut out = vec![0.0; n];
            system.step.matrix.resize(n / 6);
            let (level, effects) = (system.level, system.forces.in_element.as_ref());
            let to = MatrixOutput { matrix: &mut system.step.matrix, mass_scale: 1.0 };
            system.forces.elements.add_discrete_gradient_and_matrix(level, effects, step, &mut out, to);
            let tangent = system.step.matrix.clone();
            system.step.matrix.clear();
            system.mass.add_to(&mut system.step.matrix, 1.0);
            let mut worst = 0.0f64;
            for (block, mass, at) in tangent
                .diag
                .iter()
                .zip(&system.step.matrix.diag)
                .enumerate()
                .map(|(i, (b, m))| (b, m, (6 * i, 6 * i)))
                .chain(
                    tangent
                        .lower
                        .iter()
                        .zip(&system.step.matrix.lower)
                        .enumerate()
                        .map(|(i, (b, m))| (b, m, (6 * i + 6, 6 * i))),
                )
            {
                for c in 0..6 {
                    for r in 0..6 {
                        let entry = (block.0[c][r] - mass.0[c][r]) / (OneLeg::default().b * h);
                        worst = worst.max((entry - columns[at.1 + c][at.0 + r]).abs());
                    }
                }
            }
            let scale = columns.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
            println!("{rule}: tangent off by {:.1e}", worst / scale);
            assert!(worst < 1e-7 * scale, "{rule} {of_cable:?}: {worst:e} of {scale:e}");
        }
    }
}

/// With T1, or without bending, the step matrix is positive definite in any state and for any step.
///
/// *Source.* It is the sum of the mass matrix and of positive semi-definite terms.
#[test]
fn the_step_matrix_of_t1_and_of_no_bending_is_positive_definite() {
    let mut random = Random(3);
    for rule in ["projected-T1", "projected-none", "ST1", "mean-T1", "G2-T1"] {
        let rest =
            effects(rule).into_iter().filter(|e| e.rest_shape.as_ref().is_none_or(|r| r.pieces[1].curvature == 0.0));
        for of_cable in rest {
            let system = &mut cable(rule, of_cable.clone()).system;
            let n = 6 * (system.forces.elements.count() + 1);
            for _ in 0..30 {
                let q = coordinates(&mut random, n, 1.0);
                let change: Vec<f64> = (0..n).map(|_| random.next()).collect();
                let before: Vec<f64> = (0..n).map(|_| random.next()).collect();
                for h in [1e-3, 0.1, 10.0] {
                    let step = CoordinateStep {
                        start: &q,
                        change: &change,
                        before: &before,
                        kept: 1.0,
                        linearised: &[],
                        h,
                        leg: OneLeg::default(),
                        across: false,
                    };
                    let mut out = vec![0.0; n];
                    system.step.matrix.resize(n / 6);
                    let (level, effects) = (system.level, system.forces.in_element.as_ref());
                    let to = MatrixOutput { matrix: &mut system.step.matrix, mass_scale: 1.0 };
                    system.forces.elements.add_discrete_gradient_and_matrix(level, effects, step, &mut out, to);
                    let kind = Factorisation::default().factor(level, &system.step.matrix).unwrap();
                    assert_eq!(kind, Definiteness::PositiveDefinite, "{rule} {of_cable:?} {h}");
                }
            }
        }
    }
}
