//! Parts of a cable with a free end, beyond the last point that is held.
//!
//! # Equation
//!
//! Nothing acts on a free end, so the part between it and the nearest held point has the shape that
//! was drawn, without stress from the clamps: it turns with the tangent at that point,
//!
//! ```text
//! r = r_h + R (r_d - r_h)        r' = R r'_d        R t_d = t        t_d, t tangents at the held point as drawn and now
//! ```
//!
//! A slack cable has no shape of its own there but that of its weight, and hangs in equilibrium.
//!
//! # Validity
//!
//! R is the shortest turn; half a turn is made about any normal. A body, or another cable, that is
//! to hold the end may be attached later: the end is laid where it was drawn then, if that is where
//! it is attached, and the part is bent as one between held points. A slack part for which no
//! equilibrium is found keeps its arc.
//!
//! # References
//!
//! `tests/clamps.rs`: energy and motion of turned cantilevers.
//!
//! # Alternatives considered
//!
//! A free end that is held where it is drawn while the shape is sought: a cantilever that is
//! clamped across its drawing began bent, and whipped.

use super::Cable;
use super::as_laid::AsDrawn;
use super::clamp::{is_turned, turn};
use crate::at::At;
use crate::error::Error;
use crate::support::{Motion, SlopeSupport, Support};
use nalgebra::{Rotation3, Vector3};

impl Cable {
    /// Returns the first and the last node that something holds.
    pub(super) fn held(&self) -> Option<[usize; 2]> {
        let supports = &self.model.supports;
        Some([supports.first()?.0, supports.last()?.0])
    }

    /// Returns whether the cable is longer than it was drawn.
    pub(super) fn is_slack(&self) -> bool {
        !self.model.drawn.is_empty()
    }

    /// Returns the coordinates with these slopes.
    pub(super) fn positions_before(&self, slopes: &[(usize, Vector3<f64>)]) -> Vec<f64> {
        let mut before = self.positions().to_vec();
        for (node, slope) in slopes {
            before[6 * node + 3..6 * node + 6].copy_from_slice(slope.as_slice());
        }
        before
    }

    /// Turns the parts beyond the first and the last held node with the tangents there, which were
    /// others `before`.
    pub(super) fn turn_free_parts(&mut self, [first, last]: [usize; 2], before: &[f64]) {
        let part = |node: usize, k: usize| Vector3::from_column_slice(&before[6 * node + k..6 * node + k + 3]);
        for (held, free) in [(first, 0..first), (last, last + 1..self.nodes())] {
            if free.is_empty() || !is_turned(&part(held, 3), &self.node_slope(held).normalize()) {
                continue;
            }
            let rotation = Rotation3::new(turn(&part(held, 3), &self.node_slope(held)));
            let centre = part(held, 0);
            for node in free {
                let (old, slope) = (part(node, 0), part(node, 3));
                let (position, turned) = (centre + rotation * (old - centre), rotation * slope);
                for corner in &mut self.model.corners {
                    if corner.position == old && corner.slope == slope {
                        (corner.position, corner.slope) = (position, turned);
                        corner.sides = corner.sides.map(|side| rotation * side);
                    }
                }
                for end in &mut self.model.drawn {
                    if end.position == old && end.slope == slope {
                        (end.position, end.slope) = (position, turned);
                        end.direction = rotation * end.direction;
                    }
                }
                self.snapshot.state.q[6 * node..6 * node + 3].copy_from_slice(position.as_slice());
                self.set_slope(node, &turned);
            }
        }
    }

    /// Gives a slack cable the shape of equilibrium with its free ends free, if one is found.
    pub(super) fn hang_free_parts(&mut self) -> Result<(), Error> {
        let mut shape = self.under_weight()?;
        if shape.equilibrium().is_ok() {
            self.take_shape(&shape, 0);
        }
        Ok(())
    }

    /// Remembers the coordinates before parts with free ends were turned.
    pub(super) fn note_turn(&mut self, before: Vec<f64>) {
        let drawn = match self.as_drawn.take() {
            Some(earlier) if earlier.turned == before => earlier.drawn,
            _ => before,
        };
        let last = drawn.len() - 6;
        let turned = self.positions();
        let moved = |at: usize| drawn[at..at + 3] != turned[at..at + 3];
        self.as_drawn =
            (moved(0) || moved(last)).then(|| Box::new(AsDrawn { turned: turned.to_vec(), drawn: drawn.clone() }));
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn drawn_position(&self, at: At) -> Option<Vector3<f64>> {
        let as_drawn = self.as_drawn.as_ref()?;
        let node = self.node(at).ok()?;
        let found = self.is_as_begun() && as_drawn.turned == self.positions() && self.model.support(node).is_none();
        found.then(|| Vector3::from_column_slice(&as_drawn.drawn[6 * node..6 * node + 3]))
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn lay_as_drawn(&mut self, at: At) -> Result<(), Error> {
        let (Some(position), node) = (self.drawn_position(at), self.node(at)?) else { return Ok(()) };
        let Some(as_drawn) = self.as_drawn.take() else { return Ok(()) };
        self.snapshot.state.q = as_drawn.drawn;
        let mut from = Vec::new();
        for (node, support) in self.model.supports.clone() {
            let (SlopeSupport::Direction(direction) | SlopeSupport::Attached(direction)) = support.slope else {
                continue;
            };
            let slope = self.node_slope(node);
            if is_turned(&slope, &direction) {
                self.set_slope(node, &(direction * slope.norm()));
                from.push((node, slope));
            }
        }
        let support = Support { position: Some(Motion::fixed(position)), ..Support::default() };
        self.set_support(At::Node(node), support)?;
        self.bend_to_clamps(&from)?;
        self.set_support(At::Node(node), Support::default())
    }
}
