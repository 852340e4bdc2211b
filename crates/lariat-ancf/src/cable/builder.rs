//! Building a cable.

use super::as_laid::Sagging;
use super::clamp::{is_turned, unit};
use super::grading::{self, Grading};
use super::layout::{Laid, Sag};
use super::span::Span;
use super::unstrained::{Kept, unstrain};
use super::{Cable, Snapshot, layout};
use crate::at::At;
use crate::effect::force_density::ForceDensities;
use crate::effect::potential::Potentials;
use crate::effect::{AxialLaw, Damping, Effects, ForceDensity, RopeKind};
use crate::error::{Error, require, require_finite};
use crate::integrate::Fidelity;
use crate::load::PointLoad;
use crate::material::RopeMaterial;
use crate::model::{Corner, Drawn, Model, STANDARD_GRAVITY};
use crate::obstacle::Obstacles;
use crate::point::Point;
use crate::reel::Reels;
use crate::rule::{BendingRule, Rule};
use crate::scales::cable::{MAX_ELEMENTS, SLACK};
use crate::section::{Element, Section};
use crate::support::{Motion, SlopeSupport, Support};
use nalgebra::Vector3;
use std::sync::Arc;

/// How a node is held at the start; see [`CableBuilder::fix`] and [`CableBuilder::clamp`].
#[derive(Clone, Copy, Debug)]
enum Hold {
    Pin,
    /// Along this direction, or that of the drawing.
    Clamp(Option<Vector3<f64>>),
}

/// Builds a [`Cable`]. Needed: two points and a section; everything else has a default.
#[derive(Clone, Debug)]
pub struct CableBuilder {
    name: String,
    points: Vec<Vector3<f64>>,
    length: Option<f64>,
    span: Option<Span>,
    elements: usize,
    /// Length in m of the finest elements, and the points where they are.
    grading: Option<(f64, Vec<At>)>,
    sections: Vec<(f64, Section)>,
    nodes_at: Vec<f64>,
    rule: Option<Rule>,
    allow_rank_deficient: bool,
    integrator: Option<Fidelity>,
    gravity: Vector3<f64>,
    velocity: Vector3<f64>,
    angular_velocity: Vector3<f64>,
    holds: Vec<(At, Hold)>,
    loads: Vec<PointLoad>,
    effects: Effects,
    damped_as: Option<RopeKind>,
    force_densities: ForceDensities,
}

impl Default for CableBuilder {
    fn default() -> Self {
        CableBuilder {
            name: "cable".to_string(),
            points: Vec::new(),
            length: None,
            span: None,
            elements: 10,
            grading: None,
            sections: Vec::new(),
            nodes_at: Vec::new(),
            rule: None,
            allow_rank_deficient: false,
            integrator: None,
            gravity: STANDARD_GRAVITY,
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            holds: Vec::new(),
            loads: Vec::new(),
            effects: Effects::default(),
            damped_as: None,
            force_densities: ForceDensities::default(),
        }
    }
}

impl Cable {
    /// Starts building a cable.
    pub fn builder() -> CableBuilder {
        CableBuilder::default()
    }
}

impl CableBuilder {
    /// Name in errors and reports. Default "cable".
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Start shape: a polyline through these points, in m. At least two. The cable is smooth and
    /// starts without strain but an even stretch, so corners are rounded, within 0.6 elements; not
    /// those on a node that is held, clamped or asked for by [`node_at`](Self::node_at).
    pub fn points<P: Into<Point>>(mut self, points: impl IntoIterator<Item = P>) -> Self {
        self.points = points.into_iter().map(|p| p.into().0).collect();
        self
    }

    /// Unstretched length in m. Default: the length of the polyline. Longer: the cable starts
    /// slack, in arcs that sag along gravity; shorter: it starts stretched.
    pub fn length(mut self, length: f64) -> Self {
        self.length = Some(length);
        self
    }

