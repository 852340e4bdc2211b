//! The component that makes an entity a cable.

use crate::cables::Cables;
use crate::components::CableComponents;
use crate::description::{Description, Span};
use crate::event::{CableFailed, Logged, QueuedEvent};
use crate::pending::Pending;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::name::Name;
use bevy_ecs::world::DeferredWorld;
use lariat_ancf::{At, Fidelity, Point, Section};
use serde::{Deserialize, Serialize};

/// The description of a cable. Spawn it with its rule and effects as components beside it;
/// [`Cables`] then holds the cable:
///
/// ```
/// use bevy_ecs::prelude::*;
/// use lariat_bevy::{Bending, Cable, Cables, Damping, Drag, Rule};
///
/// let mut world = World::new();
/// lariat_bevy::install(&mut world);
/// let rope = world.spawn((
///     Cable::steel_rope(0.012).between([0.0, 30.0, 0.0], [20.0, 0.0, 0.0]).length(40.0).elements(24),
///     Rule::G5_3,
///     Bending,
///     Damping::critical_fraction(0.05),
///     Drag::air(),
/// ));
/// let rope = rope.id();
/// let cables = world.resource::<Cables>(); // in a system: `cables: Res<Cables>`
/// assert_eq!(cables.get(rope)?.positions().len(), 25 * 6); // built when it is spawned
/// # Ok::<(), lariat_bevy::Error>(())
/// ```
///
/// Without [`Bending`](crate::Bending) it has no bending stiffness; without [`Rule`](crate::Rule)
/// the rule is that of its [fidelity](lariat_ancf::Fidelity::rule); every other effect is absent unless its component is there. An
/// entity's [`Name`] is the name of the cable in error messages. If a description cannot be built,
/// [`Cables::get`] returns the reason, and [`CableFailed`] is triggered.
///
/// The component cannot be changed in place. Inserting another description replaces the cable, and
/// attachments pass to the new one if it is at their anchors ([`Gap`](crate::Gap)). A clone of the component, like that of a prefab, makes a new
/// cable in its initial state.
///
/// # Limits
///
/// Elastic, with constant EA and EI unless it has an [`AxialLaw`](crate::AxialLaw): see
/// [`lariat_ancf::element`]. Ropes and chains by name ([`Section::of`], [`Section::wire_rope`]) cannot push.
/// Nothing touches it without a [`Contact`](crate::Contact): see the [crate page](crate#limits).
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[component(immutable, on_insert = built, on_discard = discarded)]
pub struct Cable(pub(crate) Description);

impl Cable {
    /// A cable of this section.
    pub fn new(section: Section) -> Self {
        Cable(Description::new(Ok(section)))
    }

    /// A steel wire rope of this diameter (m): [`Section::wire_rope`].
    pub fn steel_rope(diameter: f64) -> Self {
        Cable(Description::new(Section::wire_rope(diameter)))
    }

    /// A homogeneous round cable: diameter in m, Young's modulus in Pa, density in kg/m^3.
    pub fn round(diameter: f64, youngs_modulus: f64, density: f64) -> Self {
        Cable(Description::new(Section::round(diameter, youngs_modulus, density)))
    }

    /// Sets the unstretched length in m. Default: the length of the initial shape. A longer cable
    /// starts slack.
    pub fn length(mut self, length: f64) -> Self {
        (self.0.length, self.0.span) = (Some(length), None);
        self
    }

    /// Instead of [`length`](Self::length): the length with which it has this tension in N at its
    /// middle when it hangs between the ends of its initial shape, before loads, wind and currents;
    /// under [`gravity`](Self::gravity), if that is not 9.81 m/s^2 along -y.
    pub fn pretension(mut self, tension: f64) -> Self {
        (self.0.length, self.0.span) = (None, Some(Span::Tension(tension)));
        self
    }

    /// Instead of [`length`](Self::length): the length with which it hangs by this distance in m
    /// below the line between its ends, at most; under the same.
    pub fn sag(mut self, sag: f64) -> Self {
        (self.0.length, self.0.span) = (None, Some(Span::Sag(sag)));
        self
    }

