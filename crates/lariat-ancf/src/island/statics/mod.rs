//! Static equilibrium of cables and the bodies that they carry.
//!
//! # Equation
//!
//! ```text
//! M z = c2 F(q + z)        F: forces on the cables, forces and torques on the bodies
//! ```
//!
//! is solved again and again with growing c2, from rest each time: a proximal step of the potential
//! energy in the metric of mass, for c2 = 0 along its gradient, for large c2 Newton's step. A step
//! that raises the energy is repeated with a smaller c2. Velocities, gyroscopic torques and gaps
//! are zero, and the rotation vectors of the bodies are counted from their attitude before each
//! step. The end is checked: forces and moments balance at every node and at every body, no element
//! is folded, and the matrix is positive definite; a saddle is left by a small displacement.
//!
//! [Loads on bodies](load) may depend on where these are. [Joints](joint) between bodies are a
//! potential of their multipliers, [over sheaves](sheaves) material runs from one equilibrium to
//! the next, and [torsion](twists) couples the bodies that hold a cable.
//!
//! In a flow, or under a force of the user's own, there is no potential, and the tangent is not
//! symmetric: the error falls linearly. Where no shape is found so, the whole tangent is solved
//! with (`krylov`); and where that finds none, what drives the shape grows from nothing, and it is
//! followed.
//!
//! # Validity
//!
//! Loads on bodies that are constant in world axes. A drum that is a body must not turn, nor what
//! holds its eye: one that is free to turn rests only where something else balances the pull.
//! Cables touch obstacles that stand still, without friction; contact of the bodies, and of cables
//! with them, must be known to the caller. Modes without stiffness, such as a turn about a rope,
//! keep their place.
//!
//! # References
//!
//! Rockafellar 1976 (proximal point); Kelley & Keyes 1998 (pseudo-transient continuation).
//!
//! # Alternatives considered
//!
//! - Newton's method alone: a body on a slack cable has a singular matrix.
//! - Motion with damping until it rests: its last digits take as long as all before.

mod alone;
mod joint;
mod krylov;
mod load;
mod search;
mod sheaves;
mod twists;

pub(super) use joint::Joints;
pub use joint::{FREE, JointFrame, StaticJoint};
use load::Loads;
pub use load::{LoadThere, PlacedLoad};

use super::body::RigidBody;
use super::hold::vector;
use super::pin::{PinConstraint, check, is_on_free_body};
use super::reel::{self, Drum, Sheave};
use crate::cable::Cable;
use crate::error::{EquilibriumFailure, Error, require};
use crate::island::layout::Layout;
use crate::scales::statics::PULLS;
use crate::statics::{Continued, EquilibriumOptions, EquilibriumReport, find, in_shares};
use nalgebra::Vector3;
use search::Search;
use sheaves::{Balance, Passing};

/// What holds the cables and bodies of an island together, in statics.
#[derive(Clone, Copy, Debug, Default)]
pub struct Links<'a> {
    /// Pins of cables to bodies.
    pub pins: &'a [PinConstraint],
    /// Joints between bodies.
    pub joints: &'a [StaticJoint],
    /// Sheaves between cables.
    pub sheaves: &'a [Sheave],
    /// Drums that ends of cables are on.
    pub drums: &'a [Drum],
    /// Loads on bodies that depend on where they are, with the numbers of the bodies.
    pub loads: &'a [(usize, &'a dyn PlacedLoad)],
}

