//! Internal damping after Kelvin and Voigt: stress = E (strain + time * strain rate), for stretch and bending.
//!
//! The dissipation function of an element and the force it makes, in Gram numbers g, their rates g' and the velocities v of the control vectors:
//!
//! ```text
//! R = 1/2 EA tau_a int eps'^2 + 1/2 EI tau_b int kappa'^2          F = -dR/dq'          power 2R
//! 1/2 EA tau int eps'^2 = tau EA l/8 g'.A g'                       n = tau (EA l/4) A g'
//! kappa'^2 = (4/l^2) ((1 - phi) w'^2/(4 w) + phi |k'|^2)           w = (kappa l/2)^2, k' = (l/2) (r'')'/Q
//! phi = (1 - w/e)^3 where w < e, else 0
//! ```
//!
//! A is the axial rule's own matrix, the points are those of the bending rule (three for T1, T2). An element that is bent (w >= e) is damped by
//! the rate of the *scalar* curvature: only g and g' enter, so rigid motion makes no force to the last bit of g' = 0. A nearly straight one
//! is damped by the rate of the curvature *vector*, which is what a small vibration about the straight line needs. In a plane both are the same and
//! the force is EI tau kappa', without a kink where the curvature passes through zero. At rest nothing is left of either.
//!
//! *Source.* Garcia-Vallejo, Valverde & Dominguez, Nonlinear Dyn. 42 (2005) 347 (internal damping of ANCF beams by the rates of Green
//! strain and of the scalar curvature); the vector rate is that of the linear beam. *Validity.* Damping ratio tau omega/2: it grows with
//! frequency. The scalar curvature sees a curvature that *turns about the axis* as no change: this is the cable that may spin freely in its own
//! axis, which is what an element without twist is. e = 1e-7: an element that turns the cable by less than 6e-4 rad and spins about its
//! axis by omega heats up, by at most 0.42 e EI tau omega^2/l in W (max of phi w is 0.105 e); 0 where it is straight or bent further.
//!
//! *Rejected.* The scalar rate for all curvatures (e = 0): a dissipation of g and g' alone must vanish at the straight cable, because any
//! transverse velocity of a straight cable is the limit of a fast spin of a slightly bent one. The force then is EI tau times the rate along a
//! direction that turns arbitrarily fast where the curvature is small, and the step has to follow: 2 m of 10 mm steel rope in 200 elements, let go
//! from horizontal in a breeze, tau = 1 ms: 4111 steps for the first 1/60 s, against 39 for 30/60 s. The vector rate for all: smooth, and a spinning bent cable
//! heats up. Rayleigh damping by the mass matrix: it damps falling.
//!
//! *Tangent.* By velocity exact. By position the step takes the part that keeps its matrix symmetric: geometric
//! stiffness of the viscous stress, of bending that across the curvature and where it stiffens (along it, what g' adds cancels it). Left out is C (dg'/dq),
//! unsymmetric; its symmetric half, taken in, makes stiff matrices indefinite. The exact derivative is
//! [`Cable::jacobians`](crate::Cable::jacobians)'s; what Newton's iteration would save with it is in the table of [`exact`](crate::cable::exact).

use super::curvature::{NOISE, Point};
use super::{Cut, Effect, Target};
use crate::Real;
use crate::axial::AxialTable;
use crate::element::gram::{Control, PAIR_WEIGHT, Six, Upper, dot, gradient, gram, quadratic_form};
use crate::element::kernel::Stiffness;
use crate::error::{Error, Requirement, require};
use serde::{Deserialize, Serialize};

