//! Potentials of the user's own, changed between steps.

use super::Cable;
use crate::at::At;
use crate::effect::potential::Potential;
use crate::error::Error;
use std::sync::Arc;

impl Cable {
    /// Adds an energy of your own of the point at a place, which stays with its material; see
    /// [`Potential`]. It acts in motion and in statics, on an island and beside contact, and its
    /// energy is in [`Energy::potentials`](crate::Energy::potentials). After a cable was read back
    /// from a file, add its potentials again in the same order: they are where they were.
    ///
    /// ```
    /// use lariat_ancf::{At, Cable, Potential, Section, Vector3};
    /// use std::sync::Arc;
    ///
    /// /// A spring of 20 N/m to the origin.
    /// #[derive(Debug)]
    /// struct Spring;
    ///
    /// impl Potential for Spring {
    ///     fn energy(&self, x: &Vector3<f64>) -> f64 {
    ///         10.0 * x.norm_squared()
    ///     }
    ///     fn gradient(&self, x: &Vector3<f64>) -> Vector3<f64> {
    ///         20.0 * x
    ///     }
    /// }
    ///
    /// let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    /// let mut cable = Cable::builder().points(points).section(Section::round(0.01, 1e8, 4000.0)?).fix(At::Start).build()?;
    /// cable.add_potential(At::End, Arc::new(Spring))?;
    /// cable.step(1.0 / 60.0)?;
    /// assert!(cable.energy().potentials < 40.0);
    /// # Ok::<(), lariat_ancf::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a place off the cable, [`Error::NotWithReel`] for one on the
    /// element at the eye of a reel.
    pub fn add_potential(&mut self, at: impl Into<At>, potential: Arc<dyn Potential>) -> Result<(), Error> {
        let (arc_length, passed) = (self.arc_length(at)?, self.snapshot.passed_at_start());
        let before = self.model.potentials.clone();
        self.model.potentials.add(arc_length, passed, potential);
        if let Err(error) = self.model.check_loads_at_eyes() {
            self.model.potentials = before;
            return Err(error.of_cable(self.name()));
        }
        self.system.potentials.locate(&self.model);
        if before.missing() == 0 {
            self.revise();
        }
        Ok(())
    }

    /// Returns the arc lengths in m at which potentials act, in their order.
    pub fn potentials(&self) -> impl Iterator<Item = f64> {
        self.model.potentials.list.iter().filter(|own| own.potential.is_some()).map(|own| own.arc_length)
    }

    /// Removes all potentials, missing ones included.
    pub fn clear_potentials(&mut self) {
        self.model.potentials.list.clear();
        self.system.potentials.locate(&self.model);
        self.revise();
    }
}
