//! The tables of docs/scene.md.

use super::{Choose, Default, Key, Table};
use std::fmt::Write as _;

/// Returns a table and all tables below it as Markdown, each with its heading, its purpose and its keys.
pub fn tables(root: &'static Table) -> String {
    let mut text = String::new();
    for table in root.all() {
        // writing to a String cannot fail
        let _ = write!(text, "{}\n", one(table));
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
    format!(
        "### {heading}\n\n{about}{space}{choose}| key | accepted | unit | default | meaning |\n|---|---|---|---|---|\n{rows}"
    )
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
