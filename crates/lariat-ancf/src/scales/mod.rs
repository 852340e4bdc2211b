//! The tuned numbers of this crate: thresholds, tolerances, factors and counts, each with the
//! reason of its value. One file for each module; here stand those of more than one.
//!
//! | a reason | says |
//! |---|---|
//! | *Derived* | that the value follows from what it names |
//! | *Measured* | where it was measured, and what other values do |
//! | *Setting* | that it is the default, or the range, of something that a user chooses |
//! | *Unknown* | what it does; why it has this value and no other was not recorded |
//!
//! A coefficient of the equation at the head of a file is no tuned number, and how data is laid out
//! is none: both stand in their file, as *Coefficient* and *Layout*. `.ci/constants` counts them.

pub(crate) mod cable;
pub(crate) mod contact;
pub(crate) mod effect;
pub(crate) mod element;
pub(crate) mod integrate;
pub(crate) mod island;
pub(crate) mod linalg;
pub(crate) mod obstacle;
pub(crate) mod reel;
pub(crate) mod statics;
pub(crate) mod study;
pub(crate) mod system;
pub(crate) mod term;
pub(crate) mod watch;
pub(crate) mod water;

/// Share by which two lengths or masses that are the same may differ. Derived: a sum over the most
/// elements that a cable can have, 1e6, rounds to 1e-10 of it; no element is shorter than 1e-6 of
/// the cable.
pub(crate) const SAME: f64 = 1e-9;

/// Smallest step in s, and smallest speed in m/s that is divided by. Derived: their squares, and
/// those of a step that was divided into 1e20 parts, are numbers of `f64` that are not zero.
pub(crate) const SMALLEST: f64 = 1e-100;

/// Strain whose energy is the least with which that of a cable is compared, where it is at rest.
/// Unknown: far below the strain of cables in use.
pub(crate) const LEAST_STRAIN: f64 = 1e-5;

/// Height in m over which all weight is the least energy with which that of a step or
/// a run is compared.
/// Unknown: a millimetre is below what is asked of positions.
pub(crate) const LEAST_HEIGHT: f64 = 1e-3;
