//! What a linear solve of a step misses of the axial forces, eight elements at a time.
//!
//! # Equation
//!
//! A solve about the change D d_a takes the iterate from c to D d, and the Gram numbers by `B_a (D d - c)`, `B_a = B(d0 + D d_a/2)`. They change by
//!
//! ```text
//! D g(D d) - D g(c) = B_a (D d - c) + e          D g(x) = B(d0 + x/2) x
//! ```
//!
//! The force that the solve misses is that of the stress of e at the present mean dm. The first solve of a step has the mean stress sigma of the last one in the geometric
//! stiffness instead of the stress n of the solve; of it that is missed too, with the stress by tangents at hand:
//!
//! ```text
//! b (EA l/4) N(A e) dm + 1/2 (N(n) - sigma N(a)) (D d - c)
//! ```
//!
//! Internal damping has the stress tau/h instead of b.

use super::{Group, middle_before, zero};
use crate::Real;
use crate::effect::tables::ElementTables;
use crate::element::gram::{form, gradient, gram_rates};
use crate::element::kernel::{DiscreteGradientForce, Load};
use crate::element::step::{ElementStep, combined, shifted};
use crate::integrate::discrete_gradient::{ALPHA, BETA};
use crate::simd::{LANES, dispatch};
use crate::system::elements::Elements;
use fearless_simd::{Level, Simd, SimdBase, f64x8};

/// The iterates of a linear solve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolvedStep<'a> {
    /// Coordinates at the beginning of the step.
    pub start: &'a [f64],
    /// The change about which the matrix was made.
    pub about: &'a [f64],
    /// The change before the solve.
    pub before: &'a [f64],
    /// The change by the solve.
    pub solved: &'a [f64],
    /// The present change: as `solved`, but for coordinates that follow a body.
    pub change: &'a [f64],
    /// After the first solve, the change in the step before, and the share of it that counts.
    pub last_step: Option<(&'a [f64], f64)>,
    /// Length of the step in s.
    pub h: f64,
    /// Time of axial damping in s.
    pub damping: f64,
}

impl Elements {
    /// Adds the impulses that the solve misses to `out`.
    pub fn add_remainder(&self, level: Level, effects: Option<&ElementTables>, step: SolvedStep<'_>, out: &mut [f64]) {
        dispatch!(level, simd => self.remainder_lanes(simd, effects, step, out));
    }

    #[inline(always)]
    fn remainder_lanes<S: Simd>(
        &self,
        simd: S,
        effects: Option<&ElementTables>,
        step: SolvedStep<'_>,
        out: &mut [f64],
    ) {
        for first in (0..self.count).step_by(LANES) {
            let group = Group { simd, first };
            let d = self.gather_control(group, step.start);
            let (before, change) = (self.gather_control(group, step.before), self.gather_control(group, step.change));
            let increment = shifted(&self.gather_control(group, step.solved), &before, -1.0);
            let about = shifted(&d, &self.gather_control(group, step.about), 0.5);
            let mean = shifted(&d, &change, 0.5);
            let gained = gram_rates(&mean, &change);
            let linear =
                combined(&gram_rates(&shifted(&d, &before, 0.5), &before), &gram_rates(&about, &increment), 1.0);
            let missed = combined(&gained, &linear, -1.0);
            let axial = group.load(&self.axial);
            let mut stress = [zero(simd); 6];
            self.table.add_product(&missed, axial * (BETA * step.h + step.damping), &mut stress);
            let mut force = gradient(&stress, &mean);
            if let Some((list, kept)) = step.last_step {
                let s = ElementStep::new(&d, &change, &self.gather_control(group, list), kept);
                let mut n = self.table.gradient(&combined(&s.one_leg(ALPHA), &missed, -BETA), axial * step.h);
                self.table.add_product(&linear, axial * step.damping, &mut n);
                let one = <f64x8<S> as SimdBase<S>>::splat(simd, 1.0);
                let mut rest = one;
                if let Some(effects) = effects {
                    effects.add_rest_strain(&group, &mut rest);
                }
                let sigma = (form(&self.table.a, &middle_before(&s)) - rest).at_least(0.0);
                self.table.add_mean((one - rest - sigma) * (axial * step.h), &mut n);
                force = shifted(&force, &gradient(&n, &increment), 0.5);
            }
            self.scatter_force(simd, first, &force, out);
        }
    }
}
