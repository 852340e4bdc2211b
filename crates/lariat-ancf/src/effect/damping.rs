//! Internal damping after Kelvin and Voigt: stress = E (strain + time * strain rate), for stretch and bending.
//!
//! The dissipation function of an element and the force it makes, in Gram numbers g and their rates g':
//!
//! ```text
//! R = 1/2 EA tau_a int eps'^2 + 1/2 EI tau_b int kappa'^2          F = -dR/dq'          power 2R
//! 1/2 EA tau int eps'^2 = tau EA l/8 g'.A g'                       kappa'^2 = w'^2/(l^2 w), w = (kappa l/2)^2
//! n = tau (EA l/4) A g' + (2 EI/l) tau sum_q w_q w'/(2 (w + e)) w_g
//! d n/d g' = tau (EA l/4) A + (2 EI/l) tau sum_q w_q/(2 (w + e)) w_g w_g^T
//! ```
//!
//! A is the axial rule's own matrix, the points are those of the bending rule (three for T1, T2). Only g and g' enter, so rigid motion
//! makes no force to the last bit of g' = 0, and at rest nothing is left of it.
//!
//! *Source.* Garcia-Vallejo, Valverde & Dominguez, Nonlinear Dyn. 42 (2005) 347 (internal damping of ANCF beams by the rates of Green
//! strain and of the scalar curvature). *Validity.* Damping ratio tau omega/2: it grows with frequency. e = 2.5e-12: a curvature that turns
//! the cable by less than 3e-6 rad per element is not damped in bending, and of a bending vibration of curvature k about the straight
//! line a share of about 6e-6/(k l) is missing. The scalar curvature sees a curvature that *turns about the axis* as no change: this is
//! the cable that may spin freely in its own axis, which is what an element without twist is.
//!
//! *No choice.* A dissipation that is continuous, vanishes in every rigid motion and knows positions alone must vanish at the straight
//! cable, because any transverse velocity of a straight cable is the limit of a fast spin of a slightly curved one about its axis.
//! *Rejected.* The rate of the curvature vector: smooth at the straight cable, and a spinning bent cable heats up. Rayleigh damping by the
//! mass matrix: it damps falling.
//!
//! *Tangent.* By velocity exact. By position the step takes the part that keeps its matrix symmetric: geometric
//! stiffness of the viscous stress (of bending: where it stiffens). Left out is C (dg'/dq), unsymmetric; its symmetric half, taken in, makes
//! stiff matrices indefinite. The exact derivative is [`Cable::jacobians`](crate::Cable::jacobians)'s. *Rejected* for the step: with it Newton
//! saves 2 to 8 % of its iterations on a rod damped by 1 to 10 ms, 19 to 28 % at an axial time of 1 s, and takes 10 to 23 % more on damped
//! steel (table and command: [`exact`](crate::cable::exact)). Times far beyond the step on a stiff, nearly
//! straight cable cost rejected steps: there the direction of the curvature, and with it C, turns within a step.

use super::curvature::Point;
use crate::Real;
use crate::axial::AxialTable;
use crate::element::gram::{Control, PAIR_WEIGHT, Six, Upper, dot, quadratic_form};
use crate::element::kernel::Stiffness;
use crate::error::{Error, require};
use serde::{Deserialize, Serialize};

/// Square of half the turn per element, in rad, below which bending is not damped.
const LEAST_SQUARE: f64 = 2.5e-12;

/// Kelvin-Voigt times: how long the rate of strain must last to double the stress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Damping {
    /// Time of the axial strain in s, >= 0.
    pub axial: f64,
    /// Time of the curvature in s, >= 0.
    pub bending: f64,
}

impl Damping {
    /// The time in s that damps a mode of this angular frequency (rad/s) with this damping ratio: 2 ratio/omega, for both kinds. By the
    /// number of a mode: [`Cable::damping_at_mode`](crate::Cable::damping_at_mode).
    ///
    /// *Validity.* A mode whose restoring force is elastic; where gravity or tension restores, less of the energy is strain.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a ratio below 0 or a frequency that is not positive.
    pub fn from_ratio(ratio: f64, angular_frequency: f64) -> Result<Self, Error> {
        require("damping ratio", ratio, ratio >= 0.0, ">= 0")?;
        require("angular frequency (rad/s)", angular_frequency, angular_frequency > 0.0, "> 0")?;
        let time = 2.0 * ratio / angular_frequency;
        Ok(Damping { axial: time, bending: time })
    }

