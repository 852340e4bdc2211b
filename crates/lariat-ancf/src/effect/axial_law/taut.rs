//! Axial damping of a law that cannot push: it acts where the rope is taut, and pushes neither.
//!
//! # Equation
//!
//! At the points of the law, with its secant S = dW/dx >= 0 over a step of the squared stretch x,
//! the share rho of the step on which x is above that of the slack rope, x_s, and the damping time:
//!
//! ```text
//! S + V = max(0, S + tau rho x'/4)        rho = [max(x1, x_s) - max(x0, x_s)]/(x1 - x0)        loss V x' >= 0
//! ```
//!
//! V has the sign of x', or is 0, in every rounding: so the loss is never negative. The derivative
//! of rho x' by x1 is 1/h above x_s and 0 below. What of the strain is not linear in the element is
//! damped as without a law, by the matrix of the rule less that of the points.
//!
//! # Validity
//!
//! A rope that is stretched from slack is damped from where it becomes taut. One that shortens fast
//! carries nothing: its dissipation ends where it would push.
//!
//! # References
//!
//! The dissipation is that of [`damping`](crate::effect::damping); a contact that cannot pull is
//! damped likewise: Hunt & Crossley, J. Appl. Mech. 42 (1975) 440.
//!
//! # Alternatives considered
//!
//! Kelvin's law at any strain: a slack rope of 100 kN and 10 ms pushed with 16 kN at 3 m/s.

use super::{LawTable, add_pairs, add_square};
use crate::Real;
use crate::element::axial::{AxialTable, add_outer, exact, gauss, mean, projected};
use crate::element::gram::{Six, Upper, contract, form, quadratic_form};
use crate::element::kernel::{Gradient, GramState, GramStep, Hessian};
use crate::rule::AxialRule;

/// Damping of a law that cannot push, as the kernel needs it.
#[derive(Clone, Debug)]
pub(crate) struct Taut {
    law: LawTable,
    /// Squared stretch of the slack rope.
    slack: f64,
    /// The rule less what is linear in the element.
    beyond: AxialTable,
}

/// Viscous part of the secant at a point, and its derivative by the end of the step, both of a
/// damping time; where it is limited, of the elastic part.
struct Viscous<T> {
    value: T,
    slope: T,
}

impl Taut {
    /// Returns the damping of a law, if it cannot push.
    pub fn of(law: &LawTable, rule: AxialRule) -> Option<Self> {
        let slack = law.spline.slack()? + 1.0;
        let whole = match rule {
            AxialRule::Exact => exact::table(),
            AxialRule::Gauss(points) => gauss::table(usize::from(points)),
            AxialRule::Mean => mean::table(),
            AxialRule::Projected => projected::table(),
        };
        let mut matrix: Upper<f64> = whole.matrix;
        for point in &law.points {
            add_outer(&mut matrix, -1.0 / law.points.len() as f64, point);
        }
        Some(Taut { law: law.clone(), slack: slack * slack, beyond: AxialTable::new([0.0; 6], matrix) })
    }

    /// Returns the viscous part at a point beside the elastic secant `elastic`, whose slope is
    /// `stiffness`: of the rate of the squared stretch, and the share of the step on which the rope
    /// is taut, at the end of it `open`.
    #[inline(always)]
    fn limited<T: Real>(
        [elastic, stiffness]: [T; 2],
        rate: T,
        [time, by_rate]: [f64; 2],
        [share, open]: [T; 2],
    ) -> Viscous<T> {
        let elastic = elastic.at_least(0.0);
        let total = (elastic + share * rate * (0.25 * time)).at_least(0.0);
        let carries = super::spline::is_positive(total);
        let slope = carries * open * (0.25 * time * by_rate) - (total.splat(1.0) - carries) * stiffness;
        Viscous { value: total - elastic, slope }
    }

