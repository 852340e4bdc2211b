//! What a section is made of: text, tables, figures. A table is written twice from the same cells: rounded in Markdown, in full as CSV.

use std::fmt::Write as _;

/// A value of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A measured number.
    Number(f64),
    /// A count.
    Count(u64),
    /// Nothing was measured.
    Empty,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Cell::Text(text.to_string())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Cell::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Cell::Number(x)
    }
}

impl From<Option<f64>> for Cell {
    fn from(x: Option<f64>) -> Self {
        x.map_or(Cell::Empty, Cell::Number)
    }
}

impl From<u64> for Cell {
    fn from(n: u64) -> Self {
        Cell::Count(n)
    }
}

impl From<usize> for Cell {
    fn from(n: usize) -> Self {
        Cell::Count(n as u64)
    }
}

/// How Markdown rounds a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Words and counts as they are.
    Plain,
    /// Decimals.
    Fixed(usize),
    /// Decimals of the mantissa.
    Scientific(usize),
}

/// A column: its name in the CSV file, and in Markdown if it is shown there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in the CSV file, unit included.
    pub name: &'static str,
    /// Name in Markdown; `None` = in the CSV file only.
    pub head: Option<&'static str>,
    /// Rounding in Markdown.
    pub format: Format,
}

/// A column that both show.
pub const fn both(name: &'static str, head: &'static str, format: Format) -> Column {
    Column { name, head: Some(head), format }
}

/// A column of the CSV file alone.
pub const fn raw(name: &'static str) -> Column {
    Column { name, head: None, format: Format::Plain }
}

/// A table, and the CSV file of the same rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Stem of the CSV file.
    pub name: &'static str,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Its rows, a cell for each column.
    pub rows: Vec<Vec<Cell>>,
    /// Shown folded up, because it is long.
    pub folded: bool,
}

impl Table {
    /// Name of the CSV file.
    pub fn file(&self) -> String {
        format!("{}.csv", self.name)
    }

    /// The CSV file: numbers read back to the same f64.
    pub fn csv(&self) -> String {
        let mut out = self.columns.iter().map(|c| c.name).collect::<Vec<_>>().join(",") + "\n";
        for row in &self.rows {
            let cells = row.iter().map(|cell| match cell {
                Cell::Text(text) if text.contains([',', '"', '\n']) => format!("\"{}\"", text.replace('"', "\"\"")),
                Cell::Text(text) => text.clone(),
                Cell::Number(x) => format!("{x:?}"),
                Cell::Count(n) => n.to_string(),
                Cell::Empty => String::new(),
            });
            out += &(cells.collect::<Vec<_>>().join(",") + "\n");
        }
        out
    }

    /// The columns that Markdown shows.
    pub fn shown(&self) -> impl Iterator<Item = (usize, &'static str, Format)> {
        self.columns.iter().enumerate().filter_map(|(i, c)| Some((i, c.head?, c.format)))
    }

    fn markdown(&self, out: &mut String) {
        let heads: Vec<_> = self.shown().map(|(_, head, _)| head).collect();
        let align = self.shown().map(|(i, ..)| {
            let words = self.rows.iter().any(|row| matches!(row[i], Cell::Text(_)));
            if words { "---" } else { "---:" }
        });
        let _ = writeln!(out, "| {} |\n|{}|", heads.join(" | "), align.collect::<Vec<_>>().join("|"));
        for row in &self.rows {
            let cells = self.shown().map(|(i, _, format)| match (&row[i], format) {
                (Cell::Text(text), _) => text.replace('|', "\\|"),
                (Cell::Count(n), _) => n.to_string(),
                (Cell::Empty, _) => "-".to_string(),
                (Cell::Number(x), Format::Fixed(n)) => format!("{x:.n$}"),
                (Cell::Number(x), Format::Scientific(n)) => format!("{x:.n$e}"),
                (Cell::Number(x), Format::Plain) => x.to_string(),
            });
            let _ = writeln!(out, "| {} |", cells.collect::<Vec<_>>().join(" | "));
        }
    }
}

/// A drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Stem of the SVG file.
    pub name: &'static str,
    /// What it shows.
    pub caption: String,
    /// The drawing.
    pub svg: String,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Markdown.
    Text(String),
    /// A table.
    Table(Table),
    /// A figure.
    Figure(Figure),
}

/// A section.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Title.
    pub title: String,
    /// Its parts.
    pub blocks: Vec<Block>,
}

impl Section {
    /// An empty section.
    pub fn new(title: &str) -> Self {
        Section { title: title.to_string(), blocks: Vec::new() }
    }

    /// Adds Markdown.
    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// Adds a table.
    pub fn table(&mut self, table: Table) {
        self.blocks.push(Block::Table(table));
    }

    /// Adds a figure.
    pub fn figure(&mut self, name: &'static str, caption: &str, svg: String) {
        self.blocks.push(Block::Figure(Figure { name, caption: caption.to_string(), svg }));
    }

    /// Its tables.
    pub fn tables(&self) -> impl Iterator<Item = &Table> {
        self.blocks.iter().filter_map(|block| if let Block::Table(table) = block { Some(table) } else { None })
    }

    /// Its figures.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.blocks.iter().filter_map(|block| if let Block::Figure(figure) = block { Some(figure) } else { None })
    }

    /// The section as Markdown, figures as links to their files.
    pub fn markdown(&self) -> String {
        let mut out = format!("## {}\n\n", self.title);
        for block in &self.blocks {
            match block {
                Block::Text(text) => out += &format!("{text}\n\n"),
                Block::Figure(figure) => out += &format!("![{}]({}.svg)\n\n", figure.caption, figure.name),
                Block::Table(table) => {
                    let file = table.file();
                    if table.folded {
                        let rows = table.rows.len();
                        let _ = write!(out, "<details><summary>All {rows} points; in full: {file}</summary>\n\n");
                    }
                    table.markdown(&mut out);
                    out += if table.folded { "\n</details>\n\n" } else { "\n" };
                    if !table.folded {
                        out += &format!("In full: [{file}]({file}).\n\n");
                    }
                }
            }
        }
        out
    }
}
