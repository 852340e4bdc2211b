//! What was done about contacts in the present step.

use crate::contact::ContactBalance;

/// Rounds of the iteration that contacts asked for, and what they found.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::island) struct ContactRounds {
    /// Number of times that bounds of friction were set.
    pub(super) renewals: usize,
    /// Number of times that contacts were looked for again and found.
    pub(super) searches: usize,
    /// Whether contacts are missing still, if that is known.
    pub(super) missed: Option<bool>,
    /// Whether something goes through something else.
    pub(super) passes: bool,
    /// What contacts between cables do in the iterate.
    pub(super) pairs: Option<ContactBalance>,
}
