//! Tests of cuts: the same solution as without them, and how the work grows with the pins.

use super::*;
use crate::contact::Border;
use crate::island::bordered::{Bordered, Lever};
use crate::island::condense::Columns;
use crate::island::hold::Held;
use crate::linalg::Factorisation;
use fearless_simd::Level;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// Numbers from -0.5 to 0.5.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }
}

/// A cable with pins, two on each body, and a body that it touches from end to end.
struct Bridge {
    matrix: BlockTridiagonal,
    pinned: Vec<usize>,
    arms: Vec<Vector3<f64>>,
    touched: Vec<Border>,
    rhs: Vec<f64>,
}

/// The solution, and the products of blocks in the condensation and the factors of the border.
struct Solved {
    x: Vec<f64>,
    bodies: Vec<f64>,
    products: usize,
}

impl Bridge {
    fn new(nodes: usize, pinned: impl Iterator<Item = usize>, touches: bool) -> Self {
        let mut random = Random(7);
        let mut matrix = BlockTridiagonal::zeros(nodes);
        for node in 0..nodes {
            for c in 0..6 {
                matrix.diag[node].0[c][c] = 6.0 + random.next();
                for r in c + 1..6 {
                    let value = random.next();
                    (matrix.diag[node].0[c][r], matrix.diag[node].0[r][c]) = (value, value);
                }
                if node + 1 < nodes {
                    (0..6).for_each(|r| matrix.lower[node].0[c][r] = random.next());
                }
            }
        }
        let pinned: Vec<usize> = pinned.collect();
        let mut vector = || Vector3::from_fn(|_, _| random.next());
        let arms = pinned.iter().map(|_| vector()).collect();
        let rhs = (0..6 * nodes).map(|_| random.next()).collect();
        let touched = (0..usize::from(touches)).map(|_| Border {
            body: 1,
            columns: (0..36 * nodes).map(|_| 0.1 * random.next()).collect(),
            block: Matrix6::identity(),
        });
        let touched = touched.collect();
        Bridge { matrix, pinned, arms, touched, rhs }
    }

    /// Solves with some of the pinned nodes cut.
    fn solve(&self, cuts: &[usize]) -> Solved {
        let (level, nodes) = (Level::new(), self.matrix.nodes());
        let bodies = self.pinned.len().div_ceil(2).max(2);
        let mut held: Vec<Held> = self.pinned.iter().map(|&node| Held { node, slope: false }).collect();
        held.extend(cuts.iter().rev().map(|&node| Held { node, slope: true }));
        let project = |first: usize, rows: &mut [f64]| {
            for (node, six) in (first..).zip(rows.chunks_exact_mut(6)) {
                if self.pinned.contains(&node) {
                    six[..3].fill(0.0);
                }
            }
        };
        let levers = || {
            let pins = self.arms.iter().enumerate().map(|(pin, arm)| Lever::held(pin / 2, arm, false));
            let touched = self.touched.iter().flat_map(|border| Lever::own(border.body));
            pins.chain((0..cuts.len()).map(|cut| Lever::of_own(bodies, cut))).chain(touched).collect::<Vec<_>>()
        };
        let mut bordered = Bordered::default();
        bordered.resize(1);
        bordered.begin(bodies, [cuts.len()].into_iter(), 0);
        (0..bodies).for_each(|body| bordered.add_inertia(body, &(Matrix6::identity() * 9.0)));
        bordered.add_rotational(0, &Matrix3::identity());
        let mut matrix = self.matrix.clone();
        bordered.cable(0).read(&matrix, &held, &self.touched);
        cut(cuts, &mut matrix);
        for &node in &self.pinned {
            for c in 0..6 {
                (0..6).filter(|r| c < 3 || *r < 3).for_each(|r| matrix.diag[node].0[c][r] = f64::from(r == c));
                matrix.lower[node - 1].0[c][..3].fill(0.0);
            }
            matrix.lower[node].0[..3].fill([0.0; 8]);
        }
        let mut factors = Factorisation::default();
        factors.factor(level, &matrix).unwrap();
        let columns = Columns { held: &held, cuts, touched: &self.touched, ..Columns::default() };
        bordered.cable(0).complete(level, &factors, columns, project);
        bordered.levers(0).extend(levers());
        bordered.add_cable(0);
        bordered.factor().unwrap();
        assert_eq!(bordered.negative(), 0);
        let (mut x, mut rows) = (self.rhs.clone(), vec![0.0; bordered.rows()]);
        rows[..6 * bodies].iter_mut().enumerate().for_each(|(i, row)| *row = (i as f64).sin());
        take(cuts, &mut x, &mut rows[6 * bodies..]);
        project(0, &mut x);
        bordered.reduce(0, (level, &factors), &mut x, &mut rows);
        bordered.solve(&mut rows);
        let moved = bordered.expand(0, (level, &factors), &mut x, &rows).to_vec();
        give(cuts, &moved[3 * self.pinned.len()..], &mut x);
        for (node, three) in self.pinned.iter().zip(moved.chunks_exact(3)) {
            x[6 * node..6 * node + 3].copy_from_slice(three);
        }
        assert_eq!(x.len(), 6 * nodes);
        rows.truncate(6 * bodies);
        Solved { x, bodies: rows, products: bordered.products() }
    }
}

