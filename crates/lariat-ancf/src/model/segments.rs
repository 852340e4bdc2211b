//! The segments of a cable with torsion.

use super::Model;
use crate::effect::torsion::segment::{Segment, follow_holds};
use crate::effect::{EndSpin, Torsion};
use crate::state::SegmentTwist;
use crate::support::{SlopeSupport, Support};

impl Model {
    /// Finds the segments between nodes that hold the spin; none without torsion.
    pub(crate) fn find_segments(&self, out: &mut Vec<Segment>) {
        out.clear();
        out.extend(self.segments());
    }

    /// Returns them.
    pub(crate) fn segments(&self) -> impl Iterator<Item = Segment> + '_ {
        self.effects.torsion.iter().flat_map(move |torsion| {
            let mut before = None;
            let holds = self.supports.iter().filter(move |(node, support)| self.holds_spin(torsion, *node, support));
            holds.filter_map(move |(node, _)| {
                let first = before.replace(*node)?;
                Some(Segment::between(torsion, &self.elements, [first, *node]))
            })
        })
    }

    /// Makes the twists of a state those of the segments.
    pub(crate) fn follow_holds(&self, segments: &[Segment], twists: &mut Option<Vec<SegmentTwist>>) {
        if let Some(torsion) = &self.effects.torsion {
            follow_holds(torsion, &self.elements, segments, twists);
        }
    }

    fn holds_spin(&self, torsion: &Torsion, node: usize, support: &Support) -> bool {
        support.slope != SlopeSupport::Free && self.end_spin(torsion, node) != EndSpin::Swivel
    }

    /// Returns how the spin of a node is held, if that is clamped.
    pub(crate) fn end_spin(&self, torsion: &Torsion, node: usize) -> EndSpin {
        if node == 0 {
            torsion.start
        } else if node == self.elements.len() {
            torsion.end
        } else {
            EndSpin::Held
        }
    }
}
