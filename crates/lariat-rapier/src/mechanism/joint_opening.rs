//! By how far the joints of a mechanism open under what Rapier makes them carry.
//!
//! # Equation
//! ```text
//! A = L + U = G M^-1 G^T      l = A^-1 (G M^-1 f + G' v)      g = -h^2 U l / p
//! ```
//! The rows of G are the locked axes of all joints, in the order in which Rapier solves them, U is
//! what of A is above its diagonal, and l holds the forces of the joints under the loads f and the
//! motion v that are left to them. In each of its substeps of h, Rapier makes p sweeps of
//! Gauss-Seidel from l = 0 with the right side b + g/h^2, so that gaps g close within h. A sweep
//! ends at (L + D)^-1 (b + g/h^2), which is l, the forces that hold, when g is as above: joints
//! that do not converge open until their gaps do what sweeps leave undone. Of two joints on a link
//! of mass m that carry the force F of a body of mass M that is F h^2/m, as on a spring of m/h^2:
//! the gap grows to it in some h sqrt(M/m).
//!
//! # Validity
//! Gaps small beside the arms of their joints, of joints as stiff as Rapier makes them by default.
//! Pairs of joints, of whose two orders the one that opens less counts, since Rapier may take
//! either; what one joint does to itself is left out. The loads f are those that the prediction
//! does not carry: none, where a mechanism touches no other body, and elsewhere the gap is not
//! known before it shows. Measured: of a body that whirls on a link of 1/40 to 1/1200 of its mass
//! it is 0.7 to 1.3 of F h^2/(m p), most often 1.2, for 2 to 8 substeps and one or three sweeps,
//! whether Rapier keeps impulses from step to step or not (test
//! the_gap_of_a_light_link_is_foreseen).
//!
//! # References
//! Saad 2003, *Iterative methods for sparse linear systems*, section 4.1 (Gauss-Seidel).

use super::constraints::Constraints;
use crate::body::unsettled::JointGap;
use crate::scales::mechanism::REGULARISATION_OF_OPENING;
use ::nalgebra::DMatrix;

/// The rows of a joint in G.
#[derive(Clone, Debug)]
pub(super) struct JointRows {
    pub first: usize,
    /// How many there are, and how many of them, the first ones, hold a direction.
    pub count: usize,
    pub directions: usize,
    /// Distance in m of the anchor from the centre of the farther of its moving bodies.
    pub arm: f64,
}

impl JointRows {
    /// Returns by how much the joint opens per h^2 in what the forces of another give to its
    /// bodies.
    fn opened_by(&self, other: &Self, constraints: &Constraints, forces: &DMatrix<f64>) -> f64 {
        let rows = constraints.rows.rows(self.first, self.directions);
        let spread = constraints.spread.columns(other.first, other.count);
        (rows * (spread * forces.rows(other.first, other.count))).norm()
    }
}

/// Returns the largest gap to which joints open in substeps of `h` (s) with `sweeps` each.
pub(super) fn opening(constraints: &Constraints, joints: &[JointRows], (h, sweeps): (f64, usize)) -> JointGap {
    let mut matrix = &constraints.rows * &constraints.spread;
    for i in 0..matrix.nrows() {
        // a row that nothing moves holds nothing
        matrix[(i, i)] = if matrix[(i, i)] > 0.0 { matrix[(i, i)] * (1.0 + REGULARISATION_OF_OPENING) } else { 1.0 };
    }
    let turning = DMatrix::from_column_slice(matrix.nrows(), 1, constraints.turning.as_slice());
    let Some(matrix) = matrix.cholesky() else { return JointGap::default() };
    let forces = matrix.solve(&turning);
    let mut largest = JointGap::default();
    for (k, one) in joints.iter().enumerate() {
        for other in &joints[k + 1..] {
            let opens = [(one, other), (other, one)].map(|(a, b)| (a.opened_by(b, constraints, &forces), a.arm));
            let (opened, arm) = if opens[0].0 < opens[1].0 { opens[0] } else { opens[1] };
            let gap = opened * h * h / sweeps as f64;
            if gap > largest.gap {
                largest = JointGap { gap, arm };
            }
        }
    }
    largest
}
