//! Static equilibrium of cables and the bodies that they carry.
//!
//! # Equation
//!
//! ```text
//! M z = c2 F(q + z)        F: forces on the cables, forces and torques on the bodies
//! ```
//!
//! is solved again and again with growing c2, from rest each time: a proximal step of the potential
//! energy in the metric of mass, for c2 = 0 along its gradient, for large c2 Newton's step. A step that
//! raises the energy is repeated with a smaller c2. Velocities, gyroscopic torques and gaps are zero,
//! and the rotation vectors of the bodies are counted from their attitude before each step. The end is
//! checked: forces and moments balance at every node and at every body, no element is folded, and the
//! matrix is positive definite; a saddle is left by a small displacement.
//!
//! # Validity
//!
//! Loads on bodies that are constant in world axes. Cables touch obstacles that stand still, without friction; contact of the bodies, and
//! of cables with them, must be known to the caller. Modes without stiffness, such as a turn about a rope, keep their place.
//!
//! # References
//!
//! Rockafellar 1976 (proximal point); Kelley & Keyes 1998 (pseudo-transient continuation).
//!
//! # Alternatives considered
//!
//! - Newton's method alone: a body on a slack cable has a singular matrix.
//! - Motion with damping until it rests: its last digits take as long as all before.

mod search;

use super::body::RigidBody;
use super::hold::vector;
use super::pin::{PinConstraint, check, is_on_free_body};
use crate::cable::Cable;
use crate::contact::Growth;
use crate::element::side::Side;
use crate::error::{Error, require};
use crate::load::PointLoad;
use crate::statics::{EquilibriumOptions, EquilibriumReport};
use nalgebra::Vector3;
use search::Search;

/// Moves cables and bodies, held together by `pins`, to static equilibrium under gravity, the full point
/// loads and effects of the cables, and the forces and torques of the bodies; velocities become zero. Flow
/// is that of the cables' time.
///
/// # Errors
/// [`Error::NoEquilibrium`] if none is found, and as [`Island::step`](super::Island::step) for pins that
/// do not fit. Cables and bodies are then as before.
pub fn equilibrium(
    cables: &mut [&mut Cable],
    bodies: &mut [RigidBody],
    pins: &[PinConstraint],
    options: EquilibriumOptions,
) -> Result<EquilibriumReport, Error> {
    require("equilibrium tolerance", options.tolerance, options.tolerance > 0.0, "> 0")?;
    check(cables, bodies, pins)?;
    if let Some(cable) = cables.iter().find(|cable| Side::BOTH.iter().any(|&side| cable.needs_island(side))) {
        let reason = "its end is at a sheave or on a drum, whose equilibrium is not computed";
        return Err(Error::ReelPlace { cable: cable.name().to_string(), reason });
    }
    let windings: Vec<_> = cables.iter().map(|cable| cable.snapshot.windings).collect();
    for (i, cable) in cables.iter_mut().enumerate().filter(|(_, cable)| cable.has_reel()) {
        cable.set_riding_stock(|node| is_on_free_body(bodies, pins, i, node));
        cable.sync_reel();
    }
    let mut still = bodies.to_vec();
    for body in &mut still {
        (body.velocity, body.angular_velocity, body.memory) = (Vector3::zeros(), Vector3::zeros(), None);
    }
    let loads: Vec<Vec<PointLoad>> = cables.iter().map(|cable| cable.model.loads.clone()).collect();
    cables.iter_mut().flat_map(|cable| &mut cable.model.loads).for_each(|load| load.ramp = 0.0);
    let supports: Vec<_> = cables.iter().map(|cable| cable.model.supports.clone()).collect();
    cables.iter_mut().for_each(|cable| cable.begin_static_contact());
    let mut search = Search::new(cables, &still, pins, options.tolerance);
    let mut outcome = search.run(cables, options.iterations);
    let mut softened = false;
    for cable in cables.iter_mut().filter(|_| outcome.is_err()) {
        let start = cable.positions().to_vec();
        softened |= cable.soften_static_contact(&start);
    }
    if softened {
        let steps = search.steps;
        search = Search::new(cables, &still, pins, options.tolerance);
        search.steps = steps;
        outcome = search.run(cables, steps + options.iterations);
    }
    let mut growth = Growth::default();
    while outcome.is_ok() {
        let harden = |cable: &mut &mut Cable| cable.harden_static_contact(&growth);
        let depths: Vec<_> = cables.iter_mut().map(harden).collect();
        if depths.iter().all(Option::is_none) {
            break;
        }
        let good = (search.q.clone(), search.layout.clone());
        let harder = search.run(cables, search.steps + options.iterations);
        if growth.adapt(harder.is_ok()) {
            (search.q, search.layout) = good;
            for (cable, depth) in cables.iter_mut().zip(depths) {
                depth.into_iter().for_each(|depth| cable.system.static_contact.retreat(depth));
            }
        } else {
            outcome = harder;
        }
    }
    let (steps, residual) = (search.steps, search.residual);
    for (((cable, loads), supports), windings) in cables.iter_mut().zip(loads).zip(supports).zip(windings) {
        cable.model.loads = loads;
        if outcome.is_err() {
            cable.model.supports = supports;
            cable.snapshot.windings = windings;
            cable.sync_reel();
        }
    }
    if outcome.is_err() {
        cables.iter_mut().for_each(|cable| cable.system.static_contact.end());
    }
    let stable = outcome.map_err(|failure| Error::NoEquilibrium {
        cable: cables[0].name().to_string(),
        time: cables[0].time(),
        failure,
        residual,
        iterations: steps,
    })?;
    for (cable, part) in cables.iter_mut().zip(&search.layout.parts) {
        cable.snapshot.state.q.copy_from_slice(&search.q[part.range()]);
        cable.snapshot.state.v.fill(0.0);
        cable.disturb();
        cable.snapshot.state.memory.contacts = cable.end_static_contact();
    }
    for (i, (body, still)) in bodies.iter_mut().zip(&search.layout.bodies).enumerate() {
        body.position = vector(&search.q[search.layout.body_at(i)..]);
        body.rotation = still.rotation;
        (body.velocity, body.angular_velocity, body.memory) = (Vector3::zeros(), Vector3::zeros(), None);
    }
    Ok(EquilibriumReport { iterations: steps, residual, stable })
}
