//! What the condensed mass matrix of a cable depends on.
//!
//! The mass matrix of a cable stays the same from step to step, while its bodies move. It is
//! factored and condensed again only where something here has changed: the masses, by a reel, what
//! holds the cable, with the directions of clamps, or where it is cut.

use super::hold::Held;
use super::layout::Part;
use crate::cable::Cable;
use crate::linalg::MassMatrix;
use crate::support::Support;

/// The masses, supports and held coordinates for which a matrix was condensed.
#[derive(Clone, Debug, Default)]
pub(super) struct MassKey {
    /// Whether there is such a matrix.
    valid: bool,
    matrix: MassMatrix,
    supports: Vec<(usize, Support)>,
    held: Vec<Held>,
    cuts: Vec<usize>,
}

impl MassKey {
    /// Returns whether a matrix of the cable, and of its part of the island, would be the same.
    pub fn fits(&self, cable: &Cable, part: &Part) -> bool {
        self.valid
            && self.held == part.held
            && self.cuts == part.cuts
            && self.has_supports(&cable.model.supports)
            && self.matrix == *cable.system.mass.matrix()
    }

    /// Returns whether supports hold the same directions; how they move them does not matter.
    fn has_supports(&self, supports: &[(usize, Support)]) -> bool {
        let same = |((a, one), (b, other)): (&(usize, Support), &(usize, Support))| a == b && one.holds_as(other);
        self.supports.len() == supports.len() && self.supports.iter().zip(supports).all(same)
    }

    /// Makes it fit no cable.
    pub fn clear(&mut self) {
        self.valid = false;
    }

    /// Makes it that of a matrix that was condensed.
    pub fn set(&mut self, cable: &Cable, part: &Part) {
        let MassMatrix { diag, lower } = cable.system.mass.matrix();
        self.matrix.diag.clone_from(diag);
        self.matrix.lower.clone_from(lower);
        self.supports.clone_from(&cable.model.supports);
        self.held.clone_from(&part.held);
        self.cuts.clone_from(&part.cuts);
        self.valid = true;
    }
}
