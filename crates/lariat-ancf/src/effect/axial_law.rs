//! Axial law: force against strain, other than the Green law of the paper.
//!
//! # Equation
//!
//! Without this effect the axial energy of an element is quadratic in its Gram numbers, `N = EA eps f`
//! with the Green strain eps = (f^2 - 1)/2. A law replaces the part of that energy that is linear in
//! the element, at its two Gauss points, by the energy W of a force T per EA against the strain
//! `e = f - 1`:
//!
//! ```text
//! U = EA l sum_q 1/2 [W(x_q) - (x_q - 1)^2/8] + U_Green        x_q = b_q.g = f^2, projected on linear functions
//! W = int T de        T = k e + sum_k [a_k p_k + c_k p_k^2]        p_k = max(0, e - e_k)
//! hooke   T = e          rope   T = max(0, e)          curve   a monotone quadratic spline through a table
//! ```
//!
//! What of the Green energy is left is the share of higher strains that the rule stiffens. Two points
//! integrate linear strain exactly, so the part that is replaced is the whole of what the rules
//! `projected` and `exact` have of it; `mean` has one strain, at one point. Over a step of the
//! discrete gradient the pairs are the exact secant `(W(x1) - W(x0))/(x1 - x0)`, hinge by hinge, and
//! the energy law closes with every law.
//!
//! The curve is Schumaker's spline: quadratic between the rows, with a knot amid them, C1, monotone
//! where the table is, with the slopes of Fritsch and Butland at the rows. Beyond the last row it goes
//! on straight; before the first, where its force is zero, it is zero.
//!
//! # Validity
//!
//! Damping is another effect, and acts in a slack element, too: with it a rope pushes by the rate of
//! its strain. Stretch above 1/4; below, f is continued linearly in f^2, so that energy and force stay finite.
//! EA of the section is the steepest slope of a curve or more: steps, tolerances and numerical
//! dissipation go by it. With `rope` and `curve` a slack element has no axial stiffness but that
//! share (1e-3 EA of strains that are not linear in the element).
//!
//! # References
//!
//! Schumaker, SIAM J. Numer. Anal. 20 (1983) 853; Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5
//! (1984) 300; Gonzalez, J. Nonlinear Sci. 6 (1996) 449.
//!
//! # Alternatives considered
//!
//! - Hooke as the default: engineering strain differs from Green's law by 3/2 of the strain (0.15 % of
//!   the tension at 0.1 %), costs a fifth more per element, and changes every result that is compared
//!   with the paper. It is asked for by name.
//! - Cubic pieces (PCHIP): their secant over pieces needs a branch in each lane.
//! - The law at the points of the rule: with raw strain a bent element locks.

use super::acts::{Acts, ElementForce, Nothing, SampledPoint};
use super::{Cut, Effect, Target};
use crate::Real;
use crate::element::axial::moment;
use crate::element::gram::{PAIR_WEIGHT, Six, form, upper};
use crate::element::kernel::{DiscreteGradientForce, Gradient, GramForce, GramState, GramStep, Hessian, Load};
use crate::error::{Error, Requirement, require};
use crate::rule::AxialRule;
use crate::scales::effect::{CRUMPLED, TINY};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Axial force against engineering strain. Default of a cable: none of these, but the Green law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AxialLaw {
    /// EA times the strain, in tension and in compression.
    Hooke,
    /// EA times the strain in tension, nothing in compression: a rope that cannot push, but by axial
    /// damping, if it has any.
    Rope,
    /// A measured curve: rows of strain and force in N, both ascending, from the strain at which the
    /// force begins with 0 N. It cannot push.
    Curve(Vec<[f64; 2]>),
}

impl AxialLaw {
    /// Returns whether a slack cable has no force.
    pub fn cannot_push(&self) -> bool {
        !matches!(self, AxialLaw::Hooke)
    }

    /// Returns the law per EA (N).
    fn spline(&self, stiffness: f64) -> Spline {
        match self {
            AxialLaw::Hooke => Spline { slope: 1.0, hinges: Vec::new() },
            AxialLaw::Rope => Spline { slope: 0.0, hinges: vec![Hinge { at: 0.0, linear: 1.0, square: 0.0 }] },
            AxialLaw::Curve(rows) => Spline { slope: 0.0, hinges: hinges(rows, stiffness) },
        }
    }

