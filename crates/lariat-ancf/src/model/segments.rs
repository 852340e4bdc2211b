//! The segments of a cable with torsion.

use super::Model;
use crate::effect::torsion::segment::{Segment, follow_holds};
use crate::effect::torsion::stranded::Strands;
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
                Some(Segment::between(torsion, self.effects.rest_shape.as_ref(), &self.elements, [first, *node]))
            })
        })
    }

    /// Makes the twists of a state those of the segments.
    pub(crate) fn follow_holds(&self, segments: &[Segment], twists: &mut Option<Vec<SegmentTwist>>) {
        if let Some(torsion) = &self.effects.torsion {
            follow_holds(torsion, &self.elements, segments, twists);
        }
    }

    /// Returns the part in N of the tension over the stretch that the torque makes in an element of
    /// a stranded rope, and the number of the first element behind that has another torque.
    pub(crate) fn pull_of_torque(&self, e: usize, q: &[f64], twists: &Option<Vec<SegmentTwist>>) -> (f64, usize) {
        let beyond = self.elements.len();
        let Some(strands) = self.effects.torsion.as_ref().and_then(Strands::of) else { return (0.0, beyond) };
        let Some((number, segment)) = self.segments().enumerate().find(|(_, segment)| segment.nodes[1] > e) else {
            return (0.0, beyond);
        };
        if segment.nodes[0] > e {
            return (0.0, segment.nodes[0]);
        }
        let known = twists.as_ref().and_then(|twists| twists.get(number)).filter(|twist| twist.nodes == segment.nodes);
        let twist = known.map_or_else(
            || {
                let (segments, mut twists): (Vec<Segment>, _) = (self.segments().collect(), twists.clone());
                self.follow_holds(&segments, &mut twists);
                twists.and_then(|twists| Some(twists.get(number)?.twist)).unwrap_or(0.0)
            },
            |known| known.twist,
        );
        (strands.share(&self.elements[e]) * segment.torque(&self.elements, q, twist), segment.nodes[1])
    }

    fn holds_spin(&self, torsion: &Torsion, node: usize, support: &Support) -> bool {
        support.slope != SlopeSupport::Free && *self.end_spin(torsion, node) != EndSpin::Swivel
    }

    /// Returns how the spin of a node is held, if that is clamped.
    pub(crate) fn end_spin<'a>(&self, torsion: &'a Torsion, node: usize) -> &'a EndSpin {
        if node == 0 {
            &torsion.start
        } else if node == self.elements.len() {
            &torsion.end
        } else {
            &torsion.inner
        }
    }
}
