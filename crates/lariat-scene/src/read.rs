//! From a file to a checked scene.

use crate::document::{Document, KeyPath};
use crate::error::Error;
use crate::physics;
use crate::scene::{self, Purpose, Scene, SceneTable};
use crate::text::read_text;
use std::path::Path;

impl Scene {
    /// Reads and checks a scene file, with overrides `KEY=VALUE`.
    ///
    /// # Errors
    /// [`Error::Read`], [`Error::Syntax`], [`Error::Override`], [`Error::Scene`].
    pub fn read(path: &Path, overrides: &[String], purpose: Purpose) -> Result<Self, Error> {
        let text = read_text(path)?;
        let stem = path.file_stem().map_or_else(|| "scene".to_string(), |s| s.to_string_lossy().into_owned());
        parse(&path.display().to_string(), &stem, &text, overrides, purpose)
    }

    /// Checks the text of a scene; `file` is its name in errors.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(file: &str, text: &str, overrides: &[String], purpose: Purpose) -> Result<Self, Error> {
        parse(file, file, text, overrides, purpose)
    }
}

fn parse(file: &str, name: &str, text: &str, overrides: &[String], purpose: Purpose) -> Result<Scene, Error> {
    let mut document = Document::parse(file, text, &SceneTable::TABLE)?;
    overrides.iter().try_for_each(|argument| document.set(argument))?;
    let folder = Path::new(file).parent().unwrap_or(Path::new(""));
    let scene = scene::check(&document, name, folder, purpose)?;
    for (i, body) in scene.bodies.iter().enumerate() {
        let shape = KeyPath::root("body").item(i).key("shape");
        physics::collider(body).map_err(|problem| document.conflict(&shape, problem))?;
    }
    Ok(scene)
}