    /// Returns the steepest slope of a curve in N, and the strain in the middle of which it is.
    fn steepest(rows: &[[f64; 2]]) -> f64 {
        let spline = Spline { slope: 0.0, hinges: hinges(rows, 1.0) };
        let knots = spline.hinges.iter().map(|hinge| hinge.at);
        knots.map(|e| spline.slope_at(e)).fold(0.0, f64::max)
    }
}

impl Effect for AxialLaw {
    const DISSIPATIVE: bool = false;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        if let AxialRule::Gauss(points) = cable.rule.axial
            && points < 5
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
        let steepest = Self::steepest(rows);
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
        Some(LawTable { spline: self.spline(stiffness), points })
    }
}

/// A part of a law that begins at a strain: `linear p + square p^2`, p = max(0, e - at).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Hinge {
    at: f64,
    linear: f64,
    square: f64,
}

/// Force per EA against strain.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spline {
    slope: f64,
    hinges: Vec<Hinge>,
}

/// Returns the spline through rows of strain and force, per `unit` N.
fn hinges(rows: &[[f64; 2]], unit: f64) -> Vec<Hinge> {
    let chord = |i: usize| (rows[i + 1][1] - rows[i][1]) / (rows[i + 1][0] - rows[i][0]) / unit;
    let last = rows.len() - 2;
    let slope = |i: usize| match i {
        0 => chord(0),
        i if i > last => chord(last),
        // the harmonic mean keeps the spline monotone
        i => 2.0 / (1.0 / chord(i - 1) + 1.0 / chord(i)),
    };
    let mut hinges = vec![Hinge { at: rows[0][0], linear: slope(0), square: 0.0 }];
    let mut bend = 0.0;
    let mut turn = |at: f64, new: f64| {
        if new != bend {
            hinges.push(Hinge { at, linear: 0.0, square: 0.5 * (new - bend) });
        }
        bend = new;
    };
    for i in 0..=last {
        let (from, half) = (rows[i][0], 0.5 * (rows[i + 1][0] - rows[i][0]));
        let middle = 2.0 * chord(i) - 0.5 * (slope(i) + slope(i + 1));
        turn(from, (middle - slope(i)) / half);
        turn(from + half, (slope(i + 1) - middle) / half);
    }
    turn(rows[last + 1][0], 0.0);
    hinges
}

/// Secant of the energy by the squared stretch over a step, and its derivative by the end of it.
struct Secant<T> {
    value: T,
    slope: T,
}

impl Spline {
    /// Returns dT/de at a strain, from above.
    fn slope_at(&self, strain: f64) -> f64 {
        let of = |h: &Hinge| if strain < h.at { 0.0 } else { h.linear + 2.0 * h.square * (strain - h.at) };
        self.slope + self.hinges.iter().map(of).sum::<f64>()
    }

    /// Returns the force per EA at a strain.
    fn force(&self, strain: f64) -> f64 {
        let of = |h: &Hinge| {
            let p = (strain - h.at).max(0.0);
            p * (h.linear + h.square * p)
        };
        self.slope * strain + self.hinges.iter().map(of).sum::<f64>()
    }

    /// Returns the energy per EA and length at a squared stretch.
    fn energy(&self, x: f64) -> f64 {
        let e = stretch(x)[0] - 1.0;
        let of = |h: &Hinge| {
            let p = (e - h.at).max(0.0);
            p * p * (0.5 * h.linear + h.square * p * (1.0 / 3.0))
        };
        0.5 * self.slope * e * e + self.hinges.iter().map(of).sum::<f64>()
    }

