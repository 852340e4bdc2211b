//! All contacts between the cables of a system over a step.

use super::super::ContactBalance;
use super::super::lag::{lag, renew};
use super::super::law::NormalLaw;
use super::super::point::ContactPoint;
use super::chords::{Piece, Strand};
use super::columns::{PairColumns, PairEnd};
use super::passage::Passage;
use super::point::{PairPoint, frame};
use super::search::{Candidate, Crossed, Search};
use super::strands::Strands;
use crate::one_leg::OneLeg;
use crate::scales::contact::{CLOSING_TIME, DEVIATION, HAND_ON, LAG, NEAR_PAIR, ONE, PAID};
use crate::scales::island::MAX_SEARCHES;
use crate::state::ContactMemory;
use crate::state::PairMemory;
use nalgebra::Vector3;

/// The contacts between cables in a step; empty where none are near.
#[derive(Clone, Debug, Default)]
pub(crate) struct PairStep {
    pub(super) points: Vec<PairPoint>,
    search: Search,
    /// By strand, the change of its coordinates with which the search was made.
    searched: Vec<Vec<f64>>,
    /// By strand, what of its memory was taken up.
    taken: Vec<Vec<bool>>,
    /// Length of the step in s.
    pub(super) h: f64,
    pub(super) leg: OneLeg,
    /// Energy in J that the contacts store at the beginning.
    before: f64,
    /// Energy in J that was remembered: what of it no contact begins with is lost.
    stored: f64,
    /// Where strands go through each other in the step.
    crossed: Option<Crossed>,
    /// Number of searches.
    searches: usize,
    /// Whether friction missed its bounds when that was last asked.
    pub lags: bool,
    /// Whether any cable can touch another or itself.
    on: bool,
    /// Those that have a tangent, as columns of the linear equations.
    pub columns: Vec<PairColumns>,
}

impl PairStep {
    /// Returns whether nothing is near.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Returns the number of contacts that are evaluated.
    pub fn count(&self) -> u64 {
        self.points.len() as u64
    }

    /// Returns the number of tests of whether pieces of cables are near each other, since that was
    /// last asked.
    pub fn take_tests(&mut self) -> u64 {
        core::mem::take(&mut self.search.tests)
    }

    /// Begins a step of length `h` (s); contacts close offsets if `close`.
    pub fn begin(&mut self, (h, leg): (f64, OneLeg), close: bool, strands: &Strands<'_, '_>) {
        self.points.clear();
        (self.h, self.leg, self.before, self.stored, self.searches) = (h, leg, 0.0, 0.0, 0);
        self.on = (0..strands.count).any(|c| strands.may_touch(c));
        self.columns.clear();
        self.lags = false;
        if !self.on {
            return;
        }
        self.taken.resize_with(strands.count, Vec::new);
        for (c, taken) in self.taken.iter_mut().enumerate() {
            taken.clear();
            let memory = (strands.get)(c).memory;
            taken.resize(memory.len(), false);
            self.stored += memory.iter().map(|memory| memory.contact.energy).sum::<f64>();
        }
        self.look(strands, NEAR_PAIR);
        self.hand_over(strands);
        if close {
            self.close_offsets(strands);
        }
        self.start(strands, 0);
    }

    /// Gives the energy of contacts that none took up to the nearest one that has an offset: one
    /// that slides over the end of a chord to what has begun beside it. What is not given is lost,
    /// and strands would sink by the depth of a load at each chord.
    fn hand_over(&mut self, strands: &Strands<'_, '_>) {
        for a in 0..strands.count {
            let memory = (strands.get)(a).memory;
            for (memory, taken) in memory.iter().zip(&mut self.taken[a]).filter(|(_, taken)| !**taken) {
                let mut best: Option<(f64, usize)> = None;
                for (k, pair) in self.points.iter().enumerate().filter(|(_, pair)| pair.ends[0].strand == a) {
                    let other = (strands.get)(pair.ends[1].strand);
                    let passed = [(strands.get)(a).passed, other.passed];
                    let apart = memory.apart([0, 1].map(|k| pair.from[k] - passed[k]));
                    let may = memory.contact.obstacle == other.key && pair.point.offset > 0.0;
                    if may && apart < HAND_ON * pair.reach && best.is_none_or(|(least, _)| apart < least) {
                        best = Some((apart, k));
                    }
                }
                if let Some((_, k)) = best {
                    *taken = true;
                    self.points[k].point.take_up(memory.contact.energy);
                }
            }
        }
    }

