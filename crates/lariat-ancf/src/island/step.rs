//! One host step of an island.

use super::body::RigidBody;
use super::coupling::{self, CoupledInertia};
use super::discrete_gradient::{HostStep, StepBuffers};
use super::dynamics::{IslandDynamics, Vectors};
use super::equations::{IslandEquations, Matrices};
use super::layout::Layout;
use super::memory;
use super::pin::{PinConstraint, check};
use super::pin_accounts::{PinAccount, PinAccounts};
use super::reel::{self, Wheels};
use crate::cable::{Cable, check_integrator, check_torsion};
use crate::contact::CablePair;
use crate::error::{Error, require};
use crate::integrate::{Integrator, IntegratorRef, Scratch, step_control};
use crate::scales::SMALLEST;
use crate::state::State;

/// Buffers of an island, reused from step to step; nothing in them is state.
#[derive(Clone, Debug, Default)]
pub struct Island {
    pub(super) layout: Layout,
    pub(super) matrices: Matrices,
    pub(super) accounts: PinAccounts,
    pub(super) vectors: Vectors,
    by_discrete_gradient: StepBuffers,
    scratch: Scratch,
    pub(super) state: State,
    straight: Straight,
}

/// Coordinates of cables that a step bent, as they were before it.
#[derive(Clone, Debug, Default)]
struct Straight {
    cables: Vec<usize>,
    q: Vec<f64>,
    /// How many strains at which they were bent before there are of each, and the strains.
    counts: Vec<usize>,
    bent_at: Vec<f64>,
}

impl Straight {
    /// Bends the struts among the cables.
    fn bend(&mut self, cables: &mut [&mut Cable]) {
        self.cables.clear();
        self.q.clear();
        self.counts.clear();
        self.bent_at.clear();
        for (i, cable) in cables.iter_mut().enumerate() {
            cable.stop_ended();
            cable.bend_struts(|cable| {
                let bent_at = &cable.snapshot.state.memory.bent_at;
                self.cables.push(i);
                self.q.extend(cable.positions());
                self.counts.push(bent_at.len());
                self.bent_at.extend(bent_at);
            });
        }
    }

    /// Makes them straight again, as a step that failed leaves them.
    fn put_back(&self, cables: &mut [&mut Cable]) {
        let (mut q, mut bent_at) = (self.q.as_slice(), self.bent_at.as_slice());
        for (&i, &count) in self.cables.iter().zip(&self.counts) {
            let State { q: own, memory, .. } = &mut cables[i].snapshot.state;
            let first = q.split_off(..own.len()).unwrap_or_default();
            own.copy_from_slice(first);
            memory.bent_at.clear();
            memory.bent_at.extend(bent_at.split_off(..count).unwrap_or_default());
        }
    }
}

impl Island {
    /// Advances `cables` and `bodies`, held together by `pins`, by `dt` (s) with `integrator`.
    /// Cables touch bodies that carry their [obstacles](crate::contact::Obstacle::on).
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the step fails; [`Error::Pin`], [`Error::NotInIsland`] or
    /// [`Error::OutOfRange`] for a pin that fits no attached node, cable or body;
    /// [`Error::EmptyIsland`] and [`Error::TimeMismatch`]; [`Error::ObstacleBody`] for an obstacle
    /// on a body that is not there; and as [`Cable::step_with`](Cable::step_with). Cables and
    /// bodies are then exactly as before.
    pub fn step(
        &mut self,
        cables: &mut [&mut Cable],
        bodies: &mut [RigidBody],
        pins: &[PinConstraint],
        integrator: Integrator,
        dt: f64,
    ) -> Result<(), Error> {
        self.step_with(cables, bodies, pins, &integrator, dt)
    }

