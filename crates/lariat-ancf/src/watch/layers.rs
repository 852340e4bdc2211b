//! What is kept of the [layers](crate::cable) at clamps and loads that the mesh does not resolve.

use serde::{Deserialize, Serialize};

/// The worst of them so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Layers {
    /// The moment that is the most too large, if one is.
    #[serde(default)]
    pub(crate) moment: Option<CoarseMoment>,
    /// Largest error of position, if one is too large.
    #[serde(default)]
    pub(crate) kink: Option<CoarseKink>,
}

/// A moment that is too large.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct CoarseMoment {
    /// Arc length in m.
    pub(crate) at: f64,
    /// Moments in N m: of the mesh and of the elastica.
    pub(crate) moments: [f64; 2],
    /// Length of the layer in m.
    pub(crate) scale: f64,
}

/// A kink that is smeared over an element.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct CoarseKink {
    /// Arc length in m.
    pub(crate) at: f64,
    /// Error of position in m.
    pub(crate) error: f64,
    /// Length of the element in m.
    pub(crate) element: f64,
}
