//! Of [`island`](crate::island).

/// Closing speed of a gap in m/s above which its work is included. Unknown: slower ones are
/// rounding.
pub(crate) const SLOW_CLOSING: f64 = 1e-6;

/// Closing speed of a gap in m/s above which its work is not known accurately. Unknown: the pin
/// then pulls by more than it holds.
pub(crate) const FAST_CLOSING: f64 = 1e-2;

/// Length of a slope below which it has no direction. Derived: that of a cable at rest is one, and
/// rounding turns one of 1e-9 by 1e-7 rad.
pub(crate) const MIN_SLOPE: f64 = 1e-9;

/// Largest jump of velocity at a pin in m/s that is rounding. Derived: that of 1e6 m/s.
pub(crate) const JUMP_ROUNDING: f64 = 1e-10;

/// Largest component of a gap in m that is rounding. Derived: that of positions up to 1e4 m.
pub(crate) const GAP_ROUNDING: f64 = 1e-12;

/// Largest angle in rad that is rounding. Derived: that of a product of some rotations.
pub(crate) const ANGLE_ROUNDING: f64 = 1e-12;

/// Largest mean speed in m/s with which a gap closes, to limit the acceleration of the cable after
/// a teleport. Unknown: a gap of 1 m is closed in six frames.
pub(crate) const CLOSING_SPEED: f64 = 10.0;

/// Time in s below which a step closes a gap in part, by the square of its share of it: the
/// acceleration of the cable, that of `6 gap/h^2`, is then at most that of a step of this length,
/// and a gap that is the rounding of an engine pulls no harder in a shorter one. Derived:
/// lariat-rapier takes no finer steps of a frame of 1/60 s.
pub(crate) const SHORTEST_CLOSING: f64 = 1.0 / 1920.0;

/// Where the cosine between a slope and its clamp is below minus this, the slope of a cable without
/// bending stiffness has reversed: it is along the clamp, with negative stretch. Treating this as a
/// rotation by pi in one step creates energy without bound. Unknown: within 26 degrees of the
/// opposite.
pub(crate) const REVERSED_COSINE: f64 = 0.9;

/// Largest divisor of D and K against compression that makes A indefinite. Unknown: nothing is left
/// of them then.
pub(crate) const MAX_DIVISOR: f64 = 1e6;

/// Smallest share of the displacement that is tried before it is omitted. Unknown: six halvings.
pub(crate) const MIN_SHARE: f64 = 1.0 / 64.0;

/// Angle in rad below which series replace the quotients: they cost less than sines, without
/// cancellation. Derived: seven terms leave less than 1e-18.
pub(crate) const SERIES_ANGLE: f64 = 0.5;

/// Share of a velocity by which two that are the same may differ. Derived: some units in the last
/// place of single precision, in which an engine keeps bodies.
pub(crate) const VELOCITY_ROUNDING: f64 = 1e-6;

/// Number of times that contacts are looked for again in a step. Unknown: what is found later is
/// found in the next step.
pub(crate) const MAX_SEARCHES: usize = 3;

/// Largest number of times that the bounds of friction are set by the normal forces of the step.
/// Unknown: twice the iterations of laws; what swings on is divided.
pub(crate) const MAX_RENEWALS: usize = 40;

/// Number of pins of a cable on bodies that move from which on it is cut at them. Measured by the
/// test of `island/cuts.rs`: from here on the cut cable takes fewer products of blocks, with one to
/// five elements between pins.
pub(crate) const MIN_CUTS: usize = 13;