    /// Damping ratio of an elastic mode of this angular frequency (rad/s) by the bending time: tau omega/2.
    pub fn bending_ratio(&self, angular_frequency: f64) -> f64 {
        0.5 * self.bending * angular_frequency
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        require("axial damping time (s)", self.axial, self.axial >= 0.0, ">= 0")?;
        require("bending damping time (s)", self.bending, self.bending >= 0.0, ">= 0")
    }

    /// Adds the viscous part to the weighted gradient `n`.
    #[inline(always)]
    pub(crate) fn add_gradient<T: Real>(
        &self,
        table: &AxialTable,
        points: &[Point],
        stiffness: Stiffness<T>,
        g: &Six<T>,
        rates: &Six<T>,
        n: &mut Six<T>,
    ) {
        table.add_product(rates, stiffness.axial * self.axial, n);
        for point in points {
            let at = point.squared(g);
            let scale = stiffness.bending * (0.5 * self.bending * point.weight) / (at.w + LEAST_SQUARE);
            at.add_gradient(scale * at.rate(rates), n);
        }
    }

    /// Adds the viscous part to the weighted gradient `n`, what of it is geometric stiffness to `geometric` and `h`, and the
    /// derivative by velocity times `rate` to `h`.
    #[inline(always)]
    pub(crate) fn add_hessian<T: Real>(
        &self,
        table: &AxialTable,
        points: &[Point],
        stiffness: Stiffness<T>,
        g: &Six<T>,
        rates: &Six<T>,
        rate: f64,
        [n, geometric]: [&mut Six<T>; 2],
        h: &mut Upper<T>,
    ) {
        let axial = stiffness.axial * self.axial;
        table.add_product(rates, axial, n);
        table.add_product(rates, axial, geometric);
        table.add_hessian(axial * rate, h);
        for point in points {
            let at = point.squared(g);
            let scale = stiffness.bending * (0.5 * self.bending * point.weight) / (at.w + LEAST_SQUARE);
            let moment = scale * at.rate(rates);
            at.add_gradient(moment, n);
            at.add_square(scale * rate, h);
            let stiffening = (moment + moment.abs()) * 0.5;
            at.add_gradient(stiffening, geometric);
            point.add_second(g, &at, stiffening, h);
        }
    }

    /// `tau kappa'/kappa` at a place of an element.
    pub(crate) fn moment_share(&self, xi: f64, g: &Six<f64>, rates: &Six<f64>) -> f64 {
        let at = Point::at(xi, 1.0).squared(g);
        0.5 * self.bending * at.rate(rates) / (at.w + LEAST_SQUARE)
    }

    /// Power 2R in W that an element turns into heat.
    pub(crate) fn power(
        &self,
        table: &AxialTable,
        points: &[Point],
        stiffness: Stiffness<f64>,
        g: &Six<f64>,
        rates: &Six<f64>,
    ) -> f64 {
        let axial = stiffness.axial * self.axial * quadratic_form(&table.matrix, rates, rates);
        let bending = points.iter().map(|point| {
            let at = point.squared(g);
            let rate = at.rate(rates);
            0.5 * self.bending * point.weight * rate * rate / (at.w + LEAST_SQUARE)
        });
        axial + stiffness.bending * bending.sum::<f64>()
    }
}

/// Rates of the Gram numbers: `g'_ij = d_i . v_j + v_i . d_j`.
#[inline(always)]
pub(crate) fn gram_rates<T: Real>(d: &Control<T>, v: &Control<T>) -> Six<T> {
    let twice = |i: usize| dot(&d[i], &v[i]) * PAIR_WEIGHT[0];
    let pair = |i: usize, j: usize| dot(&d[i], &v[j]) + dot(&v[i], &d[j]);
    [twice(0), pair(0, 1), pair(0, 2), twice(1), pair(1, 2), twice(2)]
}
