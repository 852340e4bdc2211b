//! Junctions that were spawned, changed, or lost a cable.

use crate::cables::Cables;
use crate::error::Error;
use crate::event::{JunctionEnded, JunctionFailed};
use crate::junction::{Joined, Junction, NotJoinable};
use crate::links::JunctionLink;
use crate::pending::Pending;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::prelude::{Commands, Has, Query, Ref, ResMut};
use lariat_ancf::At;
use lariat_rapier::{CableHandle, JunctionHandle};

/// The components of a junction, and its state.
type Components = (Entity, Ref<'static, Junction>, Option<&'static Joined>, Has<NotJoinable>);

/// Makes the junctions that the components ask for, and ends the others. `pending.new_cables` is still
/// that of the attachments.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    mut pending: ResMut<Pending>,
    junctions: Query<Components>,
    mut commands: Commands,
) {
    let cables = &mut *cables;
    for handle in pending.removed_junctions.drain(..) {
        dissolve(cables, handle);
    }
    for (entity, junction, joined, failed) in &junctions {
        let mut component = commands.entity(entity);
        let points = existing(cables, &junction);
        let was_joined = joined.is_some();
        if let Some(&Joined(handle)) = joined {
            if is_as_described(cables, handle, &junction, &points) {
                continue;
            }
            dissolve(cables, handle);
            component.remove::<Joined>();
        } else if failed && !junction.is_changed() && !pending.new_cables {
            continue;
        }
        let outcome = if points.len() == junction.points.len() || was_joined && points.len() > 1 {
            join(cables, &junction, &points).map(Some)
        } else if was_joined {
            Ok(None)
        } else {
            let missing = junction.points.iter().find_map(|(cable, _)| cables.handle(*cable).err());
            Err(missing.unwrap_or(Error::TooFewCables))
        };
        match outcome {
            Ok(Some(handle)) => {
                cables.links.junctions.insert(handle, JunctionLink { entity, made: Junction::clone(&junction) });
                component.insert(Joined(handle)).remove::<NotJoinable>();
            }
            Ok(None) => {
                component.insert(NotJoinable);
                cables.events.push(JunctionEnded { entity }.into());
            }
            Err(error) => {
                component.insert(NotJoinable);
                cables.events.push(JunctionFailed { entity, error }.into());
            }
        }
    }
}

/// Returns the points of a junction whose cables are in the set.
fn existing(cables: &Cables, junction: &Junction) -> Vec<(CableHandle, At)> {
    junction.points.iter().filter_map(|(cable, at)| Some((cables.handle(*cable).ok()?, *at))).collect()
}

/// Returns whether a junction of the set is the one that its component describes.
fn is_as_described(cables: &Cables, handle: JunctionHandle, junction: &Junction, points: &[(CableHandle, At)]) -> bool {
    let Ok(joined) = cables.set.junction(handle) else { return false };
    let same = cables.links.junctions.get(&handle).is_some_and(|link| link.made.points == junction.points);
    same && joined.points().map(|(cable, _)| cable).eq(points.iter().map(|(cable, _)| *cable))
}

/// Makes a junction of points that are part of no other.
fn join(cables: &mut Cables, junction: &Junction, points: &[(CableHandle, At)]) -> Result<JunctionHandle, Error> {
    for &(cable, at) in points {
        let existing = cables.set.get(cable)?;
        let s = existing.arc_length(at)?;
        let node = existing.node(s).ok();
        let mut taken = cables.links.junctions.keys().filter_map(|handle| cables.set.junction(*handle).ok());
        if let Some(node) = node.filter(|node| taken.any(|other| other.nodes().contains(&(cable, *node)))) {
            let cable = existing.name().to_string();
            return Err(lariat_rapier::Error::AlreadyAttached { cable, node }.into());
        }
    }
    let [first, others @ ..] = points else { return Err(Error::TooFewCables) };
    let mut made = None;
    for other in others {
        match cables.set.join_with_gap(*first, *other, junction.gap) {
            Ok(handle) => made = Some(handle),
            Err(error) => {
                if let Some(handle) = made {
                    dissolve(cables, handle);
                }
                return Err(error.into());
            }
        }
    }
    made.ok_or(Error::TooFewCables)
}

/// Unties the cables of a junction.
fn dissolve(cables: &mut Cables, handle: JunctionHandle) {
    cables.links.junctions.remove(&handle);
    let Ok(junction) = cables.set.junction(handle) else { return };
    for (cable, _) in junction.nodes().to_vec() {
        // the last of them ends the junction
        let _ = cables.set.leave(handle, cable);
    }
}
