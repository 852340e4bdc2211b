//! Effects inside the element kernel: damping and rest shape, in the same lanes as the elastic force.
//!
//! They add to the weighted derivatives n and h of an element before these become forces and blocks, so a damped element is gathered,
//! multiplied out and scattered once. Cables without them run the kernels of [`assembly`](super::assembly), which know nothing of this.

use super::assembly::{BendingKernel, Elements, LANES, load, with_bending};
use super::model::Model;
use crate::Real;
use crate::bending::Bending;
use crate::dual::{Dual, constant};
use crate::effect::Damping;
use crate::effect::curvature::{self, Point};
use crate::effect::damping::gram_rates;
use crate::effect::rest_shape::NaturalCurvature;
use crate::element::gram::{Control, Six, Upper, form, gradient, gram, hessian_block};
use crate::element::kernel::Stiffness;
use crate::linalg::{Block, BlockTridiagonal};
use crate::rule::BendingRule;
use fearless_simd::{Level, Simd, dispatch, f64x8};

/// Gauss points of bending effects beside a bending rule that has none of its own.
const POINTS: usize = 3;

/// f_0^2 - 1 of an element, and its natural curvature.
type Rest = (f64, NaturalCurvature<f64>);

/// Velocities at which forces are evaluated: none at all means at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates<'a> {
    /// Nodal velocities, or an empty slice.
    pub v: &'a [f64],
    /// d velocity/d position of the stage in 1/s.
    pub rate: f64,
}

impl Rates<'_> {
    /// At rest.
    pub const REST: Rates<'static> = Rates { v: &[], rate: 0.0 };
}

/// What effects add to the kernels.
#[derive(Clone, Debug)]
pub(crate) struct KernelEffects {
    damping: Option<Damping>,
    damping_points: Vec<Point>,
    /// f_0^2 - 1 by element, padded; empty = unstretched.
    excess: Vec<f64>,
    rest_points: Vec<Point>,
    /// Target and rounding by element, padded; empty = straight.
    natural: [Vec<f64>; 2],
}

impl KernelEffects {
    /// The tables of a model's effects, if it has any that act in the kernel.
    pub fn new(model: &Model) -> Option<Self> {
        let effects = &model.effects;
        if effects.damping.is_none() && effects.rest_shape.is_none() {
            return None;
        }
        let points = match model.rule.bending {
            BendingRule::None => Vec::new(),
            BendingRule::Gauss(count) => curvature::points(count as usize),
            BendingRule::T1 | BendingRule::T2 => curvature::points(POINTS),
        };
        let mut begin = 0.0;
        let mut rest = Vec::new();
        for element in &model.elements {
            let middle = begin + 0.5 * element.length;
            begin += element.length;
            let (stretch, curvature) = effects.rest_shape.as_ref().map_or((1.0, 0.0), |shape| shape.at(middle));
            rest.push((stretch * stretch - 1.0, NaturalCurvature::new(curvature, element.length)));
        }
        let padded = |f: &dyn Fn(&Rest) -> f64, on: bool| {
            let mut values: Vec<f64> = if on { rest.iter().map(f).collect() } else { Vec::new() };
            if on {
                values.resize(values.len().next_multiple_of(LANES), values[values.len() - 1]);
            }
            values
        };
        let stretched = rest.iter().any(|(excess, _)| *excess != 0.0);
        let curved = rest.iter().any(|(_, natural)| natural.target != 0.0);
        let bends = |damping: &Damping| damping.bending > 0.0;
        Some(KernelEffects {
            damping: effects.damping,
            damping_points: if effects.damping.as_ref().is_some_and(bends) { points.clone() } else { Vec::new() },
            excess: padded(&|(excess, _)| *excess, stretched),
            rest_points: if curved { points } else { Vec::new() },
            natural: [padded(&|(_, n)| n.target, curved), padded(&|(_, n)| n.rounding, curved)],
        })
    }

