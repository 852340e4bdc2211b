//! The usual rope between two points, spawned in one call.

use crate::attachment::Attachment;
use crate::cable::Cable;
use crate::description::Description;
use crate::effects::{Bending, Damping};
use crate::strength::BreakTension;
use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use bevy_ecs::system::Commands;
use bevy_ecs::world::{CommandQueue, World};
use lariat_ancf::At;
use lariat_rapier::{ROPE_DAMPING, Rope, RopeEnd};

/// Spawns ropes, from [`Commands`] or a [`World`].
pub trait SpawnRope {
    /// Spawns the usual rope between two points in m, in axes of the *world* for ends on bodies, too
    /// (where [`Attachment::anchor`](crate::Attachment::anchor) is in those of the body), held there
    /// by bodies or by the world: a cable with bending stiffness and damping, which cannot push, and
    /// an attachment at either end. Returns the entity of the cable, and those of the attachments.
    ///
    /// ```
    /// use bevy_ecs::prelude::*;
    /// use lariat_bevy::rapier::prelude::ColliderBuilder;
    /// use lariat_bevy::{Body, BodyPose, Rope, SpawnRope};
    ///
    /// let mut world = World::new();
    /// lariat_bevy::install(&mut world);
    /// let cube = ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0);
    /// let load = world.spawn(Body::dynamic().at([0.0, -2.1, 0.0]).with(cube)).id();
    /// // a steel rope of 8 mm that breaks at 20 kN; `.slack(0.05)` makes it 5 % longer
    /// let rope = Rope::steel(0.008).strength(20e3);
    /// let (rope, [top, hook]) = world.spawn_rope([0.0, 0.0, 0.0], (load, [0.0, -2.0, 0.0]), rope);
    /// for _ in 0..300 {
    ///     lariat_bevy::advance(&mut world, 1.0 / 60.0);
    /// }
    /// assert!((world.get::<BodyPose>(load).unwrap().position.y + 2.1).abs() < 0.01);
    /// ```
    ///
    /// A body is attached where the end of the rope is when the next host step begins.
    fn spawn_rope(
        &mut self,
        from: impl Into<RopeEnd<Entity>>,
        to: impl Into<RopeEnd<Entity>>,
        rope: Rope,
    ) -> (Entity, [Entity; 2]);
}

impl SpawnRope for Commands<'_, '_> {
    fn spawn_rope(
        &mut self,
        from: impl Into<RopeEnd<Entity>>,
        to: impl Into<RopeEnd<Entity>>,
        rope: Rope,
    ) -> (Entity, [Entity; 2]) {
        let (from, to) = (from.into(), to.into());
        let section = rope.section.clone();
        let mut description = Description::new(section);
        description.rope = true;
        description.points = vec![from.point, to.point];
        description.length = Some(rope.length(&from.point, &to.point));
        description.elements = rope.elements;
        if let Some(fidelity) = rope.fidelity {
            description.integrator = fidelity;
        }
        let damping = Damping::critical_fraction(ROPE_DAMPING);
        // the cable is built when the component `Cable` is inserted, with what is there
        let cable = self.spawn((Name::new(rope.name), Bending, damping, Cable(description))).id();
        if let Some(strength) = rope.strength {
            self.entity(cable).insert(BreakTension(strength));
        }
        let attachments = [(At::Start, from), (At::End, to)].map(|(at, end)| {
            let attachment = Attachment::ball(cable, at);
            match end.body {
                Some(body) => self.spawn(attachment.to(body)).id(),
                None => self.spawn(attachment.to_world()).id(),
            }
        });
        (cable, attachments)
    }
}

impl SpawnRope for World {
    fn spawn_rope(
        &mut self,
        from: impl Into<RopeEnd<Entity>>,
        to: impl Into<RopeEnd<Entity>>,
        rope: Rope,
    ) -> (Entity, [Entity; 2]) {
        let mut queue = CommandQueue::default();
        let spawned = Commands::new(&mut queue, self).spawn_rope(from, to, rope);
        queue.apply(self);
        spawned
    }
}
