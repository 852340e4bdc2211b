//! Tension and strain read from the coordinates of a cable, between steps and within them, and the
//! largest load.
//!
//! # Equation
//!
//! `N = EA (eps + that of effects) f` with the Green strain eps that the rule resists, as far as it
//! is linear in an element ([`axial`](crate::element::axial)), averaged at nodes, and the strain
//! `f/f_0 - 1`, f_0 the rest stretch: what strains the material, where
//! [`Cable::sample`](crate::Cable::sample) reads what equilibrium asks for. Both are largest at
//! ends of elements. An element at the eye of a reel is read at the length that it has at the time
//! of the reading.
//!
//! What a limit is compared with is the elastic part: what holds the material together is strained,
//! and a cable breaks at the same strain however it is damped.
//!
//! # Validity
//!
//! A cable with a limit of its load is read at the beginning of a host step and after every
//! integration step that is accepted, with each method; one without never, which the counter
//! `load_readings` shows.
//!
//! # Alternatives considered
//!
//! The whole tension, that of damping included: the same fall broke a rope at 5.8 % strain with 1
//! ms of damping and at 0.04 % with 10 ms.
//!
//! Only the end of host steps: a rope that is loaded at once broke at 1.28 of its limit at 30 Hz,
//! and a peak between two host steps broke nothing.

use super::{Equations, System};
use crate::element::gram::{gram, gram_rates};
use crate::element::kernel::GramState;
use crate::element::variable_length::Extent;
use crate::model::Model;
use crate::state::SegmentTwist;
use crate::strength::{Load, Strength};
use nalgebra::Vector3;

/// A cable in a state, to be read.
#[derive(Clone, Copy)]
pub(crate) struct Reading<'a> {
    pub model: &'a Model,
    pub system: &'a System,
    /// Nodal coordinates and velocities.
    pub q: &'a [f64],
    pub v: &'a [f64],
    /// Time in s.
    pub time: f64,
    /// What is known of the twists of a cable with torsion.
    pub twists: &'a Option<Vec<SegmentTwist>>,
}

/// Tension in N and Green strain, as the rule sees it, at a point of an element.
#[derive(Clone, Copy)]
pub(crate) struct Pull {
    pub tension: f64,
    /// Stretch.
    stretch: f64,
    pub green_strain: f64,
}

impl Pull {
    /// Adds a force over the stretch, in N.
    fn with(self, force: f64) -> Self {
        if force == 0.0 { self } else { Pull { tension: self.tension + force * self.stretch, ..self } }
    }
}

/// Tension at a node in N: what the elements before and behind it miss to the average, and the jump
/// between them.
#[derive(Clone, Copy)]
pub(crate) struct NodeTension {
    pub missing: [f64; 2],
    pub jump: f64,
}

/// Returns what the tension of an element misses at both its ends to those averages that there are.
pub(crate) fn missing_at_ends(before: Option<NodeTension>, behind: Option<NodeTension>) -> [f64; 2] {
    let [start, end] = [before.map(|node| node.missing[1]), behind.map(|node| node.missing[0])];
    let start = start.or(end.map(|end| -end)).unwrap_or(0.0);
    [start, end.unwrap_or(-start)]
}

