//! Torsion where forces are functions of the coordinates: in statics, and in the stages of methods
//! ([`torsion_motion`](super::torsion_motion)).
//!
//! # Equation
//!
//! ```text
//! F = -M dPhi/dq        K = M Hess(Phi) + sum_s K_s g_s g_s^T        g = dPhi/dq
//! ```
//!
//! Where bodies hold a segment, their spin ([`spin`](crate::effect::torsion::spin)) is part of Phi.
//!
//! In statics Phi is advanced by its exact increments from shape to shape as they are evaluated,
//! along great circles; what slips on the way is counted where the twist is another one for it
//! ([`check`](crate::effect::torsion::check)). The second part of the stiffness couples all
//! coordinates of a segment; it enters where equations are solved
//! ([`rank`](crate::effect::torsion::rank)).

use crate::effect::acts::ForceInput;
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

/// A segment.
#[derive(Clone, Debug)]
pub(super) struct ForceSegment {
    pub segment: Segment,
    /// Twist at the last shape.
    pub twist: f64,
    /// dPhi/dq, of the segment's coordinates.
    pub gradient: Vec<f64>,
    /// That of the matrix that is factored.
    pub factored: Vec<f64>,
    /// That matrix, inverted, times it.
    pub column: Vec<f64>,
    /// The bodies that hold it.
    ends: [Option<BodyEnd>; 2],
    /// In statics.
    check: Option<Check>,
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
pub(super) const SIGNS: [f64; 2] = [-1.0, 1.0];

impl ForceSegment {
    fn new(segment: Segment) -> Self {
        let [gradient, factored, column] = [(); 3].map(|_| Vec::new());
        ForceSegment { segment, twist: 0.0, gradient, factored, column, ends: [None; 2], check: None }
    }

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

/// Torsion of a cable whose forces are evaluated.
#[derive(Clone, Debug, Default)]
pub(crate) struct TorsionForces {
    pub(super) segments: Vec<ForceSegment>,
    found: Vec<Segment>,
    /// The last shape; in motion that at the beginning of the step.
    pub(super) shape: Vec<f64>,
    /// Time in s of that shape, in motion.
    pub(super) since: Option<f64>,
    /// Factor on K in the matrix of the last evaluation.
    pub(super) scale: f64,
    pub(super) rank: RankUpdate,
    /// Whether it is the island that solves with its stiffness.
    pub(super) in_island: bool,
}

impl TorsionForces {
    /// Begins statics with the twists of a state.
    pub fn begin(&mut self, model: &Model, state: &mut State) {
        self.find(model, state);
        for own in &mut self.segments {
            own.check = Some(Check::of(&Curve::between(own.segment.nodes, &model.elements, &state.q)));
        }
        self.shape.clone_from(&state.q);
    }

    /// Finds the segments, and their twists in a state.
    pub(super) fn find(&mut self, model: &Model, state: &mut State) {
        let Self { segments, found, .. } = self;
        model.find_segments(found);
        model.follow_holds(found, &mut state.memory.torsion);
        segments.truncate(found.len());
        found[segments.len()..].iter().for_each(|segment| segments.push(ForceSegment::new(*segment)));
        let twists = state.memory.torsion.iter().flatten();
        for ((own, segment), twist) in segments.iter_mut().zip(found).zip(twists) {
            (own.segment, own.twist, own.ends, own.check) = (*segment, twist.twist, [None; 2], None);
        }
        (self.since, self.in_island) = (None, false);
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
        let of = |own: &ForceSegment| own.segment.torque(&model.elements, &self.shape, own.twist).abs();
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
        let curve = |own: &ForceSegment| Curve::between(own.segment.nodes, &model.elements, &state.q);
        let lost = |own: &ForceSegment| own.check.map_or(0, |check| check.lost(&curve(own)));
        let slips = self.segments.iter().map(lost).sum();
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
    fn change(&self, own: &ForceSegment, model: &Model, q: &[f64]) -> (f64, u64) {
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
            if let Some(check) = &mut own.check {
                check.follow(&Curve::between(own.segment.nodes, &model.elements, q), change);
            }
            own.ends.iter_mut().flatten().for_each(|end| end.attitude[0] = end.attitude[1]);
        }
        self.shape.copy_from_slice(q);
    }

    /// Returns the twist that is added from the last shape to another and a time in s, and how many
    /// pairs slip.
    pub(super) fn turned(&self, own: &ForceSegment, model: &Model, (q, time): (&[f64], f64)) -> (f64, u64) {
        let (curve, slips) = if self.is_last(q) { (0.0, 0) } else { self.change(own, model, q) };
        (curve + own.spin() + self.driven(own, model, time), slips)
    }

    /// Returns the twist in rad of a segment in a shape at a time in s.
    pub(super) fn twist_in(&self, own: &ForceSegment, model: &Model, (q, time): (&[f64], f64)) -> f64 {
        own.twist + self.turned(own, model, (q, time)).0
    }

    /// Returns the energy in J of a shape at a time in s.
    pub fn energy(&self, model: &Model, at: (&[f64], f64)) -> f64 {
        let of = |own: &ForceSegment| {
            let twist = own.segment.loaded(&model.elements, at.0, self.twist_in(own, model, at));
            0.5 * own.segment.stiffness * twist * twist
        };
        self.segments.iter().map(of).sum()
    }

    /// Sets the gradient of a segment, and returns its elastic torque in N m and that of damping.
    pub(super) fn torque_parts(&mut self, number: usize, model: &Model, input: &ForceInput<'_>) -> [f64; 2] {
        let twist = self.twist_in(&self.segments[number], model, (input.q, input.time));
        let ForceSegment { segment, gradient, .. } = &mut self.segments[number];
        segment.gradient(&model.elements, input.q, gradient);
        let (elastic, damping) = (segment.torque(&model.elements, input.q, twist), self.damping(model));
        let own = &self.segments[number];
        let damped = if damping > 0.0 { damping * own.segment.stiffness * own.rate(model, input) } else { 0.0 };
        [elastic, damped]
    }

    /// Adds the force of a shape times the input's factor, and the part of its negative derivative
    /// that couples neighbours alone.
    pub fn add(
        &mut self,
        model: &Model,
        input: &ForceInput<'_>,
        out: &mut [f64],
        mut matrix: Option<&mut BlockTridiagonal>,
    ) -> u64 {
        let (q, scale) = (input.q, input.scale);
        if self.since.is_none() {
            self.follow(model, q);
        }
        if matrix.is_some() {
            self.scale = scale * (1.0 + self.damping(model) * input.dv_dq);
        }
        let mut count = 0;
        for number in 0..self.segments.len() {
            let torque = self.torque_parts(number, model, input).iter().sum::<f64>();
            let ForceSegment { segment, gradient, .. } = &self.segments[number];
            let own = &mut out[segment.range()];
            own.iter_mut().zip(gradient).for_each(|(out, g)| *out -= scale * torque * g);
            if let Some(matrix) = &mut matrix {
                segment.add_hessian(&Lengths::fixed(&model.elements), |i| q[i], scale * torque, matrix);
            }
            count += segment.count();
        }
        count
    }
}