    /// Instead of [`length`](Self::length): the length with which the cable has this tension in N
    /// at its middle when it hangs between its drawn ends, under its weight, loads per length and
    /// buoyancy: as it is installed, before loads at points, wind and currents.
    pub fn pretension(mut self, tension: f64) -> Self {
        self.span = Some(Span::Tension(tension));
        self
    }

    /// Instead of [`length`](Self::length): the length with which the cable hangs by this distance
    /// in m below the line between its drawn ends, at most; under the same.
    pub fn sag(mut self, sag: f64) -> Self {
        self.span = Some(Span::Sag(sag));
        self
    }

    /// Number of elements. Default 10.
    pub fn elements(mut self, elements: usize) -> Self {
        self.elements = elements;
        self
    }

    /// Grades the mesh: elements at these points, on which nodes are placed, have this length in m
    /// at most, and the others grow from there by a constant ratio, up to the
    /// [number](Self::elements) of elements. For cables that bend sharply where they are clamped,
    /// held or loaded: under a tension T within `sqrt(EI/T)`, of which elements should have twice
    /// the length there, or less. A cable with a [reel](Cable::add_reel) at such a point splits and
    /// merges its elements by their mean length.
    pub fn finest<A: Into<At>>(mut self, length: f64, at: impl IntoIterator<Item = A>) -> Self {
        self.grading = Some((length, at.into_iter().map(Into::into).collect()));
        self
    }

    /// Section of the whole cable.
    pub fn section(self, section: Section) -> Self {
        self.section_from(0.0, section)
    }

    /// Section of the whole cable by name: that of a rope or chain of this material and nominal
    /// diameter in m. Its EA is force over elongation, as catalogues have it, and it cannot push:
    /// its axial law is [`AxialLaw::Rope`], unless the [effects](Self::effects) have one, or what
    /// no law goes with: a rest stretch or a torque of tension.
    ///
    /// # Errors
    /// As [`RopeMaterial::section`].
    pub fn rope(self, material: RopeMaterial, diameter: f64) -> Result<Self, Error> {
        Ok(self.section(material.section(diameter)?))
    }

    /// Section from an arc length (m) on, up to the next one given: for cables made of pieces. A
    /// node is placed there.
    pub fn section_from(mut self, arc_length: f64, section: Section) -> Self {
        self.sections.push((arc_length, section));
        self
    }

    /// Places a node at this arc length (m).
    pub fn node_at(mut self, arc_length: f64) -> Self {
        self.nodes_at.push(arc_length);
        self
    }

    /// Force strategy. Default: [`Fidelity::rule`] of the fidelity that is chosen as integrator,
    /// `projected-3` without one.
    pub fn rule(mut self, rule: Rule) -> Self {
        self.rule = Some(rule);
        self
    }

    /// Builds even if the rule leaves modes without energy (see [`Rule::check`]).
    pub fn allow_rank_deficient(mut self) -> Self {
        self.allow_rank_deficient = true;
        self
    }

    /// Time integrator: an [`Integrator`](crate::Integrator), or a [`Fidelity`] that chooses one by
    /// the cable's frequencies. Default: [`Fidelity::Engineering`] for a cable by itself; in a set
    /// of cables beside Rapier, the set's.
    pub fn integrator(mut self, integrator: impl Into<Fidelity>) -> Self {
        self.integrator = Some(integrator.into());
        self
    }

    /// Time integrator of a fidelity. Default: as for [`integrator`](Self::integrator). Its rule is
    /// that of the cable unless another is [chosen](Self::rule); its number of elements is a
    /// recommendation: [`Fidelity::elements`].
    pub fn fidelity(self, fidelity: Fidelity) -> Self {
        self.integrator(fidelity)
    }

    /// Gravity in m/s^2. Default [`STANDARD_GRAVITY`].
    pub fn gravity(mut self, gravity: impl Into<Point>) -> Self {
        self.gravity = gravity.into().0;
        self
    }

