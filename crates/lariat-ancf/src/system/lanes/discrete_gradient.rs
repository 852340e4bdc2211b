//! Discrete-gradient forces of all elements, their tangent and their dissipation, eight elements at
//! a time.
//!
//! # Equation
//!
//! The pairs n of an element ([`element::step`](crate::element::step)) add up those of the axial
//! rule, of the bending rule and of effects; the force is `N(n) dm`. Of its derivative by the
//! change D d the tangent takes, with `B = dg/dd` at dm,
//!
//! ```text
//! b (EA l/4) B^T A B + 1/2 max(0, sigma) N(a) + 1/2 (N(n_b) + B^T u''(gm) B) + a (2EI/l) N(rho) + effects
//! ```
//!
//! sigma is the mean axial stress. Left out are `B^T A (B(d1) - B)`, which is unsymmetric and of
//! first order in the rotation per step, and the geometric stiffness of compression. Only the
//! bending term can make the matrix indefinite; that of T1 is positive.
//!
//! sigma is the stress of the last linear solve, and before the first the stress in the middle of
//! the step before: the strains of an iterate whose slopes have rotated are far from those of the
//! solution.

use super::dispatch::dispatch_groups;
use super::group::Group;
use super::{Elements, MatrixOutput};
use crate::Real;
use crate::effect::tables::ElementTables;
use crate::element::bending::Bending;
use crate::element::bending::t1::RHO;
use crate::element::gram::{Control, PAIR_WEIGHT, Six, contract, form, gradient, gram, gram_rates, hessian_block};
use crate::element::kernel::{DiscreteGradientForce, Gradient, GramForce, GramStep, Hessian, Load, Stiffness};
use crate::element::step::{ElementStep, STRAIGHT, combined, product, scaled, shifted};
use crate::linalg::Block;
use crate::one_leg::OneLeg;
use fearless_simd::Level;

/// A step of the coordinates of a cable.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoordinateStep<'a> {
    /// Coordinates at the beginning.
    pub start: &'a [f64],
    /// Change over the step.
    pub change: &'a [f64],
    /// Change in the step before.
    pub before: &'a [f64],
    /// Share of that change that counts: less than 1 after a longer step.
    pub kept: f64,
    /// The change about which the linear solve was made that gave `change`; empty if none was.
    pub linearised: &'a [f64],
    /// Length of the step in s.
    pub h: f64,
    /// Its formula.
    pub leg: OneLeg,
    /// Whether the tangent has what damping resists across the curvature.
    pub across: bool,
}

/// What the elements of a cable lose in a step, in J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ElementLoss {
    /// Numerical dissipation.
    pub numerical: f64,
    /// Dissipation by effects.
    pub effects: f64,
    /// Strain energy at the beginning, that of bending in the norm of rule T1, at least zero.
    pub strain: f64,
}

impl Elements {
    /// Adds h times the discrete-gradient force to `out`, and overwrites the matrix by the mass
    /// matrix plus `b h^2` times the tangent.
    pub fn add_discrete_gradient_and_matrix(
        &self,
        level: Level,
        effects: Option<&ElementTables>,
        step: CoordinateStep<'_>,
        out: &mut [f64],
        to: MatrixOutput<'_>,
    ) {
        dispatch_groups!(level, groups => self.step_matrix_groups(groups, effects, step, out, to));
    }

    /// Adds h times the discrete-gradient force to `out`, and returns what the elements lose.
    pub fn add_discrete_gradient(
        &self,
        level: Level,
        effects: Option<&ElementTables>,
        step: CoordinateStep<'_>,
        out: &mut [f64],
    ) -> ElementLoss {
        dispatch_groups!(level, groups => self.discrete_gradient_groups(groups, effects, step, out))
    }

    #[inline(always)]
    fn gather_step<G: Group>(
        &self,
        group: G,
        step: CoordinateStep<'_>,
    ) -> (ElementStep<G::Number>, Stiffness<G::Number>) {
        let d = group.control(self, step.start);
        let change = group.control(self, step.change);
        let before = group.control(self, step.before);
        let stiffness =
            Stiffness { axial: group.load(&self.axial) * step.h, bending: group.load(&self.flexural) * step.h };
        (ElementStep::new(&d, &change, &before, step.kept), stiffness)
    }

    /// Returns the pairs of the axial rule and of the bending rule.
    #[inline(always)]
    fn pairs<T: Real>(&self, stiffness: Stiffness<T>, s: &ElementStep<T>, leg: OneLeg) -> [Six<T>; 2] {
        let axial = self.table.gradient(&s.one_leg(leg.a), stiffness.axial);
        let mut flexural = [stiffness.axial.splat(0.0); 6];
        self.bending.add_discrete_gradient([&s.start, &s.end], stiffness.bending, &mut flexural);
        [axial, flexural]
    }

