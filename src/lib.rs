//! Lariat: cables computed as finite elements, for Rapier and Bevy.
//!
//! You give Young's modulus, density and cross-section; Lariat computes motion, tension and bending moment. A cable is a chain of
//! ANCF elements (absolute nodal coordinate formulation), stepped by an integrator that controls its own error.
//!
//! A wire rope hangs between two points; then one end is released:
//!
//! ```
//! use lariat::{At, Cable, Section, Vector3};
//!
//! # fn main() -> Result<(), lariat::Error> {
//! let mut rope = Cable::builder()
//!     .points([Vector3::zeros(), Vector3::new(2.5, 0.0, 0.0)])  // m
//!     .length(3.0)                                              // m, unstretched: it hangs slack
//!     .section(Section::from_stiffness(1.66e6, 0.016, 0.147)?)  // 6 mm wire rope: EA N, EI N m^2, kg/m
//!     .elements(40)
//!     .fix(At::Start)
//!     .fix(At::End)
//!     .build()?;
//! rope.equilibrium()?;
//! let middle = rope.sample(1.5)?;
//! println!("sag {:.3} m, tension {:.2} N", -middle.position.y, middle.tension);
//! rope.release(At::End)?;
//! for _ in 0..60 {
//!     rope.step(1.0 / 60.0)?;                                   // s; error-controlled inside
//! }
//! println!("after {:.0} s the support carries {:.1} N", rope.time(), rope.reactions()?[0].force.norm());
//! # // the elastica by shooting, with the same EI and weight: sag 0.73113 m, horizontal force 1.6743 N
//! # assert!((-middle.position.y - 0.73113).abs() < 1e-4 && (middle.tension - 1.6743).abs() < 0.04, "{middle:?}");
//! # Ok(())
//! # }
//! ```
//!
//! The crate re-exports [`lariat_ancf`], the mechanics, which knows no engine. Feature `rapier` adds `lariat_rapier`, the coupling to
//! rapier3d; feature `bevy` adds `lariat_bevy`, cables as components of bevy_ecs. Units are SI, numbers are `f64`.
//!
//! | to | look at |
//! |---|---|
//! | make a cable | [`CableBuilder`], [`Section`], [`Support`], [`PointLoad`] |
//! | choose the rule of the elastic forces | [`Rule`]: `projected-3` (default), the paper's `G5-3`, `ST2`, `L2T2` ... |
//! | choose the integrator | [`Integrator`], [`Fidelity`], [`Method`] |
//! | read it | [`Cable::sample`], [`Cable::reactions`], [`Cable::energy`], [`Cable::diagnostics`] |
//! | find its static shape | [`Cable::equilibrium`] |
//! | take and restore snapshots | [`Cable::snapshot`], [`Cable::restore`], serde |
//!
//! # Limits
//!
//! Cables have no shear and no plasticity; the axial law is linear in the Green strain, or one of
//! those of [`AxialLaw`]. Torsion is that of an isotropic cable, without waves of twist. Contact,
//! torsion, and reels that a force drives are stepped by the integrator `discrete-gradient`;
//! whatever does not go together is an error that names both. JSON snapshots need `serde_json` with
//! feature `float_roundtrip`.
//!
//! The equations, their validity and their sources are in `docs/theory.md` of the repository, recipes in `docs/cookbook.md`, error against
//! CPU time in `docs/accuracy`.

#[doc(inline)]
pub use lariat_ancf::*;

/// Hides `lariat_ancf::coupling`: those who couple cables to an engine of their own take it from there.
#[allow(hidden_glob_reexports)]
mod coupling {}

#[cfg(feature = "bevy")]
#[doc(no_inline)]
pub use lariat_bevy;
#[cfg(feature = "rapier")]
#[doc(no_inline)]
pub use lariat_rapier;
