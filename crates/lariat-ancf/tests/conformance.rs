//! One suite over every pair of an axial and a bending rule: derivatives, frame indifference, rest, and modes without
//! energy.

mod common;

use common::{Random, dense, largest_difference, map3};
use lariat_ancf::axial::AxialTable;
use lariat_ancf::bending::{Bending, NoBending, gauss::Gauss, t1::RHO, t1::T1, t2::T2};
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::element::gram::{form, gram};
use lariat_ancf::element::kernel::{Stiffness, energy, force, force_and_tangent};
use lariat_ancf::{AxialRule, BendingRule, Cable, Rule, Section, Vector3};
use nalgebra::{DMatrix, Matrix3};

/// Flat control vectors of one element.
type Flat = [f64; 9];

/// Energies of the order of 1, axial and bending alike.
const STIFFNESS: Stiffness<f64> = Stiffness { axial: 3.0, bending: 0.7 };

fn axial_rules() -> impl Iterator<Item = AxialRule> {
    [AxialRule::Projected, AxialRule::Exact, AxialRule::Mean].into_iter().chain((1..=10).map(AxialRule::Gauss))
}

fn bending_rules() -> impl Iterator<Item = BendingRule> {
    [BendingRule::None, BendingRule::T1, BendingRule::T2].into_iter().chain((1..=10).map(BendingRule::Gauss))
}

/// Calls a generic check with the table and the bending kernel of every rule.
macro_rules! for_every_rule {
    ($check:ident) => {
        for axial in axial_rules() {
            for bending in bending_rules() {
                let rule = Rule::new(axial, bending);
                let table = &rule.axial_table();
                match bending {
                    BendingRule::None => $check(rule, table, &NoBending),
                    BendingRule::T1 => $check(rule, table, &T1),
                    BendingRule::T2 => $check(rule, table, &T2::default()),
                    BendingRule::Gauss(points) => $check(rule, table, &Gauss::new(points as usize)),
                }
            }
        }
    };
}

fn control(d: &Flat) -> [[f64; 3]; 3] {
    [[d[0], d[1], d[2]], [d[3], d[4], d[5]], [d[6], d[7], d[8]]]
}

fn flat(d: [[f64; 3]; 3]) -> Flat {
    core::array::from_fn(|i| d[i / 3][i % 3])
}

/// A stretched, bent element in space: r' within 0.4 of (1.1, 0, 0).
fn bent(random: &mut Random) -> Flat {
    let mut d = [0.0; 9];
    for (k, size) in [1.1, 3.3, 1.1].into_iter().enumerate() {
        d[3 * k] = size;
        for x in 0..3 {
            d[3 * k + x] += 0.15 * size * random.next();
        }
    }
    d
}

/// Derivative of a vector function by central differences, Richardson-extrapolated: error about 1e-12.
fn difference<const N: usize>(f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let central = |h: f64| -> [f64; N] {
        let (a, b) = (f(h), f(-h));
        core::array::from_fn(|i| (a[i] - b[i]) / (2.0 * h))
    };
    let (h1, h2, h4) = (central(4e-3), central(2e-3), central(1e-3));
    core::array::from_fn(|i| {
        let (coarse, fine) = ((4.0 * h2[i] - h1[i]) / 3.0, (4.0 * h4[i] - h2[i]) / 3.0);
        (16.0 * fine - coarse) / 15.0
    })
}

