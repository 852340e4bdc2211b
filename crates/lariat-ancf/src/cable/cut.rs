//! Cutting a cable in two, without changing the shape or motion of either part.
//!
//! *Source.* The nodal coordinates of the cut are doubled ([`insert_node`](Cable::insert_node) places them first): mass, momenta and kinetic
//! energy of the parts sum to those of the whole to rounding. *Validity.* Any node between the ends. The tension at the cut
//! has nothing to act against from then on: a taut cable whips, and wants an integrator with error control or damping.

use super::{At, Cable, Snapshot};
use crate::effect::Cut;
use crate::error::Error;
use crate::integrate::{Memory, State};

impl Cable {
    /// Cuts the cable at a point: this one keeps what is before it, the rest is returned. What holds or loads the point itself stays with
    /// this one. Effects go on in both; their work so far, and the counts, stay with this one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the point is not on the cable, or at one of its ends.
    pub fn cut(&mut self, at: impl Into<At>) -> Result<Cable, Error> {
        let s = self.arc_length(at)?;
        let length = self.length();
        if s <= 1e-9 * length || s >= length * (1.0 - 1e-9) {
            let cable = self.name().to_string();
            return Err(Error::OutOfRange {
                cable,
                what: "arc length of a cut must lie between the ends:",
                value: s,
                limit: length,
            });
        }
        let node = self.insert_node(At::ArcLength(s))?;
        let s = self.node_arc_lengths()[node];
        let (mut head, mut tail) = (self.model.clone(), self.model.clone());
        tail.name = format!("{}, cut off", self.model.name);
        tail.elements = head.elements.split_off(node);
        head.supports.retain(|(n, _)| *n <= node);
        tail.supports.retain(|(n, _)| *n > node);
        tail.supports.iter_mut().for_each(|(n, _)| *n -= node);
        head.loads.retain(|load| load.arc_length <= s);
        tail.loads.retain(|load| load.arc_length > s);
        tail.loads.iter_mut().for_each(|load| load.arc_length = (load.arc_length - s).min(length - s));
        [head.effects, tail.effects] = self.model.effects.cut(Cut { node, elements: &self.model.elements });
        let phase = &self.state.phase;
        let part =
            |q: &[f64], v: &[f64]| State { time: phase.time, q: q.to_vec(), v: v.to_vec(), memory: Memory::default() };
        let (end, begin) = (6 * node + 6, 6 * node);
        let head_state = Snapshot { phase: part(&phase.q[..end], &phase.v[..end]), work: self.state.work };
        let tail_state = Snapshot { phase: part(&phase.q[begin..], &phase.v[begin..]), ..Snapshot::default() };
        let tail = Cable::from_parts(tail, tail_state, self.integrator)?;
        let mut head = Cable::from_parts(head, head_state, self.integrator)?;
        head.diagnostics = self.diagnostics;
        head.revision = self.revision;
        head.revise();
        *self = head;
        Ok(tail)
    }

    /// Where the tension is largest, as arc length in m, and how large it is there in N: read at both ends of every element, between which it
    /// is linear but for the stretch. A point load inside an element makes the reading overshoot at its ends: place a node there.
    pub fn peak_tension(&self) -> (f64, f64) {
        let mut peak = (0.0, f64::NEG_INFINITY);
        let mut from = 0.0;
        for (e, element) in self.elements().iter().enumerate() {
            for xi in [0.0, 1.0] {
                let tension = self.sample_in(e, xi).tension;
                if tension > peak.1 {
                    peak = (from + xi * element.length, tension);
                }
            }
            from += element.length;
        }
        peak
    }
}
