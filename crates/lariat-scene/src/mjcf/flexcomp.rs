//! Flexcomps of one dimension.

use super::Importer;
use super::cable::{Cable, Hold, Names};
use super::composite::{VERTICES, in_world};
use super::surface::Surface;
use super::tree::Element;
use crate::error::Error;
use nalgebra::{Isometry3, Vector3};

impl Importer {
    pub(super) fn flexcomp(&mut self, node: &Element, root: usize, place: &Isometry3<f64>) -> Result<(), Error> {
        let here = place * self.local(node, "pos")?;
        if node.word("rigid", &["false", "true"])? == "true" {
            return Err(node.wrong("is rigid"));
        }
        let local: Vec<Vector3<f64>> = match node.word("type", &["grid", "direct"])? {
            "grid" => {
                let count = node.number("count")?.unwrap_or(10.0);
                let spacing = node.number("spacing")?.unwrap_or(0.02);
                if !VERTICES.contains(&count) || count.fract() != 0.0 || spacing <= 0.0 {
                    return Err(node.wrong(format!(
                        "count = {count}, spacing = {spacing}: needs 2 to {} vertices, and a spacing > 0",
                        VERTICES.end()
                    )));
                }
                // the grid is centred
                (0..count as usize).map(|i| Vector3::x() * spacing * (i as f64 - 0.5 * (count - 1.0))).collect()
            }
            _ => {
                let points = node.list("point")?.unwrap_or_default();
                let order = node.list("element")?.unwrap_or_default();
                let vertices = points.len() / 3;
                let in_a_row = order.len() == 2 * vertices.saturating_sub(1)
                    && order.chunks_exact(2).enumerate().all(|(i, pair)| pair == [i as f64, i as f64 + 1.0]);
                if vertices < 2 || points.len() % 3 != 0 || !in_a_row {
                    return Err(node.wrong("needs points whose elements are 0 1 1 2 2 3 ..."));
                }
                points.chunks_exact(3).map(Vector3::from_column_slice).collect()
            }
        };
        if node.list("scale")?.is_some_and(|scale| scale.iter().any(|factor| *factor != 1.0)) {
            return Err(node.wrong("scale is not read: scale the points"));
        }
        if self.options.density > 0.0 || self.options.viscosity > 0.0 {
            return Err(node.wrong(
                "in a fluid of <option>: MuJoCo takes its vertices for small balls; give the cable drag in the scene",
            ));
        }
        let vertices = in_world(&here, &local);
        let chords: Vec<f64> = vertices.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
        let edge = node.named("edge").next();
        let of_edge = |key: &str| edge.map_or(Ok(None), |edge| edge.number(key));
        let Some(stiffness) = of_edge("stiffness")?.filter(|k| *k > 0.0) else {
            return Err(
                node.wrong("no edge stiffness > 0: without it there is no material (an equality is no material)")
            );
        };
        if let Some(edge) = edge.filter(|edge| edge.attribute("equality").is_some_and(|value| value != "false")) {
            return Err(edge.wrong("equality: edges of one length, beside a stiffness, are no material: write false"));
        }
        if chords.iter().any(|chord| !chord.is_finite() || (chord - chords[0]).abs() > 1e-6 * chords[0])
            || chords[0] <= 0.0
        {
            return Err(node.wrong("edges of different length: one stiffness for all is no material"));
        }
        let mass = node.number("mass")?.unwrap_or(1.0);
        if mass <= 0.0 {
            return Err(node.wrong("needs a mass > 0"));
        }
        let index = self.cables.len();
        for pin in node.named("pin") {
            for id in pin.list("id")?.unwrap_or_default() {
                if id < 0.0 || id.fract() != 0.0 || id as usize >= vertices.len() {
                    return Err(
                        pin.wrong(format!("vertex {id}: the cable has the vertices 0 to {}", vertices.len() - 1))
                    );
                }
                let arc = chords[0] * id;
                if !self.holds.iter().any(|hold| hold.cable == index && hold.arc == arc) {
                    self.holds.push(Hold { cable: index, arc, frame: root, clamp: false });
                }
            }
        }
        let contact = node.named("contact").next();
        let surface = Surface::read(contact, self.options.no_contact)?;
        let kinds = ["auto", "none", "narrow", "bvh", "sap"];
        let alone = match contact {
            Some(contact) => contact.word("selfcollide", &kinds)? == "none",
            None => false,
        };
        let itself = !alone && surface.touches(&surface);
        let name = node.attribute("name").unwrap_or_default().to_string();
        let radius = node.number("radius")?.unwrap_or(0.005);
        if radius <= 0.0 {
            return Err(node.wrong("radius is not above 0"));
        }
        if node.named("edge").count() > 1 || node.named("contact").count() > 1 {
            return Err(node.wrong("has two edge or contact"));
        }
        let arcs = (0..vertices.len()).map(|k| chords[0] * k as f64).collect();
        // a spring k with a damper c beside it is a modulus with the time c/k
        let axial_damping = of_edge("damping")?.filter(|c| *c > 0.0).map(|c| c / stiffness);
        let own = self.free_name(&name, "cable");
        self.cables.push(Cable {
            name: own,
            names: Names::Flex(name),
            points: vertices.clone(),
            vertices,
            arcs,
            curvature: Vec::new(),
            solid: None,
            stretches: true,
            axial: stiffness * chords[0],
            bending: 0.0,
            // half of the mass of an end vertex is not on the cable: all vertices have the same
            mass,
            bending_damping: None,
            axial_damping,
            surface,
            radius,
            itself,
            drag: None,
        });
        Ok(())
    }
}
