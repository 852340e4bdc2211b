//! What a cable is made of: plain data from which everything else is rebuilt.

mod scale;
mod segments;

pub(crate) use scale::{LoadScale, largest_force};

use crate::effect::acts::Acts;
use crate::effect::force_density::ForceDensities;
use crate::effect::potential::Potentials;
use crate::effect::tables::ElementTables;
use crate::effect::torsion::stranded::Strands;
use crate::effect::{AxialLaw, Damping, Effects, LineLoads, RestShape, Target};
use crate::error::{Error, Requirement, require, require_finite};
use crate::load::PointLoad;
use crate::obstacle::Obstacles;
use crate::reel::Reels;
use crate::rule::Rule;
use crate::scales::cable::{AT_NODE, MAX_ELEMENTS};
use crate::section::Element;
use crate::strength::Strength;
use crate::support::Support;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Gravity that a cable has unless told otherwise, in m/s^2: (0, -9.81, 0). Not the standard
/// 9.80665: the value that games and engines use.
pub const STANDARD_GRAVITY: Vector3<f64> = Vector3::new(0.0, -9.81, 0.0);

/// A node at a corner of the drawn shape.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Corner {
    pub(crate) position: Vector3<f64>,
    pub(crate) slope: Vector3<f64>,
    /// Slopes of the cable before and behind it.
    pub(crate) sides: [Vector3<f64>; 2],
}

/// An end of a slack cable as it was laid, and the direction in which it was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Drawn {
    pub(crate) position: Vector3<f64>,
    pub(crate) slope: Vector3<f64>,
    pub(crate) direction: Vector3<f64>,
}

/// The description of a cable; see [`CableBuilder`](crate::CableBuilder) for units and defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Model {
    pub(crate) name: String,
    pub(crate) elements: Vec<Element>,
    pub(crate) rule: Rule,
    pub(crate) gravity: Vector3<f64>,
    /// Supports by node, ascending, none of them free.
    pub(crate) supports: Vec<(usize, Support)>,
    pub(crate) loads: Vec<PointLoad>,
    /// By point load, the arc length in m of its material less what had come through the eye of a
    /// reel at the start when it was given: it stays.
    #[serde(default)]
    pub(crate) load_origins: Vec<f64>,
    #[serde(default)]
    pub(crate) effects: Effects,
    #[serde(default)]
    pub(crate) force_densities: ForceDensities,
    #[serde(default)]
    pub(crate) potentials: Potentials,
    /// What it can touch; set by the host, no part of a file.
    #[serde(skip)]
    pub(crate) obstacles: Obstacles,
    /// By which other cables remember contacts with it.
    #[serde(default)]
    pub(crate) contact_key: u64,
    #[serde(default)]
    pub(crate) strength: Strength,
    #[serde(default)]
    pub(crate) reels: Reels,
    /// Corners at nodes of the drawn shape.
    #[serde(default)]
    pub(crate) corners: Vec<Corner>,
    /// Ends of a slack cable, whose tangents are not those of the drawing.
    #[serde(default)]
    pub(crate) drawn: Vec<Drawn>,
    /// Length of the drawing in m, if it was drawn.
    #[serde(default)]
    pub(crate) drawn_length: Option<f64>,
    /// Axial damping time in s that the cable has at least; set by the host, no part of a file.
    #[serde(skip)]
    pub(crate) least_damping: f64,
}

