//! Torsion where forces are functions of the coordinates: in statics.
//!
//! # Equation
//!
//! ```text
//! F = -M dPhi/dq        K = M Hess(Phi) + sum_s K_s g_s g_s^T        g = dPhi/dq
//! ```
//!
//! Where bodies hold a segment, their spin ([`spin`](crate::effect::torsion::spin)) is part of Phi.
//!
//! Phi is advanced by its exact increments from shape to shape as they are evaluated, along great
//! circles; what slips on the way is counted where the twist is another one for it
//! ([`check`](crate::effect::torsion::check)). The second part of
//! the stiffness couples all coordinates of a segment; it enters where equations are solved
//! ([`rank`](crate::effect::torsion::rank)).

use crate::effect::torsion::check::Check;
use crate::effect::torsion::curve::Curve;
use crate::effect::torsion::lengths::Lengths;
use crate::effect::torsion::rank::RankUpdate;
use crate::effect::torsion::segment::Segment;
use crate::effect::torsion::spin::spun;
use crate::linalg::BlockTridiagonal;
use crate::model::Model;
use crate::state::{SegmentTwist, State};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// A segment in statics.
#[derive(Clone, Debug)]
pub(super) struct StaticSegment {
    pub segment: Segment,
    /// Twist at the last shape.
    twist: f64,
    /// dPhi/dq, of the segment's coordinates.
    pub gradient: Vec<f64>,
    /// The matrix of the last evaluation, inverted, times it.
    pub column: Vec<f64>,
    /// The bodies that hold it.
    ends: [Option<BodyEnd>; 2],
    check: Check,
}

/// A body that holds the spin of an end, in statics.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyEnd {
    /// Its number in the island.
    pub body: usize,
    /// Direction of the clamp in its axes.
    pub direction: Vector3<f64>,
    /// Attitude at the last shape, and at the next one.
    pub attitude: [UnitQuaternion<f64>; 2],
}

/// Coefficient: sign of the spin of the first and of the last hold in the twist.
const SIGNS: [f64; 2] = [-1.0, 1.0];

impl StaticSegment {
    /// Returns what the spin of its bodies adds to the twist from the last shape to the next.
    fn spin(&self) -> f64 {
        let of = |(end, sign): (&Option<BodyEnd>, f64)| {
            end.map_or(0.0, |end| sign * spun(&end.attitude[0], &end.attitude[1], &end.direction))
        };
        self.ends.iter().zip(SIGNS).map(of).sum()
    }

    /// Returns the derivatives of the twist by rotations of the bodies, with their numbers.
    fn levers(&self) -> impl Iterator<Item = (usize, Vector3<f64>)> + use<> {
        let of =
            |(end, sign): (Option<BodyEnd>, f64)| end.map(|end| (end.body, end.attitude[0] * end.direction * sign));
        self.ends.into_iter().zip(SIGNS).filter_map(of)
    }
}

/// Torsion in statics.
#[derive(Clone, Debug, Default)]
pub(crate) struct StaticTorsion {
    pub(super) segments: Vec<StaticSegment>,
    /// The last shape.
    shape: Vec<f64>,
    /// Factor on the matrix of the last evaluation.
    pub(super) scale: f64,
    pub(super) rank: RankUpdate,
    /// Whether it is the island that solves with its stiffness.
    pub(super) in_island: bool,
}

impl StaticTorsion {
    /// Begins with the twists of a state.
    pub fn begin(&mut self, model: &Model, state: &mut State) {
        self.segments.clear();
        let mut segments = Vec::new();
        model.find_segments(&mut segments);
        model.follow_holds(&segments, &mut state.memory.torsion);
        let twists = state.memory.torsion.iter().flatten();
        self.segments.extend(segments.into_iter().zip(twists).map(|(segment, twist)| StaticSegment {
            segment,
            twist: twist.twist,
            gradient: Vec::new(),
            column: Vec::new(),
            ends: [None; 2],
            check: Check::of(&Curve::between(segment.nodes, &model.elements, &state.q)),
        }));
        self.shape.clone_from(&state.q);
        self.in_island = false;
    }

    /// Leaves the solution to an island, whose bodies hold segments: `end` returns that at a node.
    pub fn join_island(&mut self, state: &State, mut end: impl FnMut(usize) -> Option<BodyEnd>) {
        self.in_island = true;
        for (number, own) in self.segments.iter_mut().enumerate() {
            let remembered = state.memory.torsion.as_ref().and_then(|all| all.get(number));
            for (side, node) in own.segment.nodes.into_iter().enumerate() {
                own.ends[side] = end(node);
                if let (Some(end), Some([w, x, y, z])) =
                    (&mut own.ends[side], remembered.and_then(|twist| twist.attitudes[side]))
                {
                    end.attitude[0] = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
                }
            }
        }
    }

    /// Sets the attitudes of the bodies at the next shape.
    pub fn turn_bodies(&mut self, attitude: impl Fn(usize) -> UnitQuaternion<f64>) {
        for end in self.segments.iter_mut().flat_map(|own| &mut own.ends).flatten() {
            end.attitude[1] = attitude(end.body);
        }
    }

