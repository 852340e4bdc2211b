//! `path` of a body: rows of a kinematic body's places, of its rotations, or a file of both.

use super::course::Path;
use crate::document::{Document, KeyPath};
use crate::error::Error;
use crate::schema::{Choose, Kind, table};
use crate::text::bounded;
use lariat_ancf::Vector3;
use nalgebra::UnitQuaternion;
use serde::Deserialize;
use std::f64::consts::PI;
use std::path::Path as FilePath;

table! {
    /// A path with rotations, or from a file. A kinematic body moves by its positions alone, by its rotations alone, or by both.
    struct PathTable("[body.path]") {
        /// Positions of the origin.
        rows: Option<Vec<[f64; 4]>> = ("the body stays at `position`"), Kind::Ascending(&["t", "x", "y", "z"]), "s, m";
        /// Axis times angle at times of their own, instead of `rotation` of the body. From row to row it changes by less than pi; several turns go on beyond them.
        rotation: Option<Vec<[f64; 4]>> = ("as the body has it"), Kind::Ascending(&["t", "x", "y", "z"]), "s, rad";
        /// Instead of both a text file, named from the folder of the scene, with rows `t,x,y,z` or `t,x,y,z,rx,ry,rz`; a first row of names is left out.
        csv: Option<String> = (), Kind::Text;
        /// Whether the velocity is continuous from row to row (cubics), or the path is linear between rows. It stays between equal rows, and is at rest outside in any case: begin and end with two equal rows to start and stop without a jump. Cubics through the corners of a trapezoid of velocities alone are another motion: put rows between them.
        smooth: bool = true, Kind::Flag;
    }
    choose Choose::AtLeastOne(&["rows", "rotation", "csv"]);
}

/// A path as a scene writes it.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum PathOrRows {
    /// Positions, linear between rows.
    Rows(Vec<[f64; 4]>),
    /// With all that a path has.
    Table(PathTable),
}

/// Reads a path; files are named from `folder`.
pub(super) fn read(doc: &Document<'_>, at: &KeyPath, path: PathOrRows, folder: &FilePath) -> Result<Path, Error> {
    let PathTable { rows, rotation, csv, smooth } = match path {
        PathOrRows::Rows(rows) => return Ok(Path { positions: in_time(doc, at, &rows)?, ..Path::default() }),
        PathOrRows::Table(table) => table,
    };
    let (mut rows, mut rotation) = (rows.unwrap_or_default(), rotation.unwrap_or_default());
    if let Some(file) = &csv {
        for (key, given) in [("rows", !rows.is_empty()), ("rotation", !rotation.is_empty())] {
            if given {
                return Err(doc.conflict(&at.key(key), format!("both csv and {key} are given")));
            }
        }
        let at = at.key("csv");
        (rows, rotation) = read_file(&folder.join(file)).map_err(|problem| doc.conflict(&at, problem))?;
    }
    let key = |key| at.key(if csv.is_some() { "csv" } else { key });
    let positions = in_time(doc, &key("rows"), &rows)?;
    let vectors = in_time(doc, &key("rotation"), &rotation)?;
    if let Some(far) = vectors.windows(2).find(|pair| (pair[1].1 - pair[0].1).norm() >= PI) {
        let problem = format!(
            "it turns by {:.2} rad between {} s and {} s, where half a turn has two senses: add rows between them",
            (far[1].1 - far[0].1).norm(),
            far[0].0,
            far[1].0
        );
        return Err(doc.conflict(&key("rotation"), problem));
    }
    let rotations = vectors.iter().map(|(t, vector)| (*t, UnitQuaternion::from_scaled_axis(*vector))).collect();
    Ok(Path { positions, rotations, smooth })
}

/// Rows of a time and three numbers.
type Rows = Vec<[f64; 4]>;

/// Reads rows of four or seven numbers from a file.
fn read_file(path: &FilePath) -> Result<(Rows, Rows), String> {
    let named = |problem: String| format!("{}: {problem}", path.display());
    let text = bounded(path).map_err(|error| named(error.to_string()))?;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let (mut rows, mut rotation): (Rows, Rows) = Default::default();
    for (i, record) in reader.records().enumerate() {
        let record = record.map_err(|error| named(error.to_string()))?;
        let row: Result<Vec<f64>, _> = record.iter().map(str::parse::<f64>).collect();
        let row = match row {
            Ok(row) if row.iter().all(|x| x.is_finite()) => row,
            Err(_) if i == 0 => continue,
            _ => {
                return Err(named(format!(
                    "row {}: {:?} are not all numbers",
                    i + 1,
                    record.iter().collect::<Vec<_>>()
                )));
            }
        };
        match row[..] {
            [t, x, y, z] => rows.push([t, x, y, z]),
            [t, x, y, z, rx, ry, rz] => {
                rows.push([t, x, y, z]);
                rotation.push([t, rx, ry, rz]);
            }
            _ => return Err(named(format!("row {} has {} numbers, not 4 or 7", i + 1, row.len()))),
        }
        if let [.., before, last] = &rows[..]
            && last[0] <= before[0]
        {
            return Err(named(format!("row {}: time {} is not above {}", i + 1, last[0], before[0])));
        }
    }
    if rows.is_empty() { Err(named("it has no rows".to_string())) } else { Ok((rows, rotation)) }
}

/// Returns the vectors of rows with their times.
fn in_time(doc: &Document<'_>, at: &KeyPath, rows: &[[f64; 4]]) -> Result<Vec<(f64, Vector3<f64>)>, Error> {
    let row = |&[t, x, y, z]: &[f64; 4]| {
        let vector = Vector3::new(x, y, z);
        doc.check_single(at, &vector)?;
        Ok((t, vector))
    };
    rows.iter().map(row).collect()
}
