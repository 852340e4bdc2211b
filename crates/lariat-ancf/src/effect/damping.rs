//! Internal damping after Kelvin and Voigt: stress = E (strain + time * strain rate), for stretch
//! and bending.
//!
//! # Equation
//!
//! The dissipation function of an element and its force, in Gram numbers g, their rates g' and the
//! velocities v of the control vectors:
//!
//! ```text
//! R = 1/2 EA tau_a int eps'^2 + 1/2 EI tau_b int kappa'^2          F = -dR/dq'          power 2R
//! 1/2 EA tau int eps'^2 = tau EA l/8 g'.A g'                       n = tau (EA l/4) A g'
//! kappa'^2 = (4/l^2) ((1 - phi) w'^2/(4 w) + phi |k'|^2)           w = (kappa l/2)^2, k' = (l/2) (r'')'/Q
//! phi = (1 - w/e)^3 where w < e, else 0
//! ```
//!
//! A is the axial rule's matrix, the points are those of the bending rule (three for T1, T2). An
//! element that is bent (w >= e) is damped by the rate of the *scalar* curvature: only g and g'
//! enter, so rigid motion makes no force, to the last bit of g' = 0. A nearly straight one is
//! damped by the rate of the curvature *vector*, which is what a small vibration about the straight
//! line needs. In a plane both are the same and the force is EI tau kappa', without a kink where
//! the curvature passes through zero. Both vanish at zero velocity.
//!
//! The derivative of the force by velocity is exact. By position the step takes the part that keeps
//! its matrix symmetric: the geometric stiffness of the viscous stress, of bending that across the
//! curvature and where it stiffens (along it, the derivative of g' cancels it). Left out is C
//! (dg'/dq), which is unsymmetric; its symmetric half would make stiff matrices indefinite. The
//! exact derivative is [`Cable::jacobians`](crate::coupling::Linearisation::jacobians)'s.
//!
//! Over a step of the [discrete gradient](crate::integrate::discrete_gradient) the moment `m = EI
//! tau D kappa/h` acts along the mean n of the curvature, and its derivative by the curvature
//! vector k is `EI tau/h n n^T + m (1 - n n^T)/(2 |k|)`. The tangent takes both while m resists
//! bending further, with `N(P_g)/Q^3`, never negative, for the second, and what that has along n
//! taken from the first: `D w <= 4 w` then, so at least a part stays, and the matrix is never less
//! definite. Where an element straightens, m < 0, the second makes it indefinite, a strut that
//! buckles sideways: it is left out, and the iteration is a modified one. The force is the same.
//! The second is taken near contacts, and where a step had to be divided, alone: it also resists
//! rotation of the curvature, which costs nothing, and elsewhere a step is accepted with what one
//! iteration leaves: damped ropes on rotors of 0.86 rad per step pull 1.1 % too much with it and
//! 0.25 % without (`moving_ends.rs` of lariat-rapier).
//!
//! # Validity
//!
//! Damping ratio tau omega/2: it grows with frequency. The scalar curvature does not change when
//! the curvature rotates about the axis: the cable may spin freely about its own axis, as an
//! element without twist does. e = 1e-7: an element that bends by less than 6e-4 rad and spins
//! about its axis by omega heats up, by at most 0.42 e EI tau omega^2/l in W (the maximum of phi w
//! is 0.105 e); by nothing where it is straight or bent further.
//!
//! A section whose [axial law](super::axial_law) cannot push is not damped where it is slack.
//!
//! # References
//!
//! Garcia-Vallejo, Valverde & Dominguez, Nonlinear Dyn. 42 (2005) 347 (internal damping of ANCF
//! beams by the rates of Green strain and of the scalar curvature); the vector rate is that of the
//! linear beam.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/elements.md.

use super::acts::{Acts, ElementForce, Nothing, SampledPoint};
use super::axial_law::{LawTable, Taut};
use super::curvature::{self, Point, Squared};
use super::{Cut, Effect, Target};
use crate::Real;
use crate::element::gram::{Control, contract, dot, gradient, quadratic_form};
use crate::element::kernel::{DiscreteGradientForce, Gradient, GramForce, GramState, GramStep, Hessian, Load};
use crate::element::step::combined;
use crate::error::{Error, Requirement, require};
use crate::rule::AxialRule;
use crate::scales::effect::{NOISE, STRAIGHT};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Kelvin-Voigt times: the time that the rate of strain must last to double the stress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Damping {
    /// Time of the axial strain in s, >= 0.
    pub axial: f64,
    /// Time of the curvature in s, >= 0.
    pub bending: f64,
}

impl Damping {
    /// Returns the times in s that damp a mode of this angular frequency (rad/s) with this damping
    /// ratio: 2 ratio/omega, for both kinds. Valid for a mode whose restoring force is elastic;
    /// where gravity or tension restores, less of the energy is strain. By the number of a mode:
    /// [`Cable::damping_at_mode`](crate::coupling::Linearisation::damping_at_mode).
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a ratio below 0 or a frequency that is not positive.
    pub fn from_ratio(ratio: f64, angular_frequency: f64) -> Result<Self, Error> {
        require("damping ratio", ratio, ratio >= 0.0, ">= 0")?;
        require("angular frequency (rad/s)", angular_frequency, angular_frequency > 0.0, "> 0")?;
        let time = 2.0 * ratio / angular_frequency;
        Ok(Damping { axial: time, bending: time })
    }

