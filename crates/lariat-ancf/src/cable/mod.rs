//! A cable: its description, its state, and its step.
//!
//! | file | what it holds |
//! |---|---|
//! | [`builder`], `layout` | building a cable |
//! | `state` | reading and changing the state; snapshots |
//! | `supports`, `loads`, `effects` | what acts on it, changed between steps |
//! | `edit` | breaking, cutting, refining, changing the rule |
//! | `reel` | reels at the ends, which change the length |
//! | [`sample`], [`reactions`], [`energy`] | reading results |
//! | [`mesh`] | how far the mesh resolves the shape |
//! | [`linearise`] | matrices at the present state |
//! | `workspace`, [`fleet`] | buffers of a step, shared by cables; a step of many |

pub mod builder;
mod edit;
mod effects;
pub mod energy;
pub mod fleet;
mod layout;
pub mod linearise;
mod loads;
pub mod mesh;
pub mod reactions;
mod reel;
pub mod sample;
mod saved;
mod state;
mod supports;
mod workspace;

use crate::diagnostics::Diagnostics;
use crate::error::{Error, StepFailure, require};
use crate::integrate::{
    Integrator, IntegratorChoice, IntegratorRef, OneStep, Scratch, State, discrete_gradient, step_control,
};
use crate::model::Model;
use crate::rule::Rule;
use crate::section::Element;
use crate::system::{Buffers, CableDynamics, CableStep, Equations, System};
use crate::warning::Watch;
use builder::CableBuilder;
use fearless_simd::Level;
pub(crate) use layout::along_polyline;
use nalgebra::Vector3;
pub use reel::{Feed, Reel, ReelReading, Reels};
use serde::{Deserialize, Serialize};
pub use state::Snapshot;

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

/// A cable of ANCF elements with its rule, integrator and state.
///
/// Serialises as its description and state; a deserialised cable continues bitwise the same run. JSON needs `serde_json` with its
/// feature `float_roundtrip`: without it, numbers are read back changed in the last bit.
///
/// # Validity
///
/// - "Linear elastic" is the St Venant-Kirchhoff law on the Green strain, N = EA (f^2 - 1)/2 f per unstretched length: a good law within a
///   few percent of stretch f = 1, too stiff in large extension, too soft in large compression (its stiffness vanishes at f = 0.577).
/// - No torsion: the section rotates freely about the axis, and no moment about it is transmitted.
/// - [Contact](crate::contact) with obstacles, fixed or moving as prescribed, and with itself.
/// - The unstretched length is constant, but for [`cut`](Self::cut) and a [reel](Self::add_reel).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "saved::Saved", into = "saved::Saved")]
pub struct Cable {
    pub(crate) model: Model,
    pub(crate) snapshot: Snapshot,
    integrator: Integrator,
    /// Whether the integrator is the default, because nobody chose one.
    pub(crate) default_integrator: bool,
    diagnostics: Diagnostics,
    pub(crate) system: System,
    // The rest of a [workspace](self::workspace): empty between two steps.
    pub(crate) buffers: Buffers,
    pub(crate) step_buffers: discrete_gradient::Buffers,
    scratch: Scratch,
    /// State at the beginning of the host step, restored if it fails.
    before: State,
    /// Readings of the host steps, if they are asked for.
    pub(crate) watch: Option<Box<Watch>>,
    /// Counts changes of supports, loads, effects and integrator.
    pub(crate) revision: u64,
}

impl Cable {
    /// Starts building a cable.
    pub fn builder() -> CableBuilder {
        CableBuilder::default()
    }

    pub(crate) fn from_parts(mut model: Model, snapshot: Snapshot, integrator: Integrator) -> Result<Self, Error> {
        model.check().map_err(|e| e.of_cable(&model.name))?;
        snapshot.state.check(&model.name, 6 * model.nodes())?;
        if model.load_origins.len() != model.loads.len() {
            model.note_load_origins(snapshot.passed_at_start());
        }
        let system = System::new(&model).map_err(|failure| Error::StepFailed {
            cable: model.name.clone(),
            time: snapshot.state.time,
            at: snapshot.state.time,
            step: 0.0,
            failure,
        })?;
        check_integrator(&model, &integrator.method)?;
        let mut cable = Cable {
            integrator: integrator.checked()?,
            default_integrator: false,
            diagnostics: Diagnostics::default(),
            system,
            buffers: Buffers::default(),
            step_buffers: discrete_gradient::Buffers::default(),
            scratch: Scratch::default(),
            before: State::default(),
            watch: None,
            revision: 0,
            model,
            snapshot,
        };
        cable.sync_reel();
        Ok(cable)
    }

