//! The coordinates of an island, and what pins and clamps prescribe during one host step.
//!
//! The coordinates are those of the cables, one after the other, then six per body: position and
//! rotation vector. Everything here is set when the step begins and constant until it ends.

use super::body::RigidBody;
use super::clamp::Clamp;
use super::coupling::CoupledInertia;
use super::cuts;
use super::hold::{Held, Hold, direction, vector};
use super::pin::PinConstraint;
use super::rotation::{exponential, spin};
use super::statics::Joints;
use crate::cable::Cable;
use crate::scales::island::{CLOSING_SPEED, GAP_ROUNDING, REVERSED_COSINE, SHORTEST_CLOSING};
use nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};

/// Returns the share of a gap (m) that closes in a step of `dt` (s).
pub fn closing_share(gap: f64, dt: f64) -> f64 {
    (CLOSING_SPEED * dt / (1.5 * gap).max(GAP_ROUNDING)).min(1.0) * share_of_closing(dt)
}

/// Returns the share of a small gap, or turn of a clamp, that closes in a step of `dt` (s).
fn share_of_closing(dt: f64) -> f64 {
    (dt / SHORTEST_CLOSING).min(1.0).powi(2)
}

/// The coordinates of one cable.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    /// Offset among the island's coordinates.
    pub at: usize,
    /// Number of coordinates.
    pub size: usize,
    /// Those that follow bodies, in the order of nodes.
    pub holds: Vec<Hold>,
    /// Nodes at which it is cut, in ascending order.
    pub cuts: Vec<usize>,
    /// Those of the border: that follow bodies, then the slopes of cuts, the last cut first, so
    /// that neighbours in the list are neighbours along the cable.
    pub held: Vec<Held>,
    /// The first block of the border, beyond the bodies, of its cuts.
    pub cut_at: usize,
    /// Nodes on bodies with prescribed motion, which do work on the cable.
    pub driven: Vec<usize>,
}

impl Part {
    /// Returns the range of the coordinates.
    pub fn range(&self) -> core::ops::Range<usize> {
        self.at..self.at + self.size
    }
}

/// A body at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub position: Vector3<f64>,
    pub rotation: UnitQuaternion<f64>,
    pub velocity: Vector3<f64>,
    pub spin: Vector3<f64>,
}

/// Coordinates, bodies and pins of an island during one host step.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    /// By cable.
    pub parts: Vec<Part>,
    /// The bodies when the step began.
    pub bodies: Vec<RigidBody>,
    /// Inertia that couples them.
    pub coupled: Vec<CoupledInertia>,
    /// By body, the largest distance of a pin from the centre of mass in m, by which a rotation
    /// displaces it.
    pub levers: Vec<f64>,
    pub pins: Vec<PinConstraint>,
    /// By pin, the clamped direction if it is a clamp.
    pub clamps: Vec<Option<Clamp>>,
    /// By pin, the part of the gap that closes in this step, and the part that remains.
    closing: Vec<Vector3<f64>>,
    remaining: Vec<Vector3<f64>>,
    /// By pin, its velocity beyond that of the uniform motion of its body at both ends of the step.
    rates: Vec<[Vector3<f64>; 2]>,
    /// Joints between the bodies, in statics alone: in motion an engine computes them.
    pub joints: Joints,
    /// Stiffness of the loads on bodies that depend on where they are, in statics alone.
    pub stiffness: Vec<(usize, Matrix6<f64>)>,
    /// Offset of the bodies' coordinates.
    pub bodies_at: usize,
    /// Number of blocks of the border that are those of cuts.
    pub cut_blocks: usize,
    /// Time in s at which the step began, and its duration in s.
    start: f64,
    duration: f64,
}

