//! How far a body rises in a step, and what volume it displaces meanwhile.
//!
//! # Equation
//!
//! ```text
//! r = h v + h^2/2m (f + rho g V^(r))        V^(r) = (V_s d(0) - V_s d(r))/r
//! ```
//!
//! V_s d is the energy of the displaced water over rho g: its derivative by the depth is the
//! volume. V^ is the mean volume over the rise, which falls with it, so that there is one root.
//!
//! # Validity
//!
//! The surface is the plane that it is over the body at the beginning of the step.

use super::hull::{Hull, Wet};
use crate::scales::water::{HEIGHT_ROUNDS, SMALLEST_RISE};
use ::nalgebra::Vector3;

/// A body over a plane, in axes of the body.
pub(super) struct Rising<'a> {
    hull: &'a Hull,
    /// Normal of the plane, and its component along up.
    normal: Vector3<f64>,
    tilt: f64,
    /// Depth of the centroid of the body in m, across the plane, at the beginning.
    depth: f64,
    first: Wet,
    /// Volume times depth at the beginning, in m^4.
    start: f64,
}

impl<'a> Rising<'a> {
    /// Creates it by the normal in axes of the body, its component along up, and the depth.
    pub fn new(hull: &'a Hull, normal: Vector3<f64>, tilt: f64, depth: f64) -> Self {
        let mut rising = Rising { hull, normal, tilt, depth, first: hull.below(&normal, depth), start: 0.0 };
        rising.start = rising.moment(&rising.first, 0.0);
        rising
    }

    fn below(&self, rise: f64) -> Wet {
        self.hull.below(&self.normal, self.depth - rise * self.tilt)
    }

    fn moment(&self, wet: &Wet, rise: f64) -> f64 {
        let above = self.normal.dot(&(wet.centre - self.hull.centre()));
        wet.volume * ((self.depth - above) / self.tilt - rise)
    }

    /// Returns the mean volume in m^3 over a rise in m.
    pub fn mean_volume(&self, rise: f64) -> f64 {
        let (whole, last) = (self.hull.volume(), self.below(rise));
        if self.first.volume == last.volume && (last.volume == whole || last.volume == 0.0) {
            last.volume
        } else if rise.abs() < SMALLEST_RISE * self.hull.radius() {
            self.below(0.5 * rise).volume
        } else {
            ((self.start - self.moment(&last, rise)) / rise).clamp(0.0, whole)
        }
    }

    /// Returns the mean volume and the rise in m, by the rise without buoyancy and that of a
    /// volume of 1 m^3.
    pub fn solve(&self, uniform: f64, by_volume: f64) -> (f64, f64) {
        let excess = |rise: f64, volume: f64| uniform + by_volume * volume - rise;
        let (mut low, mut high) = (uniform, uniform + by_volume.max(0.0) * self.hull.volume());
        if low >= high {
            return (self.mean_volume(low), low);
        }
        let [dry, wet] = [low, high].map(|rise| self.mean_volume(rise));
        let [mut at_low, mut at_high] = [excess(low, dry), excess(high, wet)];
        if at_low <= 0.0 {
            return (dry, low);
        }
        if at_high >= 0.0 {
            return (wet, high);
        }
        // false position after Illinois
        let (mut side, mut found) = (0, (dry, low));
        for _ in 0..HEIGHT_ROUNDS {
            let rise = low + (high - low) * (at_low / (at_low - at_high));
            let volume = self.mean_volume(rise);
            let here = excess(rise, volume);
            found = (volume, rise);
            if here.abs() <= f64::EPSILON * self.hull.radius() {
                break;
            }
            if here > 0.0 {
                (low, at_low) = (rise, here);
                at_high *= if side == 1 { 0.5 } else { 1.0 };
                side = 1;
            } else {
                (high, at_high) = (rise, here);
                at_low *= if side == -1 { 0.5 } else { 1.0 };
                side = -1;
            }
        }
        found
    }
}

/// Returns a root of a continuous function that is not negative at `low` and not positive at
/// `high`, by bisection to the rounding of numbers; or the middle if it is neither.
pub(super) fn bisect(mut low: f64, mut high: f64, excess: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
}
