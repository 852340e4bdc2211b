//! Makes the kinks that components ask for, and the entities of the parts behind them.

use super::has_cable_changed;
use crate::breaking::split_entity;
use crate::cables::Cables;
use crate::error::Error;
use crate::event::JunctionFailed;
use crate::junction::{Joined, Junction};
use crate::kink::KinkAlong;
use crate::links::JunctionLink;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Ref, World};
use bevy_ecs::query::{Allow, QueryState};
use lariat_ancf::At;

/// Makes the kinks that were asked for. Attachments to the ends of their cables are there already.
pub(crate) fn update(world: &mut World, asked: &mut QueryState<(Entity, Ref<KinkAlong>), Allow<Disabled>>) {
    let asked: Vec<_> = asked.iter(world).map(|(entity, kink)| (entity, *kink, kink.is_changed())).collect();
    for (entity, kink, is_changed) in asked {
        if (is_changed || has_cable_changed(world, kink.cable.0))
            && let Err(error) = make(world, entity, kink)
        {
            world.resource_mut::<Cables>().events.push(JunctionFailed { entity, error }.into());
        }
    }
}

/// Makes a kink, the entity of the part behind it, and the junction of both.
fn make(world: &mut World, entity: Entity, KinkAlong { cable: (cable, at) }: KinkAlong) -> Result<(), Error> {
    let mut cables = world.resource_mut::<Cables>();
    let handle = cables.handle(cable)?;
    let (tail, junction) = cables.set.add_kink(handle, at)?;
    let rest = split_entity(world, cable, handle, tail).ok_or(Error::NotACable(cable))?;
    let made = Junction::between((cable, At::End), (rest, At::Start));
    let link = JunctionLink { entity, made: made.clone() };
    world.resource_mut::<Cables>().links.junctions.insert(junction, link);
    world.entity_mut(entity).remove::<KinkAlong>().insert((made, Joined(junction)));
    Ok(())
}
