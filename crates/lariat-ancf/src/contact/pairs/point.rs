//! One contact of two cables over a step: its frame, its slip, and its forces on both.

use super::super::path::{BodyPath, ObstacleStep};
use super::super::point::ContactPoint;
use super::Strand;
use super::chords::Piece;
use super::passage::Passage;
use super::search::Candidate;
use crate::element::shape::{self, combine};
use crate::obstacle::{Mount, Patch};
use crate::scales::contact::ROLLING;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// A place of a strand that touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// Number of the strand.
    pub strand: usize,
    pub element: usize,
    /// Chord of the element.
    pub chord: usize,
    /// Local coordinate in the element.
    pub xi: f64,
    /// Shape functions, and their derivatives by arc length.
    pub shape: [f64; 4],
    pub slope: [f64; 4],
    /// Arc length in m.
    pub arc: f64,
}

/// A contact of two strands. Its obstacle is the second one; `point` is about y.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairPoint {
    pub ends: [End; 2],
    /// Arc lengths in m of the closest points when the step begins.
    pub from: [f64; 2],
    /// Sum of the radii in m.
    pub reach: f64,
    pub point: ContactPoint,
    /// Tangents at the beginning.
    pub tangents: [Vector3<f64>; 2],
    /// How the frame turns.
    pub frame: ObstacleStep,
    /// What a force on the slip is on y and on the tangents.
    spread: [Matrix3<f64>; 3],
    /// The same in the last linear solve.
    linear_spread: [Matrix3<f64>; 3],
}

/// The frame of a pair that turns by twice the vector `half`, by the Cayley map.
pub(super) fn frame(half: Vector3<f64>, h: f64) -> ObstacleStep {
    let (origin, still) = (Vector3::zeros(), UnitQuaternion::identity());
    let path = BodyPath { centre: origin, displacement: origin, rotation: still, half, moved: false };
    let mut frame = ObstacleStep::carried(&Mount { body: 0, position: origin, rotation: still }, &path, h);
    // no body of the island carries it
    frame.body = None;
    frame
}

impl PairPoint {
    /// Returns that of a candidate, which is to be put to its places; `from` are arc lengths in m
    /// of the closest points when the step begins.
    pub fn new(candidate: &Candidate, from: [f64; 2], point: ContactPoint, h: f64) -> Self {
        let ends = [0, 1].map(|k| End {
            strand: candidate.strands[k],
            element: candidate.elements[k],
            chord: candidate.chords[k],
            xi: candidate.xi[k],
            arc: candidate.arcs[k],
            shape: [0.0; 4],
            slope: [0.0; 4],
        });
        let spread = [Matrix3::identity(), Matrix3::zeros(), Matrix3::zeros()];
        let (reach, frame, tangents) = (candidate.reach, frame(Vector3::zeros(), h), [Vector3::zeros(); 2]);
        PairPoint { ends, from, reach, point, tangents, frame, spread, linear_spread: spread }
    }

