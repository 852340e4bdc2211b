//! Right-hand sides that are put aside while others are solved for.

/// Right-hand sides that are put aside, by cable, and of the bodies.
#[derive(Clone, Debug, Default)]
pub(in crate::island) struct Aside {
    pub(super) cables: Vec<Vec<f64>>,
    pub(super) rows: Vec<f64>,
}
