//! Rest shape: stress-free stretch and curvature of a cable that was coiled, or built in under
//! pre-strain.
//!
//! # Equation
//!
//! ```text
//! N = EA (eps - eps_0) f,  eps_0 = (f_0^2 - 1)/2        U_axial = EA l/8 (g.A.g - 2 f_0^2 a.g + f_0^4)
//! U_bending = EI l/2 sum_q w_q (S_q - S_0)^2,           S = sqrt(kappa^2 + k_r^2), S_0 = sqrt(kappa_0^2 + k_r^2), k_r = kappa_0/100
//! ```
//!
//! The square of kappa is the bending rule's; the rest is added here at the points of the rule
//! (three for T1, T2). Every shape of curvature kappa_0 is stress-free, to the last bit for Gauss
//! rules. k_r rounds the cusp of the energy at the straight cable: between kappa_0/2 and 2 kappa_0
//! moments change by less than 0.5 % of EI kappa_0.
//!
//! At the eye of a reel l changes. With the half angles `th_q` of the bending rule it is
//!
//! ```text
//! U_bending = (2 EI/l) sum_q w_q (R_q - S_0 l/2)^2,      R_q = sqrt(th_q^2 + k_r^2 l^2/4)
//! ```
//!
//! of which `-2 EI S_0 sum_q w_q R_q` grows neither with l nor with its inverse: its force on the
//! length over a step is a quotient of differences by k_r alone. Stock lies in its rest shape,
//! without energy: what comes out straight takes `EI kappa_0^2/2` per length from the winch.
//!
//! The tangent is exact beyond kappa_0. Below, the geometric stiffness of the compressive bending
//! moment across the curvature is left out, which keeps the step matrix definite and costs Newton
//! iterations; [`Cable::jacobians`](crate::coupling::Linearisation::jacobians) has all of it.
//!
//! # Validity
//!
//! The *direction* of the natural curvature is free: a coil may unwind into any curve of the same
//! curvature, out of plane without resistance, and one that passes through the straight line may
//! come out on the other side. A cable that is *straighter* than kappa_0 has therefore no stiffness
//! across its plane, or a negative one: it may wrinkle at the size of the mesh, and one that is
//! pulled straight vibrates at that size, which error control follows (`lariat stability --case
//! "hanging 1e4"`: 22 times the steps with effects). Draw its start shape finely, because the
//! corners of a coarse polyline stay. Meant for cables that stay near one plane or beyond kappa_0.
//! The straight cable is an unstable equilibrium. f_0 within a few percent of 1: EA counts per
//! length of the reference.
//!
//! # References
//!
//! The energy of an elastic rod without twist: with a section that rotates freely about the axis,
//! 1/2 EI |kappa - kappa_0 n|^2 is least where the natural direction n lies along kappa, which
//! leaves 1/2 EI (kappa - kappa_0)^2 (Langer & Singer 1996, SIAM Review 38:605, on the twist-free
//! frame).
//!
//! # Alternatives considered
//!
//! A natural curvature with a direction: it needs the twist that this element does not have. k_r =
//! 0: the tangent is infinite at the straight cable.

use super::acts::{Acts, ElementForce, Nothing, SampledPoint};
use super::curvature::{self, Point};
use super::{Cut, Effect, Target};
use crate::Real;
use crate::element::bending::gauss::middle;
use crate::element::gram::{Control, Six, form, gram};
use crate::element::kernel::{DiscreteGradientForce, Gradient, GramForce, GramState, GramStep, Hessian, Load};
use crate::error::{Error, Requirement, require};
use crate::scales::effect::{BLUNTING, NOISE};
use crate::section::Element;
use crate::simd::padded;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Stress-free stretch and curvature from an arc length on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RestPiece {
    /// Arc length of the unstretched cable where the piece begins, in m; it acts on the elements
    /// whose middle lies in it.
    pub from: f64,
    /// Stretch without stress f_0, > 0; 1 = unstretched, above 1 = longer than its reference
    /// length.
    pub stretch: f64,
    /// Curvature without stress kappa_0 in 1/m, >= 0.
    pub curvature: f64,
}

/// The shape of a cable without stress.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RestShape {
    /// Pieces by ascending arc length; before the first, straight and unstretched.
    pub pieces: Vec<RestPiece>,
}

