//! Stranded ropes: tension makes torque, and torque length.
//!
//! # Equation
//!
//! Per unstretched length, with the Green strain eps and the twist rate tau,
//!
//! ```text
//! u = EA (eps + k tau)^2/2 + GJ tau^2/2        T = EA (eps + k tau),  M = k T + GJ tau
//! ```
//!
//! so EA is the stiffness and k T the torque while twist is held (k = c d: torque factor c,
//! diameter d), GJ the stiffness while tension is. Nothing acts on the spin of an inner section, so
//! M is uniform, tau = (M - EA k eps)/G with G = GJ + EA k^2, and over a segment of twist Phi
//!
//! ```text
//! M = K (Phi + sum beta_e E_e)        K = 1/sum(l_e/G_e),  beta = EA k/G,  E_e = int eps ds
//! U = sum int EA GJ/G eps^2/2 ds + K (Phi + sum beta_e E_e)^2/2
//! ```
//!
//! This is torsion of the stiffness G by a twist that has the elongation in it, beside the axial
//! stiffness EA GJ/G of a rope that may turn: no further column, and without two holds (M = 0)
//! nothing is left but that stiffness. The tension is T = EA GJ/G eps + beta M. The elongation is
//! quadratic in the coordinates, so its gradient at the mean is an exact secant:
//!
//! ```text
//! E = l/2 [6/5 c.c - 1/5 c.(t_i + t_j) + 2/15 (t_i.t_i + t_j.t_j) - 1/15 t_i.t_j - 1]        c = (r_j - r_i)/l
//! ```
//!
//! With a rest stretch f0 the elongation is counted from (f0^2 - 1)/2 l.
//!
//! # Validity
//!
//! The Green law, unstretched at rest; lengths that do not change (no reels); small tau d: a lay
//! whose angle the twist hardly changes. k > 0 for a right-hand lay (Z), which tension unlays: it
//! turns left-handed. One k for the whole cable.
//!
//! # References
//!
//! Costello, Theory of Wire Rope (1997): tension and torque of a strand, linear in strain and twist
//! rate with one coupling, for they have an energy. Kollros 1974, in Feyrer, Wire Ropes (2015),
//! chapter 2: the torque c d T of ropes. The elimination of the twist is derived here.
//!
//! # Alternatives considered
//!
//! The mean strain as one more coordinate, with two more columns of the matrix: the elimination
//! above leaves one, and keeps the energy a sum of squares.

use super::Torsion;
use super::element::COORDINATES;
use crate::effect::RestShape;
use crate::section::Element;

/// k and GJ of a stranded rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strands {
    per_tension: f64,
    stiffness: f64,
}

impl Strands {
    /// Returns those of an effect; `None` where tension makes no torque.
    pub fn of(torsion: &Torsion) -> Option<Self> {
        let (per_tension, stiffness) = (torsion.torque_per_tension, torsion.stiffness);
        (per_tension != 0.0).then_some(Strands { per_tension, stiffness })
    }

    /// Returns G in N m^2 of an element.
    pub fn torsional(&self, element: &Element) -> f64 {
        self.stiffness + element.section.axial_stiffness * self.per_tension * self.per_tension
    }

    /// Returns EA GJ/G in N of an element.
    pub fn axial(&self, element: &Element) -> f64 {
        element.section.axial_stiffness * (self.stiffness / self.torsional(element))
    }

    /// Returns beta in rad/m of an element.
    pub fn share(&self, element: &Element) -> f64 {
        element.section.axial_stiffness * self.per_tension / self.torsional(element)
    }
}

/// Coefficient: of the products in E, over (c, t_i, t_j).
const PRODUCTS: [[f64; 3]; 3] = [[1.2, -0.1, -0.1], [-0.1, 2.0 / 15.0, -1.0 / 30.0], [-0.1, -1.0 / 30.0, 2.0 / 15.0]];

/// Returns c, t_i and t_j of an element.
fn slopes(q: &[f64], length: f64) -> [[f64; 3]; 3] {
    [
        core::array::from_fn(|x| (q[6 + x] - q[x]) / length),
        core::array::from_fn(|x| q[3 + x]),
        core::array::from_fn(|x| q[9 + x]),
    ]
}

/// Returns the derivatives of E by them.
fn derivatives(slopes: &[[f64; 3]; 3], length: f64) -> [[f64; 3]; 3] {
    PRODUCTS.map(|row| core::array::from_fn(|x| length * (0..3).map(|k| row[k] * slopes[k][x]).sum::<f64>()))
}

/// Returns E in m.
pub(super) fn elongation(q: &[f64], length: f64) -> f64 {
    let slopes = slopes(q, length);
    let by = derivatives(&slopes, length);
    let square: f64 = slopes.iter().flatten().zip(by.iter().flatten()).map(|(a, b)| a * b).sum();
    0.5 * (square - length)
}

/// Writes a factor times the gradient of E at coordinates `q(i)` to `out`.
pub(super) fn elongation_gradient(q: impl Fn(usize) -> f64, length: f64, factor: f64, out: &mut [f64; COORDINATES]) {
    let q: [f64; COORDINATES] = core::array::from_fn(q);
    let [by_chord, first, last] = derivatives(&slopes(&q, length), length).map(|v| v.map(|x| factor * x));
    for x in 0..3 {
        (out[x], out[3 + x]) = (-by_chord[x] / length, first[x]);
        (out[6 + x], out[9 + x]) = (by_chord[x] / length, last[x]);
    }
}

/// Returns the entry of the Hessian of E between two of r_i, t_i, r_j, t_j: that of each axis.
pub(super) fn elongation_hessian(row: usize, column: usize, length: f64) -> f64 {
    // which of c, t_i, t_j, and by what factor
    let of = |k: usize| [(0, -1.0 / length), (1, 1.0), (0, 1.0 / length), (2, 1.0)][k];
    let ((a, f), (b, g)) = (of(row), of(column));
    length * f * g * PRODUCTS[a][b]
}

/// Returns the elongation in m of an element without stress, `(f0^2 - 1)/2 l` with its rest stretch
/// f0.
pub(super) fn rest_elongation(shape: Option<&RestShape>, elements: &[Element], e: usize) -> f64 {
    let Some(shape) = shape else { return 0.0 };
    let (before, length) = (elements[..e].iter().map(|element| element.length).sum::<f64>(), elements[e].length);
    let stretch = shape.at(before + 0.5 * length).0;
    0.5 * (stretch * stretch - 1.0) * length
}
