//! Arc lengths of the nodes of a cable: even, or graded towards points where it bends sharply.
//!
//! # Equation
//!
//! A beam of bending stiffness EI under a tension T bends within `sqrt(EI/T)` of a clamp or a load.
//! From such a point on, elements have the lengths f, q f, q^2 f, ..., by the size
//!
//! ```text
//! h(d) = a + c d      c = ln q      a = f c/(q - 1)      number of elements over d: ln(1 + c d/a)/c
//! ```
//!
//! at the distance d to the nearest of these points; q is that which makes the elements of the
//! whole cable as many as are asked for.
//!
//! # Validity
//!
//! Between two nodes that are asked for, the number of elements is rounded up, so no element at a
//! point is longer than f. q is 2 at most.
//!
//! # References
//!
//! Exponentially graded meshes for layers: Roos, Stynes & Tobiska 2008, section I.2.4.
//!
//! # Alternatives considered
//!
//! A layer of even elements (Shishkin): its edge jumps by the ratio of the lengths, at which waves
//! are reflected.

use crate::error::{Error, require};
use crate::scales::cable::{AT_NODE, MOST_GROWTH};

/// Returns an arc length that is on a cable of this length (both in m), or `None`; one within
/// [`AT_NODE`] of the length beyond an end is at the end.
pub(super) fn on_length(s: f64, length: f64) -> Option<f64> {
    let slack = AT_NODE * length;
    (-slack..=length + slack).contains(&s).then(|| s.clamp(0.0, length))
}

/// A mesh that is graded towards points.
#[derive(Clone, Debug, Default)]
pub(super) struct Grading {
    /// Length in m of the elements at the points.
    pub finest: f64,
    /// Arc lengths of the points in m.
    pub points: Vec<f64>,
}

/// The sizes of the elements on one side of a point.
#[derive(Clone, Copy)]
struct Growth {
    a: f64,
    c: f64,
}

impl Growth {
    fn new(finest: f64, c: f64) -> Self {
        Growth { a: finest * c / c.exp_m1(), c }
    }

    /// Returns the number of elements over a distance in m from the point.
    fn count(self, distance: f64) -> f64 {
        (self.c * distance / self.a).ln_1p() / self.c
    }

    /// Returns the distance in m over which there are so many elements.
    fn distance(self, count: f64) -> f64 {
        self.a * (self.c * count).exp_m1() / self.c
    }
}

/// Sorts arc lengths in m on a cable of this length, and leaves one of each.
fn put_in_order(points: &mut Vec<f64>, length: f64) {
    points.sort_by(f64::total_cmp);
    points.dedup_by(|a, b| *a - *b <= AT_NODE * length);
}

/// Returns the arc lengths of the nodes in m: all breaks, among which are the points of a grading,
/// and between them elements of about equal length, `elements` or a few more in all; with a
/// grading, of lengths that grow from its points.
pub(super) fn nodes(
    breaks: &mut Vec<f64>,
    length: f64,
    elements: usize,
    grading: Option<&Grading>,
) -> Result<Vec<f64>, Error> {
    let is_in_range = (elements as f64 * length).is_finite();
    require("length (m)", length, is_in_range, "times the number of elements a finite number")?;
    put_in_order(breaks, length);
    let last = breaks.len() - 1;
    breaks[last] = length;
    let sizes = grading.map(|grading| Sizes::new(grading, length, elements)).transpose()?;
    let mut s = vec![0.0];
    for ends in breaks.windows(2) {
        let piece = ends[1] - ends[0];
        match &sizes {
            None => {
                let count = ((elements as f64 * piece / length).round() as usize).max(1);
                s.extend((1..count).map(|i| ends[0] + piece * i as f64 / count as f64));
            }
            Some(sizes) => {
                let [from, to] = [ends[0], ends[1]].map(|s| sizes.elements_to(s));
                // what rounding adds is no element
                let count = ((to - from) * (1.0 - AT_NODE)).ceil().max(1.0);
                let at = |i: usize| sizes.place(from + (to - from) * i as f64 / count);
                s.extend((1..count as usize).map(at));
            }
        }
        s.push(ends[1]);
    }
    Ok(s)
}

/// Sizes of elements along a cable.
struct Sizes {
    growth: Growth,
    /// Pieces on which the distance to the nearest point grows or falls: the point, the other end,
    /// and the number of elements before it.
    pieces: Vec<([f64; 2], f64)>,
}

impl Sizes {
    fn new(grading: &Grading, length: f64, elements: usize) -> Result<Self, Error> {
        let (finest, count, given) = (grading.finest, elements as f64, grading.points.len() as f64);
        require("number of points with the finest elements", given, given > 0.0, "> 0")?;
        require("length of the finest elements (m)", finest, finest > 0.0, "> 0")?;
        let what = format!("length of the finest elements (m) of {elements} on {length} m");
        require(&what, finest, finest * count < length, "below the mean length of an element")?;
        let mut points = grading.points.clone();
        put_in_order(&mut points, length);
        let of = |c: f64| Sizes::with(Growth::new(finest, c), &points, length);
        let mut bounds = [0.0, MOST_GROWTH.ln()];
        let least = of(bounds[1]).elements_to(length).ceil();
        let what = format!(
            "number of elements ({least} are needed from {finest} m on, each at most {MOST_GROWTH} times as long as the last)"
        );
        require(&what, count, count >= least, "as many")?;
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = 0.5 * (bounds[0] + bounds[1]);
            let more = of(middle).elements_to(length) > count;
            bounds[usize::from(!more)] = middle;
        }
        Ok(of(bounds[1]))
    }

    fn with(growth: Growth, points: &[f64], length: f64) -> Self {
        let (mut pieces, mut before, mut from) = (Vec::new(), 0.0, 0.0);
        for (k, &point) in points.iter().enumerate() {
            let to = points.get(k + 1).map_or(length, |next| 0.5 * (point + next));
            for end in [from, to] {
                pieces.push(([point, end], before));
                before += growth.count((end - point).abs());
            }
            from = to;
        }
        Sizes { growth, pieces }
    }

    /// Returns the number of elements from the start to an arc length in m.
    fn elements_to(&self, s: f64) -> f64 {
        let covers = |([point, end], _): &&([f64; 2], f64)| s <= point.max(*end);
        let Some(([point, end], before)) = self.pieces.iter().find(covers).or(self.pieces.last()) else { return 0.0 };
        let here = self.growth.count((s - point).abs());
        // towards a point the elements are counted from the other end
        if end < point { before + self.growth.count(point - end) - here } else { before + here }
    }

    /// Returns the arc length in m up to which there are so many elements.
    fn place(&self, elements: f64) -> f64 {
        let Some(([point, end], before)) = self.pieces.iter().rev().find(|(_, before)| *before <= elements) else {
            return 0.0;
        };
        let here = elements - before;
        if end < point {
            point - self.growth.distance(self.growth.count(point - end) - here)
        } else {
            point + self.growth.distance(here)
        }
    }
}
