//! Supports in vectors and matrices: the projector P on the free directions.
//!
//! `x -> P x`, `A -> P A P + (I - P)`: see [`support`](crate::Support).

use crate::linalg::BlockTridiagonal;
use crate::model::Model;
use crate::support::Support;

/// Removes held components from a vector.
pub(crate) fn project_vector(model: &Model, x: &mut [f64]) {
    for (node, support) in &model.supports {
        support.project(&mut x[6 * node..6 * node + 6]);
    }
}

/// Removes held components from the part of a vector that begins with a node.
pub(crate) fn project_part(model: &Model, first: usize, part: &mut [f64]) {
    let from = model.supports.partition_point(|(node, _)| *node < first);
    let end = first + part.len() / 6;
    for (node, support) in model.supports[from..].iter().take_while(|(node, _)| *node < end) {
        let at = 6 * (node - first);
        support.project(&mut part[at..at + 6]);
    }
}

/// Replaces `A` by `P A P + (I - P)`.
pub(crate) fn project_matrix(model: &Model, a: &mut BlockTridiagonal) {
    for (node, support) in &model.supports {
        let diag = &mut a.diag[*node].0;
        project_columns(support, diag);
        project_rows(support, diag);
        let p = support.projector();
        for c in 0..6 {
            for r in 0..6 {
                diag[c][r] += f64::from(u8::from(r == c)) - p[c][r];
            }
        }
        if *node > 0 {
            project_columns(support, &mut a.lower[node - 1].0);
        }
        if node + 1 < a.diag.len() {
            project_rows(support, &mut a.lower[*node].0);
        }
    }
}

/// Replaces a block, `[column][row]`, by `P A`.
fn project_columns(support: &Support, a: &mut [[f64; 8]; 6]) {
    a.iter_mut().for_each(|column| support.project(&mut column[..6]));
}

/// Replaces a block, `[column][row]`, by `A P`.
fn project_rows(support: &Support, a: &mut [[f64; 8]; 6]) {
    for r in 0..6 {
        let mut row: [f64; 6] = core::array::from_fn(|c| a[c][r]);
        support.project(&mut row);
        (0..6).for_each(|c| a[c][r] = row[c]);
    }
}
