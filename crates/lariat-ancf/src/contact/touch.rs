//! What is read of contacts with obstacles.

use nalgebra::Vector3;

/// A contact of a cable with an obstacle, as it was at the end of the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Touch {
    /// Key of the obstacle.
    pub obstacle: u64,
    /// Arc length in m of the point that touches.
    pub arc_length: f64,
    /// Outward normal of the obstacle.
    pub normal: Vector3<f64>,
    /// Normal force in N, > 0: the obstacle pushes the cable along the normal.
    pub normal_force: f64,
    /// Friction on the cable in N.
    pub friction: Vector3<f64>,
    /// Depth in m by which the cable's surface is in the obstacle, offset and all.
    pub depth: f64,
    /// Whether it slips.
    pub slips: bool,
}

/// Where a cable is in an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Overlap {
    /// Key of the obstacle.
    pub obstacle: u64,
    /// Arc length in m of the deepest point.
    pub arc_length: f64,
    /// Its depth in m.
    pub depth: f64,
    /// Whether the centre line itself runs through the obstacle there, and is not a bulge between
    /// contacts that keep it out.
    pub crosses: bool,
}
