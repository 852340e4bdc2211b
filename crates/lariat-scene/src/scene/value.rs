//! Values that may be written in more than one way: a text or a number, a text or a table.

use super::table::FlowTable;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// `at = "start" | "end" | arc length in m`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// The first point.
    Start,
    /// The last point.
    End,
    /// Arc length of the unstretched cable in m.
    ArcLength(f64),
}

impl<'de> Deserialize<'de> for At {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl Visitor<'_> for Reader {
            type Value = At;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"start\", \"end\" or an arc length in m")
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<At, E> {
                match text {
                    "start" => Ok(At::Start),
                    "end" => Ok(At::End),
                    _ => Err(E::custom(format!("{text:?} is no place on a cable"))),
                }
            }
            fn visit_f64<E: serde::de::Error>(self, s: f64) -> Result<At, E> {
                Ok(At::ArcLength(s))
            }
            fn visit_i64<E: serde::de::Error>(self, s: i64) -> Result<At, E> {
                Ok(At::ArcLength(s as f64))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// `rule = "G5-3"` or `{ axial = "exact", bending = "gauss-3" }`.
#[derive(Clone, Debug, PartialEq)]
pub enum RuleValue {
    /// By name.
    Name(String),
    /// By its two parts.
    Pair {
        /// The axial rule.
        axial: String,
        /// The bending rule.
        bending: String,
    },
}

impl<'de> Deserialize<'de> for RuleValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Pair {
            axial: String,
            bending: String,
        }
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = RuleValue;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name or { axial, bending }")
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<RuleValue, E> {
                Ok(RuleValue::Name(text.to_string()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RuleValue, A::Error> {
                let Pair { axial, bending } = Pair::deserialize(MapAccessDeserializer::new(map))?;
                Ok(RuleValue::Pair { axial, bending })
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// Shape of a body, in m.
#[derive(Clone, Debug, PartialEq)]
pub enum ShapeValue {
    /// No shape.
    None,
    /// Half extents.
    Cuboid([f64; 3]),
    /// Radius.
    Ball(f64),
    /// Half height and radius.
    Cylinder([f64; 2]),
    /// Half height and radius.
    Capsule([f64; 2]),
    /// Normal of a half space.
    Plane([f64; 3]),
    /// A file with a triangle mesh.
    Mesh(String),
}

impl<'de> Deserialize<'de> for ShapeValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table {
            cuboid: Option<[f64; 3]>,
            ball: Option<f64>,
            cylinder: Option<[f64; 2]>,
            capsule: Option<[f64; 2]>,
            plane: Option<[f64; 3]>,
            mesh: Option<String>,
        }
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = ShapeValue;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"none\" or a table of one shape")
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<ShapeValue, E> {
                if text == "none" { Ok(ShapeValue::None) } else { Err(E::custom(format!("unknown shape {text:?}"))) }
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ShapeValue, A::Error> {
                let table = Table::deserialize(MapAccessDeserializer::new(map))?;
                let mut given: Vec<ShapeValue> = [
                    table.cuboid.map(ShapeValue::Cuboid),
                    table.ball.map(ShapeValue::Ball),
                    table.cylinder.map(ShapeValue::Cylinder),
                    table.capsule.map(ShapeValue::Capsule),
                    table.plane.map(ShapeValue::Plane),
                    table.mesh.map(ShapeValue::Mesh),
                ]
                .into_iter()
                .flatten()
                .collect();
                match (given.pop(), given.len()) {
                    (Some(shape), 0) => Ok(shape),
                    _ => Err(A::Error::custom("not exactly one shape")),
                }
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// `flow = [x, y, z]` or `{ velocity, profile | power_law, history }`.
#[derive(Clone, Debug, PartialEq)]
pub enum FlowValue {
    /// The same everywhere and always, in m/s.
    Uniform([f64; 3]),
    /// Changing in place or time.
    Table(FlowTable),
}

impl<'de> Deserialize<'de> for FlowValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = FlowValue;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("three numbers or a table")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<FlowValue, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(seq)).map(FlowValue::Uniform)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<FlowValue, A::Error> {
                Deserialize::deserialize(MapAccessDeserializer::new(map)).map(FlowValue::Table)
            }
        }
        deserializer.deserialize_any(Reader)
    }
}
