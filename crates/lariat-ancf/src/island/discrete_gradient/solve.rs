//! The linear equations of an iteration: each cable is condensed on the bodies and on the forces of
//! contacts between cables, and their matrix is factored.

use super::super::bordered::Lever;
use super::super::condense::Columns;
use super::super::cuts;
use super::super::layout::Part;
use super::coupled::complete_rows;
use super::reels::Reels;
use super::terms::Terms;
use super::{CableBuffers, IslandStep, StepBuffers};
use crate::contact::Border;
use crate::effect::EffectWork;
use crate::error::StepFailure;
use crate::one_leg::OneLeg;
use crate::system::StepVectors;
use crate::system::{CableStep, Equations, project_part, project_vector};
use crate::term::StepTerm;

impl IslandStep<'_, '_> {
    /// Computes residuals and step matrices of all cables, factors and condenses these, and sums
    /// the rows of the bodies.
    pub(super) fn linearise(&mut self) -> Result<(), StepFailure> {
        self.buffers.rows.fill(0.0);
        Reels::evaluate(self);
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            equations.step_residual(state, buffers, true, &mut EffectWork::default());
        }
        Terms::linearise(self);
        let StepBuffers { bodies, coupled, cables: own, matrix, rows, pairs, .. } = &mut *self.buffers;
        for (strand, ((cable, own), part)) in self.cables.iter_mut().zip(own).zip(&self.layout.parts).enumerate() {
            let CableStep { mut equations, buffers, .. } = cable.step_parts();
            own.pass_impulses(&buffers.rhs, rows);
            buffers.contact.pass_impulses(true, rows);
            let borders = buffers.contact.borders();
            matrix.cable(strand).read(&equations.system.step.matrix, &part.held, borders);
            cuts::cut(&part.cuts, &mut equations.system.step.matrix);
            equations.factor_to_solve()?;
            let (level, model) = (equations.system.level, equations.model);
            let factors = &equations.system.step.factorisation;
            let (pairs, own) = (&pairs.columns, &own.pairs);
            let beside = Columns { held: &part.held, cuts: &part.cuts, touched: borders, strand, pairs, own };
            matrix.cable(strand).complete(level, factors, beside, |first, x| project_part(model, first, x));
        }
        complete_rows(bodies, coupled, rows);
        Ok(())
    }

    /// Factors the matrix of the border, bodies and forces of contacts, for steps of length `h`
    /// (s) with a formula.
    pub(super) fn factor_bodies(&mut self, (h, leg): (f64, OneLeg)) -> Result<(), StepFailure> {
        let StepBuffers { bodies, coupled, cables: own, matrix, pairs, .. } = &mut *self.buffers;
        let parts = &self.layout.parts;
        matrix.begin(bodies.len(), parts.iter().map(|part| part.cuts.len()), pairs.columns.len());
        for (i, body) in bodies.iter().enumerate() {
            matrix.add_inertia(i, &body.world_matrix());
        }
        let rotation = |i: usize| bodies[i].middle;
        coupled.iter().for_each(|coupled| matrix.add_coupled(&coupled.turned(coupled.bodies.map(rotation))));
        for (c, ((cable, own), part)) in self.cables.iter().zip(own.iter()).zip(parts).enumerate() {
            for hold in &own.holds {
                matrix.add_rotational(hold.body, &(hold.stiffening() * (0.5 * leg.b * h)));
            }
            let borders = cable.step_buffers.contact.borders();
            set_levers(matrix.levers(c), own, (part, self.layout.cut_blocks), borders, bodies.len());
            matrix.add_cable(c);
        }
        for (i, body) in bodies.iter().enumerate() {
            matrix.lock(i, &body.free);
        }
        matrix.factor()
    }

    /// Solves the linear equations in place: the residuals of cables and the rows of bodies become
    /// their increments.
    pub(super) fn solve(&mut self) {
        self.solve_bordered();
        self.complete_by_torsion();
    }

    /// Solves them without what [torsion](super::torsion) couples along a cable.
    fn solve_bordered(&mut self) {
        let StepBuffers { bodies, cables: own, matrix, rows, .. } = &mut *self.buffers;
        rows.resize(matrix.rows(), 0.0);
        let layout = self.layout;
        for (c, ((cable, own), part)) in self.cables.iter_mut().zip(own.iter()).zip(&layout.parts).enumerate() {
            let CableStep { equations, buffers, .. } = cable.step_parts();
            equations.diagnostics.solves += 1;
            let StepVectors { contact, rhs, .. } = &mut *buffers;
            cuts::take(&part.cuts, rhs, &mut rows[6 * (bodies.len() + part.cut_at)..]);
            project_vector(equations.model, rhs);
            let factors = (equations.system.level, &equations.system.step.factorisation);
            set_levers(matrix.levers(c), own, (part, layout.cut_blocks), contact.borders(), bodies.len());
            matrix.reduce(c, factors, rhs, rows);
        }
        for (body, row) in bodies.iter().zip(rows.chunks_exact_mut(6)) {
            body.lock(row);
        }
        matrix.solve(rows);
        for (c, ((cable, own), part)) in self.cables.iter_mut().zip(own.iter()).zip(&layout.parts).enumerate() {
            let CableStep { equations, buffers, .. } = cable.step_parts();
            let factors = (equations.system.level, &equations.system.step.factorisation);
            let moved = matrix.expand(c, factors, &mut buffers.rhs, rows);
            cuts::give(&part.cuts, &moved[3 * own.holds.len()..], &mut buffers.rhs);
            for (hold, moved) in own.holds.iter().zip(moved.chunks_exact(3)) {
                for x in 0..3 {
                    // a slope is free along its direction
                    let along = if hold.slope { buffers.rhs[hold.at + x] } else { 0.0 };
                    buffers.rhs[hold.at + x] = along + moved[x];
                }
            }
        }
        rows.truncate(6 * bodies.len());
    }

    /// Solves for the increments and adds a share of them to the iterate: all where rates of reels
    /// are unknown.
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

/// Sets what the coordinates of a cable in the border follow: those that are held, slopes of cuts,
/// of which all cables have a number of blocks, bodies that it touches, and the forces of its
/// contacts with cables.
fn set_levers(
    levers: &mut Vec<Lever>,
    own: &CableBuffers,
    (part, cut_blocks): (&Part, usize),
    touched: &[Border],
    bodies: usize,
) {
    levers.clear();
    levers.extend(own.holds.iter().map(|hold| Lever::held(hold.body, &hold.arm, hold.slope)));
    levers.extend((0..part.cuts.len()).map(|cut| Lever::of_own(bodies + part.cut_at, cut)));
    levers.extend(touched.iter().flat_map(|border| Lever::own(border.body)));
    levers.extend(own.pairs.iter().map(|&pair| Lever::of_own(bodies + cut_blocks, pair)));
}
