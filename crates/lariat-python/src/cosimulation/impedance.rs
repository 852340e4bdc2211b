//! The impedance of a cable between bodies that another program moves.
//!
//! # Equation
//!
//! The impedance is the matrix Z (6x6 for each pair of bodies, velocity before angular velocity, about the reference points) by which
//! the impulse on the bodies changes when their velocities at the end of a step differ by dv from the prescribed ones: dJ = -Z dv.
//!
//! ```text
//! A = M + h D + h^2 K        C = B A^-1 B^T        Z = P^T C^-1 P
//! ```
//!
//! B selects the coordinates of the cable that the bodies hold, and P are the velocities of these by those of the bodies.
//!
//! A segment of a cable with torsion, of stiffness K_s and damping C_s, has the twist rate g.v + w: v are the velocities of the coordinates, w
//! is the spin of the body at its last node about the slope there, less that at its first. It adds k g g^T, k = h C_s + h^2 K_s, and acts on
//! the bodies, too: one more row g of B, with 1/k on its place of the diagonal of C, and -w in P. (The least energy k y^2/2 of the rates y that the
//! row may be off by is that of a spring between them.)
//!
//! *What is factored* is A' = A + s B^T B in place of A, whose C'^-1 is that of A plus s on the diagonal of the rows of B: for long steps A is
//! almost singular, since a cable that nothing holds may move as it is. With s of the size of the diagonal of A at the ends the rounding of Z
//! is that of A.
//!
//! # Validity
//!
//! A is one linearised implicit Euler step. The cable must be stable while the bodies hold still: if it is not, D and K are halved until it is. By the
//! additivity of inertia (Haynsworth 1968) it is stable where A' and C' have as many negative eigenvalues, so that neither a cable whose ends are
//! pushed together, nor one that the spin of its ends alone keeps from kinking, counts as unstable; their Z may be indefinite.
//! Forces and moments of the ends turn with them: this stiffness of the second order, of the size of h^2 times the moment, is not in Z.

use super::link::{End, Link};
use crate::error::Raise;
use fearless_simd::Level;
use lariat_ancf::coupling::{Coupling, Linearisation, TwistBorder};
use lariat_ancf::linalg::{BlockTridiagonal, Definiteness, Factorisation, SchurComplement};
use lariat_ancf::{self as ancf, At, Vector3};
use nalgebra::DMatrix;

/// Largest number of times that D and K are halved.
const HALVINGS: i32 = 40;

impl Link {
    /// Returns Z; see the page of this module.
    pub(super) fn impedance(&self, cable: &ancf::Cable, h: f64) -> Result<DMatrix<f64>, Raise> {
        let mut cable = cable.clone();
        // while the bodies hold the spin
        let borders = cable.twist_borders();
        let (mass, stiffness, damping) = (cable.mass_matrix(), cable.stiffness_matrix(), cable.damping_matrix());
        for end in &self.ends {
            cable.detach(At::Node(end.node))?;
        }
        let size = cable.positions().len();
        let (mut rows, mut maps): (Vec<Vec<f64>>, Vec<Map>) = (Vec::new(), Vec::new());
        for (i, end) in self.ends.iter().enumerate() {
            let lever = end.motion.rotation * end.anchor;
            for axis in 0..3 {
                let mut row = vec![0.0; size];
                row[6 * end.node + axis] = 1.0;
                rows.push(row);
                let unit = Vector3::ith(axis, 1.0);
                // (omega x lever) . unit = omega . (lever x unit)
                maps.push(vec![(i, unit, lever.cross(&unit))]);
            }
            if end.direction.is_some() {
                let at = 6 * end.node + 3;
                let slope = Vector3::from_column_slice(&cable.positions()[at..at + 3]);
                let tangent = slope.normalize();
                let across = if tangent.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
                let first = tangent.cross(&across).normalize();
                for unit in [first, tangent.cross(&first)] {
                    let mut row = vec![0.0; size];
                    // omega . unit = unit . (t x t')/|t|^2
                    row[at..at + 3].copy_from_slice((unit.cross(&slope) / slope.norm_squared()).as_slice());
                    rows.push(row);
                    maps.push(vec![(i, Vector3::zeros(), unit)]);
                }
            }
        }
        let firm = rows.len();
        for TwistBorder { nodes, gradient, .. } in &borders {
            let spin = |(i, end): (usize, &End)| {
                end.direction?;
                let sign = nodes.iter().zip([1.0, -1.0]).find(|(node, _)| **node == end.node)?.1;
                let at = 6 * end.node + 3;
                let slope = Vector3::from_column_slice(&cable.positions()[at..at + 3]);
                Some((i, Vector3::zeros(), slope.try_normalize(0.0)? * sign))
            };
            maps.push(self.ends.iter().enumerate().filter_map(spin).collect());
            rows.push(held_out(&cable, gradient.clone()));
        }
        let count = rows.len();
        let p = DMatrix::from_fn(count, 6 * self.ends.len(), |r, c| {
            let own = maps[r].iter().filter(|(end, ..)| *end == c / 6);
            own.map(|(_, linear, angular)| if c % 6 < 3 { linear[c % 6] } else { angular[c % 6 - 3] }).sum::<f64>()
        });
        let of_share = |share: f64| -> Option<DMatrix<f64>> {
            let mut a = combine(&mass, &damping, share * h, &stiffness, share * h * h);
            cable.apply_supports(&mut a);
            let shifts: Vec<f64> = rows[..firm].iter().map(|row| shift(&mut a, row)).collect();
            let (level, mut factorisation) = (Level::new(), Factorisation::default());
            let negative = match factorisation.factor(level, &a).ok()? {
                Definiteness::PositiveDefinite => 0,
                Definiteness::Indefinite { negative } => negative?,
            };
            let mut border = SchurComplement::default();
            border.begin(factorisation.nodes(), count);
            rows.iter().enumerate().for_each(|(k, row)| border.set(k, 0, row));
            border.complete(level, &factorisation);
            let mut compliance = DMatrix::zeros(count, count);
            border.subtract_from(level, compliance.as_mut_slice());
            let mut compliance = -compliance;
            for (k, TwistBorder { stiffness, damping, .. }) in borders.iter().enumerate() {
                compliance[(firm + k, firm + k)] += (share * h * (damping + h * stiffness)).recip();
            }
            let mut held = inverse_with(compliance, negative)?;
            shifts.iter().enumerate().for_each(|(k, shift)| held[(k, k)] -= shift);
            let z = p.transpose() * held * &p;
            z.iter().all(|x| x.is_finite()).then_some(z)
        };
        (0..=HALVINGS).find_map(|halving| of_share(0.5f64.powi(halving))).ok_or_else(|| {
            let message =
                format!("cable {:?}: no impedance at t = {} s for a step of {h} s", cable.name(), cable.time());
            Raise::new("ImpedanceError", message)
                .with("cable", cable.name())
                .with("time", cable.time())
                .with("value", h)
        })
    }
}

