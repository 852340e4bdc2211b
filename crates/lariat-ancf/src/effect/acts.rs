//! How effects enter the equations of motion: by constants, within the element kernel, or at Gauss
//! points.

use super::{Effect, Target};
use crate::dual::{Dual, Slope};
use crate::element::gram::Control;
use crate::element::kernel::{DiscreteGradientForce, Gradient, GramForce, GramState, GramStep, Hessian, Load};
use crate::linalg::BlockTridiagonal;
use crate::one_leg::OneLeg;
use crate::real::Real;
use crate::section::Section;
use core::fmt::Debug;
use fearless_simd::Level;
use nalgebra::Vector3;

/// How an effect acts. Every method has a default: not at all.
pub(crate) trait Acts: Effect {
    /// Its tables for the element kernel; [`Nothing`] if it does not act there.
    type InElement: ElementForce;
    /// Its tables for Gauss points; [`Nothing`] if it does not act there.
    type AtPoints: PointForce;

    /// Tables for the element kernel.
    fn in_element(&self, _: &Target<'_>) -> Option<Self::InElement> {
        None
    }

    /// Tables for forces at Gauss points.
    fn at_points(&self, _: &Target<'_>) -> Option<Self::AtPoints> {
        None
    }

    /// Mass per length in kg/m that it adds to the inertia of a section.
    fn added_mass(&self, _: &Section) -> f64 {
        0.0
    }

    /// Mass per length in kg/m that it takes from the weight of a section.
    fn displaced_mass(&self, _: &Section) -> f64 {
        0.0
    }

    /// Factor on gravity.
    fn gravity_factor(&self) -> f64 {
        1.0
    }

    /// Constant generalised force; empty for none.
    fn dead_force(&self, _: &Target<'_>) -> Vec<f64> {
        Vec::new()
    }

    /// Adds the resultant of its constant forces in N, and their sizes.
    fn add_resultant(&self, _: &Target<'_>, _: &mut Vector3<f64>, _: &mut f64) {}
}

/// The arguments of a force evaluation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ForceInput<'a> {
    /// Time in s.
    pub time: f64,
    /// Nodal coordinates.
    pub q: &'a [f64],
    /// Nodal velocities; empty for a cable at rest.
    pub v: &'a [f64],
    /// Derivative of the velocities by the coordinates in 1/s, for the step matrix.
    pub dv_dq: f64,
    /// Factor on the force and its derivatives.
    pub scale: f64,
}

/// The arguments of a force over a step of the [discrete
/// gradient](crate::integrate::discrete_gradient).
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepInput<'a> {
    /// Time in the middle of the step in s.
    pub time: f64,
    /// Mean coordinates of the iterate.
    pub middle: &'a [f64],
    /// Mean velocities of the iterate: the change of the coordinates over h.
    pub velocity: &'a [f64],
    /// Mean coordinates of the iterate about which the last linear solve was made; those of the
    /// present one before the first.
    pub middle_before: &'a [f64],
    /// Mean velocities of that iterate.
    pub velocity_before: &'a [f64],
    /// Length of the step in s.
    pub h: f64,
    /// Its formula.
    pub leg: OneLeg,
}

/// Loads the numbers of a single element.
pub(crate) struct Single(pub usize);

impl Load<f64> for Single {
    fn load(&self, by_element: &[f64]) -> f64 {
        by_element[self.0]
    }
}

impl<S: Slope> Load<Dual<S>> for Single {
    fn load(&self, by_element: &[f64]) -> Dual<S> {
        crate::dual::constant(by_element[self.0])
    }
}

/// A point of an element at which curvature is read.
pub(crate) struct SampledPoint<'a> {
    pub element: usize,
    /// Local coordinate in `[0, 1]`.
    pub xi: f64,
    /// Length of the element in m.
    pub length: f64,
    pub at: GramState<'a, f64>,
    /// Curvature vector r' x r'' |r'|^-3 in 1/m, with the power of the bending rule.
    pub curvature: Vector3<f64>,
    /// r' x (r'')' in 1/(m s).
    pub vector_rate: Vector3<f64>,
    /// |r'|^-3 with the power of the bending rule.
    pub power: f64,
}

/// An effect within the element kernel.
pub(crate) trait ElementForce: GramForce + DiscreteGradientForce + Clone + Debug {
    /// Axial and bending energy in J that it adds to an element.
    fn energy(&self, _element: usize, _at: &GramState<'_, f64>) -> (f64, f64) {
        (0.0, 0.0)
    }

    /// The parts of this energy that grow with the length of an element, and with its inverse,
    /// while its control vectors stay; of what is left is the force [`on_length`](Self::on_length).
    fn energy_by_length(&self, element: usize, at: &GramState<'_, f64>) -> (f64, f64) {
        self.energy(element, at)
    }

    /// Force in N on the length of an element of the bending stiffness `flexural` (N m^2) over a
    /// step, of the energy that is not [by length](Self::energy_by_length), at control vectors that
    /// stay: these, and lengths in m, when it begins and ends.
    fn on_length(&self, _element: usize, _flexural: f64, _d: [&Control<f64>; 2], _lengths: [f64; 2]) -> f64 {
        0.0
    }

