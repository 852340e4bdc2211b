//! The tables of all effects of a cable, made once when they are set: what an evaluation of the
//! force reads. An effect that is absent, or that does not act in a place, leaves no code there.

use super::acts::*;
use super::*;
use crate::dual::Dual;
use crate::element::gram::Control;
use crate::element::kernel::{DiscreteGradientForce, Gradient, GramForce, GramState, GramStep, Hessian, Load};
use crate::linalg::BlockTridiagonal;
use crate::real::Real;
use crate::section::Section;
use fearless_simd::Level;
use nalgebra::Vector3;

macro_rules! generate {
    ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => {
        impl Effects {
            /// Mass per length in kg/m that resists acceleration, beside that of the section.
            pub(crate) fn added_mass(&self, section: &Section) -> f64 {
                0.0 $(+ self.$field.as_ref().map_or(0.0, |effect| effect.added_mass(section)))*
            }

            /// Weight per length in N/m of a section.
            pub(crate) fn weight(&self, section: &Section, gravity: Vector3<f64>) -> Vector3<f64> {
                let factor = 1.0 $(* self.$field.as_ref().map_or(1.0, Acts::gravity_factor))*;
                let displaced = 0.0 $(+ self.$field.as_ref().map_or(0.0, |effect| effect.displaced_mass(section)))*;
                (factor * (section.mass_per_length - displaced)) * gravity
            }

            /// Factor on gravity.
            pub(crate) fn gravity_factor(&self) -> f64 {
                1.0 $(* self.$field.as_ref().map_or(1.0, Acts::gravity_factor))*
            }

            /// Adds the resultant of all constant forces in N, and their sizes.
            pub(crate) fn add_resultant(&self, cable: &Target<'_>, sum: &mut Vector3<f64>, size: &mut f64) {
                $(if let Some(effect) = &self.$field { effect.add_resultant(cable, sum, size); })*
            }

            /// Tables for the element kernel, if an effect acts there.
            pub(crate) fn in_element(&self, cable: &Target<'_>) -> Option<ElementTables> {
                let tables = ElementTables { $($field: self.$field.as_ref().and_then(|effect| effect.in_element(cable)),)* };
                (false $(|| tables.$field.is_some())*).then_some(tables)
            }

            /// Tables for Gauss points.
            pub(crate) fn at_points(&self, cable: &Target<'_>) -> PointTables {
                PointTables { $($field: self.$field.as_ref().and_then(|effect| effect.at_points(cable)).map(Box::new),)* }
            }

            /// Constant generalised forces.
            pub(crate) fn dead_forces(&self, cable: &Target<'_>) -> DeadForces {
                DeadForces { $($field: self.$field.as_ref().map_or(Vec::new(), |effect| effect.dead_force(cable)),)* }
            }
        }

        /// Effects within the element kernel.
        #[derive(Clone, Debug)]
        pub(crate) struct ElementTables {
            $(pub $field: Option<<$type as Acts>::InElement>,)*
        }

        impl GramForce for ElementTables {
            #[inline(always)]
            fn needs_rates(&self) -> bool {
                false $(|| match &self.$field { Some(table) => table.needs_rates(), None => false })*
            }

            #[inline(always)]
            fn add_gradient<T: Real, L: Load<T>>(&self, at: &GramState<'_, T>, from: &L, sum: &mut Gradient<T>) {
                $(if let Some(table) = &self.$field { table.add_gradient(at, from, sum); })*
            }

            #[inline(always)]
            fn add_hessian<T: Real, L: Load<T>>(
                &self,
                at: &GramState<'_, T>,
                rate: f64,
                from: &L,
                sum: &mut Gradient<T>,
                tangent: &mut Hessian<T>,
            ) {
                $(if let Some(table) = &self.$field { table.add_hessian(at, rate, from, sum, tangent); })*
            }
        }

        impl DiscreteGradientForce for ElementTables {
            #[inline(always)]
            fn add_discrete_gradient<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, sum: &mut Gradient<T>) -> T {
                let mut power = at.rates[0].splat(0.0);
                $(if let Some(table) = &self.$field { power = power + table.add_discrete_gradient(at, from, sum); })*
                power
            }

            #[inline(always)]
            fn add_step_tangent<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, tangent: &mut Hessian<T>) {
                $(if let Some(table) = &self.$field { table.add_step_tangent(at, from, tangent); })*
            }

            #[inline(always)]
            fn add_strain_energy<T: Real, L: Load<T>>(&self, at: &GramStep<'_, T>, from: &L, energy: &mut T) {
                $(if let Some(table) = &self.$field { table.add_strain_energy(at, from, energy); })*
            }

            #[inline(always)]
            fn add_rest_strain<T: Real, L: Load<T>>(&self, square: T, from: &L, strain: &mut T) {
                $(if let Some(table) = &self.$field { table.add_rest_strain(square, from, strain); })*
            }

            #[inline(always)]
            fn add_rest_energy<T: Real, L: Load<T>>(&self, square: T, from: &L, energy: &mut T) {
                $(if let Some(table) = &self.$field { table.add_rest_energy(square, from, energy); })*
            }
        }

        impl ElementTables {
            /// Counts the evaluation of `elements` elements, at rest or `moving`.
            pub fn count(&self, elements: u64, moving: bool, counts: &mut EffectCounts) {
                $(if let Some(table) = &self.$field && (moving || !table.needs_rates()) { counts.$field += elements; })*
            }

            /// Axial and bending energy in J that effects add to an element.
            pub fn energy(&self, element: usize, at: &GramState<'_, f64>) -> (f64, f64) {
                let mut sum = (0.0, 0.0);
                $(if let Some(table) = &self.$field {
                    let (axial, bending) = table.energy(element, at);
                    sum = (sum.0 + axial, sum.1 + bending);
                })*
                sum
            }

            /// The parts of this energy that grow with the length of an element, and with its
            /// inverse.
            pub fn energy_by_length(&self, element: usize, at: &GramState<'_, f64>) -> (f64, f64) {
                let mut sum = (0.0, 0.0);
                $(if let Some(table) = &self.$field {
                    let (axial, bending) = table.energy_by_length(element, at);
                    sum = (sum.0 + axial, sum.1 + bending);
                })*
                sum
            }

            /// Force in N on the length of an element over a step, of the energy that is not by
            /// length.
            pub fn on_length(&self, element: usize, flexural: f64, d: [&Control<f64>; 2], lengths: [f64; 2]) -> f64 {
                0.0 $(+ self.$field.as_ref().map_or(0.0, |table| table.on_length(element, flexural, d, lengths)))*
            }

            /// Sets the length of an element over a step: its mean in m, and the mean of its
            /// inverse.
            pub fn set_length_over(&mut self, element: usize, mean: f64, inverse: f64) {
                $(if let Some(table) = &mut self.$field { table.set_length_over(element, mean, inverse); })*
            }

            /// Whether any effect dissipates.
            pub fn dissipates(&self) -> bool {
                false $(|| self.$field.as_ref().is_some_and(|table| table.dissipates()))*
            }

            /// Power in W that each effect gives to an element with velocities `v` of the control
            /// vectors.
            pub fn add_power(&self, at: &GramState<'_, f64>, v: &Control<f64>, power: &mut EffectWork) {
                $(if let Some(table) = &self.$field { power.$field += table.power(at, v); })*
            }

            /// Adds the energy in J that an effect dissipated to its work.
            pub fn add_dissipated(&self, energy: f64, work: &mut EffectWork) {
                $(if self.$field.as_ref().is_some_and(|table| table.dissipates()) { work.$field -= energy; return; })*
            }

            /// Strain that effects add to the one that makes tension.
            pub fn strain(&self, element: usize, xi: f64, at: &GramState<'_, f64>) -> f64 {
                0.0 $(+ self.$field.as_ref().map_or(0.0, |table| table.strain(element, xi, at)))*
            }

            /// Curvature in 1/m that effects add to the one that makes the bending moment.
            pub fn curvature(&self, at: &SampledPoint<'_>) -> Vector3<f64> {
                let mut sum = Vector3::zeros();
                $(if let Some(table) = &self.$field { sum += table.curvature(at); })*
                sum
            }
        }

        /// Effects at Gauss points; boxed, so that absent ones take no room.
        #[derive(Clone, Debug)]
        pub(crate) struct PointTables {
            $(pub $field: Option<Box<<$type as Acts>::AtPoints>>,)*
        }

        impl PointTables {
            /// Adds the generalised forces of all effects to `out`, and their negative derivatives
            /// to `matrix` if that is asked for; counts the evaluation of `elements` elements.
            pub fn add(
                &mut self,
                level: Level,
                input: ForceInput<'_>,
                out: &mut [f64],
                mut matrix: Option<&mut BlockTridiagonal>,
                (elements, counts): (u64, &mut EffectCounts),
            ) {
                $(if let Some(table) = &mut self.$field {
                    table.add(level, input, out, matrix.as_deref_mut());
                    counts.$field += elements;
                })*
            }

            /// Adds the generalised forces of all effects over a step to `out`, b h^2 times their
            /// negative derivatives to `matrix` if that is asked for, and without it their work
            /// over the change of the coordinates to `work`; `force` is a buffer. Counts the
            /// evaluation of `elements` elements.
            pub fn add_over_step(
                &mut self,
                level: Level,
                step: StepInput<'_>,
                (out, force): (&mut [f64], &mut [f64]),
                mut matrix: Option<&mut BlockTridiagonal>,
                work: &mut EffectWork,
                (elements, counts): (u64, &mut EffectCounts),
            ) {
                $(if let Some(table) = &mut self.$field {
                    force.fill(0.0);
                    table.add_over_step(level, step, force, matrix.as_deref_mut());
                    out.iter_mut().zip(force.iter()).for_each(|(out, f)| *out += f);
                    work.$field += step.h * force.iter().zip(step.velocity).map(|(f, v)| f * v).sum::<f64>();
                    counts.$field += elements;
                })*
            }

            /// Adds the generalised forces on an element, in dual numbers.
            pub fn add_dual(&self, element: usize, time: f64, q: &[Dual; 12], v: &[Dual; 12], out: &mut [Dual; 12]) {
                $(if let Some(table) = &self.$field { table.add_dual(element, time, q, v, out); })*
            }

            /// Sets the length of an element in m.
            pub fn set_length(&mut self, element: usize, length: f64) {
                $(if let Some(table) = &mut self.$field { table.set_length(element, length); })*
            }

            /// Whether an effect is there.
            pub fn any(&self) -> bool {
                false $(|| self.$field.is_some())*
            }

            /// Power in W that each effect gives to the cable; `force` is a buffer.
            pub fn add_power(&mut self, level: Level, input: ForceInput<'_>, force: &mut [f64], power: &mut EffectWork) {
                $(if let Some(table) = &mut self.$field {
                    force.fill(0.0);
                    table.add(level, input, force, None);
                    power.$field += force.iter().zip(input.v).map(|(f, v)| f * v).sum::<f64>();
                })*
            }

            /// Whether an effect can move a cable at rest although it has no potential.
            pub fn drive(&self) -> bool {
                false $(|| self.$field.as_ref().is_some_and(|table| table.drives()))*
            }

            /// Makes all effects steady from now on: as they are at `time` (s).
            pub fn hold(&mut self, time: f64) {
                $(if let Some(table) = &mut self.$field { table.hold(time); })*
            }

            /// Multiplies what drives by a share.
            pub fn drive_by(&mut self, share: f64) {
                $(if let Some(table) = &mut self.$field { table.drive_by(share); })*
            }
        }

        /// Constant generalised forces of effects; empty for those that have none.
        #[derive(Clone, Debug)]
        pub(crate) struct DeadForces {
            $(pub $field: Vec<f64>,)*
        }

        impl DeadForces {
            /// Adds all forces to `out`.
            pub fn add(&self, out: &mut [f64]) {
                $(out.iter_mut().zip(&self.$field).for_each(|(out, f)| *out += f);)*
            }

            /// Work in J from the origin to `q`.
            pub fn work(&self, q: &[f64]) -> f64 {
                0.0 $(+ self.$field.iter().zip(q).map(|(f, q)| f * q).sum::<f64>())*
            }

            /// Adds the work of each effect between two positions.
            pub fn add_work(&self, before: &[f64], after: &[f64], work: &mut EffectWork) {
                $(if !self.$field.is_empty() {
                    let moved = after.iter().zip(before);
                    work.$field += self.$field.iter().zip(moved).map(|(f, (q, q0))| f * (q - q0)).sum::<f64>();
                })*
            }
        }
    };
}

crate::for_each_effect!(generate);
