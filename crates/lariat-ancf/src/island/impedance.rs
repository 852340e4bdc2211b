//! How a cable answers an impulse at its pins within one step: for engines that must be told before they step.
//!
//! ```text
//! A = M + h D + h^2 K        C = J A^-1 J^T        dv = -A^-1 J^T p,  dx = h dv
//! ```
//!
//! D is the damping of effects. J reads the pinned positions, *free* here. C (1/kg) is the velocity that a unit impulse makes at a pin over the step: the
//! inverse of the mass that a body feels there. *Source.* One implicit Euler step of the cable, linearised. *Validity.* Short steps;
//! it damps, so it decides only how a deviation from the prediction is shared, never the prediction itself. Under compression
//! A may be indefinite, or nearly singular, and answer a small impulse with any velocity; then M counts twice, four times ...
//! until half of it suffices.

use crate::cable::{Cable, Rates, project_matrix, project_vector};
use crate::error::{Error, StepFailure};
use crate::linalg::{Definiteness, Factorisation};
use nalgebra::{DMatrix, Vector3};

/// Inertia is raised at most this much against compression that makes A indefinite.
const MOST_INERTIA: f64 = 1e6;

/// The impulse response of one cable at some of its nodes.
#[derive(Clone, Debug, Default)]
pub struct Impedance {
    factorisation: Factorisation,
    /// A^-1 J^T, one column per coordinate of the nodes.
    columns: Vec<f64>,
    nodes: Vec<usize>,
    step: f64,
}

impl Impedance {
    /// Linearises `cable` at its present state for a step of `h` (s), with the attached ones of its nodes free.
    ///
    /// # Errors
    /// [`Error::StepRefused`] if the matrix is singular or not finite.
    pub fn update(&mut self, cable: &mut Cable, nodes: &[usize], h: f64) -> Result<(), Error> {
        let size = cable.positions().len();
        self.step = h;
        self.nodes.clear();
        self.nodes.extend_from_slice(nodes);
        self.columns.clear();
        self.columns.resize(3 * nodes.len() * size, 0.0);
        // with its pins free a cable has other supports: put back below
        let supports = cable.model.supports.clone();
        cable.model.supports.iter_mut().for_each(|(_, s)| s.attached = false);
        let outcome = self.linearise(cable, h);
        cable.model.supports = supports;
        outcome.map_err(|failure| cable.refused(cable.time(), h, failure))
    }

    fn linearise(&mut self, cable: &mut Cable, h: f64) -> Result<(), StepFailure> {
        let size = cable.positions().len();
        let mut inertia = 1.0;
        loop {
            // definite with half the inertia: then the response is at most twice that of the inertia alone
            let definite = self.factor(cable, h, 0.5 * inertia);
            if definite == Ok(true) {
                break;
            }
            inertia *= 2.0;
            if inertia > MOST_INERTIA {
                definite?;
                break;
            }
        }
        self.factor(cable, h, inertia)?;
        let (model, system) = (&cable.model, &mut cable.system);
        for (i, column) in self.columns.chunks_exact_mut(size).enumerate() {
            column[6 * self.nodes[i / 3] + i % 3] = 1.0;
            project_vector(model, column);
        }
        if !self.nodes.is_empty() {
            self.factorisation.solve_many(system.level, &mut self.columns, 3 * self.nodes.len());
        }
        Ok(())
    }

    /// Factors `inertia M + h^2 K`; whether it is positive definite.
    fn factor(&mut self, cable: &mut Cable, h: f64, inertia: f64) -> Result<bool, StepFailure> {
        let mut force = core::mem::take(&mut cable.system.product);
        let (mut equations, phase) = cable.equations();
        let rates = Rates { v: &phase.v, rate: 1.0 / h };
        equations.moving_force_and_matrix(phase.time, &phase.q, rates, h * h, inertia, &mut force);
        cable.system.product = force;
        let (model, system) = (&cable.model, &mut cable.system);
        project_matrix(model, &mut system.matrix);
        let kind = self.factorisation.factor(system.level, &system.matrix)?;
        Ok(matches!(kind, Definiteness::PositiveDefinite))
    }

    /// Velocity in m/s of coordinate `i` of the nodes (three per node) for a unit impulse at coordinate `j`, in 1/kg.
    pub fn compliance(&self) -> DMatrix<f64> {
        let count = 3 * self.nodes.len();
        let size = self.columns.len() / count.max(1);
        DMatrix::from_fn(count, count, |i, j| self.columns[j * size + 6 * self.nodes[i / 3] + i % 3])
    }

    /// Gives the cable the opposite of `impulses` (N s), one per node, which it gave to what holds the nodes.
    pub fn kick(&self, cable: &mut Cable, impulses: &[Vector3<f64>]) {
        let size = cable.positions().len();
        let phase = &mut cable.state.phase;
        for (i, column) in self.columns.chunks_exact(size).enumerate() {
            let p = impulses[i / 3][i % 3];
            for (k, y) in column.iter().enumerate() {
                phase.v[k] -= p * y;
                phase.q[k] -= self.step * p * y;
            }
        }
        phase.memory.valid = false;
    }
}
