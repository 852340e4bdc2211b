//! Changing the force strategy of a cable between steps.

use super::Cable;
use super::system::System;
use crate::error::Error;
use crate::rule::Rule;

impl Cable {
    /// Replaces the force strategy from the next step on: also how bending is switched on and off
    /// ([`BendingRule::None`](crate::BendingRule::None)). Not for every step: tables are built anew. Position and velocity stay as they are, so
    /// elastic energy changes where the rules differ.
    ///
    /// # Errors
    /// [`Error::UnknownRule`] for points out of range, [`Error::RankDeficient`] for a rule with spare modes, [`Error::InvalidShape`] for an
    /// effect that needs a bending rule. The cable is then as before.
    pub fn set_rule(&mut self, rule: Rule) -> Result<(), Error> {
        rule.check()?;
        let before = core::mem::replace(&mut self.model.rule, rule);
        let system = self.model.check_effects().and_then(|()| {
            System::with_level(&self.model, self.system.level)
                .map_err(|failure| self.refused(self.time(), 0.0, failure))
        });
        match system {
            Ok(system) => {
                self.system = system;
                self.revise();
                Ok(())
            }
            Err(error) => {
                self.model.rule = before;
                Err(error)
            }
        }
    }
}
