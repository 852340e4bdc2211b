//! The cable's matrices at its present state: for eigenfrequencies, buckling loads and coupling.

use super::Cable;
use super::kernel_effects::Rates;
use super::projection::project_matrix;
use crate::linalg::BlockTridiagonal;

impl Cable {
    /// Consistent mass matrix over all coordinates (kg, kg m, kg m^2); supports are not applied.
    pub fn mass_matrix(&mut self) -> BlockTridiagonal {
        let system = &mut self.system;
        system.matrix.clear();
        system.add_mass(1.0);
        system.matrix.clone()
    }

    /// Tangent stiffness -dF/dq at the present state over all coordinates (N/m, N, N m); supports are not applied. Of damping and
    /// drag the part that the step matrix takes, see [`damping`](crate::effect::damping) and [`drag`](crate::effect::drag).
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
}