impl RestShape {
    /// Creates a natural curvature (1/m) of the whole cable.
    pub fn curved(curvature: f64) -> Self {
        RestShape { pieces: vec![RestPiece { from: 0.0, stretch: 1.0, curvature }] }
    }

    /// Returns whether a piece has a stress-free stretch.
    pub(crate) fn is_stretched(&self) -> bool {
        self.pieces.iter().any(|piece| piece.stretch != 1.0)
    }

    /// Creates a stress-free stretch of the whole cable: below 1 it is under tension at its
    /// reference length.
    pub fn stretched(stretch: f64) -> Self {
        RestShape { pieces: vec![RestPiece { from: 0.0, stretch, curvature: 0.0 }] }
    }

    /// Returns stretch and curvature (1/m) at an arc length.
    pub fn at(&self, arc_length: f64) -> (f64, f64) {
        let piece = self.pieces.iter().rev().find(|piece| piece.from <= arc_length);
        piece.map_or((1.0, 0.0), |piece| (piece.stretch, piece.curvature))
    }

    /// Whether any piece is curved.
    pub(crate) fn is_curved(&self) -> bool {
        self.pieces.iter().any(|piece| piece.curvature > 0.0)
    }

    /// The first piece that no element of a cable has.
    fn unused(&self, elements: &[Element]) -> Option<usize> {
        let mut begin = 0.0;
        let middle = |e: &Element| {
            let end = begin + e.length;
            0.5 * (core::mem::replace(&mut begin, end) + end)
        };
        let middles: Vec<f64> = elements.iter().map(middle).collect();
        (0..self.pieces.len()).find(|&i| {
            let end = self.pieces.get(i + 1).map_or(f64::INFINITY, |next| next.from);
            !middles.iter().any(|s| (self.pieces[i].from..end).contains(s))
        })
    }
}

impl Effect for RestShape {
    const DISSIPATIVE: bool = false;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        let mut before = f64::NEG_INFINITY;
        for piece in &self.pieces {
            require("arc length of a rest shape (m)", piece.from, piece.from > before, "ascending")?;
            require("rest stretch", piece.stretch, piece.stretch > 0.0, "> 0")?;
            require("rest curvature (1/m)", piece.curvature, piece.curvature >= 0.0, ">= 0")?;
            before = piece.from;
        }
        if let Some(i) = self.unused(cable.elements) {
            let from = self.pieces[i].from;
            return Err(Error::EmptyRestPiece { cable: cable.name.to_string(), from });
        }
        if cable.has_no_bending() && self.is_curved() {
            return Err(cable.missing("a natural curvature", Requirement::BendingRule));
        }
        Ok(())
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn has_exact_tangent(&self) -> bool {
        !self.is_curved()
    }

    fn needs_implicit_integrator(&self) -> bool {
        false
    }

    fn is_steady(&self, _from: f64, _to: f64) -> bool {
        true
    }