    /// Closes offsets, by a share of what friction and damping took in the last step: as long as
    /// they take as much in this one, that makes no energy.
    fn close_offsets(&mut self, strands: &Strands<'_, '_>) {
        let friction =
            |strand: &Strand<'_>| strand.memory.iter().map(|memory| memory.contact.friction_power).sum::<f64>();
        let powers = (0..strands.count).map(|c| (strands.get)(c)).map(|strand| friction(&strand) + strand.damped);
        let budget = PAID * powers.sum::<f64>() * self.h;
        let points = self.points.iter().map(|pair| &pair.point);
        let share = ContactPoint::affordable_share(points, (self.h / CLOSING_TIME).min(1.0), budget);
        self.points.iter_mut().for_each(|pair| pair.point.close(share));
    }

    /// Begins the step of the contacts from one on: what does not come fast, but is pressed or
    /// lies, has the law of its depth, but for what bounces.
    fn start(&mut self, strands: &Strands<'_, '_>, first: usize) {
        for pair in &mut self.points[first..] {
            if pair.point.speed > 0.0 || pair.point.bounces() {
                let pieces = pair.ends.map(|end| Piece::new((strands.get)(end.strand), end.element));
                let opens = pair.opens(pieces.each_ref());
                pair.point.find_law(opens, (self.h, self.leg.b));
            }
            self.before += pair.point.energy_before();
        }
    }

    /// Searches again if an iterate is far from that of the last search, and adds what it finds.
    pub fn complete(&mut self, strands: &Strands<'_, '_>) {
        if self.on
            && self.searches < MAX_SEARCHES
            && (0..strands.count).any(|c| deviates(&(strands.get)(c), &self.searched[c]))
        {
            let known = self.points.len();
            self.look(strands, 0.0);
            self.start(strands, known);
        }
    }

    /// Returns whether centre lines go through each other in the step.
    pub fn crosses(&mut self, strands: &Strands<'_, '_>) -> bool {
        self.crossed = None;
        if !self.on {
            return false;
        }
        if (0..strands.count).any(|c| deviates(&(strands.get)(c), &self.searched[c])) {
            self.search.find_near(strands);
        }
        self.crossed = self.search.crossing(strands);
        self.crossed.is_some()
    }

    /// Returns where strands went through each other when that was last asked.
    pub fn crossed(&self) -> Option<Crossed> {
        self.crossed
    }

    fn look(&mut self, strands: &Strands<'_, '_>, near: f64) {
        self.searched.resize_with(strands.count, Vec::new);
        for (c, searched) in self.searched.iter_mut().enumerate() {
            searched.clear();
            searched.extend_from_slice((strands.get)(c).change);
        }
        self.searches += 1;
        let mut search = core::mem::take(&mut self.search);
        search.run(strands, near);
        let known = self.points.len();
        for candidate in &search.found {
            let same = |point: &PairPoint| {
                let [one, other] = &point.ends;
                [one.strand, other.strand] == candidate.strands
                    && (one.element, one.chord) == (candidate.elements[0], candidate.chords[0])
                    && (other.arc - candidate.arcs[1]).abs() < candidate.reach
            };
            if !self.points[..known].iter().any(same) {
                self.add(strands, candidate);
            }
        }
        self.search = search;
    }

