//! Of the equations of a cable.

/// Largest share u of the second difference of a velocity that is given back. Derived: what the
/// method itself takes of it.
pub(crate) const LARGEST_SHARE: f64 = super::integrate::ALPHA;

/// Rounding error of the total energy, as a share of it. Derived: that of a sum over some hundred
/// elements, of which each rounds by itself.
pub(crate) const ROUNDING: f64 = 1e-14;

/// Newton's tolerance is at most this share of the displacement that the acceleration makes in the
/// stage, and of the strain that it makes in the cable. Measured: with a hundred times more, steel
/// gains energy and shows spurious tension at coarse tolerances (tests, steel.rs).
pub(crate) const RELATIVE_TOLERANCE: f64 = 1e-2;

/// A pivot of the inertia of a cable below this share of its diagonal entry is none: a straight
/// cable has no inertia about its own axis. Derived: between the rounding of a sum over all
/// elements and the square of a sag of 1e-5 of the length.
pub(crate) const LEAST_PIVOT: f64 = 1e-10;