    /// Returns the secant of the energy over a step of the squared stretch from `x0` to `x1`; where both
    /// are the same, its derivative, whose own is twice that of the secant.
    #[inline(always)]
    fn secant<T: Real>(&self, x0: T, x1: T) -> Secant<T> {
        let ([f0, s0, r0], [f1, s1, r1]) = (stretch(x0), stretch(x1));
        // df/dx over the step: by the root above, constant below
        let dx = x1 - x0;
        let above = dx.splat(1.0) / (s0 + s1);
        let below = ratio(r1 - r0, dx);
        let by_x = above + below * (above.splat(0.5 / CRUMPLED.sqrt()) - above);
        let (e0, e1, de) = (f0 - 1.0, f1 - 1.0, f1 - f0);
        let mut mean = (e0 + e1) * (0.5 * self.slope);
        let mut slope = mean.splat(0.5 * self.slope);
        for hinge in &self.hinges {
            let (p0, p1) = ((e0 - hinge.at).at_least(0.0), (e1 - hinge.at).at_least(0.0));
            // the share of the step on which the hinge is open; exactly 1 where it is open at both ends
            let closed = ((e1 - hinge.at) - p1) - ((e0 - hinge.at) - p0);
            let open = dx.splat(1.0) - ratio(closed, de);
            let (sum, square) = (p0 + p1, p1 * p1 + p1 * p0 + p0 * p0);
            mean = mean + open * (sum * (0.5 * hinge.linear) + square * (hinge.square / 3.0));
            let (opens, any) = (is_positive(p1), is_positive(sum));
            let of_linear = opens * (open - open * open) + open * open * 0.5;
            slope = slope + any * of_linear * hinge.linear + open * (p1 * 2.0 + p0) * (hinge.square / 3.0);
        }
        // d e1/d x1, and the derivative of by_x
        let e_by_x = dx.splat(0.5) / s1;
        let curved = dx.splat(1.0) - is_positive(-r1);
        let by_x_slope = -(above * above * e_by_x) * curved;
        Secant { value: mean * by_x, slope: slope * e_by_x * by_x + mean * by_x_slope }
    }
}

/// Returns the stretch of its square, the root of the square or of its least, and by how much the square
/// is below that.
#[inline(always)]
fn stretch<T: Real>(x: T) -> [T; 3] {
    let square = x.at_least(CRUMPLED);
    let (root, below) = (square.sqrt(), x - square);
    [root + below * (0.5 / CRUMPLED.sqrt()), root, below]
}

/// Returns a share of a change; 0 of no change.
#[inline(always)]
fn ratio<T: Real>(part: T, change: T) -> T {
    part * change / (change * change + TINY)
}

/// Returns 1 of a positive number and 0 of zero.
#[inline(always)]
fn is_positive<T: Real>(x: T) -> T {
    x / (x + TINY)
}

/// A law as the kernel needs it.
#[derive(Clone, Debug)]
pub(crate) struct LawTable {
    spline: Spline,
    /// The squared stretch at its points, by the Gram numbers.
    points: Vec<Six<f64>>,
}

impl LawTable {
    /// Visits the points with their weight over EA l/4 and the secant of the energy beyond that of the
    /// Green law, `(x - 1)^2/8`, over a step between Gram numbers.
    #[inline(always)]
    fn visit<T: Real>(&self, [g0, g1]: [&Six<T>; 2], mut each: impl FnMut(&Six<f64>, f64, Secant<T>, T)) {
        let weight = 4.0 / self.points.len() as f64;
        for point in &self.points {
            let (x0, x1) = (form(point, g0), form(point, g1));
            let green = (x0 + x1 - 2.0) * 0.125;
            let law = self.spline.secant(x0, x1);
            let value = law.value - green;
            each(point, weight, Secant { value, slope: law.slope - 0.125 }, law.value);
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
            |point, weight, secant, _| add_pairs(point, at.stiffness.axial * weight * secant.value, &mut sum.n),
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
            |point, weight, secant, _| {
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
            |point, weight, secant, _| add_pairs(point, at.stiffness.axial * weight * secant.value, &mut sum.n),
        );
        at.rates[0].splat(0.0)
    }

    #[inline(always)]
    fn add_step_tangent<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, _: &L, tangent: &mut Hessian<T>) {
        self.visit(
            [&at.step.start, &at.step.end],
            #[inline(always)]
            |point, weight, secant, _| {
                add_square(point, at.stiffness.axial * weight * secant.slope, &mut tangent.h);
            },
        );
    }

    #[inline(always)]
    fn add_rest_strain<T: Real, L: Load<T>>(&self, square: T, _: &L, strain: &mut T) {
        // the stress of the law is 4 dW/dx, that of the Green law x - 1
        let law = self.spline.secant(square, square).value * 4.0;
        *strain = *strain + (square - 1.0 - law);
    }
}

