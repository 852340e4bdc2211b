//! Which chords of two elements come near each other in a step, by halves.
//!
//! # Equation
//!
//! The chords from s0 to s1 along an element are in the ball about the middle of the ends of that
//! part with the radius
//!
//! ```text
//! R = |r(s1) - r(s0)|/2 + (s1 - s0)^2/8 max |r''|
//! ```
//!
//! and move, beside those of another part, no further than the ends beside each other and the same
//! second term of their changes: r'' is linear in s, so its largest values are at the ends of the
//! element. Two parts whose balls are further apart than way and reach hold no chords that are
//! near.
//!
//! # Validity
//!
//! Two elements that meet in few chords cost some tests per halving and per chord that is near,
//! whatever the number of their chords.

use super::chords::Piece;
use crate::element::shape::{combine, second_derivative};
use crate::scales::contact::{APART, FEW, NEAR_PAIR, ROUNDED};
use core::f64::consts::SQRT_2;
use core::ops::Range;
use nalgebra::Vector3;

/// Two elements, of which chords can touch.
pub(super) struct Near<'a> {
    pub pieces: [Piece<'a>; 2],
    /// Where their chords are in the list.
    pub slots: [usize; 2],
    /// Arc lengths in m at which they begin.
    pub from: [f64; 2],
    /// Sum of the radii in m.
    pub reach: f64,
    /// Whether they are of one strand.
    pub same: bool,
}

/// A chord at the beginning of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord {
    /// Its ends, each with its change over the step.
    ends: [[Vector3<f64>; 2]; 2],
    middle: Vector3<f64>,
    /// Half of its length in m.
    half: f64,
    /// Largest way of its ends in m.
    way: f64,
}

/// Two chords at the beginning of a step, with their changes.
pub(super) struct ChordPair {
    pub one: [[Vector3<f64>; 2]; 2],
    pub other: [[Vector3<f64>; 2]; 2],
    /// Half of the sum of their lengths in m.
    pub size: f64,
    /// Largest way in m of an end beside one of the other.
    pub way: f64,
    /// Distance in m of their middles.
    pub apart: f64,
    /// Distance in m of their middles along the cable.
    pub along: f64,
}

/// The chords that were asked for in a search.
#[derive(Clone, Debug, Default)]
pub(super) struct Chords {
    /// By slot, where a chord is in the list, and one more; 0 of one that was not asked for.
    slots: Vec<usize>,
    list: Vec<Chord>,
}

impl Chords {
    pub fn clear(&mut self) {
        self.slots.clear();
        self.list.clear();
    }

    /// Returns the first of a number of new slots.
    pub fn reserve(&mut self, count: usize) -> usize {
        let first = self.slots.len();
        self.slots.resize(first + count, 0);
        first
    }

    /// Returns a chord of one of two elements.
    fn of(&mut self, near: &Near<'_>, k: usize, chord: usize) -> Chord {
        let slot = &mut self.slots[near.slots[k] + chord];
        if *slot == 0 {
            let ends = [near.place(k, chord), near.place(k, chord + 1)];
            let [[a, da], [b, db]] = ends;
            let (half, way) = (0.5 * (b - a).norm(), da.norm().max(db.norm()));
            self.list.push(Chord { ends, middle: 0.5 * (a + b), half, way });
            *slot = self.list.len();
        }
        self.list[*slot - 1]
    }
}

