//! Attributes of elements of a model: numbers, vectors, words and places, with errors that name the line.

use super::tree::Element;
use crate::error::Error;
use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

/// How a model writes angles, by its `<compiler>`.
#[derive(Clone, Debug)]
pub(super) struct Angles {
    pub degrees: bool,
    pub sequence: String,
}

impl Default for Angles {
    fn default() -> Self {
        Angles { degrees: true, sequence: "xyz".to_string() }
    }
}

impl Element {
    pub fn numbers(&self, key: &str, text: &str) -> Result<Vec<f64>, Error> {
        let number = |word: &str| match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(self.wrong(format!("{key}: {word:?} is not a finite number"))),
        };
        text.split_whitespace().map(number).collect()
    }

    pub fn list(&self, key: &str) -> Result<Option<Vec<f64>>, Error> {
        self.attribute(key).map(|text| self.numbers(key, text)).transpose()
    }

    /// Returns the first number of an attribute.
    pub fn number(&self, key: &str) -> Result<Option<f64>, Error> {
        match self.list(key)?.as_deref() {
            None => Ok(None),
            Some([x, ..]) => Ok(Some(*x)),
            Some([]) => Err(self.wrong(format!("{key} is empty"))),
        }
    }

    pub fn vector(&self, key: &str) -> Result<Option<Vector3<f64>>, Error> {
        match self.list(key)?.as_deref() {
            None => Ok(None),
            Some(&[x, y, z]) => Ok(Some(Vector3::new(x, y, z))),
            Some(_) => Err(self.wrong(format!("{key} needs 3 numbers"))),
        }
    }

    /// Returns one of some words, the first by default.
    pub fn word<'w>(&self, key: &str, words: &[&'w str]) -> Result<&'w str, Error> {
        let Some(word) = self.attribute(key) else { return Ok(words[0]) };
        let found = words.iter().find(|known| **known == word);
        found.copied().ok_or_else(|| self.wrong(format!("{key} = {word:?} is not read: {} are", words.join(", "))))
    }

    /// Returns the place of an element on its parent.
    pub fn place(&self, position: &str, angles: &Angles) -> Result<Isometry3<f64>, Error> {
        let shift = self.vector(position)?.unwrap_or_default();
        Ok(Isometry3::from_parts(Translation3::from(shift), self.turn(angles)?.unwrap_or_default()))
    }

    /// Returns the orientation of an element on its parent, if it has one.
    pub fn turn(&self, angles: &Angles) -> Result<Option<UnitQuaternion<f64>>, Error> {
        let given = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];
        let mut keys = given.into_iter().filter(|key| self.has(key));
        let Some(key) = keys.next() else { return Ok(None) };
        if let Some(other) = keys.next() {
            return Err(self.wrong(format!("{key} and {other}: an element has one orientation")));
        }
        let numbers = self.list(key)?.unwrap_or_default();
        let angle = |x: f64| if angles.degrees { x.to_radians() } else { x };
        let unit = |v: Vector3<f64>| Unit::try_new(v, 1e-12);
        let turn = match (key, &numbers[..]) {
            ("quat", &[w, x, y, z]) if w * w + x * x + y * y + z * z > 0.0 => {
                Some(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)))
            }
            ("axisangle", &[x, y, z, a]) => {
                unit(Vector3::new(x, y, z)).map(|axis| UnitQuaternion::from_axis_angle(&axis, angle(a)))
            }
            ("euler", &[a, b, c]) => Some(euler(&angles.sequence, [a, b, c].map(angle))),
            ("xyaxes", &[a, b, c, d, e, f]) => {
                let x = unit(Vector3::new(a, b, c));
                let y = x.and_then(|x| unit(Vector3::new(d, e, f) - *x * x.dot(&Vector3::new(d, e, f))));
                x.zip(y).map(|(x, y)| {
                    let axes = Matrix3::from_columns(&[*x, *y, x.cross(&y)]);
                    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes))
                })
            }
            ("zaxis", &[x, y, z]) => unit(Vector3::new(x, y, z)).map(|axis| to_axis(&axis)),
            _ => None,
        };
        turn.map(Some).ok_or_else(|| self.wrong(format!("{key} = {numbers:?} is no orientation")))
    }
}

/// Returns the smallest rotation that takes z to an axis; about x for the opposite one.
pub(super) fn to_axis(axis: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(&Vector3::z(), axis)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI))
}

/// Returns a rotation by Euler angles: about axes that rotate along (xyz) or stand still (XYZ).
fn euler(sequence: &str, angles: [f64; 3]) -> UnitQuaternion<f64> {
    sequence.chars().zip(angles).fold(UnitQuaternion::identity(), |turn, (axis, angle)| {
        let about = match axis.to_ascii_lowercase() {
            'x' => Vector3::x_axis(),
            'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let step = UnitQuaternion::from_axis_angle(&about, angle);
        if axis.is_ascii_lowercase() { turn * step } else { step * turn }
    })
}
