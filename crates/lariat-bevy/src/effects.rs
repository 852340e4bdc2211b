//! Effects as components: an effect acts on a cable while its component is there, and costs nothing
//! while it is not.
//!
//! A change of these components takes effect in the next host step. The components of the effects
//! in [`for_each_effect`](lariat_ancf::for_each_effect) are generated from that list, each a
//! newtype of the mechanics' parameters; [`Damping`] alone is written by hand, because a share of
//! critical damping depends on the cable. [`Rule`], [`Bending`] and [`PointLoads`] are no effects
//! of the list.

use crate::pending::Pending;
use bevy_ecs::component::Component;
use bevy_ecs::lifecycle::HookContext;
#[cfg(feature = "reflect")]
use bevy_ecs::reflect::ReflectComponent;
use bevy_ecs::world::DeferredWorld;
#[cfg(feature = "reflect")]
use bevy_reflect::prelude::*;
use core::f64::consts::PI;
use lariat_ancf::{BendingRule, Flow, LineLoad, Point, PointLoad, RestPiece, Section, Vector3};
use serde::{Deserialize, Serialize};

/// Share of critical damping above which it is said: the slower of both times of an overdamped mode
/// is then four times that of its oscillation.
const MOST_FRACTION: f64 = 2.0;

/// A component that adds an effect of the mechanics to a cable.
pub(crate) trait EffectComponent: Component + Clone + PartialEq {
    /// The parameters in the mechanics.
    type Effect: lariat_ancf::effect::Effect;

    /// Returns the effect on a cable of this section and unstretched length (m).
    fn resolve(&self, section: &Section, length: f64) -> Result<Self::Effect, lariat_ancf::Error>;

    /// Returns the component of a part of a cable that broke, on which the effect has become
    /// `effect`.
    fn of_part(&self, effect: &Self::Effect) -> Self;
}

/// Rule for the elastic forces; see [`lariat_ancf::Rule`]. Without it a cable has that of its [fidelity](lariat_ancf::Fidelity::rule),
/// `projected-T1` for `game`.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[component(on_remove = note_removal)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct Rule(pub lariat_ancf::Rule);

impl Rule {
    /// Projected axial strain, bending by three Gauss points: the default.
    pub const PROJECTED_3: Rule =
        Rule(lariat_ancf::Rule::new(lariat_ancf::AxialRule::Projected, BendingRule::Gauss(3)));
    /// Five Gauss points for the axial energy and three for bending.
    pub const G5_3: Rule = Rule(lariat_ancf::Rule::new(lariat_ancf::AxialRule::Gauss(5), BendingRule::Gauss(3)));
    /// ST2 of the paper.
    pub const ST2: Rule = Rule(lariat_ancf::Rule::ST2);
    /// L2T2 of the paper.
    pub const L2T2: Rule = Rule(lariat_ancf::Rule::L2T2);
}

/// Bending stiffness, by the bending half of the [`Rule`]. Without it the cable has none, and no
/// bending code runs.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[component(on_remove = note_removal)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct Bending;

/// Forces and moments at points; see [`PointLoad`]. A ramp begins when the load is added.
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[component(on_remove = note_removal)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct PointLoads(pub Vec<PointLoad>);

/// Internal damping (Kelvin-Voigt); see [`lariat_ancf::Damping`]. On a cable without [`Bending`] it
/// acts on the axial strain alone.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[component(on_remove = note_removal)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub enum Damping {
    /// Damping times in s of axial strain and curvature.
    Times(lariat_ancf::Damping),
    /// Share of critical damping for the first axial mode of the cable with one end fixed.
    CriticalFraction(f64),
}

impl Damping {
    /// The same damping time in s for strain and curvature.
    pub fn time(time: f64) -> Self {
        Damping::Times(lariat_ancf::Damping { axial: time, bending: time })
    }

    /// Share of critical damping for the first axial mode of the cable with one end fixed, omega =
    /// pi/(2 L) sqrt(EA/(rho A)). The damping ratio of other modes is proportional to their
    /// frequency: higher for vibrations within the cable, lower for a heavy load that bounces on
    /// it.
    pub fn critical_fraction(fraction: f64) -> Self {
        Damping::CriticalFraction(fraction)
    }
}

impl EffectComponent for Damping {
    type Effect = lariat_ancf::Damping;

    fn resolve(&self, section: &Section, length: f64) -> Result<lariat_ancf::Damping, lariat_ancf::Error> {
        match *self {
            Damping::Times(times) => Ok(times),
            Damping::CriticalFraction(fraction) => {
                if fraction > MOST_FRACTION {
                    log::warn!(
                        "`Damping::critical_fraction` is {fraction}: it is a share, 1 is critical damping; with more than {MOST_FRACTION} a cable creeps, was a percentage meant?"
                    );
                }
                let wave = (section.axial_stiffness / section.mass_per_length).sqrt();
                lariat_ancf::Damping::from_ratio(fraction, 0.5 * PI * wave / length)
            }
        }
    }

    fn of_part(&self, effect: &lariat_ancf::Damping) -> Self {
        match *self {
            Damping::Times(times) => Damping::Times(times),
            // of the material as it was, not of a cable of the part's length
            Damping::CriticalFraction(_) => Damping::time(effect.axial),
        }
    }
}

