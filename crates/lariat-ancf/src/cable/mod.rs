//! A cable: its mesh, its state, and its step.

mod assembly;
pub mod builder;
mod cut;
mod effects;
pub mod energy;
mod equations;
pub mod exact;
mod fluid;
mod frequency;
mod hold;
mod kernel_effects;
mod layout;
pub mod linearise;
mod made;
mod model;
mod projection;
mod refine;
mod rest;
pub mod sample;
mod saved;
mod simd;
mod strategy;
mod system;

pub use crate::section::Element;
pub use model::Model;

use crate::diagnostics::Diagnostics;
use crate::effect::EffectWork;
use crate::error::{Error, StepFailure, require};
use crate::integrate::{Integrator, IntegratorRef, Scratch, State, step_control};
use crate::rule::Rule;
use builder::CableBuilder;
pub(crate) use effects::check_integrator;
pub(crate) use equations::Equations;
pub(crate) use fluid::Fluid;
pub(crate) use kernel_effects::Rates;
pub(crate) use layout::along_polyline;
use nalgebra::Vector3;
pub(crate) use projection::{project_matrix, project_vector};
use serde::{Deserialize, Serialize};
use system::System;

/// Shortest step in s: squares of its smallest part must not vanish.
pub(crate) const SHORTEST_STEP: f64 = 1e-100;

/// A point of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum At {
    /// The first node.
    Start,
    /// The last node.
    End,
    /// A node by number, from 0.
    Node(usize),
    /// An arc length of the unstretched cable in m.
    ArcLength(f64),
}

impl From<f64> for At {
    fn from(arc_length: f64) -> Self {
        At::ArcLength(arc_length)
    }
}

/// All that changes while a cable moves. Plain data: clone it, serialise it, put it back, and the run goes on bitwise the same.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    pub(crate) phase: State,
    /// Work of effects so far.
    #[serde(default)]
    pub(crate) work: EffectWork,
}

/// A cable of ANCF elements with its force strategy, integrator and state.
///
/// Serialises as its description and state; a deserialised cable continues bitwise the same run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "saved::Saved", into = "saved::Saved")]
pub struct Cable {
    pub(crate) model: Model,
    pub(crate) state: Snapshot,
    integrator: Integrator,
    diagnostics: Diagnostics,
    pub(crate) system: System,
    scratch: Scratch,
    /// State at the beginning of the host step, to go back to.
    saved: State,
    /// Counts changes of supports, loads and integrator.
    pub(crate) revision: u64,
}

impl Cable {
    /// Starts building a cable.
    pub fn builder() -> CableBuilder {
        CableBuilder::default()
    }

    pub(crate) fn from_parts(model: Model, state: Snapshot, integrator: Integrator) -> Result<Self, Error> {
        model.check().map_err(|e| e.of_cable(&model.name))?;
        state.phase.check(&model.name, 6 * model.nodes())?;
        let system = System::new(&model).map_err(|failure| Error::StepFailed {
            cable: model.name.clone(),
            time: state.phase.time,
            at: state.phase.time,
            step: 0.0,
            failure,
        })?;
        check_integrator(&model, &integrator.method)?;
        Ok(Cable {
            model,
            state,
            integrator: integrator.checked()?,
            diagnostics: Diagnostics::default(),
            system,
            scratch: Scratch::default(),
            saved: State::default(),
            revision: 0,
        })
    }

    /// Advances the cable by `dt` (s), the host's step, with its integrator. `dt` = 0 does nothing.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a `dt` that is negative, not finite, or below 1e-100 and not zero; [`Error::StepFailed`] if
    /// the step failed: the cable is then exactly as before. [`Error::Attached`] for a cable with
    /// [attached](Self::attach) nodes, which only an [`island`](crate::island) can step.
    pub fn step(&mut self, dt: f64) -> Result<(), Error> {
        let integrator = self.integrator;
        self.step_with(dt, &integrator)
    }

