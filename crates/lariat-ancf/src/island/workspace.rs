//! Buffers of an island, and where its bodies are: nothing here outlives a step.

use super::account::PinAccount;
use super::clamp::Clamp;
use super::condense::Condensed;
use super::dense::Dense;
use super::rotation::{exponential, spin};
use super::{PinConstraint, RigidBody};
use crate::cable::Cable;
use crate::linalg::Factorisation;
use nalgebra::{UnitQuaternion, Vector3};

/// Three coordinates of a cable that follow a body: a pinned position, or a clamped slope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hold {
    pub pin: usize,
    pub node: usize,
    /// Where they are among the island's coordinates.
    pub at: usize,
    pub slope: bool,
}

/// Gaps below this in m are rounding.
const LEAST_GAP: f64 = 1e-12;
/// A gap closes no faster than this in m/s: after a teleport the cable must live through it.
pub const CLOSING_SPEED: f64 = 10.0;
/// A slope shorter than this has no direction.
const LEAST_SLOPE: f64 = 1e-9;

/// Where the cosine between a slope and its clamp is below minus this, the slope is along the clamp and its stretch negative: limp cables
/// are thrown inside out. Taken for a turn instead, half of one in a step, it made energy without bound.
const INSIDE_OUT: f64 = 0.9;

/// Buffers of one cable in an island.
#[derive(Clone, Debug, Default)]
pub(crate) struct CableWork {
    /// Where its coordinates begin.
    pub at: usize,
    pub size: usize,
    pub holds: Vec<Hold>,
    pub step: Condensed,
    pub mass: Condensed,
    /// By hold, the direction of the slope when the matrices were factored.
    pub step_directions: Vec<Vector3<f64>>,
    pub mass_directions: Vec<Vector3<f64>>,
    pub mass_factorisation: Factorisation,
}

/// A body at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub position: Vector3<f64>,
    pub rotation: UnitQuaternion<f64>,
    pub velocity: Vector3<f64>,
    pub spin: Vector3<f64>,
}

/// Buffers of an island.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workspace {
    pub cables: Vec<CableWork>,
    /// Bodies as they were when the step began.
    pub bodies: Vec<RigidBody>,
    /// By body, the distance of the farthest pin from the centre of mass in m: a rotation moves it by this.
    pub levers: Vec<f64>,
    /// Zeros, as many as coordinates.
    pub zero: Vec<f64>,
    /// By pin, what of the gap closes in this step, and what is left.
    pub gaps: Vec<Vector3<f64>>,
    pub left: Vec<Vector3<f64>>,
    /// By pin, its direction if it is a clamp.
    pub clamps: Vec<Option<Clamp>>,
    /// By pin, what passed in this step.
    pub accounts: Vec<PinAccount>,
    /// The time to which the accounts are kept.
    pub accounted: Option<f64>,
    pub start: f64,
    pub duration: f64,
    /// Where the coordinates of the bodies begin.
    pub bodies_at: usize,
    pub mass_ready: bool,
    pub factored: f64,
    pub border: Vec<f64>,
    pub dense: Dense,
    pub rhs: Vec<f64>,
    pub product: Vec<f64>,
    pub z: Vec<f64>,
    pub velocity: Vec<f64>,
}

/// The direction of a slope, on the side of `otherwise`, which it is if it has none: a stretch that passes through zero does not turn it.
pub(super) fn direction(slope: &[f64], otherwise: &Vector3<f64>) -> Vector3<f64> {
    let d = vector(slope).try_normalize(LEAST_SLOPE).unwrap_or(*otherwise);
    if d.dot(otherwise) < 0.0 { -d } else { d }
}

/// The vector that begins a slice.
pub(super) fn vector(x: &[f64]) -> Vector3<f64> {
    Vector3::new(x[0], x[1], x[2])
}

