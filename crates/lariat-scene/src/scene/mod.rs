//! The tables of a scene file: keys, checks and the checked [`Scene`]. The format, key by key: docs/scene.md in the repository.
//!
//! Each file declares the keys of its table ([`table!`](crate::schema)), the type that they are checked into, and the checks that
//! go beyond single values. Nothing here knows the engine: what only Rapier can judge (whether a shape encloses a volume) is
//! checked where a scene is [read](Scene::read).
//!
//! | file | table |
//! |---|---|
//! | `mod`: [`SceneTable`] | the scene itself |
//! | [`cable`], [`integrator`], [`effects`], [`flow`], [`breaking`], [`reel`] | `[[cable]]` |
//! | [`body`], [`course`], `path`, `mesh` | `[[body]]` |
//! | [`water`] | `[water]`, `[body.water]` |
//! | [`joint`], [`attachment`], [`junction`], [`sheave`], [`load`], [`probe`] | the tables of these names |
//! | `references` | names and points that tables refer to |
//! | `passing` | the parts of a cable between its sheaves |
//! | `build` | from a scene to cables |
//! | `plausibility` | warnings about what is probably not meant |

pub mod attachment;
pub mod body;
pub mod breaking;
mod build;
pub mod cable;
pub mod course;
pub mod effects;
pub mod elements;
pub mod flow;
pub mod integrator;
pub mod joint;
pub mod junction;
pub mod kinks;
pub mod load;
pub(crate) mod mesh;
mod passing;
mod path;
mod plausibility;
pub mod probe;
pub mod reel;
mod references;
pub mod sections;
pub mod sheave;
pub mod water;

pub use attachment::AttachmentScene;
pub use cable::CableScene;
pub use joint::{JointKind, JointScene};
pub use junction::JunctionScene;
pub use load::{BodyLoadScene, LoadScene};
pub use mesh::Mesh;
pub use probe::{ProbeScene, Target};
pub use sheave::SheaveScene;

use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Kind, MANY, POSITIVE, VECTOR, choice, table};
use body::BodyScene;
use lariat_ancf::{Vector3, Water};
use std::path::Path;

/// Largest number of steps, and of samples of a probe, in a run; more is taken for a mistake.
const MAX_COUNT: f64 = 1e8;

/// Why a scene is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// For a run in time.
    Run,
    /// For the static equilibrium: no duration needed, anchors anywhere.
    Static,
    /// For a run that starts from the state that statics wrote: anchors anywhere.
    Resume,
}

choice! {
    /// How a scene starts.
    enum Start {
        /// Each cable as it says, bodies as drawn.
        Drawn = "drawn",
        /// In static equilibrium.
        Equilibrium = "equilibrium",
    }
}

choice! {
    /// What moves bodies.
    enum Engine {
        /// rapier3d.
        Rapier = "rapier",
        /// Nothing: there are none.
        None = "none",
    }
}

