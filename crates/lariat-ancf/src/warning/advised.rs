//! A mesh that a warning advises.

use crate::at::At;
use core::fmt;
use serde::{Deserialize, Serialize};

/// A mesh that would do: so many elements, and if they are not even, their length in m at points of
/// the cable.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct AdvisedMesh {
    /// Number of elements.
    pub elements: usize,
    /// Length in m of those at the points, for [`finest`](crate::CableBuilder::finest).
    pub finest_m: Option<f64>,
    /// The points.
    pub at: Vec<At>,
}

impl fmt::Display for AdvisedMesh {
    /// As scenes write it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let AdvisedMesh { elements, finest_m: Some(finest), at } = self else {
            return write!(f, "elements = {}", self.elements);
        };
        write!(f, "elements = {{ count = {elements}, finest = {}, at = [", significant(*finest))?;
        for (k, at) in at.iter().enumerate() {
            f.write_str(if k == 0 { "" } else { ", " })?;
            match at {
                At::Start => write!(f, "\"start\""),
                At::End => write!(f, "\"end\""),
                At::ArcLength(s) => write!(f, "{s}"),
                At::Node(node) => write!(f, "node {node}"),
            }?;
        }
        write!(f, "] }}")
    }
}

/// Returns a number with two digits, rounded down.
fn significant(x: f64) -> f64 {
    let unit = 10f64.powf(x.log10().floor() - 1.0);
    let digits = (x / unit).floor();
    if unit < 1.0 { digits / (1.0 / unit).round() } else { digits * unit }
}
