//! A document checked against the schema: unknown and missing keys, types and ranges; defaults filled in.

use super::quantity::{is_quantity, quantity};
use super::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Choose, Default, Key, Kind, Range, Table};
use crate::suggest::nearest;
use toml::Value;
use toml::de::{DeArray, DeTable, DeValue};

/// How a value is written.
#[derive(PartialEq, Eq)]
enum Form {
    Text,
    Flag,
    Number,
    Array,
    Table,
}

impl Document<'_> {
    /// Returns the values of the scene with all defaults.
    ///
    /// # Errors
    /// [`Error::Scene`] for the first key or value that the schema does not accept.
    pub fn resolve(&self) -> Result<toml::Table, Error> {
        self.table(self.schema, self.root.get_ref(), &KeyPath::default())
    }

    fn table(&self, schema: &Table, tree: &DeTable<'_>, path: &KeyPath) -> Result<toml::Table, Error> {
        for (name, _) in tree {
            if schema.key(name.get_ref()).is_none() {
                let (name, near) = (name.get_ref(), nearest(name.get_ref(), schema.keys().map(|key| key.name)));
                return Err(self.suggesting(
                    &path.key(name),
                    Problem::UnknownKey(name.to_string()),
                    schema.names(),
                    near,
                ));
            }
        }
        self.choose(schema, tree, path)?;
        let mut values = toml::Table::new();
        for key in schema.keys() {
            let at = path.key(key.name);
            let value = match (tree.get(key.name), key.default) {
                (Some(value), _) => self.value(&key.kind, value.get_ref(), &at)?,
                (None, Default::Required) => return Err(self.missing(&at)),
                (None, Default::Value(text)) => self.default(key, text, &at)?,
                (None, Default::Absent(_)) if matches!(key.kind, Kind::Tables(_)) => Value::Array(Vec::new()),
                (None, Default::Absent(_)) => continue,
            };
            values.insert(key.name.to_string(), value);
        }
        Ok(values)
    }

    fn default(&self, key: &Key, text: &str, path: &KeyPath) -> Result<Value, Error> {
        let value = DeValue::parse(text).map_err(|error| self.conflict(path, error.message()))?;
        self.value(&key.kind, value.get_ref(), path)
    }

    /// Checks how many keys of a table are given.
    fn choose(&self, schema: &Table, tree: &DeTable<'_>, path: &KeyPath) -> Result<(), Error> {
        let (names, most) = match schema.choose {
            Choose::Free => return Ok(()),
            Choose::AtLeastOne(names) => (names, usize::MAX),
            Choose::ExactlyOne(names) => (names, 1),
        };
        let given: Vec<&'static str> = names.iter().copied().filter(|name| tree.contains_key(*name)).collect();
        if !given.is_empty() && given.len() <= most {
            return Ok(());
        }
        let problem = if given.is_empty() { Problem::NoneGiven(names) } else { Problem::TooManyGiven(given) };
        Err(self.error_accepting(path, problem, schema.choose.phrase()))
    }

    fn value(&self, kind: &Kind, value: &DeValue<'_>, path: &KeyPath) -> Result<Value, Error> {
        match (kind, value) {
            (Kind::Text, DeValue::String(text)) => Ok(Value::String(text.to_string())),
            (Kind::Name(reserved), DeValue::String(text)) => {
                if text.is_empty() || reserved.contains(&text.as_ref()) {
                    return Err(self.error(path, Problem::ReservedName(text.to_string())));
                }
                Ok(Value::String(text.to_string()))
            }
            (Kind::Choice(names), DeValue::String(text)) => {
                if names().contains(&text.as_ref()) {
                    return Ok(Value::String(text.to_string()));
                }
                let accepted = self.schema.find(path.keys()).map_or_else(|| kind.phrase(), Key::accepted);
                Err(self.suggesting(path, Problem::UnknownValue(text.to_string()), accepted, nearest(text, names())))
            }
            (Kind::Parsed { parse, .. }, DeValue::String(text)) => match parse(text) {
                Ok(()) => Ok(Value::String(text.to_string())),
                Err(reason) => Err(self.error(path, Problem::NotUnderstood(reason))),
            },
            (Kind::Flag, DeValue::Boolean(flag)) => Ok(Value::Boolean(*flag)),
            (Kind::Whole(low, high), DeValue::Integer(_)) => self.whole(*low, *high, value, path),
            (Kind::Number(range), DeValue::Integer(_) | DeValue::Float(_)) => {
                self.number(range, number_of(value), path)
            }
            (Kind::Number(range), DeValue::String(text)) if is_quantity(text) => {
                let unit = self.schema.find(path.keys()).map_or("", |key| key.unit);
                match quantity(text, unit) {
                    Ok(x) => self.number(range, x, path),
                    Err(reason) => Err(self.error(path, Problem::NotUnderstood(reason))),
                }
            }
            (Kind::Numbers(names, range), DeValue::Array(items)) => {
                self.numbers(names.len(), range, items, value, path)
            }
            (Kind::Rows(names, least), DeValue::Array(rows)) => self.rows(names.len(), *least, rows, path),
            (Kind::Ascending(names), DeValue::Array(rows)) => {
                let value = self.rows(names.len(), 1, rows, path)?;
                self.ascending(names[0], &value, path)?;
                Ok(value)
            }
            (Kind::List(kind), DeValue::Array(items)) if !items.is_empty() => items
                .iter()
                .map(|item| self.value(kind, item.get_ref(), path))
                .collect::<Result<_, _>>()
                .map(Value::Array),
            (Kind::Table(schema), DeValue::Table(tree)) => self.table(schema, tree, path).map(Value::Table),
            (Kind::Tables(schema), DeValue::Array(items)) => {
                let one = |(i, item): (usize, &toml::Spanned<DeValue<'_>>)| match item.get_ref() {
                    DeValue::Table(tree) => self.table(schema, tree, &path.item(i)).map(Value::Table),
                    other => Err(self.wrong_type(path, other)),
                };
                items.iter().enumerate().map(one).collect::<Result<_, _>>().map(Value::Array)
            }
            (Kind::Either(kinds), _) => {
                // the first of this form says what is wrong
                let mut refused = None;
                let of_form = kinds.iter().filter(|kind| kind.form() == form(value));
                let text = form(value) == Form::Text;
                let with_unit = kinds.iter().filter(|kind| text && matches!(kind, Kind::Number(_)));
                for kind in of_form.chain(with_unit) {
                    match self.value(kind, value, path) {
                        Ok(value) => return Ok(value),
                        Err(error) => refused = refused.or(Some(error)),
                    }
                }
                Err(refused.unwrap_or_else(|| self.wrong_type(path, value)))
            }
            _ => Err(self.wrong_type(path, value)),
        }
    }

    fn whole(&self, low: u64, high: u64, value: &DeValue<'_>, path: &KeyPath) -> Result<Value, Error> {
        let found = value.as_integer().and_then(|i| i64::from_str_radix(i.as_str(), i.radix()).ok());
        match found.filter(|&n| u64::try_from(n).is_ok_and(|n| (low..=high).contains(&n))) {
            Some(n) => Ok(Value::Integer(n)),
            None => Err(self.error(path, Problem::OutOfRange(number_of(value)))),
        }
    }

    fn number(&self, range: &Range, x: f64, path: &KeyPath) -> Result<Value, Error> {
        if range.contains(x) {
            return Ok(Value::Float(x));
        }
        Err(self.error(path, if x.is_finite() { out_of_range(range, x) } else { Problem::NotFinite(vec![x]) }))
    }

    fn numbers(
        &self,
        count: usize,
        range: &Range,
        items: &DeArray<'_>,
        value: &DeValue<'_>,
        path: &KeyPath,
    ) -> Result<Value, Error> {
        if items.len() != count || items.iter().any(|item| form(item.get_ref()) != Form::Number) {
            return Err(self.wrong_type(path, value));
        }
        let numbers: Vec<f64> = items.iter().map(|item| number_of(item.get_ref())).collect();
        if !numbers.iter().all(|x| x.is_finite()) {
            return Err(self.error(path, Problem::NotFinite(numbers)));
        }
        match numbers.iter().find(|x| !range.contains(**x)) {
            Some(x) => Err(self.error(path, out_of_range(range, *x))),
            None => Ok(Value::Array(numbers.into_iter().map(Value::Float).collect())),
        }
    }

    fn rows(&self, columns: usize, least: usize, rows: &DeArray<'_>, path: &KeyPath) -> Result<Value, Error> {
        if rows.len() < least {
            return Err(self.error(path, Problem::TooFewRows(rows.len())));
        }
        let row = |row: &toml::Spanned<DeValue<'_>>| match row.get_ref() {
            DeValue::Array(items) => self.numbers(columns, &crate::schema::ANY, items, row.get_ref(), path),
            other => Err(self.wrong_type(path, other)),
        };
        rows.iter().map(row).collect::<Result<_, _>>().map(Value::Array)
    }

    fn ascending(&self, name: &'static str, rows: &Value, path: &KeyPath) -> Result<(), Error> {
        let rows = rows.as_array().map_or(&[][..], Vec::as_slice);
        let first: Vec<f64> = rows.iter().filter_map(|row| row.get(0)?.as_float()).collect();
        match first.windows(2).find(|pair| pair[1] <= pair[0]) {
            None => Ok(()),
            Some(pair) => Err(self.error(path, Problem::NotAscending { name, before: pair[0], after: pair[1] })),
        }
    }

    fn wrong_type(&self, path: &KeyPath, value: &DeValue<'_>) -> Error {
        let found = match value {
            DeValue::String(text) => format!("the text {text:?}"),
            DeValue::Integer(_) => format!("the number {}", number_of(value)),
            // with its point, which is why it is no whole number
            DeValue::Float(_) => format!("the number {:?}", number_of(value)),
            DeValue::Boolean(flag) => format!("{flag}"),
            DeValue::Datetime(date) => format!("the date {date}"),
            DeValue::Array(items) => format!("an array of {} values", items.len()),
            DeValue::Table(_) => "a table".to_string(),
        };
        self.error(path, Problem::WrongType(found))
    }
}

