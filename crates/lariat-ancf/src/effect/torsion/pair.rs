//! The twist between two directions: its derivative, its exact change over a step.
//!
//! # Equation
//!
//! Psi(x, y) is the angle about y from P u_x to u_y: P is the smallest rotation that takes x to y,
//! u are material directors of the sections. While these do not spin,
//!
//! ```text
//! d Psi = c.(dx + dy)        c = x cross y/(1 + x.y)
//! D Psi = 2 atan z = c^.(Dx + Dy)        z = N/S,  c^ = (X cross Y) 2 atan(z)/N
//! N = (X cross Y).(Dx + Dy)        S = (X.B)(Y.C) - (X.Y)(B.C) + (X.C)(B.Y)
//! X = x0 + x1,  Y = y0 + y1,  B = x1 + y1,  C = x0 + y0
//! ```
//!
//! for directors that are carried by the smallest rotations x0 -> x1 and y0 -> y1. *Proof.* The
//! strip between two neighbouring geodesics x-y has the area c.(dx + dy), and parallel transport
//! round a loop turns by the area inside (Gauss and Bonnet). The loop x0 y0 y1 x1 is the product of
//! four rotors, (1 + x0 x1)(1 + x1 y1)(1 + y1 y0)(1 + y0 x0) = X B Y C in the geometric algebra,
//! because (a + b) b = a (a + b); its scalar part is S, and its bivector against X is X.(B cross C)
//! = (X cross Y).(Dx + Dy)/2 up to the common factor, since B + C = X + Y and B - C = Dx + Dy. N is
//! linear in the increments, so c^ is an exact secant.
//!
//! # Validity
//!
//! Beyond 120 degrees between the two, or between the ends of the step, S -> 4/(2 - S/4): smooth,
//! and the identity D Psi = c^.(Dx + Dy) stays, but it is no more the angle: a *slip*.
//!
//! # References
//!
//! Langer & Singer, SIAM Review 38 (1996) 605 (twist of curves); Bergou et al., ACM Trans. Graph.
//! 27 (2008) 63 (parallel transport in rods); Gonzalez, J. Nonlinear Sci. 6 (1996) 449.

use crate::scales::effect::SMALL_TURN;
use nalgebra::{Matrix3, Vector3};

/// Coefficient of the continuation: S at 120 degrees.
const SHARP: f64 = 4.0;

/// Returns the matrix of the cross product from the left.
pub(super) fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

/// Returns c, and the factor on x cross y in it with its derivative by x.y.
fn factors(x: &Vector3<f64>, y: &Vector3<f64>) -> (Vector3<f64>, f64, f64) {
    let (w, s) = (x.cross(y), 1.0 + x.dot(y));
    let (factor, slope) = if 8.0 * s >= SHARP { (s.recip(), -(s * s).recip()) } else { (4.0 - 4.0 * s, -4.0) };
    (w * factor, factor, slope)
}

/// Returns c.
pub(super) fn gradient(x: &Vector3<f64>, y: &Vector3<f64>) -> Vector3<f64> {
    factors(x, y).0
}

/// Returns the derivatives of c by x and by y.
pub(super) fn jacobians(x: &Vector3<f64>, y: &Vector3<f64>) -> [Matrix3<f64>; 2] {
    let (_, factor, slope) = factors(x, y);
    let w = x.cross(y) * slope;
    [cross(y) * -factor + w * y.transpose(), cross(x) * factor + w * x.transpose()]
}

/// What the ends of a pair change over a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairChange {
    /// D Psi.
    pub angle: f64,
    /// c^.
    pub secant: Vector3<f64>,
    /// Whether the angle slips.
    pub slips: bool,
}

/// Returns the change of a pair from (x0, y0) to (x1, y1).
pub(super) fn change([x0, x1]: [&Vector3<f64>; 2], [y0, y1]: [&Vector3<f64>; 2]) -> PairChange {
    let (x, y, b, c) = (x0 + x1, y0 + y1, x1 + y1, x0 + y0);
    let normal = x.cross(&y);
    let n = normal.dot(&(b - c));
    let mut s = x.dot(&b) * y.dot(&c) - x.dot(&y) * b.dot(&c) + x.dot(&c) * b.dot(&y);
    let slips = s < SHARP;
    if slips {
        s = 4.0 / (2.0 - 0.25 * s);
    }
    let z = n / s;
    let square = z * z;
    let (angle, ratio) = if square < SMALL_TURN * SMALL_TURN {
        let ratio = 1.0 - square * (1.0 / 3.0 - square / 5.0);
        (2.0 * z * ratio, ratio)
    } else {
        let atan = z.atan();
        (2.0 * atan, atan / z)
    };
    PairChange { angle, secant: normal * (2.0 * ratio / s), slips }
}