impl ElementForce for LawTable {
    fn energy(&self, _: usize, at: &GramState<'_, f64>) -> (f64, f64) {
        let weight = 4.0 / self.points.len() as f64;
        let of = |point: &Six<f64>| {
            let x = form(point, &at.g);
            self.spline.energy(x) - 0.125 * (x - 1.0) * (x - 1.0)
        };
        (at.stiffness.axial * weight * self.points.iter().map(of).sum::<f64>(), 0.0)
    }

    fn strain(&self, _: usize, xi: f64, at: &GramState<'_, f64>) -> f64 {
        let green = crate::element::axial::projected::strain(&at.g, xi);
        let square = 1.0 + 2.0 * green;
        self.spline.force(stretch(square)[0] - 1.0) / square.max(CRUMPLED).sqrt() - green
    }

    fn curvature(&self, _: &SampledPoint<'_>) -> Vector3<f64> {
        Vector3::zeros()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> Vec<Spline> {
        let rows = vec![[0.0, 0.0], [0.02, 1.0], [0.05, 8.0], [0.2, 20.0], [0.3, 21.0]];
        let unit = AxialLaw::steepest(&rows);
        [AxialLaw::Hooke, AxialLaw::Rope, AxialLaw::Curve(rows)].map(|law| law.spline(unit)).to_vec()
    }

    /// The curve goes through its rows, does not fall, and is C1; beyond the last row it is straight.
    #[test]
    fn a_curve_is_monotone_and_goes_through_its_rows() {
        let rows = [[0.0, 0.0], [0.02, 1.0], [0.05, 8.0], [0.2, 20.0], [0.3, 21.0]];
        let spline = AxialLaw::Curve(rows.to_vec()).spline(1.0);
        for [strain, force] in rows {
            assert!((spline.force(strain) - force).abs() < 1e-12 * 21.0, "{strain}");
        }
        let at = |i: i32| f64::from(i) * 1e-4;
        for i in 0..4000 {
            assert!(spline.force(at(i + 1)) > spline.force(at(i)));
            let jump = (spline.slope_at(at(i + 1)) - spline.slope_at(at(i))).abs();
            assert!(jump < 2.0, "{jump} at {}", at(i));
        }
        assert_eq!(spline.force(-0.3), 0.0);
        assert!((spline.force(0.5) - 23.0).abs() < 1e-9);
    }

    /// The secant times the step is the change of the energy, whatever the step; its slope is the derivative by differences.
    #[test]
    fn the_secant_is_exact_and_its_slope_that_of_differences() {
        let xs = [0.001, 0.05, 0.0625, 0.3, 0.9, 0.999, 1.0, 1.001, 1.04, 1.05, 1.1, 1.4, 1.9];
        for law in laws() {
            for (x0, x1) in xs.iter().flat_map(|a| xs.iter().map(move |b| (*a, *b))) {
                let change = law.energy(x1) - law.energy(x0);
                let secant = law.secant(x0, x1);
                assert!((secant.value * (x1 - x0) - change).abs() < 1e-15, "{x0} {x1} {change:e}");
                let d = 1e-6;
                if x0 != x1 && [0.0625, 1.0, 1.0404, 1.1025, 1.44, 1.69].iter().all(|k| (x1 - k).abs() > 2.0 * d) {
                    let slope = (law.secant(x0, x1 + d).value - law.secant(x0, x1 - d).value) / (2.0 * d);
                    // over the knots of a curve and into a crumpled element an approximation
                    let crumpled = x0.min(x1) < CRUMPLED;
                    let room = if law.hinges.len() > 1 || crumpled { 2.0 * slope.abs() + 0.5 } else { 1e-7 };
                    assert!((secant.slope - slope).abs() < room, "{x0} {x1}: {} {slope}", secant.slope);
                }
            }
            for x in [0.03, 0.3, 0.9, 1.001, 1.2] {
                let d = 1e-6;
                let at = law.secant(x, x);
                let [value, slope] = [
                    (law.energy(x + d) - law.energy(x - d)) / (2.0 * d),
                    (law.secant(x + d, x + d).value - law.secant(x - d, x - d).value) / (2.0 * d),
                ];
                assert!((at.value - value).abs() < 1e-8 && (2.0 * at.slope - slope).abs() < 1e-7, "{x}");
            }
        }
    }
}