/// Generates a component for every effect of the list but damping.
macro_rules! newtypes {
    () => {};
    ({ field: damping, $($entry:tt)* } $($others:tt)*) => { newtypes!($($others)*); };
    ({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal }
     $($others:tt)*) => {
        #[doc = $summary]
        #[doc = concat!("\n\nParameters and theory: [`lariat_ancf::", stringify!($type), "`].")]
        #[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[component(on_remove = note_removal)]
        #[cfg_attr(
            feature = "reflect",
            derive(bevy_reflect::Reflect),
            reflect(opaque, Component, Clone, Serialize, Deserialize)
        )]
        pub struct $type(pub lariat_ancf::$type);

        impl From<lariat_ancf::$type> for $type {
            fn from(effect: lariat_ancf::$type) -> Self {
                $type(effect)
            }
        }

        impl EffectComponent for $type {
            type Effect = lariat_ancf::$type;

            fn resolve(&self, _: &Section, _: f64) -> Result<lariat_ancf::$type, lariat_ancf::Error> {
                Ok(self.0.clone())
            }

            fn of_part(&self, effect: &lariat_ancf::$type) -> Self {
                $type(effect.clone())
            }
        }

        newtypes!($($others)*);
    };
}
lariat_ancf::for_each_effect!(newtypes);

impl Drag {
    /// Air at rest: 1.2 kg/m^3, normal coefficient 1.2, tangential 0.01.
    pub fn air() -> Self {
        Drag(lariat_ancf::Drag::new(1.2, 1.2, 0.01, Flow::default()))
    }

    /// Fresh water at rest: 1000 kg/m^3, normal coefficient 1.2, tangential 0.01.
    pub fn water() -> Self {
        Drag(lariat_ancf::Drag::new(1000.0, 1.2, 0.01, Flow::default()))
    }

    /// Sets the velocity of the fluid in m/s, uniform in space.
    pub fn flowing(mut self, velocity: impl Into<Point>) -> Self {
        self.0.flow = Flow::uniform(velocity.into().0);
        self
    }
}

impl Buoyancy {
    /// Fresh water: 1000 kg/m^3, coefficient of added mass 1.
    pub fn water() -> Self {
        Buoyancy(lariat_ancf::Buoyancy::new(1000.0, 1.0))
    }
}

impl Contact {
    /// Contact with the bodies, with this coefficient of friction.
    pub fn with_friction(friction: f64) -> Self {
        Contact(lariat_ancf::Contact::with_friction(friction))
    }

    /// With this coefficient of restitution, which is combined with that of what it touches.
    pub fn with_restitution(self, restitution: f64) -> Self {
        Contact(self.0.with_restitution(restitution))
    }

    /// Contact with other cables that have it and with itself, too.
    pub fn with_cables(self) -> Self {
        Contact(self.0.with_cables())
    }
}

impl AxialLaw {
    /// EA times the Green strain, as without a law: where that is meant.
    pub fn green() -> Self {
        AxialLaw(lariat_ancf::AxialLaw::Green)
    }

    /// EA times the engineering strain.
    pub fn hooke() -> Self {
        AxialLaw(lariat_ancf::AxialLaw::Hooke)
    }

    /// EA times the engineering strain in tension, nothing in compression.
    pub fn rope() -> Self {
        AxialLaw(lariat_ancf::AxialLaw::Rope)
    }

    /// A measured curve: rows of strain and force in N, as [`lariat_ancf::AxialLaw::Curve`].
    pub fn curve(rows: impl IntoIterator<Item = [f64; 2]>) -> Self {
        AxialLaw(lariat_ancf::AxialLaw::Curve(rows.into_iter().collect()))
    }
}

impl GravityScale {
    /// Multiplies gravity by `factor`.
    pub fn new(factor: f64) -> Self {
        GravityScale(lariat_ancf::GravityScale(factor))
    }
}

impl LineLoads {
    /// A force per length in N/m on the whole cable, world axes.
    pub fn uniform(force: impl Into<Point>) -> Self {
        LineLoads(LineLoad::uniform(force.into().0).into())
    }
}

impl From<Vec<LineLoad>> for LineLoads {
    fn from(loads: Vec<LineLoad>) -> Self {
        LineLoads(lariat_ancf::LineLoads(loads))
    }
}

impl From<Vec<RestPiece>> for RestShape {
    fn from(pieces: Vec<RestPiece>) -> Self {
        RestShape(lariat_ancf::RestShape { pieces })
    }
}

impl PointLoads {
    /// A force in N, world axes, at an arc length in m.
    pub fn force(arc_length: f64, force: impl Into<Point>) -> Self {
        let force: Vector3<f64> = force.into().0;
        PointLoads(vec![PointLoad::force(arc_length, force)])
    }
}

/// Marks a cable for update when one of its effects is removed.
fn note_removal(mut world: DeferredWorld, context: HookContext) {
    if let Some(mut pending) = world.get_resource_mut::<Pending>() {
        pending.changed_effects.insert(context.entity);
    }
}
