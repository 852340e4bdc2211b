//! Large rotations in a chart: the rotation vector theta from the attitude at the beginning of a step.
//!
//! ```text
//! R = exp([theta]) R0        omega = J theta'        omega' = J theta'' + J' theta'
//! J = I + a [theta] + b [theta]^2,   a = (1 - cos p)/p^2,  b = (p - sin p)/p^3,  p = |theta|
//! ```
//!
//! omega in world axes; J is the left Jacobian of SO(3). *Source.* Chirikjian 2012, section 10.8; the rates by differentiation,
//! checked below by finite differences. *Validity.* p < 2 pi; a step of a game turns a body by less than pi/4.
//! *Rejected.* Unit quaternions as coordinates (a constraint to project in every stage), one chart for all times (singular).

use nalgebra::{Matrix3, Vector3};

/// Below this angle series replace the quotients.
const SMALL: f64 = 1e-2;

/// `[v]x`: the matrix of the cross product.
pub fn skew(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

/// Left Jacobian J: angular velocity = J theta'.
pub fn jacobian(theta: &Vector3<f64>) -> Matrix3<f64> {
    let (p2, k) = (theta.norm_squared(), skew(theta));
    let (a, b) = if p2 < SMALL * SMALL {
        (0.5 - p2 / 24.0 + p2 * p2 / 720.0, 1.0 / 6.0 - p2 / 120.0 + p2 * p2 / 5040.0)
    } else {
        let p = p2.sqrt();
        ((1.0 - p.cos()) / p2, (p - p.sin()) / (p2 * p))
    };
    Matrix3::identity() + k * a + k * k * b
}

/// Inverse of [`jacobian`].
pub fn jacobian_inverse(theta: &Vector3<f64>) -> Matrix3<f64> {
    let (p2, k) = (theta.norm_squared(), skew(theta));
    let c = if p2 < SMALL * SMALL {
        1.0 / 12.0 + p2 / 720.0 + p2 * p2 / 30240.0
    } else {
        let half = 0.5 * p2.sqrt();
        (1.0 - half / half.tan()) / p2
    };
    Matrix3::identity() - k * 0.5 + k * k * c
}

/// Time derivative of [`jacobian`] at rate theta'.
pub fn jacobian_rate(theta: &Vector3<f64>, rate: &Vector3<f64>) -> Matrix3<f64> {
    let (p2, k, dk) = (theta.norm_squared(), skew(theta), skew(rate));
    // a, b and their derivatives by p over p
    let (a, b, da, db) = if p2 < SMALL * SMALL {
        (
            0.5 - p2 / 24.0 + p2 * p2 / 720.0,
            1.0 / 6.0 - p2 / 120.0 + p2 * p2 / 5040.0,
            -1.0 / 12.0 + p2 / 180.0 - p2 * p2 / 6720.0,
            -1.0 / 60.0 + p2 / 1260.0 - p2 * p2 / 60480.0,
        )
    } else {
        let p = p2.sqrt();
        let (sin, cos) = p.sin_cos();
        (
            (1.0 - cos) / p2,
            (p - sin) / (p2 * p),
            (p * sin - 2.0 * (1.0 - cos)) / (p2 * p2),
            (p * (1.0 - cos) - 3.0 * (p - sin)) / (p2 * p2 * p),
        )
    };
    let along = theta.dot(rate);
    k * (da * along) + dk * a + k * k * (db * along) + (dk * k + k * dk) * b
}

/// `scale` times the angular acceleration, of `scale` times the acceleration `k` of the rotation vector.
pub fn angular_acceleration(scale: f64, theta: &Vector3<f64>, rate: &Vector3<f64>, k: &Vector3<f64>) -> Vector3<f64> {
    jacobian(theta) * k + jacobian_rate(theta, rate) * rate * scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;

    #[test]
    fn angular_velocity_is_the_jacobian_times_the_rate_of_the_rotation_vector() {
        let rate = Vector3::new(0.3, -0.8, 0.5);
        for size in [0.0, 1e-6, 5e-3, 0.0101, 0.3, 2.0] {
            let theta = Vector3::new(0.6, 0.0, -0.8) * size;
            let h = 1e-5;
            let at = |s: f64| Rotation3::new(theta + rate * s);
            // for a small rotation the skew part of the matrix is the rotation vector
            let turn = (at(h) * at(-h).inverse()).into_inner();
            let skew_part = (turn - turn.transpose()) * 0.5;
            let omega = Vector3::new(skew_part[(2, 1)], skew_part[(0, 2)], skew_part[(1, 0)]) / (2.0 * h);
            assert_relative_eq!(jacobian(&theta) * rate, omega, epsilon = 1e-9);
            assert_relative_eq!(jacobian(&theta) * jacobian_inverse(&theta), Matrix3::identity(), epsilon = 1e-13);
            let difference = (jacobian(&(theta + rate * h)) - jacobian(&(theta - rate * h))) / (2.0 * h);
            assert_relative_eq!(jacobian_rate(&theta, &rate), difference, epsilon = 1e-9);
        }
    }
}
