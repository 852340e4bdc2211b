//! The description that a cable is built from.

use crate::saved::reason;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{At, Effects, Error, Fidelity, Integrator, PointLoad, Rule, Section, Vector3};
use serde::{Deserialize, Serialize};

/// What fixes the length of a cable that hangs between its drawn ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Span {
    /// Tension at the middle in N.
    Tension(f64),
    /// Distance below the line between the ends in m.
    Sag(f64),
}

/// The geometry, section and integrator of a cable; rule, effects and loads are components beside
/// it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Description {
    #[serde(with = "reason")]
    pub section: Result<Section, Error>,
    /// Whether it cannot push, whatever the section.
    #[serde(default)]
    pub rope: bool,
    /// Points of the initial shape in m.
    pub points: Vec<Vector3<f64>>,
    /// Unstretched length in m; `None`: that of the initial shape.
    pub length: Option<f64>,
    /// What fixes the length instead.
    pub span: Option<Span>,
    pub elements: usize,
    /// Length in m of the finest elements, and the points where they are.
    #[serde(default)]
    pub finest: Option<(f64, Vec<At>)>,
    /// Arc lengths in m of nodes.
    pub nodes_at: Vec<f64>,
    /// Whether it starts in static equilibrium between its ends.
    pub hanging: bool,
    pub integrator: Fidelity,
    /// In m/s^2; `None`: that of the world.
    pub gravity: Option<Vector3<f64>>,
    /// Initial velocity in m/s.
    pub velocity: Vector3<f64>,
}

impl Description {
    pub fn new(section: Result<Section, Error>) -> Self {
        Description {
            section,
            rope: false,
            points: Vec::new(),
            length: None,
            span: None,
            elements: 10,
            finest: None,
            nodes_at: Vec::new(),
            hanging: false,
            integrator: Fidelity::Game,
            gravity: None,
            velocity: Vector3::zeros(),
        }
    }

    /// Returns the unstretched length in m, whether or not a cable of it can be built.
    pub fn unstretched_length(&self) -> f64 {
        self.length.unwrap_or_else(|| self.points.windows(2).map(|p| (p[1] - p[0]).norm()).sum())
    }

    /// Builds the cable.
    pub fn build(
        &self,
        name: &str,
        rule: Rule,
        effects: Effects,
        loads: &[PointLoad],
    ) -> Result<lariat_ancf::Cable, Error> {
        let mut builder = lariat_ancf::Cable::builder()
            .name(name)
            .points(self.points.iter().copied())
            .section(self.section.clone()?)
            .elements(self.elements)
            .rule(rule)
            .effects(effects)
            .velocity(self.velocity)
            .integrator(self.integrator);
        builder = match self.span {
            Some(Span::Tension(tension)) => builder.pretension(tension),
            Some(Span::Sag(sag)) => builder.sag(sag),
            None => builder,
        };
        if let Some(length) = self.length {
            builder = builder.length(length);
        }
        builder = self.nodes_at.iter().fold(builder, |builder, &s| builder.node_at(s));
        if let Some((length, at)) = &self.finest {
            builder = builder.finest(*length, at.iter().copied());
        }
        if let Some(gravity) = self.gravity {
            builder = builder.gravity(gravity);
        }
        let mut cable = if self.hanging {
            let mut cable = builder.fix(At::Start).fix(At::End).build()?;
            cable.equilibrium()?;
            cable.release(At::Start)?;
            cable.release(At::End)?;
            cable
        } else {
            builder.build()?
        };
        loads.iter().try_for_each(|load| cable.add_load(load.clone()))?;
        Ok(cable)
    }

    /// Returns the integrator of a cable that is given other effects: the described one, unless the
    /// user has set another since the cable was built.
    pub fn integrator_for(&self, cable: &lariat_ancf::Cable, effects: &Effects) -> Integrator {
        // internal damping needs an implicit method, however low the frequencies of the cable
        let choice = |effects: &Effects| {
            if self.integrator == Fidelity::Engineering && effects.need_discrete_gradient() {
                return Integrator::COUPLED;
            }
            let implicit = effects.needs_implicit_integrator();
            self.integrator.integrator(if implicit { f64::INFINITY } else { cable.frequency_bound() })
        };
        let untouched = cable.integrator() == choice(cable.effects());
        if untouched { choice(effects) } else { cable.integrator() }
    }
}
