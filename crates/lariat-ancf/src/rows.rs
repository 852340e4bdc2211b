//! Tables of two columns: linear between rows, constant beyond the first and the last one.

use crate::error::{Error, require};

/// Refuses numbers that are not finite and rows that do not ascend.
pub(crate) fn check_rows(what: &str, rows: &[[f64; 2]]) -> Result<(), Error> {
    rows.iter().flatten().try_for_each(|&x| require(what, x, true, "a number"))?;
    match rows.windows(2).find(|r| r[1][0] <= r[0][0]) {
        None => Ok(()),
        Some(r) => require(what, r[1][0], false, "above the row before it"),
    }
}

/// Interpolates linearly, constant outside; 1 without rows.
pub(crate) fn interpolate(rows: &[[f64; 2]], x: f64) -> f64 {
    let after = rows.partition_point(|row| row[0] <= x);
    match (after.checked_sub(1).and_then(|i| rows.get(i)), rows.get(after)) {
        (Some(a), Some(b)) => a[1] + (b[1] - a[1]) * ((x - a[0]) / (b[0] - a[0])),
        (Some(only), None) | (None, Some(only)) => only[1],
        (None, None) => 1.0,
    }
}

/// Returns whether a table has one value between two places.
pub(crate) fn is_constant(rows: &[[f64; 2]], from: f64, to: f64) -> bool {
    let value = interpolate(rows, from);
    let between = rows.iter().filter(|row| from < row[0] && row[0] < to);
    interpolate(rows, to) == value && between.into_iter().all(|row| row[1] == value)
}
