//! Of obstacles.

/// Steps along the way to a surface. Derived: at the least step, all of the way and a quarter.
pub(crate) const TRACES: usize = 64;

/// Least step of these, as a share of the distance at which the surface is met. Unknown: near a
/// surface it is not walked beyond by more.
pub(crate) const PAST: f64 = 0.02;