impl Layout {
    /// Begins a step of `dt` (s) from the present state.
    pub fn begin(&mut self, cables: &[&mut Cable], bodies: &[RigidBody], pins: &[PinConstraint], dt: f64) {
        self.parts.resize_with(cables.len(), Part::default);
        let mut at = 0;
        for (part, cable) in self.parts.iter_mut().zip(cables) {
            part.at = at;
            part.size = cable.positions().len();
            at += part.size;
            part.holds.clear();
            part.driven.clear();
        }
        for (i, pin) in pins.iter().enumerate() {
            let part = &mut self.parts[pin.cable];
            if bodies[pin.body].is_driven() && bodies[pin.body].moves() {
                part.driven.push(pin.node);
            }
            let position = Hold { pin: i, node: pin.node, at: part.at + 6 * pin.node, slope: false };
            part.holds.push(position);
            if pin.direction.is_some() {
                part.holds.push(Hold { at: position.at + 3, slope: true, ..position });
            }
        }
        self.cut_blocks = 0;
        for (part, cable) in self.parts.iter_mut().zip(cables) {
            part.holds.sort_unstable_by_key(|hold| (hold.node, hold.slope));
            cuts::find(cable, &part.holds, (bodies, pins), &mut part.cuts);
            part.held.clear();
            part.held.extend(part.holds.iter().map(|&Hold { node, slope, .. }| Held { node, slope }));
            part.held.extend(part.cuts.iter().rev().map(|&node| Held { node, slope: true }));
            part.cut_at = self.cut_blocks;
            self.cut_blocks += cuts::blocks(part.cuts.len());
        }
        self.bodies_at = at;
        self.bodies.clear();
        self.bodies.extend_from_slice(bodies);
        self.levers.clear();
        self.levers.resize(bodies.len(), 0.0);
        self.pins.clear();
        self.pins.extend_from_slice(pins);
        self.closing.clear();
        self.remaining.clear();
        self.rates.clear();
        self.clamps.clear();
        for pin in pins {
            let (cable, body) = (&cables[pin.cable], &bodies[pin.body]);
            let gap = cable.node_position(pin.node) - body.point(&pin.anchor);
            let gap = if gap.amax() < GAP_ROUNDING { Vector3::zeros() } else { gap };
            let share = closing_share(gap.norm(), dt);
            self.closing.push(gap * share);
            self.remaining.push(gap * (1.0 - share));
            self.levers[pin.body] = self.levers[pin.body].max(pin.anchor.norm());
            let turned = exponential(&(body.angular_velocity * dt)) * body.rotation;
            let rate = |[linear, angular]: [Vector3<f64>; 2], attitude: &UnitQuaternion<f64>| {
                linear + angular.cross(&(attitude * pin.anchor))
            };
            let [first, last] = if body.is_driven() { body.unsteadiness } else { Default::default() };
            self.rates.push([rate(first, &body.rotation), rate(last, &turned)]);
            self.clamps.push(pin.direction.map(|wanted| {
                let slope = body.rotation.inverse() * vector(&cable.positions()[6 * pin.node + 3..]);
                let present = direction(&slope).unwrap_or(wanted);
                let present = if present.dot(&wanted) < -REVERSED_COSINE { -present } else { present };
                Clamp::new(
                    present,
                    wanted,
                    (dt, share_of_closing(dt)),
                    [body.rotation.inverse() * first[1], turned.inverse() * last[1]],
                )
            }));
        }
        self.start = cables[0].time();
        self.duration = dt;
    }

    /// Closes all gaps and rotates all clamps at once: for statics.
    pub fn close(&mut self) {
        self.closing.fill(Vector3::zeros());
        self.remaining.fill(Vector3::zeros());
        self.rates.fill(Default::default());
        for (clamp, pin) in self.clamps.iter_mut().zip(&self.pins) {
            *clamp = pin.direction.map(|wanted| Clamp::new(wanted, wanted, (self.duration, 1.0), Default::default()));
        }
    }

    /// Returns the number of coordinates.
    pub fn size(&self) -> usize {
        self.bodies_at + 6 * self.bodies.len()
    }

    /// Returns the offset of a body's coordinates.
    pub fn body_at(&self, body: usize) -> usize {
        self.bodies_at + 6 * body
    }

    /// Returns the offset of a pinned node's coordinates.
    pub fn pin_at(&self, pin: usize) -> usize {
        self.parts[self.pins[pin].cable].at + 6 * self.pins[pin].node
    }

    /// Returns all coordinates that follow bodies.
    pub fn holds(&self) -> impl Iterator<Item = &Hold> {
        self.parts.iter().flat_map(|part| &part.holds)
    }

