//! How a cable was drawn and laid, for those who lay it anew.

use super::unstrained::Kept;
use nalgebra::Vector3;

/// Coordinates of a cable before and after parts with free ends were turned.
#[derive(Clone, Debug)]
pub(super) struct AsDrawn {
    pub drawn: Vec<f64>,
    pub turned: Vec<f64>,
}

/// How a slack cable was drawn and laid.
#[derive(Clone, Debug)]
pub(super) struct Sagging {
    pub points: Vec<Vector3<f64>>,
    pub kept: Vec<Kept>,
    pub laid: Vec<f64>,
}
