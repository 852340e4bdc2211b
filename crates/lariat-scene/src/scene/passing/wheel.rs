//! Where a cable passes its wheels in the drawn shape, and how it is laid around them.
//!
//! # Equation
//!
//! The drawn polyline is cut where it is nearest to the anchor of each sheave; a part ends at the anchor, or, at a wheel of radius R, where
//! the straight line to its next point touches the wheel. With the centre C, the point P before the wheel and the normal n about which the cable turns,
//!
//! ```text
//! A = C + R (cos f u + sin f n x u)     u = (P - C)/|P - C|,   cos f = R/|P - C|
//! ```
//!
//! and the mirror image of it for the point behind. Between two wheels both points are found by iteration. What is on the wheel is the
//! angle from A to B times R, in the proportion of the unstretched to the drawn length. `at` is the arc length of any point that is on
//! the wheel as drawn; what lies before or beyond is moved over the wheel.
//!
//! # Validity
//!
//! A and B are points of the body from then on: exact as long as the cable keeps its directions there, else off by R times the angle that
//! it turned, which a run [warns of](crate::Warning::WheelTurned).
//!
//! # Alternatives considered
//!
//! Points that move along the wheel: the element at the eye would have an eye that moves over its material, and a second flow.

use super::{GAP, Passage};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::scene::CableScene;
use lariat_ancf::Vector3;

/// Drawn points within this many radii of the centre are on the wheel.
const ON_WHEEL: f64 = 1.5;
/// Iterations for the lines between two wheels.
const ROUNDS: usize = 100;
/// Least sine of the angle between two directions that have a plane.
const PLANE: f64 = 1e-6;

/// The drawn points of a part.
pub(super) struct Drawn(pub Vec<Vector3<f64>>);

impl Drawn {
    /// Returns their length in m.
    pub fn length(&self) -> f64 {
        self.0.windows(2).map(|p| (p[1] - p[0]).norm()).sum()
    }
}

/// Returns the place in m of each point of a polyline.
fn places(points: &[Vector3<f64>]) -> Vec<f64> {
    let mut sum = 0.0;
    let rest = points.windows(2).map(|p| {
        sum += (p[1] - p[0]).norm();
        sum
    });
    std::iter::once(0.0).chain(rest).collect()
}

/// Finds where a cable passes its sheaves, in their order.
pub(super) fn place(doc: &Document<'_>, own: &CableScene, passages: &mut [Passage]) -> Result<(), Error> {
    let places = places(&own.points);
    let drawn = places.last().copied().unwrap_or(0.0);
    let mut before = 0.0;
    for k in 0..passages.len() {
        let at = KeyPath::root("sheave").item(passages[k].row);
        let passage = &mut passages[k];
        let (s, centre, radius) = (passage.at, passage.centre, passage.radius);
        let near = |i: usize| {
            let (a, b) = (own.points[i], own.points[i + 1]);
            let span = places[i + 1] - places[i];
            let share = ((centre - a).dot(&(b - a)) / (span * span)).clamp(0.0, 1.0);
            let place = (places[i] + share * span).max(before);
            let point = a + (b - a) * ((place - places[i]) / span).clamp(0.0, 1.0);
            (place, point, (point - centre).norm())
        };
        let all: Vec<_> = (0..own.points.len() - 1).filter(|&i| places[i + 1] > before).map(near).collect();
        let least = all.iter().map(|(_, _, far)| *far).fold(f64::INFINITY, f64::min);
        let wanted = s * drawn / own.length;
        let alike = all.iter().filter(|(_, _, far)| *far <= least.max(radius) + GAP);
        let nearest = alike.min_by(|a, b| (a.0 - wanted).abs().total_cmp(&(b.0 - wanted).abs()));
        let Some(&(place, point, far)) = nearest else {
            return Err(doc.conflict(&at.key("at"), "the cable as drawn ends before it"));
        };
        if far > radius * (1.0 + 1e-3) + GAP && !own.equilibrium {
            let problem = Problem::Conflict(format!("it is {far:.3e} m from the cable as drawn"));
            let accepted = "a point that the cable is drawn through, or initial = \"equilibrium\"";
            return Err(doc.error_accepting(&at.key("anchor"), problem, accepted));
        }
        passage.drawn = (place, point);
        before = place;
    }
    if passages.iter().all(|passage| passage.radius == 0.0) {
        return Ok(());
    }
    for _ in 0..ROUNDS {
        let mut moved = 0.0f64;
        for k in 0..passages.len() {
            let parts = shape(own, passages);
            let around = [parts[k].0.iter().rev().nth(1), parts[k + 1].0.get(1)].map(|p| p.copied());
            if let (passage, [Some(p), Some(q)]) = (&mut passages[k], around)
                && passage.radius > 0.0
            {
                let before = passage.touches;
                touch(doc, passage, p, q)?;
                moved += (0..2).map(|i| (passage.touches[i] - before[i]).norm()).sum::<f64>();
            }
        }
        if moved <= 1e-14 * drawn {
            break;
        }
    }
    Ok(())
}

