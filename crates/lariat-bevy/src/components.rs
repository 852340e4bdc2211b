//! The components that together say what a cable does, in one list.
//!
//! The list is that of [`for_each_effect`](lariat_ancf::for_each_effect), and before it [`Rule`],
//! [`Bending`], [`PointLoads`], [`Reel`], [`ReelAtStart`], [`Drum`], [`BreakTension`] and [`BreakStrain`]. Building, updating, breaking, snapshots, change detection and
//! reflection all use [`CableComponents`], so a new effect needs no further line in this crate.

use crate::description::Description;
use crate::drum::Drum;
use crate::effects::*;
use crate::reel::{Reel, ReelAtStart};
use crate::saved::maybe;
use crate::strength::{BreakStrain, BreakTension};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::query::{Changed, Or};
use bevy_ecs::world::{EntityRef, EntityWorldMut};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, BendingRule, Effects, Error, Feed, PointLoad, Section};
use serde::{Deserialize, Serialize};

macro_rules! components {
    ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => {
        /// The components beside a [`Cable`](crate::Cable) that say what it does.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub(crate) struct CableComponents {
            #[serde(with = "maybe")]
            rule: Option<Rule>,
            #[serde(with = "maybe")]
            bending: Option<Bending>,
            #[serde(with = "maybe")]
            point_loads: Option<PointLoads>,
            #[serde(with = "maybe")]
            reel: Option<Reel>,
            #[serde(with = "maybe")]
            reel_at_start: Option<ReelAtStart>,
            #[serde(with = "maybe")]
            drum: Option<Drum>,
            #[serde(with = "maybe")]
            break_tension: Option<BreakTension>,
            #[serde(with = "maybe")]
            break_strain: Option<BreakStrain>,
            $(#[serde(with = "maybe")] $field: Option<$type>,)*
        }

        /// Query filter: one of the components was added or changed.
        pub(crate) type AnyChanged =
            Or<(Changed<Rule>, Changed<Bending>, Changed<PointLoads>, $(Changed<$type>),*)>;

        impl CableComponents {
            /// Reads the components of an entity.
            pub fn of(entity: EntityRef) -> Self {
                CableComponents {
                    rule: entity.get().copied(),
                    bending: entity.get().copied(),
                    point_loads: entity.get().cloned(),
                    reel: entity.get().cloned(),
                    reel_at_start: entity.get().cloned(),
                    drum: entity.get().cloned(),
                    break_tension: entity.get().copied(),
                    break_strain: entity.get().copied(),
                    $($field: entity.get().cloned(),)*
                }
            }

            /// Writes the components of an entity, those that differ alone.
            pub fn put(self, entity: &mut EntityWorldMut) {
                put(entity, self.rule);
                put(entity, self.bending);
                put(entity, self.point_loads);
                put(entity, self.reel);
                put(entity, self.reel_at_start);
                put(entity, self.drum);
                put(entity, self.break_tension);
                put(entity, self.break_strain);
                $(put(entity, self.$field);)*
            }

            /// Returns the components of a part of a cable that broke.
            pub fn of_part(&self, part: &lariat_ancf::Cable) -> Self {
                let effects = part.effects();
                let has_reel = |at: At| part.reel_description(at).is_some_and(|reel| !reel.needs_island());
                CableComponents {
                    rule: self.rule,
                    bending: self.bending,
                    point_loads: self.point_loads.as_ref().map(|_| PointLoads(part.loads().to_vec())),
                    reel: self.reel.clone().filter(|_| has_reel(At::End)),
                    reel_at_start: self.reel_at_start.clone().filter(|_| has_reel(At::Start)),
                    drum: self.drum.clone().filter(|drum| part.reel_description(drum.at()).is_some_and(|reel| reel.feed == Feed::BodyDrum)),
                    break_tension: self.break_tension,
                    break_strain: self.break_strain,
                    $($field: self.$field.as_ref().zip(effects.$field.as_ref()).map(|(c, effect)| c.of_part(effect)),)*
                }
            }

            /// Returns the effects on a cable of this section and unstretched length (m), with the law
            /// of a rope where it is one.
            fn effects(&self, description: &Description, section: &Section, length: f64) -> Result<Effects, Error> {
                let mut effects =
                    Effects { $($field: self.$field.as_ref().map(|c| c.resolve(section, length)).transpose()?,)* };
                if let (None, Some(damping)) = (self.bending, &mut effects.damping)
                    && damping.bending > 0.0
                    && damping.bending.is_finite()
                {
                    // only a cable with bending stiffness damps its curvature
                    damping.bending = 0.0;
                }
                if effects.axial_law.is_none() && (description.rope || section.is_rope()) {
                    effects.axial_law = lariat_ancf::AxialLaw::of_rope(&effects, self.rule(description));
                }
                Ok(effects)
            }
        }

        /// Registers the components with the type registry of an app.
        #[cfg(all(feature = "bevy_app", feature = "reflect"))]
        pub(crate) fn register(app: &mut bevy_app::App) {
            app.register_type::<Rule>().register_type::<Bending>().register_type::<PointLoads>();
            $(app.register_type::<$type>();)*
        }
    };
}
lariat_ancf::for_each_effect!(components);