    /// Visits the points with the factor on their pairs, the rate of their squared stretch and the
    /// viscous part, at an instant.
    #[inline(always)]
    fn at_instant<T: Real>(
        &self,
        (at, rates): (&GramState<'_, T>, &Six<T>),
        times: [f64; 2],
        mut each: impl FnMut(&Six<f64>, T, T, Viscous<T>),
    ) {
        let unit = at.stiffness.axial * (4.0 / self.law.points.len() as f64);
        for point in &self.law.points {
            let (x, rate) = (form(point, &at.g), form(point, rates));
            let law = self.law.spline.secant(x, x);
            let open = super::spline::is_positive((x - self.slack).at_least(0.0));
            each(point, unit, rate, Self::limited([law.value, law.slope * 2.0], rate, times, [open, open]));
        }
    }

    /// As [`at_instant`](Self::at_instant), over a step.
    #[inline(always)]
    fn over_step<T: Real>(&self, at: &GramStep<'_, T>, time: f64, mut each: impl FnMut(&Six<f64>, T, T, Viscous<T>)) {
        let unit = at.stiffness.axial * (4.0 / self.law.points.len() as f64);
        for point in &self.law.points {
            let (x0, x1) = (form(point, &at.step.start), form(point, &at.step.end));
            let law = self.law.spline.secant(x0, x1);
            let rate = form(point, &at.rates);
            let [below0, below1] = [x0 - self.slack, x1 - self.slack];
            let [p0, p1] = [below0.at_least(0.0), below1.at_least(0.0)];
            let closed = super::spline::ratio((below1 - p1) - (below0 - p0), x1 - x0);
            // of no change both are what the end is
            let (open, any) = (super::spline::is_positive(p1), super::spline::is_positive(p0 + p1));
            let share = (x0.splat(1.0) - closed).at_least(0.0) * any;
            each(point, unit, rate, Self::limited([law.value, law.slope], rate, [time, at.rate], [share, open]));
        }
    }

    #[inline(always)]
    pub fn add_gradient<T: Real>(&self, at: &GramState<'_, T>, rates: &Six<T>, time: f64, sum: &mut Gradient<T>) {
        self.beyond.add_product(rates, at.stiffness.axial * time, &mut sum.n);
        self.at_instant(
            (at, rates),
            [time, 0.0],
            #[inline(always)]
            |point, unit, _, viscous| add_pairs(point, unit * viscous.value, &mut sum.n),
        );
    }

    #[inline(always)]
    pub fn add_hessian<T: Real>(
        &self,
        (at, rates): (&GramState<'_, T>, &Six<T>),
        [time, rate]: [f64; 2],
        sum: &mut Gradient<T>,
        tangent: &mut Hessian<T>,
    ) {
        let axial = at.stiffness.axial * time;
        self.beyond.add_product(rates, axial, &mut sum.n);
        self.beyond.add_product(rates, axial, &mut tangent.geometric);
        self.beyond.add_hessian(axial * rate, &mut tangent.h);
        self.at_instant(
            (at, rates),
            [time, rate],
            #[inline(always)]
            |point, unit, _, viscous| {
                add_pairs(point, unit * viscous.value, &mut sum.n);
                add_pairs(point, unit * viscous.value, &mut tangent.geometric);
                add_square(point, unit * viscous.slope, &mut tangent.h);
            },
        );
    }

    /// Adds the pairs of a step, and returns the power in W that they dissipate.
    #[inline(always)]
    pub fn add_discrete_gradient<T: Real>(&self, at: &GramStep<'_, T>, time: f64, sum: &mut Gradient<T>) -> T {
        let mut stress = [at.rates[0].splat(0.0); 6];
        self.beyond.add_product(&at.rates, at.stiffness.axial * time, &mut stress);
        // a sum of squares, but for rounding
        let mut power = contract(&stress, &at.rates).at_least(0.0);
        self.over_step(
            at,
            time,
            #[inline(always)]
            |point, unit, rate, viscous| {
                add_pairs(point, unit * viscous.value, &mut stress);
                power = power + unit * (viscous.value * rate);
            },
        );
        for i in 0..6 {
            sum.n[i] = sum.n[i] + stress[i];
        }
        power
    }

    #[inline(always)]
    pub fn add_step_tangent<T: Real>(&self, at: &GramStep<'_, T>, time: f64, tangent: &mut Hessian<T>) {
        self.beyond.add_hessian(at.stiffness.axial * (time * at.rate), &mut tangent.h);
        self.over_step(
            at,
            time,
            #[inline(always)]
            |point, unit, _, viscous| add_square(point, unit * viscous.slope, &mut tangent.h),
        );
    }

    /// Returns the power in W that it dissipates.
    pub fn power(&self, at: &GramState<'_, f64>, rates: &Six<f64>, time: f64) -> f64 {
        let mut power = at.stiffness.axial * time * quadratic_form(&self.beyond.matrix, rates, rates);
        self.at_instant((at, rates), [time, 0.0], |_, unit, rate, viscous| power += unit * viscous.value * rate);
        power
    }

    /// Returns the strain that it adds at a local coordinate to the one that makes tension.
    pub fn strain(&self, at: &GramState<'_, f64>, rates: &Six<f64>, xi: f64, time: f64) -> f64 {
        // linear in the Gram numbers, and -1/2 at zero
        let [x, rate] = [&at.g, rates].map(|g| 1.0 + 2.0 * at.table.strain(g, xi));
        let law = self.law.spline.secant(x, x);
        let open = if x > self.slack { 1.0 } else { 0.0 };
        2.0 * Self::limited([law.value, law.slope], rate, [time, 0.0], [open, open]).value
    }
}