    fn add(&mut self, strands: &Strands<'_, '_>, candidate: &Candidate) {
        let own = candidate.strands.map(|c| (strands.get)(c));
        let sections = [0, 1].map(|k| &own[k].model.elements[candidate.elements[k]]);
        let (Some(one), Some(other)) = (own[0].model.effects.contact, own[1].model.effects.contact) else { return };
        let Some([friction, restitution]) = strands.coefficients(candidate.strands[0], candidate.strands[1]) else {
            return;
        };
        let pieces = [0, 1].map(|k| Piece::new(own[k], candidate.elements[k]));
        let passage = Passage::new(pieces.each_ref(), candidate.chords[0], candidate.xi);
        let from = [0, 1].map(|k| candidate.arcs[k] + (passage.start[k] - candidate.xi[k]) * pieces[k].length);
        // what begins where another one does is the same contact
        let is_known = |pair: &PairPoint| {
            let apart = |k: usize| (pair.from[k] - from[k]).abs();
            pair.ends.map(|end| end.strand) == candidate.strands && apart(0) + apart(1) < ONE * candidate.reach
        };
        if passage.apart.norm() < candidate.reach && self.points.iter().any(is_known) {
            return;
        }
        let places = [0, 1].map(|k| pieces[k].place(candidate.xi[k]));
        let memory = self.recall(strands, (candidate, from), (places[0][1] - places[1][1]).norm());
        let apart = places[0][0] - places[1][0];
        let point = ContactPoint {
            key: (candidate.elements[0] as u32, own[1].key, candidate.elements[1] as u32),
            weight: pieces[0].length / pieces[0].chords as f64,
            law: NormalLaw::in_series(
                NormalLaw::of(&one, &sections[0].section),
                NormalLaw::of(&other, &sections[1].section),
            ),
            mass: reduced(sections.map(|section| section.section.mass_per_length)),
            friction,
            restitution,
            ..ContactPoint::default()
        };
        let mut pair = PairPoint::new(candidate, from, point, self.h);
        match &memory {
            Some(memory) => pair.pass(pieces.each_ref(), &passage, &memory.normal),
            None => {
                // the side on which they are when it begins
                let normal = if candidate.normal.dot(&apart) < 0.0 { -candidate.normal } else { candidate.normal };
                pair.put(pieces.each_ref(), candidate.xi, normal);
                pair.point.reach = candidate.reach;
            }
        }
        let point = &mut pair.point;
        let still = frame(Vector3::zeros(), self.h);
        let start = point.start;
        point.recall(&start, &still, memory.as_ref());
        self.points.push(pair);
    }

    /// Returns the nearest contact that the cables remember and that none took up.
    fn recall(
        &mut self,
        strands: &Strands<'_, '_>,
        (candidate, from): (&Candidate, [f64; 2]),
        way: f64,
    ) -> Option<ContactMemory> {
        let [a, b] = candidate.strands;
        let key = (strands.get)(b).key;
        let arcs = [0, 1].map(|k| from[k] - (strands.get)(candidate.strands[k]).passed);
        let limit = HAND_ON * candidate.reach + 2.0 * way;
        let mut best: Option<(f64, usize)> = None;
        for (i, memory) in (strands.get)(a).memory.iter().enumerate() {
            let apart = memory.apart(arcs);
            let may = memory.contact.obstacle == key && !self.taken[a][i] && apart < limit;
            if may && best.is_none_or(|(least, _)| apart < least) {
                best = Some((apart, i));
            }
        }
        let (_, i) = best?;
        self.taken[a][i] = true;
        Some((strands.get)(a).memory[i].contact)
    }

    /// Returns the sum in N by which friction misses its bounds by the normal forces of the present
    /// iterate, and notes whether that is much.
    pub fn find_lag(&mut self) -> f64 {
        let [missed, all] = lag(self.points.iter().map(|pair| &pair.point));
        self.lags = missed > LAG * all;
        missed
    }

    /// Sets the bounds of friction by the normal forces of the present iterate.
    pub fn renew_friction(&mut self) {
        renew(self.points.iter_mut().map(|pair| &mut pair.point));
    }

    /// Returns whether a strand has a contact.
    pub fn has(&self, strand: usize) -> bool {
        self.points.iter().any(|pair| pair.ends.iter().any(|end| end.strand == strand))
    }

    /// Returns whether a strand touches when the step ends.
    pub fn touches(&self, strand: usize) -> bool {
        let mut touching = self.points.iter().filter(|pair| pair.point.now.normal_force > 0.0);
        touching.any(|pair| pair.ends.iter().any(|end| end.strand == strand))
    }