    /// Returns the damping ratio of an elastic mode of this angular frequency (rad/s) by the
    /// bending time: tau omega/2.
    pub fn bending_ratio(&self, angular_frequency: f64) -> f64 {
        0.5 * self.bending * angular_frequency
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

    fn is_steady(&self, _from: f64, _to: f64) -> bool {
        true
    }

    fn cut(&self, _: Cut<'_>) -> [Option<Self>; 2] {
        [Some(*self); 2]
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

impl Acts for Damping {
    type InElement = DampingTable;
    type AtPoints = Nothing;

    fn in_element(&self, cable: &Target<'_>) -> Option<DampingTable> {
        let points = if self.bending > 0.0 { curvature::points_of(cable.rule.bending) } else { Vec::new() };
        Some(DampingTable { damping: *self, points, taut: None })
    }
}

/// Damping as the kernel needs it.
#[derive(Clone, Debug)]
pub(crate) struct DampingTable {
    damping: Damping,
    /// Points of bending; empty if it is not damped.
    points: Vec<Point>,
    /// The axial part of a law that cannot push.
    taut: Option<Box<Taut>>,
}

impl GramForce for DampingTable {
    #[inline(always)]
    fn needs_rates(&self) -> bool {
        true
    }

    #[inline(always)]
    fn add_gradient<T: Real, L: Load<T>>(&self, at: &GramState<'_, T>, _: &L, sum: &mut Gradient<T>) {
        let Some(rates) = &at.rates else { return };
        match &self.taut {
            Some(taut) => taut.add_gradient(at, rates, self.damping.axial, sum),
            None => at.table.add_product(rates, at.stiffness.axial * self.damping.axial, &mut sum.n),
        }
        for point in &self.points {
            let w = point.squared(&at.g);
            let scale = at.stiffness.bending * (0.5 * self.damping.bending * point.weight);
            let shares = Shares::new(w.w);
            w.add_gradient(scale * shares.scalar * w.rate(rates), &mut sum.n);
            point.add_second_derivative(scale * shares.vector * w.inverse * w.inverse, &mut sum.viscous);
        }
    }

    #[inline(always)]
    fn add_hessian<T: Real, L: Load<T>>(
        &self,
        at: &GramState<'_, T>,
        rate: f64,
        _: &L,
        sum: &mut Gradient<T>,
        tangent: &mut Hessian<T>,
    ) {
        let Some(rates) = &at.rates else { return };
        match &self.taut {
            Some(taut) => taut.add_hessian((at, rates), [self.damping.axial, rate], sum, tangent),
            None => {
                let axial = at.stiffness.axial * self.damping.axial;
                at.table.add_product(rates, axial, &mut sum.n);
                at.table.add_product(rates, axial, &mut tangent.geometric);
                at.table.add_hessian(axial * rate, &mut tangent.h);
            }
        }
        let mut viscous = [at.g[0].splat(0.0); 6];
        for point in &self.points {
            let w = point.squared(&at.g);
            let scale = at.stiffness.bending * (0.5 * self.damping.bending * point.weight);
            let shares = Shares::new(w.w);
            let moment = scale * shares.scalar * w.rate(rates);
            w.add_gradient(moment, &mut sum.n);
            let stiffening = (moment + moment.abs()) * 0.5;
            w.add_gradient(stiffening, &mut tangent.geometric);
            point.add_second(&at.g, &w, stiffening, &mut tangent.h);
            w.add_square(scale * shares.scalar * rate - stiffening * 0.5 / (w.w + NOISE), &mut tangent.h);
            point.add_second_derivative(scale * shares.vector * w.inverse * w.inverse, &mut viscous);
        }
        for i in 0..6 {
            sum.viscous[i] = sum.viscous[i] + viscous[i];
            tangent.geometric[i] = tangent.geometric[i] + viscous[i] * rate;
        }
    }
}

impl DiscreteGradientForce for DampingTable {
    /// Every term is the square of a product with the change of the Gram numbers or of the control
    /// vectors, so the step dissipates exactly, whatever its length.
    #[inline(always)]
    fn add_discrete_gradient<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, _: &L, sum: &mut Gradient<T>) -> T {
        let mut power = match &self.taut {
            Some(taut) => taut.add_discrete_gradient(at, self.damping.axial, sum),
            None => {
                let mut stress = [at.rates[0].splat(0.0); 6];
                at.table.add_product(&at.rates, at.stiffness.axial * self.damping.axial, &mut stress);
                sum.n = combined(&sum.n, &stress, 1.0);
                contract(&stress, &at.rates)
            }
        };
        self.bending(
            at,
            #[inline(always)]
            |point, w, scalar, vector| {
                let rate = w.rate(&at.rates);
                w.add_gradient(scalar * rate, &mut sum.n);
                power = power + scalar * rate * rate;
                point.add_second_derivative(vector, &mut sum.viscous);
            },
        );
        power
    }

    #[inline(always)]
    fn add_step_tangent<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, _: &L, tangent: &mut Hessian<T>) {
        match &self.taut {
            Some(taut) => taut.add_step_tangent(at, self.damping.axial, tangent),
            None => at.table.add_hessian(at.stiffness.axial * (self.damping.axial * at.rate), &mut tangent.h),
        }
        self.bending(
            at,
            #[inline(always)]
            |point, w, scalar, vector| {
                // at the middle of the step, which moves half as far as its end
                let moment = scalar * w.rate(&at.rates) * (0.5 * at.across);
                let stiffening = (moment + moment.abs()) * 0.5;
                w.add_minor(stiffening, &mut tangent.geometric);
                w.add_square((scalar * at.rate - stiffening * 0.5 / (w.w + NOISE)).at_least(0.0), &mut tangent.h);
                point.add_second_derivative(vector * at.rate, &mut tangent.geometric);
            },
        );
    }

    #[inline(always)]
    fn add_rest_strain<T: Real, L: Load<T>>(&self, _: T, _: &L, _: &mut T) {}

    #[inline(always)]
    fn add_rest_energy<T: Real, L: Load<T>>(&self, _: T, _: &L, _: &mut T) {}
}

impl DampingTable {
    /// Damps a section of this law and rule.
    pub(crate) fn follow(&mut self, law: &LawTable, rule: AxialRule) {
        self.taut = if self.damping.axial > 0.0 { Taut::of(law, rule).map(Box::new) } else { None };
    }