    /// Replaces the description, and builds everything anew that is derived from it.
    fn rebuild(&mut self, model: Model) -> Result<(), Error> {
        let system = System::with_level(&model, self.system.level);
        self.system = system.map_err(|failure| self.step_failed(self.time(), 0.0, failure))?;
        self.model = model;
        self.sync_reel();
        Ok(())
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
        self.check_complete()?;
        self.model.obstacles.check_bodies(self.name(), 0)?;
        if self.has_reel() {
            self.step_with_reel(dt, integrator)?;
        } else {
            self.with_workspace(|cable| cable.step_in_workspace(dt, integrator))?;
        }
        self.note_step();
        Ok(())
    }

    fn step_in_workspace(&mut self, dt: f64, integrator: IntegratorRef<'_>) -> Result<(), Error> {
        self.before.copy_from(&self.snapshot.state);
        self.refresh_memory();
        self.system.meter.begin();
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        let state = &mut self.snapshot.state;
        let (counts, outcome) = if integrator.method.uses_discrete_gradients() {
            let mut cable = CableStep { equations, state, buffers: &mut self.step_buffers };
            discrete_gradient::advance(&mut cable, integrator, dt)
        } else {
            state.memory.differences.clear();
            let mut dynamics = CableDynamics { equations, buffers: &mut self.buffers };
            step_control::advance(&mut dynamics, integrator, state, dt, &mut self.scratch)
        };
        self.diagnostics.steps += counts.steps;
        self.diagnostics.rejected_steps += counts.rejected;
        match outcome {
            Ok(()) => {
                self.diagnostics.host_steps += 1;
                self.snapshot.add_work_of_step(&mut self.system, &self.before.q);
                Ok(())
            }
            Err(failed) => {
                self.snapshot.state.copy_from(&self.before);
                Err(self.step_failed(failed.time, failed.step, failed.failure))
            }
        }
    }

    pub(crate) fn step_failed(&self, at: f64, step: f64, failure: StepFailure) -> Error {
        log::warn!("cable {:?}: step failed at t = {at} s: {failure}", self.model.name);
        Error::StepFailed { cable: self.model.name.clone(), time: self.time(), at, step, failure }
    }

    /// Rejects a cable that cannot be stepped by itself.
    pub(crate) fn check_complete(&self) -> Result<(), Error> {
        self.check_forces()?;
        if self.model.reels.sides().any(|side| self.needs_island(side)) {
            let reason = "its end is at a sheave or on a drum: only an island with that sheave or drum steps it";
            return Err(Error::ReelPlace { cable: self.name().to_string(), reason });
        }
        match self.model.supports.iter().find(|(_, s)| s.attached) {
            None => Ok(()),
            Some((node, _)) => Err(Error::Attached { cable: self.name().to_string(), node: *node }),
        }
    }

    pub(crate) fn equations(&mut self) -> (Equations<'_>, &mut State) {
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        (equations, &mut self.snapshot.state)
    }

