//! The shock of a point that is given another velocity at once.
//!
//! # Equation
//!
//! A jump of the velocity by v at a point sends a wave along the cable, with the force
//!
//! ```text
//! F_a = v_a sqrt(EA m)      of the part v_a along the cable
//! F_t = v_t sqrt(T m)       of the part v_t across it, under the tension T
//! ```
//!
//! m the mass per length. It is compared with what pulls there anyway: the largest of the tension,
//! the weight of the cable, that of what hangs there, and the force of the least strain of a run. A
//! wave of a share s of the tension has a share s^2 of the strain energy.
//!
//! # Validity
//!
//! Small strain. The force is an upper bound for a body that is not much heavier than the cable
//! that the wave has passed; of two parts that meet at the point, each has its own wave.
//!
//! # References
//!
//! Characteristic impedance of a rod and of a string: Graff, Wave Motion in Elastic Solids, 1975,
//! sections 2.1 and 1.1.

use crate::cable::Cable;
use crate::error::Error;
use crate::scales::watch::{LEAST_STRAIN_OF_RUN, SHOCK};
use crate::warning::balance::weight_and_stiffness;
use nalgebra::Vector3;

/// The shock of a jump of the velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shock {
    /// Force of the wave in N.
    pub force: f64,
    /// That over what pulls there anyway.
    pub share: f64,
}

impl Shock {
    /// Returns whether it is worth a warning: its wave has more energy than a run may lose.
    pub fn is_large(&self) -> bool {
        self.share > SHOCK
    }
}

impl Cable {
    /// Returns the shock of a jump of the velocity (m/s) at an arc length (m), where a weight (N)
    /// hangs.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an arc length beyond the ends.
    pub fn shock(&self, arc_length: f64, jump: &Vector3<f64>, weight: f64) -> Result<Shock, Error> {
        let sample = self.sample(arc_length)?;
        let (element, _) = self.model.locate(self.on_cable(arc_length)?);
        let section = self.elements()[element].section;
        let along = jump.dot(&sample.slope) / sample.slope.norm();
        let across = (jump.norm_squared() - along * along).max(0.0).sqrt();
        let impedance = |force: f64| (force.max(0.0) * section.mass_per_length).sqrt();
        let force = (along * impedance(section.axial_stiffness)).hypot(across * impedance(sample.tension));
        let least = LEAST_STRAIN_OF_RUN * section.axial_stiffness;
        let pull = sample.tension.max(weight).max(weight_and_stiffness(self).0).max(least);
        Ok(Shock { force, share: force / pull })
    }
}