    fn cut(&self, cut: Cut<'_>) -> [Option<Self>; 2] {
        let s = cut.arc_length();
        let before = self.pieces.partition_point(|piece| piece.from <= s).saturating_sub(1);
        let shift = |piece: &RestPiece| RestPiece { from: (piece.from - s).max(0.0), ..*piece };
        let head = RestShape { pieces: self.pieces.clone() };
        let tail = RestShape { pieces: self.pieces[before..].iter().map(shift).collect() };
        let [of_head, of_tail] = cut.parts();
        [(head, of_head), (tail, of_tail)].map(|(mut shape, elements)| {
            while let Some(i) = shape.unused(elements) {
                shape.pieces.remove(i);
            }
            (!shape.pieces.is_empty()).then_some(shape)
        })
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

/// Rest shape of all elements, as the kernel needs it.
#[derive(Clone, Debug)]
pub(crate) struct RestTable {
    /// f_0^2 - 1 by element, padded; empty = unstretched.
    excess: Vec<f64>,
    points: Vec<Point>,
    /// Target and rounding of the natural curvature by element, padded; empty = straight.
    natural: [Vec<f64>; 2],
    /// Natural curvature in 1/m by element; empty = straight.
    curvature: Vec<f64>,
}

impl Acts for RestShape {
    type InElement = RestTable;
    type AtPoints = Nothing;

    fn in_element(&self, cable: &Target<'_>) -> Option<RestTable> {
        let mut begin = 0.0;
        let mut rest = Vec::new();
        for element in cable.elements {
            let middle = begin + 0.5 * element.length;
            begin += element.length;
            let (stretch, curvature) = self.at(middle);
            rest.push((stretch * stretch - 1.0, curvature, NaturalCurvature::new(curvature, element.length)));
        }
        let stretched = rest.iter().any(|(excess, ..)| *excess != 0.0);
        let curved = rest.iter().any(|(_, curvature, _)| *curvature != 0.0);
        let none = Vec::new;
        let numbers = |f: fn(&NaturalCurvature<f64>) -> f64| padded(rest.iter().map(|(.., natural)| f(natural)));
        let table = RestTable {
            excess: if stretched { padded(rest.iter().map(|(excess, ..)| *excess)) } else { none() },
            points: if curved { curvature::points_of(cable.rule.bending) } else { Vec::new() },
            natural: if curved { [numbers(|n| n.target), numbers(|n| n.rounding)] } else { [none(), none()] },
            curvature: if curved { rest.iter().map(|(_, curvature, _)| *curvature).collect() } else { none() },
        };
        (stretched || curved).then_some(table)
    }
}

/// Returns the axial energy that a rest shape adds to an element of `axial` = EA l/4, x its excess
/// and `square` = a.g its mean squared stretch: `EA l/8 ((1 + x)^2 - 1 - 2 x a.g)`.
#[inline(always)]
fn axial_energy<T: Real>(axial: T, x: T, square: T) -> T {
    axial * x * (x * 0.5 + 1.0 - square)
}

impl RestTable {
    fn of(&self, element: usize) -> NaturalCurvature<f64> {
        let [target, rounding] = [0, 1].map(|i| self.natural[i][element]);
        NaturalCurvature { target, rounding }
    }

    /// The natural curvature of an element in 1/m, if it has one.
    fn curvature_of(&self, element: usize) -> Option<f64> {
        self.curvature.get(element).copied().filter(|curvature| *curvature != 0.0)
    }

    /// Axial energy in J that it adds to an element.
    fn axial_energy(&self, element: usize, at: &GramState<'_, f64>) -> f64 {
        let energy = |excess: &f64| axial_energy(at.stiffness.axial, *excess, form(&at.table.a, &at.g));
        self.excess.get(element).map_or(0.0, energy)
    }

    #[inline(always)]
    fn natural<T: Real, L: Load<T>>(&self, from: &L) -> NaturalCurvature<T> {
        NaturalCurvature { target: from.load(&self.natural[0]), rounding: from.load(&self.natural[1]) }
    }
}

impl GramForce for RestTable {
    #[inline(always)]
    fn needs_rates(&self) -> bool {
        false
    }

    #[inline(always)]
    fn add_gradient<T: Real, L: Load<T>>(&self, at: &GramState<'_, T>, from: &L, sum: &mut Gradient<T>) {
        if !self.excess.is_empty() {
            at.table.add_mean(-(at.stiffness.axial * from.load(&self.excess)), &mut sum.n);
        }
        if !self.points.is_empty() {
            self.natural(from).add_gradient(&self.points, at.stiffness.bending, &at.g, &mut sum.n);
        }
    }

    #[inline(always)]
    fn add_hessian<T: Real, L: Load<T>>(
        &self,
        at: &GramState<'_, T>,
        _: f64,
        from: &L,
        sum: &mut Gradient<T>,
        tangent: &mut Hessian<T>,
    ) {
        if !self.excess.is_empty() {
            let scale = -(at.stiffness.axial * from.load(&self.excess));
            at.table.add_mean(scale, &mut sum.n);
            at.table.add_mean(scale, &mut tangent.geometric);
        }
        if !self.points.is_empty() {
            self.natural(from).add_hessian(&self.points, at.stiffness.bending, &at.g, sum, tangent);
        }
    }
}

impl DiscreteGradientForce for RestTable {
    #[inline(always)]
    fn add_discrete_gradient<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, sum: &mut Gradient<T>) -> T {
        if !self.excess.is_empty() {
            at.table.add_mean(-(at.stiffness.axial * from.load(&self.excess)), &mut sum.n);
        }
        if !self.points.is_empty() {
            let ends = [&at.step.start, &at.step.end];
            self.natural(from).add_discrete_gradient(&self.points, at.stiffness.bending, ends, &mut sum.n);
        }
        at.rates[0].splat(0.0)
    }

    #[inline(always)]
    fn add_step_tangent<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, tangent: &mut Hessian<T>) {
        if !self.points.is_empty() {
            let mut unused = Gradient { n: at.rates, viscous: at.rates };
            let half = at.stiffness.bending * 0.5;
            self.natural(from).add_hessian(&self.points, half, &at.middle, &mut unused, tangent);
        }
    }

