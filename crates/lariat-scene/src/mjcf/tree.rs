//! A model as a tree of its own, with the files that it includes.

use super::limits;
use crate::error::Error;
use roxmltree::{Document, Node};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Most files that a model includes, itself among them.
const FILES: usize = 64;

/// An element with its attributes, where it stands, and its children.
pub(super) struct Element {
    pub name: String,
    pub file: Rc<str>,
    pub line: u32,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
}

impl Element {
    pub fn attribute(&self, key: &str) -> Option<&str> {
        self.attributes.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
    }

    pub fn has(&self, key: &str) -> bool {
        self.attribute(key).is_some()
    }

    /// Returns the children of a name.
    pub fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name == name)
    }

    pub fn error(&self, problem: String) -> Error {
        Error::Import { file: self.file.to_string(), line: self.line, problem }
    }

    pub fn wrong(&self, problem: impl Into<String>) -> Error {
        self.error(format!("<{}>: {}", self.name, problem.into()))
    }
}

/// Reads a text, and what it includes from the folder of `file`.
///
/// # Errors
/// What is no XML, nests too deep, has no root `mujoco`, or includes what cannot be read.
pub(super) fn read(file: &str, text: &str) -> Result<Element, Error> {
    let folder = Path::new(file).parent().map(Path::to_path_buf).unwrap_or_default();
    let mut files = Files { folder, seen: HashSet::new(), level: 0 };
    let mut root = files.parse(file, text)?;
    if root.name != "mujoco" {
        return Err(root.error("not a model of MuJoCo: its root is not <mujoco>".to_string()));
    }
    // an included file has a world of its own: all are one
    let (worlds, mut others) = root.children.drain(..).partition::<Vec<_>, _>(|child| child.name == "worldbody");
    let world = worlds.into_iter().reduce(|mut world, next| {
        world.children.extend(next.children);
        world
    });
    others.extend(world);
    root.children = others;
    Ok(root)
}

struct Files {
    folder: PathBuf,
    seen: HashSet<PathBuf>,
    /// Levels of elements above the present one, in all files.
    level: usize,
}

impl Files {
    fn parse(&mut self, file: &str, text: &str) -> Result<Element, Error> {
        let error = |line, problem| Error::Import { file: file.to_string(), line, problem };
        limits::check(text).map_err(|(line, problem)| error(line, problem))?;
        let document = Document::parse(text).map_err(|problem| error(0, format!("not XML: {problem}")))?;
        self.element(&Rc::from(file), document.root_element())
    }

    fn element(&mut self, file: &Rc<str>, node: Node<'_, '_>) -> Result<Element, Error> {
        let mut element = Element {
            name: node.tag_name().name().to_string(),
            file: file.clone(),
            line: node.document().text_pos_at(node.range().start).row,
            attributes: node.attributes().map(|a| (a.name().to_string(), a.value().to_string())).collect(),
            children: Vec::new(),
        };
        self.level += 1;
        if self.level > limits::LEVELS {
            return Err(element.error(format!("elements are nested deeper than {} levels", limits::LEVELS)));
        }
        for child in node.children().filter(Node::is_element) {
            let child = self.element(file, child)?;
            if child.name == "include" {
                element.children.extend(self.include(&child)?.children);
            } else {
                element.children.push(child);
            }
        }
        self.level -= 1;
        Ok(element)
    }

    fn include(&mut self, element: &Element) -> Result<Element, Error> {
        let Some(name) = element.attribute("file") else { return Err(element.wrong("needs file")) };
        if let Some((other, _)) = element.attributes.iter().find(|(key, _)| key != "file") {
            return Err(element.wrong(format!("{other}: is not read: file is")));
        }
        let path = self.folder.join(name);
        if !path.is_file() {
            return Err(element.wrong(format!("{} is no file", path.display())));
        }
        if self.seen.len() >= FILES || !self.seen.insert(path.clone()) {
            return Err(element.wrong(format!("{name} is included twice, or more than {FILES} files are")));
        }
        self.parse(&path.display().to_string(), &crate::read_text(&path)?)
    }
}
