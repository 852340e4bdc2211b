//! Force against strain as a spline, with the exact secant of its energy.
//!
//! # Equation
//!
//! ```text
//! T = k e + sum_k [a_k p_k + c_k p_k^2]        p_k = max(0, e - e_k)        W = int T de
//! ```
//!
//! The curve is Schumaker's spline: quadratic between the rows, with a knot amid them, C1, monotone
//! where the table is, with the slopes of Fritsch and Butland at the rows. Beyond the last row it
//! goes on straight; before the first, where its force is zero, it is zero. The secant
//! `(W(x1) - W(x0))/(x1 - x0)` by the squared stretch x is taken hinge by hinge.
//!
//! # Validity
//!
//! Rows whose strains and forces ascend. Below a squared stretch of 1/16 the stretch is continued
//! linearly in its square.
//!
//! # References
//!
//! Schumaker, SIAM J. Numer. Anal. 20 (1983) 853; Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5
//! (1984) 300.
//!
//! # Alternatives considered
//!
//! Cubic pieces (PCHIP): their secant over pieces needs a branch in each lane.

use crate::Real;
use crate::scales::effect::{CRUMPLED, TINY};

/// A part of a law that begins at a strain: `linear p + square p^2`, p = max(0, e - at).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Hinge {
    at: f64,
    linear: f64,
    square: f64,
}

/// Force per EA against strain.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spline {
    slope: f64,
    hinges: Vec<Hinge>,
}

/// Secant of the energy by the squared stretch over a step, and its derivative by the end of it.
pub(super) struct Secant<T> {
    pub value: T,
    pub slope: T,
}

impl Spline {
    /// Returns a straight line.
    pub fn hooke() -> Self {
        Spline { slope: 1.0, hinges: Vec::new() }
    }

    /// Returns a straight line in tension, and nothing in compression.
    pub fn rope() -> Self {
        Spline { slope: 0.0, hinges: vec![Hinge { at: 0.0, linear: 1.0, square: 0.0 }] }
    }

    /// Returns the spline through rows of strain and force, per `unit` N.
    pub fn curve(rows: &[[f64; 2]], unit: f64) -> Self {
        Spline { slope: 0.0, hinges: hinges(rows, unit) }
    }

    /// Returns the steepest slope of a curve.
    pub fn steepest(&self) -> f64 {
        self.hinges.iter().map(|hinge| self.slope_at(hinge.at)).fold(0.0, f64::max)
    }

    /// Returns the strain at which the force begins, of a law that cannot push.
    pub fn slack(&self) -> Option<f64> {
        self.hinges.first().filter(|_| self.slope == 0.0).map(|hinge| hinge.at)
    }

    /// Returns the same with a straight line in compression.
    pub fn pushing(&self) -> Self {
        let none_above = Hinge { at: 0.0, linear: -1.0, square: 0.0 };
        Spline {
            slope: self.slope + 1.0,
            hinges: [none_above].into_iter().chain(self.hinges.iter().copied()).collect(),
        }
    }

    /// Returns dT/de at a strain, from above.
    fn slope_at(&self, strain: f64) -> f64 {
        let of = |h: &Hinge| if strain < h.at { 0.0 } else { h.linear + 2.0 * h.square * (strain - h.at) };
        self.slope + self.hinges.iter().map(of).sum::<f64>()
    }

    /// Returns the force per EA at a strain.
    pub fn force(&self, strain: f64) -> f64 {
        let of = |h: &Hinge| {
            let p = (strain - h.at).max(0.0);
            p * (h.linear + h.square * p)
        };
        self.slope * strain + self.hinges.iter().map(of).sum::<f64>()
    }

    /// Returns the energy per EA and length at a squared stretch.
    #[inline(always)]
    pub fn energy<T: Real>(&self, x: T) -> T {
        let e = stretch(x)[0] - 1.0;
        let mut of_hinges = x.splat(0.0);
        for hinge in &self.hinges {
            let p = (e - hinge.at).at_least(0.0);
            of_hinges = of_hinges + p * p * (p * hinge.square * (1.0 / 3.0) + 0.5 * hinge.linear);
        }
        e * (0.5 * self.slope) * e + of_hinges
    }

    /// Returns the secant of the energy over a step of the squared stretch from `x0` to `x1`; where
    /// both are the same, its derivative, whose own is twice that of the secant.
    #[inline(always)]
    pub fn secant<T: Real>(&self, x0: T, x1: T) -> Secant<T> {
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
            // the share of the step on which the hinge is open; exactly 1 where it is open at both
            // ends
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

/// Returns the stretch of its square, the root of the square or of its least, and by how much the
/// square is below that.
#[inline(always)]
pub(super) fn stretch<T: Real>(x: T) -> [T; 3] {
    let square = x.at_least(CRUMPLED);
    let (root, below) = (square.sqrt(), x - square);
    [root + below * (0.5 / CRUMPLED.sqrt()), root, below]
}

/// Returns a share of a change; 0 of no change.
#[inline(always)]
pub(super) fn ratio<T: Real>(part: T, change: T) -> T {
    part * change / (change * change + TINY)
}

/// Returns 1 of a positive number and 0 of zero.
#[inline(always)]
pub(super) fn is_positive<T: Real>(x: T) -> T {
    x / (x + TINY)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> Vec<Spline> {
        let rows = [[0.0, 0.0], [0.02, 1.0], [0.05, 8.0], [0.2, 20.0], [0.3, 21.0]];
        let unit = Spline::curve(&rows, 1.0).steepest();
        vec![Spline::hooke(), Spline::rope(), Spline::curve(&rows, unit)]
    }

    /// The curve goes through its rows, does not fall, and is C1; beyond the last row it is
    /// straight.
    #[test]
    fn a_curve_is_monotone_and_goes_through_its_rows() {
        let rows = [[0.0, 0.0], [0.02, 1.0], [0.05, 8.0], [0.2, 20.0], [0.3, 21.0]];
        let spline = Spline::curve(&rows, 1.0);
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

    /// The secant times the step is the change of the energy, whatever the step; its slope is the
    /// derivative by differences.
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
