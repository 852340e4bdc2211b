//! Triangles of an OBJ file.

use serde::Deserialize;
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
        // materials are not used, and a missing file of them is not an error
        let (models, _) =
            tobj::load_obj(&path, &options).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
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
        Ok(())
    }
}
