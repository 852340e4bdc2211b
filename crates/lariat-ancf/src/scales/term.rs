//! Of the energy law of a step.

/// Share of its forces that a term may miss. Unknown: forces are then right to as much.
pub(crate) const CONSISTENCY: f64 = 1e-3;

/// Share of what damping, friction and impact take that the residual of a step may make. Unknown:
/// losses are then right to as much.
pub(crate) const CLOSURE: f64 = 1e-2;

/// Share of the energy of the system within which its law is closed. Derived: a million steps, an
/// hour at 1/240 s, then make a thousandth of it.
pub const TOLERANCE: f64 = 1e-9;
