//! The scene format as data: each key with its kind, unit, default and meaning, stated once.
//!
//! `table!` declares the keys of a table together with the type that holds its values. Everything else that depends on the
//! format follows from these declarations:
//!
//! | what | where |
//! |---|---|
//! | unknown and missing keys, types, ranges, defaults | `document::resolve` |
//! | what an error message says is accepted | [`phrase`] |
//! | the tables of docs/scene.md | [`markdown`], printed by `lariat keys` |

pub mod markdown;
pub mod phrase;
mod range;
#[macro_use]
mod table;

pub use range::{ANY, DISSIPATION, NOT_NEGATIVE, POSITIVE, Range, SHARE, UNIT};
pub(crate) use table::{choice, table};

/// A table of a scene file.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// Its heading: `[[cable]]`, `[cable.drag]`, or the name of an inline table.
    pub header: &'static str,
    /// What the table is for.
    pub about: &'static str,
    /// Its keys, in groups.
    pub keys: &'static [&'static [Key]],
    /// How many of some of its keys must be given.
    pub choose: Choose,
}

/// How many of some keys must be given.
#[derive(Clone, Copy, Debug)]
pub enum Choose {
    /// Each key speaks for itself.
    Free,
    /// One of these keys or more.
    AtLeastOne(&'static [&'static str]),
    /// One of these keys and no other.
    ExactlyOne(&'static [&'static str]),
}

/// A key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// The values it accepts.
    pub kind: Kind,
    /// Unit of its numbers; empty for none.
    pub unit: &'static str,
    /// What holds if it is missing.
    pub default: Default,
    /// What it means. Error messages show the first sentence, docs/scene.md all.
    pub meaning: &'static str,
}

/// What holds if a key is missing.
#[derive(Clone, Copy, Debug)]
pub enum Default {
    /// Nothing: the key must be given.
    Required,
    /// A value, as TOML.
    Value(&'static str),
    /// No value; what happens then, in words.
    Absent(&'static str),
}

/// The values that a key accepts.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Any text.
    Text,
    /// A name: any text but the empty one and these.
    Name(&'static [&'static str]),
    /// One of these texts.
    Choice(fn() -> Vec<&'static str>),
    /// A text that a parser understands.
    Parsed {
        /// What it understands, in words.
        accepted: &'static str,
        /// The parser: an error in words if the text is not understood.
        parse: fn(&str) -> Result<(), String>,
    },
    /// `true` or `false`.
    Flag,
    /// A whole number from the first to the second, both included; [`MANY`] stands for no limit.
    Whole(u64, u64),
    /// A finite number.
    Number(Range),
    /// Finite numbers with these names.
    Numbers(&'static [&'static str], Range),
    /// Rows of finite numbers with these names, at least so many.
    Rows(&'static [&'static str], usize),
    /// As [`Kind::Rows`], at least one, with the first number ascending from row to row.
    Ascending(&'static [&'static str]),
    /// An array of one value of a kind or more.
    List(&'static Kind),
    /// A table.
    Table(&'static Table),
    /// An array of tables.
    Tables(&'static Table),
    /// A value of one of these kinds, which are told apart by their form.
    Either(&'static [Kind]),
}

/// No limit of a whole number.
pub const MANY: u64 = u32::MAX as u64;

/// Three numbers in the axes of the world or a body.
pub const VECTOR: Kind = Kind::Numbers(&["x", "y", "z"], ANY);

/// A share of the length of a cable.
const SHARE_OF_LENGTH: Kind =
    Kind::Parsed { accepted: "a share of the length, as \"50 %\"", parse: |text| share(text).map(|_| ()) };

/// A point of a cable.
pub const POSITION: Kind = Kind::Either(&[Kind::Choice(|| vec!["start", "end"]), Kind::Number(ANY), SHARE_OF_LENGTH]);

/// An arc length, or a share of the length of a cable.
pub const ARC_LENGTH: Kind = Kind::Either(&[Kind::Number(NOT_NEGATIVE), SHARE_OF_LENGTH]);

/// Reads a share that is written in percent, as `"50 %"`.
///
/// # Errors
/// In words, for another text, or a share that is not from 0 to 100 %.
pub fn share(text: &str) -> Result<f64, String> {
    let percent = text.strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok());
    match percent {
        Some(percent) if (0.0..=100.0).contains(&percent) => Ok(percent / 100.0),
        _ => Err(format!("{text:?} is no share from \"0 %\" to \"100 %\"")),
    }
}

/// A parser for [`Kind::Parsed`].
pub fn parse_as<T: std::str::FromStr<Err: ToString>>(text: &str) -> Result<(), String> {
    text.parse::<T>().map(|_| ()).map_err(|error| error.to_string())
}

impl Table {
    /// Returns all keys.
    pub fn keys(&self) -> impl Iterator<Item = &'static Key> {
        self.keys.iter().copied().flatten()
    }

    /// Returns a key by its name.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys().find(|key| key.name == name)
    }

    /// Returns a key by its path from this table.
    pub fn find<'p>(&self, path: impl IntoIterator<Item = &'p str>) -> Option<&'static Key> {
        let mut path = path.into_iter();
        let mut key = self.key(path.next()?)?;
        for name in path {
            key = key.kind.table()?.key(name)?;
        }
        Some(key)
    }

    /// Returns this table and all tables below it, each before its own.
    pub fn all(&'static self) -> Vec<&'static Table> {
        let below = self.keys().filter_map(|key| key.kind.table()).flat_map(Table::all);
        [self].into_iter().chain(below).collect()
    }
}

impl Key {
    /// Returns the table that a value of the key is or may be.
    pub fn table(&self) -> Option<&'static Table> {
        self.kind.table()
    }
}

impl Kind {
    /// Returns the table that a value of this kind is or may be.
    pub fn table(&self) -> Option<&'static Table> {
        match self {
            Kind::Table(table) | Kind::Tables(table) => Some(table),
            Kind::Either(kinds) => kinds.iter().find_map(Kind::table),
            _ => None,
        }
    }
}
