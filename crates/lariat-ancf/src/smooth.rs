//! Curves through rows of time and value whose rate is continuous: paths, and courses of motors.
//!
//! # Equation
//!
//! Between rows i and i + 1, at distance h in time, the cubic with the values and rates at both.
//! The rate at a row is that of the parabola through it and its neighbours, in terms of the mean
//! rates d of the intervals beside it:
//!
//! ```text
//! inner row   r_i = (h_i d_{i-1} + h_{i-1} d_i)/(h_{i-1} + h_i)
//! first row   r_0 = ((2 h_0 + h_1) d_0 - h_0 d_1)/(h_0 + h_1), and the last one likewise
//! ```
//!
//! but 0 at a row beside an equal one: between equal rows the value stays.
//!
//! # Validity
//!
//! Exact for parabolas; else an error of the third order in the distance of the rows. Before the
//! first row and behind the last the value stays, so that rows which begin or end in motion have a
//! jump of the rate there: two equal rows start or stop without one.
//!
//! # References
//!
//! de Boor 2001, chapter IV (cubic Hermite interpolation, Bessel's end rule).
//!
//! # Alternatives considered
//!
//! Splines with a continuous second derivative: they swing beyond the rows, and a row changes the
//! curve everywhere.

use core::ops::{Add, Div, Mul, Sub};

/// What can be interpolated: numbers and vectors.
pub trait Linear:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Div<f64, Output = Self>
{
}

impl<T> Linear for T where T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T> + Div<f64, Output = T> {}

/// Returns the coefficients of s, s^2 and s^3 of the cubic that begins at 0 with the first rate and
/// has the mean rate and the second rate after a time h.
pub fn hermite<T: Linear>(h: f64, mean: T, [v0, v1]: [T; 2]) -> [T; 3] {
    [v0, (mean * 3.0 - v0 * 2.0 - v1) / h, (v0 + v1 - mean * 2.0) / (h * h)]
}

/// Returns the rate at a row of `rows` >= 2, by the lengths in s and the mean rates of the
/// intervals between them.
pub fn rate<T: Linear + PartialEq>(
    rows: usize,
    row: usize,
    length: impl Fn(usize) -> f64,
    mean: impl Fn(usize) -> T,
) -> T {
    let last = rows - 1;
    if last == 1 {
        return mean(0);
    }
    let zero = mean(0) * 0.0;
    let mut beside = row.saturating_sub(1)..(row + 1).min(last);
    if beside.any(|interval| mean(interval) == zero) {
        return zero;
    }
    // the interval whose rate counts more at an end, and the next
    let beyond = |near: usize, far: usize| {
        let (h, g) = (length(near), length(far));
        (mean(near) * (2.0 * h + g) - mean(far) * h) / (h + g)
    };
    if row == 0 {
        beyond(0, 1)
    } else if row == last {
        beyond(last - 1, last - 2)
    } else {
        let (before, behind) = (length(row - 1), length(row));
        (mean(row - 1) * behind + mean(row) * before) / (before + behind)
    }
}

/// Returns the value at a time of the curve through ascending rows of time and value; 0 without
/// rows.
pub(crate) fn value(rows: &[[f64; 2]], time: f64) -> f64 {
    match piece(rows, time) {
        Some((value, s, [a, b, c])) => value + s * (a + s * (b + s * c)),
        None => {
            let outside = rows.first().filter(|row| time < row[0]).or(rows.last());
            outside.map_or(0.0, |row| row[1])
        }
    }
}

/// Returns the rate of that curve at a time.
pub(crate) fn rate_at(rows: &[[f64; 2]], time: f64) -> f64 {
    piece(rows, time).map_or(0.0, |(_, s, [a, b, c])| a + s * (2.0 * b + s * 3.0 * c))
}

/// Returns the value at the row before a time, the time since then, and the coefficients of the
/// cubic behind it; `None` where the value stays.
fn piece(rows: &[[f64; 2]], time: f64) -> Option<(f64, f64, [f64; 3])> {
    let next = rows.partition_point(|row| row[0] <= time);
    let (i, after) = (next.checked_sub(1)?, rows.get(next)?);
    let length = |i: usize| rows[i + 1][0] - rows[i][0];
    let mean = |i: usize| (rows[i + 1][1] - rows[i][1]) / length(i);
    let rates = [i, i + 1].map(|row| rate(rows.len(), row, length, mean));
    Some((rows[i][1], time - rows[i][0], hermite(after[0] - rows[i][0], mean(i), rates)))
}

#[cfg(test)]
mod tests {
    use super::{rate_at, value};

    /// A curve through rows of a parabola is that parabola, stays between equal rows and outside,
    /// and converges to a wave with order 3.
    ///
    /// *Source.* The parabola; the page of this module.
    #[test]
    fn a_curve_is_a_parabola_through_rows_of_one_and_stays_between_equal_rows() {
        let parabola = |t: f64| 3.0 * t * t - t + 0.5;
        let rows = [0.0, 0.3, 0.5, 1.4, 2.0].map(|t| [t, parabola(t)]);
        for t in [0.0, 0.1, 0.4, 0.77, 1.4, 1.9, 2.0] {
            assert!((value(&rows, t) - parabola(t)).abs() < 1e-14, "t = {t}");
            let rate = if t < 2.0 { 6.0 * t - 1.0 } else { 0.0 };
            assert!((rate_at(&rows, t) - rate).abs() < 1e-13, "t = {t}");
        }
        assert_eq!([-1.0, 9.0].map(|t| value(&rows, t)), [0.5, parabola(2.0)]);
        assert_eq!([-1.0, 9.0].map(|t| rate_at(&rows, t)), [0.0; 2]);
        let rows = [[0.0, 1.0], [1.0, 1.0], [2.0, 4.0], [3.0, 4.0]];
        assert_eq!([0.3, 2.5].map(|t| value(&rows, t)), [1.0, 4.0]);
        assert_eq!([value(&[], 1.0), value(&[[2.0, 3.0]], 1.0), value(&[[2.0, 3.0]], 5.0)], [0.0, 3.0, 3.0]);
        let error = |count: usize| {
            let row = |i: usize| 2.0 * i as f64 / count as f64;
            let rows: Vec<[f64; 2]> = (0..=count).map(|i| [row(i), (3.0 * row(i)).sin()]).collect();
            (0..200).map(|i| 0.01 * f64::from(i)).map(|t| (value(&rows, t) - (3.0 * t).sin()).abs()).fold(0.0, f64::max)
        };
        assert!(error(80) < 1e-4 && error(80) < error(40) / 7.0 && error(40) < error(20) / 7.0);
    }
}
