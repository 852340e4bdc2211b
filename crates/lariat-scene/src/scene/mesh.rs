//! Triangles of an OBJ file.

use super::body::BodyShape;
use std::path::Path;
use tobj::LoadOptions;

/// Reads all triangles of an OBJ file, polygons cut into triangles, in m.
///
/// # Errors
/// In words.
pub fn read(path: &Path) -> Result<BodyShape, String> {
    let options = LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..LoadOptions::default() };
    // materials are of no interest, and a missing file of them no fault
    let (models, _) =
        tobj::load_obj(path, &options).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for model in models {
        let first = vertices.len() as u32;
        let corners = model.mesh.positions.chunks_exact(3).map(|x| [x[0], x[1], x[2]]);
        vertices.extend(corners);
        triangles.extend(model.mesh.indices.chunks_exact(3).map(|t| [first + t[0], first + t[1], first + t[2]]));
    }
    let inside = |t: &[u32; 3]| t.iter().all(|&i| (i as usize) < vertices.len());
    if triangles.is_empty() || !triangles.iter().all(inside) {
        return Err(format!("{} holds no triangles", path.display()));
    }
    if !vertices.iter().flatten().all(|x| x.is_finite()) {
        return Err(format!("{} has a corner that is not finite", path.display()));
    }
    Ok(BodyShape::Mesh { vertices, triangles })
}
