//! The linear equations of an iteration: each cable is condensed on the bodies, and their matrix is factored.

use super::super::body_matrix::Lever;
use super::super::hold::vector;
use super::coupled::complete_rows;
use super::{CableBuffers, IslandStep, StepBuffers};
use crate::effect::EffectWork;
use crate::error::StepFailure;
use crate::one_leg::BETA;
use crate::system::StepVectors;
use crate::system::{CableStep, Equations, project_vector};

impl IslandStep<'_, '_> {
    /// Computes residuals and step matrices of all cables, factors and condenses these, and sums the rows of the bodies.
    pub(super) fn linearise(&mut self) -> Result<(), StepFailure> {
        let StepBuffers { bodies, coupled, cables: own, rows, unknowns, .. } = &mut *self.buffers;
        rows.fill(0.0);
        unknowns.winches.iter().for_each(|winch| winch.pass(winch.force, self.cables[0].step_buffers.h, rows));
        for ((cable, own), part) in self.cables.iter_mut().zip(own).zip(&self.layout.parts) {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            equations.step_residual(state, buffers, true, &mut EffectWork::default());
            own.pass_impulses(&buffers.rhs, rows);
            buffers.contact.pass_impulses(true, rows);
            let borders = buffers.contact.borders();
            own.condensed.read(&equations.system.step.matrix, &part.holds, borders);
            equations.factor_to_solve()?;
            let (level, model) = (equations.system.level, equations.model);
            let factors = &equations.system.step.factorisation;
            own.condensed.complete(level, factors, (&part.holds, borders), |x| project_vector(model, x));
        }
        complete_rows(bodies, coupled, rows);
        Ok(())
    }

    /// Factors the matrix of the bodies for steps of length `h` (s).
    pub(super) fn factor_bodies(&mut self, h: f64) -> Result<(), StepFailure> {
        let StepBuffers { bodies, coupled, cables: own, matrix, .. } = &mut *self.buffers;
        matrix.begin(bodies.len());
        for (i, body) in bodies.iter().enumerate() {
            matrix.add_inertia(i, &body.world_matrix());
        }
        let rotation = |i: usize| bodies[i].rotation;
        coupled.iter().for_each(|coupled| matrix.add_coupled(&coupled.turned(coupled.bodies.map(rotation))));
        for (cable, CableBuffers { holds, condensed, .. }) in self.cables.iter().zip(own.iter()) {
            for hold in holds {
                matrix.add_rotational(hold.body, &(hold.stiffening() * (0.5 * BETA * h)));
            }
            let held = holds.iter().map(|hold| Lever::held(hold.body, &hold.arm, hold.slope));
            let touched = cable.step_buffers.contact.borders().iter().flat_map(|border| Lever::own(border.body));
            matrix.add_cable(&condensed.w, held.chain(touched));
        }
        for (i, body) in bodies.iter().enumerate() {
            matrix.lock(i, &body.free);
        }
        matrix.factor()
    }

    /// Solves the linear equations without contacts between cables in place.
    pub(super) fn solve_apart(&mut self) {
        let StepBuffers { bodies, cables: own, matrix, rows, .. } = &mut *self.buffers;
        for (cable, own) in self.cables.iter_mut().zip(own.iter_mut()) {
            let CableStep { equations, buffers, .. } = cable.step_parts();
            equations.diagnostics.solves += 1;
            project_vector(equations.model, &mut buffers.rhs);
            let (level, factors) = (equations.system.level, &equations.system.step.factorisation);
            own.condensed.reduce(level, factors, &mut buffers.rhs, &mut own.at_bodies);
            let (held, touched) = own.at_bodies.split_at(3 * own.holds.len());
            for (hold, reduced) in own.holds.iter().zip(held.chunks_exact(3)) {
                hold.pass(&-vector(reduced), rows);
            }
            for (border, reduced) in buffers.contact.borders().iter().zip(touched.chunks_exact(6)) {
                (0..6).for_each(|x| rows[6 * border.body + x] -= reduced[x]);
            }
        }
        for (body, row) in bodies.iter().zip(rows.chunks_exact_mut(6)) {
            body.lock(row);
        }
        matrix.solve(rows);
        for (cable, own) in self.cables.iter_mut().zip(own.iter_mut()) {
            let CableStep { equations, buffers, .. } = cable.step_parts();
            own.at_bodies.clear();
            own.at_bodies.extend(own.holds.iter().flat_map(|hold| <[f64; 3]>::from(hold.moved(rows))));
            let StepVectors { contact, rhs, .. } = &mut *buffers;
            for border in contact.borders() {
                own.at_bodies.extend_from_slice(&rows[6 * border.body..6 * border.body + 6]);
            }
            let (level, factors) = (equations.system.level, &equations.system.step.factorisation);
            own.condensed.expand(level, factors, &own.at_bodies, rhs);
            for (hold, moved) in own.holds.iter().zip(own.at_bodies.chunks_exact(3)) {
                for x in 0..3 {
                    // a slope is free along its direction
                    let along = if hold.slope { buffers.rhs[hold.at + x] } else { 0.0 };
                    buffers.rhs[hold.at + x] = along + moved[x];
                }
            }
        }
    }

    /// Solves for the increments and adds a share of them to the iterate: all where rates of reels are unknown.
    pub(super) fn add_increment(&mut self, share: f64) -> Result<(), StepFailure> {
        self.solve();
        self.add_to_laws();
        let StepBuffers { bodies, rows, unknowns, .. } = &mut *self.buffers;
        let share = if unknowns.reels.is_empty() { share } else { 1.0 };
        for cable in self.cables.iter_mut() {
            let CableStep { equations, buffers, .. } = cable.step_parts();
            if !buffers.rhs.iter().all(|x| x.is_finite()) {
                return Err(equations.not_finite("Newton increment", &buffers.rhs));
            }
            Equations::apply_increment(buffers, share);
        }
        rows.iter_mut().for_each(|x| *x *= share);
        for (body, increment) in bodies.iter_mut().zip(rows.chunks_exact(6)) {
            body.add(increment);
        }
        Ok(())
    }
}
