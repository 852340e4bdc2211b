//! The angular velocity of a kinematic body that Rapier does not carry out.
//!
//! # Equation
//! ```text
//! asked = |w|        turned = |log(R1 R0')|/h        lost where |asked - turned| > s asked
//! ```
//! w is the angular velocity that the user gives to a body which Rapier moves by its velocity, R0
//! and R1 are its attitudes at both ends of a Rapier step of h, a prime is the transpose. Rapier
//! turns a body by at most pi/4 in a step, unless it is allowed to rotate fast, and in each of n
//! substeps by 2 atan(|w| h/(2 n)) instead of |w| h/n; beyond half a turn, poses tell the shorter
//! way alone, and it is what cables follow.

use crate::body::pose::OriginPose;
use crate::scales::body::LOST_SPIN;
use ::nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Angular velocities of a body in a Rapier step, in rad/s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LostSpin {
    pub asked: f64,
    pub turned: f64,
}

impl LostSpin {
    /// Returns what is lost of the angular velocity `spin` between two poses `h` (s) apart.
    fn between([start, end]: &[OriginPose; 2], spin: &Vector3<f64>, h: f64) -> Option<Self> {
        let (asked, turned) = (spin.norm(), start.1.angle_to(&end.1) / h);
        ((asked - turned).abs() > LOST_SPIN * asked).then_some(LostSpin { asked, turned })
    }

    /// Returns the share that is lost.
    fn share(&self) -> f64 {
        (self.asked - self.turned).abs() / self.asked
    }
}

/// The largest share that a body lost so far.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct SpinWatch {
    worst: Option<LostSpin>,
    told: bool,
}

impl SpinWatch {
    /// Reads a Rapier step.
    pub fn note(&mut self, poses: &[OriginPose; 2], spin: &Vector3<f64>, h: f64) {
        let lost = LostSpin::between(poses, spin, h);
        let larger = |lost: &LostSpin| self.worst.is_none_or(|worst| lost.share() > worst.share());
        self.worst = lost.filter(larger).or(self.worst);
    }

    /// Returns the worst step, if there was one.
    pub fn worst(&self) -> Option<LostSpin> {
        self.worst
    }

    /// Returns the worst step, until it was told.
    pub fn due(&self) -> Option<LostSpin> {
        self.worst.filter(|_| !self.told)
    }

    /// What was due has been told.
    pub fn set_told(&mut self) {
        self.told = self.worst.is_some();
    }
}