impl CableComponents {
    /// Renames entities.
    pub fn rename(&mut self, name: &(impl Fn(Entity) -> Entity + ?Sized)) {
        if let Some(drum) = &mut self.drum {
            drum.body = name(drum.body);
        }
    }

    /// Returns the rule: the component, or that of the described fidelity.
    fn rule(&self, description: &Description) -> lariat_ancf::Rule {
        let mut rule = self.rule.map_or_else(|| description.integrator.rule(), |rule| rule.0);
        if self.bending.is_none() {
            rule.bending = BendingRule::None;
        }
        rule
    }

    fn loads(&self) -> &[PointLoad] {
        self.point_loads.as_ref().map_or(&[], |loads| &loads.0)
    }

    /// Builds a cable from its description and these components.
    pub fn build(&self, name: &str, description: &Description) -> Result<lariat_ancf::Cable, Error> {
        let length = description.unstretched_length();
        // the builder rejects any other length, with a better message than an effect on such a
        // cable could give
        let effects = match &description.section {
            Ok(section) if length > 0.0 => self.effects(description, section, length)?,
            _ => Effects::default(),
        };
        let cable = description.build(name, self.rule(description), effects, self.loads())?;
        if description.span.is_none() {
            return Ok(cable);
        }
        // once more with the effects of its length, which shares are of
        let found = Description { length: Some(cable.length()), span: None, ..description.clone() };
        self.build(name, &found)
    }

    /// Returns a cable changed to what these components say of one of this unstretched length (m); `None` if it does that already.
    pub fn updated(
        &self,
        cable: &lariat_ancf::Cable,
        description: &Description,
        length: f64,
    ) -> Result<Option<lariat_ancf::Cable>, Error> {
        let (rule, loads) = (self.rule(description), self.loads());
        let effects = self.effects(description, &description.section.clone()?, length)?;
        let same_rule = rule == cable.rule() && effects == *cable.effects();
        let same_loads =
            cable.loads().len() == loads.len() && cable.loads().iter().zip(loads).all(|(a, b)| a.is_same(b));
        if same_rule && same_loads {
            return Ok(None);
        }
        let mut changed = cable.clone();
        if !same_rule {
            let integrator = description.integrator_for(cable, &effects);
            rule.check()?;
            changed.redefine(rule, effects, integrator)?;
        }
        if !same_loads {
            changed.set_loads(loads)?;
        }
        Ok(Some(changed))
    }
}

/// Writes or removes a component if that changes anything, so that nothing is marked as changed
/// that is not.
pub(crate) fn put<C: Component + PartialEq>(entity: &mut EntityWorldMut, component: Option<C>) {
    if entity.get::<C>() == component.as_ref() {
        return;
    }
    match component {
        Some(component) => entity.insert(component),
        None => entity.remove::<C>(),
    };
}
