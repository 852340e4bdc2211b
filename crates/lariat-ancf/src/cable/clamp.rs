//! Clamps and their directions, and the start shape of a cable between them.
//!
//! # Equation
//!
//! A clamp holds a direction that was given, or that of the drawn polyline at its point: never that
//! of the provisional arc in which a slack cable is [laid](super::layout). Where the two differ,
//! the arc is replaced by the equilibrium of the section between the points that are held, under
//! its weight and constant loads per length, with its rest shape:
//!
//! ```text
//! dU(q) = 0        U = axial + bending + weight        r = drawn at held points and ends        r' / |r'| = direction at clamps
//! ```
//!
//! # Validity
//!
//! Of the shapes in equilibrium it is one that minimisation reaches from the arc, as in
//! [statics](crate::statics). It is sought between the first and the last held point; what is
//! beyond them [turns](super::turned) with them. If none is found, the arc remains with its slopes
//! turned, and the strain at the start is told by a warning.
//!
//! # References
//!
//! Bisshopp & Drucker 1945 (elastica); `tests/clamps.rs` compares with it by shooting.
//!
//! # Alternatives considered
//!
//! A clamp that keeps the tangent of the arc: level clamps 0.7 m apart with 1 m of cable were held
//! at 64 degrees. An arc between given end tangents (a biarc) is not in equilibrium, so a cable at
//! rest begins to swing.

use super::Cable;
use crate::at::At;
use crate::effect::Effects;
use crate::effect::force_density::ForceDensities;
use crate::effect::potential::Potentials;
use crate::error::{Error, require_finite};
use crate::model::Drawn;
use crate::obstacle::Obstacles;
use crate::reel::Reels;
use crate::scales::cable::{LARGEST_TURN, SAME_DIRECTION};
use crate::support::{Motion, SlopeSupport, Support};
use nalgebra::{Rotation3, Vector3};

impl Cable {
    /// Holds the position of a node where it is, or an end that turned with a clamp where it was
    /// drawn, and the direction of its tangent: that of the present tangent, and at an end of a
    /// slack cable that is as it was laid, that of the drawing, to which the cable is bent.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::NoTangent`] if the tangent has no length.
    pub fn clamp(&mut self, at: impl Into<At>) -> Result<(), Error> {
        self.clamp_to(at.into(), None)
    }

    /// Holds the position of a node where it is, and its tangent along `direction` (any length).
    /// The tangent is turned at once. A cable at rest that has not been stepped takes the shape of
    /// static equilibrium between its clamps, as one that is
    /// [built](crate::CableBuilder::clamp_along) so.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::InvalidValue`] for a direction that is not finite or zero.
    pub fn clamp_along(&mut self, at: impl Into<At>, direction: impl Into<crate::Point>) -> Result<(), Error> {
        self.clamp_to(at.into(), Some(direction.into().0))
    }

    fn clamp_to(&mut self, at: At, direction: Option<Vector3<f64>>) -> Result<(), Error> {
        self.lay_as_drawn(at)?;
        let node = self.node(at)?;
        let direction = self.direction_of_clamp(node, direction)?;
        let position = Some(Motion::fixed(self.node_position(node)));
        let slope = SlopeSupport::Direction(direction);
        self.hold_along(node, Support { position, slope, attached: false }, direction)
    }

    /// Returns the direction of a clamp at a node, as a unit vector: the given one, or that of the
    /// drawing or the tangent.
    pub(crate) fn direction_of_clamp(&self, node: usize, given: Option<Vector3<f64>>) -> Result<Vector3<f64>, Error> {
        let no_tangent = || Error::NoTangent { cable: self.name().to_string(), node };
        match given {
            Some(direction) => unit(direction).map_err(|error| error.of_cable(self.name())),
            None => {
                let slope = self.node_slope(node);
                let position = self.node_position(node);
                let as_laid = |drawn: &&Drawn| drawn.position == position && drawn.slope == slope;
                let drawn = self.model.drawn.iter().find(as_laid).map(|drawn| drawn.direction);
                drawn.or_else(|| slope.try_normalize(1e-9)).ok_or_else(no_tangent)
            }
        }
    }

    /// Sets the support of a node that holds its tangent along a unit vector, and bends a cable at
    /// rest that has not been stepped to it.
    pub(crate) fn hold_along(&mut self, node: usize, support: Support, direction: Vector3<f64>) -> Result<(), Error> {
        let before = self.node_slope(node);
        self.set_support(At::Node(node), support)?;
        if is_turned(&before, &direction) {
            let turned = direction * before.norm();
            self.set_slope(node, &turned);
            if self.is_as_begun() {
                self.bend_to_clamps(&[(node, before)])?;
            }
        }
        Ok(())
    }

    /// Returns the slope of a node.
    pub(super) fn node_slope(&self, node: usize) -> Vector3<f64> {
        Vector3::from_column_slice(&self.positions()[6 * node + 3..6 * node + 6])
    }

    pub(super) fn set_slope(&mut self, node: usize, slope: &Vector3<f64>) {
        self.snapshot.state.q[6 * node + 3..6 * node + 6].copy_from_slice(slope.as_slice());
    }

