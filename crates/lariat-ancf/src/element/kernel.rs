//! Energy, force and tangent of one element for a pair of rules and the effects that act on Gram
//! numbers.
//!
//! # Equation
//!
//! `U = EA l/8 (g.A.g - 2 a.g + 1) + (2 EI/l) u(g)` ([`axial`](crate::element::axial),
//! [`bending`](crate::element::bending)); derivatives with respect to the control vectors by
//! [`gram`](super::gram). The nodes follow by the constant map d1 = 3 (r_j - r_i)/l, done where the
//! result is scattered.
//!
//! # Validity
//!
//! Any element state. Generic over [`Real`]: one element in `f64` or in dual numbers, eight in
//! lanes.

use super::gram::{Control, Six, Upper, gradient, gram, gram_rates, hessian_block};
use super::step::ElementStep;
use crate::Real;
use crate::element::axial::AxialTable;
use crate::element::bending::Bending;

/// Stiffness of one element: `axial = EA l/4` (J), `bending = 2 EI/l` (J).
#[derive(Clone, Copy, Debug)]
pub struct Stiffness<T> {
    /// EA l/4, in J.
    pub axial: T,
    /// 2 EI/l, in J.
    pub bending: T,
}

/// Second derivatives with respect to the control vectors: the 3x3 blocks (0,0), (0,1), (0,2),
/// (1,1), (1,2), (2,2).
pub type Blocks<T> = [[[T; 3]; 3]; 6];

/// Axial and bending energy in J.
#[inline]
pub fn energy<B: Bending>(table: &AxialTable, bending: &B, stiffness: Stiffness<f64>, d: &Control<f64>) -> (f64, f64) {
    let g = gram(d);
    (0.5 * stiffness.axial * table.energy(&g), stiffness.bending * bending.energy(&g))
}

/// Gradient of the energy with respect to the control vectors, in N m (the force is its negative).
#[inline(always)]
pub fn force<T: Real, B: Bending>(
    table: &AxialTable,
    bending: &B,
    stiffness: Stiffness<T>,
    d: &Control<T>,
) -> Control<T> {
    Kernel { table, bending, effects: &NoEffects }.force(&ElementState { stiffness, d: *d, velocity: None }, &NoEffects)
}

/// Gradient and second derivatives of the energy with respect to the control vectors.
#[inline(always)]
pub fn force_and_tangent<T: Real, B: Bending>(
    table: &AxialTable,
    bending: &B,
    stiffness: Stiffness<T>,
    d: &Control<T>,
) -> (Control<T>, Blocks<T>) {
    let state = ElementState { stiffness, d: *d, velocity: None };
    Kernel { table, bending, effects: &NoEffects }.force_and_tangent(&state, 0.0, &NoEffects)
}

/// What one element, or a group of elements in lanes, is evaluated at.
#[derive(Clone, Copy)]
pub(crate) struct ElementState<T> {
    pub stiffness: Stiffness<T>,
    /// Control vectors.
    pub d: Control<T>,
    /// Their velocities, where a force depends on them and the cable moves.
    pub velocity: Option<Control<T>>,
}

/// An element state in Gram numbers, as effects see it.
pub(crate) struct GramState<'a, T> {
    pub table: &'a AxialTable,
    pub stiffness: Stiffness<T>,
    /// Gram numbers.
    pub g: Six<T>,
    /// Their rates, where the element has velocities.
    pub rates: Option<Six<T>>,
}

/// Weighted derivatives of what acts on an element (see [`gram`](super::gram)).
pub(crate) struct Gradient<T> {
    /// Pairs that act on the control vectors.
    pub n: Six<T>,
    /// Pairs that act on their velocities.
    pub viscous: Six<T>,
}

/// Weighted second derivatives of what acts on an element.
pub(crate) struct Hessian<T> {
    /// Pairs of the geometric stiffness.
    pub geometric: Six<T>,
    pub h: Upper<T>,
}