    /// Adds to the weighted gradient `n` of element `e` and to the pairs that act on its velocities, for its exact derivative.
    pub fn add_dual(
        &self,
        e: usize,
        elements: &Elements,
        g: &Six<Dual>,
        rates: &Six<Dual>,
        [n, viscous]: [&mut Six<Dual>; 2],
    ) {
        let stiffness = Stiffness { axial: constant(elements.axial[e]), bending: constant(elements.flexural[e]) };
        if let Some(excess) = self.excess.get(e) {
            elements.table.add_mean(-(stiffness.axial * *excess), n);
        }
        if !self.rest_points.is_empty() {
            let [target, rounding] = [0, 1].map(|i| constant(self.natural[i][e]));
            NaturalCurvature { target, rounding }.add_gradient(&self.rest_points, stiffness.bending, g, n);
        }
        if let Some(damping) = &self.damping {
            damping.add_gradient(&elements.table, &self.damping_points, stiffness, g, rates, [n, viscous]);
        }
    }

    /// Whether an element is damped.
    pub fn damps(&self) -> bool {
        self.damping.is_some()
    }

    /// Whether an element has a rest shape of its own.
    pub fn rests(&self) -> bool {
        !self.excess.is_empty() || !self.rest_points.is_empty()
    }

    #[inline(always)]
    fn natural<S: Simd>(&self, simd: S, first: usize) -> Option<NaturalCurvature<f64x8<S>>> {
        let lanes = |i: usize| load(simd, &self.natural[i], first);
        (!self.rest_points.is_empty()).then(|| NaturalCurvature { target: lanes(0), rounding: lanes(1) })
    }
}

/// The sum of two forces on control vectors.
#[inline(always)]
pub(super) fn sum<T: Real>(a: &Control<T>, b: &Control<T>) -> Control<T> {
    let mut out = *a;
    for (out, b) in out.iter_mut().zip(b) {
        for x in 0..3 {
            out[x] = out[x] + b[x];
        }
    }
    out
}

impl Elements {
    /// [`add_force`](Self::add_force) with effects.
    pub fn add_force_with(
        &self,
        level: Level,
        effects: &KernelEffects,
        q: &[f64],
        v: &[f64],
        scale: f64,
        out: &mut [f64],
    ) {
        with_bending!(&self.bending, b => dispatch!(level, simd => self.lanes_with(simd, effects, b, q, v, scale, out)));
    }

    /// [`add_force_and_matrix`](Self::add_force_and_matrix) with effects.
    pub fn add_force_and_matrix_with(
        &self,
        level: Level,
        effects: &KernelEffects,
        q: &[f64],
        rates: Rates<'_>,
        scale: f64,
        mass_scale: f64,
        out: &mut [f64],
        a: &mut BlockTridiagonal,
    ) {
        with_bending!(&self.bending, b => dispatch!(level, simd => {
            self.matrix_lanes_with(simd, effects, b, q, rates, scale, mass_scale, out, a)
        }));
    }

    #[inline(always)]
    fn lanes_with<S: Simd, B: Bending>(
        &self,
        simd: S,
        effects: &KernelEffects,
        bending: &B,
        q: &[f64],
        v: &[f64],
        scale: f64,
        out: &mut [f64],
    ) {
        let damping = effects.damping.filter(|_| !v.is_empty());
        for first in (0..self.count).step_by(LANES) {
            let (d, stiffness) = self.gather(simd, first, q, scale);
            let g = gram(&d);
            let mut n: Six<f64x8<S>> = self.table.gradient(&g, stiffness.axial);
            bending.add_gradient(&g, stiffness.bending, &mut n);
            if !effects.excess.is_empty() {
                self.table.add_mean(-(stiffness.axial * load(simd, &effects.excess, first)), &mut n);
            }
            if let Some(natural) = effects.natural(simd, first) {
                natural.add_gradient(&effects.rest_points, stiffness.bending, &g, &mut n);
            }
            if let Some(damping) = &damping {
                let v = self.gather(simd, first, v, scale).0;
                let mut viscous = [g[0] * 0.0; 6];
                let both = [&mut n, &mut viscous];
                damping.add_gradient(&self.table, &effects.damping_points, stiffness, &g, &gram_rates(&d, &v), both);
                self.scatter_force(simd, first, &sum(&gradient(&n, &d), &gradient(&viscous, &v)), out);
            } else {
                self.scatter_force(simd, first, &gradient(&n, &d), out);
            }
        }
    }

