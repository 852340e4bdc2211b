//! Of [`linalg`](crate::linalg).

/// Smallest accepted reciprocal condition number. Derived: it leaves five of 53 bits, enough for a
/// correction of Newton's to halve the error.
pub(crate) const MIN_RCOND: f64 = 1.0 / (1u64 << 48) as f64;

/// Largest accepted growth of the entries. Derived: rounding grows with it, to 2^-33, or 1e-10, of
/// the largest entry.
pub(crate) const MAX_GROWTH: f64 = (1u64 << 20) as f64;

/// Share of its diagonal entry above which a pivot needs no exchange. Derived: cancellation costs
/// at most ten bits.
pub(crate) const MIN_PIVOT_SHARE: f64 = 1e-3;

/// Smallest accepted pivot relative to the diagonal entry of the matrix. Derived: of 53 bits,
/// cancellation leaves the 11 from which corrections converge by 1e-3 each.
pub(crate) const MIN_PIVOT: f64 = 1.0 / (1u64 << 42) as f64;

/// The same of the border, which rows that say the same twice make singular. Unknown: what is left
/// of such a pivot is some units in the last place.
pub(crate) const MIN_PIVOT_OF_BORDER: f64 = 64.0 * f64::EPSILON;

/// Smallest accepted pivot and, inverted, largest accepted diagonal entry. Derived: the product of
/// two is within the range of `f64`.
pub(crate) const RANGE: f64 = 1e-140;
