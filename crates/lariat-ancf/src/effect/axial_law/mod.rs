//! Axial law: force against strain, other than the Green law of the paper.
//!
//! # Equation
//!
//! Without this effect the axial energy of an element is quadratic in its Gram numbers, `N = EA eps
//! f` with the Green strain eps = (f^2 - 1)/2. A law replaces the part of that energy that is
//! linear in the element, at its two Gauss points, by the energy W of a force T per EA against the
//! strain `e = f - 1`:
//!
//! ```text
//! U = EA l sum_q 1/2 [W(x_q) - (x_q - 1)^2/8] + U_Green        x_q = b_q.g = f^2, projected on linear functions
//! W = int T de        T = k e + sum_k [a_k p_k + c_k p_k^2]        p_k = max(0, e - e_k)
//! hooke   T = e          rope   T = max(0, e)          curve   a monotone quadratic spline through a table
//! ```
//!
//! What of the Green energy is left is the share of higher strains that the rule stiffens. Two
//! points integrate linear strain exactly, so the part that is replaced is the whole of what the
//! rules `projected` and `exact` have of it; `mean` has one strain, at one point. Over a step of
//! the discrete gradient the pairs are the exact secant `(W(x1) - W(x0))/(x1 - x0)`, hinge by
//! hinge, and the energy law closes with every law.
//!
//! The curve is the spline of `spline.rs`.
//!
//! # Validity
//!
//! [Damping](crate::Damping) of a law that cannot push is that of `taut.rs`: it does not push
//! either. Stretch above 1/4; below, f is continued linearly in f^2, so that energy and
//! force stay finite. EA of the section is the steepest slope of a curve or more: steps, tolerances
//! and numerical dissipation go by it. With `rope` and `curve` a slack element has no axial
//! stiffness but that share (1e-3 EA of strains that are not linear in the element).
//!
//! # References
//!
//! Gonzalez, J. Nonlinear Sci. 6 (1996) 449.
//!
//! # Alternatives considered
//!
//! - Hooke as the default: engineering strain differs from Green's law by 3/2 of the strain (0.15 %
//!   of the tension at 0.1 %), costs more per element, and changes every result that is compared
//!   with the paper. It is asked for by name.
//! - Hooke for ropes whose section is [named by material](crate::CableBuilder::rope), whose EA is
//!   force over elongation: it pushes. A crate of 500 kg that lands on 19 m of straight steel rope
//!   was pushed with 8 kN: in steps of 1/240 s the rope takes longer to buckle than to be let down.
//! - The law at the points of the rule: with raw strain a bent element locks.

mod spline;
mod taut;

use super::acts::{Acts, ElementForce, Nothing, SampledPoint};
use super::torsion::stranded::Strands;
use super::work::POINTS;
use super::{Cut, Effect, Effects, RestShape, Target};
use crate::Real;
use crate::element::axial::moment;
use crate::element::gram::{PAIR_WEIGHT, Six, form, upper};
use crate::element::kernel::{DiscreteGradientForce, Gradient, GramForce, GramState, GramStep, Hessian, Load};
use crate::error::{Error, Requirement, require};
use crate::rule::{AxialRule, Rule};
use crate::scales::effect::{CRUMPLED, LEAST_POINTS};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use spline::{Secant, Spline, stretch};
pub(crate) use taut::Taut;

/// Axial force against engineering strain. Default of a cable: none of these, but the Green law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AxialLaw {
    /// The Green law, which a cable has without this effect: for where it is meant, and its
    /// difference to Hooke's is not to be warned of.
    Green,
    /// EA times the strain, in tension and in compression.
    Hooke,
    /// EA times the strain in tension, nothing in compression: a rope that cannot push, with axial
    /// damping neither.
    Rope,
    /// A measured curve: rows of strain and force in N, both ascending, from the strain at which
    /// the force begins with 0 N. It cannot push.
    Curve(Vec<[f64; 2]>),
}

impl AxialLaw {
    /// Returns the law of a rope or chain whose EA is force over elongation, and which folds where
    /// it would be pushed: [`AxialLaw::Rope`]; `None` beside effects and rules that no law goes
    /// with.
    pub fn of_rope(effects: &Effects, rule: Rule) -> Option<Self> {
        let stretched = effects.rest_shape.as_ref().is_some_and(RestShape::is_stretched);
        let stranded = effects.torsion.as_ref().and_then(Strands::of).is_some();
        let coarse = matches!(rule.axial, AxialRule::Gauss(points) if points < LEAST_POINTS);
        (!stretched && !stranded && !coarse).then_some(AxialLaw::Rope)
    }

    /// Returns whether it is another one than that of the elements.
    pub(crate) fn is_other(&self) -> bool {
        *self != AxialLaw::Green
    }