table! {
    /// Duration, steps and the world.
    struct SceneTable("The scene") {
        /// Name of the scene.
        name: Option<String> = ("the name of the file"), Kind::Text;
        /// Simulated time.
        duration: Option<f64> = ("required by `lariat run`"), Kind::Number(POSITIVE), "s";
        /// Host step, the step of Rapier: at most 1e8 steps in all. The default is 1/60 s.
        dt: f64 = 0.016666666666666666, Kind::Number(POSITIVE), "s";
        /// `"drawn"` starts each cable by its own `initial` and bodies where they are drawn; `"equilibrium"` starts all cables and the dynamic
        /// bodies on them in one equilibrium, as `lariat static` finds it but without loads that have a ramp, and then with the velocities that are given.
        initial: Start = "drawn", Kind::Choice(Start::names);
        /// Gravity.
        gravity: Vector3<f64> = [0.0, -9.81, 0.0], VECTOR, "m/s^2";
        /// Computes the bodies, and the junctions and sheaves of cables.
        engine: Option<Engine> = ("`\"rapier\"` with bodies, junctions, kinks, sheaves or contact between cables, else `\"none\"`"), Kind::Choice(Engine::names);
        /// Rapier's `num_solver_iterations`, with `engine = "rapier"`.
        solver_iterations: Option<u32> = ("Rapier's"), Kind::Whole(1, MANY);
        /// Water with its surface, current and wave.
        water: Option<water::WaterTable> = ("none"), Kind::Table(&water::WaterTable::TABLE);
        /// Rigid bodies.
        body: Vec<body::BodyTable> = ("none"), Kind::Tables(&body::BodyTable::TABLE);
        /// Joints between bodies.
        joint: Vec<joint::JointTable> = ("none"), Kind::Tables(&joint::JointTable::TABLE);
        /// Cables, at least one.
        cable: Vec<cable::CableTable> = required, Kind::Tables(&cable::CableTable::TABLE);
        /// Points of cables held by bodies or the world.
        attachment: Vec<attachment::AttachmentTable> = ("none"), Kind::Tables(&attachment::AttachmentTable::TABLE);
        /// Cables tied to each other.
        junction: Vec<junction::JunctionTable> = ("none"), Kind::Tables(&junction::JunctionTable::TABLE);
        /// Wheels and eyes that cables run over.
        sheave: Vec<sheave::SheaveTable> = ("none"), Kind::Tables(&sheave::SheaveTable::TABLE);
        /// Point forces and moments.
        load: Vec<load::LoadTable> = ("none"), Kind::Tables(&load::LoadTable::TABLE);
        /// What a run writes down.
        probe: Vec<probe::ProbeTable> = ("none"), Kind::Tables(&probe::ProbeTable::TABLE);
    }
}

/// A checked scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name.
    pub name: String,
    /// Simulated time in s; 0 if none was given, for statics.
    pub duration: f64,
    /// Host step in s.
    pub dt: f64,
    /// Whether a run starts in static equilibrium of all cables and bodies.
    pub equilibrium: bool,
    /// Gravity in m/s^2.
    pub gravity: Vector3<f64>,
    /// Water that cables and bodies are in.
    pub water: Option<Water>,
    /// What moves bodies.
    pub engine: Engine,
    /// Rapier's number of solver iterations; `None` = its own.
    pub solver_iterations: Option<usize>,
    /// Rigid bodies.
    pub bodies: Vec<BodyScene>,
    /// Cables, in the order of the file; after them what is behind the sheaves along them.
    pub cables: Vec<CableScene>,
    /// By cable of the file, its parts between sheaves, in their order: positions in [`cables`](Self::cables). The first is that of the cable.
    pub parts: Vec<Vec<usize>>,
    /// Attachments to bodies and to the world.
    pub attachments: Vec<AttachmentScene>,
    /// Joints between bodies.
    pub joints: Vec<JointScene>,
    /// Cables tied to each other.
    pub junctions: Vec<JunctionScene>,
    /// Kinks of cables.
    pub kinks: Vec<kinks::Kink>,
    /// Sheaves.
    pub sheaves: Vec<SheaveScene>,
    /// Point loads on cables.
    pub loads: Vec<LoadScene>,
    /// Loads on bodies.
    pub body_loads: Vec<BodyLoadScene>,
    /// Probes.
    pub probes: Vec<ProbeScene>,
}

impl Scene {
    /// Returns whether it has something that only the integrator `discrete-gradient` steps:
    /// contact, torsion, a rate that is an unknown, or a stock that rides on a dynamic body.
    pub(crate) fn is_coupled(&self) -> bool {
        let dynamic = |body: usize| self.bodies[body].kind == body::BodyKind::Dynamic;
        let rides = |part: usize| {
            let held = self.attachments.iter().filter(|a| reel::is_at_eye(self, part, (a.cable, a.arc_length)));
            self.cables[part].reel.is_some() && held.filter_map(|a| a.body).any(dynamic)
        };
        let only = |(part, cable): (usize, &CableScene)| {
            let slips = cable.reel.as_ref().is_some_and(|reel| reel.max_force.is_some());
            cable.effects.need_discrete_gradient() || slips || cable.drum.is_some() || rides(part)
        };
        !self.sheaves.is_empty() || self.cables.iter().enumerate().any(only)
    }
}

