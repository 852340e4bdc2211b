//! The side to which a slack cable is laid.
//!
//! # Equation
//!
//! The arcs of a slack cable [sag](super::layout) along gravity. Turned about the line from its
//! first to its last point by an angle, they sag along another direction; what is drawn stays.
//! With a [lead](Sag::lead) they leave the drawn points along the line between them.
//!
//! # Validity
//!
//! A cable as it was built: at rest, in the shape in which it was laid, without clamps, held at
//! drawn points alone. Which side is free is asked of those who know what is around.
//!
//! # References
//!
//! Rodrigues' rotation.
//!
//! # Alternatives considered
//!
//! Moving what is inside a body out of it: the cable would start strained.

use super::Cable;
use super::layout::{Sag, along_polyline, normal_of};
use super::unstrained::unstrain;
use crate::model::{Corner, Drawn};
use crate::support::SlopeSupport;
use nalgebra::{Rotation3, Unit};

impl Cable {
    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn can_turn_slack(&self) -> bool {
        let is_clamped = || self.model.supports.iter().any(|(_, support)| support.slope != SlopeSupport::Free);
        let sagging = self.sagging.as_ref();
        sagging.is_some_and(|sagging| self.is_as_begun() && !is_clamped() && sagging.laid == self.positions())
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn turn_slack(&mut self, angle: f64, lead: f64) -> bool {
        if !self.can_turn_slack() {
            return false;
        }
        let Some(sagging) = &self.sagging else { return false };
        let points = &sagging.points;
        let chord = points[points.len() - 1] - points[0];
        // a closed one turns about its first segment
        let along = chord.try_normalize(1e-9 * self.length()).unwrap_or_else(|| (points[1] - points[0]).normalize());
        let down = normal_of(&along, &self.gravity());
        let towards = Rotation3::from_axis_angle(&Unit::new_unchecked(along), angle) * down;
        let s = self.node_arc_lengths();
        let mut laid = along_polyline(points, &s, Sag { towards, lead });
        if points.len() > 2 {
            unstrain(&mut laid, &s, &sagging.kept, 1.0);
        }
        let room = 1e-9 * self.length();
        let stays = |node: usize| (laid[node].position - self.node_position(node)).norm() <= room;
        if !self.model.supports.iter().all(|(node, _)| stays(*node)) {
            return false;
        }
        self.model.corners = laid.iter().filter_map(Corner::of).collect();
        for end in &mut self.model.drawn {
            let Drawn { position, slope, .. } = end;
            if let Some(node) = laid.iter().find(|node| (node.position - *position).norm() <= room) {
                (*position, *slope) = (node.position, node.slope);
            }
        }
        let q: Vec<f64> = laid.iter().flat_map(|node| node.position.iter().chain(node.slope.iter()).copied()).collect();
        self.snapshot.state.q.copy_from_slice(&q);
        if let Some(sagging) = &mut self.sagging {
            sagging.laid = q;
        }
        self.disturb();
        true
    }
}
