//! Lariat: cables that obey real materials.
pub use lariat_ancf as ancf;
