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
//! # Validity
//!
//! A is one linearised implicit Euler step; if compression makes it indefinite, D and K are halved until it is positive definite.

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
        let level = Level::new();
        let mut factorisation = Factorisation::default();
        let mut share = 1.0;
        let is_positive_definite = (0..=HALVINGS).any(|halving| {
            share = 0.5f64.powi(halving);
            let mut a = combine(&mass, &damping, share * h, &stiffness, share * h * h);
            cable.apply_supports(&mut a);
            matches!(factorisation.factor(level, &a), Ok(Definiteness::PositiveDefinite))
        });
        let none = || {
            let message =
                format!("cable {:?}: no impedance at t = {} s for a step of {h} s", cable.name(), cable.time());
            Raise::new("ImpedanceError", message)
                .with("cable", cable.name())
                .with("time", cable.time())
                .with("value", h)
        };
        if !is_positive_definite {
            return Err(none());
        }
        let size = cable.positions().len();
        let (mut rows, mut maps) = (Vec::new(), Vec::new());
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
        let mut supple = Vec::new();
        for TwistBorder { nodes, stiffness, damping, gradient, .. } in borders {
            let spin = |(i, end): (usize, &End)| {
                end.direction?;
                let sign = nodes.iter().zip([1.0, -1.0]).find(|(node, _)| **node == end.node)?.1;
                let at = 6 * end.node + 3;
                let slope = Vector3::from_column_slice(&cable.positions()[at..at + 3]);
                Some((i, Vector3::zeros(), slope.try_normalize(0.0)? * sign))
            };
            maps.push(self.ends.iter().enumerate().filter_map(spin).collect());
            rows.push(held_out(&cable, gradient));
            supple.push((share * h * (damping + h * stiffness)).recip());
        }
        let count = rows.len();
        let mut border = SchurComplement::default();
        border.begin(factorisation.nodes(), count);
        rows.iter().enumerate().for_each(|(k, row)| border.set(k, 0, row));
        border.complete(level, &factorisation);
        let mut compliance = DMatrix::zeros(count, count);
        border.subtract_from(level, compliance.as_mut_slice());
        let mut compliance = -compliance;
        supple.iter().enumerate().for_each(|(k, own)| compliance[(firm + k, firm + k)] += own);
        let p = DMatrix::from_fn(count, 6 * self.ends.len(), |r, c| {
            let own = maps[r].iter().filter(|(end, ..)| *end == c / 6);
            own.map(|(_, linear, angular)| if c % 6 < 3 { linear[c % 6] } else { angular[c % 6 - 3] }).sum::<f64>()
        });
        let z = p.transpose() * compliance.try_inverse().ok_or_else(none)? * p;
        if z.iter().all(|x| x.is_finite()) { Ok(z) } else { Err(none()) }
    }
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
