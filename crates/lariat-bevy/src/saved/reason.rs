//! A value, or why there is none. The reasons of the mechanics are no data of serde: one of a
//! [number out of range](Error::InvalidValue), like those of sections, is read as it was; another
//! one becomes such a reason, with its words.

use lariat_ancf::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The ranges of the numbers of sections.
const RANGES: [&str; 2] = ["> 0", ">= 0"];

/// A value or its reason, as it is written.
#[derive(Serialize, Deserialize)]
enum Written<T> {
    Value(T),
    Reason { cable: Option<String>, what: String, value: String, expected: String },
}

/// Writes a value or its reason.
pub(crate) fn serialize<T: Serialize, S: Serializer>(
    outcome: &Result<T, Error>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match outcome {
        Ok(value) => Written::Value(value),
        Err(Error::InvalidValue { cable, what, value, expected }) => Written::Reason {
            cable: cable.clone(),
            what: what.clone(),
            // not every format has infinite numbers
            value: value.to_string(),
            expected: expected.to_string(),
        },
        Err(other) => Written::Reason {
            cable: None,
            what: format!("a saved number ({other})"),
            value: f64::NAN.to_string(),
            expected: String::new(),
        },
    }
    .serialize(serializer)
}

/// Reads a value or its reason.
pub(crate) fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Result<T, Error>, D::Error> {
    Ok(match Written::deserialize(deserializer)? {
        Written::Value(value) => Ok(value),
        Written::Reason { cable, what, value, expected } => {
            let value = value.parse().unwrap_or(f64::NAN);
            let expected = RANGES.into_iter().find(|range| *range == expected).unwrap_or("in its range");
            Err(Error::InvalidValue { cable, what, value, expected })
        }
    })
}
