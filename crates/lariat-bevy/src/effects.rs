//! Effects as components: present = on, absent = no work at all.
//!
//! What an entity has beside its [`Cable`](crate::Cable) is compared with what the cable does when one of these components was added,
//! changed or removed; a difference takes effect on the next step.

use crate::plan::Plan;
use crate::point::Point;
use crate::prepare::ChangedEffects;
use bevy_ecs::component::Component;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::name::Name;
#[cfg(feature = "reflect")]
use bevy_ecs::reflect::ReflectComponent;
use bevy_ecs::world::{DeferredWorld, EntityRef};
#[cfg(feature = "reflect")]
use bevy_reflect::prelude::*;
use core::f64::consts::PI;
use lariat_ancf::{BendingRule, Effects, Fidelity, Flow, IntegratorChoice, LineLoad, PointLoad, RestPiece};
use serde::{Deserialize, Serialize};

/// Force strategy; see [`lariat_ancf::Rule`]. Absent: `projected-3`.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct Rule(pub lariat_ancf::Rule);

impl Rule {
    /// Projected strain, bending by three Gauss points: the default.
    pub const PROJECTED_3: Rule =
        Rule(lariat_ancf::Rule::new(lariat_ancf::AxialRule::Projected, BendingRule::Gauss(3)));
    /// Gauss quadrature with five points for the axial energy and three for bending.
    pub const G5_3: Rule = Rule(lariat_ancf::Rule::new(lariat_ancf::AxialRule::Gauss(5), BendingRule::Gauss(3)));
    /// The paper's ST2.
    pub const ST2: Rule = Rule(lariat_ancf::Rule::ST2);
    /// The paper's L2T2.
    pub const L2T2: Rule = Rule(lariat_ancf::Rule::L2T2);
}

/// Bending stiffness, by the bending half of the [`Rule`]. Absent: the cable is limp, and no bending code runs.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct Bending;

/// Internal damping after Kelvin and Voigt; see [`lariat_ancf::Damping`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub enum Damping {
    /// Times in s of the axial strain and of the curvature.
    Times(lariat_ancf::Damping),
    /// This share of critical damping for the first axial mode of the cable with one end held.
    CriticalFraction(f64),
}

impl Damping {
    /// Time in s of strain and curvature alike.
    pub fn time(time: f64) -> Self {
        Damping::Times(lariat_ancf::Damping { axial: time, bending: time })
    }

    /// This share of critical damping for the first axial mode of the cable with one end held, omega = pi/(2 L) sqrt(EA/(rho A)); faster
    /// vibrations are damped more, slower ones (a load that bounces on the cable) less, in proportion to their frequency.
    pub fn critical_fraction(fraction: f64) -> Self {
        Damping::CriticalFraction(fraction)
    }

    fn resolve(self, plan: &Plan, length: f64) -> Result<lariat_ancf::Damping, lariat_ancf::Error> {
        match self {
            Damping::Times(times) => Ok(times),
            Damping::CriticalFraction(fraction) => {
                let section = plan.section.clone()?;
                let wave = (section.axial_stiffness / section.mass_per_length).sqrt();
                lariat_ancf::Damping::from_ratio(fraction, 0.5 * PI * wave / length)
            }
        }
    }
}

/// Drag of a fluid or wind; see [`lariat_ancf::Drag`].
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct Drag(pub lariat_ancf::Drag);

impl Drag {
    /// Air at rest: 1.2 kg/m^3, normal coefficient 1.2, tangential 0.01.
    pub fn air() -> Self {
        Drag(lariat_ancf::Drag::new(1.2, 1.2, 0.01, Flow::default()))
    }

    /// Fresh water at rest: 1000 kg/m^3, normal coefficient 1.2, tangential 0.01.
    pub fn water() -> Self {
        Drag(lariat_ancf::Drag::new(1000.0, 1.2, 0.01, Flow::default()))
    }

    /// The fluid moves with this velocity in m/s.
    pub fn flowing(mut self, velocity: impl Into<Point>) -> Self {
        self.0.flow = Flow::uniform(velocity.into().0);
        self
    }
}

/// Buoyancy and added mass; see [`lariat_ancf::Buoyancy`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct Buoyancy(pub lariat_ancf::Buoyancy);

impl Buoyancy {
    /// Fresh water: 1000 kg/m^3, coefficient of added mass 1.
    pub fn water() -> Self {
        Buoyancy(lariat_ancf::Buoyancy::new(1000.0, 1.0))
    }
}

/// Stress-free stretch and curvature; see [`lariat_ancf::RestShape`]. Absent: straight and unstretched.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct RestShape(pub lariat_ancf::RestShape);

impl From<Vec<RestPiece>> for RestShape {
    fn from(pieces: Vec<RestPiece>) -> Self {
        RestShape(lariat_ancf::RestShape { pieces })
    }
}

/// Forces per length; see [`LineLoad`].
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct LineLoads(pub Vec<LineLoad>);