impl Kind {
    /// Returns how values of this kind are written; not for kinds that are written in several ways.
    fn form(&self) -> Form {
        match self {
            Kind::Text | Kind::Name(_) | Kind::Choice(_) | Kind::Parsed { .. } => Form::Text,
            Kind::Flag => Form::Flag,
            Kind::Whole(..) | Kind::Number(_) => Form::Number,
            Kind::Numbers(..) | Kind::Rows(..) | Kind::Ascending(_) | Kind::List(_) | Kind::Tables(_) => Form::Array,
            Kind::Table(_) | Kind::Either(_) => Form::Table,
        }
    }
}

fn form(value: &DeValue<'_>) -> Form {
    match value {
        DeValue::String(_) | DeValue::Datetime(_) => Form::Text,
        DeValue::Boolean(_) => Form::Flag,
        DeValue::Integer(_) | DeValue::Float(_) => Form::Number,
        DeValue::Array(_) => Form::Array,
        DeValue::Table(_) => Form::Table,
    }
}

/// Returns why a finite number is not in a range.
fn out_of_range(range: &Range, x: f64) -> Problem {
    if range.contains_in_double(x) { Problem::BeyondSingle(x) } else { Problem::OutOfRange(x) }
}

/// Returns a number of a scene; NaN for what is no number.
fn number_of(value: &DeValue<'_>) -> f64 {
    match value {
        DeValue::Float(x) => x.as_str().parse().unwrap_or(f64::NAN),
        DeValue::Integer(i) if i.radix() == 10 => i.as_str().parse().unwrap_or(f64::NAN),
        DeValue::Integer(i) => i128::from_str_radix(i.as_str(), i.radix()).map_or(f64::NAN, |n| n as f64),
        _ => f64::NAN,
    }
}
