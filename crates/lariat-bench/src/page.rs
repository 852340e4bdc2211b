//! Pages of results: Markdown, with the CSV files and SVG figures that stand beside it.

use crate::error::Error;
use crate::table::Table;
use std::path::Path;

/// A figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Stem of the SVG file.
    pub name: &'static str,
    /// What the figure shows.
    pub caption: String,
    /// The drawing.
    pub svg: String,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Markdown.
    Text(String),
    /// A table that is shown, and saved as CSV.
    Table(Table),
    /// A table that is shown alone: part of another one.
    Excerpt(Table),
    /// A table that is saved as CSV alone; the page links to it.
    Data(Table),
    /// A figure.
    Figure(Figure),
}

/// A section of a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Title.
    pub title: &'static str,
    /// Its parts.
    pub blocks: Vec<Block>,
}

impl Section {
    /// Returns an empty section.
    pub fn new(title: &'static str) -> Self {
        Section { title, blocks: Vec::new() }
    }

    /// Adds Markdown.
    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// Adds a table that is shown, and saved as CSV.
    pub fn table(&mut self, table: Table) {
        self.blocks.push(Block::Table(table));
    }

    /// Adds a table that is shown alone.
    pub fn excerpt(&mut self, table: Table) {
        self.blocks.push(Block::Excerpt(table));
    }

    /// Adds a table that is saved as CSV alone.
    pub fn data(&mut self, table: Table) {
        self.blocks.push(Block::Data(table));
    }

    /// Adds a figure.
    pub fn figure(&mut self, name: &'static str, caption: &str, svg: String) {
        self.blocks.push(Block::Figure(Figure { name, caption: caption.to_string(), svg }));
    }

    /// Returns the tables that are saved as CSV.
    pub fn tables(&self) -> impl Iterator<Item = &Table> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Table(table) | Block::Data(table) => Some(table),
            _ => None,
        })
    }

    /// Returns the section as Markdown, figures as links to their files.
    pub fn markdown(&self) -> String {
        let mut out = format!("## {}\n\n", self.title);
        for block in &self.blocks {
            out += &match block {
                Block::Text(text) => format!("{text}\n\n"),
                Block::Figure(figure) => format!("![{}]({}.svg)\n\n", figure.caption, figure.name),
                Block::Excerpt(table) => table.markdown() + "\n",
                Block::Table(table) => format!("{}\nIn full: [{}]({1}).\n\n", table.markdown(), table.file()),
                Block::Data(table) => format!("All {} runs: [{}]({1}).\n\n", table.rows.len(), table.file()),
            };
        }
        out
    }

    /// Writes the CSV files and figures into a folder.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn save(&self, folder: &Path) -> Result<(), Error> {
        for block in &self.blocks {
            match block {
                Block::Table(table) | Block::Data(table) => write(&folder.join(table.file()), &table.csv())?,
                Block::Figure(figure) => write(&folder.join(format!("{}.svg", figure.name)), &figure.svg)?,
                Block::Text(_) | Block::Excerpt(_) => {}
            }
        }
        Ok(())
    }
}

/// Returns a page as Markdown.
pub fn markdown<'a>(title: &str, introduction: &str, sections: impl IntoIterator<Item = &'a Section>) -> String {
    let sections: String = sections.into_iter().map(Section::markdown).collect();
    format!("# {title}\n\n{}\n\n{sections}", introduction.trim_end()).trim_end().to_string() + "\n"
}

/// Returns a page with a section in place of the one with the same title, or at its end.
pub fn replaced(page: &str, section: &Section) -> String {
    let heading = format!("## {}\n", section.title);
    let (before, rest) = page.split_once(&heading).unwrap_or((page, ""));
    let after = rest.find("\n## ").map_or("", |i| &rest[i + 1..]);
    format!("{}\n\n{}{after}", before.trim_end(), section.markdown()).trim_end().to_string() + "\n"
}

/// Writes a text file.
///
/// # Errors
/// [`Error::Output`].
pub fn write(path: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(path, text).map_err(|source| Error::Output { path: path.to_path_buf(), source })
}

/// Writes a page anew, and keeps the part between two marks, which something else writes into it.
///
/// # Errors
/// [`Error::Output`].
pub fn write_around(path: &Path, text: &str, marks: [&str; 2]) -> Result<(), Error> {
    let before = std::fs::read_to_string(path).unwrap_or_default();
    let kept = before.find(marks[0]).zip(before.find(marks[1]));
    let kept = kept.and_then(|(from, to)| before.get(from..to + marks[1].len()));
    write(path, &kept.map_or(text.to_string(), |kept| format!("{}\n\n{kept}\n", text.trim_end())))
}

/// Creates a folder for a page of a title, and checks that it can be written before hours of
/// measurements end in an error. A folder with that page has the tables and figures of the last
/// one, which are replaced; one without it may hold none.
///
/// # Errors
/// [`lariat_scene::Error::InTheWay`] for another page of the name, or a table or figure that
/// belongs to none; [`Error::Output`].
pub fn create_folder(folder: &Path, page: &str, title: &str) -> Result<(), Error> {
    let fail = |source| Error::Output { path: folder.to_path_buf(), source };
    std::fs::create_dir_all(folder).map_err(fail)?;
    if !has_title(&folder.join(page), title)? {
        for entry in std::fs::read_dir(folder).map_err(fail)? {
            let path = entry.map_err(fail)?.path();
            if path.extension().is_some_and(|kind| kind == "csv" || kind == "svg") {
                return Err(lariat_scene::Error::InTheWay { path }.into());
            }
        }
    }
    let trial = folder.join(".writable");
    write(&trial, "")?;
    std::fs::remove_file(&trial).map_err(|source| Error::Output { path: trial, source })
}

/// Returns whether there is a page of this title; false if there is none.
///
/// # Errors
/// [`lariat_scene::Error::InTheWay`] for a file that is not such a page.
pub fn has_title(path: &Path, title: &str) -> Result<bool, Error> {
    match std::fs::read_to_string(path) {
        Ok(text) if text.is_empty() || text.starts_with(&format!("# {title}\n")) => Ok(true),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(false),
        _ => Err(lariat_scene::Error::InTheWay { path: path.to_path_buf() }.into()),
    }
}
