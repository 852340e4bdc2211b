//! The momentum of cables whose ends are driven, as the impulses at the pins that drive them.
//!
//! # Equation
//!
//! A step from x0, v0 to x1, v1 leaves in every row of a cable an impulse and so, in all, an
//! angular impulse about the origin
//!
//! ```text
//! f = h F - M (v1 - v0)          A = sum x_m x f - sum (x1 - x0) x M (v0 + v1)/2          x_m = (x0 + x1)/2
//! ```
//!
//! with the mean force F of the method. At held rows f is the reaction. At others it is what
//! Newton's iteration left, what a rescaled step took from the velocities and, of methods that
//! prescribe the ends of a step, the error of their quadrature. A cable gains this momentum all the
//! same, so the pins give it: f acts through displacements `w_p` that are linear between held
//! nodes,
//!
//! ```text
//! J_p = sum_i w_p(i) f_i          sum_p w_p = 1          sum_p J_p = impulse of loads - change of momentum
//! ```
//!
//! to rounding. Clamps take what is then left of A, in equal parts, where all that holds the cable
//! are driven pins.
//!
//! # Validity
//!
//! Pins on driven bodies; others have no host that could lose momentum, and take nothing of f. The
//! discrete gradient takes F and A from its own equations; others by the trapezoidal rule over each
//! of their steps, so the impulse of loads that change with time or state is of that order.
//!
//! # References
//!
//! Virtual work.

use super::layout::Layout;
use crate::cable::Cable;
use crate::state::State;
use nalgebra::Vector3;

use super::hold::vector;

/// A node whose position is held; the pin if that is on a driven body.
#[derive(Clone, Copy, Debug)]
struct Held {
    node: usize,
    pin: Option<usize>,
}

/// Forces and momenta of all rows at one time.
#[derive(Clone, Debug, Default)]
struct Reading {
    force: Vec<f64>,
    momentum: Vec<f64>,
    /// By cable, the sums of `x x force` and `x x momentum`.
    moments: Vec<[Vector3<f64>; 2]>,
}

/// What the pins take, over a host step.
#[derive(Clone, Debug, Default)]
pub(super) struct PinMomentum {
    /// Held nodes of all cables in order, and where those of each begin.
    held: Vec<Held>,
    first: Vec<usize>,
    /// By pin, the impulse to add to its account.
    pub impulses: Vec<Vector3<f64>>,
    /// By cable, A.
    angular: Vec<Vector3<f64>>,
    /// By pin, where the node was when the host step began.
    places: Vec<Vector3<f64>>,
    readings: [Reading; 2],
    /// Rows of one cable.
    field: Vec<f64>,
}

/// Returns the sum of `x x p` over all vectors (r, t) of nodes.
fn moment(q: &[f64], p: &[f64]) -> Vector3<f64> {
    q.chunks_exact(3).zip(p.chunks_exact(3)).map(|(q, p)| vector(q).cross(&vector(p))).sum()
}

impl PinMomentum {
    /// Begins a host step.
    pub fn begin(&mut self, cables: &[&mut Cable], layout: &Layout) {
        self.held.clear();
        self.first.clear();
        self.impulses.clear();
        self.angular.clear();
        self.places.clear();
        let driven = |body: usize| layout.bodies[body].free == [false; 6];
        if !layout.pins.iter().any(|pin| driven(pin.body)) {
            return;
        }
        for (c, cable) in cables.iter().enumerate() {
            let first = self.held.len();
            self.first.push(first);
            for (node, _) in cable.model.supports.iter().filter(|(_, s)| s.attached || s.position.is_some()) {
                let is_pin = |pin: usize| layout.pins[pin].cable == c && layout.pins[pin].node == *node;
                let pin = (0..layout.pins.len()).find(|&pin| is_pin(pin) && driven(layout.pins[pin].body));
                self.held.push(Held { node: *node, pin });
            }
            self.held[first..].sort_unstable_by_key(|held| held.node);
        }
        self.first.push(self.held.len());
        self.impulses.resize(layout.pins.len(), Vector3::zeros());
        self.angular.resize(cables.len(), Vector3::zeros());
        self.places.extend(layout.pins.iter().map(|pin| cables[pin.cable].node_position(pin.node)));
    }

    /// Returns whether a driven pin holds the cable.
    pub fn holds(&self, cable: usize) -> bool {
        self.is_active() && self.of(cable).iter().any(|held| held.pin.is_some())
    }

    /// Returns whether there is a driven pin.
    pub fn is_active(&self) -> bool {
        !self.first.is_empty()
    }

    fn of(&self, cable: usize) -> &[Held] {
        &self.held[self.first[cable]..self.first[cable + 1]]
    }