impl Model {
    /// Refuses numbers that make no cable: for descriptions that come from a file.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let cable = || self.name.clone();
        if self.elements.is_empty() {
            return Err(Error::ElementCount { cable: cable(), count: 0, most: MAX_ELEMENTS });
        }
        self.rule.check_points()?;
        for element in &self.elements {
            require("element length (m)", element.length, element.length > 0.0, "> 0")?;
            element.section.checked()?;
        }
        require_finite("gravity (m/s^2)", &self.gravity)?;
        let length = self.length();
        for load in &self.loads {
            let s = load.arc_length;
            require("arc length of a load (m)", s, s >= 0.0 && s <= length * (1.0 + 1e-12), "on the cable")?;
            load.check()?;
        }
        for s in self.potentials.list.iter().map(|own| own.arc_length) {
            require("arc length of a potential (m)", s, s >= 0.0 && s <= length * (1.0 + 1e-12), "on the cable")?;
        }
        let nodes = self.nodes();
        let unordered = self.supports.windows(2).find(|s| s[0].0 >= s[1].0).map(|s| s[1].0);
        let outside = self.supports.iter().map(|(node, _)| *node).find(|node| *node >= nodes);
        if let Some(node) = unordered.or(outside) {
            return Err(Error::SupportOrder { cable: cable(), node, nodes });
        }
        self.supports.iter().try_for_each(|(_, support)| support.check())?;
        self.strength.check()?;
        self.check_effects()
    }

    /// Number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.elements.len() + 1
    }

    /// Unstretched length in m.
    pub(crate) fn length(&self) -> f64 {
        self.elements.iter().map(|e| e.length).sum()
    }

    /// Arc length of each node in m.
    pub(crate) fn node_arc_lengths(&self) -> impl Iterator<Item = f64> + '_ {
        let add = |s: &mut f64, element: &Element| {
            *s += element.length;
            Some(*s)
        };
        core::iter::once(0.0).chain(self.elements.iter().scan(0.0, add))
    }

    /// Element and local coordinate xi of an arc length in `[0, length]`; at a node, whatever
    /// rounding says, those of the element before it.
    pub(crate) fn locate(&self, arc_length: f64) -> (usize, f64) {
        let (mut rest, near) = (arc_length, AT_NODE * arc_length);
        for (e, element) in self.elements.iter().enumerate() {
            if rest <= element.length + near || e + 1 == self.elements.len() {
                return (e, (rest / element.length).clamp(0.0, 1.0));
            }
            rest -= element.length;
        }
        unreachable!("a cable has at least one element")
    }

    /// Returns whether an element is at the eye of a reel, where material flows: it touches
    /// nothing.
    pub(crate) fn is_at_eye(&self, element: usize) -> bool {
        self.reels.sides().any(|side| side.element(self.elements.len()) == element)
    }

    /// Returns whether contact begins with an element: it is the first, or behind one at an eye.
    pub(crate) fn begins_contact(&self, element: usize) -> bool {
        element == 0 || self.is_at_eye(element - 1)
    }

    /// Returns whether contact ends with an element.
    pub(crate) fn ends_contact(&self, element: usize) -> bool {
        element + 1 == self.elements.len() || self.is_at_eye(element + 1)
    }

    /// The support of a node, if any.
    pub(crate) fn support(&self, node: usize) -> Option<&Support> {
        self.supports.binary_search_by_key(&node, |(n, _)| *n).ok().map(|at| &self.supports[at].1)
    }

    /// Returns whether tension and shape have no reason to jump at a node between two elements, at
    /// an arc length in m: neither support, load nor another section.
    pub(crate) fn is_smooth_at(&self, node: usize, s: f64) -> bool {
        let [a, b] = [&self.elements[node - 1], &self.elements[node]];
        let is_held = || self.supports.iter().any(|(held, _)| *held == node);
        let near = |at: f64| (at - s).abs() <= AT_NODE * self.length();
        a.section == b.section && !is_held() && !self.pulled_points().any(near)
    }

    /// Returns the arc lengths in m of point loads and potentials.
    pub(crate) fn pulled_points(&self) -> impl Iterator<Item = f64> {
        self.loads.iter().map(|load| load.arc_length).chain(self.potentials.list.iter().map(|own| own.arc_length))
    }

    /// Sets the support of a node; a free one is removed.
    pub(crate) fn set_support(&mut self, node: usize, support: Support) {
        self.supports.retain(|(n, _)| *n != node);
        if !support.is_free() {
            let at = self.supports.partition_point(|(n, _)| *n < node);
            self.supports.insert(at, (node, support));
        }
    }

    /// The cable as effects see it.
    pub(crate) fn target(&self) -> Target<'_> {
        let gravity = self.effects.gravity_factor() * self.gravity;
        Target { name: &self.name, rule: self.rule, elements: &self.elements, gravity }
    }

    /// Damping with the least time of the axial strain, if the cable's own has less.
    fn least_damping(&self) -> Option<Damping> {
        let own = self.effects.damping.unwrap_or_default();
        (own.axial < self.least_damping).then_some(Damping { axial: self.least_damping, ..own })
    }

    /// Tables for the element kernel, if an effect acts there.
    pub(crate) fn in_element(&self) -> Option<ElementTables> {
        let (target, own) = (self.target(), self.effects.in_element(&self.target()));
        let mut tables = match self.least_damping() {
            None => own?,
            Some(damping) => match own {
                Some(tables) => ElementTables { damping: damping.in_element(&target), ..tables },
                None => Effects { damping: Some(damping), ..Effects::default() }.in_element(&target)?,
            },
        };
        // the damping of a law that cannot push
        if let (Some(damping), Some(law)) = (&mut tables.damping, &tables.axial_law) {
            damping.follow(law, self.rule.axial);
        }
        Some(tables)
    }

    /// Rejects effects that are out of range or that the cable has no numbers for.
    pub(crate) fn check_effects(&self) -> Result<(), Error> {
        self.effects.check(&self.target())?;
        let stretched = RestShape::is_stretched;
        let has_law = self.effects.axial_law.as_ref().is_some_and(AxialLaw::is_other);
        if has_law && self.effects.rest_shape.as_ref().is_some_and(stretched) {
            let (cable, effect) = (self.name.clone(), "an axial law");
            return Err(Error::MissingForEffect { cable, effect, requirement: Requirement::RestStretch });
        }
        if self.effects.torsion.as_ref().and_then(Strands::of).is_some() {
            let problems = [(has_law, "an axial law"), (!self.reels.is_empty(), "a reel")];
            if let Some((_, what)) = problems.into_iter().find(|(is, _)| *is) {
                let by = format!("with {what} where tension makes torque: leave out torque_per_tension");
                return Err(Error::TorsionPlace { cable: self.name.clone(), by });
            }
        }
        if self.reels.is_empty() { Ok(()) } else { self.check_with_reel() }
    }

    /// Returns the axial stiffness in N of an element whose twist bears no torque: EA, but of a
    /// [stranded rope](crate::effect::torsion::stranded).
    pub(crate) fn axial_stiffness(&self, element: &Element) -> f64 {
        let strands = self.effects.torsion.as_ref().and_then(Strands::of);
        strands.map_or(element.section.axial_stiffness, |strands| strands.axial(element))
    }

    /// Returns whether it becomes slack, by its axial law.
    pub fn goes_slack(&self) -> bool {
        matches!(self.effects.axial_law, Some(AxialLaw::Rope | AxialLaw::Curve(_)))
    }

    /// Returns whether a force depends on velocity.
    pub(crate) fn depends_on_velocity(&self) -> bool {
        self.least_damping().is_some()
            || self.effects.depends_on_velocity()
            || self.force_densities.depend_on_velocity()
            || !self.reels.is_empty()
    }

    /// Returns whether the step matrix holds the exact tangent of the force.
    pub(crate) fn has_exact_tangent(&self) -> bool {
        self.least_damping().is_none()
            && self.effects.has_exact_tangent()
            && self.force_densities.is_empty()
            && self.reels.is_empty()
    }

    /// Returns the mass per length in kg/m that resists acceleration, added mass included.
    pub(crate) fn inertia(&self, element: &Element) -> f64 {
        element.section.mass_per_length + self.effects.added_mass(&element.section)
    }

    /// Returns the weight per length in N/m: scaled gravity less buoyancy.
    pub(crate) fn weight(&self, element: &Element) -> Vector3<f64> {
        self.effects.weight(&element.section, self.gravity)
    }

    /// Returns the constant force per length in N/m of a cable with a reel, beside its weight.
    pub(crate) fn line_force(&self) -> Vector3<f64> {
        self.effects.line_loads.as_ref().map_or_else(Vector3::zeros, LineLoads::sum)
    }

    /// Returns the sum of weights and constant forces in N, and the sum of their sizes.
    pub(crate) fn dead_resultant(&self) -> (Vector3<f64>, f64) {
        let mut sum = (Vector3::zeros(), 0.0);
        for element in &self.elements {
            // a neutrally buoyant cable is measured by its weight in air
            let size = element.length * element.section.mass_per_length * self.gravity.norm();
            sum = (sum.0 + element.length * self.weight(element), sum.1 + size * self.effects.gravity_factor().abs());
        }
        self.effects.add_resultant(&self.target(), &mut sum.0, &mut sum.1);
        sum
    }
}
