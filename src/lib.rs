//! Lariat: cables that obey real materials.
pub use lariat_ancf::*;
pub use lariat_ancf::integrate::NewtonMode;