/// Pins at every node, at every second and fourth one, an odd number of them, some of them cut,
/// with and without a touched body: the increments are those without cuts.
///
/// *Source.* The same equations with all slopes among the cable's own unknowns.
#[test]
fn a_cut_cable_has_the_same_solution() {
    for (pins, every, touches) in [(7, 1, false), (8, 1, true), (9, 2, false), (12, 4, true), (5, 4, false)] {
        let bridge = Bridge::new(every * (pins + 1) + 1, (1..=pins).map(|pin| every * pin), touches);
        let whole = bridge.solve(&[]);
        let some: Vec<usize> = bridge.pinned.iter().copied().step_by(3).collect();
        for cuts in [&bridge.pinned[..], &some[..], &bridge.pinned[..1]] {
            let found = bridge.solve(cuts);
            let pairs = found.x.iter().zip(&whole.x).chain(found.bodies.iter().zip(&whole.bodies));
            let off = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(off < 1e-13, "{pins} pins, every {every}, {} cuts: {off:e}", cuts.len());
        }
    }
}

/// The products of blocks of a solution of 20, 40, 80 and 160 pins are proportional to the pins;
/// without cuts they grow with a higher power.
///
/// *Source.* Each stretch between two cuts is coupled with its neighbours alone.
#[test]
fn the_work_grows_with_the_number_of_pins() {
    for every in [1, 2, 5] {
        let products = |pins: usize, cut: bool| {
            let bridge = Bridge::new(every * (pins + 1) + 1, (1..=pins).map(|pin| every * pin), false);
            bridge.solve(if cut { &bridge.pinned } else { &[] }).products
        };
        for pins in 4..=16 {
            let [whole, cut] = [false, true].map(|cut| products(pins, cut));
            println!("{pins} pins, every {every}: {whole} without cuts, {cut} with");
            assert!(pins < MIN_CUTS || cut < whole, "{pins} pins, every {every}: {whole} and {cut}");
        }
        for pins in [20, 40, 80] {
            let [one, two] = [pins, 2 * pins].map(|pins| products(pins, true));
            let [whole, twice] = [pins, 2 * pins].map(|pins| products(pins, false));
            println!("{pins} pins, every {every}: {whole} to {twice} without cuts, {one} to {two} with");
            assert!(two as f64 <= 2.1 * one as f64, "{pins} pins, every {every}: {one} to {two}");
            assert!(one < whole && twice > 3 * whole, "{pins} pins, every {every}: {whole} to {twice}");
        }
    }
}