    /// Gives the cable the shape of equilibrium between its held points, under its weight and
    /// constant loads, if one is found: from clamps along these slopes, which are turned to their
    /// directions by and by. Parts with a free end [turn](super::turned) with the point that holds
    /// them.
    pub(super) fn bend_to_clamps(&mut self, from: &[(usize, Vector3<f64>)]) -> Result<(), Error> {
        let Some(held) = self.held() else { return Ok(()) };
        let before = self.positions_before(from);
        if held[0] < held[1] {
            self.bend_between(held, from)?;
        }
        self.turn_free_parts(held, &before);
        if self.is_slack() && held != [0, self.nodes() - 1] {
            self.hang_free_parts()?;
        }
        self.note_turn(before);
        self.disturb();
        Ok(())
    }

    /// Bends the part between two held nodes.
    fn bend_between(&mut self, [first, last]: [usize; 2], from: &[(usize, Vector3<f64>)]) -> Result<(), Error> {
        let mut shape = self.under_weight()?;
        if last + 1 < shape.nodes() {
            shape.cut(At::Node(last))?;
        }
        if first > 0 {
            let support = shape.support(At::Node(first))?;
            shape = shape.cut(At::Node(first))?;
            shape.set_support(At::Node(0), support)?;
        }
        let turns: Vec<(usize, Vector3<f64>, Vector3<f64>)> =
            from.iter().map(|(node, slope)| (node - first, *slope, turn(slope, &self.node_slope(*node)))).collect();
        let largest = turns.iter().map(|(_, _, turn)| turn.norm()).fold(0.0, f64::max);
        let steps = (largest / LARGEST_TURN).ceil().max(1.0);
        for (node, slope, _) in &turns {
            shape.set_slope(*node, slope);
        }
        for step in 1..=steps as usize {
            for (node, slope, turn) in &turns {
                let direction = Rotation3::new(turn * (step as f64 / steps)) * slope.normalize();
                let support = shape.support(At::Node(*node))?;
                let slope = SlopeSupport::Direction(direction.normalize());
                shape.set_support(At::Node(*node), Support { slope, ..support })?;
            }
            if shape.equilibrium().is_err() {
                return Ok(());
            }
        }
        self.take_shape(&shape, first);
        Ok(())
    }

    /// Returns the cable with its weight and constant loads alone, and what is attached held where
    /// it is.
    pub(super) fn under_weight(&self) -> Result<Cable, Error> {
        let Effects { gravity_scale, buoyancy, line_loads, rest_shape, axial_law, .. } = self.model.effects.clone();
        let mut model = crate::model::Model {
            effects: Effects { gravity_scale, buoyancy, line_loads, rest_shape, axial_law, ..Effects::default() },
            loads: Vec::new(),
            load_origins: Vec::new(),
            force_densities: ForceDensities::default(),
            potentials: Potentials::default(),
            obstacles: Obstacles::default(),
            reels: Reels::default(),
            ..self.model.clone()
        };
        for (node, support) in &mut model.supports {
            if support.attached {
                (support.position, support.attached) = (Some(Motion::fixed(self.node_position(*node))), false);
            }
            if let SlopeSupport::Attached(direction) = support.slope {
                support.slope = SlopeSupport::Direction(direction);
            }
        }
        Cable::from_parts(model, self.snapshot.clone(), crate::Fidelity::default().integrator(f64::INFINITY))
    }

    /// Takes the shape of a part of this cable, which begins at the node `first`, with the
    /// directions of clamps to the last bit.
    pub(super) fn take_shape(&mut self, part: &Cable, first: usize) {
        let mut q = part.positions().to_vec();
        for (node, support) in &part.model.supports {
            if let SlopeSupport::Direction(_) = support.slope {
                let slope = self.node_slope(first + node).normalize() * part.node_slope(*node).norm();
                q[6 * node + 3..6 * node + 6].copy_from_slice(slope.as_slice());
            }
        }
        self.snapshot.state.q[6 * first..6 * first + q.len()].copy_from_slice(&q);
    }
}

/// Returns the turn, as axis times angle, by which one vector gets the direction of another.
pub(super) fn turn(from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    let angle = from.angle(to);
    let axis = from.cross(to).try_normalize(1e-12 * from.norm() * to.norm());
    // half a turn is made about any normal
    let other = if from.x.abs() < 0.5 * from.norm() { Vector3::x() } else { Vector3::z() };
    axis.unwrap_or_else(|| from.cross(&other).normalize()) * angle
}

/// Returns whether a slope does not have a direction.
pub(super) fn is_turned(slope: &Vector3<f64>, direction: &Vector3<f64>) -> bool {
    slope.cross(direction).norm() > SAME_DIRECTION * slope.norm() || slope.dot(direction) <= 0.0
}

/// Returns a direction as a unit vector.
pub(super) fn unit(direction: Vector3<f64>) -> Result<Vector3<f64>, Error> {
    require_finite("direction of a clamp", &direction)?;
    let size = direction.amax();
    crate::error::require("size of the direction of a clamp", size, size > 0.0, "> 0")?;
    Ok((direction / size).normalize())
}
