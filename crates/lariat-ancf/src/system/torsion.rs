//! Torsion where forces are functions of the coordinates: in statics.
//!
//! # Equation
//!
//! ```text
//! F = -M dPhi/dq        K = M Hess(Phi) + sum_s K_s g_s g_s^T        g = dPhi/dq
//! ```
//!
//! Phi is advanced by its exact increments from shape to shape as they are evaluated, so each must
//! be within 120 degrees of the one before: the steps of statics are shorter. The second part of
//! the stiffness couples all coordinates of a segment; it enters where equations are solved
//! ([`rank`](crate::effect::torsion::rank)).

use crate::effect::torsion::lengths::Lengths;
use crate::effect::torsion::rank::RankUpdate;
use crate::effect::torsion::segment::Segment;
use crate::linalg::BlockTridiagonal;
use crate::model::Model;
use crate::state::{SegmentTwist, State};

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
        }));
        self.shape.clone_from(&state.q);
    }

    /// Ends, and leaves the twists of the shape of a state in it.
    pub fn end(&mut self, model: &Model, state: &mut State) {
        self.follow(model, &state.q);
        let own: &mut [SegmentTwist] = state.memory.torsion.as_deref_mut().unwrap_or_default();
        own.iter_mut().zip(&self.segments).for_each(|(to, own)| (to.twist, to.change) = (own.twist, 0.0));
    }

    /// Returns whether nothing acts.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// Returns the twist that the curve adds from the last shape to another.
    fn change(&self, own: &StaticSegment, model: &Model, q: &[f64]) -> f64 {
        let step: Vec<f64> = q.iter().zip(&self.shape).map(|(now, then)| now - then).collect();
        own.segment.change(&Lengths::fixed(&model.elements), &self.shape, &step, &mut Vec::new()).angle
    }

    fn follow(&mut self, model: &Model, q: &[f64]) {
        if self.is_empty() || self.shape == q {
            return;
        }
        let changes: Vec<f64> = self.segments.iter().map(|own| self.change(own, model, q)).collect();
        self.segments.iter_mut().zip(changes).for_each(|(own, change)| own.twist += change);
        self.shape.copy_from_slice(q);
    }

    /// Returns the energy in J of a shape.
    pub fn energy(&self, model: &Model, q: &[f64]) -> f64 {
        let of = |own: &StaticSegment| {
            let twist = if self.shape == q { own.twist } else { own.twist + self.change(own, model, q) };
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
