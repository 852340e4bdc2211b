//! A cable as a component: described when it is spawned, built at once, stepped by its set, readable between steps.

use crate::effects::{self, Wanted};
use crate::error::Error;
use crate::event::CableFailed;
use crate::plan::Plan;
use crate::point::Point;
use crate::world::Cables;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::world::DeferredWorld;
use lariat_ancf::{Energy, Fidelity, Integrator, Sample, Section};
use lariat_rapier::Lent;

/// A cable. Spawn it with its force strategy and effects as components beside it:
///
/// ```
/// use bevy_ecs::prelude::*;
/// use lariat_bevy::{Bending, Cable, Damping, Drag, Rule};
///
/// let mut world = World::new();
/// lariat_bevy::install(&mut world);
/// let rope = world.spawn((
///     Cable::steel_rope(0.012).length(40.0).elements(24).between([0.0, 30.0, 0.0], [20.0, 0.0, 0.0]),
///     Rule::G5_3,
///     Bending,
///     Damping::critical_fraction(0.05),
///     Drag::air(),
/// ));
/// let rope = rope.get::<Cable>().unwrap();
/// assert_eq!(rope.positions().len(), 25 * 6); // built at once
/// ```
///
/// Without [`Bending`](crate::Bending) it is limp; without [`Rule`](crate::Rule) the rule is `projected-3`; every other effect is absent
/// until its component is there. An entity's [`Name`](bevy_ecs::name::Name) is the cable's name in errors. A description that cannot be built leaves a cable without
/// state, whose [`failure`](Self::failure) says why, and [`CableFailed`] is triggered.
#[derive(Component, Clone, Debug)]
#[component(on_insert = build, on_discard = hand_in)]
pub struct Cable {
    pub(crate) plan: Plan,
    pub(crate) state: State,
    /// What it had done when it was counted last.
    pub(crate) counted: lariat_ancf::Diagnostics,
}

/// Where the mechanics of a cable are.
#[derive(Clone, Debug)]
pub(crate) enum State {
    /// Not built yet.
    Planned,
    /// Built, not in the set yet.
    Built(Box<lariat_ancf::Cable>),
    /// Of the set, lent to the component.
    Lent(Lent),
    /// With the set, during a step.
    Away,
    /// Cannot be built.
    Failed(lariat_ancf::Error),
}

impl Cable {
    /// A cable of this section.
    pub fn new(section: Section) -> Self {
        Self::planned(Ok(section))
    }

    /// A steel wire rope of this diameter (m): [`Section::wire_rope`].
    pub fn steel_rope(diameter: f64) -> Self {
        Self::planned(Section::wire_rope(diameter))
    }

    /// A homogeneous round cable: diameter in m, Young's modulus in Pa, density in kg/m^3.
    pub fn round(diameter: f64, youngs_modulus: f64, density: f64) -> Self {
        Self::planned(Section::round(diameter, youngs_modulus, density))
    }

    fn planned(section: Result<Section, lariat_ancf::Error>) -> Self {
        Cable { plan: Plan::new(section), state: State::Planned, counted: lariat_ancf::Diagnostics::default() }
    }

    /// Unstretched length in m. Default: the length of the drawn shape. Longer: it starts slack.
    pub fn length(mut self, length: f64) -> Self {
        self.plan.length = Some(length);
        self
    }

    /// Number of elements. Default 10.
    pub fn elements(mut self, elements: usize) -> Self {
        self.plan.elements = elements;
        self
    }

    /// Starts on the line from `a` to `b`, in m.
    pub fn between(self, a: impl Into<Point>, b: impl Into<Point>) -> Self {
        self.through([a.into(), b.into()])
    }

    /// Starts on the polyline through these points, in m.
    pub fn through<P: Into<Point>>(mut self, points: impl IntoIterator<Item = P>) -> Self {
        self.plan.points = points.into_iter().map(|p| p.into().0).collect();
        self
    }

    /// Starts in the static shape in which it hangs between its ends.
    pub fn hanging(mut self) -> Self {
        self.plan.hanging = true;
        self
    }

    /// Accuracy against time. Default: engineering.
    pub fn fidelity(mut self, fidelity: Fidelity) -> Self {
        self.plan.integrator = fidelity.into();
        self
    }

    /// Time integrator. Default: that of the fidelity.
    pub fn integrator(mut self, integrator: Integrator) -> Self {
        self.plan.integrator = integrator.into();
        self
    }

    /// Gravity in m/s^2. Default: the world's.
    pub fn gravity(mut self, gravity: impl Into<Point>) -> Self {
        self.plan.gravity = Some(gravity.into().0);
        self
    }