    /// Returns whether no gap closes and no clamp rotates in this step.
    pub fn is_closed(&self) -> bool {
        self.closing.iter().chain(&self.remaining).chain(self.rates.iter().flatten()).all(|x| *x == Vector3::zeros())
            && !self.clamp_rotates()
    }

    /// Returns whether a clamp rotates a slope into its direction in this step.
    pub fn clamp_rotates(&self) -> bool {
        !self.clamps.iter().flatten().all(Clamp::is_constant)
    }

    /// Returns the elapsed share of the step, 0 to 1.
    pub fn elapsed(&self, time: f64) -> f64 {
        ((time - self.start) / self.duration).clamp(0.0, 1.0)
    }

    /// Returns the attitude of body `i` at its coordinates `q`.
    pub fn attitude(&self, i: usize, q: &[f64]) -> UnitQuaternion<f64> {
        exponential(&vector(&q[3..])) * self.bodies[i].rotation
    }

    /// Returns, by body, its position and its rotation from the attitude that it is counted from,
    /// at coordinates `q` of all.
    pub fn pose<'a>(&self, q: &'a [f64]) -> impl Fn(usize) -> (Vector3<f64>, UnitQuaternion<f64>) + use<'a> {
        let at = self.bodies_at;
        move |body| {
            let own = &q[at + 6 * body..];
            (vector(own), exponential(&vector(&own[3..])))
        }
    }

    /// Returns body `i` at its coordinates `q` and their rates `v`. Inlined, so that callers pay
    /// only for the fields they use.
    #[inline(always)]
    pub fn motion(&self, i: usize, q: &[f64], v: &[f64]) -> Motion {
        let theta = vector(&q[3..]);
        Motion {
            position: vector(q),
            rotation: exponential(&theta) * self.bodies[i].rotation,
            velocity: vector(v),
            spin: spin(&theta, &vector(&v[3..])),
        }
    }

    /// Returns gap and rate of a pin. The gap is a cubic of time with zero rate at both ends, or
    /// with those of an unsteady body: a jump of the rate would give the cable an impulse.
    pub fn gap(&self, pin: usize, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (s, h, [first, last]) = (self.elapsed(time), self.duration, self.rates[pin]);
        let open = self.remaining[pin] + self.closing[pin] * (1.0 - s * s * (3.0 - 2.0 * s));
        let beyond = (first * (s * (1.0 - s) * (1.0 - s)) - last * (s * s * (1.0 - s))) * h;
        let rate = first * ((1.0 - s) * (1.0 - 3.0 * s)) + last * (s * (3.0 * s - 2.0));
        (open + beyond, self.closing[pin] * (-6.0 * s * (1.0 - s) / h) + rate)
    }

    /// Returns the second time derivative of a pin's gap.
    pub fn gap_acceleration(&self, pin: usize, time: f64) -> Vector3<f64> {
        let (s, h, [first, last]) = (self.elapsed(time), self.duration, self.rates[pin]);
        self.closing[pin] * (-6.0 * (1.0 - 2.0 * s) / (h * h)) + (first * (6.0 * s - 4.0) + last * (6.0 * s - 2.0)) / h
    }
}

impl Layout {
    /// Returns twice the kinetic energy in J of the coupled inertia at the velocities of the
    /// bodies.
    pub(super) fn coupled_energy(&self, velocity: impl Fn(usize) -> Vector6<f64>) -> f64 {
        let energy = |c: &CoupledInertia| velocity(c.bodies[0]).dot(&(c.matrix * velocity(c.bodies[1])));
        2.0 * self.coupled.iter().map(energy).sum::<f64>()
    }

    /// Adds the momenta of the coupled inertia, times `factor`, to the rows of the bodies.
    pub(super) fn add_coupled_momenta(&self, factor: f64, velocity: impl Fn(usize) -> Vector6<f64>, rows: &mut [f64]) {
        for (body, momentum) in self.coupled.iter().flat_map(|c| c.momenta(&velocity)) {
            let at = self.body_at(body);
            rows[at..at + 6].iter_mut().zip(&momentum).for_each(|(row, p)| *row += factor * p);
        }
    }
}