/// Checks the values of a document against each other; `fallback` names a scene without name, and files are named from `folder`.
pub(crate) fn check(doc: &Document<'_>, fallback: &str, folder: &Path, purpose: Purpose) -> Result<Scene, Error> {
    let root = KeyPath::default();
    let table: SceneTable = doc.typed(&root, toml::Value::Table(doc.resolve()?))?;
    let engine = engine(doc, &table)?;
    let duration = match (table.duration, purpose) {
        (Some(duration), _) => duration,
        (None, Purpose::Static) => 0.0,
        (None, Purpose::Run | Purpose::Resume) => return Err(doc.missing(&root.key("duration"))),
    };
    let dt = table.dt;
    if duration / dt > MAX_COUNT {
        return Err(doc.conflict(&root.key("dt"), format!("{dt} s makes {:.3e} steps", duration / dt)));
    }
    if engine == Engine::Rapier {
        check_single(doc, dt, &table.gravity)?;
    }
    if table.cable.is_empty() {
        return Err(doc.missing(&root.key("cable")));
    }
    let mut scene = Scene {
        name: table.name.unwrap_or_else(|| fallback.to_string()),
        duration,
        dt,
        equilibrium: table.initial == Start::Equilibrium,
        gravity: table.gravity,
        water: water::read(doc, table.water, table.gravity)?,
        engine,
        solver_iterations: table.solver_iterations.map(|n| n as usize),
        bodies: Vec::new(),
        cables: Vec::new(),
        parts: Vec::new(),
        attachments: Vec::new(),
        joints: Vec::new(),
        junctions: Vec::new(),
        kinks: Vec::new(),
        sheaves: Vec::new(),
        loads: Vec::new(),
        body_loads: Vec::new(),
        probes: Vec::new(),
    };
    let mut drums = Vec::new();
    for (i, row) in table.cable.into_iter().enumerate() {
        let at = root.key("cable").item(i);
        references::unique(doc, &at, &row.name, scene.cables.iter().map(|c| c.name.as_str()))?;
        let (cable, drum) = cable::read(doc, &at, row, (scene.gravity, scene.water.as_ref()))?;
        drums.extend(drum.map(|drum| (i, drum)));
        if cable.effects.contact.is_some() && engine == Engine::None {
            return Err(
                doc.conflict(&at.key("contact"), "without an engine there is nothing that the cable could touch")
            );
        }
        scene.cables.push(cable);
        scene.parts.push(vec![i]);
    }
    for (i, row) in table.body.into_iter().enumerate() {
        let at = root.key("body").item(i);
        references::unique(doc, &at, &row.name, scene.bodies.iter().map(|b| b.name.as_str()))?;
        let body = body::read(doc, &at, row, (folder, scene.water.as_ref()))?;
        scene.bodies.push(body);
    }
    for (i, row) in table.joint.into_iter().enumerate() {
        let row = joint::read(doc, &scene, i, row)?;
        scene.joints.push(row);
    }
    let (mut along, at_sheaves) = passing::divide(doc, &mut scene, &table.sheave)?;
    if table.engine != Some(Engine::None) {
        let (loads, junctions, attachments) = (&table.load, &table.junction, &table.attachment);
        kinks::find(doc, &mut scene, &kinks::Turning { loads, junctions, attachments })?;
        if scene.cables.iter().any(|cable| !cable.kinks.is_empty()) && engine == Engine::None {
            scene.engine = Engine::Rapier;
            check_single(doc, dt, &scene.gravity)?;
        }
    }
    kinks::divide(doc, &mut scene)?;
    for (i, row) in table.attachment.into_iter().enumerate() {
        let row = attachment::read(doc, &scene, i, row)?;
        scene.attachments.push(row);
    }
    passing::add(doc, &mut scene, at_sheaves)?;
    for (cable, drum) in drums {
        reel::put_on_drum(doc, &mut scene, cable, &drum)?;
    }
    for (i, row) in table.junction.into_iter().enumerate() {
        let row = junction::read(doc, &scene, i, row)?;
        scene.junctions.push(row);
    }
    // what is tied at a kink is in its knot
    kinks::join(doc, &mut scene)?;
    integrator::check_torsion(doc, &mut scene)?;
    for (i, row) in table.sheave.into_iter().enumerate() {
        let row = sheave::read(doc, &mut scene, i, row, along[i].take())?;
        scene.sheaves.push(row);
    }
    for (i, row) in table.load.into_iter().enumerate() {
        load::read(doc, &mut scene, i, row)?;
    }
    for (i, row) in table.probe.into_iter().enumerate() {
        let row = probe::read(doc, &scene, i, row)?;
        scene.probes.push(row);
    }
    check_start(doc, &scene, purpose)?;
    reel::check_eyes(doc, &scene)?;
    elements::check_eyes(doc, &scene)?;
    Ok(scene)
}

