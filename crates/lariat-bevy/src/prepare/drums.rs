//! Gives the set the drums that components describe.

use crate::body::BodyHandle;
use crate::cable::Cable;
use crate::cables::Cables;
use crate::drum::Drum;
use crate::error::Error;
use crate::event::DrumFailed;
use crate::pending::Pending;
use crate::physics::Physics;
use crate::snapshot::Watched;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Query, Ref, Res, ResMut, With};
use bevy_ecs::query::Allow;
use lariat_ancf::At;
use lariat_rapier::CableHandle;
use lariat_rapier::rapier::math::{Real, Vector};

/// Gives cables their drums, changes and removes them.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    physics: Res<Physics>,
    pending: Res<Pending>,
    drums: Query<(Entity, Ref<Drum>, Ref<Cable>), Allow<Disabled>>,
    with_cable: Query<&Drum, (With<Cable>, Allow<Disabled>)>,
    bodies: Query<Ref<BodyHandle>>,
) {
    let Cables { set, links, .. } = &mut *cables;
    let without = |cable| links.cables.get(&cable).is_some_and(|link| with_cable.get(link.entity).is_err());
    let removed: Vec<(CableHandle, At)> =
        set.drums().filter(|(cable, ..)| without(*cable)).map(|(cable, at, _)| (cable, at)).collect();
    for (cable, at) in removed {
        // it is there
        let _ = set.remove_drum(cable, at);
    }
    for (entity, drum, cable) in &drums {
        let Ok(handle) = cables.handle(entity) else { continue };
        let body = bodies.get(drum.body);
        let changed = drum.is_changed()
            || pending.has_changed(entity, Watched::Cable, &cable)
            || body.as_ref().is_ok_and(|body| body.is_changed());
        let wanted = body.as_ref().ok().map(|body| lariat_rapier::Drum {
            body: body.handle,
            axis: Vector::from(drum.axis.map(|x| x as Real)),
            radius: drum.radius as Real,
        });
        let now = cables.set.drums().find(|(cable, ..)| *cable == handle).map(|(_, at, drum)| (at, *drum));
        let reel = drum.reel();
        let as_described = now.is_some_and(|(at, own)| {
            let wound = cables.set.get(handle).ok().and_then(|cable| cable.reel_description(at).cloned());
            at == drum.at() && Some(own) == wanted && wound.as_ref() == Some(&reel)
        });
        if as_described || now.is_none() && !changed {
            continue;
        }
        if let Some((at, _)) = now {
            // a cable of the set
            let _ = cables.set.remove_drum(handle, at);
        }
        let outcome = match wanted {
            Some(wanted) => {
                cables.set.add_drum(&physics.bodies, (handle, drum.at()), wanted, reel).map_err(Error::from)
            }
            None => Err(Error::NotABody(drum.body)),
        };
        if let Err(error) = outcome {
            cables.events.push(DrumFailed { entity, error }.into());
        }
    }
}
