//! Pins: which node of which cable is held to which point of which body, and the checks that they
//! fit.

use super::body::RigidBody;
use crate::cable::Cable;
use crate::error::{Error, PinProblem, require, require_finite};
use crate::support::SlopeSupport;
use nalgebra::Vector3;

/// A node of a cable held to a point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinConstraint {
    /// Index of the cable in the island.
    pub cable: usize,
    /// Node of the cable; it must be [attached](crate::coupling::Coupling::attach).
    pub node: usize,
    /// Index of the body in the island.
    pub body: usize,
    /// Point of the body in body axes, from the centre of mass, in m.
    pub anchor: Vector3<f64>,
    /// For a clamp, the direction of the tangent in body axes, a unit vector; the node must be
    /// [attached with its tangent](crate::coupling::Coupling::attach_clamped).
    pub direction: Option<Vector3<f64>>,
}

/// Returns whether a node of a cable is held by a body that moves freely along or about an axis.
pub(super) fn is_on_free_body(bodies: &[RigidBody], pins: &[PinConstraint], cable: usize, node: usize) -> bool {
    let mut holding = pins.iter().filter(|pin| pin.cable == cable && pin.node == node);
    holding.any(|pin| bodies[pin.body].free.contains(&true))
}

/// Checks that cables, bodies and pins make an island.
pub(super) fn check(cables: &[&mut Cable], bodies: &[RigidBody], pins: &[PinConstraint]) -> Result<(), Error> {
    let Some(time) = cables.first().map(|cable| cable.time()) else { return Err(Error::EmptyIsland) };
    if let Some(other) = cables.iter().find(|c| c.time() != time) {
        let cable = other.name().to_string();
        return Err(Error::TimeMismatch { cable, time: other.time(), expected: time });
    }
    let problem = |cable: &Cable, node: usize, problem: PinProblem| {
        Err(Error::Pin { cable: cable.name().to_string(), node, problem })
    };
    for (i, pin) in pins.iter().enumerate() {
        for (what, index, count) in [("cables", pin.cable, cables.len()), ("bodies", pin.body, bodies.len())] {
            if index >= count {
                return Err(Error::NotInIsland { pin: i, what, index, count });
            }
        }
        let cable = &cables[pin.cable];
        require_finite("anchor of a pin (m)", &pin.anchor).map_err(|e| e.of_cable(cable.name()))?;
        if pin.node >= cable.nodes() {
            let (cable, limit) = (cable.name().to_string(), (cable.nodes() - 1) as f64);
            return Err(Error::OutOfRange { cable, what: "node", value: pin.node as f64, limit });
        }
        let Some(support) = cable.model.support(pin.node).filter(|s| s.attached) else {
            return problem(cable, pin.node, PinProblem::NotAttached);
        };
        if matches!(support.slope, SlopeSupport::Attached(_)) != pin.direction.is_some() {
            return problem(cable, pin.node, PinProblem::ClampMismatch);
        }
        if let Some(d) = &pin.direction {
            require("length of a clamp's direction", d.norm(), (d.norm() - 1.0).abs() < 1e-6, "1")
                .map_err(|e| e.of_cable(cable.name()))?;
        }
        if pins[..i].iter().any(|p| p.cable == pin.cable && p.node == pin.node) {
            return problem(cable, pin.node, PinProblem::Duplicate);
        }
    }
    cables.iter().try_for_each(|cable| cable.check_forces())?;
    for (c, cable) in cables.iter().enumerate() {
        for (node, support) in &cable.model.supports {
            if support.attached && !pins.iter().any(|p| p.cable == c && p.node == *node) {
                return problem(cable, *node, PinProblem::Missing);
            }
        }
    }
    Ok(())
}
