//! A cable: its mesh, its state, and its step.

mod assembly;
pub mod builder;
pub mod energy;
mod equations;
mod frequency;
mod layout;
pub mod linearise;
mod model;
mod projection;
pub mod sample;
mod simd;
mod system;

pub use model::{Element, Model};

use crate::diagnostics::Diagnostics;
use crate::error::{Error, StepFailure, require, require_finite};
use crate::integrate::drive::{self, Counts};
use crate::integrate::{Integrator, Phase, Scratch};
use crate::load::PointLoad;
use crate::rule::Rule;
use crate::support::{Motion, SlopeSupport, Support};
use builder::CableBuilder;
pub(crate) use equations::Equations;
pub(crate) use layout::along_polyline;
use nalgebra::Vector3;
pub(crate) use projection::{project_matrix, project_vector};
use serde::{Deserialize, Serialize};
use system::System;

/// Shortest step in s: squares of its smallest part must not vanish.
const SHORTEST_STEP: f64 = 1e-100;

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
pub struct State {
    pub(crate) phase: Phase,
}

/// A cable of ANCF elements with its force strategy, integrator and state.
///
/// Serialises as its description and state; a deserialised cable continues bitwise the same run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "Saved", into = "Saved")]
pub struct Cable {
    pub(crate) model: Model,
    pub(crate) state: State,
    integrator: Integrator,
    diagnostics: Diagnostics,
    pub(crate) system: System,
    scratch: Scratch,
    /// State at the beginning of the host step, to go back to.
    saved: Phase,
}

/// A cable as it is serialised.
#[derive(Clone, Serialize, Deserialize)]
#[serde(rename = "Cable")]
struct Saved {
    model: Model,
    state: State,
    integrator: Integrator,
    diagnostics: Diagnostics,
}

impl From<Cable> for Saved {
    fn from(cable: Cable) -> Self {
        let Cable { model, state, integrator, diagnostics, .. } = cable;
        Saved { model, state, integrator, diagnostics }
    }
}

impl TryFrom<Saved> for Cable {
    type Error = Error;
    fn try_from(saved: Saved) -> Result<Self, Error> {
        let mut cable = Cable::from_parts(saved.model, saved.state, saved.integrator)?;
        cable.diagnostics = saved.diagnostics;
        Ok(cable)
    }
}

impl Cable {
    /// Starts building a cable.
    pub fn builder() -> CableBuilder {
        CableBuilder::default()
    }

    pub(crate) fn from_parts(model: Model, state: State, integrator: Integrator) -> Result<Self, Error> {
        let n = 6 * model.nodes();
        if model.elements.is_empty() || state.phase.q.len() != n || state.phase.v.len() != n {
            return Err(Error::InvalidShape {
                cable: model.name,
                reason: format!("{} coordinates do not fit {} elements", state.phase.q.len(), model.elements.len()),
            });
        }
        let system = System::new(&model).map_err(|failure| Error::StepRefused {
            cable: model.name.clone(),
            time: state.phase.time,
            step: 0.0,
            failure,
        })?;
        Ok(Cable {
            model,
            state,
            integrator: integrator.checked()?,
            diagnostics: Diagnostics::default(),
            system,
            scratch: Scratch::default(),
            saved: Phase::default(),
        })
    }

    /// Advances the cable by `dt` (s), the host's step, with its integrator. `dt` = 0 does nothing.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a `dt` that is negative, not finite, or below 1e-100 and not zero; [`Error::StepRefused`] if the step cannot be done: the cable
    /// is then exactly as before.
    pub fn step(&mut self, dt: f64) -> Result<(), Error> {
        require("dt (s)", dt, dt == 0.0 || dt >= SHORTEST_STEP, "0, or >= 1e-100")?;
        if dt == 0.0 {
            return Ok(());
        }
        self.saved.copy_from(&self.state.phase);
        let mut counts = Counts::default();
        let mut equations =
            Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        let Integrator { method, control } = self.integrator;
        let phase = &mut self.state.phase;
        let outcome = drive::advance(&mut equations, method, control, phase, dt, &mut self.scratch, &mut counts);
        self.diagnostics.steps += counts.steps;
        self.diagnostics.rejected_steps += counts.rejected;
        match outcome {
            Ok(()) => {
                self.diagnostics.host_steps += 1;
                Ok(())
            }
            Err(refusal) => {
                core::mem::swap(&mut self.state.phase, &mut self.saved);
                Err(self.refused(refusal.time, refusal.step, refusal.failure))
            }
        }
    }

    pub(crate) fn refused(&self, time: f64, step: f64, failure: StepFailure) -> Error {
        log::warn!("cable {:?}: step refused at t = {time} s: {failure}", self.model.name);
        Error::StepRefused { cable: self.model.name.clone(), time, step, failure }
    }