    /// Puts it to places of both elements, with the normal when the step begins.
    pub fn put(&mut self, pieces: [&Piece<'_>; 2], xi: [f64; 2], normal: Vector3<f64>) {
        for ((end, piece), xi) in self.ends.iter_mut().zip(pieces).zip(xi) {
            end.arc += (xi - end.xi) * piece.length;
            end.xi = xi;
            (end.shape, end.slope) = (shape::position(xi, piece.length), shape::slope(xi, piece.length));
        }
        let at = |k: usize, shape: &[f64; 4]| combine(pieces[k].strand.q, pieces[k].element, shape);
        let [one, other] = &self.ends;
        self.tangents = [at(0, &one.slope), at(1, &other.slope)];
        self.point.start = at(0, &one.shape) - at(1, &other.shape);
        (self.point.xi, self.point.shape) = (xi[0], one.shape);
        self.point.patch = Patch::Plane { point: Vector3::zeros(), normal };
    }

    /// Puts it half way of a passage of cables that were on a side: its depth begins with the true
    /// one.
    pub fn pass(&mut self, pieces: [&Piece<'_>; 2], passage: &Passage, side: &Vector3<f64>) {
        let (gap, normal) = passage.on_side(side);
        self.put(pieces, passage.xi, normal);
        self.point.reach = self.reach + normal.dot(&self.point.start) - gap;
    }

    /// Returns the speed in m/s with which it opens when the step begins.
    pub fn opens(&self, pieces: [&Piece<'_>; 2]) -> f64 {
        let at = |k: usize| combine(pieces[k].strand.velocity, self.ends[k].element, &self.ends[k].shape);
        self.point.patch.gap(&self.point.start).1.dot(&(at(0) - at(1)))
    }

    /// Moves the frame with an iterate, and returns the change of y.
    fn turn(&mut self, strands: [&Strand<'_>; 2]) -> Vector3<f64> {
        let change = |k: usize, shape: &[f64; 4]| combine(strands[k].change, self.ends[k].element, shape);
        let moved = change(0, &self.ends[0].shape) - change(1, &self.ends[1].shape);
        let turned = [change(0, &self.ends[0].slope), change(1, &self.ends[1].slope)];
        let y = self.point.start + 0.5 * moved;
        let tangents = [0, 1].map(|k| self.tangents[k] + 0.5 * turned[k]);
        let weight = ROLLING / (self.reach * self.reach);
        let square = |v: &Vector3<f64>| Matrix3::identity() * v.norm_squared() - v * v.transpose();
        let sum = square(&tangents[0]) + square(&tangents[1]) + square(&y) * weight;
        let inverse = sum.try_inverse().unwrap_or_default();
        let turn = inverse * (tangents[0].cross(&turned[0]) + tangents[1].cross(&turned[1]) + y.cross(&moved) * weight);
        self.frame = frame(0.5 * turn, self.frame.h);
        let couple = inverse * y.cross_matrix();
        self.spread = [
            Matrix3::identity() + y.cross_matrix() * couple * weight,
            tangents[0].cross_matrix() * couple,
            tangents[1].cross_matrix() * couple,
        ];
        moved
    }

    /// Makes it linear at an iterate.
    pub fn linearise(&mut self, strands: [&Strand<'_>; 2]) {
        let moved = self.turn(strands);
        self.linear_spread = self.spread;
        self.point.linearise(&self.frame, |_, _| moved);
    }

    /// Evaluates it at the result of the linear solve, and returns how far that was off in N, and
    /// the work of its force in J.
    pub fn follow(&mut self, strands: [&Strand<'_>; 2]) -> [f64; 2] {
        let moved = self.turn(strands);
        let missed = self.point.follow(&self.frame, |_, _| moved);
        [missed, self.point.now.force.dot(&self.frame.slip(&self.point.start, &moved))]
    }

    /// Returns a force on the slip as forces on the coordinates of both elements.
    pub fn forces(&self, force: &Vector3<f64>) -> [[f64; 12]; 2] {
        self.spread_forces(&self.spread, force)
    }

    /// The same as the last linear solve saw it.
    pub fn linear_forces(&self, force: &Vector3<f64>) -> [[f64; 12]; 2] {
        self.spread_forces(&self.linear_spread, force)
    }

    /// Returns the rate of the slip for velocities that are combined by strand, element and shape
    /// functions: what [`linear_forces`](Self::linear_forces) are the transpose of.
    pub fn rate(&self, velocity: impl Fn(usize, usize, &[f64; 4]) -> Vector3<f64>) -> Vector3<f64> {
        let at = |k: usize, shape: &[f64; 4]| velocity(self.ends[k].strand, self.ends[k].element, shape);
        let [place, first, second] = &self.linear_spread;
        let apart = at(0, &self.ends[0].shape) - at(1, &self.ends[1].shape);
        place.tr_mul(&apart) + first.tr_mul(&at(0, &self.ends[0].slope)) + second.tr_mul(&at(1, &self.ends[1].slope))
    }

    fn spread_forces(&self, spread: &[Matrix3<f64>; 3], force: &Vector3<f64>) -> [[f64; 12]; 2] {
        let [place, first, second] = spread.map(|part| part * force);
        let nodal = |end: &End, place: Vector3<f64>, slope: Vector3<f64>| {
            let mut out = [0.0; 12];
            for k in 0..4 {
                for x in 0..3 {
                    out[3 * k + x] = end.shape[k] * place[x] + end.slope[k] * slope[x];
                }
            }
            out
        };
        [nodal(&self.ends[0], place, first), nodal(&self.ends[1], -place, second)]
    }
}
