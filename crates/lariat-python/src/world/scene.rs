//! Worlds of scenes: built as a run starts, then stepped, read and changed by a program, by the names of the scene.

use super::bodies::Handle;
use super::{Contents, World, numbered};
use crate::cable::Cable;
use crate::convert::result;
use crate::error::{Raise, raise};
use crate::shared::Shared;
use crate::told::Told;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{AttachmentHandle, SheaveHandle};
use lariat_scene::run::Parts;
use lariat_scene::{Error, Purpose, Scene};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};

/// What a scene calls the parts of a world.
#[derive(Default, Serialize, Deserialize)]
pub struct Names {
    bodies: Vec<(String, RigidBodyHandle)>,
    attachments: Vec<String>,
    sheaves: Vec<String>,
}

impl Contents {
    /// Returns what its scene calls a body, else its number in the world.
    pub fn body_names(&self) -> impl Iterator<Item = (RigidBodyHandle, String)> {
        let there = self.bodies.iter().filter(|body| self.world.bodies.contains(**body)).enumerate();
        there.map(|(number, body)| {
            let own = self.names.bodies.iter().find(|(_, named)| named == body).map(|(name, _)| name.clone());
            (*body, own.unwrap_or_else(|| format!("body {number}")))
        })
    }
}

/// An attachment or a sheave: its number, or its name in the scene.
pub enum Which {
    Number(usize),
    Name(String),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Which {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(name) = object.extract::<String>() {
            return Ok(Which::Name(name));
        }
        match object.extract::<usize>() {
            Err(error) if error.is_instance_of::<PyTypeError>(object.py()) => {
                let class = object.get_type().name()?.to_string();
                Err(PyTypeError::new_err(format!("expected a number (int) or a name of the scene (str), got {class}")))
            }
            number => number.map(Which::Number),
        }
    }
}

/// Returns the exception that a scene calls nothing by a name, with the names that there are.
fn unnamed<'a>(class: &'static str, kind: &str, name: &str, names: impl Iterator<Item = &'a str>) -> Raise {
    let names: Vec<String> = names.map(|name| format!("{name:?}")).collect();
    let there = if names.is_empty() { "none".to_string() } else { names.join(", ") };
    Raise::new(class, format!("no {kind} is called {name:?}; there are: {there}"))
}

/// Returns the number of what is called by a name, or has a number.
fn find(which: &Which, names: &[String], kind: &str, class: &'static str) -> Result<usize, Raise> {
    match which {
        Which::Number(number) => Ok(*number),
        Which::Name(name) => names
            .iter()
            .position(|own| own == name)
            .ok_or_else(|| unnamed(class, kind, name, names.iter().map(String::as_str))),
    }
}

impl Contents {
    /// Returns the handle of an attachment.
    pub(super) fn attachment(&self, which: &Which) -> Result<AttachmentHandle, Raise> {
        const CLASS: &str = "NoAttachmentError";
        let number = find(which, &self.names.attachments, "attachment to a body", CLASS)?;
        numbered(&self.attachments, number, "attachment", CLASS)
    }

    /// Returns the handle of a sheave.
    pub(super) fn sheave(&self, which: &Which) -> Result<SheaveHandle, Raise> {
        const CLASS: &str = "NoSheaveError";
        let number = find(which, &self.names.sheaves, "sheave", CLASS)?;
        numbered(&self.sheaves, number, "sheave", CLASS)
    }
}

#[pymethods]
impl World {
    /// Returns the first cable of this name. Raises NoCableError, with the names that there are.
    #[pyo3(name = "cable")]
    fn cable_called(&self, py: Python<'_>, name: &str) -> PyResult<Cable> {
        let found = self.0.with(py, |contents| {
            let all = || contents.set.iter();
            let found = all().find(|(_, cable)| cable.name() == name).map(|(handle, _)| handle);
            found.ok_or_else(|| unnamed("NoCableError", "cable", name, all().map(|(_, cable)| cable.name())))
        });
        Ok(self.cable(found.map_err(raise)?))
    }

    /// Names of the bodies, in the order of their handles: those of the scene, else their numbers.
    fn _body_names(&self, py: Python<'_>) -> Vec<String> {
        self.0.with(py, |contents| contents.body_names().map(|(_, name)| name).collect())
    }

    /// Returns the body that the scene of :func:`lariat.load` calls so. Raises NoBodyError, with
    /// the names that there are.
    fn body<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let found = slf.get().0.with(py, |contents| {
            let Contents { names, world, .. } = contents;
            let own = || names.bodies.iter().filter(|(_, body)| world.bodies.contains(*body));
            let found = own().find(|(own, _)| own == name).map(|(_, body)| Handle(*body));
            found.ok_or_else(|| unnamed("NoBodyError", "body", name, own().map(|(name, _)| name.as_str())))
        });
        let handle = result(py, "RigidBodyHandle", found.map_err(raise)?.0.into_raw_parts())?;
        py.import("lariat_cables.bodies")?.getattr("RigidBody")?.call1((slf, handle))
    }
}

/// Builds the world of a scene as a run starts; returns it with what the start tells.
#[pyfunction]
pub fn load_scene(py: Python<'_>, file: &str, text: &str, overrides: Vec<String>) -> PyResult<(World, Vec<String>)> {
    let loaded = py.detach(|| {
        let scene = Scene::parse(file, text, &overrides, Purpose::Run)?;
        let Parts { world, cables: set, bodies, attachments, sheaves, script, told, .. } = Parts::of(&scene)?;
        let (attachment_names, attachments) = attachments.into_iter().unzip();
        let (sheave_names, sheaves) = sheaves.into_iter().unzip();
        let handles = bodies.iter().map(|(_, handle)| *handle).collect();
        let names = Names { bodies, attachments: attachment_names, sheaves: sheave_names };
        let junctions = Vec::new();
        let contents = Contents {
            world,
            set,
            time: 0.0,
            bodies: handles,
            attachments,
            sheaves,
            junctions,
            names,
            script,
            told: Told::default(),
        };
        Ok::<_, Error>((World(Shared::new(contents)), told))
    });
    loaded.map_err(raise)
}
