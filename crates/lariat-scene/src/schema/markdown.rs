//! The tables of docs/scene.md.

use super::{Choose, Default, Key, Table};
use crate::error::Error;
use crate::suggest::nearest;
use std::fmt::Write as _;

/// The line before the tables in a page.
pub const BEGIN: &str = "<!-- lariat keys -->";
/// The line after the tables in a page.
pub const END: &str = "<!-- end of lariat keys -->";

/// Replaces the tables between [`BEGIN`] and [`END`] in a page; `None` if it lacks one of the two.
pub fn replace(page: &str, tables: &str) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}\n\n{tables}\n{END}{after}"))
}

/// Returns the tables below a dotted path of keys, or the row of a single key.
///
/// # Errors
/// [`Error::NoSuchKey`].
pub fn below(root: &'static Table, path: &str) -> Result<String, Error> {
    let mut here = root;
    let mut key = None;
    for name in path.split('.') {
        let unknown = |table: &Table| Error::NoSuchKey {
            key: name.to_string(),
            accepted: table.names(),
            suggestion: nearest(name, table.keys().map(|key| key.name)),
        };
        if let Some(parent) = key {
            here = Key::table(parent).ok_or_else(|| unknown(here))?;
        }
        key = Some(here.key(name).ok_or_else(|| unknown(here))?);
    }
    match key.and_then(Key::table) {
        Some(table) => Ok(tables(table)),
        None => Ok(format!("{HEAD}{}", key.map(row).unwrap_or_default())),
    }
}

const HEAD: &str = "| key | accepted | unit | default | meaning |\n|---|---|---|---|---|\n";

/// Returns a table and all tables below it as Markdown, each with its heading, its purpose and its keys.
pub fn tables(root: &'static Table) -> String {
    let mut text = String::new();
    let mut written = Vec::new();
    for table in root.all() {
        // two keys may have the same table
        if written.contains(&(table.header, table.about)) {
            continue;
        }
        written.push((table.header, table.about));
        // writing to a String cannot fail
        let _ = writeln!(text, "{}", one(table));
    }
    text.trim_end().to_string() + "\n"
}

/// Returns one table as Markdown.
fn one(table: &Table) -> String {
    let heading = if table.header.starts_with('[') { format!("`{}`", table.header) } else { table.header.to_string() };
    let choose = match table.choose {
        Choose::Free => String::new(),
        Choose::AtLeastOne(names) => format!("At least one of {} must be given.\n\n", coded(names)),
        Choose::ExactlyOne(names) => format!("Exactly one of {} must be given.\n\n", coded(names)),
    };
    let about = table.about.trim();
    let space = if about.is_empty() { "" } else { "\n\n" };
    let rows: String = table.keys().map(row).collect();
    format!("### {heading}\n\n{about}{space}{choose}{HEAD}{rows}")
}

fn row(key: &Key) -> String {
    let accepted = key.kind.phrase();
    let default = match key.default {
        Default::Required => "required".to_string(),
        Default::Value(value) => format!("`{value}`"),
        Default::Absent(without) => without.to_string(),
    };
    // a bar ends a cell
    let cell = |text: &str| text.trim().replace('|', "\\|");
    let cells = [&accepted, key.unit, &default, key.meaning].map(cell);
    format!("| `{}` | {} |\n", key.name, cells.join(" | "))
}

fn coded(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
