//! Cutting a cable in two, without changing the shape or motion of either part.
//!
//! # Validity
//!
//! Any node between the ends. The tension at the cut is unbalanced from then on: a taut cable
//! whips, and needs an integrator with error control, or damping.
//!
//! # References
//!
//! The nodal coordinates of the cut are doubled ([`insert_node`](Cable::insert_node) places them
//! first): mass, momenta and kinetic energy of the parts sum to those of the whole to rounding. So
//! does elastic energy at a node; between two nodes the part before the cut records the difference
//! ([`inserted_energy`](crate::coupling::Coupling::inserted_energy)).

use crate::at::At;
use crate::cable::{Cable, Snapshot};
use crate::effect::Cut;
use crate::error::Error;
use crate::state::{Memory, SegmentTwist, State};
use crate::strength::LoadRecord;
use crate::support::Prescription;

impl Cable {
    /// Cuts the cable at a point: this one keeps the part before it, the rest is returned. A
    /// support or load at the point itself stays with this one. Effects act on both parts; their
    /// work so far, and the counters, stay with this one, reels with their ends.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the point is not on the cable, or at one of its ends;
    /// [`Error::NotWithReel`] if it is in the element at a reel.
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
        tail.name = format!("{}, cut off", self.model.name.trim_end_matches(", cut off"));
        tail.elements = head.elements.split_off(node);
        head.supports.retain(|(n, _)| *n <= node);
        tail.supports.retain(|(n, _)| *n > node);
        tail.supports.iter_mut().for_each(|(n, _)| *n -= node);
        head.loads.retain(|load| load.arc_length <= s);
        tail.loads.retain(|load| load.arc_length > s);
        tail.loads.iter_mut().for_each(|load| load.arc_length = (load.arc_length - s).min(length - s));
        // noted anew by the parts
        [&mut head, &mut tail].into_iter().for_each(|part| part.load_origins.clear());
        [head.effects, tail.effects] = self.model.effects.cut(Cut { node, elements: &self.model.elements });
        [head.reels, tail.reels] = self.model.reels.cut(self.number(node));
        tail.force_densities = self.model.force_densities.behind(s - self.snapshot.passed_at_start());
        tail.potentials = head.potentials.cut(s);
        let state = &self.snapshot.state;
        let twists = self.segments();
        let part = |q: &[f64], v: &[f64], first: usize| {
            let own = |twist: &SegmentTwist| {
                let [from, to] = twist.nodes;
                let nodes = [from.checked_sub(first)?, to - first];
                (nodes[1] < q.len() / 6).then_some(SegmentTwist { nodes, ..*twist })
            };
            // a segment that is cut has lost a hold, and its twist
            let torsion = self
                .model
                .effects
                .torsion
                .as_ref()
                .map(|_| twists.iter().filter_map(|(_, twist)| own(twist)).collect());
            let memory = Memory { torsion, ..Memory::default() };
            State { time: state.time, q: q.to_vec(), v: v.to_vec(), memory }
        };
        let (end, begin) = (6 * node + 6, 6 * node);
        let [at_start, at_end] = self.snapshot.windings;
        let mut head_state = Snapshot {
            state: part(&state.q[..end], &state.v[..end], 0),
            windings: [at_start, None],
            load: LoadRecord::default(),
            prescribed: self.snapshot.prescribed.iter().filter(|led| led.node <= node).copied().collect(),
            ..self.snapshot.clone()
        };
        // what earlier steps owe of the momenta is restored by this part, and what hangs on it
        head_state.state.memory.differences.owed = state.memory.differences.owed;
        let windings = [None, at_end];
        let mut tail_state =
            Snapshot { state: part(&state.q[begin..], &state.v[begin..], node), windings, ..Snapshot::default() };
        let led = self.snapshot.prescribed.iter().filter(|led| led.node > node);
        tail_state.prescribed = led.map(|led| Prescription { node: led.node - node, ..*led }).collect();
        let mut tail = Cable::from_parts(tail, tail_state, self.integrator)?;
        tail.set_watched(self.is_watched());
        let mut head = Cable::from_parts(head, head_state, self.integrator)?;
        head.diagnostics = self.diagnostics;
        head.watch = self.watch.take();
        head.revision = self.revision;
        head.revise();
        *self = head;
        Ok(tail)
    }
}
