//! What is read of contacts between cables.

use nalgebra::Vector3;

/// A contact of a cable with a cable, or with itself, as it was at the end of the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PairTouch {
    /// [Key](crate::coupling::Coupling::set_contact_key) of the other cable.
    pub other: u64,
    /// Arc length in m of the point that touches.
    pub arc_length: f64,
    /// Arc length in m along the other cable.
    pub other_arc_length: f64,
    /// Unit normal, from the other cable to this one.
    pub normal: Vector3<f64>,
    /// Normal force in N, > 0.
    pub normal_force: f64,
    /// Friction on this cable in N.
    pub friction: Vector3<f64>,
    /// Depth in m by which the surfaces are in each other.
    pub depth: f64,
    /// Whether it slips.
    pub slips: bool,
}

impl PairTouch {
    /// Returns it as the other cable has it; `key` is that of this one.
    pub fn mirrored(self, key: u64) -> Self {
        PairTouch {
            other: key,
            arc_length: self.other_arc_length,
            other_arc_length: self.arc_length,
            normal: -self.normal,
            friction: -self.friction,
            ..self
        }
    }
}
