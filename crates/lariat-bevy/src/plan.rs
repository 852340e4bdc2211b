//! What a cable entity is spawned with: the description from which its mechanics are built.

use lariat_ancf::{Effects, Error, IntegratorChoice, Rule, Section, Vector3};

/// Description of a cable that is to be built.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub section: Result<Section, Error>,
    pub points: Vec<Vector3<f64>>,
    pub length: Option<f64>,
    pub elements: usize,
    pub hanging: bool,
    pub integrator: IntegratorChoice,
    pub gravity: Option<Vector3<f64>>,
    pub velocity: Vector3<f64>,
}

impl Plan {
    pub fn new(section: Result<Section, Error>) -> Self {
        Plan {
            section,
            points: Vec::new(),
            length: None,
            elements: 10,
            hanging: false,
            integrator: IntegratorChoice::default(),
            gravity: None,
            velocity: Vector3::zeros(),
        }
    }

    /// The cable without damping, which needs the cable to know its frequencies.
    pub fn build(&self, name: &str, rule: Rule, effects: &Effects) -> Result<lariat_ancf::Cable, Error> {
        let mut builder = lariat_ancf::Cable::builder()
            .name(name)
            .points(self.points.iter().copied())
            .section(self.section.clone()?)
            .elements(self.elements)
            .rule(rule)
            .effects(effects.clone())
            .velocity(self.velocity)
            .integrator(self.integrator);
        if let Some(length) = self.length {
            builder = builder.length(length);
        }
        if let Some(gravity) = self.gravity {
            builder = builder.gravity(gravity);
        }
        if !self.hanging {
            return builder.build();
        }
        use lariat_ancf::At;
        let mut cable = builder.fix(At::Start).fix(At::End).build()?;
        cable.equilibrium()?;
        cable.release(At::Start)?;
        cable.release(At::End)?;
        Ok(cable)
    }
}
