//! The usual rope between two points, in one call.

use crate::handle::{AttachmentHandle, CableHandle};
use crate::scales::set::ROPE_DAMPING;
use lariat_ancf::{At, AxialLaw, Cable, Damping, Effects, Fidelity, Point, RopeMaterial, Section, Vector3};
use rapier::math::Vector;

/// What a rope is made of, how slack it is, and what it bears: the description of the usual rope,
/// with bending stiffness and a damping ratio of [`ROPE_DAMPING`]. See
/// [`CableSet::add_rope`](crate::CableSet::add_rope).
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Name in errors and reports. Default "rope".
    pub name: String,
    /// Cross-section, or why there is none.
    pub section: Result<Section, lariat_ancf::Error>,
    /// Unstretched length beyond the distance of the ends, as a share of that distance. Default 0:
    /// straight and without tension.
    pub slack: f64,
    /// Unstretched length in m, whatever the distance of the ends and the slack: shorter than the
    /// distance, it begins taut. Default: by the slack.
    pub unstretched_length: Option<f64>,
    /// Tension in N above which it breaks. Default: it does not break.
    pub strength: Option<f64>,
    /// Number of elements. Default: that of [`Fidelity::Game`].
    pub elements: usize,
    /// Accuracy against cost. Default: that of the set.
    pub fidelity: Option<Fidelity>,
}

impl Rope {
    /// A rope of this section. It cannot push, whatever the section: its axial law is
    /// [`AxialLaw::Rope`](lariat_ancf::AxialLaw::Rope).
    pub fn new(section: Section) -> Self {
        Self::of(Ok(section))
    }

    /// A steel wire rope of this diameter (m): [`Section::wire_rope`].
    pub fn steel(diameter: f64) -> Self {
        Self::of(Section::wire_rope(diameter))
    }

    /// A rope or chain of this material and nominal diameter (m): [`RopeMaterial::section`].
    pub fn named(material: RopeMaterial, diameter: f64) -> Self {
        Self::of(material.section(diameter))
    }

    fn of(section: Result<Section, lariat_ancf::Error>) -> Self {
        Rope {
            name: "rope".to_string(),
            section,
            slack: 0.0,
            unstretched_length: None,
            strength: None,
            elements: Fidelity::Game.elements(),
            fidelity: None,
        }
    }

    /// Sets the name.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Sets the unstretched length beyond the distance of the ends, as a share of that distance.
    pub fn slack(mut self, slack: f64) -> Self {
        self.slack = slack;
        self
    }

    /// Sets the unstretched length in m, in place of a slack.
    pub fn unstretched_length(mut self, length: f64) -> Self {
        self.unstretched_length = Some(length);
        self
    }

    /// Sets the tension in N above which it breaks.
    pub fn strength(mut self, strength: f64) -> Self {
        self.strength = Some(strength);
        self
    }

    /// Sets the number of elements.
    pub fn elements(mut self, elements: usize) -> Self {
        self.elements = elements;
        self
    }

    /// Sets accuracy against cost.
    pub fn fidelity(mut self, fidelity: Fidelity) -> Self {
        self.fidelity = Some(fidelity);
        self
    }

    /// Returns its unstretched length in m between two points.
    pub fn length(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
        self.unstretched_length.unwrap_or_else(|| (to - from).norm() * (1.0 + self.slack))
    }

    /// Builds its cable, fixed where no body holds it; `fidelity` is that of the set, whose rule it
    /// has if it has no fidelity of its own.
    pub(crate) fn build<B>(
        &self,
        [from, to]: &[RopeEnd<B>; 2],
        fidelity: Fidelity,
    ) -> Result<Cable, lariat_ancf::Error> {
        let length = self.length(&from.point, &to.point);
        let section = self.section.clone()?;
        let wave_speed = (section.axial_stiffness / section.mass_per_length).sqrt();
        let mut builder = Cable::builder()
            .name(self.name.as_str())
            .points([from.point, to.point])
            .length(length)
            .section(section)
            .elements(self.elements);
        let rule = self.fidelity.unwrap_or(fidelity).rule();
        builder = match self.fidelity {
            Some(own) => builder.fidelity(own),
            None => builder.rule(rule),
        };
        let axial_law = AxialLaw::of_rope(&Effects::default(), rule);
        builder = builder.effects(Effects { axial_law, ..Effects::default() });
        if length > 0.0 {
            // a length that is not positive is an error of the builder
            let first_mode = core::f64::consts::FRAC_PI_2 * wave_speed / length;
            builder = builder.damping(Damping::from_ratio(ROPE_DAMPING, first_mode)?);
        }
        for (at, end) in [(At::Start, from), (At::End, to)] {
            if end.body.is_none() {
                builder = builder.fix(at);
            }
        }
        let mut cable = builder.build()?;
        cable.set_strength(self.strength)?;
        Ok(cable)
    }
}

/// An end of a rope: a point of the world in m, and the body that holds it there; without one the
/// world holds it. From a point, or from a body and a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeEnd<B> {
    /// Where the rope ends, in m, in world axes.
    pub point: Vector3<f64>,
    /// What holds it there; `None` for the world.
    pub body: Option<B>,
}

macro_rules! rope_ends {
    ($($point:ty),*) => {$(
        impl<B> From<$point> for RopeEnd<B> {
            fn from(point: $point) -> Self {
                RopeEnd { point: Point::from(point).0, body: None }
            }
        }

        impl<B> From<(B, $point)> for RopeEnd<B> {
            fn from((body, point): (B, $point)) -> Self {
                RopeEnd { point: Point::from(point).0, body: Some(body) }
            }
        }
    )*};
}
rope_ends!([f64; 3], [f32; 3], Vector3<f64>, Vector, Point);

/// The handles of a rope that was added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct RopeHandles {
    /// The cable.
    pub cable: CableHandle,
    /// The attachment of its start; `None` if the world holds it.
    pub start: Option<AttachmentHandle>,
    /// The attachment of its end; `None` if the world holds it.
    pub end: Option<AttachmentHandle>,
}