    /// Velocity of the whole cable at the start, in m/s. Default zero.
    pub fn velocity(mut self, velocity: impl Into<Point>) -> Self {
        self.plan.velocity = velocity.into().0;
        self
    }

    /// The mechanics, to read everything else.
    ///
    /// # Errors
    /// [`Error::NotBuilt`].
    pub fn core(&self) -> Result<&lariat_ancf::Cable, Error> {
        match &self.state {
            State::Built(cable) => Ok(cable),
            State::Lent(cable) => Ok(cable),
            State::Planned | State::Away | State::Failed(_) => Err(Error::NotBuilt),
        }
    }

    /// The mechanics, to change state, integrator or gravity; it wakes. Effects, point loads and the rule are the entity's components,
    /// which win over what is set here.
    ///
    /// # Errors
    /// [`Error::NotBuilt`].
    pub fn core_mut(&mut self) -> Result<&mut lariat_ancf::Cable, Error> {
        match &mut self.state {
            State::Built(cable) => Ok(cable),
            State::Lent(cable) => Ok(cable),
            State::Planned | State::Away | State::Failed(_) => Err(Error::NotBuilt),
        }
    }

    /// Nodal coordinates: position (m) and slope of each node, six numbers a node. Empty if it is not built.
    pub fn positions(&self) -> &[f64] {
        self.core().map_or(&[], lariat_ancf::Cable::positions)
    }

    /// Nodal velocities: of position (m/s) and slope (1/s) of each node. Empty if it is not built.
    pub fn velocities(&self) -> &[f64] {
        self.core().map_or(&[], lariat_ancf::Cable::velocities)
    }

    /// Position, tangent, tension, curvature and moment at an arc length in m.
    ///
    /// # Errors
    /// [`Error::NotBuilt`]; [`Error::Cable`] for an arc length that is not on the cable.
    pub fn sample(&self, arc_length: f64) -> Result<CableSample, Error> {
        Ok(self.core()?.sample(arc_length)?)
    }

    /// Kinetic, elastic and gravity energy in J.
    ///
    /// # Errors
    /// [`Error::NotBuilt`].
    pub fn energy(&self) -> Result<Energy, Error> {
        Ok(self.core()?.energy())
    }

    /// Whether it sleeps with the bodies that it holds.
    pub fn is_asleep(&self) -> bool {
        matches!(&self.state, State::Lent(cable) if cable.is_asleep())
    }

    /// Why it could not be built.
    pub fn failure(&self) -> Option<&lariat_ancf::Error> {
        if let State::Failed(error) = &self.state { Some(error) } else { None }
    }
}

/// What a cable is like at one point.
pub type CableSample = Sample;

/// Builds a cable from its description and the components beside it.
fn build(mut world: DeferredWorld, context: HookContext) {
    let entity = context.entity;
    let Some(cable) = world.get::<Cable>(entity) else { return };
    if let State::Lent(lent) = &cable.state {
        // the copy of another entity's cable is a cable of its own
        let of_this = |cables: &Cables| cables.links.cables.get(&lent.handle()) == Some(&entity);
        if !world.get_resource::<Cables>().is_some_and(of_this) {
            let copy = Box::new((**lent).clone());
            if let Some(mut cable) = world.get_mut::<Cable>(entity) {
                cable.state = State::Built(copy);
            }
        }
        return;
    }
    build_one(world, entity);
}

/// Builds the cable of an entity, if it is not built.
pub(crate) fn build_one(mut world: DeferredWorld, entity: Entity) {
    let Some(cable) = world.get::<Cable>(entity) else { return };
    if !matches!(cable.state, State::Planned) {
        return;
    }
    let wanted = Wanted::of(world.entity(entity));
    let built = effects::build(&cable.plan, &wanted);
    let failure = built.as_ref().err().cloned();
    if let Some(mut cable) = world.get_mut::<Cable>(entity) {
        cable.state = match built {
            Ok(core) => State::Built(Box::new(core)),
            Err(error) => State::Failed(error),
        };
    }
    if let Some(error) = failure {
        let event = CableFailed { entity, error };
        if world.contains_resource::<Cables>() {
            world.write_message(event.clone());
        }
        world.commands().trigger(event);
    }
}

/// Hands the mechanics of a cable that goes away, or is replaced, to the set.
fn hand_in(mut world: DeferredWorld, context: HookContext) {
    let Some(mut cable) = world.get_mut::<Cable>(context.entity) else { return };
    if let State::Lent(lent) = core::mem::replace(&mut cable.state, State::Planned)
        && let Some(mut cables) = world.get_resource_mut::<Cables>()
    {
        cables.handed_in.push((context.entity, lent));
    }
}