    #[inline(always)]
    fn gram_step<'a, T: Real>(&'a self, stiffness: Stiffness<T>, step: &'a ElementStep<T>, h: f64) -> GramStep<'a, T> {
        let rate = 1.0 / h;
        let rates = scaled(&step.gram_change, rate);
        GramStep { table: &self.table, stiffness, step, middle: gram(&step.mean), rates, rate, across: 0.0 }
    }

    /// Returns h times the negative discrete-gradient force of one element on its control vectors;
    /// the stiffness has the factor h.
    #[inline(always)]
    pub fn discrete_gradient_of<T: Real, L: Load<T>>(
        &self,
        effects: Option<&ElementTables>,
        from: &L,
        step: &ElementStep<T>,
        stiffness: Stiffness<T>,
        (h, leg): (f64, OneLeg),
    ) -> Control<T> {
        self.element_force(effects, from, (step, stiffness, h, leg)).0
    }

    /// Returns h times the negative force on the control vectors, and h times numerical
    /// dissipation, dissipation by effects (times 1) and strain energy.
    #[inline(always)]
    fn element_force<T: Real, L: Load<T>>(
        &self,
        effects: Option<&ElementTables>,
        from: &L,
        (s, stiffness, h, leg): (&ElementStep<T>, Stiffness<T>, f64, OneLeg),
    ) -> (Control<T>, [T; 3]) {
        let (zero, rate) = (stiffness.axial.splat(0.0), 1.0 / h);
        let [axial, flexural] = self.pairs(stiffness, s, leg);
        let mut sum = Gradient { n: combined(&axial, &flexural, 1.0), viscous: [zero; 6] };
        let (mut dissipated, mut strain) = (zero, self.axial_square(stiffness, &over_straight(&s.start)) * 0.5);
        if let Some(effects) = effects {
            let at = self.gram_step(stiffness, s, h);
            dissipated = effects.add_discrete_gradient(&at, from, &mut sum);
            effects.add_strain_energy(&at, from, &mut strain);
        }
        let mut force = gradient(&sum.n, &s.mean);
        let mut numerical = self.axial_square(stiffness, &s.gram_second()) * (0.5 * leg.a);
        if self.bends() {
            let of_bending = gradient(&numerical_bending(stiffness.bending, leg), &s.second);
            force = shifted(&force, &of_bending, 1.0);
            numerical = numerical + product(&of_bending, &s.second) * 0.5;
            strain = strain + stiffness.bending * form(&RHO, &s.start);
        }
        if effects.is_some_and(|effects| effects.needs_rates()) {
            let viscous = gradient(&sum.viscous, &s.change);
            force = shifted(&force, &viscous, rate);
            dissipated = dissipated + product(&viscous, &s.change) * (rate * rate);
        }
        (force, [numerical, dissipated, strain])
    }

    #[inline(always)]
    fn discrete_gradient_groups<G: Group>(
        &self,
        groups: G,
        effects: Option<&ElementTables>,
        step: CoordinateStep<'_>,
        out: &mut [f64],
    ) -> ElementLoss {
        let rate = 1.0 / step.h;
        let mut losses = [0.0; 3];
        for first in (0..self.count).step_by(G::SIZE) {
            let group = groups.at(first);
            let (s, stiffness) = self.gather_step(group, step);
            let (force, [numerical, dissipated, strain]) =
                self.element_force(effects, &group, (&s, stiffness, step.h, step.leg));
            group.add_force(self, &force, out);
            group.add_to(self, numerical, &mut losses[0]);
            group.add_to(self, dissipated, &mut losses[1]);
            group.add_to(self, strain.at_least(0.0), &mut losses[2]);
        }
        // the stiffness of the lanes has the factor h; what is dissipated is a power
        let [numerical, effects, strain] = losses;
        ElementLoss { numerical: numerical * rate, effects, strain: strain * rate }
    }