    /// Advances the cable as [`step`](Self::step) does, with this integrator instead of the cable's own: `&Integrator`, or an
    /// [`IntegratorRef`] with a method of another crate.
    ///
    /// # Errors
    /// As [`step`](Self::step), [`Integrator::checked`] and [`set_integrator`](Self::set_integrator).
    pub fn step_with<'a>(&mut self, dt: f64, integrator: impl Into<IntegratorRef<'a>>) -> Result<(), Error> {
        let integrator = integrator.into();
        integrator.check()?;
        check_integrator(&self.model, integrator.method)?;
        require("dt (s)", dt, dt == 0.0 || dt >= SHORTEST_STEP, "0, or >= 1e-100")
            .map_err(|e| e.of_cable(self.name()))?;
        if dt == 0.0 {
            return Ok(());
        }
        self.check_not_attached()?;
        self.saved.copy_from(&self.state.phase);
        self.refresh_memory();
        self.system.work = EffectWork::default();
        let mut equations =
            Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        let phase = &mut self.state.phase;
        let (counts, outcome) = step_control::advance(&mut equations, integrator, phase, dt, &mut self.scratch);
        self.diagnostics.steps += counts.steps;
        self.diagnostics.rejected_steps += counts.rejected;
        match outcome {
            Ok(()) => {
                self.diagnostics.host_steps += 1;
                let saved = core::mem::take(&mut self.saved);
                self.settle(&saved.q);
                self.saved = saved;
                Ok(())
            }
            Err(failed) => {
                core::mem::swap(&mut self.state.phase, &mut self.saved);
                Err(self.step_failed(failed.time, failed.step, failed.failure))
            }
        }
    }

    pub(crate) fn step_failed(&self, at: f64, step: f64, failure: StepFailure) -> Error {
        log::warn!("cable {:?}: step failed at t = {at} s: {failure}", self.model.name);
        Error::StepFailed { cable: self.model.name.clone(), time: self.time(), at, step, failure }
    }

    /// Accelerations of another description of the cable (a snapshot from before a change) are not used.
    pub(crate) fn refresh_memory(&mut self) {
        let memory = &mut self.state.phase.memory;
        if memory.revision != self.revision {
            memory.valid = false;
            memory.step = 0.0;
            memory.revision = self.revision;
        }
    }

    pub(crate) fn check_not_attached(&self) -> Result<(), Error> {
        match self.model.supports.iter().find(|(_, s)| s.attached) {
            None => Ok(()),
            Some((node, _)) => Err(Error::Attached { cable: self.name().to_string(), node: *node }),
        }
    }

    pub(crate) fn equations(&mut self) -> (Equations<'_>, &State) {
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        (equations, &self.state.phase)
    }

    /// Name.
    pub fn name(&self) -> &str {
        &self.model.name
    }

    /// Time of the state in s.
    pub fn time(&self) -> f64 {
        self.state.phase.time
    }

    /// Unstretched length in m.
    pub fn length(&self) -> f64 {
        self.model.length()
    }

    /// Elements: lengths and sections.
    pub fn elements(&self) -> &[Element] {
        &self.model.elements
    }

    /// Number of nodes: one more than elements.
    pub fn nodes(&self) -> usize {
        self.model.nodes()
    }

    /// Arc lengths of the nodes in m, ascending from 0.
    pub fn node_arc_lengths(&self) -> Vec<f64> {
        self.model.node_arc_lengths()
    }

    /// Force strategy.
    pub fn rule(&self) -> Rule {
        self.model.rule
    }

    /// Gravity in m/s^2.
    pub fn gravity(&self) -> Vector3<f64> {
        self.model.gravity
    }

    /// Nodal coordinates, flat: by node the position (m) and the slope dr/ds.
    pub fn positions(&self) -> &[f64] {
        &self.state.phase.q
    }

    /// Nodal velocities, flat: by node m/s and 1/s.
    pub fn velocities(&self) -> &[f64] {
        &self.state.phase.v
    }

    /// Position of a node in m.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn node_position(&self, node: usize) -> Vector3<f64> {
        Vector3::from_column_slice(&self.positions()[6 * node..6 * node + 3])
    }

    /// Counts of what was done.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    /// Counts, to reset them.
    pub fn diagnostics_mut(&mut self) -> &mut Diagnostics {
        &mut self.diagnostics
    }

    /// Time integrator.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// Changes the time integrator from the next step on.
    ///
    /// # Errors
    /// As [`Integrator::checked`]; [`Error::ExplicitDamping`] for an explicit method on a cable with internal damping.
    pub fn set_integrator(&mut self, integrator: Integrator) -> Result<(), Error> {
        check_integrator(&self.model, &integrator.method)?;
        self.integrator = integrator.checked()?;
        self.revise();
        Ok(())
    }

    /// An upper bound of the cable's angular frequencies in rad/s.
    pub fn frequency_bound(&self) -> f64 {
        self.system.frequency_bound
    }

    /// The state: clone it to take a snapshot.
    pub fn snapshot(&self) -> &Snapshot {
        &self.state
    }

    /// Puts a state back; the run then continues bitwise as it did from there (if supports, loads, effects and integrator are
    /// as they were, else from its positions and velocities).
    ///
    /// # Errors
    /// [`Error::WrongCount`] if the state is of a cable with another number of nodes, [`Error::InvalidValue`] if it is not
    /// finite.
    pub fn restore(&mut self, state: Snapshot) -> Result<(), Error> {
        state.phase.check(self.name(), self.positions().len())?;
        let works = state.work.by_key();
        works
            .map(|(_, x)| require("work of effects (J)", x, true, "a number"))
            .collect::<Result<(), Error>>()
            .map_err(|e| e.of_cable(self.name()))?;
        self.state = state;
        Ok(())
    }

    /// Sets nodal coordinates and velocities, flat as [`positions`](Self::positions) and [`velocities`](Self::velocities).
    ///
    /// # Errors
    /// [`Error::WrongCount`] for the wrong number, [`Error::InvalidValue`] for numbers that are not finite.
    pub fn set_coordinates(&mut self, positions: &[f64], velocities: &[f64]) -> Result<(), Error> {
        let n = self.positions().len();
        for (what, each, given) in [("coordinates", "coordinate", positions), ("velocities", "velocity", velocities)] {
            if given.len() != n {
                let (cable, count) = (self.name().to_string(), given.len());
                return Err(Error::WrongCount { cable, what, count, expected: n });
            }
            given.iter().try_for_each(|&x| require(each, x, true, "a number")).map_err(|e| e.of_cable(self.name()))?;
        }
        self.state.phase.q.copy_from_slice(positions);
        self.state.phase.v.copy_from_slice(velocities);
        self.disturb();
        Ok(())
    }

    /// The state changed under the integrator: accelerations must be computed anew.
    pub(crate) fn disturb(&mut self) {
        self.state.phase.memory.valid = false;
        self.state.phase.memory.step = 0.0;
    }

    /// Supports, loads or integrator changed: states from before keep their positions and velocities only.
    pub(crate) fn revise(&mut self) {
        self.revision += 1;
        self.refresh_memory();
    }

    pub(crate) fn check_arc_length(&self, s: f64) -> Result<(), Error> {
        let limit = self.length();
        if s >= 0.0 && s <= limit * (1.0 + 1e-12) {
            Ok(())
        } else {
            Err(Error::OutOfRange { cable: self.name().to_string(), what: "arc length", value: s, limit })
        }
    }

    /// Arc length of a point in m.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not on the cable.
    pub fn arc_length(&self, at: impl Into<At>) -> Result<f64, Error> {
        match at.into() {
            At::Start => Ok(0.0),
            At::End => Ok(self.length()),
            At::Node(i) => self.node_arc_lengths().get(i).copied().ok_or_else(|| self.no_node(i as f64)),
            At::ArcLength(s) => self.check_arc_length(s).map(|()| s),
        }
    }

    fn no_node(&self, value: f64) -> Error {
        let limit = self.model.elements.len() as f64;
        Error::OutOfRange { cable: self.name().to_string(), what: "node", value, limit }
    }

    /// Number of the node at a point.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not on the cable, [`Error::NoNode`] if no node is within 1e-9 of the length.
    pub fn node(&self, at: impl Into<At>) -> Result<usize, Error> {
        let s = self.arc_length(at)?;
        let nodes = self.node_arc_lengths();
        nodes.iter().position(|x| (x - s).abs() <= 1e-9 * self.length()).ok_or_else(|| {
            let nearest = nodes.iter().copied().min_by(|a, b| (a - s).abs().total_cmp(&(b - s).abs())).unwrap_or(0.0);
            Error::NoNode { cable: self.name().to_string(), arc_length: s, nearest }
        })
    }
}