    #[inline(always)]
    fn matrix_lanes_with<S: Simd, B: Bending>(
        &self,
        simd: S,
        effects: &KernelEffects,
        bending: &B,
        q: &[f64],
        Rates { v, rate }: Rates<'_>,
        scale: f64,
        mass_scale: f64,
        out: &mut [f64],
        a: &mut BlockTridiagonal,
    ) {
        let damping = effects.damping.filter(|_| !v.is_empty());
        a.diag[0] = Block::ZERO;
        for first in (0..self.count).step_by(LANES) {
            let (d, stiffness) = self.gather(simd, first, q, scale);
            let g = gram(&d);
            let mut n: Six<f64x8<S>> = self.table.gradient(&g, stiffness.axial);
            let mut h: Upper<f64x8<S>> = self.table.hessian(stiffness.axial);
            bending.add_hessian(&g, stiffness.bending, &mut n, &mut h);
            if !effects.excess.is_empty() {
                self.table.add_mean(-(stiffness.axial * load(simd, &effects.excess, first)), &mut n);
            }
            let mut geometric = n;
            if let Some(natural) = effects.natural(simd, first) {
                let both = [&mut n, &mut geometric];
                natural.add_hessian(&effects.rest_points, stiffness.bending, &g, both, &mut h);
            }
            if let Some(damping) = &damping {
                let v = self.gather(simd, first, v, scale).0;
                let (rates, mut viscous) = (gram_rates(&d, &v), [g[0] * 0.0; 6]);
                let all = [&mut n, &mut geometric, &mut viscous];
                damping.add_hessian(&self.table, &effects.damping_points, stiffness, &g, &rates, rate, all, &mut h);
                for i in 0..6 {
                    geometric[i] += viscous[i] * rate;
                }
                self.scatter_force(simd, first, &sum(&gradient(&n, &d), &gradient(&viscous, &v)), out);
            } else {
                self.scatter_force(simd, first, &gradient(&n, &d), out);
            }
            let blocks = [
                hessian_block(0, 0, &geometric, &h, &d),
                hessian_block(0, 1, &geometric, &h, &d),
                hessian_block(0, 2, &geometric, &h, &d),
                hessian_block(1, 1, &geometric, &h, &d),
                hessian_block(1, 2, &geometric, &h, &d),
                hessian_block(2, 2, &geometric, &h, &d),
            ];
            self.scatter_matrix(simd, first, &blocks, mass_scale, a);
        }
    }

    /// Axial and bending energy in J that a rest shape adds.
    pub fn rest_energy(&self, effects: &KernelEffects, q: &[f64]) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for e in 0..self.count {
            let g = gram(&self.control(e, q));
            if let Some(x) = effects.excess.get(e) {
                // EA l/8 ((1 + x)^2 - 1 - 2 x a.g)
                sum.0 += self.axial[e] * x * (1.0 + 0.5 * x - form(&self.table.a, &g));
            }
            if !effects.rest_points.is_empty() {
                let natural = NaturalCurvature { target: effects.natural[0][e], rounding: effects.natural[1][e] };
                sum.1 += self.flexural[e] * natural.energy(&effects.rest_points, &g);
            }
        }
        sum
    }

    /// Power in W that damping turns into heat.
    pub fn damping_power(&self, effects: &KernelEffects, q: &[f64], v: &[f64]) -> f64 {
        let Some(damping) = &effects.damping else { return 0.0 };
        (0..self.count)
            .map(|e| {
                let (d, w): (Control<f64>, Control<f64>) = (self.control(e, q), self.control(e, v));
                let stiffness = Stiffness { axial: self.axial[e], bending: self.flexural[e] };
                damping.power(&self.table, &effects.damping_points, stiffness, &d, &w)
            })
            .sum()
    }
}