fn size(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// The tangent as a dense 9x9 matrix.
fn tangent<B: Bending>(table: &AxialTable, bending: &B, d: &Flat) -> DMatrix<f64> {
    let (_, blocks) = force_and_tangent(table, bending, STIFFNESS, &control(d));
    let mut m = DMatrix::zeros(9, 9);
    for (block, (i, k)) in blocks.iter().zip([(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]) {
        for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
            m[(3 * i + r, 3 * k + c)] = block[r][c];
            m[(3 * k + c, 3 * i + r)] = block[r][c];
        }
    }
    m
}

/// The force is the gradient of the energy, and the tangent the gradient of the force; the diagonal blocks are
/// symmetric.
///
/// *Source.* Central differences of the energy and of the force. Of the paper's rules T2 fails this if fbar is frozen
/// while differentiating.
#[test]
fn force_is_the_gradient_of_the_energy_and_the_tangent_that_of_the_force() {
    fn check<B: Bending>(rule: Rule, table: &AxialTable, bending: &B) {
        let mut random = Random::new(7);
        let mut worst = [0.0f64; 2];
        // regular, and crumpled to a fifth, where powers of 1/|r'| are continued
        for scale in [1.0, 1.0, 1.0, 0.2, 0.2] {
            let d = bent(&mut random).map(|x| scale * x);
            let at = |i: usize, h: f64| {
                let mut d = d;
                d[i] += h;
                control(&d)
            };
            let f = flat(force(table, bending, STIFFNESS, &control(&d)));
            let k = tangent(table, bending, &d);
            for i in 0..9 {
                let [du] = difference(|h| {
                    let (axial, bent) = energy(table, bending, STIFFNESS, &at(i, h));
                    [axial + bent]
                });
                worst[0] = worst[0].max((du - f[i]).abs() / size(&f));
                let column = difference(|h| flat(force(table, bending, STIFFNESS, &at(i, h))));
                for j in 0..9 {
                    worst[1] = worst[1].max((column[j] - k[(j, i)]).abs() / k.amax());
                }
            }
            let (again, blocks) = force_and_tangent(table, bending, STIFFNESS, &control(&d));
            assert!(size(&core::array::from_fn::<_, 9, _>(|i| flat(again)[i] - f[i])) <= 1e-14 * size(&f), "{rule}");
            for block in [blocks[0], blocks[3], blocks[5]] {
                let m = Matrix3::from_fn(|r, c| block[r][c]);
                assert!((m - m.transpose()).amax() <= 1e-13 * k.amax(), "{rule}: tangent not symmetric");
            }
        }
        assert!(worst[0] < 1e-10 && worst[1] < 1e-9, "{rule}: force {:e}, tangent {:e}", worst[0], worst[1]);
    }
    for_every_rule!(check);
}

/// An element whose slope passes through zero has a finite force, tangent and energy.
///
/// *Source.* The bounds of the continued powers (bending/regularisation.rs) in terms of the mean of |r''|^2, rho.g: Q f <= 2/Q_c^2 at a point,
/// and for T2 f <= 6/Q_c^2.
#[test]
fn an_element_turned_inside_out_is_regular() {
    fn check<B: Bending>(rule: Rule, table: &AxialTable, bending: &B) {
        let bound = if rule.bending == BendingRule::T2 { 96.0 } else { 32.0 };
        for size in [0.0, 1e-12, 1e-3, 0.1, 0.3] {
            // r' from (size, 0, 0) to (-size, 0, 0), half as much across
            let d: Flat = [size, 0.0, 0.0, 0.0, 1.5 * size, 0.0, -size, 0.0, 0.0];
            let (f, blocks) = force_and_tangent(table, bending, STIFFNESS, &control(&d));
            assert!(flat(f).iter().all(|x| x.is_finite()), "{rule}");
            assert!(blocks.iter().flatten().flatten().all(|x| x.is_finite()), "{rule}");
            let (_, bent) = energy(table, bending, STIFFNESS, &control(&d));
            let most = STIFFNESS.bending * bound * form(&RHO, &gram(&control(&d)));
            assert!(bent.is_finite() && bent <= most * (1.0 + 1e-12), "{rule}: {bent:e}, at most {most:e}");
        }
    }
    for_every_rule!(check);
}

/// A rotated element has the rotated force and the same energy: F(R d) = R F(d).
///
/// *Source.* Objectivity; the rules see Gram numbers only, which do not change.
#[test]
fn a_rotated_element_has_the_rotated_force_and_the_same_energy() {
    fn check<B: Bending>(rule: Rule, table: &AxialTable, bending: &B) {
        let mut random = Random::new(11);
        for _ in 0..3 {
            let (d, rotation) = (bent(&mut random), random.rotation());
            let turned = control(&map3(&d, |v| rotation * v).try_into().unwrap());
            let (u, v) = (energy(table, bending, STIFFNESS, &control(&d)), energy(table, bending, STIFFNESS, &turned));
            assert!((u.0 + u.1 - v.0 - v.1).abs() <= 1e-13, "{rule}: {u:?} {v:?}");
            let here = flat(force(table, bending, STIFFNESS, &control(&d)));
            let there = flat(force(table, bending, STIFFNESS, &turned));
            let expected = map3(&here, |v| rotation * v);
            assert!(largest_difference(&there, &expected) <= 1e-12 * size(&here), "{rule}");
        }
    }
    for_every_rule!(check);
}

/// The straight unstressed element has no force and a finite tangent; the straight stretched one carries N = EA f (f^2
/// - 1)/2.
///
/// *Source.* The Green law. Finite-difference tangents of other codes are rank deficient here; one axial point does not
/// integrate the virtual strain of a slope, so its nodal forces are left out (its energy is right).
#[test]
fn straight_element_is_at_rest_unstressed_and_carries_the_green_law_stretched() {
    fn check<B: Bending>(rule: Rule, table: &AxialTable, bending: &B) {
        let along = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        let straight =
            |f: f64| control(&core::array::from_fn(|i| f * along[i % 3] * if i / 3 == 1 { 3.0 } else { 1.0 }));
        let rest = flat(force(table, bending, STIFFNESS, &straight(1.0)));
        assert!(size(&rest) < 1e-14, "{rule}: {rest:?}");
        let k = tangent(table, bending, &flat(straight(1.0)));
        assert!(k.iter().all(|x| x.is_finite()), "{rule}");
        let f = 1.2;
        let (axial, bent) = energy(table, bending, STIFFNESS, &straight(f));
        // U = EA l/8 (f^2 - 1)^2, EA l/4 = STIFFNESS.axial
        let expected = 0.5 * STIFFNESS.axial * (f * f - 1.0f64).powi(2);
        assert!((axial - expected).abs() < 1e-13 && bent.abs() < 1e-13, "{rule}: {axial} {bent}");
        if rule.axial == AxialRule::Gauss(1) {
            return;
        }
        // dU/dr_j = (3/l) G1 = N
        let [g0, g1, g2] = force(table, bending, STIFFNESS, &straight(f));
        let n = 4.0 * STIFFNESS.axial * f * (f * f - 1.0) / 2.0;
        for x in 0..3 {
            assert!((3.0 * g1[x] - n * along[x]).abs() < 1e-12, "{rule}: {g1:?}");
            assert!(g0[x].abs() < 1e-13 && g2[x].abs() < 1e-13, "{rule}: {g0:?} {g2:?}");
        }
    }
    for_every_rule!(check);
}

/// A straight cable at rest, unit stiffness, unit element length, without gravity.
fn chain(rule: Rule, elements: usize) -> Cable {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(elements as f64, 0.0, 0.0)])
        .section(Section::from_stiffness(1.0, if rule.bending == BendingRule::None { 0.0 } else { 1.0 }, 1.0).unwrap())
        .elements(elements)
        .gravity(Vector3::zeros())
        .rule(rule)
        .allow_rank_deficient()
        .build()
        .unwrap()
}