/// Refuses what Rapier's single precision cannot hold.
fn check_single(doc: &Document<'_>, dt: f64, gravity: &Vector3<f64>) -> Result<(), Error> {
    let root = KeyPath::default();
    if f64::from(dt as f32) < f64::from(f32::MIN_POSITIVE) * 1e3 {
        return Err(doc.conflict(&root.key("dt"), format!("{dt} s is too short for Rapier, in single precision")));
    }
    doc.check_single(&root.key("gravity"), gravity)
}

/// Returns the engine; without the key, bodies, junctions, sheaves and contact of cables with cables choose Rapier.
fn engine(doc: &Document<'_>, table: &SceneTable) -> Result<Engine, Error> {
    let kinked = table.cable.iter().position(|row| row.kinks.as_ref().is_some_and(|kinks| !kinks.is_empty()));
    let alone = table.body.is_empty() && table.junction.is_empty() && table.sheave.is_empty() && kinked.is_none();
    let mut touching = false;
    for (i, row) in table.cable.iter().enumerate() {
        let at = KeyPath::root("cable").item(i).key("contact");
        touching |= effects::touches_cables(doc, &at, &row.effects)?;
    }
    let engine = match table.engine {
        None if alone && !touching => Engine::None,
        None => Engine::Rapier,
        Some(engine) => engine,
    };
    if engine == Engine::None {
        let given = [
            ("body", !table.body.is_empty()),
            ("junction", !table.junction.is_empty()),
            ("sheave", !table.sheave.is_empty()),
        ];
        for (key, given) in given {
            if given {
                let problem = Problem::Conflict(format!("engine = \"none\" computes no {key}"));
                let accepted = "engine = \"rapier\", or no engine";
                return Err(doc.error_accepting(&KeyPath::root(key).item(0), problem, accepted));
            }
        }
        if let Some(i) = kinked {
            let problem = Problem::Conflict("engine = \"none\" computes no kinks".to_string());
            let accepted = "engine = \"rapier\", or no engine";
            return Err(doc.error_accepting(&KeyPath::root("cable").item(i).key("kinks"), problem, accepted));
        }
        if table.solver_iterations.is_some() {
            return Err(doc.conflict(&KeyPath::root("solver_iterations"), "it is a setting of engine = \"rapier\""));
        }
    }
    Ok(engine)
}

/// Builds every cable once as drawn, and checks attachments and junctions against them.
fn check_start(doc: &Document<'_>, scene: &Scene, purpose: Purpose) -> Result<(), Error> {
    let mut cables = Vec::new();
    for i in 0..scene.cables.len() {
        let failed = |error: lariat_ancf::Error| {
            let problem = Problem::Conflict(error.to_string());
            doc.error_accepting(
                &KeyPath::root("cable").item(scene.whole(i)),
                problem,
                "a cable that can be built, see docs/scene.md",
            )
        };
        cables.push(scene.build_cable(i).map_err(failed)?);
    }
    attachment::check_start(doc, scene, &cables, purpose)?;
    junction::check_start(doc, scene, &cables)?;
    load::check_start(doc, scene, sheave::check_start(doc, scene, cables)?)
}
