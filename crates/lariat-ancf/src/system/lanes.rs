//! From elements to nodes: the force of all elements and its tangent, eight elements at a time or
//! one by one ([`group`]).
//!
//! # Equation
//!
//! Control vectors are gathered from the nodal coordinates (r, t), the kernel runs
//! ([`kernel`](crate::element::kernel)), and the result is scattered with d1 = s (r_j - r_i), s =
//! 3/l:
//!
//! ```text
//! dU/dr_i = -s G1   dU/dt_i = G0   dU/dr_j = s G1   dU/dt_j = G2        G_k = dU/dd_k
//! ```
//!
//! # Validity
//!
//! Elements are added in ascending order whatever the width of the lanes, so sums round the same
//! way everywhere. The last group is padded with elements without length, which are computed and
//! dropped. Effects are a type parameter of the loop: a cable without any runs code that does not
//! contain them.

pub(crate) mod discrete_gradient;
mod dispatch;
mod group;
#[cfg(target_arch = "x86_64")]
mod one;

use super::elements::Elements;
use crate::effect::acts::ForceInput;
use crate::effect::tables::ElementTables;
use crate::element::kernel::{ElementState, GramForce, Kernel, NoEffects, Stiffness};
use crate::linalg::{Block, BlockTridiagonal};
use dispatch::dispatch_groups;
use fearless_simd::Level;
use group::Group;

/// Where the tangent goes.
pub(crate) struct MatrixOutput<'a> {
    /// The matrix, which is overwritten.
    pub matrix: &'a mut BlockTridiagonal,
    /// Factor on the mass matrix in it.
    pub mass_scale: f64,
}

impl Elements {
    /// Adds the force of all elements to `out`, times the input's factor.
    pub fn add_force(&self, level: Level, effects: Option<&ElementTables>, input: ForceInput<'_>, out: &mut [f64]) {
        match effects {
            None => dispatch_groups!(level, groups => self.force_groups(groups, &NoEffects, input, out)),
            Some(effects) => dispatch_groups!(level, groups => self.force_groups(groups, effects, input, out)),
        }
    }

    /// Adds the force of all elements to `out`, and overwrites the matrix by its negative
    /// derivative (the stiffness) plus the mass matrix, times their factors.
    pub fn add_force_and_matrix(
        &self,
        level: Level,
        effects: Option<&ElementTables>,
        input: ForceInput<'_>,
        out: &mut [f64],
        to: MatrixOutput<'_>,
    ) {
        match effects {
            None => dispatch_groups!(level, groups => self.matrix_groups(groups, &NoEffects, input, out, to)),
            Some(effects) => dispatch_groups!(level, groups => self.matrix_groups(groups, effects, input, out, to)),
        }
    }

    #[inline(always)]
    fn force_groups<G: Group, E: GramForce>(&self, groups: G, effects: &E, input: ForceInput<'_>, out: &mut [f64]) {
        let kernel = Kernel { table: &self.table, bending: &self.bending, effects };
        let moving = effects.needs_rates() && !input.v.is_empty();
        for first in (0..self.count).step_by(G::SIZE) {
            let group = groups.at(first);
            let force = kernel.force(&self.gather(group, input, moving), &group);
            group.add_force(self, &force, out);
        }
    }

    #[inline(always)]
    fn matrix_groups<G: Group, E: GramForce>(
        &self,
        groups: G,
        effects: &E,
        input: ForceInput<'_>,
        out: &mut [f64],
        to: MatrixOutput<'_>,
    ) {
        let kernel = Kernel { table: &self.table, bending: &self.bending, effects };
        let moving = effects.needs_rates() && !input.v.is_empty();
        to.matrix.diag[0] = Block::ZERO;
        for first in (0..self.count).step_by(G::SIZE) {
            let group = groups.at(first);
            let state = self.gather(group, input, moving);
            let (force, blocks) = kernel.force_and_tangent(&state, input.dv_dq, &group);
            group.add_force(self, &force, out);
            group.add_matrix(self, &blocks, to.mass_scale, to.matrix);
        }
    }

    /// Gathers what the elements of a group are evaluated at.
    #[inline(always)]
    fn gather<G: Group>(&self, group: G, input: ForceInput<'_>, moving: bool) -> ElementState<G::Number> {
        let stiffness = Stiffness {
            axial: group.load(&self.axial) * input.scale,
            bending: group.load(&self.flexural) * input.scale,
        };
        let d = group.control(self, input.q);
        let velocity = if moving { Some(group.control(self, input.v)) } else { None };
        ElementState { stiffness, d, velocity }
    }
}
