//! The cable's matrices at its present state: for eigenfrequencies, buckling loads and coupling.

use super::Cable;
use crate::effect::acts::ForceInput;
use crate::effect::torsion::segment::Segment;
use crate::linalg::BlockTridiagonal;
use crate::state::State;
use crate::system::jacobian::Jacobians;
use crate::system::project_matrix;
use nalgebra::DMatrix;

/// What torsion adds to the matrices of a cable, between two neighbouring nodes that hold its spin:
/// the stiffness K g g^T and the damping C g g^T, which couple all coordinates.
///
/// The twist is that of the curve, whose derivatives g are, less the angle by which what holds the
/// first node spins about the slope there, and that of the last node more.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TwistBorder {
    /// The two nodes, ascending.
    pub nodes: [usize; 2],
    /// K in N m.
    pub stiffness: f64,
    /// C in N m s.
    pub damping: f64,
    /// Derivatives g of the twist by all coordinates, in rad/m and rad.
    pub gradient: Vec<f64>,
}

impl Cable {
    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn mass_matrix(&mut self) -> BlockTridiagonal {
        let mut matrix = BlockTridiagonal::zeros(self.nodes());
        self.system.mass.add_to(&mut matrix, 1.0);
        matrix
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn stiffness_matrix(&mut self) -> BlockTridiagonal {
        let mut force = vec![0.0; self.positions().len()];
        self.with_workspace(|cable| cable.evaluate_with_stiffness(&mut force).clone())
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn damping_matrix(&mut self) -> BlockTridiagonal {
        let mut force = vec![0.0; self.positions().len()];
        let (stiffness, mut damping) = self.with_workspace(|cable| {
            (cable.evaluate_with_stiffness(&mut force).clone(), cable.evaluate_with_matrix(1.0, &mut force).clone())
        });
        let blocks = stiffness.diag.iter().chain(&stiffness.lower);
        for (block, k) in damping.diag.iter_mut().chain(&mut damping.lower).zip(blocks) {
            block.0.iter_mut().flatten().zip(k.0.iter().flatten()).for_each(|(c, k)| *c -= k);
        }
        damping
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn jacobians(&self) -> Jacobians {
        Jacobians::new(&self.system, &self.model, input(&self.snapshot.state, 0.0))
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn force(&mut self) -> Vec<f64> {
        let mut force = vec![0.0; self.positions().len()];
        self.evaluate(&mut force);
        force
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn evaluate(&mut self, force: &mut [f64]) {
        self.with_torsion(|cable| {
            let (mut equations, state) = cable.equations();
            equations.force(input(state, 0.0), force);
        });
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn evaluate_with_stiffness(&mut self, force: &mut [f64]) -> &BlockTridiagonal {
        self.evaluate_with_matrix(0.0, force)
    }

    fn evaluate_with_matrix(&mut self, dv_dq: f64, force: &mut [f64]) -> &BlockTridiagonal {
        self.with_torsion(|cable| {
            let (mut equations, state) = cable.equations();
            equations.force_and_matrix(input(state, dv_dq), 0.0, force);
        });
        &self.system.step.matrix
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn apply_supports(&self, matrix: &mut BlockTridiagonal) {
        project_matrix(&self.model, matrix);
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn twist_borders(&self) -> Vec<TwistBorder> {
        let damping = self.model.effects.torsion.as_ref().map_or(0.0, |torsion| torsion.damping);
        let border = |(segment, _): (Segment, _)| {
            let (mut own, mut gradient) = (Vec::new(), vec![0.0; self.positions().len()]);
            segment.gradient(&self.model.elements, self.positions(), &mut own);
            gradient[segment.range()].copy_from_slice(&own);
            let stiffness = segment.stiffness;
            TwistBorder { nodes: segment.nodes, stiffness, damping: stiffness * damping, gradient }
        };
        self.segments().into_iter().map(border).collect()
    }

    /// Returns the angular frequencies in rad/s of small motions about the present state, supports
    /// in place, ascending: `det(K - omega^2 M) = 0`. 0 for a mode of zero or negative stiffness
    /// (buckling). A dense eigenproblem, reduced by Cholesky's factors (Golub & Van Loan 2013,
    /// section 8.7): for tens or hundreds of nodes.
    /// [`damping_at_mode`](crate::coupling::Linearisation::damping_at_mode) damps one of them by a
    /// given ratio.
    pub fn natural_frequencies(&mut self) -> Vec<f64> {
        let held_at = 10.0 * self.frequency_bound() * self.frequency_bound();
        let mut held = BlockTridiagonal::zeros(self.nodes());
        self.apply_supports(&mut held);
        let (mut k, mut m) = (self.stiffness_matrix(), self.mass_matrix());
        self.apply_supports(&mut k);
        self.apply_supports(&mut m);
        let held = dense(&held);
        // held coordinates get a frequency above all others, and are dropped
        let k = dense(&k) + self.torsion_stiffness() + &held * (held_at - 1.0);
        let dropped = held.trace().round() as usize;
        let Some(factor) = dense(&m).cholesky() else { return Vec::new() };
        let half = factor.l().solve_lower_triangular(&k).expect("a factor has no zero on its diagonal");
        let reduced = factor.l().solve_lower_triangular(&half.transpose()).expect("as above");
        let mut squares: Vec<f64> =
            ((&reduced + reduced.transpose()) * 0.5).symmetric_eigenvalues().as_slice().to_vec();
        squares.sort_by(f64::total_cmp);
        squares.truncate(squares.len() - dropped);
        squares.into_iter().map(|x| x.max(0.0).sqrt()).collect()
    }
}

/// The arguments of an evaluation at a state.
fn input(state: &State, dv_dq: f64) -> ForceInput<'_> {
    ForceInput { time: state.time, q: &state.q, v: &state.v, dv_dq, scale: 1.0 }
}

fn dense(a: &BlockTridiagonal) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(6 * a.nodes(), 6 * a.nodes());
    for (i, block) in a.diag.iter().enumerate() {
        for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
            out[(6 * i + r, 6 * i + c)] = block.0[c][r];
        }
    }
    for (i, block) in a.lower.iter().enumerate() {
        for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
            out[(6 * i + 6 + r, 6 * i + c)] = block.0[c][r];
            out[(6 * i + c, 6 * i + 6 + r)] = block.0[c][r];
        }
    }
    out
}
