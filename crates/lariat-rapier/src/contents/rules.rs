//! Which colliders and cables a cable touches, and with which friction and restitution: as Rapier
//! decides it for two colliders.

use crate::handle::CableHandle;
use lariat_ancf::contact::LARGEST_RESTITUTION;
use rapier::dynamics::CoefficientCombineRule;
use rapier::geometry::{Collider, ColliderHandle, InteractionGroups};
use rapier::math::Real;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// What a cable is for Rapier's rules of contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ContactRules {
    /// Its collision groups. Default: all.
    pub collision_groups: InteractionGroups,
    /// Its solver groups. Default: all.
    pub solver_groups: InteractionGroups,
    /// How its friction is combined with that of a collider or another cable. Default: the mean of
    /// both.
    pub friction_combine_rule: CoefficientCombineRule,
    /// How its restitution is combined with that of a collider or another cable. Default: the mean
    /// of both.
    pub restitution_combine_rule: CoefficientCombineRule,
}

impl ContactRules {
    /// Returns whether the cable touches a collider: both groups allow it, it is enabled and no
    /// sensor.
    pub(crate) fn allow(&self, collider: &Collider) -> bool {
        collider.is_enabled()
            && !collider.is_sensor()
            && self.collision_groups.test(collider.collision_groups())
            && self.solver_groups.test(collider.solver_groups())
    }

    /// Returns the coefficients of friction and of restitution between two cables, each with its
    /// own, if both groups let them touch.
    pub(crate) fn between((one, mine): (&Self, [f64; 2]), (other, theirs): (&Self, [f64; 2])) -> Option<[f64; 2]> {
        let allowed = one.collision_groups.test(other.collision_groups) && one.solver_groups.test(other.solver_groups);
        let friction = (one.friction_combine_rule, other.friction_combine_rule);
        let restitution = (one.restitution_combine_rule, other.restitution_combine_rule);
        let both = |rules, k: usize| combined(rules, mine[k], theirs[k] as Real);
        allowed.then(|| [both(friction, 0), both(restitution, 1).min(LARGEST_RESTITUTION)])
    }

    /// Returns the coefficient of friction between a cable with its own and a collider.
    pub(crate) fn friction(&self, own: f64, collider: &Collider) -> f64 {
        let rules = (self.friction_combine_rule, collider.friction_combine_rule());
        combined(rules, own, collider.friction())
    }

    /// Returns the coefficient of restitution between a cable with its own and a collider.
    pub(crate) fn restitution(&self, own: f64, collider: &Collider) -> f64 {
        let rules = (self.restitution_combine_rule, collider.restitution_combine_rule());
        combined(rules, own, collider.restitution())
    }
}

/// Returns what two coefficients make, each with its rule: never below 0.
fn combined(rules: (CoefficientCombineRule, CoefficientCombineRule), own: f64, other: Real) -> f64 {
    f64::from(CoefficientCombineRule::combine(own as Real, other, rules.0, rules.1)).max(0.0)
}

/// Decides whether a cable may touch a collider, beyond the groups; for
/// [`CableSet::set_contact_filter`](crate::CableSet::set_contact_filter). It must depend on its
/// arguments alone.
#[derive(Clone)]
pub struct ContactFilter(Arc<dyn Fn(CableHandle, ColliderHandle) -> bool + Send + Sync>);

impl ContactFilter {
    /// Wraps a function that returns whether they may touch.
    pub fn new(allows: impl Fn(CableHandle, ColliderHandle) -> bool + Send + Sync + 'static) -> Self {
        ContactFilter(Arc::new(allows))
    }

    pub(crate) fn allows(&self, cable: CableHandle, collider: ColliderHandle) -> bool {
        (self.0)(cable, collider)
    }
}

impl fmt::Debug for ContactFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ContactFilter")
    }
}