    /// Returns the torques in N m on the bodies at the last shape, with their numbers.
    pub fn torques(&self, model: &Model) -> impl Iterator<Item = (usize, Vector3<f64>)> {
        self.segments.iter().flat_map(move |own| {
            let torque = own.segment.torque(&model.elements, &self.shape, own.twist);
            own.levers().map(move |(body, lever)| (body, lever * -torque))
        })
    }

    /// Returns the sum of the torques in N m, without their signs.
    pub fn torque(&self, model: &Model) -> f64 {
        let of = |own: &StaticSegment| own.segment.torque(&model.elements, &self.shape, own.twist).abs();
        self.segments.iter().map(of).sum()
    }

    /// Returns the number of segments.
    pub fn count(&self) -> usize {
        self.segments.len()
    }

    /// Returns K of a segment in N m, times the factor on the matrix of the last evaluation.
    pub fn stiffness(&self, segment: usize) -> f64 {
        self.scale * self.segments[segment].segment.stiffness
    }

    /// Returns g of a segment: of its coordinates, at their place in the cable, and of the
    /// rotations of bodies.
    pub fn gradient(
        &self,
        segment: usize,
    ) -> (core::ops::Range<usize>, &[f64], impl Iterator<Item = (usize, Vector3<f64>)>) {
        let own = &self.segments[segment];
        (own.segment.range(), &own.gradient, own.levers())
    }

    /// Ends, and leaves the twists of the shape of a state in it. Returns how many pairs slipped on
    /// the way, where a twist is another one for it.
    pub fn end(&mut self, model: &Model, state: &mut State) -> u64 {
        self.follow(model, &state.q);
        let curve = |own: &StaticSegment| Curve::between(own.segment.nodes, &model.elements, &state.q);
        let slips = self.segments.iter().map(|own| own.check.lost(&curve(own))).sum();
        let own: &mut [SegmentTwist] = state.memory.torsion.as_deref_mut().unwrap_or_default();
        for (to, own) in own.iter_mut().zip(&self.segments) {
            (to.twist, to.change) = (own.twist, 0.0);
            if self.in_island {
                to.attitudes = own.ends.map(|end| {
                    let attitude = end?.attitude[1];
                    Some([attitude.w, attitude.i, attitude.j, attitude.k])
                });
            }
        }
        slips
    }

    /// Returns whether nothing acts.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// Returns the twist that the curve adds from the last shape to another, and how many pairs
    /// slip.
    fn change(&self, own: &StaticSegment, model: &Model, q: &[f64]) -> (f64, u64) {
        own.segment.follow(&model.elements, [&self.shape, q])
    }

    /// Returns whether a shape is the last one.
    fn is_last(&self, q: &[f64]) -> bool {
        let turns = |end: &BodyEnd| end.attitude[0] != end.attitude[1];
        self.shape == q && !self.segments.iter().flat_map(|own| &own.ends).flatten().any(turns)
    }

    fn follow(&mut self, model: &Model, q: &[f64]) {
        if self.is_empty() || self.is_last(q) {
            return;
        }
        let changes: Vec<(f64, u64)> = self.segments.iter().map(|own| self.change(own, model, q)).collect();
        for (own, change) in self.segments.iter_mut().zip(changes) {
            own.twist += change.0 + own.spin();
            own.check.follow(&Curve::between(own.segment.nodes, &model.elements, q), change);
            own.ends.iter_mut().flatten().for_each(|end| end.attitude[0] = end.attitude[1]);
        }
        self.shape.copy_from_slice(q);
    }

    /// Returns the energy in J of a shape.
    pub fn energy(&self, model: &Model, q: &[f64]) -> f64 {
        let of = |own: &StaticSegment| {
            let twist = if self.is_last(q) { own.twist } else { own.twist + self.change(own, model, q).0 + own.spin() };
            let twist = own.segment.loaded(&model.elements, q, twist);
            0.5 * own.segment.stiffness * twist * twist
        };
        self.segments.iter().map(of).sum()
    }

    /// Adds the force of a shape times `scale`, and the part of its negative derivative that
    /// couples neighbours alone.
    pub fn add(
        &mut self,
        model: &Model,
        (q, scale): (&[f64], f64),
        out: &mut [f64],
        mut matrix: Option<&mut BlockTridiagonal>,
    ) -> u64 {
        self.follow(model, q);
        if matrix.is_some() {
            self.scale = scale;
        }
        let mut count = 0;
        for StaticSegment { segment, twist, gradient, .. } in &mut self.segments {
            let torque = segment.torque(&model.elements, q, *twist);
            segment.gradient(&model.elements, q, gradient);
            let own = &mut out[segment.range()];
            own.iter_mut().zip(gradient.iter()).for_each(|(out, g)| *out -= scale * torque * g);
            if let Some(matrix) = &mut matrix {
                segment.add_hessian(&Lengths::fixed(&model.elements), |i| q[i], scale * torque, matrix);
            }
            count += segment.count();
        }
        count
    }
}