    pub(crate) fn step_parts(&mut self) -> CableStep<'_> {
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        CableStep { equations, state: &mut self.snapshot.state, buffers: &mut self.step_buffers }
    }

    pub(crate) fn dynamics(&mut self) -> (CableDynamics<'_>, &State) {
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        (CableDynamics { equations, buffers: &mut self.buffers }, &self.snapshot.state)
    }

    /// Forces a SIMD level, for benchmarks and for the test that all levels agree. Not part of the state.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix cannot be factored.
    #[doc(hidden)]
    pub fn set_simd_level(&mut self, level: Level) -> Result<(), Error> {
        self.system.level = level;
        let failure = self.system.factor_mass(&self.model).err();
        failure.map_or(Ok(()), |failure| Err(self.step_failed(self.time(), 0.0, failure)))
    }

    /// Returns the name.
    pub fn name(&self) -> &str {
        &self.model.name
    }

    /// Returns the time of the state in s.
    pub fn time(&self) -> f64 {
        self.snapshot.state.time
    }

    /// Returns the unstretched length in m.
    pub fn length(&self) -> f64 {
        self.model.length()
    }

    /// Returns the elements: lengths and sections.
    pub fn elements(&self) -> &[Element] {
        &self.model.elements
    }

    /// Returns the number of nodes: one more than elements.
    pub fn nodes(&self) -> usize {
        self.model.nodes()
    }

    /// Returns the arc lengths of the nodes in m, ascending from 0.
    pub fn node_arc_lengths(&self) -> Vec<f64> {
        self.model.node_arc_lengths()
    }

    /// Returns the rule of the elastic forces.
    pub fn rule(&self) -> Rule {
        self.model.rule
    }

    /// Returns gravity in m/s^2.
    pub fn gravity(&self) -> Vector3<f64> {
        self.model.gravity
    }

    /// Returns the position of a node in m.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn node_position(&self, node: usize) -> Vector3<f64> {
        Vector3::from_column_slice(&self.positions()[6 * node..6 * node + 3])
    }

    /// Returns the counters.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    /// Returns the counters, to reset them.
    pub fn diagnostics_mut(&mut self) -> &mut Diagnostics {
        &mut self.diagnostics
    }

    /// Returns the time integrator.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// Returns the integrator that `choice` means for this cable: an implicit one where internal damping needs it.
    pub fn integrator_for(&self, choice: impl Into<IntegratorChoice>) -> Integrator {
        let implicit = self.model.effects.needs_implicit_integrator();
        choice.into().integrator(if implicit { f64::INFINITY } else { self.frequency_bound() })
    }

    /// Returns whether the integrator is the builder's default, because nobody chose one. A set of cables may then give it its own.
    pub fn has_default_integrator(&self) -> bool {
        self.default_integrator
    }

    /// Changes the time integrator from the next step on.
    ///
    /// # Errors
    /// As [`Integrator::checked`]; [`Error::ExplicitDamping`] for an explicit method on a cable with internal damping.
    pub fn set_integrator(&mut self, integrator: Integrator) -> Result<(), Error> {
        check_integrator(&self.model, &integrator.method)?;
        self.integrator = integrator.checked()?;
        self.default_integrator = false;
        self.revise();
        Ok(())
    }

    /// Returns an upper bound of the cable's angular frequencies in rad/s; effects and forces of your own are not in it, but added mass and
    /// the rest stretch.
    pub fn frequency_bound(&self) -> f64 {
        self.system.scales.frequency_bound
    }

    pub(crate) fn check_arc_length(&self, s: f64) -> Result<(), Error> {
        let limit = self.length();
        if s >= 0.0 && s <= limit * (1.0 + 1e-12) {
            Ok(())
        } else {
            Err(Error::OutOfRange { cable: self.name().to_string(), what: "arc length", value: s, limit })
        }
    }

    /// Returns the arc length of a point in m.
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
        let (cable, limit) = (self.name().to_string(), self.model.elements.len() as f64);
        Error::OutOfRange { cable, what: "node", value, limit }
    }

    /// Returns the number of the node at a point.
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

/// Checks that a cable has an implicit method where an effect or a reel needs one, and the discrete gradient for contact.
pub(crate) fn check_integrator(model: &Model, method: &dyn OneStep) -> Result<(), Error> {
    if model.effects.contact.is_some() && !method.uses_discrete_gradients() {
        return Err(Error::ContactMethod { cable: model.name.clone(), method: method.name() });
    }
    if model.effects.needs_implicit_integrator() && method.stability_limit().is_some() {
        return Err(Error::ExplicitDamping { cable: model.name.clone(), method: method.name() });
    }
    if !model.reels.is_empty() && method.stability_limit().is_some() {
        return Err(Error::ExplicitReel { cable: model.name.clone(), method: method.name() });
    }
    if model.reels.have_laws() && !method.uses_discrete_gradients() {
        return Err(Error::ReelMethod { cable: model.name.clone(), method: method.name() });
    }
    Ok(())
}
