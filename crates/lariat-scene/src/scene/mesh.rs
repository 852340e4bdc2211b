//! Triangles of an OBJ file.

use crate::text::bounded;
use nalgebra::Vector3;
use serde::Deserialize;
use std::fmt::Display;
use std::path::Path;
use tobj::LoadOptions;

/// Triangles of an OBJ file, in m.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(from = "String")]
pub struct Mesh {
    /// The file, named from the folder of the scene.
    pub file: String,
    /// Corners.
    pub vertices: Vec<[f64; 3]>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
}

impl From<String> for Mesh {
    fn from(file: String) -> Self {
        Mesh { file, ..Mesh::default() }
    }
}

impl Mesh {
    /// Reads all triangles of the file; polygons are cut into triangles.
    ///
    /// # Errors
    /// In words, if the file cannot be read or holds no triangles of finite corners.
    pub(super) fn read(&mut self, folder: &Path) -> Result<(), String> {
        let path = folder.join(&self.file);
        let options =
            LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..LoadOptions::default() };
        let unread = |problem: &dyn Display| format!("cannot read {}: {problem}", path.display());
        let text = bounded(&path).map_err(|error| unread(&error))?;
        // materials are not used, and a missing file of them is not an error
        let no_materials = |_: &Path| Ok((Vec::new(), Default::default()));
        let (models, _) =
            tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials).map_err(|error| unread(&error))?;
        for model in models {
            let first = self.vertices.len() as u32;
            self.vertices.extend(model.mesh.positions.chunks_exact(3).map(|x| [x[0], x[1], x[2]]));
            let triangles = model.mesh.indices.chunks_exact(3);
            self.triangles.extend(triangles.map(|t| [first + t[0], first + t[1], first + t[2]]));
        }
        let inside = |t: &[u32; 3]| t.iter().all(|&i| (i as usize) < self.vertices.len());
        if self.triangles.is_empty() || !self.triangles.iter().all(inside) {
            return Err(format!("{} holds no triangles", path.display()));
        }
        if !self.vertices.iter().flatten().all(|x| x.is_finite()) {
            return Err(format!("{} has a corner that is not finite", path.display()));
        }
        // triangles without area, which programs export where corners coincide, have no normal and cover nothing
        let corner = |i: u32| Vector3::from(self.vertices[i as usize]);
        self.triangles.retain(|&[a, b, c]| (corner(b) - corner(a)).cross(&(corner(c) - corner(a))) != Vector3::zeros());
        if self.triangles.is_empty() {
            return Err(format!("{} holds triangles without area alone", path.display()));
        }
        Ok(())
    }
}
