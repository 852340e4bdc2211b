//! A cable: its description, its state, and its step.
//!
//! | file | what it holds |
//! |---|---|
//! | [`builder`], `layout` | building a cable |
//! | `grading` | its nodes, even or graded towards points |
//! | `unstrained` | laying it around corners without strain |
//! | `corner` | corners of the drawn shape, for parts that end there |
//! | `clamp` | clamps, their directions, and the start shape between them |
//! | `sag` | the side to which a slack cable is laid |
//! | `as_laid` | how it was drawn and laid |
//! | `turned` | parts with a free end, which turn with their clamps |
//! | `parts`, `check` | what steps it: its parts lent apart, and whether it can be stepped |
//! | `state`, `snapshot` | reading and changing the state; snapshots |
//! | `span` | the length by tension or sag |
//! | `strut` | the bend of a straight cable under compression |
//! | `supports`, `loads`, `potentials`, `effects` | what acts on it, changed between steps |
//! | `contact`, `overlap` | what it can touch, and what it touches |
//! | `prescribe` | points that are led to a place |
//! | `reel` | reels at the ends, which change the length |
//! | [`sample`], [`reactions`], [`energy`] | reading results |
//! | `carried` | tension and moment where equilibrium gives them |
//! | [`mesh`] | how far the mesh resolves the shape |
//! | [`linearise`] | matrices at the present state |
//! | `workspace` | buffers of a step, shared by cables |

mod as_laid;
pub mod builder;
mod carried;
mod check;
mod clamp;
mod contact;
mod corner;
mod effects;
pub mod energy;
mod friction;
mod grading;
mod layout;
pub mod linearise;
mod loads;
pub mod mesh;
mod overlap;
mod parts;
mod potentials;
mod prescribe;
pub mod reactions;
mod reel;
mod sag;
pub mod sample;
mod saved;
mod snapshot;
mod span;
mod state;
mod stripe;
mod strut;
mod supports;
mod torsion;
mod turned;
mod unstrained;
mod workspace;

pub(crate) use crate::at::At;
use crate::diagnostics::Diagnostics;
use crate::error::Error;
use crate::integrate::{Fidelity, Integrator, Scratch};
use crate::model::Model;
use crate::rule::Rule;
use crate::scales::cable::AT_NODE;
use crate::section::Element;
use crate::state::State;
use crate::system::{Buffers, StepVectors, System};
use crate::watch::{Passage, Watch};
use as_laid::{AsDrawn, Sagging};
pub(crate) use carried::Layer;
pub use carried::SharpBend;
pub(crate) use check::{check_integrator, check_torsion};
use fearless_simd::Level;
pub(crate) use layout::{Sag, along_polyline};
use nalgebra::Vector3;
pub use reel::ReelReading;
use serde::{Deserialize, Serialize};
pub use snapshot::Snapshot;
pub use torsion::TorsionReading;

/// A cable of ANCF elements with its rule, integrator and state.
///
/// Serialises as its description and state; a deserialised cable continues bitwise the same run.
/// JSON needs `serde_json` with its feature `float_roundtrip`: without it, numbers are read back
/// changed in the last bit. A [seal](crate::seal) around the bytes finds damage.
///
/// # Validity
///
/// - "Linear elastic" is the St Venant-Kirchhoff law on the Green strain, N = EA (f^2 - 1)/2 f per
///   unstretched length: a good law within a few percent of stretch f = 1, too stiff in large
///   extension, too soft in large compression (its stiffness vanishes at f = 0.577).
/// - Without [torsion](crate::Torsion) the section rotates freely about the axis, and no moment
///   about it is transmitted.
/// - [Contact](crate::contact) with obstacles, fixed or moving as prescribed, and with itself.
/// - The unstretched length is constant, but for [`cut`](Self::cut) and a [reel](Self::add_reel).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "saved::Saved", into = "saved::Saved")]
pub struct Cable {
    pub(crate) model: Model,
    pub(crate) snapshot: Snapshot,
    pub(crate) integrator: Integrator,
    /// Whether the integrator is the default, because nobody chose one.
    pub(crate) default_integrator: bool,
    pub(crate) diagnostics: Diagnostics,
    pub(crate) system: System,
    // The rest of a [workspace](self::workspace): empty between two steps.
    pub(crate) buffers: Buffers,
    pub(crate) step_buffers: StepVectors,
    pub(crate) scratch: Scratch,
    /// State at the beginning of the host step, restored if it fails.
    pub(crate) before: State,
    /// Readings of the host steps, if they are asked for.
    pub(crate) watch: Option<Box<Watch>>,
    /// The first of the [steps](Diagnostics::crossed_steps) in which it passed through what it can
    /// touch.
    pub(crate) passage: Option<Box<Passage>>,
    /// Force in N that the rounding of what holds it may make in a host step, if it is straight.
    pub(crate) end_noise: f64,
    /// Time in s at which an obstacle was last moved by its pose alone, its key, and by how far in
    /// m.
    posed: Option<(f64, u64, f64)>,
    /// Time in s at which it was built, or inserted among others.
    begins: f64,
    /// The shape before parts with free ends turned with their clamps, if they did.
    as_drawn: Option<Box<AsDrawn>>,
    /// How it was laid, if it is slack and without clamps.
    sagging: Option<Box<Sagging>>,
    /// Counts changes of supports, loads, effects and integrator.
    pub(crate) revision: u64,
}

