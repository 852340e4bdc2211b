//! The twist of a cable with torsion, as part of its state.

use crate::error::{Error, require};
use nalgebra::{Quaternion, UnitQuaternion};
use serde::{Deserialize, Serialize};

/// Twist of the material between two neighbouring nodes that hold its spin. Plain data, part of a
/// snapshot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SegmentTwist {
    /// The two nodes, ascending.
    pub nodes: [usize; 2],
    /// Twist in rad, right-handed positive, whole turns included.
    pub twist: f64,
    /// Its change in the last step of the discrete gradient.
    pub change: f64,
    /// Attitude (w, x, y, z) of the bodies that hold both nodes, at the end of the last step;
    /// `None` on supports.
    pub attitudes: [Option<[f64; 4]>; 2],
}

impl SegmentTwist {
    /// Turns the bodies that hold both nodes, with the cable: its twist stays.
    pub(super) fn turn(&mut self, turn: &UnitQuaternion<f64>) {
        for attitude in self.attitudes.iter_mut().flatten() {
            let [w, i, j, k] = *attitude;
            let turned = turn * UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
            *attitude = [turned.w, turned.i, turned.j, turned.k];
        }
    }

    /// Checks that its numbers are finite.
    pub(super) fn check(&self) -> Result<(), Error> {
        let attitudes = self.attitudes.iter().flatten().flatten();
        let mut all = [self.twist, self.change].into_iter().chain(attitudes.copied());
        all.try_for_each(|x| require("twist of the state", x, true, "a number"))
    }
}
