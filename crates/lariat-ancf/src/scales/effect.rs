//! Of [`effect`](crate::effect).

/// EA over this many squares of the radius is the stiffness of contact. Setting:
/// [`Contact::stiffness`](crate::effect::Contact::stiffness).
pub(crate) const SOFTNESS: f64 = 40.0;

/// Floor for the square w of half the turn of an element. Derived: above what cancellation leaves
/// of the 2x2 minors of a straight one.
pub(crate) const NOISE: f64 = 2.5e-12;

/// Gauss points of an element, where its bending rule has none of its own. Derived: exact to degree
/// five, of the cubic shape functions and a force that is quadratic along the element.
pub(crate) const POINTS: usize = 3;

/// e: square of half the turn per element, in rad, below which the curvature is damped as a vector.
/// Derived: [`damping`](crate::effect::damping) bounds the heat of a spin by e, and 6e-4 rad are no
/// bend.
pub(crate) const STRAIGHT: f64 = 1e-7;

/// Rows of a table built from a formula. Unknown: their heights grow by the cube, so most are near
/// the ground, where a profile is steep.
pub(crate) const ROWS: usize = 65;

/// Step of central differences, as a share of the element or of the speed, and in m for a
/// potential. Derived: near the cube root of the rounding of `f64`, where they err least.
pub(crate) const DIFFERENCE: f64 = 1e-5;

/// What is left of a difference of two energies below this share of them is rounding. Unknown: a
/// sum of eight terms rounds by as much.
pub(crate) const ENERGY_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// k_r over kappa_0: share of the rest curvature below which the corner of its energy is rounded.
/// Unknown: a bend by a hundredth of it is none.
pub(crate) const BLUNTING: f64 = 0.01;

/// Half waves over the length in the bending mode whose damping is named. Unknown: a mode that a
/// mesh of usual fineness has.
pub(crate) const HALF_WAVES: f64 = 10.0;

/// Square of the stretch below which an axial law continues it linearly. Derived: 1/4 of the
/// length, which no cable has but where it is crumpled, and where the law must stay finite.
pub(crate) const CRUMPLED: f64 = 1.0 / 16.0;

/// Added to squares in ratios of changes. Derived: below all squares that count, and with a square
/// that is a number, which derivatives of the ratio need.
pub(crate) const TINY: f64 = 1e-140;

/// z below which atan(z)/z is its series to the fourth power. Derived: the next term, z^6/7, is
/// then below the rounding of `f64`.
pub(crate) const SMALL_TURN: f64 = 2e-3;

/// Least number of points of an axial rule beside which a law of one's own acts. Derived: the
/// energy of Green's strain is of degree 8 inside an element, which as many integrate exactly.
pub(crate) const LEAST_POINTS: u8 = 5;

/// Largest angle a in rad that a direction turns by in a part of a change that no step makes.
/// Derived: a pair within 120 degrees at both ends is within 143 inside, where |c| = tan(143/2
/// degrees), so the area that it sweeps is below 2 a |c| = 2.3 < pi: the sign of S tells it.
pub(crate) const LONGEST_PART: f64 = core::f64::consts::FRAC_PI_8;

/// That below which a part that slips is not divided any more. Setting: a pair is then within as
/// much of 120 degrees.
pub(crate) const FINEST_PART: f64 = 0.02;

/// Angle in rad by which a twist may differ from that between carried directors. Setting: a
/// millionth of a radian is none.
pub(crate) const LOST_TWIST: f64 = 1e-6;
