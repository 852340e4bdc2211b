//! The segments of an island over a step. Equations: [`torsion`](super::torsion).

use super::body::BodyStep;
use super::holds::HoldStep;
use crate::effect::torsion::rank::RankUpdate;
use crate::effect::torsion::segment::Segment;
use crate::effect::torsion::spin::spun;
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
    /// K at both ends of the step.
    pub stiffness: [f64; 2],
    /// tau in s.
    pub damping: f64,
    /// Twist of the material at the start of the step; Phi0, which has what the elongation of a
    /// stranded rope counts with it; and O Phi as remembered and as of this step.
    pub material: f64,
    pub start: f64,
    pub remembered: f64,
    pub before: f64,
    /// D Phi, its part of the elongation, and M^ of the iterate.
    pub change: f64,
    pub stretch: f64,
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
        let (damping, [material, start, remembered, before], [change, stretch, torque]) = (0.0, [0.0; 4], [0.0; 3]);
        let ends = [End::default(); 2];
        SegmentStep {
            cable: 0,
            number: 0,
            segment,
            stiffness: [0.0; 2],
            damping,
            material,
            start,
            remembered,
            before,
            change,
            stretch,
            torque,
            slips: 0,
            secant: Vec::new(),
            ends,
        }
    }

    /// Returns K_m.
    pub fn mean_stiffness(&self) -> f64 {
        0.5 * (self.stiffness[0] + self.stiffness[1])
    }

    /// Returns dU/dl in N at the elements at eyes, less what the torque does by their secants.
    pub fn force_of_dilution(&self, stiffness: f64) -> f64 {
        let [first, last] = self.stiffness;
        let end = self.start + self.change;
        -0.25 * first * last / stiffness * (self.start * self.start + end * end)
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
    spun(&then, &body.rotation, &direction(layout, hold, time))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect::Torsion;
    use crate::effect::torsion::lengths::Lengths;
    use crate::section::{Element, Section};

    const FULL: f64 = 0.7;

    /// The energy of a segment from whose end material runs is done by its torque and by the forces
    /// on coordinates and length, to rounding and at any step; the force on the length is its
    /// derivative.
    ///
    /// *Source.* Differences of `GJ Phi^2/(2 L)`, with Phi advanced by its exact changes.
    #[test]
    fn torque_and_dilution_do_the_change_of_the_energy() {
        let mut state = 13u64;
        let mut next = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let section = Section::from_stiffness(1e3, 1.0, 0.1).unwrap();
        let elements = [0, 1, 2].map(|_| Element { length: FULL, section });
        let torsion = Torsion::new(0.8);
        let segment = Segment::between(&torsion, None, &elements, [0, 3]);
        for size in [1e-5, 0.3, 1.0] {
            for _ in 0..100 {
                let node = |e: usize, i: usize| if i == 0 { FULL * e as f64 } else { f64::from(u8::from(i == 3)) };
                let q: Vec<f64> = (0..24).map(|i| node(i / 6, i % 6) + 0.2 * next()).collect();
                let step: Vec<f64> = (0..24).map(|_| 0.3 * size * next()).collect();
                let [first, last] = [0, 2].map(|_| [FULL, FULL * (1.0 + 0.5 * size * next())]);
                let lengths = Lengths::with_eyes(&elements, [Some(first), Some(last)]);
                let mut own = SegmentStep::new(segment);
                let change = segment.change(&lengths, &q, &step, &mut own.secant);
                (own.stiffness, own.start) = (segment.stiffnesses(Some(&torsion), &lengths), 7.0 * next());
                own.change = change.angle;
                let end = own.start + own.change;
                let energy = |end: usize, twist: f64| {
                    let length = FULL + first[end] + last[end];
                    0.5 * 0.8 / length * twist * twist
                };
                let torque = own.mean_stiffness() * 0.5 * (own.start + end);
                let of_dilution = own.force_of_dilution(0.8);
                let mut work = torque * dot(&own.secant, &step);
                for (side, [l0, l1]) in [first, last].into_iter().enumerate() {
                    work += (torque * change.by_lengths[side] + of_dilution) * (l1 - l0);
                }
                let made = energy(1, end) - energy(0, own.start);
                assert!((made - work).abs() < 1e-13 * energy(0, 7.0), "{size}: {made:e} {work:e}");
            }
        }
    }
}
