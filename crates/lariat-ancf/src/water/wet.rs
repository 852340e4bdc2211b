//! How much of a round section is below the surface.
//!
//! # Equation
//!
//! ```text
//! f(s) = 1/2 + (asin s + s sqrt(1 - s^2))/pi        s = depth of the centre over the radius, -1 .. 1
//! F(s) = int_-1^s f = s/2 + (s asin s + sqrt(1 - s^2) - (1 - s^2)^(3/2)/3)/pi
//! ```
//!
//! f is 0 above and 1 below, with a continuous derivative; F is then 0 and s. Over a step from s0
//! to s1 the secant (F(s1) - F(s0))/(s1 - s0) takes the place of f, and the potential is exact.
//!
//! # Validity
//!
//! The segment of a circle, exact for a level cable. One that goes through the surface steeply is
//! cut over its diameter in depth, not at the surface: its displaced volume is the same.
//!
//! # References
//!
//! The circular segment.

use crate::scales::water::SMALLEST_RISE;
use core::f64::consts::PI;

/// Returns the share of a round section that is wet.
pub(crate) fn share(s: f64) -> f64 {
    if s <= -1.0 {
        0.0
    } else if s >= 1.0 {
        1.0
    } else {
        0.5 + (libm::asin(s) + s * (1.0 - s * s).sqrt()) / PI
    }
}

/// Returns the derivative of the share.
pub(crate) fn slope(s: f64) -> f64 {
    if s.abs() >= 1.0 { 0.0 } else { 2.0 / PI * (1.0 - s * s).sqrt() }
}

/// Returns 1 less the share, integrated from s to infinity: F(s) - s, which is zero below.
fn dry_integral(s: f64) -> f64 {
    if s <= -1.0 {
        -s
    } else if s >= 1.0 {
        0.0
    } else {
        let root = (1.0 - s * s).sqrt();
        (s * libm::asin(s) + root * (1.0 - (1.0 - s * s) / 3.0)) / PI - 0.5 * s
    }
}

/// Returns the mean of the dry share, 1 - f, over a rise from s0 to s1, and its derivative by s1.
pub(crate) fn mean_dry(s0: f64, s1: f64) -> [f64; 2] {
    let rise = s1 - s0;
    if rise.abs() <= SMALLEST_RISE {
        let middle = 0.5 * (s0 + s1);
        return [1.0 - share(middle), -0.5 * slope(middle)];
    }
    let mean = (dry_integral(s0) - dry_integral(s1)) / rise;
    [mean, (1.0 - share(s1) - mean) / rise]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* Midpoint sums over 2000 chords of the circle.
    #[test]
    fn the_share_is_the_segment_of_a_circle_and_the_mean_its_integral() {
        for s in [-1.2, -0.9, -0.3, 0.0, 0.4, 0.97, 1.5] {
            let n = 20_000;
            let chord = |i: usize| {
                let z = -1.0 + 2.0 * (i as f64 + 0.5) / n as f64;
                if z < s { 2.0 * (1.0 - z * z).sqrt() * 2.0 / n as f64 } else { 0.0 }
            };
            let area: f64 = (0..n).map(chord).sum();
            assert!((share(s) - area / PI).abs() < 1e-4, "{s}");
            let h = 1e-6;
            assert!((slope(s) - (share(s + h) - share(s - h)) / (2.0 * h)).abs() < 1e-5, "{s}");
            for end in [-2.0, -0.5, s + 1e-3, 2.0] {
                let m = 2000;
                let mean = (0..m).map(|i| 1.0 - share(s + (end - s) * (i as f64 + 0.5) / m as f64)).sum::<f64>();
                let [found, slope] = mean_dry(s, end);
                assert!((found - mean / m as f64).abs() < 1e-6, "{s} {end}");
                let by = (mean_dry(s, end + 1e-5)[0] - mean_dry(s, end - 1e-5)[0]) / 2e-5;
                assert!((slope - by).abs() < 1e-5, "{s} {end} {slope} {by}");
            }
        }
        assert_eq!(mean_dry(1.5, 4.0)[0], 0.0);
        assert_eq!(mean_dry(-1.5, -4.0)[0], 1.0);
    }
}
