//! Changing the force strategy of a cable between steps.

use super::system::System;
use super::{Cable, check_integrator};
use crate::effect::Effects;
use crate::error::Error;
use crate::integrate::Integrator;
use crate::rule::Rule;

impl Cable {
    /// Replaces the force strategy from the next step on: also how bending is switched on and off
    /// ([`BendingRule::None`](crate::BendingRule::None)). Not for every step: tables are built anew. Position and velocity stay as they are, so
    /// elastic energy changes where the rules differ.
    ///
    /// # Errors
    /// [`Error::UnknownRule`] for points out of range, [`Error::RankDeficient`] for a rule with spare modes, [`Error::MissingForEffect`] for
    /// an effect that needs a bending rule. The cable is then as before.
    pub fn set_rule(&mut self, rule: Rule) -> Result<(), Error> {
        rule.check()?;
        self.redefine(rule, self.effects().clone(), self.integrator())
    }

    /// Replaces force strategy, effects and integrator together from the next step on, where one does not go without the other: damping wants an
    /// implicit integrator, a natural curvature a bending rule.
    ///
    /// # Errors
    /// As [`set_rule`](Self::set_rule) (but spare modes, which a cable may be built with), [`set_effects`](Self::set_effects) and
    /// [`set_integrator`](Self::set_integrator). The cable is then as before.
    pub fn redefine(&mut self, rule: Rule, effects: Effects, integrator: Integrator) -> Result<(), Error> {
        let integrator = integrator.checked()?;
        let rule = core::mem::replace(&mut self.model.rule, rule);
        let effects = core::mem::replace(&mut self.model.effects, effects);
        let checked = self.model.check_effects().and_then(|()| check_integrator(&self.model, &integrator.method));
        let system = checked.and_then(|()| {
            System::with_level(&self.model, self.system.level)
                .map_err(|failure| self.step_failed(self.time(), 0.0, failure))
        });
        match system {
            Ok(system) => {
                self.system = system;
                self.integrator = integrator;
                self.revise();
                Ok(())
            }
            Err(error) => {
                self.model.rule = rule;
                self.model.effects = effects;
                Err(error.of_cable(self.name()))
            }
        }
    }
}
