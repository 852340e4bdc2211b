//! Of [`water`](crate::water).

/// Largest a k of a wave in deep water; tanh(k d) of it in shallower. Derived: the height of waves
/// that break is 0.142 of their length (Miche 1944), half of it times 2 pi.
pub(crate) const STEEPEST: f64 = 0.142 * core::f64::consts::PI;

/// Most rounds of Newton's iteration for the wave number. Derived: from Eckart's guess, which is
/// within a tenth, four rounds reach rounding; the rest is for the last bit.
pub(crate) const DISPERSION_ROUNDS: u32 = 12;

/// Rise over the radius below which the mean share of a section over a step is that at its middle.
/// Derived: the error of the middle, of the square of it, is then that of rounding over it.
pub(crate) const SMALLEST_RISE: f64 = 1e-5;
