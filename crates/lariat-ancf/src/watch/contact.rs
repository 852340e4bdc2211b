//! What is kept of contacts to judge the mesh beside them.

use serde::{Deserialize, Serialize};

/// What a cable did beside what it touches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Contacts {
    pub(crate) depth: Excess,
    pub(crate) turn: Excess,
    #[serde(default)]
    pub(crate) touchdown: Excess,
    #[serde(default)]
    pub(crate) pried: Excess,
    /// Key of the obstacle in which the cable was deepest when obstacles came, its arc length there
    /// and its depth, in m.
    #[serde(default)]
    pub(crate) inside: Option<(u64, [f64; 2])>,
    #[serde(default)]
    pub(crate) facets: Facets,
    /// Its contact with a cable that pushes most, as long as that sticks.
    #[serde(default)]
    pub(crate) sticking: Option<Sticking>,
    /// The longest that ran over another one while it stuck in m, and its arc length.
    #[serde(default)]
    pub(crate) run: [f64; 2],
}

/// How far a cable slid along itself over facets about which it bends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Facets {
    /// Way in m.
    pub(crate) slid: f64,
    /// Time in s when it was read last.
    pub(crate) at: Option<f64>,
}

/// A contact of two cables that sticks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sticking {
    /// Key of the other cable.
    pub(crate) other: u64,
    /// Arc lengths in m along both, of material, when that began and now.
    pub(crate) start: [f64; 2],
    pub(crate) now: [f64; 2],
}

/// How far a reading exceeds its limit, and since when.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Excess {
    pub(crate) since: Option<f64>,
    /// The least of the readings since then, with its arc length in m.
    pub(crate) least: [f64; 2],
    /// The largest that lasted long enough, with its arc length in m.
    pub(crate) worst: [f64; 2],
}
