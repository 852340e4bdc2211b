//! Buffers of an island, and where its bodies are: nothing here outlives a step.

use super::condense::Condensed;
use super::dense::Dense;
use super::rotation::jacobian;
use super::{Pin, RigidBody};
use crate::cable::Cable;
use crate::linalg::Factorisation;
use nalgebra::{UnitQuaternion, Vector3};

/// Buffers of one cable in an island.
#[derive(Clone, Debug, Default)]
pub(crate) struct CableWork {
    /// Where its coordinates begin.
    pub at: usize,
    pub size: usize,
    /// Its pins, as indices into the island's, and their nodes.
    pub pins: Vec<usize>,
    pub nodes: Vec<usize>,
    pub step: Condensed,
    pub mass: Condensed,
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
    pub gaps: Vec<Vector3<f64>>,
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

/// The vector that begins a slice.
pub(super) fn vector(x: &[f64]) -> Vector3<f64> {
    Vector3::new(x[0], x[1], x[2])
}

impl Workspace {
    /// Prepares for a step of `dt` from the present state.
    pub fn begin(&mut self, cables: &[&mut Cable], bodies: &[RigidBody], pins: &[Pin], dt: f64) {
        self.cables.resize_with(cables.len(), CableWork::default);
        let mut at = 0;
        for (c, (work, cable)) in self.cables.iter_mut().zip(cables).enumerate() {
            work.at = at;
            work.size = cable.positions().len();
            at += work.size;
            work.pins.clear();
            work.pins.extend((0..pins.len()).filter(|&i| pins[i].cable == c));
            work.nodes.clear();
            work.nodes.extend(work.pins.iter().map(|&i| pins[i].node));
        }
        self.bodies_at = at;
        self.bodies.clear();
        self.bodies.extend_from_slice(bodies);
        self.levers.clear();
        self.levers.resize(bodies.len(), 0.0);
        self.gaps.clear();
        for pin in pins {
            let gap = cables[pin.cable].node_position(pin.node) - bodies[pin.body].point(&pin.anchor);
            self.gaps.push(gap);
            self.levers[pin.body] = self.levers[pin.body].max(pin.anchor.norm());
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

    /// Takes all pins as closed.
    pub fn close_gaps(&mut self) {
        self.gaps.iter_mut().for_each(|gap| *gap = Vector3::zeros());
    }

    /// Body `i` at chart coordinates `q` and rates `v`.
    pub fn motion(&self, i: usize, q: &[f64], v: &[f64]) -> Motion {
        let theta = vector(&q[3..]);
        Motion {
            position: vector(q),
            rotation: UnitQuaternion::from_scaled_axis(theta) * self.bodies[i].rotation,
            velocity: vector(v),
            spin: jacobian(&theta) * vector(&v[3..]),
        }
    }

    pub fn gap(&self, pin: usize, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        // a cubic with zero rate at both ends: a jump of velocity would strike the cable
        let s = ((time - self.start) / self.duration).clamp(0.0, 1.0);
        (self.gaps[pin] * (1.0 - s * s * (3.0 - 2.0 * s)), self.gaps[pin] * (-6.0 * s * (1.0 - s) / self.duration))
    }

    pub fn closing_acceleration(&self, pin: usize, time: f64) -> Vector3<f64> {
        let s = ((time - self.start) / self.duration).clamp(0.0, 1.0);
        self.gaps[pin] * (-6.0 * (1.0 - 2.0 * s) / (self.duration * self.duration))
    }
}