impl Cable {
    pub(crate) fn from_parts(mut model: Model, snapshot: Snapshot, integrator: Integrator) -> Result<Self, Error> {
        model.check().map_err(|e| e.of_cable(&model.name))?;
        snapshot.state.check(&model.name, 6 * model.nodes())?;
        if !model.reels.is_empty() {
            let first = -snapshot.nodes_from_start();
            model.reels.check_numbers(first, model.elements.len()).map_err(|e| e.of_cable(&model.name))?;
        }
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
            step_buffers: StepVectors::default(),
            scratch: Scratch::default(),
            before: State::default(),
            watch: None,
            passage: None,
            end_noise: 0.0,
            posed: None,
            begins: 0.0,
            as_drawn: None,
            sagging: None,
            revision: 0,
            model,
            snapshot,
        };
        cable.sync_reel();
        Ok(cable)
    }

    /// Replaces the description, and builds everything anew that is derived from it.
    pub(crate) fn rebuild(&mut self, model: Model) -> Result<(), Error> {
        let system = System::with_level(&model, self.system.level);
        self.system = system.map_err(|failure| self.step_failed(self.time(), 0.0, failure))?;
        self.model = model;
        self.sync_reel();
        Ok(())
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn set_simd_level(&mut self, level: Level) -> Result<(), Error> {
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
        self.model.node_arc_lengths().collect()
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

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn diagnostics_mut(&mut self) -> &mut Diagnostics {
        &mut self.diagnostics
    }

    /// Returns the time integrator.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn integrator_for(&self, choice: impl Into<Fidelity>) -> Integrator {
        let (choice, model) = (choice.into(), &self.model);
        let coupled = model.effects.need_discrete_gradient() || model.reels.have_laws();
        if choice == Fidelity::Engineering && coupled {
            return Integrator::COUPLED;
        }
        let implicit = model.effects.needs_implicit_integrator();
        choice.integrator(if implicit { f64::INFINITY } else { self.frequency_bound() })
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn has_default_integrator(&self) -> bool {
        self.default_integrator
    }

    /// Changes the time integrator from the next step on.
    ///
    /// # Errors
    /// As [`Integrator::checked`]; [`Error::ExplicitDamping`] for an explicit method on a cable
    /// with internal damping.
    pub fn set_integrator(&mut self, integrator: Integrator) -> Result<(), Error> {
        check_integrator(&self.model, &integrator.method)?;
        self.integrator = integrator.checked()?;
        self.default_integrator = false;
        self.revise();
        Ok(())
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn frequency_bound(&self) -> f64 {
        self.system.scales.frequency_bound.hypot(self.torsion_frequency())
    }

    /// Returns an arc length that is on the cable; one within 1e-9 of the length beyond an end is
    /// at the end.
    pub(crate) fn on_cable(&self, s: f64) -> Result<f64, Error> {
        let limit = self.length();
        grading::on_length(s, limit).ok_or_else(|| Error::OutOfRange {
            cable: self.name().to_string(),
            what: "arc length",
            value: s,
            limit,
        })
    }

    /// Returns the arc length of a point in m; one within 1e-9 of the length beyond an end is at
    /// the end.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not on the cable.
    pub fn arc_length(&self, at: impl Into<At>) -> Result<f64, Error> {
        match at.into() {
            At::Start => Ok(0.0),
            At::End => Ok(self.length()),
            At::Node(i) => self.model.node_arc_lengths().nth(i).ok_or_else(|| self.no_node(i as f64)),
            At::ArcLength(s) => self.on_cable(s),
        }
    }

    fn no_node(&self, value: f64) -> Error {
        let (cable, limit) = (self.name().to_string(), self.model.elements.len() as f64);
        Error::OutOfRange { cable, what: "node", value, limit }
    }

    /// Returns the number of the node at a point.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not on the cable, [`Error::NoNode`] if no node is within 1e-9
    /// of the length.
    pub fn node(&self, at: impl Into<At>) -> Result<usize, Error> {
        let s = self.arc_length(at)?;
        let (nodes, within) = (|| self.model.node_arc_lengths(), AT_NODE * self.length());
        nodes().position(|x| (x - s).abs() <= within).ok_or_else(|| {
            let nearest = nodes().min_by(|a, b| (a - s).abs().total_cmp(&(b - s).abs())).unwrap_or(0.0);
            Error::NoNode { cable: self.name().to_string(), arc_length: s, nearest }
        })
    }
}
