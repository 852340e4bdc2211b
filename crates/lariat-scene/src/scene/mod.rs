//! Scene files: TOML in, a checked [`Scene`] out. The format, key by key: docs/scene.md in the repository.
//!
//! Everything is checked before anything is written: an unknown key, a missing key, a value out of range or a reference to
//! nothing is an error that names file, line, key and what is accepted. Parts of the format that this version does not compute
//! (contact, breaking, reeling) are read and then refused by name, never ignored.
//!
//! Extensions of the format: `section = { tube = [outer, inner] }`; `allow_rank_deficient = true` runs a rule that leaves modes
//! without energy (Table 1 needs G2-2); `integrator = { fidelity = ".." }`, `{ method, max_step }`, `{ method, stable }`; energy
//! and momentum probes of one cable; `axial = "projected"` and rules such as `projected-3`.
//!
//! # Bodies
//!
//! Without `engine`, a scene with bodies runs in Rapier and one without does not. A `[[body]]` without `kind` is dynamic; `shape`
//! must be given, a dynamic body needs `mass` or `density`, and other bodies have neither. Cylinders and capsules stand along the
//! body's y. `inertia` is about the body's axes through its centre of mass, which for a mesh is that of the convex hull; without
//! shape and `inertia` a body does not turn. `velocity` is that of the origin. A kinematic body follows its `path`, or moves at its
//! constant `velocity`; it turns at its constant `angular_velocity` either way. Paths are met at host times and linear between
//! them, so put corners on multiples of `dt`. A load on a body keeps its direction in world axes; `point` without value is the
//! origin. Rapier's caps on velocities are lifted, and nothing sleeps. With `initial = "equilibrium"` and in `lariat static` bodies are held where they are drawn while the cables settle.
//!
//! # Joints
//!
//! A `[[joint]]` holds a dynamic `body` `to` another or the world, at a point and along an axis that are given in the world at t = 0, so
//! that it starts closed. With `multibody = true` the body is a link of a multibody, computed in reduced coordinates: exact where
//! Rapier's other joints give way under a pull (see the page of `lariat-rapier`). Bodies on a joint do not meet each other.
//!
//! # Junctions
//!
//! A `[[junction]]` ties the point `at` of a `cable` to the point `other_at` of an `other` (or of the same): they share one position, and
//! slopes are free. Both points start at the same place, within 1e-6 m. Several junctions at one point make one knot. Junctions
//! need `engine = "rapier"`, which they call for as bodies do. While cables settle (`initial = "equilibrium"`, `lariat static`)
//! junctions stay where they are drawn, as bodies do.
//!
//! # Anchors
//!
//! An `anchor` to the world or a body must be where the cable point starts (within 1e-6 m), because a straight start has no way to get
//! to any other place without a jump; with `initial = "equilibrium"` and in `lariat static` any anchor will do, and the cable
//! is moved there. A load with a ramp is zero at t = 0, so it takes no part in `initial = "equilibrium"`; `lariat static`
//! applies all loads in full.
//!
//! | file | what it holds |
//! |---|---|
//! | [`table`], [`value`] | the tables as written |
//! | [`document`], `overrides` | the file as a tree with places; `--set` |
//! | [`keys`] | what is accepted, in words |
//! | `check`, `check_cable`, `check_body`, `check_hold`, `check_joint`, `check_junction` | ranges and references |
//! | [`body`], `mesh` | bodies, and the files of their shapes |
//! | `build` | from a scene to cables |

pub mod body;
mod build;
mod check;
mod check_body;
mod check_cable;
mod check_effects;
mod check_flow;
mod check_hold;
mod check_joint;
mod check_junction;
pub mod document;
pub mod keys;
mod mesh;
mod overrides;
pub mod table;
pub mod value;

use crate::error::Error;
use crate::physics::collider as physics_of;
use body::BodyScene;
use document::Document;
use lariat_ancf::{Effects, IntegratorChoice, Rule, Section, Vector3};
use std::path::Path;
use value::At;

/// What a scene is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A run in time.
    Run,
    /// The static equilibrium: no duration needed, anchors anywhere.
    Static,
}

/// What moves bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Nothing: there are none.
    None,
    /// rapier3d.
    Rapier,
}

/// A checked scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name.
    pub name: String,
    /// Simulated time in s; 0 if none was given (statics).
    pub duration: f64,
    /// Host step in s.
    pub dt: f64,
    /// Gravity in m/s^2.
    pub gravity: Vector3<f64>,
    /// What moves bodies.
    pub engine: Engine,
    /// Rapier's number of solver iterations; `None` = its own.
    pub solver_iterations: Option<usize>,
    /// Rigid bodies.
    pub bodies: Vec<BodyScene>,
    /// Cables.
    pub cables: Vec<CableScene>,
    /// Attachments to bodies and to the world.
    pub attachments: Vec<AttachmentScene>,
    /// Joints between bodies.
    pub joints: Vec<JointScene>,
    /// Cables tied to each other.
    pub junctions: Vec<JunctionScene>,
    /// Point loads on cables.
    pub loads: Vec<LoadScene>,
    /// Loads on bodies.
    pub body_loads: Vec<BodyLoadScene>,
    /// Probes.
    pub probes: Vec<ProbeScene>,
}

