//! The one list of effects, and what is generated from it.
//!
//! An effect that is not in the list does not exist; one that is in it and forgets a method of
//! [`Effect`] does not compile. The crates above generate their parts (components, scene keys,
//! snapshots, counters) from the same list by [`for_each_effect`](crate::for_each_effect).

use super::*;
use core::ops::AddAssign;
use serde::{Deserialize, Serialize};

/// Passes the list of all effects to a macro, which generates one piece of code per effect.
///
/// `for_each_effect!(callback)` expands to `callback! { {entry} {entry} ... }`, and
/// `for_each_effect!(callback, extra tokens)` to `callback! { [extra tokens] {entry} {entry} ...
/// }`. An entry reads `{ field: damping, type: Damping, set: set_damping, key: "damping", summary:
/// "..." }`: the field of [`Effects`](crate::Effects), the type in `lariat_ancf` (which implements
/// [`Effect`](crate::effect::Effect)), the setter of [`Cable`](crate::Cable), the name in files and
/// counters, and one line of text.
///
/// ```
/// macro_rules! keys {
///     ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => {
///         [$($key),*]
///     };
/// }
/// assert!(lariat_ancf::for_each_effect!(keys).contains(&"drag"));
/// ```
#[macro_export]
macro_rules! for_each_effect {
    ($callback:ident) => { $crate::for_each_effect! { @list $callback {} } };
    ($callback:ident, $($extra:tt)*) => { $crate::for_each_effect! { @list $callback { [$($extra)*] } } };
    (@list $callback:ident { $($first:tt)* }) => {
        $callback! {
            $($first)*
            { field: gravity_scale, type: GravityScale, set: set_gravity_scale, key: "gravity_scale",
              summary: "Factor on gravity for this cable." }
            { field: buoyancy, type: Buoyancy, set: set_buoyancy, key: "buoyancy", summary: "Buoyancy and added mass." }
            { field: line_loads, type: LineLoads, set: set_line_loads, key: "line_load", summary: "Constant forces per length." }
            { field: rest_shape, type: RestShape, set: set_rest_shape, key: "rest_shape",
              summary: "Stress-free stretch and curvature; without it the cable is straight and unstretched at rest." }
            { field: axial_law, type: AxialLaw, set: set_axial_law, key: "axial_law",
              summary: "Axial force against strain: `hooke`, `rope` or a curve; without it the Green law." }
            { field: damping, type: Damping, set: set_damping, key: "damping", summary: "Internal damping (Kelvin-Voigt)." }
            { field: drag, type: Drag, set: set_drag, key: "drag", summary: "Drag of a fluid or wind." }
            { field: torsion, type: Torsion, set: set_torsion, key: "torsion",
              summary: "Torsion: one torque between clamps that hold the spin." }
            { field: contact, type: Contact, set: set_contact, key: "contact",
              summary: "Contact and friction with what is around the cable." }
        }
    };
}

/// Key of forces per length of the user's own in counts and work.
const FORCE_DENSITIES: &str = "force_density";