    /// Sets the number of elements. Default 10.
    pub fn elements(mut self, elements: usize) -> Self {
        self.0.elements = elements;
        self
    }

    /// Grades the mesh: elements at these points have this length in m at most, and the others grow
    /// from there, up to the [number](Self::elements) of elements, as
    /// [`CableBuilder::finest`](lariat_ancf::CableBuilder::finest) says.
    pub fn finest<A: Into<At>>(mut self, length: f64, at: impl IntoIterator<Item = A>) -> Self {
        self.0.finest = Some((length, at.into_iter().map(Into::into).collect()));
        self
    }

    /// Places a node at this arc length (m): where the cable is drawn around a corner at a sheave.
    pub fn node_at(mut self, arc_length: f64) -> Self {
        self.0.nodes_at.push(arc_length);
        self
    }

    /// Starts on the line from `a` to `b`, in m.
    pub fn between(self, a: impl Into<Point>, b: impl Into<Point>) -> Self {
        self.through([a.into(), b.into()])
    }

    /// Starts on the polyline through these points, in m.
    pub fn through<P: Into<Point>>(mut self, points: impl IntoIterator<Item = P>) -> Self {
        self.0.points = points.into_iter().map(|p| p.into().0).collect();
        self
    }

    /// Starts in static equilibrium between its ends.
    pub fn hanging(mut self) -> Self {
        self.0.hanging = true;
        self
    }

    /// Sets the trade-off between accuracy and cost. Default: game.
    pub fn fidelity(self, fidelity: Fidelity) -> Self {
        self.integrator(fidelity)
    }

    /// Sets the time integrator. Default: that of the fidelity.
    pub fn integrator(mut self, integrator: impl Into<Fidelity>) -> Self {
        self.0.integrator = integrator.into();
        self
    }

    /// Sets gravity in m/s^2. Default: that of the world.
    pub fn gravity(mut self, gravity: impl Into<Point>) -> Self {
        self.0.gravity = Some(gravity.into().0);
        self
    }

    /// Sets the initial velocity of the whole cable in m/s. Default zero.
    pub fn velocity(mut self, velocity: impl Into<Point>) -> Self {
        self.0.velocity = velocity.into().0;
        self
    }
}

/// Builds the cable of a component that was inserted.
fn built(world: DeferredWorld, context: HookContext) {
    build(world, context.entity);
}

/// Builds the cable of an entity, unless it has one already or its description was found
/// impossible.
pub(crate) fn build(mut world: DeferredWorld, entity: Entity) {
    let skip = |cables: &Cables| cables.restoring || cables.links.built.contains_key(&entity);
    if world.get_resource::<Cables>().is_none_or(skip) {
        return;
    }
    let Some(Cable(description)) = world.get::<Cable>(entity) else { return };
    let name = world.get::<Name>(entity).map_or("cable", Name::as_str);
    let built = CableComponents::of(world.entity(entity)).build(name, description);
    let mut cables = world.resource_mut::<Cables>();
    match built {
        Ok(cable) => {
            let length = cable.length();
            let handle = cables.set.insert(cable);
            cables.links.insert_cable(entity, handle, length);
            world.resource_mut::<Pending>().new_cables = true;
        }
        Err(error) => {
            cables.links.built.insert(entity, Err(error.clone()));
            let event = CableFailed { entity, error };
            let failure = QueuedEvent::from(event.clone()).failure(None);
            if let (Some(failure), Some(mut logged)) = (failure, world.get_resource_mut::<Logged>()) {
                logged.note(failure);
            }
            world.write_message(event.clone());
            world.commands().trigger(event);
        }
    }
}

/// Notes that the cable of a component that is removed or replaced is to be removed from the set.
fn discarded(mut world: DeferredWorld, context: HookContext) {
    let entity = context.entity;
    let handle = world.get_resource_mut::<Cables>().map(|mut cables| cables.links.remove_cable(entity));
    let Some(mut pending) = world.get_resource_mut::<Pending>() else { return };
    match handle {
        Some(handle) => {
            pending.removed_cables.extend(handle);
            pending.unlinked.retain(|unlinked| *unlinked != entity);
        }
        None => pending.unlinked.push(entity),
    }
}
