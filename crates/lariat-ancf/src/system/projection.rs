//! Supports in vectors and matrices: the projector P on the free directions.
//!
//! `x -> P x`, `A -> P A P + (I - P)`: see [`support`](crate::Support).

use crate::linalg::BlockTridiagonal;
use crate::model::Model;

/// Removes held components from a vector.
pub(crate) fn project_vector(model: &Model, x: &mut [f64]) {
    for (node, support) in &model.supports {
        support.project(&mut x[6 * node..6 * node + 6]);
    }
}

/// Replaces `A` by `P A P + (I - P)`.
pub(crate) fn project_matrix(model: &Model, a: &mut BlockTridiagonal) {
    for (node, support) in &model.supports {
        let p = support.projector();
        let times = |x: &[[f64; 8]; 6], left: bool, right: bool| {
            let mut y = *x;
            if left {
                for c in 0..6 {
                    y[c] = core::array::from_fn(|r| if r < 6 { (0..6).map(|k| p[k][r] * x[c][k]).sum() } else { 0.0 });
                }
            }
            let z = y;
            if right {
                for c in 0..6 {
                    y[c] = core::array::from_fn(|r| if r < 6 { (0..6).map(|k| z[k][r] * p[c][k]).sum() } else { 0.0 });
                }
            }
            y
        };
        let diag = &mut a.diag[*node].0;
        *diag = times(diag, true, true);
        for c in 0..6 {
            for r in 0..6 {
                diag[c][r] += f64::from(u8::from(r == c)) - p[c][r];
            }
        }
        if *node > 0 {
            let lower = &mut a.lower[node - 1].0;
            *lower = times(lower, true, false);
        }
        if node + 1 < a.diag.len() {
            let lower = &mut a.lower[*node].0;
            *lower = times(lower, false, true);
        }
    }
}
