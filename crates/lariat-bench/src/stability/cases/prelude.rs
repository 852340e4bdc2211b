//! What every family of cases uses.

pub use super::super::convert::{from_rapier, to_rapier};
pub use super::super::engine::rapier::prelude::*;
pub use super::super::peers::End;
pub use super::super::world::case::{Case, Script, case};
pub use super::super::world::materials::{l_stable_integrator, polymer_rope, steel_wire, straight};
pub use super::super::world::test_world::{Fault, TestWorld};
pub use crate::stability::family::Family;
pub use crate::stability::outcome::Check;
pub use lariat_ancf::{At, Cable, Damping, Fidelity, Integrator, Method, Section, StepControl, Vector3};

/// Gravity in m/s^2.
pub const G: f64 = 9.81;

/// Returns the stretch f of a cable whose tension follows Green's law, `N = EA (f^2 - 1)/2 f`, at a
/// tension N/EA.
pub fn green_stretch(share: f64) -> f64 {
    let mut f = 1.0 + share;
    for _ in 0..50 {
        f -= (0.5 * (f * f - 1.0) * f - share) / (1.5 * f * f - 0.5);
    }
    f
}