    /// Returns the law per EA (N), if it is another one than that of the elements.
    fn spline(&self, stiffness: f64) -> Option<Spline> {
        match self {
            AxialLaw::Green => None,
            AxialLaw::Hooke => Some(Spline::hooke()),
            AxialLaw::Rope => Some(Spline::rope()),
            AxialLaw::Curve(rows) => Some(Spline::curve(rows, stiffness)),
        }
    }
}

impl Effect for AxialLaw {
    const DISSIPATIVE: bool = false;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        if let AxialRule::Gauss(points) = cable.rule.axial
            && points < LEAST_POINTS
            && self.is_other()
        {
            return Err(cable.missing("an axial law", Requirement::WholeAxialRule));
        }
        let AxialLaw::Curve(rows) = self else { return Ok(()) };
        require("rows of a curve", rows.len() as f64, rows.len() >= 2, ">= 2")?;
        require("first force of a curve (N)", rows[0][1], rows[0][1] == 0.0, "0: where the force begins")?;
        require("first strain of a curve", rows[0][0], rows[0][0] > -0.75, "> -0.75")?;
        for pair in rows.windows(2) {
            require("strain of a curve", pair[1][0], pair[1][0] > pair[0][0], "ascending")?;
            require("force of a curve (N)", pair[1][1], pair[1][1] > pair[0][1], "ascending")?;
        }
        let steepest = Spline::curve(rows, 1.0).steepest();
        for element in cable.elements {
            let stiffness = element.section.axial_stiffness;
            require(
                "axial stiffness EA of a cable with a curve (N)",
                stiffness,
                stiffness >= steepest * (1.0 - 1e-9),
                "at least the steepest slope of the curve, by which steps are chosen",
            )?;
            let first = cable.elements[0].section.axial_stiffness;
            require("EA of a cable with a curve (N)", stiffness, stiffness == first, "the same everywhere")?;
        }
        Ok(())
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn has_exact_tangent(&self) -> bool {
        true
    }

    fn needs_implicit_integrator(&self) -> bool {
        false
    }

    fn is_steady(&self, _from: f64, _to: f64) -> bool {
        true
    }