impl<'a> Reading<'a> {
    /// Returns an element as effects see it, with rates of the Gram numbers if they are asked for.
    pub fn state(&self, e: usize, rates: bool) -> GramState<'a, f64> {
        let elements = &self.system.forces.elements;
        let v = if rates { self.v } else { &[] };
        let feed = self.system.feeds.list.iter().find(|feed| feed.side.element(elements.count()) == e);
        let Some(feed) = feed else { return elements.gram_state(e, self.q, v) };
        let Extent { length, rate, .. } = feed.at(self.time);
        let of = |x: &[f64]| elements.control_at(e, x, 3.0 / length);
        let d = of(self.q);
        let rates = rates.then(|| {
            let mut rates = gram_rates(&d, &of(self.v));
            // the control vector of the chord changes with the length, too
            let change = gram_rates(&d, &[[0.0; 3], d[1].map(|x| -x * rate / length), [0.0; 3]]);
            rates.iter_mut().zip(change).for_each(|(rate, change)| *rate += change);
            rates
        });
        GramState { table: &elements.table, stiffness: elements.stiffness(e), g: gram(&d), rates }
    }

    /// Returns them at a local coordinate of an element, from its state, without the part that a
    /// [torque](Model::pull_of_torque) makes.
    fn pull_without_torque(&self, e: usize, xi: f64, state: &GramState<'_, f64>) -> Pull {
        let green_strain = state.table.strain(&state.g, xi);
        let of_effects = self.system.forces.strain_of_effects(e, xi, state);
        let stretch = (1.0 + 2.0 * green_strain).max(0.0).sqrt();
        let stress = (green_strain + of_effects) * stretch;
        Pull { tension: self.model.axial_stiffness(&self.model.elements[e]) * stress, stretch, green_strain }
    }

    /// Returns what the torque of a stranded rope adds to the tension over the stretch of an
    /// element, in N.
    fn pull_of_torque(&self, e: usize) -> f64 {
        self.model.pull_of_torque(e, self.q, self.twists).0
    }

    /// Returns tension and strain at a local coordinate of an element, from its state.
    pub fn pull(&self, e: usize, xi: f64, state: &GramState<'_, f64>) -> Pull {
        self.pull_without_torque(e, xi, state).with(self.pull_of_torque(e))
    }

    /// Returns the elastic tension in N at local coordinates of an element.
    pub fn tensions(&self, e: usize, at: [f64; 2]) -> [f64; 2] {
        let state = self.state(e, false);
        at.map(|xi| self.pull_without_torque(e, xi, &state).tension)
    }

    /// Returns tension and strain at both ends of an element.
    pub fn ends(&self, e: usize) -> [Pull; 2] {
        let of_torque = self.pull_of_torque(e);
        self.ends_in(e, self.system.forces.in_element.is_some()).map(|pull| pull.with(of_torque))
    }

    /// Returns tension and strain at both ends of an element, without the tension of damping;
    /// `of_torque` is what a torque adds, and the first element that has another one.
    fn elastic_ends(&self, e: usize, of_torque: &mut (f64, usize)) -> [Pull; 2] {
        if e >= of_torque.1 {
            *of_torque = self.model.pull_of_torque(e, self.q, self.twists);
        }
        self.ends_in(e, false).map(|pull| pull.with(of_torque.0))
    }

    fn ends_in(&self, e: usize, rates: bool) -> [Pull; 2] {
        let state = self.state(e, rates);
        [0.0, 1.0].map(|xi| self.pull_without_torque(e, xi, &state))
    }

    /// Returns the tension at a node between two elements at an arc length in m, if it is
    /// continuous there; `before` and `behind` are read there.
    pub fn at_node(&self, node: usize, s: f64, before: Pull, behind: Pull) -> Option<NodeTension> {
        if !self.model.is_smooth_at(node, s) {
            return None;
        }
        let [a, b] = [node - 1, node].map(|e| self.model.elements[e].length);
        let average = (b * before.tension + a * behind.tension) / (a + b);
        let missing = [average - before.tension, average - behind.tension];
        Some(NodeTension { missing, jump: (before.tension - behind.tension).abs() })
    }

    /// Returns the strain energy in J.
    pub fn strain_energy(&self) -> f64 {
        let (axial, bending) = self.system.forces.strain_energy(self.q);
        axial + bending
    }

    /// Returns the energy in J by which the cable can recoil at most: its strain energy, the
    /// kinetic energy of its motion about its centre of mass, and that of the centre as seen from
    /// the node from which it moves fastest, as from one that is held.
    pub fn recoil_energy(&self) -> f64 {
        let mass = self.system.mass.matrix();
        let (total, (nodes, _)) = (mass.total(), self.v.as_chunks::<6>());
        let centre = Vector3::from(mass.momentum(self.v)) / total;
        let kinetic = 0.5 * mass.quadratic(self.v) - 0.5 * total * centre.norm_squared();
        let from = |node: &[f64; 6]| (centre - Vector3::new(node[0], node[1], node[2])).norm_squared();
        let fastest = nodes.iter().map(from).fold(0.0, f64::max);
        self.strain_energy() + kinetic.max(0.0) + 0.5 * total * fastest
    }

    /// Returns the load that is the largest share of its limit, read at both ends of every element.
    pub fn largest_load(&self, strength: Strength) -> Load {
        let elements = &self.model.elements;
        let rest_shape = self.model.effects.rest_shape.as_ref();
        let mut worst = Load { time: self.time, ..Load::default() };
        let of_torque = &mut self.model.pull_of_torque(0, self.q, self.twists);
        let (mut from, mut before, mut ends) = (0.0, None, self.elastic_ends(0, of_torque));
        let mut at = (0, 0);
        for (e, element) in elements.iter().enumerate() {
            let to = from + element.length;
            let next = if e + 1 < elements.len() { Some(self.elastic_ends(e + 1, of_torque)) } else { None };
            let behind = next.and_then(|next| self.at_node(e + 1, to, ends[1], next[0]));
            let rest = rest_shape.map_or(1.0, |shape| shape.at(from + 0.5 * element.length).0);
            for (end, ((s, pull), missing)) in
                [from, to].into_iter().zip(ends).zip(missing_at_ends(before, behind)).enumerate()
            {
                let tension = pull.tension + missing;
                let strain = (1.0 + 2.0 * pull.green_strain).max(0.0).sqrt() / rest - 1.0;
                let (share, cause) = strength.share(tension, strain);
                if share > worst.share {
                    worst = Load { share, cause, arc_length: s, tension, damping: 0.0, strain, time: self.time };
                    at = (e, end);
                }
            }
            (from, before) = (to, behind);
            ends = next.unwrap_or(ends);
        }
        if self.system.forces.in_element.is_some() {
            let (e, end) = at;
            worst.damping = self.ends_in(e, true)[end].tension - self.ends_in(e, false)[end].tension;
        }
        worst
    }
}

impl Equations<'_> {
    /// Reads the load of a cable that has a limit, once at each time.
    pub fn note_load(&mut self, time: f64, [q, v]: [&[f64]; 2], twists: &Option<Vec<SegmentTwist>>) {
        let strength = self.model.strength;
        if !strength.is_limited() || self.system.load.is_at(time) {
            return;
        }
        self.diagnostics.load_readings += self.model.elements.len() as u64;
        let reading = Reading { model: self.model, system: self.system, q, v, time, twists };
        let load = reading.largest_load(strength);
        let recoils = self.system.load.recoil(time).is_some();
        let energies = recoils.then(|| (reading.recoil_energy(), reading.strain_energy()));
        let is_recoil = energies.is_some_and(|(left, strained)| {
            self.system.load.lower_recoil(left);
            self.system.load.recoil(time).is_some_and(|own| own.explains(time, strained))
        });
        self.system.load.note(load, is_recoil);
    }
}