    pub(crate) fn equations(&mut self) -> (Equations<'_>, &Phase) {
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
    /// As [`Integrator::checked`].
    pub fn set_integrator(&mut self, integrator: Integrator) -> Result<(), Error> {
        self.integrator = integrator.checked()?;
        self.disturb();
        Ok(())
    }

    /// An upper bound of the cable's angular frequencies in rad/s.
    pub fn frequency_bound(&self) -> f64 {
        self.system.frequency_bound
    }

    /// The state: clone it to take a snapshot.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Puts a state back; the run then continues bitwise as it did from there.
    ///
    /// # Errors
    /// [`Error::InvalidShape`] if the state is of a cable with another number of nodes.
    pub fn restore(&mut self, state: State) -> Result<(), Error> {
        if state.phase.q.len() != self.positions().len() {
            return Err(Error::InvalidShape {
                cable: self.name().to_string(),
                reason: format!("a state of {} nodes does not fit {}", state.phase.q.len() / 6, self.nodes()),
            });
        }
        self.state = state;
        Ok(())
    }

    /// Sets nodal coordinates and velocities, flat as [`positions`](Self::positions) and [`velocities`](Self::velocities).
    ///
    /// # Errors
    /// [`Error::InvalidShape`] for the wrong number, [`Error::InvalidValue`] for numbers that are not finite.
    pub fn set_coordinates(&mut self, positions: &[f64], velocities: &[f64]) -> Result<(), Error> {
        let n = self.positions().len();
        if positions.len() != n || velocities.len() != n {
            return Err(Error::InvalidShape {
                cable: self.name().to_string(),
                reason: format!("needs {n} coordinates, got {} and {}", positions.len(), velocities.len()),
            });
        }
        positions.iter().try_for_each(|&x| require("coordinate", x, true, "a number"))?;
        velocities.iter().try_for_each(|&x| require("velocity", x, true, "a number"))?;
        self.state.phase.q.copy_from_slice(positions);
        self.state.phase.v.copy_from_slice(velocities);
        self.disturb();
        Ok(())
    }

    /// The state or the equations changed under the integrator: accelerations must be computed anew.
    pub(crate) fn disturb(&mut self) {
        self.state.phase.memory.valid = false;
        self.state.phase.memory.step = 0.0;
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
    /// [`Error::OutOfRange`] if it is not on the cable, [`Error::InvalidShape`] if no node is within 1e-9 of the length.
    pub fn node(&self, at: impl Into<At>) -> Result<usize, Error> {
        let s = self.arc_length(at)?;
        let near = |x: &f64| (x - s).abs() <= 1e-9 * self.length();
        self.node_arc_lengths().iter().position(near).ok_or_else(|| Error::InvalidShape {
            cable: self.name().to_string(),
            reason: format!("no node at arc length {s} m: ask for one with node_at when building"),
        })
    }

    /// What holds a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn support(&self, at: impl Into<At>) -> Result<Support, Error> {
        Ok(self.model.support(self.node(at)?).copied().unwrap_or_default())
    }

    /// Holds a node, or frees it with `Support::default()`. A prescribed position or slope jumps to its value at the next step.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::InvalidValue`] for numbers that are not finite or a direction that is not a unit vector.
    pub fn set_support(&mut self, at: impl Into<At>, support: Support) -> Result<(), Error> {
        let node = self.node(at)?;
        let motions = support.position.iter().chain(match &support.slope {
            SlopeSupport::Prescribed(motion) => Some(motion),
            _ => None,
        });
        for motion in motions {
            require("prescribed motion", if motion.is_finite() { 0.0 } else { f64::NAN }, true, "a number")?;
        }
        if let SlopeSupport::Direction(d) = support.slope {
            require("length of a clamp's direction", d.norm(), (d.norm() - 1.0).abs() < 1e-6, "1")?;
        }
        self.model.set_support(node, support);
        let failure = self.system.factor_mass(&self.model).err();
        self.disturb();
        failure.map_or(Ok(()), |failure| Err(self.refused(self.time(), 0.0, failure)))
    }

    /// Holds the position of a node where it is.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn fix(&mut self, at: impl Into<At>) -> Result<(), Error> {
        let node = self.node(at)?;
        let position = Some(Motion::fixed(self.node_position(node)));
        self.set_support(At::Node(node), Support { position, slope: SlopeSupport::Free, attached: false })
    }

    /// Prescribes the position of a node as `motion`, keeping what holds its slope; cheap if it was prescribed already.
    ///
    /// # Errors
    /// As [`set_support`](Self::set_support).
    pub fn set_motion(&mut self, node: usize, motion: Motion) -> Result<(), Error> {
        let support = self.support(At::Node(node))?;
        let new = Support { position: Some(motion), attached: false, ..support };
        if support.position.is_none() || !motion.is_finite() {
            return self.set_support(At::Node(node), new);
        }
        self.model.set_support(node, new);
        self.state.phase.memory.valid = false;
        Ok(())
    }

    /// Frees a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn release(&mut self, at: impl Into<At>) -> Result<(), Error> {
        self.set_support(at, Support::default())
    }

    /// Point loads.
    pub fn loads(&self) -> &[PointLoad] {
        &self.model.loads
    }

    /// Adds a point load.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an arc length off the cable, [`Error::InvalidValue`] for numbers that are not finite.
    pub fn add_load(&mut self, load: PointLoad) -> Result<(), Error> {
        self.check_arc_length(load.arc_length)?;
        require_finite("force (N)", &load.force)?;
        require_finite("moment (N m)", &load.moment)?;
        require("ramp (s)", load.ramp, load.ramp >= 0.0, ">= 0")?;
        self.model.loads.push(load);
        self.disturb();
        Ok(())
    }

    /// Removes all point loads.
    pub fn clear_loads(&mut self) {
        self.model.loads.clear();
        self.disturb();
    }
}