    /// Initial velocity of the whole cable in m/s. Default zero.
    pub fn velocity(mut self, velocity: impl Into<Point>) -> Self {
        self.velocity = velocity.into().0;
        self
    }

    /// Initial angular velocity about the start point in rad/s. Default zero.
    pub fn angular_velocity(mut self, angular_velocity: impl Into<Point>) -> Self {
        self.angular_velocity = angular_velocity.into().0;
        self
    }

    /// Holds the position of a point where it starts; its slope is free. A node is placed there.
    pub fn fix(mut self, at: impl Into<At>) -> Self {
        self.holds.push((at.into(), Hold::Pin));
        self
    }

    /// Holds the position of a point where it starts, and its tangent in the direction of the
    /// polyline there: at the start along the first of its segments, also if the cable is longer
    /// than drawn. A node is placed there. A slack cable starts in static equilibrium between its
    /// clamps, under its weight. A part with a free end turns with its clamp, without stress.
    pub fn clamp(mut self, at: impl Into<At>) -> Self {
        self.holds.push((at.into(), Hold::Clamp(None)));
        self
    }

    /// As [`clamp`](Self::clamp), with the tangent along `direction` (any length), towards growing
    /// arc length.
    pub fn clamp_along(mut self, at: impl Into<At>, direction: impl Into<Point>) -> Self {
        self.holds.push((at.into(), Hold::Clamp(Some(direction.into().0))));
        self
    }

    /// Adds a point load.
    pub fn load(mut self, load: PointLoad) -> Self {
        self.loads.push(load);
        self
    }

    /// Effects beside inertia and elasticity. Default: none.
    pub fn effects(mut self, effects: Effects) -> Self {
        self.effects = effects;
        self
    }

    /// Internal damping: the shorthand for its field of [`Effects`].
    pub fn damping(mut self, damping: Damping) -> Self {
        self.effects.damping = Some(damping);
        self.damped_as = None;
        self
    }

    /// Internal damping of a kind of rope: its percent of critical at the lowest axial mode of the
    /// cable, and at bending in ten half waves; see [`RopeKind`]. Default: no damping.
    pub fn damped_as(mut self, kind: RopeKind) -> Self {
        self.damped_as = Some(kind);
        self
    }

    /// Adds a force per length of your own.
    pub fn force_density(mut self, force: Arc<dyn ForceDensity>) -> Self {
        self.force_densities.attach(force, 0.0);
        self
    }

    /// Builds the cable.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a number that is out of range or not finite;
    /// [`Error::TooFewPoints`], [`Error::CoincidentPoints`], [`Error::ElementCount`] or
    /// [`Error::NoSection`] for what is missing; [`Error::RankDeficient`] for a rule with spare
    /// modes; [`Error::OutOfRange`] for an arc length that is not on the cable,
    /// [`Error::NodeBeforeMesh`] for a node number; and as [`Cable::set_effects`].
    pub fn build(self) -> Result<Cable, Error> {
        let name = self.name.clone();
        self.build_named().map_err(|error| error.of_cable(&name))
    }

