//! A cable of a model, as the scene has it.

use super::surface::Surface;
use nalgebra::Vector3;

/// What a cable's parts are called in MuJoCo.
pub(super) enum Names {
    /// Bodies `B_first`, `B_1`, ..., `B_last` after a prefix, and sites `S_first`, `S_last`.
    Composite(String),
    /// Bodies `NAME_0`, `NAME_1`, ..., one for each vertex.
    Flex(String),
}

/// Largest strain of a composite under the weight of all that moves. Setting: MuJoCo's does not stretch; a span that is
/// drawn straight sags by `(3 STRETCH/64)^(1/3)` of its length, 0.8 %.
const STRETCH: f64 = 1e-5;

/// A cable.
pub(super) struct Cable {
    pub name: String,
    pub names: Names,
    /// Where its segments meet, in the world, in m.
    pub vertices: Vec<Vector3<f64>>,
    /// Arc length of each vertex along the drawn shape, in m.
    pub arcs: Vec<f64>,
    /// The drawn shape: the vertices, or points on a smooth curve through them.
    pub points: Vec<Vector3<f64>>,
    /// Stress-free curvature of each segment, in 1/m; empty if it is straight.
    pub curvature: Vec<f64>,
    /// Keys of section and material, if it is solid.
    pub solid: Option<String>,
    /// Whether it stretches in MuJoCo.
    pub stretches: bool,
    /// EA in N, EI in N m^2, and mass in kg.
    pub axial: f64,
    pub bending: f64,
    pub mass: f64,
    /// Times of the damping of bending, and of stretching, in s.
    pub bending_damping: Option<f64>,
    pub axial_damping: Option<f64>,
    pub surface: Surface,
    /// Radius of contact, in m.
    pub radius: f64,
    /// Whether it touches itself.
    pub itself: bool,
    pub drag: Option<Drag>,
}

/// Drag of a segment in a fluid: coefficients on the diameter.
pub(super) struct Drag {
    pub normal: f64,
    pub tangential: f64,
    pub diameter: f64,
}

/// A hold of a point of a cable: where, the frame that holds it, and whether it holds the tangent.
#[derive(Clone, Debug)]
pub(super) struct Hold {
    pub cable: usize,
    pub arc: f64,
    pub frame: usize,
    pub clamp: bool,
}

impl Cable {
    pub fn length(&self) -> f64 {
        self.arcs.last().copied().unwrap_or(0.0)
    }

    /// Returns the keys of its section and material under a load in N: what does not stretch in MuJoCo is
    /// stretched by `STRETCH` at most.
    pub fn material(&self, load: f64) -> (String, bool) {
        let stiff = load / STRETCH;
        let stiffened = !self.stretches && stiff > self.axial;
        let keys = match &self.solid {
            Some(keys) if !stiffened => keys.clone(),
            _ => format!(
                "axial_stiffness = {:?}\nbending_stiffness = {:?}\nmass_per_length = {:?}{}",
                if stiffened { stiff } else { self.axial },
                self.bending,
                self.mass / self.length(),
                if self.stretches { "\nrule = \"projected-none\"" } else { "" }
            ),
        };
        (keys, stiffened)
    }

    /// Returns the segment or vertex that a body of MuJoCo is.
    pub fn part(&self, body: &str) -> Option<usize> {
        let index = |text: &str| text.parse::<usize>().ok().filter(|index| index.to_string() == text);
        let last = self.vertices.len() - 2;
        match &self.names {
            Names::Composite(prefix) => match body.strip_prefix(prefix.as_str())?.strip_prefix("B_")? {
                "first" => Some(0),
                "last" if last > 0 => Some(last),
                word => index(word).filter(|k| (1..last).contains(k)),
            },
            Names::Flex(name) => index(body.strip_prefix(name.as_str())?.strip_prefix('_')?).filter(|k| *k <= last + 1),
        }
    }

    /// Returns the arc length of a site of a composite.
    pub fn site(&self, site: &str) -> Option<f64> {
        let Names::Composite(prefix) = &self.names else { return None };
        match site.strip_prefix(prefix.as_str())?.strip_prefix("S_")? {
            "first" => Some(0.0),
            "last" => Some(self.length()),
            _ => None,
        }
    }
}
