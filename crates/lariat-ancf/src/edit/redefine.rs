//! Changing the rule of a cable between steps.

use crate::cable::{Cable, check_integrator};
use crate::effect::Effects;
use crate::error::Error;
use crate::integrate::Integrator;
use crate::rule::Rule;

impl Cable {
    /// Replaces the rule of the elastic forces from the next step on: this also switches bending on
    /// and off ([`BendingRule::None`](crate::BendingRule::None)). Positions and velocities stay as
    /// they are, so elastic energy changes where the rules differ. Not meant for every step,
    /// because it builds tables.
    ///
    /// # Errors
    /// [`Error::UnknownRule`] for points out of range, [`Error::RankDeficient`] for a rule with
    /// zero-energy modes, [`Error::MissingForEffect`] for an effect that needs a bending rule. The
    /// cable is then as before.
    pub fn set_rule(&mut self, rule: Rule) -> Result<(), Error> {
        rule.check()?;
        self.redefine(rule, self.effects().clone(), self.integrator())
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn redefine(&mut self, rule: Rule, effects: Effects, integrator: Integrator) -> Result<(), Error> {
        let integrator = integrator.checked()?;
        let mut model = self.model.clone();
        model.rule = rule;
        model.effects = effects;
        model.check_effects().map_err(|e| e.of_cable(self.name()))?;
        check_integrator(&model, &integrator.method)?;
        self.rebuild(model)?;
        if self.model.effects.torsion.is_none() {
            self.snapshot.state.memory.torsion = None;
        }
        self.integrator = integrator;
        self.revise();
        Ok(())
    }
}