    /// Advances as [`step`](Self::step) does, with a method that may be of another crate.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_with<'i>(
        &mut self,
        cables: &mut [&mut Cable],
        bodies: &mut [RigidBody],
        pins: &[PinConstraint],
        integrator: impl Into<IntegratorRef<'i>>,
        dt: f64,
    ) -> Result<(), Error> {
        self.step_with_wheels(cables, bodies, pins, Wheels::default(), integrator.into(), dt)
    }

    /// Advances as [`step_with`](Self::step_with) does, with cables that run over sheaves and on
    /// drums.
    ///
    /// # Errors
    /// As [`step`](Self::step), and [`Error::ReelPlace`] for a sheave or drum that does not fit the
    /// cables; sheaves are then as before, too.
    pub fn step_with_wheels(
        &mut self,
        cables: &mut [&mut Cable],
        bodies: &mut [RigidBody],
        pins: &[PinConstraint],
        wheels: Wheels<'_>,
        integrator: IntegratorRef<'_>,
        dt: f64,
    ) -> Result<(), Error> {
        require("dt (s)", dt, dt == 0.0 || dt >= SMALLEST, "0, or >= 1e-100")?;
        integrator.check()?;
        check(cables, bodies, pins)?;
        cables.iter().try_for_each(|cable| check_integrator(&cable.model, integrator.method))?;
        cables.iter().try_for_each(|cable| check_torsion(&cable.model, integrator.method, "an attachment"))?;
        cables.iter().try_for_each(|cable| cable.model.obstacles.check_bodies(cable.name(), bodies.len()))?;
        reel::check(cables, bodies, pins, (&*wheels.sheaves, wheels.drums))?;
        coupling::check(&self.layout.coupled, bodies.len())?;
        if dt == 0.0 {
            return Ok(());
        }
        reel::prepare(cables, bodies, pins, integrator.method, dt)?;
        let mut straight = std::mem::take(&mut self.straight);
        straight.bend(cables);
        reel::begin(&mut self.by_discrete_gradient.unknowns, cables, pins, &wheels, dt);
        cables.iter_mut().for_each(|cable| cable.take_workspace());
        let outcome = self.step_in_workspaces(cables, bodies, pins, integrator, dt);
        cables.iter_mut().rev().for_each(|cable| cable.return_workspace());
        reel::end(&self.by_discrete_gradient.unknowns, cables, wheels, outcome.is_ok());
        if outcome.is_err() {
            straight.put_back(cables);
        }
        self.straight = straight;
        outcome
    }

    fn step_in_workspaces(
        &mut self,
        cables: &mut [&mut Cable],
        bodies: &mut [RigidBody],
        pins: &[PinConstraint],
        integrator: IntegratorRef<'_>,
        dt: f64,
    ) -> Result<(), Error> {
        cables.iter_mut().for_each(|cable| cable.begin_accounts());
        let Island { layout, matrices, accounts, vectors, by_discrete_gradient: buffers, scratch, state, .. } = self;
        layout.begin(cables, bodies, pins, dt);
        matrices.begin(layout);
        accounts.begin(cables, layout);
        vectors.resize(layout.size());
        gather(cables, bodies, state);
        if integrator.method.uses_discrete_gradients() {
            return HostStep { cables, bodies, layout, matrices, accounts, vectors, buffers, state }
                .run(integrator, dt);
        }
        memory::recall(cables, bodies, layout, state);
        let equations = IslandEquations { cables: &mut *cables, layout, matrices };
        let mut system = IslandDynamics { equations, accounts, norm: integrator.norm(), vectors };
        if let Err(failure) = system.match_velocities(state) {
            return Err(cables[0].step_failed(state.time, 0.0, failure));
        }
        let (counts, outcome) = step_control::advance(&mut system, integrator, state, dt, scratch);
        for cable in cables.iter_mut() {
            let diagnostics = cable.diagnostics_mut();
            diagnostics.steps += counts.steps;
            diagnostics.rejected_steps += counts.rejected;
        }
        if let Err(failed) = outcome {
            return Err(cables[0].step_failed(failed.time, failed.step, failed.failure));
        }
        memory::keep(cables, bodies, pins, state);
        scatter(cables, bodies, state, layout);
        self.accounts.balance(&self.layout, bodies, dt);
        self.accounts.end(cables, &self.layout);
        Ok(())
    }

    /// Sets which cables may touch each other, and with which friction, in the steps that follow:
    /// `None`, the default, for all that have contact with cables, with the mean of their
    /// coefficients.
    pub fn set_cable_pairs(&mut self, pairs: Option<&[CablePair]>) {
        let own = &mut self.by_discrete_gradient.may_touch;
        let mut list = own.take().unwrap_or_default();
        if let Some(pairs) = pairs {
            list.clear();
            list.extend_from_slice(pairs);
            list.iter_mut().for_each(|pair| pair.cables.sort_unstable());
            list.sort_unstable_by_key(|pair| pair.cables);
            *own = Some(list);
        }
    }

    /// Sets the inertia that couples bodies in the next steps. Default: none.
    pub fn couple(&mut self, coupled: &[CoupledInertia]) {
        self.layout.coupled.clear();
        self.layout.coupled.extend_from_slice(coupled);
    }

    /// Returns forces, impulses and work at each pin during the last step.
    pub fn accounts(&self) -> &[PinAccount] {
        &self.accounts.pins
    }
}

/// Collects the coordinates of cables, then of bodies (position, rotation vector from the present
/// attitude).
pub(super) fn gather(cables: &[&mut Cable], bodies: &[RigidBody], state: &mut State) {
    state.q.clear();
    state.v.clear();
    for cable in cables {
        state.q.extend_from_slice(cable.positions());
        state.v.extend_from_slice(cable.velocities());
    }
    for body in bodies {
        state.q.extend(body.position.iter().chain(&[0.0; 3]));
        state.v.extend(body.velocity.iter().chain(body.angular_velocity.iter()));
    }
    state.time = cables[0].time();
    let memories = || cables.iter().map(|cable| &cable.snapshot.state.memory);
    state.memory.step = memories().map(|memory| memory.step).fold(f64::INFINITY, f64::min);
    // a vibration moves the bodies, so its errors add up for them
    state.memory.coherence = 1.0;
    state.memory.energy_made = memories().map(|memory| memory.energy_made).fold(0.0, f64::max);
    state.memory.largest_energy = memories().map(|memory| memory.largest_energy).fold(0.0, f64::max);
}

/// Returns the coordinates to cables and bodies.
fn scatter(cables: &mut [&mut Cable], bodies: &mut [RigidBody], state: &State, layout: &Layout) {
    for (cable, part) in cables.iter_mut().zip(&layout.parts) {
        let Cable { snapshot, system, buffers, .. } = &mut **cable;
        // the positions when the host step began
        buffers.rhs.copy_from_slice(&snapshot.state.q);
        snapshot.state.q.copy_from_slice(&state.q[part.range()]);
        snapshot.state.v.copy_from_slice(&state.v[part.range()]);
        snapshot.state.time = state.time;
        snapshot.state.memory.differences.clear();
        snapshot.add_work_of_step(system, &buffers.rhs);
        cable.diagnostics_mut().host_steps += 1;
    }
    for (i, body) in bodies.iter_mut().enumerate() {
        let at = layout.body_at(i);
        let motion = layout.motion(i, &state.q[at..at + 6], &state.v[at..at + 6]);
        body.position = motion.position;
        body.rotation = motion.rotation;
        body.velocity = motion.velocity;
        body.angular_velocity = motion.spin;
    }
}
