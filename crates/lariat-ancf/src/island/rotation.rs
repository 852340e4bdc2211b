//! Large rotations in a chart: the rotation vector theta from the attitude at the beginning of a
//! step.
//!
//! # Equation
//!
//! ```text
//! R = exp([theta]) R0        omega = J theta'        omega' = J theta'' + J' theta'
//! J = I + a [theta] + b [theta]^2,   a = (1 - cos p)/p^2,  b = (p - sin p)/p^3,  p = |theta|
//! ```
//!
//! omega in world axes; J is the left Jacobian of SO(3).
//!
//! # Validity
//!
//! p < 2 pi. Bodies in games rotate by less than pi/4 in a step.
//!
//! # References
//!
//! Chirikjian 2012, section 10.8; the rates by differentiation, checked below by finite
//! differences.
//!
//! # Alternatives considered
//!
//! - Unit quaternions as coordinates: a constraint to project in every stage.
//! - One chart for all times: it is singular.

use crate::scales::island::SERIES_ANGLE;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

/// Layout: number of terms of a series: the remainder is below 1e-18 of it at [`SERIES_ANGLE`].
const TERMS: usize = 7;
const FOURTH: [f64; TERMS] = coefficients(4);
const FIFTH: [f64; TERMS] = coefficients(5);

/// `(-1)^k / (n + 2 k)!`.
const fn coefficients(n: usize) -> [f64; TERMS] {
    let mut out = [0.0; TERMS];
    let (mut i, mut factorial) = (1, 1.0);
    while i < n + 2 * TERMS {
        factorial *= i as f64;
        if i >= n && (i - n).is_multiple_of(2) {
            let k = (i - n) / 2;
            out[k] = if k.is_multiple_of(2) { 1.0 / factorial } else { -1.0 / factorial };
        }
        i += 1;
    }
    out
}

/// s_n = 1/n! - p^2/(n + 2)! + p^4/(n + 4)! ... for n = 1 to 5: `s1 = sin p / p`, `s2 = (1 - cos
/// p)/p^2`, `s3 = (p - sin p)/p^3`.
struct Series {
    s1: f64,
    s2: f64,
    s3: f64,
    s4: f64,
    s5: f64,
}

impl Series {
    fn at(p2: f64) -> Self {
        if p2 < SERIES_ANGLE * SERIES_ANGLE {
            let sum = |c: &[f64; TERMS]| c.iter().rev().fold(0.0, |sum, c| sum * p2 + c);
            let (s4, s5) = (sum(&FOURTH), sum(&FIFTH));
            let s3 = 1.0 / 6.0 - p2 * s5;
            Series { s1: 1.0 - p2 * s3, s2: 0.5 - p2 * s4, s3, s4, s5 }
        } else {
            let p = p2.sqrt();
            let (sin, cos) = p.sin_cos();
            let (s2, s3) = ((1.0 - cos) / p2, (p - sin) / (p2 * p));
            Series { s1: sin / p, s2, s3, s4: (0.5 - s2) / p2, s5: (1.0 / 6.0 - s3) / p2 }
        }
    }
}