macro_rules! generate {
    ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => {
        /// The effects of a cable; the default has none.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct Effects {
            $(#[doc = $summary] #[serde(rename = $key)] pub $field: Option<$type>,)*
        }

        impl Effects {
            /// Keys of all effects, in the order of the list.
            pub const KEYS: &[&str] = &[$($key),*];

            /// Keys of the effects that are on.
            pub fn present(&self) -> impl Iterator<Item = &'static str> + use<> {
                [$(($key, self.$field.is_some())),*].into_iter().filter_map(|(key, on)| on.then_some(key))
            }

            /// Checks the parameters of all effects, and that the cable has the numbers that they
            /// need.
            ///
            /// # Errors
            /// As [`Effect::check`].
            pub fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
                $(if let Some(effect) = &self.$field { effect.check(cable)?; })*
                Ok(())
            }

            /// Whether a force depends on velocity.
            pub fn depends_on_velocity(&self) -> bool {
                false $(|| self.$field.as_ref().is_some_and(Effect::depends_on_velocity))*
            }

            /// Whether the step matrix holds the exact tangent of the force.
            pub fn has_exact_tangent(&self) -> bool {
                true $(&& self.$field.as_ref().is_none_or(Effect::has_exact_tangent))*
            }

            /// Whether an explicit integrator cannot step the cable.
            pub fn needs_implicit_integrator(&self) -> bool {
                false $(|| self.$field.as_ref().is_some_and(Effect::needs_implicit_integrator))*
            }

            /// Whether all forces on a cable at rest are the same from one time to another, in s.
            pub fn are_steady(&self, from: f64, to: f64) -> bool {
                true $(&& self.$field.as_ref().is_none_or(|effect| effect.is_steady(from, to)))*
            }

            /// The effects of the two parts of a cable that is cut.
            pub fn cut(&self, cut: Cut<'_>) -> [Effects; 2] {
                let [mut head, mut tail] = [Effects::default(), Effects::default()];
                $(if let Some(effect) = &self.$field { [head.$field, tail.$field] = effect.cut(cut); })*
                [head, tail]
            }

            /// Adapts the effects to an element that is split in two at `xi`.
            pub fn refine(&mut self, element: usize, xi: f64) {
                $(if let Some(effect) = &mut self.$field { effect.refine(element, xi); })*
            }
        }

        /// Counts of elements for which an effect was evaluated. Effects that act by a constant
        /// vector or by the mass matrix are evaluated once, when they are set, and count nothing.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default)]
        pub struct EffectCounts {
            $(#[doc = $summary] pub $field: u64,)*
            /// Forces per length [of your own](crate::ForceDensity).
            pub force_densities: u64,
        }

        impl EffectCounts {
            /// Key and count of every effect.
            pub fn by_key(&self) -> impl Iterator<Item = (&'static str, u64)> + use<> {
                [$(($key, self.$field),)* (FORCE_DENSITIES, self.force_densities)].into_iter()
            }

            /// Counts since `earlier`; zero where they were reset since.
            pub fn since(&self, earlier: &Self) -> Self {
                let force_densities = self.force_densities.saturating_sub(earlier.force_densities);
                EffectCounts { $($field: self.$field.saturating_sub(earlier.$field),)* force_densities }
            }
        }

        impl AddAssign for EffectCounts {
            fn add_assign(&mut self, other: Self) {
                $(self.$field += other.$field;)*
                self.force_densities += other.force_densities;
            }
        }

        /// Work in J that effects have done on a cable since it was built; negative where they took
        /// energy from it. Zero for effects whose energy is part of [`Energy`](crate::Energy)
        /// (gravity, buoyancy, rest shape), so that the total energy less all work is constant.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(default)]
        pub struct EffectWork {
            $(#[doc = $summary] pub $field: f64,)*
            /// Forces per length [of your own](crate::ForceDensity).
            pub force_densities: f64,
        }

        impl EffectWork {
            /// Key and work of every effect.
            pub fn by_key(&self) -> impl Iterator<Item = (&'static str, f64)> + use<> {
                [$(($key, self.$field),)* (FORCE_DENSITIES, self.force_densities)].into_iter()
            }

            /// Sum over all effects in J.
            pub fn total(&self) -> f64 {
                0.0 $(+ self.$field)* + self.force_densities
            }

            /// Adds `factor` times the work, or power, of another.
            pub(crate) fn add_scaled(&mut self, factor: f64, other: &Self) {
                $(self.$field += factor * other.$field;)*
                self.force_densities += factor * other.force_densities;
            }

            /// Energy in J that dissipative effects (damping and drag) took from the cable;
            /// negative where a flow drives it. What contacts and friction lost is
            /// [`EnergyLaw::contacts`](crate::integrate::EnergyLaw::contacts).
            pub fn dissipated(&self) -> f64 {
                0.0 $(- if <$type as Effect>::DISSIPATIVE { self.$field } else { 0.0 })*
            }
        }

        impl AddAssign for EffectWork {
            fn add_assign(&mut self, other: Self) {
                $(self.$field += other.$field;)*
                self.force_densities += other.force_densities;
            }
        }
    };
}

for_each_effect!(generate);

impl Effects {
    /// Whether [`Fidelity::Engineering`](crate::Fidelity::Engineering) is by the discrete gradient
    /// with them, as [`Integrator::COUPLED`](crate::Integrator::COUPLED): contact has no other
    /// method, torsion none on bodies.
    pub fn need_discrete_gradient(&self) -> bool {
        self.contact.is_some() || self.torsion.is_some()
    }
}
