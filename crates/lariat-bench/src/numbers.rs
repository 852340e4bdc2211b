//! Extremes and formats of measured numbers.

/// Returns the larger of two numbers, or NaN if either is: `f64::max` passes over NaN.
pub fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Formats a number with three significant digits, and with a power of ten outside 0.01 to 1e5.
pub fn short(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        x.to_string()
    } else if (0.01..1e5).contains(&x.abs()) {
        let decimals = (2 - x.abs().log10().floor() as i32).max(0) as usize;
        format!("{x:.decimals$}")
    } else {
        format!("{x:.1e}")
    }
}
