//! A table of measured values, written as Markdown, as CSV or as text for a terminal from the same
//! cells.

use crate::numbers::short;

/// The value of a cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A measured number.
    Number(f64),
    /// A count.
    Count(u64),
    /// Not measured.
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

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(x: Option<T>) -> Self {
        x.map_or(Cell::Empty, Into::into)
    }
}

/// How a column rounds its numbers where people read it; a CSV file holds them in full.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// As it is.
    Plain,
    /// With this number of decimals.
    Fixed(usize),
    /// As a mantissa with this number of decimals and a power of ten.
    Scientific(usize),
    /// With three significant digits, and with a power of ten outside 0.01 to 1e5.
    Short,
}

/// A column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in the CSV file, unit included.
    pub name: &'static str,
    /// Heading where people read it; `None`: in the CSV file alone.
    pub heading: Option<&'static str>,
    /// Rounding where people read it.
    pub format: Format,
}

/// Returns a column that is shown to readers too.
pub const fn shown(name: &'static str, heading: &'static str, format: Format) -> Column {
    Column { name, heading: Some(heading), format }
}

/// Returns a column of the CSV file alone.
pub const fn hidden(name: &'static str) -> Column {
    Column { name, heading: None, format: Format::Plain }
}

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Name, and stem of the CSV file.
    pub name: &'static str,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Its rows, a cell for each column.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// Name of the CSV file.
    pub fn file(&self) -> String {
        format!("{}.csv", self.name)
    }

    /// Returns the table as CSV, every column of it; numbers read back to the same `f64`.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let full = |cell: &Cell| match cell {
            Cell::Text(text) => text.clone(),
            Cell::Number(x) => format!("{x:?}"),
            Cell::Count(n) => n.to_string(),
            Cell::Empty => String::new(),
        };
        let head: Vec<&str> = self.columns.iter().map(|c| c.name).collect();
        let rows = self.rows.iter().map(|row| row.iter().map(full).collect::<Vec<_>>());
        let written =
            writer.write_record(head).and_then(|()| rows.into_iter().try_for_each(|r| writer.write_record(r)));
        // memory takes whatever is written, and rows are as long as the head
        debug_assert!(written.is_ok());
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }

    /// Returns the columns that readers see, with their positions.
    pub fn visible(&self) -> impl Iterator<Item = (usize, &'static str, Format)> {
        self.columns.iter().enumerate().filter_map(|(i, c)| Some((i, c.heading?, c.format)))
    }

    /// Returns the table as Markdown.
    pub fn markdown(&self) -> String {
        let headings: Vec<_> = self.visible().map(|(_, heading, _)| heading).collect();
        let rules: Vec<_> = self.visible().map(|(i, ..)| if self.is_text(i) { "---" } else { "---:" }).collect();
        let mut out = format!("| {} |\n|{}|\n", headings.join(" | "), rules.join("|"));
        for row in &self.rows {
            let cells = self.visible().map(|(i, _, format)| rounded(&row[i], format).replace('|', "\\|"));
            out += &format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "));
        }
        out
    }

    /// Returns the table for a terminal, in columns as wide as they need be.
    pub fn text(&self) -> String {
        let heading = self.visible().map(|(_, heading, _)| heading.to_string()).collect();
        let cells = |row: &Vec<Cell>| self.visible().map(|(i, _, format)| rounded(&row[i], format)).collect();
        let lines: Vec<Vec<String>> = std::iter::once(heading).chain(self.rows.iter().map(cells)).collect();
        let width = |k: usize| lines.iter().map(|line| line[k].chars().count()).max().unwrap_or(0);
        let columns: Vec<(usize, bool)> =
            self.visible().enumerate().map(|(k, (i, ..))| (width(k), self.is_text(i))).collect();
        let padded = |(cell, &(width, left)): (&String, &(usize, bool))| {
            if left { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
        };
        let line = |line: &Vec<String>| line.iter().zip(&columns).map(padded).collect::<Vec<_>>().join("  ");
        lines.iter().map(|cells| line(cells).trim_end().to_string() + "\n").collect()
    }

    /// Returns some columns of the rows that `keep` takes, with other headings and formats: a view
    /// for readers.
    pub fn select(&self, columns: &[Column], keep: impl Fn(&[Cell]) -> bool) -> Table {
        let places: Vec<Option<usize>> = columns.iter().map(|c| self.position(c.name)).collect();
        let cell = |row: &[Cell], at: Option<usize>| at.map_or(Cell::Empty, |i| row[i].clone());
        let rows = self.rows.iter().filter(|row| keep(row));
        let rows = rows.map(|row| places.iter().map(|at| cell(row, *at)).collect()).collect();
        Table { name: self.name, columns: columns.to_vec(), rows }
    }

    /// Returns the position of a column by its name.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|c| c.name == name)
    }

    fn is_text(&self, column: usize) -> bool {
        self.rows.iter().any(|row| matches!(row[column], Cell::Text(_)))
    }
}

/// Returns a cell as readers see it.
fn rounded(cell: &Cell, format: Format) -> String {
    match (cell, format) {
        (Cell::Text(text), _) => text.clone(),
        (Cell::Count(n), _) => n.to_string(),
        (Cell::Empty, _) => "-".to_string(),
        (Cell::Number(x), Format::Fixed(n)) => format!("{x:.n$}"),
        (Cell::Number(x), Format::Scientific(n)) => format!("{x:.n$e}"),
        (Cell::Number(x), Format::Plain) => x.to_string(),
        (Cell::Number(x), Format::Short) => short(*x),
    }
}
