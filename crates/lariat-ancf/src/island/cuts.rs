//! Cuts: nodes on bodies at which a cable is divided into stretches.
//!
//! # Equation
//!
//! A pin holds the position of a node, and its slope alone couples the cable on both sides of it.
//! If the slope is an unknown of the border, beside the bodies, each stretch between two cuts is
//! condensed on its own two ends:
//!
//! ```text
//! (D L^T .; L D L^T; . L D)  ->  W couples slopes and bodies at neighbouring cuts alone
//! ```
//!
//! so that the border of a cable on n bodies has of the order of n blocks. Without cuts W couples
//! all bodies along a cable with each other: n^2 blocks, and n^3 operations for their factors.
//!
//! # Validity
//!
//! At pins on bodies that can move, between other nodes, with a free slope. The solution is the
//! same but for rounding: unknowns are eliminated in another order. A clamped slope has its length
//! free, and no cut.
//!
//! # References
//!
//! Nested substructures: Przemieniecki, AIAA J. 1 (1963) 138; the order of elimination: George,
//! SIAM J. Numer. Anal. 10 (1973) 345.
//!
//! # Alternatives considered
//!
//! docs/decisions/border.md.

use super::body::RigidBody;
use super::hold::Hold;
use super::pin::PinConstraint;
use crate::cable::Cable;
use crate::linalg::{Block, BlockTridiagonal};
use crate::scales::island::MIN_CUTS;

/// Finds the nodes at which a cable with some holds, in the order of nodes, is cut.
pub(super) fn find(
    cable: &Cable,
    holds: &[Hold],
    (bodies, pins): (&[RigidBody], &[PinConstraint]),
    cuts: &mut Vec<usize>,
) {
    cuts.clear();
    if holds.len() < MIN_CUTS || cable.model.effects.torsion.is_some() {
        return;
    }
    let last = cable.nodes() - 1;
    let is_free = |hold: &&Hold| {
        let pin = &pins[hold.pin];
        pin.direction.is_none()
            && bodies[pin.body].free.contains(&true)
            && (1..last).contains(&hold.node)
            && !cable.model.support(hold.node).is_some_and(|support| support.holds_slope())
    };
    cuts.extend(holds.iter().filter(is_free).map(|hold| hold.node));
    if cuts.len() < MIN_CUTS {
        cuts.clear();
    }
}

/// Makes rows and columns of the slopes those of the identity.
pub(super) fn cut(cuts: &[usize], matrix: &mut BlockTridiagonal) {
    let clear_rows = |block: &mut Block| block.0.iter_mut().for_each(|column| column[3..6].fill(0.0));
    let clear_columns = |block: &mut Block| block.0[3..6].fill([0.0; 8]);
    for &node in cuts {
        let own = &mut matrix.diag[node];
        clear_rows(own);
        clear_columns(own);
        (3..6).for_each(|x| own.0[x][x] = 1.0);
        clear_rows(&mut matrix.lower[node - 1]);
        clear_columns(&mut matrix.lower[node]);
    }
}

/// Moves the rows of the slopes from a cable to the border; `rows` begin with those of its cuts,
/// the last cut first.
pub(super) fn take(cuts: &[usize], cable: &mut [f64], rows: &mut [f64]) {
    for (node, row) in cuts.iter().rev().zip(rows.chunks_exact_mut(3)) {
        let own = &mut cable[6 * node + 3..6 * node + 6];
        row.iter_mut().zip(&*own).for_each(|(row, x)| *row += x);
        own.fill(0.0);
    }
}

/// Sets the increments of the slopes to those of the border, three numbers each, the last cut
/// first.
pub(super) fn give(cuts: &[usize], increments: &[f64], cable: &mut [f64]) {
    for (node, three) in cuts.iter().rev().zip(increments.chunks_exact(3)) {
        cable[6 * node + 3..6 * node + 6].copy_from_slice(three);
    }
}

/// Returns the number of blocks of the border, of two slopes each, of a number of cuts.
pub(super) fn blocks(cuts: usize) -> usize {
    cuts.div_ceil(2)
}

#[cfg(test)]
mod tests;