/// Lays a cable that comes from one point and goes to another around a wheel.
fn touch(doc: &Document<'_>, passage: &mut Passage, p: Vector3<f64>, q: Vector3<f64>) -> Result<(), Error> {
    let at = KeyPath::root("sheave").item(passage.row).key("radius");
    let Passage { centre, radius, drawn: (_, drawn), .. } = *passage;
    let arms = [p - centre, q - centre];
    if let Some(near) = arms.iter().map(|arm| arm.norm()).find(|near| *near <= radius) {
        let problem = format!("a point of the cable beside it is {near:.3e} m from its centre: within the wheel");
        return Err(doc.conflict(&at, problem));
    }
    let turning = (drawn - p).cross(&(q - drawn));
    let (plane, across) = (arms[0].cross(&arms[1]), arms[0].norm() * arms[1].norm());
    let normal = if plane.norm() > PLANE * across {
        plane * plane.dot(&turning).signum()
    } else {
        turning - arms[0] * (turning.dot(&arms[0]) / arms[0].norm_squared())
    };
    if turning.norm() <= PLANE * (drawn - p).norm() * (q - drawn).norm() || normal.norm() == 0.0 {
        let problem = Problem::Conflict("the cable as drawn does not turn at the wheel: its side is not known".into());
        return Err(doc.error_accepting(&at, problem, "points that are drawn around the wheel, or radius = 0"));
    }
    let normal = normal.normalize();
    let touching = |arm: Vector3<f64>, sign: f64| {
        let (far, along) = (arm.norm(), arm.normalize());
        let cosine = radius / far;
        (along * cosine + normal.cross(&along) * (sign * (1.0 - cosine * cosine).max(0.0).sqrt())) * radius
    };
    let [a, b] = [touching(arms[0], 1.0), touching(arms[1], -1.0)];
    let angle = normal.dot(&a.cross(&b)).atan2(a.dot(&b)).rem_euclid(std::f64::consts::TAU);
    passage.angle = if angle > std::f64::consts::TAU - 1e-6 { 0.0 } else { angle };
    passage.touches = [centre + a, centre + b];
    Ok(())
}

/// Returns the drawn points of the parts of a cable: those between its sheaves that are on no wheel, and the points where it touches them.
pub(super) fn shape(own: &CableScene, passages: &[Passage]) -> Vec<Drawn> {
    let (places, last) = (places(&own.points), own.points.len() - 1);
    let on_wheel = |i: usize, passage: &Passage| (own.points[i] - passage.centre).norm() <= ON_WHEEL * passage.radius;
    let mut parts = Vec::new();
    for k in 0..=passages.len() {
        let sides = [k.checked_sub(1).map(|k| &passages[k]), passages.get(k)];
        let reach = |side: Option<&Passage>, end: f64| side.map_or(end, |passage| passage.drawn.0);
        let (from, to) = (reach(sides[0], -1.0), reach(sides[1], f64::INFINITY));
        let between = (0..=last).filter(|&i| places[i] > from && places[i] < to);
        let kept = between.filter(|&i| i == 0 || i == last || !sides.iter().flatten().any(|side| on_wheel(i, side)));
        let mut points: Vec<_> = sides[0].map(|side| side.touches[1]).into_iter().collect();
        points.extend(kept.map(|i| own.points[i]));
        points.extend(sides[1].map(|side| side.touches[0]));
        points.dedup_by(|b, a| (*b - *a).norm() <= 1e-9 * own.length);
        parts.push(Drawn(points));
    }
    parts
}
