//! Water with a free surface, at rest or in a linear regular wave.
//!
//! | file | holds |
//! |---|---|
//! | [`mod@wave`] | the wave: dispersion, velocity, acceleration, pressure |
//! | [`mod@surface`] | the surface that cables and bodies are under, or above |
//! | `wet` | how much of a round section is below the surface |
//!
//! What water does is told by those who are in it: [`drag`](crate::effect::drag) and
//! [`buoyancy`](crate::effect::buoyancy) of cables, `lariat_rapier::water` of bodies.
//!
//! Sines, exponentials and arcs are those of the crate `libm`, which computes them in Rust: their
//! bits are the same on every machine.

pub mod surface;
pub mod wave;
pub(crate) mod wet;

pub use surface::{Sea, SeaPoint, Surface};
pub use wave::Wave;