/// Reads the numbers of the element, or of the group of elements, that is evaluated.
pub(crate) trait Load<T> {
    /// From a list with a number per element.
    fn load(&self, by_element: &[f64]) -> T;
}

/// An effect that acts on Gram numbers and their rates, evaluated within the kernel.
pub(crate) trait GramForce {
    /// Whether it needs rates.
    fn needs_rates(&self) -> bool;

    /// Adds its weighted derivatives.
    fn add_gradient<T: Real, L: Load<T>>(&self, at: &GramState<'_, T>, from: &L, sum: &mut Gradient<T>);

    /// Adds its weighted derivatives and second derivatives; `rate` = d velocity/d position in 1/s.
    fn add_hessian<T: Real, L: Load<T>>(
        &self,
        at: &GramState<'_, T>,
        rate: f64,
        from: &L,
        sum: &mut Gradient<T>,
        tangent: &mut Hessian<T>,
    );
}

/// A step of an element in Gram numbers, as effects see it.
pub(crate) struct GramStep<'a, T> {
    pub table: &'a AxialTable,
    pub stiffness: Stiffness<T>,
    pub step: &'a ElementStep<T>,
    /// Gram numbers of the mean control vectors.
    pub middle: Six<T>,
    /// Change of the Gram numbers over the length of the step.
    pub rates: Six<T>,
    /// 1/h in 1/s.
    pub rate: f64,
    /// Factor on the [stiffness of damping across the curvature](crate::effect::damping) in the
    /// tangent: 1 where contacts are near and in parts of a step, else 0.
    pub across: f64,
}

/// An effect with discrete gradients.
pub(crate) trait DiscreteGradientForce {
    /// Adds the pairs of its discrete gradient over a step, and returns the power in W that it
    /// dissipates, without that of the pairs that act on velocities.
    fn add_discrete_gradient<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, sum: &mut Gradient<T>) -> T;

    /// Adds the derivatives of the pairs by the change of the Gram numbers, without what would make
    /// the matrix indefinite: pairs of the geometric stiffness and second derivatives.
    fn add_step_tangent<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, tangent: &mut Hessian<T>);

    /// Adds by how much the strain energy at the beginning of the step, with the factor of the
    /// stiffness, is more than that of Green's law and of a straight cable.
    fn add_strain_energy<T: Real, L: Load<T>>(&self, _: &GramStep<'_, T>, _: &L, _: &mut T) {}

    /// Adds by how much the mean axial stress over EA/2 is less than that of the Green law,
    /// `square - 1` of the squared stretch: f_0^2 - 1 of a stretch f_0 without stress.
    fn add_rest_strain<T: Real, L: Load<T>>(&self, square: T, from: &L, strain: &mut T);

    /// Adds by how much the axial energy per length over EA of a uniform squared stretch is more
    /// than that of the Green law, `(square - 1)^2/8`.
    fn add_rest_energy<T: Real, L: Load<T>>(&self, square: T, from: &L, energy: &mut T);
}

impl<E: GramForce> GramForce for Option<&E> {
    #[inline(always)]
    fn needs_rates(&self) -> bool {
        match self {
            Some(effects) => effects.needs_rates(),
            None => false,
        }
    }
    #[inline(always)]
    fn add_gradient<T: Real, L: Load<T>>(&self, at: &GramState<'_, T>, from: &L, sum: &mut Gradient<T>) {
        if let Some(effects) = self {
            effects.add_gradient(at, from, sum);
        }
    }
    #[inline(always)]
    fn add_hessian<T: Real, L: Load<T>>(
        &self,
        at: &GramState<'_, T>,
        rate: f64,
        from: &L,
        sum: &mut Gradient<T>,
        tangent: &mut Hessian<T>,
    ) {
        if let Some(effects) = self {
            effects.add_hessian(at, rate, from, sum, tangent);
        }
    }
}