impl Near<'_> {
    fn place(&self, k: usize, chord: usize) -> [Vector3<f64>; 2] {
        self.pieces[k].place(chord as f64 / self.pieces[k].chords as f64)
    }

    fn arc(&self, k: usize, chord: usize, at: f64) -> f64 {
        let piece = &self.pieces[k];
        self.from[k] + (chord as f64 + at) * piece.length / piece.chords as f64
    }

    /// Returns arc lengths in m of points of two chords, given as shares of these.
    pub fn arcs(&self, [i, j]: [usize; 2], at: [f64; 2]) -> [f64; 2] {
        [self.arc(0, i, at[0]), self.arc(1, j, at[1])]
    }

    /// Returns whether two chords are further apart than both move, whatever their directions.
    fn are_far(&self, a: &Chord, b: &Chord) -> bool {
        let reach = a.half + b.half + a.way + b.way + self.reach * (1.0 + NEAR_PAIR);
        (a.middle - b.middle).norm_squared() > ROUNDED * reach * reach
    }

    /// Returns two chords by their numbers.
    pub fn pair(&self, chords: &mut Chords, [i, j]: [usize; 2]) -> ChordPair {
        let [one, other] = [(0, i), (1, j)].map(|(k, chord)| chords.of(self, k, chord));
        self.pair_of([i, j], &one, &other)
    }

    fn pair_of(&self, [i, j]: [usize; 2], one: &Chord, other: &Chord) -> ChordPair {
        let (one, other) = (one.ends, other.ends);
        let ([a0, a1], [b0, b1]) = (one, other);
        let relative = |p: [Vector3<f64>; 2], q: [Vector3<f64>; 2]| (p[1] - q[1]).norm();
        let way = relative(a0, b0).max(relative(a0, b1)).max(relative(a1, b0)).max(relative(a1, b1));
        let size = 0.5 * ((a1[0] - a0[0]).norm() + (b1[0] - b0[0]).norm());
        let middles = 0.5 * (a0[0] + a1[0] - b0[0] - b1[0]);
        let [s, t] = self.arcs([i, j], [0.5; 2]);
        ChordPair { one, other, size, way, apart: middles.norm(), along: (s - t).abs() }
    }

    /// Returns whether chords are so near along a cable that they do not touch.
    pub fn is_joined(&self, chords: &ChordPair) -> bool {
        self.same && chords.along + 2.0 * chords.size < APART * self.reach
    }
}

/// Buffers of the search.
#[derive(Clone, Debug, Default)]
pub(super) struct Halves {
    open: Vec<[Range<usize>; 2]>,
    /// Numbers of the chords that are near each other, in ascending order.
    pub found: Vec<[usize; 2]>,
}

impl Halves {
    /// Finds the chords of two elements that are near each other at some time of the step, and
    /// returns the number of tests.
    pub fn find(&mut self, near: &Near<'_>, store: &mut Chords) -> u64 {
        self.found.clear();
        self.open.clear();
        self.open.push(near.pieces.map(|piece| 0..piece.chords));
        let bends = near.pieces.map(|piece| piece.bend());
        let mut tests = 0;
        while let Some([one, other]) = self.open.pop() {
            let few = one.len() <= FEW && other.len() <= FEW;
            let all = near.pieces[0].chords <= FEW && near.pieces[1].chords <= FEW;
            if !all {
                tests += 1;
                if near.are_apart([&one, &other], &bends) {
                    continue;
                }
            }
            if few {
                tests += (one.len() * other.len()) as u64;
                for i in one {
                    let first = store.of(near, 0, i);
                    for j in other.clone() {
                        let second = store.of(near, 1, j);
                        if near.are_far(&first, &second) {
                            continue;
                        }
                        let chords = near.pair_of([i, j], &first, &second);
                        let is_near = chords.apart <= chords.size + chords.way + near.reach * (1.0 + NEAR_PAIR);
                        if is_near && !near.is_joined(&chords) {
                            self.found.push([i, j]);
                        }
                    }
                }
            } else if one.len() >= other.len() {
                let middle = one.start + one.len() / 2;
                self.open.push([one.start..middle, other.clone()]);
                self.open.push([middle..one.end, other]);
            } else {
                let middle = other.start + other.len() / 2;
                self.open.push([one.clone(), other.start..middle]);
                self.open.push([one, middle..other.end]);
            }
        }
        self.found.sort_unstable();
        tests
    }
}

