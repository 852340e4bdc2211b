//! Of [`element`](crate::element).

/// Share of the exact energy. Measured: an element with none has a mode without energy, and with
/// 1e-2 it locks in part (tests, pendulum.rs, elastica.rs).
pub const DELTA: f64 = 1e-3;

/// Q_c: the square of the slope below which powers of 1/Q are continued. Derived: it is below 1/3,
/// where Green's law has lost its axial stiffness, so no law of a cable is changed.
pub const LOWER_LIMIT: f64 = 0.25;

/// Regularises the quotient Dy/DQ. Derived: the square of a change by 1e-10, of which rounding
/// leaves six digits.
pub(crate) const SMALL_SQUARE: f64 = 1e-20;

/// Regularises the question whether an end is below Q_c. Derived: far below the smallest change of
/// a square, and no zero.
pub(crate) const SMALL: f64 = 1e-200;

/// Largest number of Gauss points of a rule. Setting: the range of
/// [`AxialRule::Gauss`](crate::AxialRule::Gauss).
pub const MAX_POINTS: u8 = 10;
