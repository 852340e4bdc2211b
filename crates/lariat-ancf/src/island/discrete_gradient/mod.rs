//! An island under the [discrete gradient](crate::integrate::discrete_gradient): cables and bodies in one step, under one energy law.
//!
//! # Equation
//!
//! The unknowns of Newton's iteration are the changes of velocities D v of the cables and D u of the [bodies](self::body); held
//! coordinates [follow](self::holds). Each cable is condensed on them as for the other integrators, and the matrix of the bodies is
//!
//! ```text
//! B + sum G^T W G + b h/2 (p.rho)+ (1 - rho rho^T/rho^2)          G = (1, -[arm]x)
//! ```
//!
//! with the condensed matrices W and the stiffening part of the levers under the impulses p of the pins. It is positive definite if the
//! step matrices of the cables are. A body that a cable touches has columns of its own beside the held coordinates, and G = 1. The energy law
//! is that of the whole: forces and torques on the bodies do work, as do gaps that close and the axes along which a body is locked.

mod angular;
mod body;
mod coupled;
mod holds;
mod host_step;
mod impact;
mod laws;
mod method;
mod pairs;
mod rescale;
mod rigid;
mod solve;

pub(super) use host_step::HostStep;

use super::bordered::Bordered;
use super::coupling::CoupledInertia;
use super::hold::vector;
use super::layout::Layout;
use super::pin_accounts::PinAccounts;
use crate::cable::Cable;
use crate::contact::{BodyPath, CablePair, PairStep};
use crate::effect::EffectWork;
use crate::integrate::discrete_gradient::{Balance, sum_of_forces};
use crate::state::State;
use crate::support::SlopeSupport;
use crate::system::StepVectors;
use crate::system::{CableStep, System, Unknowns, dot, project_vector};
use body::BodyStep;
use coupled::{add_coupled_energies, complete_rows};
use holds::HoldStep;
use nalgebra::Vector3;

/// Length below which the free direction of a clamped slope has no direction.
const MIN_DIRECTION: f64 = 1e-9;

/// Matrices and vectors of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct StepBuffers {
    pub bodies: Vec<BodyStep>,
    /// Inertia that couples bodies, with rotations in their axes.
    coupled: Vec<CoupledInertia>,
    pub cables: Vec<CableBuffers>,
    matrix: Bordered,
    /// Rows of the bodies, then their increments.
    rows: Vec<f64>,
    /// The bodies as the contacts see them.
    paths: Vec<BodyPath>,
    /// Contacts between the cables.
    pairs: PairStep,
    /// The cables that may touch each other, in ascending order; `None` for all.
    pub may_touch: Option<Vec<CablePair>>,
    /// Rates of reels that are unknown, and sheaves.
    pub unknowns: Unknowns,
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
        self.bodies.clear();
        self.bodies.extend(layout.bodies.iter().map(BodyStep::new));
        self.coupled.clear();
        let inverse = |i: usize| layout.bodies[i].rotation.inverse();
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
    /// Sets held coordinates of the iterate and obstacles to where their bodies are, and the free directions of clamped slopes.
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
                    && let Some(along) = hold.along.try_normalize(MIN_DIRECTION)
                    && let Some((_, support)) = cable.model.supports.iter_mut().find(|(node, _)| *node == hold.node)
                {
                    support.slope = SlopeSupport::Attached(along);
                }
            }
            cable.step_buffers.contact.follow(&cable.model.obstacles.0, paths);
        }
    }

    /// Returns what the present iterate does to the energy.
    fn balance(&mut self) -> Balance {
        let pairs = self.balance_pairs();
        let StepBuffers { bodies, coupled, cables: own, rows, unknowns, .. } = &mut *self.buffers;
        rows.fill(0.0);
        unknowns.winches.iter().for_each(|winch| winch.pass(winch.force, self.cables[0].step_buffers.h, rows));
        let mut total = Balance::default();
        let closed = self.cables.iter().any(|cable| cable.system.flows.are_closed());
        for (cable, own) in self.cables.iter_mut().zip(own) {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            let mut work = EffectWork::default();
            total.add(&equations.step_balance(state, buffers, &mut work));
            equations.system.meter.work_of_step = work;
            own.pass_impulses(&buffers.rhs, rows);
            buffers.contact.pass_impulses(false, rows);
            for hold in &own.holds {
                total.residual += hold.residual(buffers.h);
                total.closing += hold.work(buffers.h);
                if !hold.slope {
                    total.impulse += hold.impulse.norm();
                }
                buffers.rhs[hold.at..hold.at + 3].fill(0.0);
            }
            project_vector(equations.model, &mut buffers.rhs);
            total.residual -= dot(&buffers.rhs, &buffers.change) / buffers.h;
            total.imbalance += sum_of_forces(&buffers.rhs);
            if closed {
                buffers.rhs.chunks_exact(6).for_each(|row| (0..3).for_each(|x| total.drift[x] += row[x]));
            }
            // the free direction of a slope, for another iteration with the same factors
            for hold in own.holds.iter().filter(|hold| hold.slope) {
                buffers.rhs[hold.at..hold.at + 3].copy_from_slice(hold.impulse.as_slice());
            }
        }
        complete_rows(bodies, coupled, rows);
        add_coupled_energies(bodies, coupled, &mut total);
        for (body, row) in bodies.iter().zip(rows.chunks_exact_mut(6)) {
            body.add_balance(row, &mut total);
            if closed {
                (0..3).for_each(|x| total.drift[x] += row[x]);
            }
        }
        self.balance_wheels(&mut total);
        if let Some(pairs) = pairs {
            pairs.add_to(&mut total, self.cables[0].step_buffers.h);
            self.cables[0].system.meter.work_of_step.contact += pairs.work;
        }
        total
    }
}

impl CableBuffers {
    /// Reads the impulses of the holds from the rows of the cable, and adds them to the rows of the bodies.
    fn pass_impulses(&mut self, rhs: &[f64], rows: &mut [f64]) {
        for hold in &mut self.holds {
            hold.impulse = vector(&rhs[hold.at..]);
            hold.pass(&hold.impulse, rows);
        }
    }

    /// Gives the momentum that the step leaves beside the reactions to the pins.
    fn give_momentum(&self, c: usize, system: &System, state: &State, b: &mut StepVectors, accounts: &mut PinAccounts) {
        let StepVectors { rhs, external, product, velocity_change, taken, landed, change, .. } = b;
        let taken_at = |i: usize| taken.get(i).unwrap_or(&0.0) + landed.get(i).unwrap_or(&0.0);
        external.iter_mut().enumerate().for_each(|(i, w)| *w = taken_at(i));
        system.mass.multiply(system.level, external, product);
        // the residual of free rows, and reactions of slopes
        rhs.iter_mut().zip(&*product).for_each(|(f, taken)| *f += taken);
        for i in 0..external.len() {
            external[i] = state.v[i] + 0.5 * (velocity_change[i] - taken_at(i));
        }
        system.mass.multiply(system.level, external, product);
        let held = self.holds.iter().filter(|hold| !hold.slope).map(|hold| (hold.at, hold.impulse));
        accounts.momentum.add_step(c, rhs, held, [&state.q, change, product]);
    }
}
