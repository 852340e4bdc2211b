//! By which methods a cable can be stepped.

use crate::error::Error;
use crate::integrate::OneStep;
use crate::model::Model;

/// Checks that a cable has an implicit method where an effect or a reel needs one, the discrete
/// gradient for contact and for torsion with a reel, and with a reel a method by which its account
/// of energy closes.
pub(crate) fn check_integrator(model: &Model, method: &dyn OneStep) -> Result<(), Error> {
    if model.effects.contact.is_some() && !method.uses_discrete_gradients() {
        return Err(Error::ContactMethod { cable: model.name.clone(), method: method.name() });
    }
    if !model.reels.is_empty() {
        check_torsion(model, method, "a reel")?;
    }
    if model.effects.needs_implicit_integrator() && method.stability_limit().is_some() {
        return Err(Error::ExplicitDamping { cable: model.name.clone(), method: method.name() });
    }
    if !model.reels.is_empty() && method.stability_limit().is_some() {
        return Err(Error::ExplicitReel { cable: model.name.clone(), method: method.name() });
    }
    let refused = |reason| Err(Error::ReelMethod { cable: model.name.clone(), method: method.name(), reason });
    if model.reels.have_laws() && !method.uses_discrete_gradients() {
        return refused("with max_force its rate is an unknown, which only discrete-gradient solves for");
    }
    if !model.reels.is_empty() && !method.uses_discrete_gradients() && method.estimate_order().is_none() {
        return refused(
            "its work is not accounted for where the steps do not resolve the waves of the mesh and the method leaves them ringing; use \
             discrete-gradient, or an implicit method with an estimate of its error, as esdirk4",
        );
    }
    Ok(())
}

/// Checks that torsion is stepped by the discrete gradient beside something else.
pub(crate) fn check_torsion(model: &Model, method: &dyn OneStep, beside: &str) -> Result<(), Error> {
    if model.effects.torsion.is_none() || method.uses_discrete_gradients() {
        return Ok(());
    }
    let by = format!("by {} with {beside}: use discrete-gradient", method.name());
    Err(Error::TorsionPlace { cable: model.name.clone(), by })
}