    #[inline(always)]
    fn step_matrix_groups<G: Group>(
        &self,
        groups: G,
        effects: Option<&ElementTables>,
        step: CoordinateStep<'_>,
        out: &mut [f64],
        to: MatrixOutput<'_>,
    ) {
        let moving = effects.is_some_and(|effects| effects.needs_rates());
        to.matrix.diag[0] = Block::ZERO;
        for first in (0..self.count).step_by(G::SIZE) {
            let group = groups.at(first);
            let (s, stiffness) = self.gather_step(group, step);
            let [axial, flexural] = self.pairs(stiffness, &s, step.leg);
            let zero = stiffness.axial.splat(0.0);
            let mut sum = Gradient { n: combined(&axial, &flexural, 1.0), viscous: [zero; 6] };
            if let Some(effects) = effects {
                effects.add_discrete_gradient(&self.gram_step(stiffness, &s, step.h), &group, &mut sum);
            }
            let mut force = gradient(&sum.n, &s.mean);
            let mut tangent = Hessian { geometric: [zero; 6], h: self.table.hessian(stiffness.axial * step.leg.b) };
            let stress = self.mean_stress(group, effects, stiffness, step, &s);
            self.table.add_mean(stress * 0.5, &mut tangent.geometric);
            if self.bends() {
                let mean = combined(&s.start, &s.gram_change, 0.5);
                let mut unused = [zero; 6];
                self.bending.add_hessian(&mean, stiffness.bending * 0.5, &mut unused, &mut tangent.h);
                let numerical = numerical_bending(stiffness.bending, step.leg);
                tangent.geometric = combined(&combined(&tangent.geometric, &flexural, 0.5), &numerical, 1.0);
                force = shifted(&force, &gradient(&numerical, &s.second), 1.0);
            }
            if let Some(effects) = effects {
                let at = self.gram_step(stiffness, &s, step.h);
                let at = GramStep { across: if step.across { 1.0 } else { 0.0 }, ..at };
                effects.add_step_tangent(&at, &group, &mut tangent);
            }
            if moving {
                force = shifted(&force, &gradient(&sum.viscous, &s.change), 1.0 / step.h);
            }
            group.add_force(self, &force, out);
            let implicit = step.leg.b * step.h;
            let geometric = scaled(&tangent.geometric, implicit);
            let mut h = tangent.h;
            for i in 0..21 {
                h[i] = h[i] * implicit;
            }
            let blocks = [
                hessian_block(0, 0, &geometric, &h, &s.mean),
                hessian_block(0, 1, &geometric, &h, &s.mean),
                hessian_block(0, 2, &geometric, &h, &s.mean),
                hessian_block(1, 1, &geometric, &h, &s.mean),
                hessian_block(1, 2, &geometric, &h, &s.mean),
                hessian_block(2, 2, &geometric, &h, &s.mean),
            ];
            group.add_matrix(self, &blocks, to.mass_scale, to.matrix);
        }
    }

    /// Returns `EA l/4 x.A x` for changes of Gram numbers.
    #[inline(always)]
    fn axial_square<T: Real>(&self, stiffness: Stiffness<T>, x: &Six<T>) -> T {
        let mut stress = [stiffness.axial.splat(0.0); 6];
        self.table.add_product(x, stiffness.axial, &mut stress);
        contract(&stress, x)
    }

    /// Returns the mean axial stress times EA l/4, not below zero.
    #[inline(always)]
    fn mean_stress<G: Group>(
        &self,
        group: G,
        effects: Option<&ElementTables>,
        stiffness: Stiffness<G::Number>,
        step: CoordinateStep<'_>,
        s: &ElementStep<G::Number>,
    ) -> G::Number {
        let g = if step.linearised.is_empty() {
            combined(&s.start, &s.gram_before, -0.5)
        } else {
            let about = group.control(self, step.linearised);
            let mean = shifted(&shifted(&s.mean, &s.change, -0.5), &about, 0.5);
            let change = gram_rates(&mean, &s.change);
            combined(&combined(&s.start, &change, step.leg.b), &s.gram_before, -step.leg.a)
        };
        let square = form(&self.table.a, &g);
        let mut rest = stiffness.axial.splat(1.0);
        if let Some(effects) = effects {
            effects.add_rest_strain(square, &group, &mut rest);
        }
        (square - rest).at_least(0.0) * stiffness.axial
    }
}

/// Returns the pairs of the numerical dissipation of bending: those of rule T1 times a.
#[inline(always)]
fn numerical_bending<T: Real>(flexural: T, leg: OneLeg) -> Six<T> {
    let mut n = [flexural * leg.a; 6];
    for i in 0..6 {
        n[i] = n[i] * (PAIR_WEIGHT[i] * RHO[i]);
    }
    n
}

/// Returns Gram numbers less those of the straight unstretched element.
#[inline(always)]
fn over_straight<T: Real>(g: &Six<T>) -> Six<T> {
    let mut y = *g;
    for i in 0..6 {
        y[i] = g[i] - STRAIGHT[i];
    }
    y
}

#[cfg(test)]
mod tests;