/// Zero eigenvalues of the stiffness of a straight cable at rest: 3 translations and 2 rotations (it has no twist), all
/// transverse motions without bending (4 per node, of which 4 are rigid), and whatever a rule adds. Rules that add are
/// exactly those that `Rule::check` refuses.
///
/// *Source.* Counting: an element has three axial strain numbers and two curvatures per direction; L or T points see at
/// most L or T of them. So G2-x leaves one axial mode of the whole chain (the one that spoils G2-2 in Table 1), G1 and
/// mean strain as many as elements plus one, T = 1 one per element and direction; T1 and T2 hold the slope and remove
/// the axial ones.
#[test]
fn modes_without_energy_are_those_counted_and_only_in_rules_that_are_refused() {
    for axial in axial_rules() {
        for (bending, elements) in bending_rules().flat_map(|b| [1, 2, 7].map(|e| (b, e))) {
            let rule = Rule::new(axial, bending);
            let eigenvalues = dense(&chain(rule, elements).stiffness_matrix()).symmetric_eigenvalues();
            assert!(eigenvalues.min() > -1e-10 * eigenvalues.max(), "{rule}: unstable at rest");
            let found = eigenvalues.iter().filter(|x| x.abs() < 1e-10 * eigenvalues.max()).count();
            let limp = if bending == BendingRule::None { 4 * elements } else { 0 };
            let spare_axial = match (axial, bending) {
                (_, BendingRule::T1 | BendingRule::T2) => 0,
                (AxialRule::Mean | AxialRule::Gauss(1), _) => elements + 1,
                (AxialRule::Gauss(2), _) => 1,
                _ => 0,
            };
            let spare_bending = if bending == BendingRule::Gauss(1) { 2 * elements } else { 0 };
            assert_eq!(found, 5 + limp + spare_axial + spare_bending, "{rule}, {elements} elements");
            let spare = found - 5 - limp;
            assert_eq!(spare > 0, rule.check().is_err(), "{rule}: {spare} spare modes");
        }
    }
}

