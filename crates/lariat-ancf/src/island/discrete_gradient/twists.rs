//! The segments of an island over a step. Equations: [`torsion`](super::torsion).

use super::body::BodyStep;
use super::holds::HoldStep;
use crate::effect::torsion::rank::RankUpdate;
use crate::effect::torsion::segment::Segment;
use crate::island::hold::vector;
use crate::island::layout::Layout;
use crate::scales::effect::SMALL_TURN;
use crate::system::dot;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// What holds the spin at an end of a segment, over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct End {
    /// D theta in rad.
    pub angle: f64,
    /// That of a motor.
    pub driven: f64,
    /// The body.
    pub body: Option<usize>,
    /// Number of its hold among those of the cable.
    pub hold: usize,
    /// sigma t.
    pub lever: Vector3<f64>,
}

/// A segment over a step.
#[derive(Clone, Debug)]
pub(super) struct SegmentStep {
    pub cable: usize,
    /// Its number among those of the cable.
    pub number: usize,
    pub segment: Segment,
    /// K tau in N m s.
    pub damping: f64,
    /// Phi0 and O Phi.
    pub start: f64,
    pub before: f64,
    /// D Phi and M^ of the iterate.
    pub change: f64,
    pub torque: f64,
    /// Pairs that slip in it.
    pub slips: u64,
    /// c.
    pub secant: Vec<f64>,
    pub ends: [End; 2],
}

/// The segments of an island.
#[derive(Clone, Debug, Default)]
pub(super) struct Torsions {
    pub list: Vec<SegmentStep>,
    pub found: Vec<Segment>,
    /// Whether the present iterate is evaluated.
    pub evaluated: bool,
    /// By segment, the solution for g: by cable, and of the bodies.
    pub columns: Vec<(Vec<Vec<f64>>, Vec<f64>)>,
    pub rank: RankUpdate,
}

/// Coefficient: sign of the spin of the first and of the last hold in the twist.
pub(super) const SIGNS: [f64; 2] = [-1.0, 1.0];

impl SegmentStep {
    pub fn new(segment: Segment) -> Self {
        let (damping, start, before, change, torque) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let ends = [End::default(); 2];
        SegmentStep {
            cable: 0,
            number: 0,
            segment,
            damping,
            start,
            before,
            change,
            torque,
            slips: 0,
            secant: Vec::new(),
            ends,
        }
    }

    /// Returns the product of g and increments of the cable and of the bodies.
    pub fn along(&self, cable: &[f64], rows: &[f64]) -> f64 {
        let of_body = |(end, sign): (&End, f64)| {
            end.body.map_or(0.0, |body| sign * end.lever.dot(&vector(&rows[6 * body + 3..])))
        };
        dot(&self.secant, &cable[self.segment.range()]) + self.ends.iter().zip(SIGNS).map(of_body).sum::<f64>()
    }
}

impl End {
    /// Returns that at a node.
    pub fn of(holds: &[HoldStep], node: usize) -> Self {
        let hold = holds.iter().position(|hold| hold.slope && hold.node == node);
        let body = hold.map(|hold| holds[hold].body);
        End { body, hold: hold.unwrap_or(0), ..End::default() }
    }

    /// Adds what the body turns between two times.
    pub fn follow(&mut self, body: &BodyStep, hold: &HoldStep, layout: &Layout, [time, end]: [f64; 2]) {
        let (first, last) = (direction(layout, hold, time), direction(layout, hold, end));
        let mean = (body.ends(&first)[0] + body.ends(&last)[1]) * 0.5;
        // w.t/2
        let half = body.mean[1].dot(&mean) * (0.5 * (end - time));
        let sigma = turn_ratio(half);
        self.lever = mean * sigma;
        self.angle += 2.0 * sigma * half;
    }
}

/// Returns sigma = atan(z)/z.
fn turn_ratio(z: f64) -> f64 {
    let square = z * z;
    if square < SMALL_TURN * SMALL_TURN { 1.0 - square * (1.0 / 3.0 - square / 5.0) } else { z.atan() / z }
}

/// Returns the direction of a clamp in the axes of its body.
fn direction(layout: &Layout, hold: &HoldStep, time: f64) -> Vector3<f64> {
    layout.clamps[hold.pin].as_ref().map_or_else(Vector3::zeros, |clamp| clamp.at(layout.elapsed(time))[0])
}

/// Returns the angle in rad by which a body that had an attitude (w, x, y, z) has spun about the
/// direction of a clamp.
pub(super) fn turned_since(then: [f64; 4], body: &BodyStep, hold: &HoldStep, layout: &Layout, time: f64) -> f64 {
    let then = UnitQuaternion::new_unchecked(Quaternion::new(then[0], then[1], then[2], then[3]));
    if then == body.rotation {
        return 0.0;
    }
    let local = direction(layout, hold, time);
    let turn = body.rotation * then.inverse();
    let mean = (then * local + body.rotation * local) * 0.5;
    // the Cayley vector of the rotation is twice its vector part over its scalar part
    let along = turn.imag().dot(&mean) * turn.scalar().signum();
    2.0 * along.atan2(turn.scalar().abs())
}