    fn cut(&self, _: Cut<'_>) -> [Option<Self>; 2] {
        [Some(self.clone()), Some(self.clone())]
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

impl Acts for AxialLaw {
    type InElement = LawTable;
    type AtPoints = Nothing;

    fn in_element(&self, cable: &Target<'_>) -> Option<LawTable> {
        let stiffness = cable.elements.first()?.section.axial_stiffness;
        let mean = moment(|_| 1.0);
        let linear = moment(|xi| xi - 0.5);
        // at the points of Gauss, 1/(2 sqrt 3) beside the middle
        let beside = |side: f64| core::array::from_fn(|i| mean[i] + side * 12.0f64.sqrt() * linear[i]);
        let points = match cable.rule.axial {
            AxialRule::Mean => vec![mean],
            _ => vec![beside(-1.0), beside(1.0)],
        };
        let spline = self.spline(stiffness)?;
        let pushing = spline.slack().map(|_| Box::new(spline.pushing()));
        Some(LawTable { spline, points, pushing, pushes: false })
    }
}

/// A law as the kernel needs it.
#[derive(Clone, Debug)]
pub(crate) struct LawTable {
    spline: Spline,
    /// The squared stretch at its points, by the Gram numbers.
    points: Vec<Six<f64>>,
    /// Of a law that cannot push: itself with Hooke's law below zero strain, or the other way round
    /// while it [pushes](Self::push).
    pushing: Option<Box<Spline>>,
    pushes: bool,
}

impl LawTable {
    /// Lets a law that cannot push do so for a while, or not any more; returns whether it is one.
    pub fn push(&mut self, pushes: bool) -> bool {
        let Some(other) = &mut self.pushing else { return false };
        if self.pushes != pushes {
            core::mem::swap(&mut self.spline, &mut **other);
            self.pushes = pushes;
        }
        true
    }

    /// Returns by how much the energy of an element of `axial` = EA l/4 is more than that of the
    /// Green law, `(x - 1)^2/8`.
    #[inline(always)]
    fn excess<T: Real>(&self, g: &Six<T>, axial: T) -> T {
        let mut sum = axial.splat(0.0);
        for point in &self.points {
            let x = form(point, g);
            sum = sum + self.spline.energy(x) - (x - 1.0) * (x - 1.0) * 0.125;
        }
        axial * sum * (4.0 / self.points.len() as f64)
    }

    /// Visits the points with their weight over EA l/4 and the secant of the energy beyond that of
    /// the Green law, `(x - 1)^2/8`, over a step between Gram numbers.
    #[inline(always)]
    fn visit<T: Real>(&self, [g0, g1]: [&Six<T>; 2], mut each: impl FnMut(&Six<f64>, f64, Secant<T>)) {
        let weight = 4.0 / self.points.len() as f64;
        for point in &self.points {
            let (x0, x1) = (form(point, g0), form(point, g1));
            let green = (x0 + x1 - 2.0) * 0.125;
            let law = self.spline.secant(x0, x1);
            each(point, weight, Secant { value: law.value - green, slope: law.slope - 0.125 });
        }
    }
}

#[inline(always)]
fn add_pairs<T: Real>(point: &Six<f64>, scale: T, n: &mut Six<T>) {
    for i in 0..6 {
        n[i] = n[i] + scale * (PAIR_WEIGHT[i] * point[i]);
    }
}

#[inline(always)]
fn add_square<T: Real>(point: &Six<f64>, scale: T, h: &mut [T; 21]) {
    for i in 0..6 {
        for j in i..6 {
            let weight = PAIR_WEIGHT[i] * PAIR_WEIGHT[j] * point[i] * point[j];
            h[upper(i, j)] = h[upper(i, j)] + scale * weight;
        }
    }
}

impl GramForce for LawTable {
    #[inline(always)]
    fn needs_rates(&self) -> bool {
        false
    }

    #[inline(always)]
    fn add_gradient<T: Real, L: Load<T>>(&self, at: &GramState<'_, T>, _: &L, sum: &mut Gradient<T>) {
        self.visit(
            [&at.g, &at.g],
            #[inline(always)]
            |point, weight, secant| add_pairs(point, at.stiffness.axial * weight * secant.value, &mut sum.n),
        );
    }

    #[inline(always)]
    fn add_hessian<T: Real, L: Load<T>>(
        &self,
        at: &GramState<'_, T>,
        _: f64,
        _: &L,
        sum: &mut Gradient<T>,
        tangent: &mut Hessian<T>,
    ) {
        self.visit(
            [&at.g, &at.g],
            #[inline(always)]
            |point, weight, secant| {
                let unit = at.stiffness.axial * weight;
                add_pairs(point, unit * secant.value, &mut sum.n);
                add_pairs(point, unit * secant.value, &mut tangent.geometric);
                add_square(point, unit * secant.slope * 2.0, &mut tangent.h);
            },
        );
    }
}

impl DiscreteGradientForce for LawTable {
    #[inline(always)]
    fn add_discrete_gradient<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, _: &L, sum: &mut Gradient<T>) -> T {
        self.visit(
            [&at.step.start, &at.step.end],
            #[inline(always)]
            |point, weight, secant| add_pairs(point, at.stiffness.axial * weight * secant.value, &mut sum.n),
        );
        at.rates[0].splat(0.0)
    }

    #[inline(always)]
    fn add_step_tangent<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, _: &L, tangent: &mut Hessian<T>) {
        self.visit(
            [&at.step.start, &at.step.end],
            #[inline(always)]
            |point, weight, secant| {
                add_square(point, at.stiffness.axial * weight * secant.slope, &mut tangent.h);
            },
        );
    }

    #[inline(always)]
    fn add_strain_energy<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, _: &L, energy: &mut T) {
        *energy = *energy + self.excess(&at.step.start, at.stiffness.axial);
    }

    #[inline(always)]
    fn add_rest_strain<T: Real, L: Load<T>>(&self, square: T, _: &L, strain: &mut T) {
        // the stress of the law is 4 dW/dx, that of the Green law x - 1
        let law = self.spline.secant(square, square).value * 4.0;
        *strain = *strain + (square - 1.0 - law);
    }

    #[inline(always)]
    fn add_rest_energy<T: Real, L: Load<T>>(&self, square: T, _: &L, energy: &mut T) {
        *energy = *energy + (self.spline.energy(square) - (square - 1.0) * (square - 1.0) * 0.125);
    }
}

impl ElementForce for LawTable {
    fn energy(&self, _: usize, at: &GramState<'_, f64>) -> (f64, f64) {
        (self.excess(&at.g, at.stiffness.axial), 0.0)
    }

    fn strain(&self, _: usize, xi: f64, at: &GramState<'_, f64>) -> f64 {
        let stress = |point: &Six<f64>| {
            let square = form(point, &at.g);
            self.spline.force(stretch(square)[0] - 1.0) / square.max(CRUMPLED).sqrt()
        };
        // the stress that does work is that at the points: between a slack and a taut one strains
        // say little
        let stress = match &self.points[..] {
            [first, second] => {
                let [from, to] = [stress(first), stress(second)];
                from + (to - from) * (xi - POINTS[0]) / (POINTS[1] - POINTS[0])
            }
            points => points.iter().map(stress).sum::<f64>() / points.len() as f64,
        };
        stress - at.table.strain(&at.g, xi)
    }

    fn curvature(&self, _: &SampledPoint<'_>) -> Vector3<f64> {
        Vector3::zeros()
    }
}
