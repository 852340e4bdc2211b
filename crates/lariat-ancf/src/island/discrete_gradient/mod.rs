//! An island under the [discrete gradient](crate::integrate::discrete_gradient): cables and bodies
//! in one step, under one energy law.
//!
//! # Equation
//!
//! The unknowns of Newton's iteration are the changes of velocities D v of the cables and D u of
//! the [bodies](self::body); held coordinates [follow](self::holds). Each cable is condensed on
//! them as for the other integrators, and the matrix of the bodies is
//!
//! ```text
//! B + sum G^T W G + b h/2 (p.rho)+ (1 - rho rho^T/rho^2)          G = (1, -[arm]x)
//! ```
//!
//! with the condensed matrices W and the stiffening part of the levers under the impulses p of the
//! pins. It is positive definite if the step matrices of the cables are; beside it stand the forces
//! of contacts between cables, with the diagonal -1. A body that a cable touches has columns of its
//! own beside the held coordinates, and G = 1. The energy law is that of the whole: forces and
//! torques on the bodies do work, as do gaps that close and the axes along which a body is locked.

mod angular;
mod bodies;
mod body;
mod cables;
mod contacts;
mod coupled;
mod disturbed;
mod error;
mod holds;
mod host_step;
mod impact;
mod laws;
mod method;
mod pairs;
mod pins;
mod reels;
mod rescale;
mod rigid;
mod rounds;
mod solve;
mod store;
mod terms;
mod torsion;
mod twists;

pub(super) use host_step::HostStep;
pub use terms::terms;

use super::bordered::Bordered;
use super::coupling::CoupledInertia;
use super::layout::Layout;
use super::pin_accounts::PinAccounts;
use crate::cable::Cable;
use crate::contact::{BodyPath, CablePair, PairStep};
use crate::scales::island::MIN_SLOPE;
use crate::state::State;
use crate::support::SlopeSupport;
use crate::system::angular::Restoration;
use crate::system::{CableStep, Unknowns};
use body::BodyStep;
use holds::HoldStep;
use nalgebra::Vector3;
use rounds::ContactRounds;

/// Matrices and vectors of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct StepBuffers {
    pub bodies: Vec<BodyStep>,
    /// Inertia that couples bodies, with rotations in their axes.
    coupled: Vec<CoupledInertia>,
    pub cables: Vec<CableBuffers>,
    matrix: Bordered,
    /// Torsion of the cables.
    torsions: twists::Torsions,
    /// Rows of the bodies, then their increments.
    rows: Vec<f64>,
    /// The bodies as the contacts see them.
    paths: Vec<BodyPath>,
    /// Contacts between the cables.
    pairs: PairStep,
    /// What was done about contacts in the step.
    rounds: ContactRounds,
    /// The cables that may touch each other, in ascending order; `None` for all.
    pub may_touch: Option<Vec<CablePair>>,
    /// Rates of reels that are unknown, and sheaves.
    pub unknowns: Unknowns,
    /// What restores the momenta after the step, if that is known when it ends.
    restoration: Option<Restoration>,
    /// To compute what steps hold.
    of_store: [Vec<f64>; 3],
    /// Share of the motion that may be owed after it.
    may_owe: f64,
    /// Whether velocities jumped at the end of the last step.
    unsteady: bool,
    /// By pin, velocity of node and slope beside those of the body when the host step began.
    pub deviations: Vec<[Vector3<f64>; 2]>,
}

/// Those of one cable.
#[derive(Clone, Debug, Default)]
pub(super) struct CableBuffers {
    pub holds: Vec<HoldStep>,
    /// Contacts with other cables and with itself, by number.
    pairs: Vec<usize>,
    /// The cable at the beginning of the host step.
    pub start: State,
    /// Coordinates and velocities at the end of the step.
    end: [Vec<f64>; 2],
}

/// An island during one host step.
pub(super) struct IslandStep<'a, 'b> {
    pub cables: &'a mut [&'b mut Cable],
    pub layout: &'a Layout,
    pub accounts: &'a mut PinAccounts,
    pub buffers: &'a mut StepBuffers,
}

impl StepBuffers {
    /// Begins a host step.
    pub fn begin(&mut self, layout: &Layout) {
        self.unsteady = false;
        self.bodies.clear();
        self.bodies.extend(layout.bodies.iter().map(BodyStep::new));
        self.coupled.clear();
        let inverse = |i: usize| layout.bodies[i].attitude_of_carried().inverse();
        self.coupled.extend(layout.coupled.iter().map(|coupled| coupled.turned(coupled.bodies.map(inverse))));
        self.rows.resize(6 * layout.bodies.len(), 0.0);
        self.cables.resize_with(layout.parts.len(), CableBuffers::default);
        self.matrix.resize(layout.parts.len());
        for (own, part) in self.cables.iter_mut().zip(&layout.parts) {
            own.holds.clear();
            own.holds.extend(part.holds.iter().map(|hold| HoldStep::new(hold, part.at, layout.pins[hold.pin].body)));
        }
    }
}

impl IslandStep<'_, '_> {
    /// Sets held coordinates of the iterate and obstacles to where their bodies are, and the free
    /// directions of clamped slopes.
    fn follow(&mut self) {
        self.follow_drums();
        let StepBuffers { bodies, cables: own, paths, .. } = &mut *self.buffers;
        paths.clear();
        paths.extend(bodies.iter().map(BodyStep::path));
        for (cable, own) in self.cables.iter_mut().zip(own) {
            for hold in &mut own.holds {
                let CableStep { state, buffers, .. } = cable.step_parts();
                hold.follow(self.layout, &bodies[hold.body], state, buffers);
                if hold.slope
                    && let Some(along) = hold.along.try_normalize(MIN_SLOPE)
                    && let Some((_, support)) = cable.model.supports.iter_mut().find(|(node, _)| *node == hold.node)
                {
                    support.slope = SlopeSupport::Attached(along);
                }
            }
            cable.step_buffers.contact.follow(&cable.model.obstacles.0, paths);
        }
    }
}