/// No effect: no code runs.
pub(crate) struct NoEffects;

impl GramForce for NoEffects {
    #[inline(always)]
    fn needs_rates(&self) -> bool {
        false
    }
    #[inline(always)]
    fn add_gradient<T: Real, L: Load<T>>(&self, _: &GramState<'_, T>, _: &L, _: &mut Gradient<T>) {}
    #[inline(always)]
    fn add_hessian<T: Real, L: Load<T>>(
        &self,
        _: &GramState<'_, T>,
        _: f64,
        _: &L,
        _: &mut Gradient<T>,
        _: &mut Hessian<T>,
    ) {
    }
}

impl<T> Load<T> for NoEffects {
    fn load(&self, _: &[f64]) -> T {
        unreachable!("no effect reads a number")
    }
}

/// The element kernel for an axial rule, a bending rule and effects.
#[derive(Clone, Copy)]
pub(crate) struct Kernel<'a, B, E> {
    pub table: &'a AxialTable,
    pub bending: &'a B,
    pub effects: &'a E,
}

impl<B: Bending, E: GramForce> Kernel<'_, B, E> {
    /// Negative force on the control vectors, in N m.
    #[inline(always)]
    pub fn force<T: Real, L: Load<T>>(&self, state: &ElementState<T>, from: &L) -> Control<T> {
        let (at, mut sum) = self.begin(state);
        self.bending.add_gradient(&at.g, at.stiffness.bending, &mut sum.n);
        self.effects.add_gradient(&at, from, &mut sum);
        sum.force(state)
    }

    /// Negative force on the control vectors, in N m, and its derivatives; `rate` = d velocity/d
    /// position in 1/s.
    #[inline(always)]
    pub fn force_and_tangent<T: Real, L: Load<T>>(
        &self,
        state: &ElementState<T>,
        rate: f64,
        from: &L,
    ) -> (Control<T>, Blocks<T>) {
        let (at, mut sum) = self.begin(state);
        let mut h = self.table.hessian(at.stiffness.axial);
        self.bending.add_hessian(&at.g, at.stiffness.bending, &mut sum.n, &mut h);
        let mut tangent = Hessian { geometric: sum.n, h };
        self.effects.add_hessian(&at, rate, from, &mut sum, &mut tangent);
        let Hessian { geometric, h } = &tangent;
        let blocks = [
            hessian_block(0, 0, geometric, h, &state.d),
            hessian_block(0, 1, geometric, h, &state.d),
            hessian_block(0, 2, geometric, h, &state.d),
            hessian_block(1, 1, geometric, h, &state.d),
            hessian_block(1, 2, geometric, h, &state.d),
            hessian_block(2, 2, geometric, h, &state.d),
        ];
        (sum.force(state), blocks)
    }

    /// Gram numbers, their rates, and the axial rule's share of the gradient.
    #[inline(always)]
    fn begin<'a, T: Real>(&'a self, state: &ElementState<T>) -> (GramState<'a, T>, Gradient<T>) {
        let g = gram(&state.d);
        let rates = match &state.velocity {
            Some(velocity) => Some(gram_rates(&state.d, velocity)),
            None => None,
        };
        let n = self.table.gradient(&g, state.stiffness.axial);
        let at = GramState { table: self.table, stiffness: state.stiffness, g, rates };
        (at, Gradient { n, viscous: [g[0].splat(0.0); 6] })
    }
}

impl<T: Real> Gradient<T> {
    /// Negative force on the control vectors.
    #[inline(always)]
    fn force(&self, state: &ElementState<T>) -> Control<T> {
        let mut force = gradient(&self.n, &state.d);
        if let Some(velocity) = &state.velocity {
            let viscous = gradient(&self.viscous, velocity);
            for i in 0..3 {
                for x in 0..3 {
                    force[i][x] = force[i][x] + viscous[i][x];
                }
            }
        }
        force
    }
}