    #[inline(always)]
    fn add_strain_energy<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, energy: &mut T) {
        let g = &at.step.start;
        if !self.excess.is_empty() {
            *energy = *energy + axial_energy(at.stiffness.axial, from.load(&self.excess), form(&at.table.a, g));
        }
        if !self.points.is_empty() {
            *energy = *energy + at.stiffness.bending * self.natural(from).energy(&self.points, g);
        }
    }

    #[inline(always)]
    fn add_rest_strain<T: Real, L: Load<T>>(&self, _: T, from: &L, strain: &mut T) {
        if !self.excess.is_empty() {
            *strain = *strain + from.load(&self.excess);
        }
    }

    #[inline(always)]
    fn add_rest_energy<T: Real, L: Load<T>>(&self, square: T, from: &L, energy: &mut T) {
        if !self.excess.is_empty() {
            // ((square - 1 - x)^2 - (square - 1)^2)/8
            let excess = from.load(&self.excess);
            *energy = *energy + excess * (excess * 0.5 + 1.0 - square) * 0.25;
        }
    }
}

impl ElementForce for RestTable {
    fn energy(&self, element: usize, at: &GramState<'_, f64>) -> (f64, f64) {
        let bending = if self.points.is_empty() {
            0.0
        } else {
            at.stiffness.bending * self.of(element).energy(&self.points, &at.g)
        };
        (self.axial_energy(element, at), bending)
    }

    fn energy_by_length(&self, element: usize, at: &GramState<'_, f64>) -> (f64, f64) {
        (self.axial_energy(element, at), 0.0)
    }

    fn on_length(&self, element: usize, flexural: f64, d: [&Control<f64>; 2], lengths: [f64; 2]) -> f64 {
        let Some(curvature) = self.curvature_of(element) else { return 0.0 };
        NaturalCurvature::on_length(curvature, &self.points, flexural, d.map(gram), lengths)
    }

    fn set_length_over(&mut self, element: usize, mean: f64, inverse: f64) {
        let Some(curvature) = self.curvature_of(element) else { return };
        let natural = NaturalCurvature::over(curvature, mean, inverse);
        (self.natural[0][element], self.natural[1][element]) = (natural.target, natural.rounding);
    }

    fn strain(&self, element: usize, _: f64, _: &GramState<'_, f64>) -> f64 {
        self.excess.get(element).map_or(0.0, |x| -0.5 * x)
    }

    fn curvature(&self, at: &SampledPoint<'_>) -> Vector3<f64> {
        if self.points.is_empty() {
            return Vector3::zeros();
        }
        at.curvature * (self.of(at.element).moment_factor(at.curvature.norm(), at.length) - 1.0)
    }
}

/// Natural curvature of an element as half angles: `S_0 l/2` and `(k_r l/2)^2`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NaturalCurvature<T> {
    pub target: T,
    pub rounding: T,
}

impl NaturalCurvature<f64> {
    pub fn new(curvature: f64, length: f64) -> Self {
        let half = 0.5 * curvature * length;
        // an element without natural curvature among others that have one: no force, and no zero
        // under the root
        let rounding = (BLUNTING * half).powi(2).max(f64::MIN_POSITIVE);
        let target = if curvature == 0.0 { 0.0 } else { (half * half + rounding).sqrt() };
        NaturalCurvature { target, rounding }
    }

    /// That of an element whose length changes over a step, by its mean in m and the mean of its
    /// inverse: with the stiffness of that inverse the energy of `S_0 S` stays what it is at any
    /// length, and the rounding is half way between those at both ends.
    fn over(curvature: f64, mean: f64, inverse: f64) -> Self {
        let unit = NaturalCurvature::new(curvature, 1.0);
        NaturalCurvature {
            target: unit.target / inverse,
            rounding: unit.rounding * (2.0 * mean - 1.0 / inverse) * mean,
        }
    }