    /// Makes the contacts linear at the present iterate, as columns of the linear equations.
    pub fn linearise(&mut self, strands: &Strands<'_, '_>) {
        self.columns.clear();
        for pair in &mut self.points {
            pair.linearise(pair.ends.map(|end| (strands.get)(end.strand)).each_ref());
            let tangents = pair.point.linear.tangents;
            let tangent = (tangents.normal + tangents.friction) * (self.leg.b * self.h * self.h);
            let eigen = tangent.symmetric_eigen();
            let most = eigen.eigenvalues.amax();
            let mut out =
                pair.ends.map(|end| PairEnd { strand: end.strand, element: end.element, columns: [[0.0; 12]; 3] });
            for k in (0..3).filter(|&k| eigen.eigenvalues[k] > 1e-12 * most) {
                let forces = pair.forces(&(eigen.eigenvectors.column(k) * eigen.eigenvalues[k].sqrt()));
                out.iter_mut().zip(forces).for_each(|(end, force)| end.columns[k] = force);
            }
            if most > 0.0 {
                self.columns.push(out);
            }
        }
    }

    /// Passes h times the forces to `add`, by strand and element: those at the iterate, or those
    /// about which the next solve is linear.
    pub fn pass_impulses(&self, linear: bool, mut add: impl FnMut(usize, usize, &[f64; 12])) {
        for pair in &self.points {
            let force = if linear { pair.point.linear.force } else { pair.point.now.force };
            if force != Vector3::zeros() {
                let forces = pair.forces(&(force * self.h));
                for (end, force) in pair.ends.iter().zip(&forces) {
                    add(end.strand, end.element, force);
                }
            }
        }
    }

    /// Evaluates the contacts at the present iterate, and returns what they do.
    pub fn balance(&mut self, strands: &Strands<'_, '_>) -> ContactBalance {
        let left = (self.stored - self.before).max(0.0);
        let mut sum = ContactBalance { before: self.before, left, ..ContactBalance::default() };
        for pair in &mut self.points {
            let [missed, work] = pair.follow(pair.ends.map(|end| (strands.get)(end.strand)).each_ref());
            let now = &pair.point.now;
            sum.missed += missed;
            sum.work += work;
            sum.forces += now.force.norm();
            sum.loss += now.loss;
            sum.obstacles += now.work;
        }
        sum
    }

    /// Remembers the contacts of a strand that touch at the end of the step; `passed` is the length
    /// in m that came through the eye at the start of one.
    pub fn remember(&self, strand: usize, passed: impl Fn(usize) -> f64, memory: &mut Vec<PairMemory>) {
        memory.clear();
        let touching = self.points.iter().filter(|pair| pair.ends[0].strand == strand && pair.point.is_kept());
        memory.extend(touching.map(|pair| PairMemory {
            contact: in_world_axes(pair),
            arcs: pair.ends.map(|end| end.arc),
            passed: pair.ends.map(|end| passed(end.strand)),
        }));
    }
}

/// Returns the mass per length of the relative motion of two.
fn reduced([one, other]: [f64; 2]) -> f64 {
    one * other / (one + other)
}

/// Returns whether an iterate is far from another change of coordinates.
fn deviates(strand: &Strand<'_>, searched: &[f64]) -> bool {
    let Some(contact) = strand.model.effects.contact else { return false };
    let elements = &strand.model.elements;
    strand.change.chunks_exact(6).zip(searched.chunks_exact(6)).enumerate().any(|(node, (now, then))| {
        let element = &elements[node.min(elements.len() - 1)];
        let apart = |x: usize| Vector3::from_fn(|k, _| now[x + k] - then[x + k]).norm();
        apart(0) + apart(3) * element.length / 3.0 > DEVIATION * contact.radius_of(&element.section)
    })
}

/// Returns what is remembered of a contact, in world axes: those of the next frame.
fn in_world_axes(pair: &PairPoint) -> ContactMemory {
    let contact = pair.point.memory(&pair.frame);
    let speed = if pair.point.restitution == 0.0 { pair.point.speed_after(pair.frame.h) } else { 0.0 };
    ContactMemory { speed, normal: contact.direction, spring: pair.frame.end.rotation * contact.spring, ..contact }
}