/// Forces and moments at points; see [`PointLoad`]. A ramp begins when the load is new to the cable.
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct PointLoads(pub Vec<PointLoad>);

/// What gravity is multiplied by for this cable.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[component(on_remove = removed)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(opaque, Component, Clone, Serialize, Deserialize)
)]
pub struct GravityScale(pub f64);

/// What the components of an entity ask of its cable.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wanted {
    pub name: Option<String>,
    pub rule: lariat_ancf::Rule,
    pub effects: Effects,
    pub damping: Option<Damping>,
    pub loads: Vec<PointLoad>,
}

impl Wanted {
    pub fn of(entity: EntityRef) -> Self {
        let mut rule = entity.get::<Rule>().copied().unwrap_or_default().0;
        if !entity.contains::<Bending>() {
            rule.bending = BendingRule::None;
        }
        let effects = Effects {
            damping: None,
            drag: entity.get::<Drag>().map(|e| e.0.clone()),
            buoyancy: entity.get::<Buoyancy>().map(|e| e.0),
            rest_shape: entity.get::<RestShape>().map(|e| e.0.clone()),
            line_loads: entity.get::<LineLoads>().map(|e| lariat_ancf::LineLoads(e.0.clone())),
            gravity_scale: entity.get::<GravityScale>().map(|e| lariat_ancf::GravityScale(e.0)),
        };
        Wanted {
            name: entity.get::<Name>().map(|name| name.as_str().to_string()),
            rule,
            effects,
            damping: entity.get::<Damping>().copied(),
            loads: entity.get::<PointLoads>().map(|e| e.0.clone()).unwrap_or_default(),
        }
    }

    /// Effects with the damping that a cable of this length has.
    fn effects(&self, plan: &Plan, length: f64) -> Result<Effects, lariat_ancf::Error> {
        let damping = self.damping.map(|d| d.resolve(plan, length)).transpose()?;
        Ok(Effects { damping, ..self.effects.clone() })
    }
}

/// Builds a cable with its effects.
pub(crate) fn build(plan: &Plan, wanted: &Wanted) -> Result<lariat_ancf::Cable, lariat_ancf::Error> {
    let drawn: f64 = plan.points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    let effects = match wanted.damping {
        // a length that is none is refused by the builder
        Some(_) if plan.length.unwrap_or(drawn) > 0.0 => wanted.effects(plan, plan.length.unwrap_or(drawn))?,
        _ => wanted.effects.clone(),
    };
    let mut cable = plan.build(wanted.name.as_deref().unwrap_or("cable"), wanted.rule, &effects)?;
    wanted.loads.iter().try_for_each(|load| cable.add_load(*load))?;
    Ok(cable)
}

/// Makes a cable do what is wanted of it; touches it only where it does something else.
pub(crate) fn update(cable: &mut crate::Cable, wanted: &Wanted) -> Result<(), lariat_ancf::Error> {
    let plan = cable.plan.clone();
    let Ok(core) = cable.core() else { return Ok(()) };
    let (rule, effects) = (core.rule(), wanted.effects(&plan, core.length())?);
    let same_effects = *core.effects() == effects;
    let same_loads =
        core.loads().len() == wanted.loads.len() && core.loads().iter().zip(&wanted.loads).all(|(a, b)| a.is_same(b));
    if rule == wanted.rule && same_effects && same_loads {
        return Ok(());
    }
    let Ok(core) = cable.core_mut() else { return Ok(()) };
    // all of it or nothing
    let mut changed = core.clone();
    if rule != wanted.rule || !same_effects {
        // damping needs an implicit method, however soft the cable; what the user has set stays
        let soft = core.frequency_bound();
        let choice = |f: Fidelity, damped: bool| f.integrator(if damped { f64::INFINITY } else { soft });
        let (damped, damps) = (core.effects().damping.is_some(), effects.damping.is_some());
        let integrator = match plan.integrator {
            IntegratorChoice::Fidelity(fidelity) if core.integrator() == choice(fidelity, damped) => {
                choice(fidelity, damps)
            }
            _ => core.integrator(),
        };
        wanted.rule.check()?;
        changed.redefine(wanted.rule, effects, integrator)?;
    }
    if !same_loads {
        changed.set_loads(&wanted.loads)?;
    }
    *core = changed;
    Ok(())
}

/// Registers the effects with the app's types.
#[cfg(all(feature = "bevy_app", feature = "reflect"))]
pub(crate) fn register(app: &mut bevy_app::App) {
    app.register_type::<Rule>()
        .register_type::<Bending>()
        .register_type::<Damping>()
        .register_type::<Drag>()
        .register_type::<Buoyancy>()
        .register_type::<RestShape>()
        .register_type::<LineLoads>()
        .register_type::<PointLoads>()
        .register_type::<GravityScale>();
}

/// Lets a cable be looked at that lost an effect.
fn removed(mut world: DeferredWorld, context: HookContext) {
    if let Some(mut changed) = world.get_resource_mut::<ChangedEffects>() {
        changed.0.insert(context.entity);
    }
}