impl Workspace {
    /// Prepares for a step of `dt` from the present state.
    pub fn begin(&mut self, cables: &[&mut Cable], bodies: &[RigidBody], pins: &[PinConstraint], dt: f64) {
        self.cables.resize_with(cables.len(), CableWork::default);
        let mut at = 0;
        for (c, (work, cable)) in self.cables.iter_mut().zip(cables).enumerate() {
            work.at = at;
            work.size = cable.positions().len();
            at += work.size;
            work.holds.clear();
            for (i, pin) in pins.iter().enumerate().filter(|(_, p)| p.cable == c) {
                let position = Hold { pin: i, node: pin.node, at: work.at + 6 * pin.node, slope: false };
                work.holds.push(position);
                if pin.direction.is_some() {
                    work.holds.push(Hold { at: position.at + 3, slope: true, ..position });
                }
            }
        }
        self.bodies_at = at;
        self.bodies.clear();
        self.bodies.extend_from_slice(bodies);
        self.levers.clear();
        self.levers.resize(bodies.len(), 0.0);
        self.gaps.clear();
        self.left.clear();
        self.clamps.clear();
        self.accounts.clear();
        self.accounts.resize(pins.len(), PinAccount::default());
        self.accounted = None;
        for pin in pins {
            let (cable, body) = (&cables[pin.cable], &bodies[pin.body]);
            let gap = cable.node_position(pin.node) - body.point(&pin.anchor);
            let gap = if gap.amax() < LEAST_GAP { Vector3::zeros() } else { gap };
            let share = (CLOSING_SPEED * dt / (1.5 * gap.norm()).max(LEAST_GAP)).min(1.0);
            self.gaps.push(gap * share);
            self.left.push(gap * (1.0 - share));
            self.levers[pin.body] = self.levers[pin.body].max(pin.anchor.norm());
            self.clamps.push(pin.direction.map(|wanted| {
                let slope = body.rotation.inverse() * vector(&cable.positions()[6 * pin.node + 3..]);
                let has = slope.try_normalize(LEAST_SLOPE).unwrap_or(wanted);
                // a stretch below zero is the slope's, not a turn to be undone
                let has = if has.dot(&wanted) < -INSIDE_OUT { -has } else { has };
                Clamp::new(has, wanted, dt)
            }));
        }
        self.start = cables[0].time();
        self.duration = dt;
        self.mass_ready = false;
        self.factored = 0.0;
        let n = at + 6 * bodies.len();
        for buffer in [&mut self.rhs, &mut self.product, &mut self.z, &mut self.velocity, &mut self.zero] {
            buffer.resize(n, 0.0);
        }
    }

    /// Whether no pin has a gap to close and no clamp has to turn.
    pub fn closed(&self) -> bool {
        self.gaps.iter().chain(&self.left).all(|gap| *gap == Vector3::zeros())
            && self.clamps.iter().flatten().all(Clamp::settled)
    }

    /// Elapsed share of the step.
    pub fn elapsed(&self, time: f64) -> f64 {
        ((time - self.start) / self.duration).clamp(0.0, 1.0)
    }

    /// Attitude of body `i` at chart coordinates `q`.
    pub fn attitude(&self, i: usize, q: &[f64]) -> UnitQuaternion<f64> {
        exponential(&vector(&q[3..])) * self.bodies[i].rotation
    }

    /// Body `i` at chart coordinates `q` and rates `v`. Inlined, so that callers pay only for what they use.
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

    pub fn gap(&self, pin: usize, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        // a cubic with zero rate at both ends: a jump of velocity would strike the cable
        let s = self.elapsed(time);
        let open = self.left[pin] + self.gaps[pin] * (1.0 - s * s * (3.0 - 2.0 * s));
        (open, self.gaps[pin] * (-6.0 * s * (1.0 - s) / self.duration))
    }

    pub fn closing_acceleration(&self, pin: usize, time: f64) -> Vector3<f64> {
        let s = self.elapsed(time);
        self.gaps[pin] * (-6.0 * (1.0 - 2.0 * s) / (self.duration * self.duration))
    }
}
