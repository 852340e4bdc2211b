//! Which components had changed when a snapshot was taken, and were not seen by a host step yet.
//!
//! Some systems try again what failed when its component changes. Restoring a component changes it,
//! too, and would have them try what the run of the snapshot did not.

use crate::attachment::{Attachment, OnCable, ToBody};
use crate::body::{BodyHandle, KinematicTarget};
use crate::cable::Cable;
use crate::drum::Drum;
use crate::junction::Junction;
use crate::kink::KinkAlong;
use crate::passing::SheaveAlong;
use crate::pending::Pending;
use crate::reel::{Reel, ReelAtStart};
use crate::sheave::Sheave;
use crate::strength::{BreakStrain, BreakTension};
use crate::water::InWater;
use bevy_ecs::change_detection::{DetectChanges, DetectChangesMut, MAX_CHANGE_AGE, Tick};
use bevy_ecs::entity::Entity;
use bevy_ecs::world::{EntityRef, World};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

macro_rules! watched {
    (mutable: $($own:ident),*; immutable: $($fixed:ident),*;) => {
        /// A component whose change a system waits for.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        pub(crate) enum Watched {
            $($own,)* $($fixed,)*
        }

        impl Watched {
            /// Returns those of an entity that changed since the last host step was prepared.
            pub(super) fn changed(entity: EntityRef, pending: &Pending, now: Tick) -> Vec<Watched> {
                let mut changed = Vec::new();
                $(if let Some(own) = entity.get_ref::<$own>()
                    && pending.is_new(entity.id(), Watched::$own, own.last_changed(), now)
                {
                    changed.push(Watched::$own);
                })*
                $(if let Some(own) = entity.get_ref::<$fixed>()
                    && pending.is_new(entity.id(), Watched::$fixed, own.last_changed(), now)
                {
                    changed.push(Watched::$fixed);
                })*
                changed
            }

            /// Has those of a restored entity count as changed, and no others.
            pub(super) fn settle(world: &mut World, entity: Entity, changed: &[Watched], put_back: &mut PutBack) {
                let now = world.change_tick();
                $(if let Some(mut own) = world.get_mut::<$own>(entity) {
                    settle(&mut own, changed.contains(&Watched::$own), now);
                })*
                // nobody can say of these when they changed
                $(if world.get::<$fixed>(entity).is_some() && !changed.contains(&Watched::$fixed) {
                    put_back.components.insert((entity, Watched::$fixed));
                })*
            }
        }
    };
}

watched! {
    mutable: Attachment, BodyHandle, KinematicTarget, Junction, Sheave, SheaveAlong, KinkAlong, Drum, Reel, ReelAtStart,
        BreakTension, BreakStrain, InWater;
    immutable: Cable, OnCable, ToBody;
}

/// Has a component or resource count as changed now, or never.
pub(super) fn settle(own: &mut impl DetectChangesMut, has_changed: bool, now: Tick) {
    if has_changed {
        own.set_changed();
    } else {
        own.set_last_changed(Tick::new(now.get().wrapping_sub(MAX_CHANGE_AGE)));
    }
}

/// Components that a snapshot put back although they had not changed when it was taken.
#[derive(Clone, Debug, Default)]
pub(crate) struct PutBack {
    components: BTreeSet<(Entity, Watched)>,
    /// When the last host step before was prepared.
    after: Tick,
    /// When it was done.
    until: Tick,
}

impl PutBack {
    /// No components yet, put back between two moments.
    pub(super) fn between(after: Tick, until: Tick) -> Self {
        PutBack { components: BTreeSet::new(), after, until }
    }

    /// Whether it was this that changed a component.
    pub fn explains(&self, entity: Entity, component: Watched, changed: Tick) -> bool {
        let since = |tick: Tick| tick.get().wrapping_sub(self.after.get());
        since(changed) <= since(self.until) && self.components.contains(&(entity, component))
    }
}