/// e: square of half the turn per element, in rad, below which the curvature is damped as a vector.
const STRAIGHT: f64 = 1e-7;

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

    /// Adds the viscous part to the weighted gradient `n`, and the pairs that act on the velocities to `viscous`.
    #[inline(always)]
    pub(crate) fn add_gradient<T: Real>(
        &self,
        table: &AxialTable,
        points: &[Point],
        stiffness: Stiffness<T>,
        g: &Six<T>,
        rates: &Six<T>,
        [n, viscous]: [&mut Six<T>; 2],
    ) {
        table.add_product(rates, stiffness.axial * self.axial, n);
        for point in points {
            let at = point.squared(g);
            let scale = stiffness.bending * (0.5 * self.bending * point.weight);
            let shares = Shares::of(at.w);
            at.add_gradient(scale * shares.scalar * at.rate(rates), n);
            point.add_second_derivative(scale * shares.vector * at.inverse * at.inverse, viscous);
        }
    }

    /// Adds the viscous part to the weighted gradient `n`, what of it is geometric stiffness to `geometric` and `h`, the derivative by
    /// velocity times `rate` to `h`, and the pairs that act on the velocities to `viscous`: times `rate` they are geometric too.
    #[inline(always)]
    pub(crate) fn add_hessian<T: Real>(
        &self,
        table: &AxialTable,
        points: &[Point],
        stiffness: Stiffness<T>,
        g: &Six<T>,
        rates: &Six<T>,
        rate: f64,
        [n, geometric, viscous]: [&mut Six<T>; 3],
        h: &mut Upper<T>,
    ) {
        let axial = stiffness.axial * self.axial;
        table.add_product(rates, axial, n);
        table.add_product(rates, axial, geometric);
        table.add_hessian(axial * rate, h);
        for point in points {
            let at = point.squared(g);
            let scale = stiffness.bending * (0.5 * self.bending * point.weight);
            let shares = Shares::of(at.w);
            let moment = scale * shares.scalar * at.rate(rates);
            at.add_gradient(moment, n);
            let stiffening = (moment + moment.abs()) * 0.5;
            at.add_gradient(stiffening, geometric);
            point.add_second(g, &at, stiffening, h);
            at.add_square(scale * shares.scalar * rate - stiffening * 0.5 / (at.w + NOISE), h);
            point.add_second_derivative(scale * shares.vector * at.inverse * at.inverse, viscous);
        }
    }

    /// `tau kappa'/kappa` at a place of an element, of the scalar curvature, and the share of the vector's rate.
    pub(crate) fn moment_shares(&self, xi: f64, g: &Six<f64>, rates: &Six<f64>) -> (f64, f64) {
        let at = Point::at(xi, 1.0).squared(g);
        let shares = Shares::of(at.w);
        (0.5 * self.bending * at.rate(rates) * shares.scalar, 0.25 * self.bending * shares.vector)
    }

    /// Power 2R in W that an element with velocities `v` turns into heat.
    pub(crate) fn power(
        &self,
        table: &AxialTable,
        points: &[Point],
        stiffness: Stiffness<f64>,
        d: &Control<f64>,
        v: &Control<f64>,
    ) -> f64 {
        let (g, rates) = (gram(d), gram_rates(d, v));
        let axial = stiffness.axial * self.axial * quadratic_form(&table.matrix, &rates, &rates);
        let bending = points.iter().map(|point| {
            let at = point.squared(&g);
            let (rate, shares) = (at.rate(&rates), Shares::of(at.w));
            let mut pairs = [0.0; 6];
            point.add_second_derivative(shares.vector * at.inverse * at.inverse, &mut pairs);
            let force = gradient(&pairs, v);
            let vector: f64 = (0..3).map(|i| dot(&force[i], &v[i])).sum();
            0.5 * self.bending * point.weight * (shares.scalar * rate * rate + vector)
        });
        axial + stiffness.bending * bending.sum::<f64>()
    }
}

impl Effect for Damping {
    const DISSIPATIVE: bool = true;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        require("axial damping time (s)", self.axial, self.axial >= 0.0, ">= 0")?;
        require("bending damping time (s)", self.bending, self.bending >= 0.0, ">= 0")?;
        if cable.has_no_bending() && self.bending > 0.0 {
            return Err(cable.missing("damping of bending", Requirement::BendingRule));
        }
        Ok(())
    }

    fn depends_on_velocity(&self) -> bool {
        true
    }

    fn has_exact_tangent(&self) -> bool {
        false
    }

    /// Internal damping lowers the stability limit of explicit methods far below any step.
    fn needs_implicit_integrator(&self) -> bool {
        true
    }

    fn cut(&self, _: Cut<'_>) -> [Option<Self>; 2] {
        [Some(*self); 2]
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

/// How the rate of bending is shared between the scalar and the vector of curvature.
struct Shares<T> {
    /// (1 - phi)/w.
    scalar: T,
    /// 4 phi.
    vector: T,
}

impl<T: Real> Shares<T> {
    #[inline(always)]
    fn of(w: T) -> Self {
        // (1 - y^3)/(1 - y) = 1 + y + y^2, y = 1 - w/e
        let y = (w * (-1.0 / STRAIGHT) + 1.0).at_least(0.0);
        let square = y * y;
        Shares { scalar: (square + y + 1.0) / w.at_least(STRAIGHT), vector: square * y * 4.0 }
    }
}

/// Rates of the Gram numbers: `g'_ij = d_i . v_j + v_i . d_j`.
#[inline(always)]
pub(crate) fn gram_rates<T: Real>(d: &Control<T>, v: &Control<T>) -> Six<T> {
    let twice = |i: usize| dot(&d[i], &v[i]) * PAIR_WEIGHT[0];
    let pair = |i: usize, j: usize| dot(&d[i], &v[j]) + dot(&v[i], &d[j]);
    [twice(0), pair(0, 1), pair(0, 2), twice(1), pair(1, 2), twice(2)]
}
