//! The cable's matrices at its present state: for eigenfrequencies, buckling loads and coupling.

use super::Cable;
use super::kernel_effects::Rates;
use super::projection::project_matrix;
use crate::linalg::BlockTridiagonal;
use nalgebra::DMatrix;

impl Cable {
    /// Consistent mass matrix over all coordinates (kg, kg m, kg m^2); supports are not applied.
    pub fn mass_matrix(&mut self) -> BlockTridiagonal {
        let system = &mut self.system;
        system.matrix.clear();
        system.add_mass(1.0);
        system.matrix.clone()
    }

    /// Tangent stiffness -dF/dq at the present state over all coordinates (N/m, N, N m); supports are not applied. Of damping and
    /// drag the part that the step matrix takes, see [`damping`](crate::effect::damping) and [`drag`](crate::effect::drag); all of it:
    /// [`jacobians`](Self::jacobians).
    pub fn stiffness_matrix(&mut self) -> BlockTridiagonal {
        let mut force = vec![0.0; self.positions().len()];
        self.evaluate_with_stiffness(&mut force).clone()
    }

    /// Damping matrix -dF/dq' at the present state over all coordinates (N s/m, N s, N m s); supports are not applied.
    pub fn damping_matrix(&mut self) -> BlockTridiagonal {
        let mut force = vec![0.0; self.positions().len()];
        let stiffness = self.evaluate_with_stiffness(&mut force).clone();
        let (mut equations, phase) = self.equations();
        let rates = Rates { v: &phase.v, rate: 1.0 };
        equations.moving_force_and_matrix(phase.time, &phase.q, rates, 1.0, 0.0, &mut force);
        let mut damping = self.system.matrix.clone();
        let blocks = |m: &mut BlockTridiagonal, k: BlockTridiagonal| {
            for (block, k) in m.diag.iter_mut().chain(&mut m.lower).zip(k.diag.iter().chain(&k.lower)) {
                block.0.iter_mut().flatten().zip(k.0.iter().flatten()).for_each(|(m, k)| *m -= k);
            }
        };
        blocks(&mut damping, stiffness);
        damping
    }

    /// Generalised force at the present state: elastic, gravity, loads and effects (N on positions, N m on slopes); no reactions.
    pub fn force(&mut self) -> Vec<f64> {
        let mut force = vec![0.0; self.positions().len()];
        self.evaluate(&mut force);
        force
    }

    /// [`force`](Self::force) into a slice of 6 numbers per node; allocates nothing.
    pub fn evaluate(&mut self, force: &mut [f64]) {
        let (mut equations, phase) = self.equations();
        equations.moving_force(phase.time, &phase.q, &phase.v, 1.0, force);
    }

    /// Force into a slice of 6 numbers per node, and the stiffness as [`stiffness_matrix`](Self::stiffness_matrix); allocates
    /// nothing.
    pub fn evaluate_with_stiffness(&mut self, force: &mut [f64]) -> &BlockTridiagonal {
        let (mut equations, phase) = self.equations();
        let rates = Rates { v: &phase.v, rate: 0.0 };
        equations.moving_force_and_matrix(phase.time, &phase.q, rates, 1.0, 0.0, force);
        &self.system.matrix
    }

    /// Applies the supports to a matrix: held rows and columns become those of the identity.
    pub fn apply_supports(&self, matrix: &mut BlockTridiagonal) {
        project_matrix(&self.model, matrix);
    }

    /// Angular frequencies in rad/s of small motions about the present state, supports in place, ascending: `det(K - omega^2 M) = 0`. 0
    /// for a motion that meets no stiffness, or a negative one (buckling). A dense eigenproblem: for tens or hundreds of nodes.
    /// [`damping_at_mode`](Self::damping_at_mode) damps one of them by a given ratio.
    ///
    /// *Source.* Golub & Van Loan 2013, section 8.7 (Cholesky reduction of a symmetric pencil).
    pub fn natural_frequencies(&mut self) -> Vec<f64> {
        let held_at = 10.0 * self.frequency_bound() * self.frequency_bound();
        let mut held = BlockTridiagonal::zeros(self.nodes());
        self.apply_supports(&mut held);
        let (mut k, mut m) = (self.stiffness_matrix(), self.mass_matrix());
        self.apply_supports(&mut k);
        self.apply_supports(&mut m);
        let held = dense(&held);
        // what is held is put above all frequencies, and dropped
        let k = dense(&k) + &held * (held_at - 1.0);
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
