//! What a key accepts, in words: the end of every message about a value that is not accepted.

use super::{Choose, Key, Kind, MANY, Range, Table};

impl Key {
    /// Returns what the key accepts, with its unit and the first sentence of its meaning.
    pub fn accepted(&self) -> String {
        let meaning = self.meaning.trim();
        let first = meaning.split_once(". ").map_or(meaning.trim_end_matches('.'), |(first, _)| first);
        let unit = if self.unit.is_empty() { String::new() } else { format!(", in {}", self.unit) };
        let stop = if first.is_empty() { "" } else { ". " };
        format!("{}{unit}{stop}{first}", self.kind.phrase())
    }
}

impl Table {
    /// Returns the names of all keys.
    pub fn names(&self) -> String {
        self.keys().map(|key| key.name).collect::<Vec<_>>().join(", ")
    }
}

impl Choose {
    /// Returns how many keys must be given, in words; empty if each key speaks for itself.
    pub fn phrase(&self) -> String {
        match self {
            Choose::Free => String::new(),
            Choose::AtLeastOne(names) => format!("at least one of {}", names.join(", ")),
            Choose::ExactlyOne(names) => format!("exactly one of {}", names.join(", ")),
        }
    }
}

impl Kind {
    /// Returns what values are accepted.
    pub fn phrase(&self) -> String {
        match self {
            Kind::Text => "a text".to_string(),
            Kind::Name(reserved) => {
                let not: String = reserved.iter().map(|name| format!(", not {name:?}")).collect();
                format!("a text, not empty{not}")
            }
            Kind::Choice(names) => names().iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(" | "),
            Kind::Parsed { accepted, .. } => (*accepted).to_string(),
            Kind::Flag => "true | false".to_string(),
            Kind::Whole(low, MANY) => format!("a whole number >= {low}"),
            Kind::Whole(low, high) => format!("a whole number from {low} to {high}"),
            Kind::Number(range) => format!("a finite number{}", after_space(range)),
            Kind::Numbers(names, range) => {
                let count = match names.len() {
                    2 => "two",
                    3 => "three",
                    _ => "several",
                };
                format!("[{}], {count} finite numbers{}", names.join(", "), after_space(range))
            }
            Kind::Rows(names, least) => format!("rows [{}] of finite numbers, at least {least}", names.join(", ")),
            Kind::Ascending(names) => {
                format!("rows [{}] of finite numbers, at least 1, {} ascending", names.join(", "), names[0])
            }
            Kind::List(kind) => format!("a list of one or more of {}", kind.phrase()),
            Kind::Table(table) => match table.choose {
                Choose::ExactlyOne(names) if names.len() == table.keys().count() => {
                    let one = |key: &Key| format!("{{ {} = {} }}", key.name, key.kind.outline());
                    table.keys().map(one).collect::<Vec<_>>().join(" | ")
                }
                _ => format!("a table {{ {} }}", table.names()),
            },
            Kind::Tables(table) => format!("tables {}", table.header),
            Kind::Either(kinds) => kinds.iter().map(Kind::phrase).collect::<Vec<_>>().join(" | "),
        }
    }

    /// Returns the form of values in short.
    fn outline(&self) -> String {
        match self {
            Kind::Number(_) => "number".to_string(),
            Kind::Numbers(names, _) => format!("[{}]", names.join(", ")),
            _ => "text".to_string(),
        }
    }
}

fn after_space(range: &Range) -> String {
    if range.text.is_empty() { String::new() } else { format!(" {}", range.text) }
}