/// Moves cables and bodies, held together by `links`, to static equilibrium under gravity, the full
/// point loads and effects of the cables, and the forces and torques of the bodies; velocities
/// become zero. Flow is that of the cables' time, without waves. Over sheaves runs what their pulls
/// ask for, so that the cables may have other nodes than before.
///
/// # Errors
/// [`Error::NoEquilibrium`] if none is found, [`Error::ReelPlace`] for a drum that can turn, and as
/// [`Island::step`](super::Island::step) for pins, sheaves and drums that do not fit. Cables and
/// bodies are then as before.
pub fn equilibrium(
    cables: &mut [&mut Cable],
    bodies: &mut [RigidBody],
    Links { pins, joints, sheaves, drums, loads }: Links<'_>,
    options: EquilibriumOptions,
) -> Result<EquilibriumReport, Error> {
    require("equilibrium tolerance", options.tolerance, options.tolerance > 0.0, "> 0")?;
    check(cables, bodies, pins)?;
    joints.iter().try_for_each(|joint| joint.check(bodies.len()))?;
    for (body, _) in loads {
        require("body of a load", *body as f64, *body < bodies.len(), "the index of a body of the island")?;
    }
    reel::check(cables, bodies, pins, (sheaves, drums))?;
    if let Some(drum) = drums.iter().find(|drum| drum.can_turn(cables, bodies, pins)) {
        let reason = "its end is on a drum that is free to turn, which rests only where something else balances the \
                      pull: lock its rotation and that of what holds the eye";
        return Err(Error::ReelPlace { cable: cables[drum.cable.0].name().to_string(), reason });
    }
    let before: Vec<Cable> = cables.iter().map(|cable| (**cable).clone()).collect();
    for (i, cable) in cables.iter_mut().enumerate().filter(|(_, cable)| cable.has_reel()) {
        cable.set_riding_stock(|node| is_on_free_body(bodies, pins, i, node));
        cable.sync_reel();
    }
    let mut still = bodies.to_vec();
    for body in &mut still {
        (body.velocity, body.angular_velocity, body.memory) = (Vector3::zeros(), Vector3::zeros(), None);
    }
    for cable in cables.iter_mut() {
        let now = cable.time();
        cable.model.loads.iter_mut().for_each(|load| load.stay(now));
        if cable.system.forces.drive() {
            cable.system.forces.hold(now);
        }
    }
    let outcome = settle_driven(cables, &mut still, Links { pins, joints, sheaves, drums, loads }, options);
    for (cable, before) in cables.iter_mut().zip(before) {
        if outcome.is_err() {
            **cable = before;
        } else {
            cable.model.loads.clone_from(&before.model.loads);
            // what does not drive it now, as a wind that is still to rise, does later
            if before.system.forces.drive() {
                let Cable { system, model, .. } = &mut **cable;
                system.forces.release(model);
            }
        }
    }
    let report = outcome?;
    for (body, still) in bodies.iter_mut().zip(&still) {
        (body.position, body.rotation) = (still.position, still.rotation);
        (body.velocity, body.angular_velocity, body.memory) = (Vector3::zeros(), Vector3::zeros(), None);
    }
    Ok(report)
}

/// Searches for an equilibrium under what drives cables and bodies, which grows from nothing if no
/// shape is found at once. Cables and bodies are undefined where none is found.
fn settle_driven(
    cables: &mut [&mut Cable],
    bodies: &mut [RigidBody],
    Links { pins, joints, sheaves, loads, .. }: Links<'_>,
    options: EquilibriumOptions,
) -> Result<EquilibriumReport, Error> {
    let driven = cables.iter().any(|c| c.system.forces.drive()) || !Loads(loads).have_potential(bodies);
    // what ran over a sheave before a search failed is not known
    let follows = driven && sheaves.is_empty();
    let copy = |cables: &[&mut Cable]| cables.iter().map(|cable| (**cable).clone()).collect::<Vec<Cable>>();
    let start = follows.then(|| (copy(cables), bodies.to_vec()));
    let outcome = settle(cables, bodies, (pins, joints, sheaves, Loads(loads)), options, false);
    let (Err(error), Some(start)) = (&outcome, start) else { return outcome };
    let Error::NoEquilibrium { failure, iterations: first, .. } = error else { return outcome };
    if failure.is_final() {
        return outcome;
    }
    let mut iterations = *first;
    let mut good = start;
    let mut at = |share: f64| {
        for (cable, good) in cables.iter_mut().zip(&good.0) {
            (**cable).clone_from(good);
            let (now, Cable { system, model, .. }) = (good.time(), &mut **cable);
            if system.forces.drive() {
                system.forces.hold_share(model, now, share);
            }
        }
        bodies.clone_from_slice(&good.1);
        let own: Vec<_> = loads.iter().map(|(body, load)| (*body, load.driven_by(share))).collect();
        let of_share = own.iter().zip(loads).map(|((body, own), (_, load))| (*body, own.as_deref().unwrap_or(*load)));
        let of_share: Vec<(usize, &dyn PlacedLoad)> = of_share.collect();
        let outcome = settle(cables, bodies, (pins, joints, sheaves, Loads(&of_share)), options, true);
        match &outcome {
            Ok(report) => {
                iterations += report.iterations;
                good.1.clone_from_slice(bodies);
                for (good, cable) in good.0.iter_mut().zip(cables.iter()) {
                    // with what drives it in full
                    good.snapshot.clone_from(&cable.snapshot);
                }
            }
            Err(Error::NoEquilibrium { iterations: more, .. }) => iterations += more,
            Err(_) => {}
        }
        outcome
    };
    let found = at(1.0).ok().or_else(|| in_shares(at));
    found.map_or(outcome, |report| Ok(EquilibriumReport { iterations, ..report }))
}