    /// Returns the force in N on the length of an element over a step, as the difference of its
    /// energy by that of its length, at control vectors that stay: of `EI l/2 (S_0^2 + k_r^2)`, and
    /// of `-EI l S_0 S` through k_r.
    fn on_length(curvature: f64, points: &[Point], flexural: f64, g: [Six<f64>; 2], lengths: [f64; 2]) -> f64 {
        let [first, last] = lengths;
        let NaturalCurvature { target, rounding: blunt } = NaturalCurvature::new(curvature, 1.0);
        let between = 0.5 * (first * first + last * last);
        let by_rounding = |point: &Point| {
            let root = |g: &Six<f64>, l: f64| {
                let w = point.squared(g).w;
                1.0 / ((w + blunt * l * l).sqrt() + (w + blunt * between).sqrt())
            };
            target * blunt * (first + last) * (root(&g[0], first) + root(&g[1], last))
        };
        2.0 * flexural
            * points.iter().map(|point| point.weight * (target * target + blunt - by_rounding(point))).sum::<f64>()
    }

    /// 1 - S_0/S: the factor of EI kappa that is the moment, for a curvature in 1/m on an element
    /// of this length.
    pub fn moment_factor(&self, curvature: f64, length: f64) -> f64 {
        let half = 0.5 * curvature * length;
        1.0 - self.target / (half * half + self.rounding).sqrt()
    }
}

impl<T: Real> NaturalCurvature<T> {
    /// Energy beyond that of the squared curvature, over 2 EI/l.
    #[inline(always)]
    pub fn energy(&self, points: &[Point], g: &Six<T>) -> T {
        let constant = self.target * self.target + self.rounding;
        let mut sum = constant.splat(0.0);
        for point in points {
            let root = (point.squared(g).w + self.rounding).sqrt();
            sum = sum + (constant - self.target * root * 2.0) * point.weight;
        }
        sum
    }

    /// Adds the gradient of the energy to the weighted gradient `n`.
    #[inline(always)]
    pub fn add_gradient(&self, points: &[Point], flexural: T, g: &Six<T>, n: &mut Six<T>) {
        for point in points {
            let at = point.squared(g);
            at.add_gradient(-(flexural * self.target * point.weight / (at.w + self.rounding).sqrt()), n);
        }
    }

    /// Adds a discrete gradient of the energy to `n`: `D sqrt(w + r) = Dw/(sum of both roots)`.
    #[inline(always)]
    pub fn add_discrete_gradient(&self, points: &[Point], flexural: T, g: [&Six<T>; 2], n: &mut Six<T>) {
        let (x, mean) = middle(g);
        for point in points {
            let (w, gradient) = point.secant(g, &x, &mean);
            let (first, last) = ((w[0] + self.rounding).sqrt(), (w[1] + self.rounding).sqrt());
            let scale = -(flexural * self.target * (2.0 * point.weight) / (first + last));
            for i in 0..6 {
                n[i] = n[i] + scale * gradient[i];
            }
        }
    }

    /// Adds the gradient of the energy, and its Hessian without what would be negative stiffness.
    #[inline(always)]
    pub fn add_hessian(
        &self,
        points: &[Point],
        flexural: T,
        g: &Six<T>,
        sum: &mut Gradient<T>,
        tangent: &mut Hessian<T>,
    ) {
        for point in points {
            let at = point.squared(g);
            let square = at.w + self.rounding;
            let first = -(flexural * self.target * point.weight / square.sqrt());
            at.add_gradient(first, &mut sum.n);
            // with the bending rule's own share not below zero: across the curvature, and along it
            let own = flexural * point.weight;
            let (across, along) = (first + own, first * self.rounding / square + own);
            let (across, along) = ((across + across.abs()) * 0.5 - own, (along + along.abs()) * 0.5 - own);
            at.add_gradient(across, &mut tangent.geometric);
            point.add_second(g, &at, across, &mut tangent.h);
            at.add_square((along - across) * 0.5 / (at.w + NOISE), &mut tangent.h);
        }
    }
}