    /// Sets the length of an element over a step: its mean in m, and the mean of its inverse.
    /// Default: it has no part in the tables.
    fn set_length_over(&mut self, _element: usize, _mean: f64, _inverse: f64) {}

    /// Whether it dissipates.
    fn dissipates(&self) -> bool {
        false
    }

    /// Power in W that it gives to an element with velocities `v` of the control vectors; negative
    /// where it dissipates.
    fn power(&self, _at: &GramState<'_, f64>, _v: &Control<f64>) -> f64 {
        0.0
    }

    /// Strain that it adds at a local coordinate of an element to the one that makes tension.
    fn strain(&self, element: usize, xi: f64, at: &GramState<'_, f64>) -> f64;

    /// Curvature in 1/m that it adds to the one that makes the bending moment.
    fn curvature(&self, at: &SampledPoint<'_>) -> Vector3<f64>;
}

/// A force per length, integrated at Gauss points.
pub(crate) trait PointForce: Clone + Debug {
    /// Adds its generalised force to `out`, and its negative derivative to `matrix` if that is
    /// asked for.
    fn add(&mut self, level: Level, input: ForceInput<'_>, out: &mut [f64], matrix: Option<&mut BlockTridiagonal>);

    /// Adds its generalised force on an element, in dual numbers.
    fn add_dual(&self, element: usize, time: f64, q: &[Dual; 12], v: &[Dual; 12], out: &mut [Dual; 12]);

    /// Adds its generalised force over a step to `out`, and to `matrix` b h^2 times its negative
    /// derivative by the change of the coordinates if that is asked for. Default: the force at the
    /// mean configuration and velocity of the iterate, with its own derivative.
    fn add_over_step(
        &mut self,
        level: Level,
        step: StepInput<'_>,
        out: &mut [f64],
        matrix: Option<&mut BlockTridiagonal>,
    ) {
        let StepInput { time, middle: q, velocity: v, h, leg, .. } = step;
        // the mean configuration changes by half the change, the velocity by 2/h of that
        let input = ForceInput { time, q, v, dv_dq: 2.0 / h, scale: 1.0 };
        let Some(matrix) = matrix else {
            return self.add(level, input, out, None);
        };
        let scale = 0.5 * leg.b * h * h;
        out.iter_mut().for_each(|f| *f *= scale);
        self.add(level, ForceInput { scale, ..input }, out, Some(matrix));
        out.iter_mut().for_each(|f| *f *= 1.0 / scale);
    }

    /// Sets the length of an element in m: that at the eye of a reel changes. Default: it never
    /// does.
    fn set_length(&mut self, _element: usize, _length: f64) {}

    /// Whether it can move a cable at rest although it has no potential.
    fn drives(&self) -> bool;

    /// Makes it steady from now on: as it is at `time` (s).
    fn hold(&mut self, time: f64);

    /// Multiplies what it [drives](Self::drives) with by a share, as the velocity of a flow, once
    /// it is held. Default: nothing drives.
    fn drive_by(&mut self, _share: f64) {}
}

/// The tables of an effect that does not act in a place.
#[derive(Clone, Debug)]
pub(crate) enum Nothing {}

impl GramForce for Nothing {
    fn needs_rates(&self) -> bool {
        match *self {}
    }
    #[inline(always)]
    fn add_gradient<T: Real, L: Load<T>>(&self, _: &GramState<'_, T>, _: &L, _: &mut Gradient<T>) {
        match *self {}
    }
    #[inline(always)]
    fn add_hessian<T: Real, L: Load<T>>(
        &self,
        _: &GramState<'_, T>,
        _: f64,
        _: &L,
        _: &mut Gradient<T>,
        _: &mut Hessian<T>,
    ) {
        match *self {}
    }
}

impl DiscreteGradientForce for Nothing {
    #[inline(always)]
    fn add_discrete_gradient<T: Real, L: Load<T>>(&self, _: &GramStep<'_, T>, _: &L, _: &mut Gradient<T>) -> T {
        match *self {}
    }
    #[inline(always)]
    fn add_step_tangent<T: Real, L: Load<T>>(&self, _: &GramStep<'_, T>, _: &L, _: &mut Hessian<T>) {
        match *self {}
    }
    #[inline(always)]
    fn add_rest_strain<T: Real, L: Load<T>>(&self, _: T, _: &L, _: &mut T) {
        match *self {}
    }
    #[inline(always)]
    fn add_rest_energy<T: Real, L: Load<T>>(&self, _: T, _: &L, _: &mut T) {
        match *self {}
    }
}

impl ElementForce for Nothing {
    fn strain(&self, _: usize, _: f64, _: &GramState<'_, f64>) -> f64 {
        match *self {}
    }
    fn curvature(&self, _: &SampledPoint<'_>) -> Vector3<f64> {
        match *self {}
    }
}

impl PointForce for Nothing {
    fn add(&mut self, _: Level, _: ForceInput<'_>, _: &mut [f64], _: Option<&mut BlockTridiagonal>) {
        match *self {}
    }
    fn add_dual(&self, _: usize, _: f64, _: &[Dual; 12], _: &[Dual; 12], _: &mut [Dual; 12]) {
        match *self {}
    }
    fn drives(&self) -> bool {
        match *self {}
    }
    fn hold(&mut self, _: f64) {
        match *self {}
    }
}