impl Near<'_> {
    /// Returns whether parts of the elements hold no chords that are near each other; `bends` are
    /// the largest second derivatives of both elements.
    fn are_apart(&self, parts: [&Range<usize>; 2], bends: &[[f64; 2]; 2]) -> bool {
        let ends = [0, 1].map(|k| [self.place(k, parts[k].start), self.place(k, parts[k].end)]);
        let sagitta = |k: usize, of: usize| {
            let length = parts[k].len() as f64 * self.pieces[k].length / self.pieces[k].chords as f64;
            0.125 * length * length * bends[k][of]
        };
        let radius = |k: usize| 0.5 * (ends[k][1][0] - ends[k][0][0]).norm() + sagitta(k, 0);
        let middle = |k: usize| 0.5 * (ends[k][0][0] + ends[k][1][0]);
        let ways = ends[0].iter().flat_map(|a| ends[1].iter().map(move |b| (a[1] - b[1]).norm()));
        let way = ways.fold(0.0, f64::max) + sagitta(0, 1) + sagitta(1, 1);
        // the middle of a chord in a ball, and half of the chord, are together within sqrt(2) radii
        // of its middle
        let reach = SQRT_2 * (radius(0) + radius(1)) + way + self.reach * (1.0 + NEAR_PAIR);
        (middle(0) - middle(1)).norm() > reach
    }
}

impl Piece<'_> {
    /// Returns the largest |r''| at the beginning of the step, and that of its change.
    fn bend(&self) -> [f64; 2] {
        let ends = [0.0, 1.0].map(|xi| second_derivative(xi, self.length));
        [self.strand.q, self.strand.change]
            .map(|x| ends.iter().map(|shape| combine(x, self.element, shape).norm()).fold(0.0, f64::max))
    }
}

#[cfg(test)]
mod tests {
    use super::super::boxes::Boxes;
    use super::super::chords::Strand;
    use super::super::strands::Strands;
    use super::*;
    use crate::{Cable, Contact, Section};

    fn cable(elements: usize) -> Cable {
        let points = [Vector3::zeros(), Vector3::new(elements as f64, 0.0, 0.0)];
        let section = Section::from_stiffness(1e5, 1e-2, 0.1).unwrap();
        let contact = Contact::default().with_radius(0.02).with_cables();
        let mut cable = Cable::builder().points(points).section(section).elements(elements).build().unwrap();
        cable.set_contact(contact).unwrap();
        cable
    }

    /// Numbers from -1 to 1.
    fn random() -> impl FnMut() -> f64 {
        let mut x = 0.617;
        move || {
            x = (x * 997.0 + 0.123_f64).fract();
            2.0 * x - 1.0
        }
    }

    /// The chords that are found are those that a comparison of all finds, although curves as wild
    /// as these, a tenth of whose chords are near each other, take half of its tests.
    ///
    /// *Source.* All pairs of chords of random curves that move.
    #[test]
    fn halves_find_what_all_pairs_do() {
        let (cable, mut next) = (cable(2), random());
        let (mut halves, mut tests, mut compared, mut found) = (Halves::default(), 0, 0, 0);
        for round in 0..200 {
            let way = [0.0, 0.01, 0.5][round % 3];
            let q: Vec<f64> = (0..18).map(|_| next()).collect();
            let change: Vec<f64> = (0..18).map(|_| way * next()).collect();
            let model = &cable.model;
            let strand =
                Strand { key: 1, model, q: &q, change: &change, velocity: &[], memory: &[], damped: 0.0, passed: 0.0 };
            let pieces = [Piece::new(strand, 0), Piece::new(strand, 1)];
            let mut store = Chords::default();
            let slots = pieces.map(|piece| store.reserve(piece.chords));
            let near = Near { pieces, slots, from: [0.0, 1.0], reach: 0.04, same: round % 2 == 0 };
            tests += halves.find(&near, &mut store);
            let mut expected = Vec::new();
            for i in 0..pieces[0].chords {
                for j in 0..pieces[1].chords {
                    let chords = near.pair(&mut store, [i, j]);
                    let reach = chords.size + chords.way + near.reach * (1.0 + NEAR_PAIR);
                    if chords.apart <= reach && !near.is_joined(&chords) {
                        expected.push([i, j]);
                    }
                    compared += 1;
                }
            }
            assert_eq!(halves.found, expected, "{round}");
            found += expected.len();
        }
        println!("{found} of {compared} chords are near: {tests} tests");
        assert!(found > 1000 && 2 * tests < compared, "{found} {tests} {compared}");
    }

