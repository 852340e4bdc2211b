//! What a step does not take up of the energy that the one before it left in the store.
//!
//! # Equation
//!
//! ```text
//! (1 - k^2 a/a') S        S = a'/2 (|O v|^2 + |O y|^2 + |O d|^2)
//! ```
//!
//! k is the [share of the changes](crate::one_leg) that counts in the step, which is below 1 in a
//! shorter one, and a its dissipation; a prime is that of the step before. The law of the step is
//! about what it takes up, so that this is lost beside it.
//!
//! # Validity
//!
//! Exact, since the store is quadratic in the changes; of bodies with the inertia of the present
//! host step, which in general is another one than that of the last where joints hold them.

use super::IslandStep;
use super::body::BodyStep;

impl IslandStep<'_, '_> {
    /// Returns the energy in J that the present step, before it is accepted, does not take up.
    pub(super) fn energy_shortened(&mut self) -> f64 {
        let mut lost = 0.0;
        for cable in self.cables.iter() {
            let (step, differences) = (&cable.step_buffers, &cable.snapshot.state.memory.differences);
            let share = step.leg.share_held(differences.dissipation, step.kept);
            if share < 1.0 && !differences.is_empty() {
                lost += (1.0 - share) * cable.energy_in_store_by(&mut self.buffers.of_store);
            }
        }
        let bodies = &self.buffers.bodies;
        lost += bodies.iter().map(BodyStep::energy_shortened).sum::<f64>();
        for c in &self.buffers.coupled {
            let [one, two] = c.bodies.map(|i| bodies[i].change_shortened());
            lost += one.dot(&(c.matrix * two));
        }
        lost
    }
}
