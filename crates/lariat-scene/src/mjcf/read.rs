//! Attributes of elements of a model: numbers, vectors and places, with errors that name the line.

use crate::error::Error;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use roxmltree::Node;

/// Reads attributes; `file` is the name of the model in errors.
pub(super) struct Reader<'a> {
    pub file: &'a str,
}

impl Reader<'_> {
    pub(super) fn error(&self, line: u32, problem: String) -> Error {
        Error::Import { file: self.file.to_string(), line, problem }
    }

    pub(super) fn wrong(&self, node: Node<'_, '_>, problem: impl Into<String>) -> Error {
        self.error(
            node.document().text_pos_at(node.range().start).row,
            format!("<{}>: {}", node.tag_name().name(), problem.into()),
        )
    }

    pub(super) fn numbers(&self, node: Node<'_, '_>, key: &str, text: &str) -> Result<Vec<f64>, Error> {
        let number = |word: &str| match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(self.wrong(node, format!("{key}: {word:?} is not a finite number"))),
        };
        text.split_whitespace().map(number).collect()
    }

    pub(super) fn list(&self, node: Node<'_, '_>, key: &str) -> Result<Option<Vec<f64>>, Error> {
        node.attribute(key).map(|text| self.numbers(node, key, text)).transpose()
    }

    pub(super) fn number(&self, node: Node<'_, '_>, key: &str) -> Result<Option<f64>, Error> {
        match self.list(node, key)?.as_deref() {
            None => Ok(None),
            Some([x, ..]) => Ok(Some(*x)),
            Some([]) => Err(self.wrong(node, format!("{key} is empty"))),
        }
    }

    pub(super) fn vector(&self, node: Node<'_, '_>, key: &str, text: &str) -> Result<Vector3<f64>, Error> {
        match self.numbers(node, key, text)?[..] {
            [x, y, z] => Ok(Vector3::new(x, y, z)),
            _ => Err(self.wrong(node, format!("{key} needs 3 numbers"))),
        }
    }

    /// Returns the place of a body, composite or flexcomp on its parent.
    pub(super) fn place(&self, node: Node<'_, '_>, position: &str) -> Result<Isometry3<f64>, Error> {
        for key in ["euler", "axisangle", "xyaxes", "zaxis"] {
            if node.has_attribute(key) {
                return Err(self.wrong(node, format!("{key} is not read: give quat")));
            }
        }
        let shift = node.attribute(position).map_or(Ok(Vector3::zeros()), |text| self.vector(node, position, text))?;
        let turn = match self.list(node, "quat")?.as_deref() {
            None => UnitQuaternion::identity(),
            Some(&[w, x, y, z]) if w * w + x * x + y * y + z * z > 0.0 => {
                UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
            }
            Some(_) => return Err(self.wrong(node, "quat needs 4 numbers, not all zero")),
        };
        Ok(Isometry3::from_parts(Translation3::from(shift), turn))
    }
}