    /// Elements that are left out because they follow each other straight have no points eight
    /// radii apart along them that are nearer than two reaches, at either end of the step.
    ///
    /// *Source.* Distances of all points of a fine grid on curves that bend at random.
    #[test]
    fn straight_elements_cannot_touch() {
        let (cable, mut next) = (cable(4), random());
        let (mut boxes, mut left, mut bent) = (Boxes::default(), 0, 0);
        for _ in 0..400 {
            let bend = 0.5 * (1.0 + next());
            let mut q = Vec::new();
            for node in 0..5 {
                q.extend([f64::from(node) + 0.3 * bend * next(), bend * next(), bend * next()]);
                q.extend([1.0 + 0.5 * bend * next(), bend * next(), bend * next()]);
            }
            let change: Vec<f64> = (0..30).map(|_| 0.2 * bend * next()).collect();
            let model = &cable.model;
            let strand =
                Strand { key: 1, model, q: &q, change: &change, velocity: &[], memory: &[], damped: 0.0, passed: 0.0 };
            let strands = Strands { count: 1, get: &|_| strand, over_bodies: &|_, _| f64::INFINITY, pairs: None };
            boxes.find(&strands);
            for first in 0..3 {
                if boxes.near.iter().any(|pair| pair.map(|own| own.element) == [first, first + 1]) {
                    bent += 1;
                    continue;
                }
                left += 1;
                for share in [0.0, 1.0] {
                    let at = |k: i32| {
                        let (e, s) = (first + (k / 50) as usize, f64::from(k % 50) / 50.0);
                        Piece::new(strand, e).at(s, share)
                    };
                    for i in 0..100 {
                        for j in i + 8..100 {
                            assert!((at(i) - at(j)).norm() > 0.08, "{first} {i} {j}");
                        }
                    }
                }
            }
        }
        assert!(left > 50 && bent > 200, "{left} {bent}");
    }

    /// A chain that moves at random, slowly or by more than the margins of its boxes in a step: no
    /// two of its elements that a kept tree says are not near have points eight radii apart along
    /// them that are nearer than two reaches; and the tree is kept in most slow steps.
    ///
    /// *Source.* Distances of all points of a grid on all pairs of elements.
    #[test]
    fn what_a_kept_tree_leaves_out_is_not_near() {
        let (cable, mut next) = (cable(8), random());
        let (mut left, mut made, mut steps) = (0, 0, 0);
        for run in 0..30 {
            let size = if run % 3 == 0 { 0.3 } else { 0.004 };
            let mut boxes = Boxes::default();
            let mut q: Vec<f64> = (0..9)
                .flat_map(|node| {
                    let at = [0.7 * f64::from(node), 0.0, 0.0].map(|x| x + 0.4 * next());
                    let slope = [1.0 + 0.3 * next(), 0.4 * next(), 0.4 * next()];
                    at.into_iter().chain(slope)
                })
                .collect();
            for _ in 0..40 {
                let change: Vec<f64> = (0..54).map(|_| size * next()).collect();
                let strand = Strand {
                    key: 1,
                    model: &cable.model,
                    q: &q,
                    change: &change,
                    velocity: &[],
                    memory: &[],
                    damped: 0.0,
                    passed: 0.0,
                };
                let strands = Strands { count: 1, get: &|_| strand, over_bodies: &|_, _| f64::INFINITY, pairs: None };
                let tests = boxes.find(&strands);
                (made, steps) = (made + u64::from(tests > 28), steps + 1);
                for (first, second) in (0..8).flat_map(|i| (i + 1..8).map(move |j| (i, j))) {
                    if boxes.near.iter().any(|pair| pair.map(|own| own.element) == [first, second]) {
                        continue;
                    }
                    left += 1;
                    for share in [0.0, 1.0] {
                        for (a, b) in (0..20).flat_map(|a| (0..20).map(move |b| (a, b))) {
                            let along = (second - first) as f64 + f64::from(b - a) / 20.0;
                            let [x, y] = [(first, a), (second, b)]
                                .map(|(e, k)| Piece::new(strand, e).at(f64::from(k) / 20.0, share));
                            assert!(along < 0.16 || (x - y).norm() > 0.08, "{first} {second} {along}");
                        }
                    }
                }
                q.iter_mut().zip(&change).for_each(|(x, dx)| *x += dx);
            }
        }
        println!("{left} pairs left out, {made} of {steps} steps made a tree");
        assert!(left > 5000 && made < steps * 3 / 4, "{left} {made} {steps}");
    }
}