    fn build_named(mut self) -> Result<Cable, Error> {
        let cable = || self.name.clone();
        self.points.iter().try_for_each(|p| require_finite("point (m)", p))?;
        require_finite("gravity (m/s^2)", &self.gravity)?;
        if self.points.len() < 2 {
            return Err(Error::TooFewPoints { cable: cable(), count: self.points.len() });
        }
        if let Some(index) = self.points.windows(2).position(|p| p[0] == p[1]) {
            return Err(Error::CoincidentPoints { cable: cable(), index, point: self.points[index] });
        }
        if !(1..=MAX_ELEMENTS).contains(&self.elements) {
            return Err(Error::ElementCount { cable: cable(), count: self.elements, most: MAX_ELEMENTS });
        }
        let drawn: f64 = self.points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
        if let Some(span) = self.span {
            require(
                "sag (m) of a cable without gravity",
                0.0,
                self.gravity != Vector3::zeros() || !span.is_sag(),
                "none",
            )?;
            let ends = [self.points[0], self.points[self.points.len() - 1]];
            self.length = Some(span.length(drawn, &ends, |length| self.hanging(length))?);
        }
        let length = self.length.unwrap_or(drawn);
        require("unstretched length (m)", length, length > 0.0, "> 0")?;
        require("length of the polyline (m)", drawn, drawn > 0.0, "> 0")?;
        let rule = self.rule.unwrap_or_else(|| self.integrator.unwrap_or_default().rule());
        rule.check_points()?;
        if !self.allow_rank_deficient {
            rule.check()?;
        }
        let mut sections = self.sections.clone();
        sections.sort_by(|a, b| a.0.total_cmp(&b.0));
        if sections.first().is_none_or(|(from, _)| *from > 0.0) {
            return Err(Error::NoSection { cable: cable() });
        }
        let arc_length = |at: At| match at {
            At::Start | At::Node(0) => Ok(0.0),
            At::End => Ok(length),
            At::ArcLength(s) => Ok(grading::on_length(s, length).unwrap_or(s)),
            At::Node(node) => Err(Error::NodeBeforeMesh { cable: cable(), node }),
        };
        let mut breaks = vec![0.0, length];
        breaks.extend(sections.iter().map(|(from, _)| *from));
        breaks.extend(&self.nodes_at);
        for (at, _) in &self.holds {
            breaks.push(arc_length(*at)?);
        }
        let grading = match &self.grading {
            None => None,
            Some((finest, at)) => {
                let points = at.iter().map(|at| arc_length(*at)).collect::<Result<Vec<f64>, Error>>()?;
                breaks.extend(&points);
                Some(Grading { finest: *finest, points })
            }
        };
        for s in breaks.iter_mut().chain(self.loads.iter_mut().map(|load| &mut load.arc_length)) {
            *s = grading::on_length(*s, length).ok_or_else(|| Error::OutOfRange {
                cable: self.name.clone(),
                what: "arc length",
                value: *s,
                limit: length,
            })?;
        }
        let s = grading::nodes(&mut breaks, length, self.elements, grading.as_ref())?;
        let elements: Vec<Element> = s
            .windows(2)
            .map(|ends| {
                let middle = 0.5 * (ends[0] + ends[1]);
                let k = sections.partition_point(|(from, _)| *from <= middle);
                Element { length: ends[1] - ends[0], section: sections[k - 1].1 }
            })
            .collect();
        if let Some(kind) = self.damped_as {
            let damping = kind.damping_of(&elements);
            let limp = rule.bending == BendingRule::None;
            self.effects.damping = Some(if limp { Damping { bending: 0.0, ..damping } } else { damping });
        }
        if sections.iter().all(|(_, section)| section.is_rope()) && self.effects.axial_law.is_none() {
            self.effects.axial_law = AxialLaw::of_rope(&self.effects, rule);
        }
        let mut laid = layout::along_polyline(&self.points, &s, Sag::along(self.gravity));
        let kept = self.kept(&s, arc_length)?;
        if self.points.len() > 2 {
            unstrain(&mut laid, &s, &kept, drawn / length);
        }
        let mut snapshot = Snapshot::default();
        for node in &laid {
            snapshot.state.q.extend(node.position.iter().chain(node.slope.iter()));
        }
        snapshot.state.v.resize(snapshot.state.q.len(), 0.0);
        let drawn_ends = self.drawn_ends(&laid, &s, drawn);
        let model = Model {
            name: self.name.clone(),
            elements,
            rule,
            gravity: self.gravity,
            supports: Vec::new(),
            loads: Vec::new(),
            load_origins: Vec::new(),
            effects: self.effects,
            force_densities: self.force_densities,
            potentials: Potentials::default(),
            obstacles: Obstacles::default(),
            contact_key: 0,
            strength: Default::default(),
            reels: Reels::default(),
            corners: laid.iter().filter_map(Corner::of).collect(),
            drawn: drawn_ends,
            drawn_length: Some(drawn),
            least_damping: 0.0,
        };
        let default = if model.effects.need_discrete_gradient() { Fidelity::Game } else { Fidelity::default() };
        let mut cable = Cable::from_parts(model, snapshot, default.integrator(f64::INFINITY))?;
        let slack = !cable.model.drawn.is_empty();
        let mut turned = Vec::new();
        for (at, hold) in self.holds {
            let node = cable.node(At::ArcLength(arc_length(at)?.min(length)))?;
            let slope = match hold {
                Hold::Pin => SlopeSupport::Free,
                Hold::Clamp(given) => {
                    let direction = match given {
                        Some(given) => unit(given)?,
                        None if slack => layout::directions(&self.points, &s)[node],
                        None => laid[node].slope.normalize(),
                    };
                    if is_turned(&laid[node].slope, &direction) {
                        turned.push((node, laid[node].slope));
                    }
                    SlopeSupport::Direction(direction)
                }
            };
            cable.set_support(
                At::Node(node),
                Support { position: Some(Motion::fixed(laid[node].position)), slope, attached: false },
            )?;
        }
        if !turned.is_empty() {
            cable.bend_to_clamps(&turned)?;
        } else if slack && !kept.iter().any(|kept| kept.slope) {
            let laid = cable.positions().to_vec();
            cable.sagging = Some(Box::new(Sagging { points: self.points, kept, laid }));
        }
        cable.set_rigid_motion(self.velocity, self.angular_velocity)?;
        for load in self.loads {
            cable.add_load(load)?;
        }
        cable.set_integrator(cable.integrator_for(self.integrator.unwrap_or(default)))?;
        cable.default_integrator = self.integrator.is_none();
        Ok(cable)
    }
}