    /// Spreads the impulses `f` (rows of all nodes) over the pins of a cable.
    fn spread(&mut self, cable: usize, f: &[f64]) {
        let range = self.first[cable]..self.first[cable + 1];
        let (held, impulses) = (&self.held[range], &mut self.impulses);
        let mut next = 0;
        for (node, f) in f.chunks_exact(6).enumerate() {
            while next < held.len() && held[next].node < node {
                next += 1;
            }
            let mut give = |held: &Held, share: f64| {
                if let Some(pin) = held.pin {
                    impulses[pin] += vector(f) * share;
                }
            };
            match (next.checked_sub(1).map(|before| &held[before]), held.get(next)) {
                (Some(before), Some(after)) => {
                    let share = (node - before.node) as f64 / (after.node - before.node) as f64;
                    give(before, 1.0 - share);
                    give(after, share);
                }
                (Some(only), None) | (None, Some(only)) => give(only, 1.0),
                (None, None) => {}
            }
        }
    }

    /// Adds the impact at the beginning of a host step, which changed the momenta of all rows of
    /// the cables by `momentum`.
    pub fn add_impact(&mut self, layout: &Layout, q: &[f64], momentum: &[f64]) {
        for (c, angular) in self.angular.iter_mut().enumerate() {
            let range = layout.parts[c].range();
            *angular -= moment(&q[range.clone()], &momentum[range]);
        }
    }

    /// Adds a step of the discrete gradient of a cable: `f` of all rows but those of held
    /// positions, whose reactions `held` are in the accounts; coordinates at the beginning and
    /// their change; the momentum of the mean velocity.
    pub fn add_step(
        &mut self,
        cable: usize,
        f: &[f64],
        held: impl Iterator<Item = (usize, Vector3<f64>)>,
        [q, change, momentum]: [&[f64]; 3],
    ) {
        self.spread(cable, f);
        let middle = |at: usize| vector(&q[at..]) + 0.5 * vector(&change[at..]);
        let of_rows = (0..f.len()).step_by(3).map(|at| middle(at).cross(&vector(&f[at..]))).sum::<Vector3<f64>>();
        let of_held = held.map(|(at, impulse)| middle(at).cross(&impulse)).sum::<Vector3<f64>>();
        self.angular[cable] += of_rows + of_held - moment(change, momentum);
    }

    /// Takes forces and momenta of all rows at a state; see [`end_step`](Self::end_step).
    pub fn read(&mut self, layout: &Layout, state: &State, fill: impl FnOnce(&mut [f64], &mut [f64])) {
        self.readings.swap(0, 1);
        let Reading { force, momentum, moments } = &mut self.readings[1];
        force.resize(layout.size(), 0.0);
        momentum.resize(layout.size(), 0.0);
        fill(force, momentum);
        moments.clear();
        moments.extend(layout.parts.iter().map(|part| {
            let range = part.range();
            let q = &state.q[range.clone()];
            [moment(q, &force[range.clone()]), moment(q, &momentum[range])]
        }));
    }

    /// Adds a step of length `h` (s) between the last two readings.
    pub fn end_step(&mut self, layout: &Layout, h: f64) {
        let (mut field, readings) = (core::mem::take(&mut self.field), core::mem::take(&mut self.readings));
        let [before, after] = &readings;
        for (c, part) in layout.parts.iter().enumerate() {
            field.clear();
            field.extend(
                part.range()
                    .map(|i| 0.5 * h * (before.force[i] + after.force[i]) - (after.momentum[i] - before.momentum[i])),
            );
            self.spread(c, &field);
            let ([f0, p0], [f1, p1]) = (before.moments[c], after.moments[c]);
            self.angular[c] += 0.5 * h * (f0 + f1) - (p1 - p0);
        }
        (self.field, self.readings) = (field, readings);
    }

    /// Returns by how much the angular impulses of the clamps of a cable miss A, and the number of
    /// clamps; `accounts` returns impulse and angular impulse of a pin. `None` where something else
    /// holds the cable, too.
    pub fn left_to_clamps(
        &self,
        c: usize,
        layout: &Layout,
        cable: &Cable,
        accounts: impl Fn(usize) -> [Vector3<f64>; 2],
    ) -> Option<Vector3<f64>> {
        let (mut left, mut clamps) = (self.angular[c], 0.0);
        for held in self.of(c) {
            let pin = held.pin?;
            let place = 0.5 * (self.places[pin] + cable.node_position(held.node));
            let [impulse, angular] = accounts(pin);
            left -= place.cross(&impulse) + angular;
            clamps += if layout.clamps[pin].is_some() { 1.0 } else { 0.0 };
        }
        (clamps > 0.0).then(|| left / clamps)
    }
}
