//! The rate of a reel over a step: as its table asks, with a limit on acceleration, and to a soft stop at the ends.
//!
//! # Equation
//!
//! The rate is linear within a step of length h. It may end at r if it can still stop within what is left of the cable:
//! `r^2/(2 a) <= left - h (r_0 + r)/2`.

use super::{Reel, Winding};
use crate::model::Model;

/// Least length of the element at the eye, as a share of its full length.
pub(super) const LEAST: f64 = 0.4;

/// The rate of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan {
    /// Acceleration in m/s^2.
    pub acceleration: f64,
    /// Whether an end stops it.
    pub stopped: bool,
}

/// Returns the rate in m/s that a table asks for at a time in s.
pub(super) fn asked(reel: &Reel, time: f64) -> f64 {
    let rows = reel.rate.partition_point(|row| row[0] <= time);
    if rows == 0 { 0.0 } else { reel.rate[rows - 1][1] }
}

/// Returns the smallest length of cable in m that can be out: up to the last held node or load, and the least element.
fn least(model: &Model) -> f64 {
    let (mut s, mut held, eye) = (0.0, 0.0f64, model.nodes() - 1);
    for node in 0..eye {
        if model.support(node).is_some() {
            held = s;
        }
        s += model.elements[node].length;
    }
    let load = model.loads.iter().map(|load| load.arc_length).fold(0.0, f64::max);
    let regular = model.reel.as_ref().map_or(0.0, |own| own.element(0).length);
    held.max(load) + LEAST * regular
}

/// Returns the rate for a step of length `h` (s) from `time` (s).
pub(super) fn plan(model: &Model, reel: &Reel, winding: &Winding, time: f64, h: f64) -> Plan {
    let (a, rate) = (reel.acceleration, winding.extent[1]);
    let wanted = asked(reel, time).clamp(rate - a * h, rate + a * h);
    let out = model.length();
    // towards an end that is `left` away, at the present rate r towards it
    let bound = |left: f64, r: f64| {
        let left = left - 0.5 * h * r;
        if left <= 0.0 { 0.0 } else { a * ((0.25 * h * h + 2.0 * left / a).sqrt() - 0.5 * h) }
    };
    let highest = reel.stock.map_or(f64::INFINITY, |stock| bound(stock - out, rate));
    let lowest = -bound(out - least(model), -rate);
    let end = wanted.clamp(lowest, highest.max(lowest));
    Plan { acceleration: (end - rate) / h, stopped: end != wanted }
}
