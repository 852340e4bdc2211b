//! The response of a cable to an impulse at its pins within one step.
//!
//! # Equation
//!
//! ```text
//! A = M + h D + h^2 K        C = J A^-1 J^T        dv = -A^-1 J^T p,  dx = h dv
//! ```
//!
//! D is the damping of effects. J selects the pinned positions, which are *free* here. C (1/kg) is
//! the velocity of a pin at the end of the step per unit impulse: the inverse of the cable's
//! effective mass there.
//!
//! # Validity
//!
//! Short steps. It is one implicit Euler step of the cable, linearised, and damps: it decides only
//! how a deviation from a prediction is shared between cable and bodies, not the prediction itself.
//! Under compression A may be indefinite or nearly singular, with arbitrarily large velocities for
//! a small impulse; then D and K are multiplied by 1/2, 1/4 ... until A is positive definite with
//! half of M: the momentum of the cable remains the impulse.
//!
//! # Alternatives considered
//!
//! Multiplying M by 2, 4 ... instead: the cable's momentum is then smaller than the impulse by that
//! factor.

use crate::cable::Cable;
use crate::effect::acts::ForceInput;
use crate::error::{Error, StepFailure};
use crate::integrate::add_scaled;
use crate::linalg::{Factorisation, SchurComplement};
use crate::scales::island::{MAX_DIVISOR, MIN_SHARE};
use crate::system::project_matrix;
use nalgebra::{Matrix3, Vector3};

/// The impulse response of one cable at some of its nodes.
#[derive(Clone, Debug, Default)]
pub struct Impedance {
    factorisation: Factorisation,
    /// The columns J^T, one per coordinate of the nodes.
    pins: SchurComplement,
    /// J times the inverse of the factored matrix times J^T, with the sign changed; row-major.
    response: Vec<f64>,
    nodes: Vec<usize>,
    /// Nodes that are attached, and free here: a buffer.
    freed: Vec<usize>,
    step: f64,
    /// What A is multiplied by in the factored matrix.
    factor: f64,
}

impl Impedance {
    /// Linearises `cable` at its present state for a step of `h` (s), with its attached nodes free.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the matrix is singular or not finite.
    pub fn update(&mut self, cable: &mut Cable, nodes: &[usize], h: f64) -> Result<(), Error> {
        self.update_freed(cable, nodes, h, |_| true)
    }

    /// As [`update`](Self::update), with the attached nodes `held` held: those whose motion is
    /// prescribed, and that are not among `nodes`.
    ///
    /// # Errors
    /// As [`update`](Self::update).
    pub fn update_beside(&mut self, cable: &mut Cable, nodes: &[usize], held: &[usize], h: f64) -> Result<(), Error> {
        self.update_freed(cable, nodes, h, |attached| !held.contains(&attached))
    }

    /// As [`update`](Self::update), with all attached nodes but `nodes` held.
    ///
    /// # Errors
    /// As [`update`](Self::update).
    pub fn update_held(&mut self, cable: &mut Cable, nodes: &[usize], h: f64) -> Result<(), Error> {
        self.update_freed(cable, nodes, h, |attached| nodes.contains(&attached))
    }

    /// Linearises `cable` with those of its attached nodes free that `is_free` names.
    fn update_freed(
        &mut self,
        cable: &mut Cable,
        nodes: &[usize],
        h: f64,
        is_free: impl Fn(usize) -> bool,
    ) -> Result<(), Error> {
        self.step = h;
        self.nodes.clear();
        self.nodes.extend_from_slice(nodes);
        // with its pins free a cable has other supports; they are restored below
        self.freed.clear();
        for (n, support) in cable.model.supports.iter_mut().filter(|(n, s)| s.attached && is_free(*n)) {
            support.attached = false;
            self.freed.push(*n);
        }
        let outcome = cable.with_workspace(|cable| self.linearise(cable, h));
        let freed = |n: &usize| self.freed.contains(n);
        cable.model.supports.iter_mut().filter(|(n, _)| freed(n)).for_each(|(_, s)| s.attached = true);
        outcome.map_err(|failure| cable.step_failed(cable.time(), h, failure))
    }