impl CableBuilder {
    /// Builds the cable with a length in m, held at its ends, and lets it hang under its weight and
    /// constant loads.
    fn hanging(&self, length: f64) -> Result<Cable, Error> {
        let builder = CableBuilder { length: Some(length), span: None, ..self.clone() };
        let mut cable = builder.build()?.under_weight()?;
        for at in [At::Start, At::End] {
            if cable.support(at)?.position.is_none() {
                cable.fix(at)?;
            }
        }
        cable.equilibrium()?;
        Ok(cable)
    }

    /// Returns what of the nodes at arc lengths `s` (m) stays as drawn: ends, and nodes that are
    /// held or asked for.
    fn kept(&self, s: &[f64], arc_length: impl Fn(At) -> Result<f64, Error>) -> Result<Vec<Kept>, Error> {
        let length = s[s.len() - 1];
        let mut kept = vec![Kept::default(); s.len()];
        let near = |at: f64| s.partition_point(|&s| s < at - 1e-9 * length).min(s.len() - 1);
        for &at in [0.0, length].iter().chain(&self.nodes_at) {
            kept[near(at)].position = true;
        }
        for (at, hold) in &self.holds {
            let kept = &mut kept[near(arc_length(*at)?)];
            kept.position = true;
            kept.slope |= matches!(hold, Hold::Clamp(_));
        }
        Ok(kept)
    }

    /// Returns the ends of a cable longer than drawn, of which `drawn` m are drawn; none if it is
    /// not.
    fn drawn_ends(&self, laid: &[Laid], s: &[f64], drawn: f64) -> Vec<Drawn> {
        let last = s.len() - 1;
        if s[last] <= drawn * (1.0 + SLACK) {
            return Vec::new();
        }
        let directions = layout::directions(&self.points, s);
        let end = |k: usize| Drawn { position: laid[k].position, slope: laid[k].slope, direction: directions[k] };
        [0, last].map(end).to_vec()
    }
}