/// Searches for equilibria until no material runs over a sheave.
fn settle(
    cables: &mut [&mut Cable],
    bodies: &mut [RigidBody],
    (pins, joints, sheaves, loads): (&[PinConstraint], &[StaticJoint], &[Sheave], Loads<'_>),
    options: EquilibriumOptions,
    exact: bool,
) -> Result<EquilibriumReport, Error> {
    let (mut pins, mut passing) = (pins.to_vec(), Passing::new(sheaves, cables));
    let mut iterations = 0;
    loop {
        cables.iter_mut().for_each(|cable| cable.begin_static_contact());
        let mut search = Search::new(cables, bodies, (&pins, joints, loads), options.tolerance);
        search.exact = exact;
        let mut together = Together { cables, search, iterations: options.iterations };
        let outcome = find(&mut together);
        let search = together.search;
        iterations += search.steps;
        let failed = |cable: &Cable, failure| Error::NoEquilibrium {
            cable: cable.name().to_string(),
            time: cable.time(),
            failure,
            residual: search.residual,
            iterations,
        };
        let stable = outcome.map_err(|failure| failed(cables[0], passing.explain(failure)))?;
        twists::follow(cables, &search.layout, &search.q);
        for (cable, part) in cables.iter_mut().zip(&search.layout.parts) {
            cable.snapshot.state.q.copy_from_slice(&search.q[part.range()]);
            cable.set_at_rest();
            let snags = cable.snags();
            cable.snapshot.state.memory.contacts = cable.end_static_contact();
            if let Some(failure) = cable.crosses().or(snags) {
                return Err(failed(cable, failure));
            }
        }
        for (i, (body, found)) in bodies.iter_mut().zip(&search.layout.bodies).enumerate() {
            body.position = vector(&search.q[search.layout.body_at(i)..]);
            body.rotation = found.rotation;
        }
        match passing.pass(cables, &mut pins, PULLS * search.tolerance)? {
            Balance::Rest => {
                let slips = |cable: &&mut Cable| cable.slips(PULLS * search.tolerance).map(|f| failed(cable, f));
                return match cables.iter().find_map(slips) {
                    Some(error) => Err(error),
                    None => Ok(EquilibriumReport { iterations, residual: search.residual, stable }),
                };
            }
            Balance::Moved => {}
            Balance::Never => return Err(failed(cables[0], passing.explain(EquilibriumFailure::NotConverged))),
        }
    }
}

/// The search for the equilibrium of an island.
struct Together<'a, 'b, 'c> {
    cables: &'a mut [&'b mut Cable],
    search: Search<'c>,
    /// Largest number of steps of one search.
    iterations: usize,
}

impl Continued for Together<'_, '_, '_> {
    type Found = bool;
    type Failure = EquilibriumFailure;
    type Shape = (Vec<f64>, Layout);

    fn search(&mut self) -> Result<bool, EquilibriumFailure> {
        self.search.run(self.cables, self.search.steps + self.iterations)
    }

    fn improve(&mut self) -> Result<bool, EquilibriumFailure> {
        self.search()
    }

    fn shape(&self) -> Self::Shape {
        (self.search.q.clone(), self.search.layout.clone())
    }

    fn restore(&mut self, shape: Self::Shape) {
        (self.search.q, self.search.layout) = shape;
    }

    fn for_each(&mut self, mut f: impl FnMut(&mut Cable, &[f64])) {
        for (cable, part) in self.cables.iter_mut().zip(&self.search.layout.parts) {
            f(cable, &self.search.q[part.range()]);
        }
    }
}