/// Rigid motion of a whole cable, bent and stretched: translation leaves the force, rotation rotates it.
///
/// *Source.* Objectivity. Rounding of the coordinates enters as EA/l ulp(position).
#[test]
fn rigid_motion_of_a_cable_leaves_its_force() {
    let mut random = Random::new(3);
    for rule in axial_rules().flat_map(|a| bending_rules().map(move |b| Rule::new(a, b))) {
        let mut cable = chain(rule, 5);
        let rest: Vec<f64> = cable.positions().to_vec();
        let q: Vec<f64> = rest.iter().map(|x| x + 0.1 * random.next()).collect();
        let zero = vec![0.0; q.len()];
        cable.set_coordinates(&q, &zero).unwrap();
        let force = cable.force();
        let (rotation, shift) = (random.rotation(), random.vector() * 3.0);
        let mut moved = map3(&q, |v| rotation * v);
        for node in moved.chunks_exact_mut(6) {
            (0..3).for_each(|x| node[x] += shift[x]);
        }
        cable.set_coordinates(&moved, &zero).unwrap();
        let expected = map3(&force, |v| rotation * v);
        assert!(largest_difference(&cable.force(), &expected) <= 1e-12 * size(&force).max(1.0), "{rule}");
    }
}

/// The cable's force, computed eight elements at a time with the vector unit of this machine, is the sum of the scalar
/// kernels to the bit.
///
/// *Source.* IEEE 754: the lanes do the same operations in the same order, so the result is the same on every machine.
/// Eleven elements fill one group of lanes and a part of the next.
#[test]
fn lanes_give_the_bits_of_the_scalar_kernel() {
    fn check<B: Bending>(rule: Rule, table: &AxialTable, bending: &B) {
        let mut random = Random::new(5);
        let mut cable = chain(rule, 11);
        let q: Vec<f64> = cable.positions().iter().map(|x| x + 0.1 * random.next()).collect();
        cable.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
        let mut sum = vec![0.0; q.len()];
        for (e, element) in cable.elements().iter().enumerate() {
            let (l, section) = (element.length, element.section);
            let s = 3.0 / l;
            let n = &q[6 * e..6 * e + 12];
            let d = [[n[3], n[4], n[5]], core::array::from_fn(|x| s * (n[6 + x] - n[x])), [n[9], n[10], n[11]]];
            let stiffness =
                Stiffness { axial: 0.25 * section.axial_stiffness * l, bending: 2.0 * section.bending_stiffness / l };
            let g = force(table, bending, stiffness, &d);
            for x in 0..3 {
                sum[6 * e + x] += g[1][x] * s;
                sum[6 * e + 3 + x] -= g[0][x];
                sum[6 * e + 6 + x] -= g[1][x] * s;
                sum[6 * e + 9 + x] -= g[2][x];
            }
        }
        assert_eq!(cable.force(), sum, "{rule}");
    }
    for_every_rule!(check);
}

/// The assembled stiffness is minus the derivative of the assembled force, with a point load, for pieces of different
/// section.
///
/// *Source.* Central differences.
#[test]
fn stiffness_of_a_loaded_cable_of_two_pieces_is_the_derivative_of_its_force() {
    for name in ["projected-3", "G5-3", "ST2", "L2T2", "G3-T1", "exact-none"] {
        let section = |k: f64| Section::from_stiffness(3.0 * k, 0.4 * k, 1.0).unwrap();
        let mut cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(1.0, 0.2, 0.0), Vector3::new(2.0, 0.0, 0.0)])
            .section(section(1.0))
            .section_from(0.7, section(2.5))
            .elements(3)
            .rule(common::rule(name))
            .load(lariat_ancf::PointLoad::force(0.3, Vector3::new(0.1, 0.2, -0.3)))
            .build()
            .unwrap();
        let q = cable.positions().to_vec();
        let zero = vec![0.0; q.len()];
        let k = dense(&cable.stiffness_matrix());
        assert!((&k - k.transpose()).amax() <= 1e-15 * k.amax());
        for i in 0..q.len() {
            let central = |h: f64, cable: &mut Cable| {
                let mut at = |h: f64| {
                    let mut moved = q.clone();
                    moved[i] += h;
                    cable.set_coordinates(&moved, &zero).unwrap();
                    cable.force()
                };
                let (a, b) = (at(h), at(-h));
                a.iter().zip(&b).map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<_>>()
            };
            let (coarse, fine) = (central(1e-3, &mut cable), central(5e-4, &mut cable));
            for j in 0..q.len() {
                let derivative = (4.0 * fine[j] - coarse[j]) / 3.0;
                assert!(
                    (derivative + k[(j, i)]).abs() < 1e-8 * k.amax(),
                    "{name}: ({j}, {i}) {derivative} {}",
                    -k[(j, i)]
                );
            }
        }
    }
}
