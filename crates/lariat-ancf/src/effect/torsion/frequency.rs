//! By how much torsion raises a bound of the frequencies, for the step of explicit methods.
//!
//! # Equation
//!
//! The largest frequency is at most that of an element alone. With the weights l_e/L of Cauchy's
//! inequality for the sum g.x over the elements of a segment, m_e and h_e mass and Hessian of one,
//!
//! ```text
//! omega^2 <= omega_0^2 + max_e (K L/l_e g_e.(m_e^-1 g_e) + |M| |m_e^(-1/2) h_e m_e^(-1/2)|)
//! ```
//!
//! # Validity
//!
//! The shape and the torque that there are. The norm is Frobenius's, two or three times the largest
//! eigenvalue.
//!
//! # References
//!
//! Irons & Treharne 1971.

use super::element::{self, Blocks, COORDINATES, twist_hessian};
use super::segment::Segment;
use super::stranded::{elongation_gradient, elongation_hessian};
use crate::element::mass;
use crate::section::Element;
use nalgebra::{Matrix3, Matrix4, Vector3};

impl Segment {
    /// Returns by how much the segment raises a bound of the squares of the frequencies of its
    /// elements alone, in 1/s^2, in a shape with its twist in rad; `mass` is that per length in
    /// kg/m.
    pub fn frequency_square(
        &self,
        elements: &[Element],
        (q, twist): (&[f64], f64),
        mass: impl Fn(&Element) -> f64,
    ) -> f64 {
        let torque = self.torque(elements, q, twist);
        let length: f64 = elements[self.elements()].iter().map(|element| element.length).sum();
        let of = |e: usize| {
            let element = &elements[e];
            let (gradient, blocks) = self.derivatives(element, &q[6 * e..6 * e + COORDINATES], torque);
            let mass = mass::consistent(mass(element), element.length);
            // the inverse of Cholesky's factor of the mass
            let factor = Matrix4::from_fn(|i, j| mass[i][j]).cholesky().and_then(|factor| factor.l().try_inverse());
            factor.map_or(f64::INFINITY, |factor| {
                self.stiffness * length / element.length * square_of(&factor, &gradient) + norm_of(&factor, &blocks)
            })
        };
        self.elements().map(of).fold(0.0, f64::max)
    }

    /// Returns gradient of the twist of an element, and its Hessian times a torque.
    fn derivatives(&self, element: &Element, q: &[f64], torque: f64) -> ([f64; COORDINATES], Blocks) {
        let (mut gradient, mut part) = ([0.0; COORDINATES], [0.0; COORDINATES]);
        element::twist_gradient(q, element.length, &mut gradient);
        let mut blocks = twist_hessian(q, element.length, torque);
        let Some(strands) = self.strands else { return (gradient, blocks) };
        let share = strands.share(element);
        elongation_gradient(|i| q[i], element.length, share, &mut part);
        gradient.iter_mut().zip(&part).for_each(|(sum, x)| *sum += x);
        for (row, column) in (0..4).flat_map(|row| (0..=row).map(move |column| (row, column))) {
            let entry = torque * share * elongation_hessian(row, column, element.length);
            blocks[row][column] += Matrix3::from_diagonal_element(entry);
        }
        (gradient, blocks)
    }
}

/// Returns g.(m^-1 g).
fn square_of(factor: &Matrix4<f64>, gradient: &[f64; COORDINATES]) -> f64 {
    let vector = |k: usize| Vector3::from_column_slice(&gradient[3 * k..3 * k + 3]);
    (0..4).map(|i| (0..4).map(|a| vector(a) * factor[(i, a)]).sum::<Vector3<f64>>().norm_squared()).sum()
}

/// Returns the norm of m^(-1/2) h m^(-1/2); of h the blocks on and below the diagonal are given.
fn norm_of(factor: &Matrix4<f64>, blocks: &Blocks) -> f64 {
    let block = |i: usize, j: usize| if i < j { blocks[j][i].transpose() } else { blocks[i][j] };
    let pairs = || (0..4).flat_map(|a| (0..4).map(move |b| (a, b)));
    let scaled =
        |(i, j)| -> Matrix3<f64> { pairs().map(|(a, b)| block(a, b) * (factor[(i, a)] * factor[(j, b)])).sum() };
    pairs().map(|at| scaled(at).norm_squared()).sum::<f64>().sqrt()
}
