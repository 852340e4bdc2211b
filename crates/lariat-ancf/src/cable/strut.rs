//! A straight cable under compression does not stand: each of its free spans is given the bend that
//! rounding would.
//!
//! # Equation
//!
//! A straight line is in equilibrium under any compression, in exact arithmetic for ever. Beyond
//! its Euler load it is unstable, and what grows from is whatever bends it. A free span, from one
//! held position to the next or to an end, that is straight to less than that and is pushed
//! anywhere by more than it can bear,
//!
//! ```text
//! max_e -EA eps_e > EI (pi/(2 l))^2        r_i += a sum_(k = 1..8) sin(k pi s_i/l)/8 n        a = 2^-23 l
//! ```
//!
//! is bent by `a`, which is the rounding of positions in single precision, in which hosts have
//! them. The slopes are bent with it. What is held stays. n is normal to the span: along x or y,
//! the one that is less along it.
//!
//! # Validity
//!
//! The bound is on the safe side for every set of supports. With phi the angle of a small bend, the
//! cable is unstable if `int EI phi'^2 + N phi^2 < 0`, so in one span by itself. Between two
//! supports phi has the mean zero, and at a clamp it is zero: there `int EI phi'^2 >= (pi/(2 l))^2
//! EI int phi^2`, after Wirtinger. A span beyond the last support shares its angle with those
//! before it, so that l is the whole cable, and half of the bound is left, for a pushed span before
//! it gives up to a quarter of its share. What turns about one point or moves freely, or hangs on
//! bodies alone, bears nothing.
//!
//! Below the load of its own supports a bent span straightens again, so the bend does nothing, and
//! is not made again until the compression is a quarter more, or the span was under tension. It
//! changes the energy by less than `2e-12 N l`. It is looked for when a step begins; a span that is
//! bent is left after its first elements.
//!
//! # References
//!
//! Euler 1744; Timoshenko & Gere 1961, sections 2.1 and 2.6; Hardy, Littlewood & Polya 1934,
//! section 7.7 (Wirtinger).
//!
//! # Alternatives considered
//!
//! The mean compression of the whole cable: a cable that is held between its ends, and hangs below,
//! stands above for ever; so does the lower half of one that is held at both ends. A law that
//! cannot push ([`AxialLaw::Rope`](crate::AxialLaw::Rope)): it is there, for cables that the user
//! calls ropes; rods push. A larger bend: it would make or take energy that is seen.

use super::Cable;
use crate::rule::BendingRule;
use crate::scales::cable::{BEND, BENT_AGAIN, COMPRESSED, COUPLED, UNBENT, WAVES};
use crate::support::{SlopeSupport, Support};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Free spans of a cable in their order, as far as they were looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spans {
    /// Node at which the next one begins, and its number.
    from: usize,
    number: usize,
}

/// A straight free span under compression.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strut {
    along: Vector3<f64>,
    /// Its first and its last node.
    nodes: [usize; 2],
    /// Its length in m.
    length: f64,
}

impl Cable {
    /// Bends the straight spans under compression; calls `before` with the cable if there are any,
    /// before it bends the first.
    pub(crate) fn bend_struts(&mut self, before: impl FnOnce(&Cable)) {
        let bent_at = &mut self.snapshot.state.memory.bent_at;
        bent_at.reserve((self.model.supports.len() + 1).saturating_sub(bent_at.len()));
        let (mut spans, mut before) = (Spans::default(), Some(before));
        while let Some(strut) = self.next_strut(&mut spans) {
            if let Some(before) = before.take() {
                before(self);
            }
            self.bend_strut(&strut);
        }
    }

    fn bend_strut(&mut self, strut: &Strut) {
        let &Strut { along, nodes: [first, last], length } = strut;
        let axis = if along.x.abs() <= along.y.abs() { Vector3::x() } else { Vector3::y() };
        let normal = (axis - along * along.dot(&axis)).normalize();
        let size = BEND * length / WAVES as f64;
        let mut from = 0.0;
        for node in first..=last {
            let support = self.model.support(node).copied().unwrap_or_default();
            let waves = (1..=WAVES).map(|k| k as f64 * PI / length);
            let (bend, slope) =
                waves.fold((0.0, 0.0), |(bend, slope), k| (bend + (k * from).sin(), slope + k * (k * from).cos()));
            let q = &mut self.snapshot.state.q[6 * node..6 * node + 6];
            if !support.holds_position() {
                (0..3).for_each(|i| q[i] += size * bend * normal[i]);
            }
            if support.slope == SlopeSupport::Free {
                (0..3).for_each(|i| q[3 + i] += size * slope * normal[i]);
            }
            from += self.model.elements.get(node).map_or(0.0, |element| element.length);
        }
    }

