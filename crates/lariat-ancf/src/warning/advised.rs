//! A mesh that a warning advises.

use crate::at::At;
use crate::scales::watch::MOST;
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
    /// As Rust writes it; see [`Interface`](super::Interface).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "elements({})", self.elements)?;
        let Some(finest) = self.finest_m else { return Ok(()) };
        write!(f, ".finest({}, [", significant(finest))?;
        for (k, at) in self.at.iter().enumerate() {
            f.write_str(if k == 0 { "" } else { ", " })?;
            match at {
                At::Start => write!(f, "At::Start"),
                At::End => write!(f, "At::End"),
                At::ArcLength(s) => write!(f, "At::ArcLength({s})"),
                At::Node(node) => write!(f, "At::Node({node})"),
            }?;
        }
        write!(f, "])")
    }
}

/// Returns a number with two digits, rounded down.
fn significant(x: f64) -> f64 {
    let unit = 10f64.powf(x.log10().floor() - 1.0);
    let digits = (x / unit).floor();
    if unit < 1.0 { digits / (1.0 / unit).round() } else { digits * unit }
}

/// Returns a number of elements that makes an error `factor` times smaller, if it falls with the
/// power 2.5 of the element length: smooth shapes that are resolved converge with 3 to 4, the
/// falling pendulum from 2 to 8 elements with 2 to 3.
pub(super) fn more(elements: usize, factor: f64) -> usize {
    (elements as f64 * factor.powf(0.4)).ceil().min(MOST) as usize
}
