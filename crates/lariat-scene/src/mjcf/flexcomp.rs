//! Flexcomps of one dimension.

use super::read::Reader;
use super::{Imported, children};
use crate::error::Error;
use nalgebra::{Isometry3, Vector3};
use roxmltree::Node;

impl Reader<'_> {
    pub(super) fn flexcomp(&self, node: Node<'_, '_>, place: &Isometry3<f64>) -> Result<Imported, Error> {
        let here = place * self.place(node, "pos")?;
        if node.attribute("rigid") == Some("true") {
            return Err(self.wrong(node, "is rigid"));
        }
        let local: Vec<Vector3<f64>> = match node.attribute("type").unwrap_or("grid") {
            "grid" => {
                let count = self.number(node, "count")?.unwrap_or(10.0);
                let spacing = self.number(node, "spacing")?.unwrap_or(0.02);
                if !(2.0..=1e6).contains(&count) || count.fract() != 0.0 || spacing <= 0.0 {
                    return Err(self.wrong(
                        node,
                        format!("count = {count}, spacing = {spacing}: needs 2 vertices or more, and a spacing > 0"),
                    ));
                }
                // the grid is centred
                (0..count as usize).map(|i| Vector3::x() * spacing * (i as f64 - 0.5 * (count - 1.0))).collect()
            }
            "direct" => {
                let points = self.list(node, "point")?.unwrap_or_default();
                let order = self.list(node, "element")?.unwrap_or_default();
                let vertices = points.len() / 3;
                let in_a_row = order.len() == 2 * vertices.saturating_sub(1)
                    && order.chunks_exact(2).enumerate().all(|(i, pair)| pair == [i as f64, i as f64 + 1.0]);
                if vertices < 2 || points.len() % 3 != 0 || !in_a_row {
                    return Err(self.wrong(node, "needs points whose elements are 0 1 1 2 2 3 ..."));
                }
                points.chunks_exact(3).map(Vector3::from_column_slice).collect()
            }
            other => return Err(self.wrong(node, format!("type = {other:?}: grid and direct are read"))),
        };
        let scale = self.list(node, "scale")?.unwrap_or_else(|| vec![1.0; 3]);
        if scale != [1.0; 3] {
            return Err(self.wrong(node, "scale is not read: scale the points"));
        }
        let points: Vec<Vector3<f64>> = local.iter().map(|p| (here * nalgebra::Point3::from(*p)).coords).collect();
        let chords: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
        let length: f64 = chords.iter().sum();
        let edge = children(node, "edge").next();
        let stiffness = edge.map_or(Ok(None), |edge| self.number(edge, "stiffness"))?.filter(|k| *k > 0.0);
        let Some(stiffness) = stiffness else {
            return Err(
                self.wrong(node, "no edge stiffness > 0: without it there is no material (an equality is no material)")
            );
        };
        if chords.iter().any(|chord| (chord - chords[0]).abs() > 1e-6 * chords[0]) {
            return Err(self.wrong(node, "edges of different length: one stiffness for all is no material"));
        }
        let mass = self.number(node, "mass")?.unwrap_or(1.0);
        let damping = edge.map_or(Ok(None), |edge| self.number(edge, "damping"))?.filter(|c| *c > 0.0);
        if damping.is_some() {
            return Err(self.wrong(node, "edge damping is not read: give the cable damping.axial in the scene"));
        }
        // half of the mass of an end vertex is not on the cable: all vertices have the same
        let material = format!(
            "axial_stiffness = {:?}\nbending_stiffness = 0.0\nmass_per_length = {:?}\nrule = \"projected-none\"",
            stiffness * chords[0],
            mass / length
        );
        let mut holds = Vec::new();
        for pin in children(node, "pin") {
            for id in self.list(pin, "id")?.unwrap_or_default() {
                match id as usize {
                    0 => holds.push(("start", false)),
                    last if last + 1 == points.len() => holds.push(("end", false)),
                    inner => {
                        return Err(self.wrong(pin, format!("vertex {inner} is inside the cable: only ends are read")));
                    }
                }
            }
            if ["range", "grid", "gridrange"].iter().any(|key| pin.has_attribute(*key)) {
                return Err(self.wrong(pin, "only id is read"));
            }
        }
        let name = node.attribute("name").unwrap_or_default().to_string();
        Ok(Imported { name, points, material, holds, damping: None, prefix: None })
    }
}