/// Returns `[v]x`, the matrix of the cross product.
pub fn skew(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

/// Returns exp([theta]).
pub fn exponential(theta: &Vector3<f64>) -> UnitQuaternion<f64> {
    let quarter = 0.25 * theta.norm_squared();
    let Series { s1, s2, .. } = Series::at(quarter);
    UnitQuaternion::new_unchecked(Quaternion::from_parts(1.0 - quarter * s2, theta * (0.5 * s1)))
}

/// Returns the angular velocity J theta', J the left Jacobian.
pub fn spin(theta: &Vector3<f64>, rate: &Vector3<f64>) -> Vector3<f64> {
    let Series { s2, s3, .. } = Series::at(theta.norm_squared());
    let across = theta.cross(rate);
    rate + across * s2 + theta.cross(&across) * s3
}

/// Returns the inverse of J: theta' = J^-1 omega.
pub fn jacobian_inverse(theta: &Vector3<f64>) -> Matrix3<f64> {
    // (1 - p/2 cot p/2)/p^2
    let Series { s1, s2, s3, .. } = Series::at(0.25 * theta.norm_squared());
    let k = skew(theta);
    Matrix3::identity() - k * 0.5 + k * k * ((s2 - s3) / (4.0 * s1))
}

/// Returns the time derivative of J at rate theta'.
pub fn jacobian_rate(theta: &Vector3<f64>, rate: &Vector3<f64>) -> Matrix3<f64> {
    let Series { s2, s3, s4, s5, .. } = Series::at(theta.norm_squared());
    let (along, k, dk) = (theta.dot(rate), skew(theta), skew(rate));
    // s2' = (2 s4 - s3) p p',  s3' = (3 s5 - s4) p p'
    k * ((2.0 * s4 - s3) * along) + dk * s2 + k * k * ((3.0 * s5 - s4) * along) + (dk * k + k * dk) * s3
}

/// Returns J' theta', the term of the rate in the angular acceleration.
pub fn spin_rate(theta: &Vector3<f64>, rate: &Vector3<f64>) -> Vector3<f64> {
    let Series { s3, s4, s5, .. } = Series::at(theta.norm_squared());
    let (along, across) = (theta.dot(rate), theta.cross(rate));
    across * ((2.0 * s4 - s3) * along) + theta.cross(&across) * ((3.0 * s5 - s4) * along) + rate.cross(&across) * s3
}

/// Returns `scale` times the angular acceleration, from `scale` times the acceleration `k` of the
/// rotation vector.
pub fn angular_acceleration(scale: f64, theta: &Vector3<f64>, rate: &Vector3<f64>, k: &Vector3<f64>) -> Vector3<f64> {
    spin(theta, k) + spin_rate(theta, rate) * scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;

    #[test]
    fn series_and_quotients_agree_where_they_meet() {
        let (below, above) = (Series::at(0.25 * (1.0 - 1e-15)), Series::at(0.25));
        let all = |s: &Series| [s.s1, s.s2, s.s3, s.s4, s.s5];
        for ((a, b), most) in all(&below).into_iter().zip(all(&above)).zip([4e-16, 2e-15, 2e-14, 2e-13, 2e-11]) {
            assert!((a / b - 1.0).abs() < most, "{a} {b}");
        }
    }

    #[test]
    fn angular_velocity_is_the_jacobian_times_the_rate_of_the_rotation_vector() {
        let rate = Vector3::new(0.3, -0.8, 0.5);
        let jacobian =
            |theta: &Vector3<f64>| Matrix3::from_columns(&[0, 1, 2].map(|i| spin(theta, &Vector3::ith(i, 1.0))));
        for size in [0.0, 1e-6, 5e-3, 0.0101, 0.3, 0.49999, 0.50001, 2.0] {
            let theta = Vector3::new(0.6, 0.0, -0.8) * size;
            let h = 1e-5;
            let at = |s: f64| Rotation3::new(theta + rate * s);
            // for a small rotation the skew part of the matrix is the rotation vector
            let rotation = (at(h) * at(-h).inverse()).into_inner();
            let skew_part = (rotation - rotation.transpose()) * 0.5;
            let omega = Vector3::new(skew_part[(2, 1)], skew_part[(0, 2)], skew_part[(1, 0)]) / (2.0 * h);
            assert_relative_eq!(spin(&theta, &rate), omega, epsilon = 1e-9);
            assert_relative_eq!(jacobian(&theta) * jacobian_inverse(&theta), Matrix3::identity(), epsilon = 1e-13);
            let difference = (jacobian(&(theta + rate * h)) - jacobian(&(theta - rate * h))) / (2.0 * h);
            assert_relative_eq!(jacobian_rate(&theta, &rate), difference, epsilon = 1e-9);
            assert_relative_eq!(spin_rate(&theta, &rate), jacobian_rate(&theta, &rate) * rate, epsilon = 1e-13);
            let library = UnitQuaternion::from_scaled_axis(theta);
            assert_relative_eq!(exponential(&theta).coords, library.coords, epsilon = 1e-15);
        }
    }
}
