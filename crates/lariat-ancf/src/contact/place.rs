//! A place of a cable beside an obstacle.

/// Where a cable is in an obstacle, or went through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Arc length in m.
    pub arc_length: f64,
    /// Key of the obstacle.
    pub obstacle: u64,
}