    /// Returns the next span that is straight, pushed by more than it can bear, and was not bent
    /// under such a load before, and notes that it is bent.
    fn next_strut(&mut self, spans: &mut Spans) -> Option<Strut> {
        let count = self.elements().len();
        while spans.from < count {
            let (first, number) = (spans.from, spans.number);
            let held =
                |(node, support): &(usize, Support)| (support.holds_position() && *node > first).then_some(*node);
            let last = self.model.supports.iter().find_map(held).unwrap_or(count);
            (spans.from, spans.number) = (last, number + 1);
            let Some(pushed) = self.pushed(first, last) else { continue };
            let Pushed { along, length, strain, force, .. } = pushed;
            let before = self.snapshot.state.memory.bent_at.get(number).copied().unwrap_or_default();
            let is_loaded = strain > COMPRESSED.max(BENT_AGAIN * before) && force > self.bears([first, last], length);
            let bent = strain.max(0.0);
            if (is_loaded || strain <= 0.0) && bent != before {
                let bent_at = &mut self.snapshot.state.memory.bent_at;
                bent_at.resize(bent_at.len().max(number + 1), 0.0);
                bent_at[number] = bent;
            }
            if is_loaded {
                return Some(Strut { along, nodes: [first, last], length });
            }
        }
        None
    }

    /// Returns what pushes a span between two nodes, if it is straight.
    fn pushed(&self, first: usize, last: usize) -> Option<Pushed> {
        let q = &self.snapshot.state.q;
        let part = |at: usize| Vector3::from_column_slice(&q[at..at + 3]);
        let start = part(6 * first);
        let along = (part(6 * first + 6) - start).try_normalize(0.0)?;
        let elements = &self.model.elements[first..last];
        let length: f64 = elements.iter().map(|element| element.length).sum();
        let off = |x: Vector3<f64>| (x - along * along.dot(&x)).amax();
        // a slope between two spans is that of both
        let bend = |node: usize| {
            let between = node == first && first > 0 || node == last && last < self.elements().len();
            let slope = if between { 0.0 } else { off(part(6 * node + 3)) };
            slope.max(off(part(6 * node) - start) / length)
        };
        let mut pushed =
            Pushed { along, length, off: bend(first), strain: f64::NEG_INFINITY, force: f64::NEG_INFINITY };
        let mut before = start;
        for (node, element) in (first + 1..).zip(elements) {
            if pushed.off > UNBENT * BEND {
                return None;
            }
            let (position, section) = (part(6 * node), &element.section);
            let shorter = 1.0 - (position - before).norm() / element.length;
            let force = shorter * section.axial_stiffness;
            pushed.off = pushed.off.max(bend(node));
            pushed.strain = pushed.strain.max(shorter);
            pushed.force = pushed.force.max(force);
            before = position;
        }
        (pushed.off <= UNBENT * BEND).then_some(pushed)
    }

    /// Returns the compression in N that a span of a length in m bears, whatever holds it.
    fn bears(&self, nodes: [usize; 2], length: f64) -> f64 {
        if self.model.rule.bending == BendingRule::None {
            return 0.0;
        }
        let least =
            self.elements().iter().map(|element| element.section.bending_stiffness).fold(f64::INFINITY, f64::min);
        let euler = |length: f64| least * (PI / (2.0 * length)).powi(2);
        let of = |node: usize| self.model.support(node).copied().unwrap_or_default();
        let fixed = |support: &Support| support.position.is_some();
        let turns = |support: &Support| !matches!(support.slope, SlopeSupport::Free | SlopeSupport::Attached(_));
        let ends = nodes.map(of);
        if ends.iter().all(fixed) || ends.iter().any(turns) {
            return euler(length);
        }
        let mut all = self.model.supports.iter().map(|(_, support)| support);
        let fixes = all.clone().filter(|support| fixed(support)).count();
        if fixes > 1 || all.any(turns) { COUPLED * euler(self.length()) } else { 0.0 }
    }
}

/// A span that is straight, or nearly so, and what pushes it.
struct Pushed {
    along: Vector3<f64>,
    /// Its length in m.
    length: f64,
    /// How far it is off the line over its length, and its slopes.
    off: f64,
    /// Largest shortening.
    strain: f64,
    /// Largest compression in N.
    force: f64,
}
