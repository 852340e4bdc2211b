//! Composites of type cable, and the constraints that hold their last body.

use super::read::Reader;
use super::{Imported, children};
use crate::error::Error;
use nalgebra::{Isometry3, Vector3};
use roxmltree::Node;
use std::f64::consts::PI;

impl Reader<'_> {
    pub(super) fn composite(&self, node: Node<'_, '_>, place: &Isometry3<f64>) -> Result<Imported, Error> {
        let here = place * self.place(node, "offset")?;
        let local = match self.list(node, "vertex")? {
            Some(numbers) if numbers.len() >= 6 && numbers.len() % 3 == 0 => {
                numbers.chunks_exact(3).map(Vector3::from_column_slice).collect()
            }
            Some(numbers) => {
                return Err(self.wrong(node, format!("vertex has {} numbers: needs 6, 9, ...", numbers.len())));
            }
            None => self.curve(node)?,
        };
        let points: Vec<Vector3<f64>> = local.iter().map(|p| (here * nalgebra::Point3::from(*p)).coords).collect();
        let length: f64 = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
        let Some(geom) = children(node, "geom").next() else { return Err(self.wrong(node, "has no geom")) };
        let configured = |key: &str| -> Result<Option<f64>, Error> {
            let mut configs = children(node, "plugin").flat_map(|plugin| children(plugin, "config"));
            let config = configs.find(|config| config.attribute("key") == Some(key));
            config.map_or(Ok(None), |config| self.number(config, "value"))
        };
        let young = configured("bend")?.or(configured("young")?);
        let Some(young) = young.filter(|young| *young > 0.0) else {
            return Err(self.wrong(
                node,
                "no bend > 0 in its plugin mujoco.elasticity.cable: without a modulus there is no cable",
            ));
        };
        let size = self.list(geom, "size")?.unwrap_or_default();
        let (area, bending, section) = match (geom.attribute("type").unwrap_or("sphere"), &size[..]) {
            ("capsule" | "cylinder", &[r, ..]) if r > 0.0 => {
                (PI * r * r, PI * r.powi(4) / 4.0, format!("section = {{ round = {:?} }}", 2.0 * r))
            }
            ("box", &[_, a, b]) if a > 0.0 && a == b => {
                (4.0 * a * a, 4.0 * a.powi(4) / 3.0, format!("section = {{ square = {:?} }}", 2.0 * a))
            }
            (kind, _) => {
                return Err(self
                    .wrong(geom, format!("a {kind} of size {size:?}: capsules, cylinders and square boxes are read")));
            }
        };
        let segments = (points.len() - 1) as f64;
        let material = match (self.number(geom, "mass")?, self.number(geom, "density")?) {
            (Some(mass), _) if mass > 0.0 => format!(
                "axial_stiffness = {:?}\nbending_stiffness = {:?}\nmass_per_length = {:?}",
                young * area,
                young * bending,
                mass * segments / length
            ),
            (None, density) if density.unwrap_or(1000.0) > 0.0 => {
                format!("{section}\ndensity = {:?}\nyoungs_modulus = {young:?}", density.unwrap_or(1000.0))
            }
            _ => return Err(self.wrong(geom, "needs a mass or a density > 0")),
        };
        let holds = match node.attribute("initial").unwrap_or("ball") {
            "free" => Vec::new(),
            "ball" => vec![("start", false)],
            "none" => vec![("start", true)],
            other => return Err(self.wrong(node, format!("initial = {other:?}: free, ball and none are read"))),
        };
        // a torque c w at a joint is that of the bending moment EI tau kappa', kappa' = w/(length of a segment)
        let joint = children(node, "joint").next();
        let damping = joint.map_or(Ok(None), |joint| self.number(joint, "damping"))?;
        let damping = damping.filter(|c| *c > 0.0).map(|c| c * length / segments / (young * bending));
        let prefix = node.attribute("prefix").unwrap_or_default().to_string();
        let name = prefix.trim_end_matches('_').to_string();
        Ok(Imported { name, points, material, holds, damping, prefix: Some(prefix) })
    }

    fn curve(&self, node: Node<'_, '_>) -> Result<Vec<Vector3<f64>>, Error> {
        let count = self.number(node, "count")?.unwrap_or(0.0);
        if !(2.0..=1e6).contains(&count) || count.fract() != 0.0 {
            return Err(self.wrong(node, format!("count = {count}: needs a whole number of vertices, 2 or more")));
        }
        let size = self.list(node, "size")?.unwrap_or_default();
        let [l, r, turns] = [0, 1, 2].map(|k| size.get(k).copied().unwrap_or(if k == 0 { 1.0 } else { 0.0 }));
        let Some(curve) = node.attribute("curve") else { return Err(self.wrong(node, "needs vertex or curve")) };
        let words: Vec<&str> = curve.split_whitespace().collect();
        if words.is_empty() || words.len() > 3 {
            return Err(self.wrong(node, format!("curve = {curve:?}: needs 1 to 3 functions")));
        }
        let mut points = Vec::new();
        for i in 0..count as usize {
            let s = i as f64 / (count - 1.0);
            let mut point = Vector3::zeros();
            for (k, word) in words.iter().enumerate() {
                point[k] = match *word {
                    "s" => l * s,
                    "cos(s)" => r * (PI * turns * s).cos(),
                    "sin(s)" => r * (PI * turns * s).sin(),
                    "0" => 0.0,
                    other => return Err(self.wrong(node, format!("curve: {other:?} is not s, cos(s), sin(s) or 0"))),
                };
            }
            points.push(point);
        }
        Ok(points)
    }

    /// Reads what holds the last body of a composite.
    pub(super) fn equality(&self, equality: Node<'_, '_>, cables: &mut [Imported]) -> Result<(), Error> {
        for constraint in equality.children().filter(Node::is_element) {
            let bodies = ["body1", "body2"].map(|key| constraint.attribute(key).unwrap_or("world"));
            for cable in cables.iter_mut() {
                let Some(prefix) = &cable.prefix else { continue };
                let is_own = |body: &str| body.strip_prefix(prefix.as_str()).is_some_and(|rest| rest.starts_with("B_"));
                let Some(own) = bodies.into_iter().find(|body| is_own(body)) else { continue };
                let other = bodies.into_iter().find(|body| !is_own(body));
                let clamp = match constraint.tag_name().name() {
                    "connect" => false,
                    "weld" => true,
                    _ => return Err(self.wrong(constraint, "of a body of a cable is not read: connect and weld are")),
                };
                if other != Some("world") || own != format!("{prefix}B_last") {
                    return Err(self.wrong(
                        constraint,
                        format!("holds {own} to {}: only the last body to the world is read", other.unwrap_or(own)),
                    ));
                }
                cable.holds.push(("end", clamp));
            }
        }
        Ok(())
    }
}
