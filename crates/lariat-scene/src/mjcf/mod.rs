//! Models of MuJoCo (MJCF) with `<composite type="cable">` and `<flexcomp dim="1">`, as a scene.
//!
//! | MuJoCo | scene |
//! |---|---|
//! | vertices of a composite (`vertex`, or `curve`, `count`, `size`, `offset`, `quat`) | `points`; one element per segment |
//! | a composite that is drawn with bends and not `flat` | points on the smooth curve through the vertices, `rest_shape` |
//! | `bend` of its plugin, and the geom | `youngs_modulus` and section; `density` is that of the mass with the ends of capsules |
//! | `mass` of the geom, `stiffness` of the joint | EA, EI + stiffness x segment, mass per length |
//! | `initial` ball or none | attachment to the world or to its body |
//! | `damping` of its joint | `damping.bending`, as the time that the same torque per turn gives |
//! | vertices of a flexcomp (`count`, `spacing`, or `point`), `pin` | `points`, attachments |
//! | `stiffness` and `damping` of its edge | EA = stiffness x edge length; `damping.axial` = damping/stiffness; no bending |
//! | bodies without joints, with `mocap`, with joints | fixed shapes, kinematic and dynamic bodies |
//! | `joint` hinge, slide, ball; a body without a joint on a moving one | joints |
//! | `connect` and `weld` of bodies or sites | attachments, junctions, joints |
//! | `density` and `wind` of the option | `drag` with the sides of MuJoCo's box of inertia |
//! | `contype`, `conaffinity`, `condim`, `friction` | `contact` of cables, shapes of bodies, friction |
//!
//! # Validity
//!
//! A composite of MuJoCo does not stretch; here it has the axial stiffness of its material. Twist is left out. `known.txt`
//! lists all of MuJoCo's schema: what is in no list is an error with file, line, element and attribute; what is left out is
//! a warning, and a comment of the scene; what would change the shape of an equilibrium is refused.
//!
//! # References
//!
//! MuJoCo documentation, XML reference; its engine's inertia-box model of fluids. Motions are compared with those of MuJoCo
//! 3.17 (`tests/mjcf`), vertices by `crates/lariat-python/tests/test_mjcf.py`.

mod bodies;
mod cable;
mod composite;
mod curve;
mod defaults;
mod flexcomp;
mod geom;
mod holds;
mod idle;
mod known;
mod limits;
mod read;
mod surface;
mod tree;
mod write;

use crate::error::Error;
use crate::scene::{Purpose, Scene};
use bodies::{Body, Frame, Joint, Listed};
use cable::{Cable, Hold};
use holds::Tie;
use nalgebra::{Isometry3, Vector3};
use read::Angles;
use std::collections::{HashMap, HashSet};
use std::fmt;
use tree::Element;

/// What of a model is left out of its scene, and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Note {
    /// File and line; empty for the whole model.
    pub place: String,
    /// What is left out, or differs.
    pub text: String,
}

impl Note {
    fn at(element: &Element, text: impl Into<String>) -> Self {
        let place = format!("{}:{}", element.file, element.line);
        Note { place, text: format!("<{}>: {}", element.name, text.into()) }
    }

    fn whole(text: impl Into<String>) -> Self {
        Note { place: String::new(), text: text.into() }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.place.is_empty() { write!(out, "{}", self.text) } else { write!(out, "{}: {}", self.place, self.text) }
    }
}

/// A scene that was made of a model.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Import {
    /// The scene, TOML.
    pub scene: String,
    /// What of the model is left out of it; comments of the scene have the same.
    pub notes: Vec<Note>,
}

/// Reads the cables of a model with its bodies, and returns a scene in TOML; `file` is its name in errors. Files that it
/// includes are read from the folder of `file`.
///
/// # Errors
/// As [`read`].
pub fn import(file: &str, text: &str) -> Result<String, Error> {
    read(file, text).map(|import| import.scene)
}

/// Reads a model as [`import`] does, and returns what is left out of the scene, too.
///
/// # Errors
/// [`Error::Import`] for a file that is not XML, that nests elements deeper than 256 or gives one more than 256 attributes,
/// without cables, with an element or attribute that is not known, or with what cannot be imported right.
pub fn read(file: &str, text: &str) -> Result<Import, Error> {
    let mut root = tree::read(file, text)?;
    let mut notes = Vec::new();
    defaults::apply(&mut root)?;
    known::check(&root, &mut notes)?;
    let mut importer = Importer::new(&root, notes)?;
    importer.model(&root)?;
    if importer.cables.is_empty() {
        return Err(root.error("no <composite type=\"cable\"> and no <flexcomp dim=\"1\">".to_string()));
    }
    let scene = importer.scene(file);
    // what no rule above saw: a scene that is none
    Scene::parse("scene", &scene, &[], Purpose::Run)
        .map_err(|error| root.error(format!("the scene that it makes is refused: {error}")))?;
    Ok(Import { scene, notes: importer.notes })
}