/// Ends, and the velocity and the angular velocity by which each of them moves a row.
type Map = Vec<(usize, Vector3<f64>, Vector3<f64>)>;

/// Adds s b b^T to a matrix, with a row b that has entries at one node alone, and returns s: the largest entry of the diagonal where b has
/// entries, over the square of b.
fn shift(a: &mut BlockTridiagonal, row: &[f64]) -> f64 {
    let Some(node) = row.iter().position(|x| *x != 0.0).map(|at| at / 6) else { return 0.0 };
    let (own, block) = (&row[6 * node..6 * node + 6], &mut a.diag[node].0);
    let largest = (0..6).filter(|&i| own[i] != 0.0).map(|i| block[i][i].abs()).fold(0.0, f64::max);
    let shift = largest / own.iter().map(|x| x * x).sum::<f64>();
    for (column, y) in block.iter_mut().zip(own) {
        column.iter_mut().zip(own).for_each(|(entry, x)| *entry += shift * x * y);
    }
    shift
}

/// Returns the inverse of a symmetric matrix that has a number of negative eigenvalues; `None` if it has others, or is singular.
fn inverse_with(matrix: DMatrix<f64>, negative: usize) -> Option<DMatrix<f64>> {
    // rows are of different units: each by its own size
    let scales: Vec<f64> = matrix.diagonal().iter().map(|x| x.abs().sqrt().recip()).collect();
    let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |r, c| {
        0.5 * (matrix[(r, c)] + matrix[(c, r)]) * scales[r] * scales[c]
    });
    if scaled.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let inverse = scaled.clone().try_inverse()?;
    if scaled.symmetric_eigenvalues().iter().filter(|x| **x <= 0.0).count() != negative {
        return None;
    }
    Some(DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |r, c| inverse[(r, c)] * scales[r] * scales[c]))
}

/// Returns derivatives by the coordinates without those that the supports hold.
fn held_out(cable: &ancf::Cable, mut gradient: Vec<f64>) -> Vec<f64> {
    let mut kept = BlockTridiagonal::zeros(cable.nodes());
    cable.apply_supports(&mut kept);
    // of the projector on what is held, the diagonal blocks are symmetric
    for (own, block) in gradient.chunks_exact_mut(6).zip(&kept.diag) {
        let before: Vec<f64> = own.to_vec();
        for (column, x) in block.0.iter().zip(before) {
            own.iter_mut().zip(column).for_each(|(own, held)| *own -= held * x);
        }
    }
    gradient
}

/// Returns `m + a c + b k`.
fn combine(m: &BlockTridiagonal, c: &BlockTridiagonal, a: f64, k: &BlockTridiagonal, b: f64) -> BlockTridiagonal {
    let mut sum = m.clone();
    let pairs = [(c, a), (k, b)];
    for (matrix, factor) in pairs {
        let blocks = matrix.diag.iter().chain(&matrix.lower);
        for (target, block) in sum.diag.iter_mut().chain(&mut sum.lower).zip(blocks) {
            target.0.iter_mut().flatten().zip(block.0.iter().flatten()).for_each(|(t, x)| *t += factor * x);
        }
    }
    sum
}