/// A checked cable.
#[derive(Clone, Debug, PartialEq)]
pub struct CableScene {
    /// Name.
    pub name: String,
    /// Start shape in m.
    pub points: Vec<Vector3<f64>>,
    /// Unstretched length in m.
    pub length: f64,
    /// True to start from static equilibrium.
    pub equilibrium: bool,
    /// Number of elements.
    pub elements: usize,
    /// Section.
    pub section: Section,
    /// Force strategy.
    pub rule: Rule,
    /// Effects.
    pub effects: Effects,
    /// Integrator, or a fidelity.
    pub integrator: IntegratorChoice,
    /// Initial velocity in m/s.
    pub velocity: Vector3<f64>,
    /// Initial angular velocity about the start point in rad/s.
    pub angular_velocity: Vector3<f64>,
}

/// A checked attachment of a cable to a body or the world.
#[derive(Clone, Debug, PartialEq)]
pub struct AttachmentScene {
    /// Name.
    pub name: String,
    /// Position of the cable in [`Scene::cables`].
    pub cable: usize,
    /// Arc length in m.
    pub arc_length: f64,
    /// Position of the body in [`Scene::bodies`]; `None` = the world.
    pub body: Option<usize>,
    /// Place in m, in axes of the body or the world; `None` = where the cable point is.
    pub anchor: Option<Vector3<f64>>,
    /// True to hold the direction of the tangent too.
    pub clamp: bool,
}

/// What a joint leaves free; directions are unit vectors in world axes at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Turns about an axis.
    Hinge(Vector3<f64>),
    /// Moves along an axis.
    Slider(Vector3<f64>),
    /// Turns about a point.
    Ball,
    /// Nothing.
    Fixed,
}

/// A checked joint between bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct JointScene {
    /// Name.
    pub name: String,
    /// Position in [`Scene::bodies`] of the body that it holds.
    pub body: usize,
    /// Position of what it holds to; `None` = the world.
    pub to: Option<usize>,
    /// Where it is at t = 0, in m.
    pub point: Vector3<f64>,
    /// What it leaves free.
    pub kind: JointKind,
    /// True for a link of a multibody.
    pub multibody: bool,
}

/// A checked junction: two points of cables that share one position, like a shackle without mass.
#[derive(Clone, Debug, PartialEq)]
pub struct JunctionScene {
    /// Name.
    pub name: String,
    /// Positions of the cables in [`Scene::cables`], and arc lengths in m.
    pub points: [(usize, f64); 2],
}

/// A checked point load.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadScene {
    /// Position of the cable in [`Scene::cables`].
    pub cable: usize,
    /// Arc length in m.
    pub arc_length: f64,
    /// Force in N.
    pub force: Vector3<f64>,
    /// Moment in N m.
    pub moment: Vector3<f64>,
    /// Time from zero to full in s.
    pub ramp: f64,
}

/// A checked load on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyLoadScene {
    /// Position of the body in [`Scene::bodies`].
    pub body: usize,
    /// Where the force acts, in axes of the body from its origin, in m.
    pub point: Vector3<f64>,
    /// Force in N, world axes.
    pub force: Vector3<f64>,
    /// Moment in N m, world axes.
    pub moment: Vector3<f64>,
    /// Time from zero to full in s.
    pub ramp: f64,
}

/// A checked probe.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeScene {
    /// Name; its file is `probes/NAME.csv`.
    pub name: String,
    /// Interval in s; `None` = each host step.
    pub every: Option<f64>,
    /// What is read.
    pub target: Target,
}

/// What a probe reads; numbers are positions in the scene's lists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point of a cable.
    Point {
        /// The cable.
        cable: usize,
        /// Arc length in m.
        arc_length: f64,
    },
    /// Pose and velocity of a body.
    Body(usize),
    /// Force, moment and gap of an attachment.
    Attachment(usize),
    /// Energy of a cable, or of all.
    Energy(Option<usize>),
    /// Momentum of a cable, or of all.
    Momentum(Option<usize>),
}

impl Scene {
    /// Reads and checks a scene file, with overrides `KEY=VALUE`.
    ///
    /// # Errors
    /// [`Error::Read`], [`Error::Syntax`], [`Error::Override`], [`Error::Scene`], [`Error::NotBuilt`].
    pub fn read(path: &Path, overrides: &[String], purpose: Purpose) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|source| Error::Read { path: path.to_path_buf(), source })?;
        let stem = path.file_stem().map_or_else(|| "scene".to_string(), |s| s.to_string_lossy().into_owned());
        Self::parse_named(&path.display().to_string(), &stem, &text, overrides, purpose)
    }

    /// Checks the text of a scene; `file` is its name in errors.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(file: &str, text: &str, overrides: &[String], purpose: Purpose) -> Result<Self, Error> {
        Self::parse_named(file, file, text, overrides, purpose)
    }

    fn parse_named(file: &str, name: &str, text: &str, overrides: &[String], purpose: Purpose) -> Result<Self, Error> {
        let mut document = Document::parse(file, text)?;
        overrides.iter().try_for_each(|argument| document.set(argument))?;
        let folder = Path::new(file).parent().unwrap_or(Path::new(""));
        check::scene(&document, document.read()?, name, folder, purpose)
    }
}

/// The arc length of a place on a cable of this length, in m.
fn arc_length(at: At, length: f64) -> f64 {
    match at {
        At::Start => 0.0,
        At::End => length,
        At::ArcLength(s) => s,
    }
}
