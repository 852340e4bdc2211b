//! Rest shape: stress-free stretch and curvature of a cable that was coiled, or built in under pre-strain.
//!
//! ```text
//! N = EA (eps - eps_0) f,  eps_0 = (f_0^2 - 1)/2        U_axial = EA l/8 (g.A.g - 2 f_0^2 a.g + f_0^4)
//! U_bending = EI l/2 sum_q w_q (S_q - S_0)^2,           S = sqrt(kappa^2 + k_r^2), S_0 = sqrt(kappa_0^2 + k_r^2), k_r = kappa_0/100
//! ```
//!
//! The square of kappa is the bending rule's; the rest is added here at the points of the rule (three for T1, T2): stress-free is every
//! shape of curvature kappa_0, to the last bit for Gauss rules. *Source.* The energy of an elastic rod without twist: with a free
//! section spin, 1/2 EI |kappa - kappa_0 n|^2 is least where the natural direction n lies along kappa, which leaves 1/2 EI (kappa - kappa_0)^2
//! (Langer & Singer 1996, SIAM Review 38:605, on the twist-free frame). *Validity.* The *direction* of the natural curvature is free:
//! a coil may unwind into any curve of the same curvature, out of plane without resistance, and one that passes through the straight
//! line may come out on the other side. So a cable that is *straighter* than kappa_0 has no resistance across its plane, and less than
//! none: it may wrinkle at the size of the mesh, and one pulled straight by force trembles so, which error control follows (`lariat stability
//! --case "hanging 1e4"`: 22 times the steps with effects). Draw its start shape finely, corners of a coarse polyline stay. Meant for cables that stay
//! near one plane or beyond kappa_0. k_r rounds the cusp there: between kappa_0/2 and 2 kappa_0 moments are off by less than 0.5 % of EI
//! kappa_0. The straight cable is an unstable equilibrium. f_0 within a few percent of 1: EA counts per length of the reference.
//!
//! *Tangent.* Exact beyond kappa_0; below, the compressive bending moment's geometric stiffness across the curvature is left out, which keeps the step
//! matrix definite and costs Newton iterations; all of it is in [`Cable::jacobians`](crate::Cable::jacobians). *Rejected.* A natural curvature with
//! a direction: it needs the twist that this element does not have. Points of zero k_r: the tangent is infinite at the straight cable.

use super::curvature::{NOISE, Point};
use super::{Cut, Effect, Target};
use crate::Real;
use crate::element::gram::{Six, Upper};
use crate::error::{Error, Requirement, require};
use crate::section::Element;
use serde::{Deserialize, Serialize};

/// k_r over kappa_0.
const ROUNDING: f64 = 0.01;

/// Stress-free stretch and curvature from an arc length on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RestPiece {
    /// Arc length of the unstretched cable where the piece begins, in m; the element whose middle lies in the piece has it.
    pub from: f64,
    /// Stretch without stress f_0, > 0; 1 = unstretched, above 1 = longer than its reference length.
    pub stretch: f64,
    /// Curvature without stress kappa_0 in 1/m, >= 0.
    pub curvature: f64,
}

/// The shape that a cable takes without stress.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RestShape {
    /// Pieces by ascending arc length; before the first, straight and unstretched.
    pub pieces: Vec<RestPiece>,
}

impl RestShape {
    /// A natural curvature (1/m) of the whole cable.
    pub fn curved(curvature: f64) -> Self {
        RestShape { pieces: vec![RestPiece { from: 0.0, stretch: 1.0, curvature }] }
    }

    /// A stress-free stretch of the whole cable: below 1 it is under tension at its reference length.
    pub fn stretched(stretch: f64) -> Self {
        RestShape { pieces: vec![RestPiece { from: 0.0, stretch, curvature: 0.0 }] }
    }

    /// Stretch and curvature (1/m) at an arc length.
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

/// The natural curvature of elements as the kernel needs it: half angles per element, `S_0 l/2` and `(k_r l/2)^2`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NaturalCurvature<T> {
    pub target: T,
    pub rounding: T,
}

impl NaturalCurvature<f64> {
    pub fn new(curvature: f64, length: f64) -> Self {
        let half = 0.5 * curvature * length;
        // an element without natural curvature among others that have one: no force, and no zero under the root
        let rounding = (ROUNDING * half).powi(2).max(f64::MIN_POSITIVE);
        let target = if curvature == 0.0 { 0.0 } else { (half * half + rounding).sqrt() };
        NaturalCurvature { target, rounding }
    }

    /// What is added to the squared curvature's energy, over 2 EI/l.
    pub fn energy(&self, points: &[Point], g: &Six<f64>) -> f64 {
        if self.target == 0.0 {
            return 0.0;
        }
        let constant = self.target * self.target + self.rounding;
        let root = |point: &Point| (point.squared(g).w + self.rounding).sqrt();
        points.iter().map(|point| point.weight * (constant - 2.0 * self.target * root(point))).sum()
    }

    /// 1 - S_0/S: the factor of EI kappa that is the moment, for a curvature in 1/m on an element of this length.
    pub fn moment_factor(&self, curvature: f64, length: f64) -> f64 {
        let half = 0.5 * curvature * length;
        1.0 - self.target / (half * half + self.rounding).sqrt()
    }
}

impl<T: Real> NaturalCurvature<T> {
    /// Adds the gradient of the energy to the weighted gradient `n`.
    #[inline(always)]
    pub fn add_gradient(&self, points: &[Point], flexural: T, g: &Six<T>, n: &mut Six<T>) {
        for point in points {
            let at = point.squared(g);
            at.add_gradient(-(flexural * self.target * point.weight / (at.w + self.rounding).sqrt()), n);
        }
    }

    /// Adds the gradient of the energy to `n`, and its Hessian to `geometric` and `h`: without what would be negative stiffness.
    #[inline(always)]
    pub fn add_hessian(
        &self,
        points: &[Point],
        flexural: T,
        g: &Six<T>,
        [n, geometric]: [&mut Six<T>; 2],
        h: &mut Upper<T>,
    ) {
        for point in points {
            let at = point.squared(g);
            let square = at.w + self.rounding;
            let first = -(flexural * self.target * point.weight / square.sqrt());
            at.add_gradient(first, n);
            // with the bending rule's own share not below zero: across the curvature, and along it
            let own = flexural * point.weight;
            let positive = |x: T| (x + x.abs()) * 0.5 - own;
            let (across, along) = (positive(first + own), positive(first * self.rounding / square + own));
            at.add_gradient(across, geometric);
            point.add_second(g, &at, across, h);
            at.add_square((along - across) * 0.5 / (at.w + NOISE), h);
        }
    }
}