/// What the options of a model say.
#[derive(Default)]
struct Options {
    angles: Angles,
    gravity: Vector3<f64>,
    density: f64,
    viscosity: f64,
    wind: Vector3<f64>,
    no_contact: bool,
    no_equality: bool,
    inertia_from_geoms: bool,
}

/// A scene in the making.
struct Importer {
    options: Options,
    notes: Vec<Note>,
    surfaces: Vec<Listed>,
    frames: Vec<Frame>,
    /// Body and point in the world of each site, in m.
    sites: HashMap<String, (usize, Vector3<f64>)>,
    names: HashSet<String>,
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    cables: Vec<Cable>,
    holds: Vec<Hold>,
    ties: Vec<Tie>,
}

impl Importer {
    fn new(root: &Element, notes: Vec<Note>) -> Result<Self, Error> {
        let mut options = Options { gravity: Vector3::new(0.0, 0.0, -9.81), ..Options::default() };
        for compiler in root.named("compiler") {
            if compiler.has("angle") {
                options.angles.degrees = compiler.word("angle", &["degree", "radian"])? == "degree";
            }
            if let Some(sequence) = compiler.attribute("eulerseq") {
                if sequence.len() != 3 || !sequence.chars().all(|axis| "xyzXYZ".contains(axis)) {
                    return Err(compiler.wrong(format!("eulerseq = {sequence:?}: needs three of x, y, z, X, Y, Z")));
                }
                options.angles.sequence = sequence.to_string();
            }
            if compiler.has("inertiafromgeom") {
                options.inertia_from_geoms = compiler.word("inertiafromgeom", &["auto", "true", "false"])? == "true";
            }
        }
        for option in root.named("option") {
            options.gravity = option.vector("gravity")?.unwrap_or(options.gravity);
            options.wind = option.vector("wind")?.unwrap_or(options.wind);
            options.density = option.number("density")?.unwrap_or(options.density);
            options.viscosity = option.number("viscosity")?.unwrap_or(options.viscosity);
            if options.density < 0.0 || options.viscosity < 0.0 {
                return Err(option.wrong("density or viscosity is negative"));
            }
        }
        for flag in root.named("option").flat_map(|option| option.named("flag")) {
            let off = |key| flag.word(key, &["enable", "disable"]).map(|word| word == "disable");
            options.no_contact |= off("contact")? || off("constraint")?;
            options.no_equality |= off("equality")? || off("constraint")?;
            if off("gravity")? {
                options.gravity = Vector3::zeros();
            }
        }
        Ok(Importer {
            options,
            notes,
            surfaces: Vec::new(),
            frames: Vec::new(),
            sites: HashMap::new(),
            names: ["world", "all"].map(str::to_string).into(),
            bodies: Vec::new(),
            joints: Vec::new(),
            cables: Vec::new(),
            holds: Vec::new(),
            ties: Vec::new(),
        })
    }

    fn model(&mut self, root: &Element) -> Result<(), Error> {
        let Some(world) = root.named("worldbody").next() else { return Ok(()) };
        self.list_surfaces(world, false, &mut 0)?;
        self.body(world, Isometry3::identity(), None)?;
        let children = |name: &'static str| root.named(name).flat_map(|section| &section.children);
        children("equality").try_for_each(|element| self.equality(element))?;
        children("actuator").try_for_each(|element| self.actuator(element))?;
        children("tendon").for_each(|element| self.tendon(element));
        children("contact").for_each(|element| self.exclude(element));
        Ok(())
    }

    /// Judges a pair that does not touch in MuJoCo.
    fn exclude(&mut self, element: &Element) {
        let [a, b] = ["body1", "body2"].map(|key| element.attribute(key).unwrap_or_default());
        let held = self.holds.iter().any(|hold| {
            let is = |name: &str| self.cables[hold.cable].part(name).is_some();
            let frame = &self.frames[hold.frame].name;
            is(a) && b == frame || is(b) && a == frame
        });
        // a cable does not touch the body that holds it, near the hold
        if !held {
            self.notes.push(Note::at(element, format!("{a} and {b} may touch here")));
        }
    }

    /// Returns the place of an element on its parent.
    fn local(&self, element: &Element, position: &str) -> Result<Isometry3<f64>, Error> {
        element.place(position, &self.options.angles)
    }

    /// Returns a name that no other has.
    fn free_name(&mut self, wanted: &str, otherwise: &str) -> String {
        let mut name = if wanted.is_empty() { otherwise.to_string() } else { wanted.to_string() };
        while !self.names.insert(name.clone()) {
            name.push('\'');
        }
        name
    }
}