    fn linearise(&mut self, cable: &mut Cable, h: f64) -> Result<(), StepFailure> {
        let mut inertia = 1.0;
        let assembled = loop {
            // positive definite with half the inertia: the response is at most twice that of the
            // inertia alone
            let half = 0.5 * inertia;
            assemble(cable, h, half);
            project_matrix(&cable.model, &mut cable.system.step.matrix);
            if self.factorisation.factor_if_definite(cable.system.level, &cable.system.step.matrix) {
                break half;
            }
            inertia *= 2.0;
            if inertia > MAX_DIVISOR {
                self.factorisation.factor_to_solve(cable.system.level, &cable.system.step.matrix)?;
                break half;
            }
        };
        if cable.system.feeds.is_empty() {
            // the rest is added to what is assembled: projected twice it is as projected once
            let system = &mut cable.system;
            system.mass.add_to(&mut system.step.matrix, inertia - assembled);
        } else {
            // the mass matrix has the stock of a reel too, which is not assembled
            assemble(cable, h, inertia);
        }
        let (model, system) = (&cable.model, &mut cable.system);
        project_matrix(model, &mut system.step.matrix);
        self.factorisation.factor_to_solve(system.level, &system.step.matrix)?;
        let count = 3 * self.nodes.len();
        self.pins.begin(self.factorisation.nodes(), count);
        for (i, node) in self.nodes.iter().enumerate() {
            for x in 0..3 {
                let mut rows = [0.0; 6];
                rows[x] = 1.0;
                model.support(*node).into_iter().for_each(|support| support.project(&mut rows));
                self.pins.set(3 * i + x, *node, &rows);
            }
        }
        self.pins.complete(system.level, &self.factorisation);
        self.response.clear();
        self.response.resize(count * count, 0.0);
        self.pins.subtract_from(system.level, &mut self.response);
        // the factored matrix is inertia M + h^2 K, the wanted one M + h^2 K/inertia
        self.factor = inertia;
        Ok(())
    }

    /// Returns the velocity in m/s at node `i` of the given ones for unit impulses at node `j`, in
    /// 1/kg.
    pub fn compliance(&self, i: usize, j: usize) -> Matrix3<f64> {
        let count = 3 * self.nodes.len();
        Matrix3::from_fn(|r, c| -self.factor * self.response[(3 * i + r) * count + 3 * j + c])
    }

    /// Returns the nodes that it was updated with.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// Applies the opposite of `impulses` (N s) to the cable, one per node, as the reaction to
    /// those that the bodies received.
    ///
    /// The velocity changes by all of them, so that momentum is conserved. The displacement dx is
    /// halved, and finally omitted, as long as the strain energy U grows by more than a linear
    /// response allows: with h^2 K <= A, dU <= (1/2 dx.K dx + U) + 1/2 dx.K dx <= U + p.C p. An
    /// omitted displacement is a gap, which the next step closes.
    pub fn apply_impulses(&self, cable: &mut Cable, impulses: &[Vector3<f64>]) {
        cable.with_workspace(|cable| self.apply_in_workspace(cable, impulses));
    }

    fn apply_in_workspace(&self, cable: &mut Cable, impulses: &[Vector3<f64>]) {
        let size = cable.positions().len();
        let mut dv = core::mem::take(&mut cable.buffers.product);
        dv.clear();
        dv.resize(size, 0.0);
        let scaled = &mut cable.buffers.z;
        scaled.clear();
        scaled.extend(impulses.iter().flatten().map(|p| self.factor * p));
        self.pins.expand(cable.system.level, &self.factorisation, scaled, &mut dv);
        let at_nodes = self.nodes.iter().zip(impulses);
        let given: f64 = at_nodes.map(|(n, p)| (0..3).map(|x| -p[x] * dv[6 * n + x]).sum::<f64>()).sum();
        let strain = |cable: &Cable| {
            let (axial, bending) = cable.system.forces.strain_energy(&cable.snapshot.state.q);
            axial + bending
        };
        let before = strain(cable);
        let mut share = 1.0;
        add_scaled(&mut cable.snapshot.state.v, 1.0, &dv);
        add_scaled(&mut cable.snapshot.state.q, self.step, &dv);
        // false for NaN
        let is_bounded = |cable: &Cable| strain(cable) - before <= before + given.abs();
        while !is_bounded(cable) {
            let less = if share > MIN_SHARE { 0.5 * share } else { 0.0 };
            add_scaled(&mut cable.snapshot.state.q, self.step * (less - share), &dv);
            share = less;
            if share == 0.0 {
                break;
            }
        }
        cable.buffers.product = dv;
        cable.snapshot.state.memory.valid = false;
    }
}

/// Computes `inertia M + h D + h^2 K` into the matrix of the system.
fn assemble(cable: &mut Cable, h: f64, inertia: f64) {
    let (dynamics, state) = cable.dynamics();
    let mut equations = dynamics.equations;
    let input = ForceInput { time: state.time, q: &state.q, v: &state.v, dv_dq: 1.0 / h, scale: h * h };
    equations.force_and_matrix(input, inertia, &mut dynamics.buffers.product);
}