    /// Visits the points of bending with the squared curvature and the factors of its scalar and
    /// vector rates.
    #[inline(always)]
    fn bending<T: Real>(&self, at: &GramStep<'_, T>, mut visit: impl FnMut(&Point, &Squared<T>, T, T)) {
        for point in &self.points {
            let w = point.squared(&at.middle);
            let scale = at.stiffness.bending * (0.5 * self.damping.bending * point.weight);
            let shares = Shares::new(w.w);
            visit(point, &w, scale * shares.scalar, scale * shares.vector * w.inverse * w.inverse);
        }
    }
}

impl ElementForce for DampingTable {
    fn dissipates(&self) -> bool {
        true
    }

    /// Returns the power -2R.
    fn power(&self, at: &GramState<'_, f64>, v: &Control<f64>) -> f64 {
        let Some(rates) = &at.rates else { return 0.0 };
        let axial = match &self.taut {
            Some(taut) => taut.power(at, rates, self.damping.axial),
            None => at.stiffness.axial * self.damping.axial * quadratic_form(&at.table.matrix, rates, rates),
        };
        let bending = self.points.iter().map(|point| {
            let w = point.squared(&at.g);
            let (rate, shares) = (w.rate(rates), Shares::new(w.w));
            let mut pairs = [0.0; 6];
            point.add_second_derivative(shares.vector * w.inverse * w.inverse, &mut pairs);
            let force = gradient(&pairs, v);
            let vector: f64 = (0..3).map(|i| dot(&force[i], &v[i])).sum();
            0.5 * self.damping.bending * point.weight * (shares.scalar * rate * rate + vector)
        });
        -(axial + at.stiffness.bending * bending.sum::<f64>())
    }

    fn strain(&self, _: usize, xi: f64, at: &GramState<'_, f64>) -> f64 {
        let Some(rates) = &at.rates else { return 0.0 };
        if let Some(taut) = &self.taut {
            return taut.strain(at, rates, xi, self.damping.axial);
        }
        // linear in the Gram numbers, and -1/2 at zero
        self.damping.axial * (at.table.strain(rates, xi) + 0.5)
    }

    fn curvature(&self, at: &SampledPoint<'_>) -> Vector3<f64> {
        let Some(rates) = at.at.rates.as_ref().filter(|_| self.damping.bending > 0.0) else { return Vector3::zeros() };
        let w = Point::at(at.xi, 1.0).squared(&at.at.g);
        let shares = Shares::new(w.w);
        let scalar = 0.5 * self.damping.bending * w.rate(rates) * shares.scalar;
        let vector = 0.25 * self.damping.bending * shares.vector;
        at.curvature * scalar + at.vector_rate * (vector * at.power)
    }
}

/// Shares of the scalar and of the vector of curvature in the rate of bending.
struct Shares<T> {
    /// (1 - phi)/w.
    scalar: T,
    /// 4 phi.
    vector: T,
}

impl<T: Real> Shares<T> {
    #[inline(always)]
    fn new(w: T) -> Self {
        // (1 - y^3)/(1 - y) = 1 + y + y^2, y = 1 - w/e
        let y = (w * (-1.0 / STRAIGHT) + 1.0).at_least(0.0);
        let square = y * y;
        Shares { scalar: (square + y + 1.0) / w.at_least(STRAIGHT), vector: square * y * 4.0 }
    }
}
