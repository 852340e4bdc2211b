//! The equations of an island, `q'' = f(q, q', t)`, as the integrators see them; see [`island`](super) for the equations.

use super::condense::Condensed;
use super::dense::Dense;
use super::rotation::{jacobian, jacobian_inverse, jacobian_rate, skew};
use super::{Pin, PinForce, RigidBody};
use crate::cable::{Cable, Equations, project_matrix, project_vector};
use crate::error::StepFailure;
use crate::integrate::newton::{self, Increment, Linearised};
use crate::integrate::{Dynamics, Phase, Stage};
use crate::linalg::Factorisation;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// Buffers of one cable in an island.
#[derive(Clone, Debug, Default)]
struct CableWork {
    /// Where its coordinates begin.
    at: usize,
    size: usize,
    /// Its pins, as indices into the island's, and their nodes.
    pins: Vec<usize>,
    nodes: Vec<usize>,
    step: Condensed,
    mass: Condensed,
    mass_factorisation: Factorisation,
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
    cables: Vec<CableWork>,
    /// Bodies as they were when the step began.
    bodies: Vec<RigidBody>,
    /// By body, the distance of the farthest pin from the centre of mass in m: a rotation moves it by this.
    levers: Vec<f64>,
    /// Zeros, as many as coordinates.
    zero: Vec<f64>,
    gaps: Vec<Vector3<f64>>,
    start: f64,
    duration: f64,
    /// Where the coordinates of the bodies begin.
    bodies_at: usize,
    mass_ready: bool,
    factored: f64,
    border: Vec<f64>,
    dense: Dense,
    rhs: Vec<f64>,
    product: Vec<f64>,
    z: Vec<f64>,
    velocity: Vec<f64>,
}

/// An island with its buffers: what the integrators see.
pub(crate) struct Work<'a, 'b> {
    pub cables: &'a mut [&'b mut Cable],
    pub bodies: &'a [RigidBody],
    pub pins: &'a [Pin],
    pub workspace: &'a mut Workspace,
}

fn vector(x: &[f64]) -> Vector3<f64> {
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

    fn gap(&self, pin: usize, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        // a cubic with zero rate at both ends: a jump of velocity would strike the cable
        let s = ((time - self.start) / self.duration).clamp(0.0, 1.0);
        (self.gaps[pin] * (1.0 - s * s * (3.0 - 2.0 * s)), self.gaps[pin] * (-6.0 * s * (1.0 - s) / self.duration))
    }
}

impl Workspace {
    fn closing_acceleration(&self, pin: usize, time: f64) -> Vector3<f64> {
        let s = ((time - self.start) / self.duration).clamp(0.0, 1.0);
        self.gaps[pin] * (-6.0 * (1.0 - 2.0 * s) / (self.duration * self.duration))
    }
}

impl Work<'_, '_> {
    fn body_at(&self, body: usize) -> usize {
        self.workspace.bodies_at + 6 * body
    }

    fn pin_at(&self, pin: usize) -> usize {
        self.workspace.cables[self.pins[pin].cable].at + 6 * self.pins[pin].node
    }

    /// The lever of a pin in world axes, with the body's motion.
    fn lever(&self, pin: usize, q: &[f64], v: &[f64]) -> (Motion, Vector3<f64>) {
        let body = self.pins[pin].body;
        let at = self.body_at(body);
        let motion = self.workspace.motion(body, &q[at..at + 6], &v[at..at + 6]);
        (motion, motion.rotation * self.pins[pin].anchor)
    }

    /// Puts pinned positions and velocities where their bodies have them.
    fn follow(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (motion, rho) = self.lever(pin, q, v);
            let (gap, closing) = self.workspace.gap(pin, time);
            let at = self.pin_at(pin);
            q[at..at + 3].copy_from_slice((motion.position + rho + gap).as_slice());
            v[at..at + 3].copy_from_slice((motion.velocity + motion.spin.cross(&rho) + closing).as_slice());
        }
    }

    /// Puts pinned accelerations where their bodies have them; `k` holds chart accelerations of the bodies.
    fn follow_acceleration(&self, time: f64, q: &[f64], v: &[f64], k: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (motion, rho) = self.lever(pin, q, v);
            let at = self.body_at(self.pins[pin].body);
            let closing = self.workspace.closing_acceleration(pin, time);
            let alpha = self.angular_acceleration(&q[at + 3..], &v[at + 3..], &k[at + 3..]);
            let spin = motion.spin;
            let a = vector(&k[at..]) + alpha.cross(&rho) + spin.cross(&spin.cross(&rho)) + closing;
            let at = self.pin_at(pin);
            k[at..at + 3].copy_from_slice(a.as_slice());
        }
    }

    fn angular_acceleration(&self, theta: &[f64], rate: &[f64], k: &[f64]) -> Vector3<f64> {
        let (theta, rate) = (vector(theta), vector(rate));
        jacobian(&theta) * vector(k) + jacobian_rate(&theta, &rate) * rate
    }

    /// Adds to the rows of the bodies: their own loads and inertia times `scale`, and what pins pass on from the rows of the
    /// cables. `k` are chart accelerations.
    fn body_rows(&mut self, scale: f64, q: &[f64], v: &[f64], k: &[f64], rhs: &mut [f64]) {
        for i in 0..self.bodies.len() {
            let at = self.body_at(i);
            let motion = self.workspace.motion(i, &q[at..at + 6], &v[at..at + 6]);
            let body = &self.workspace.bodies[i];
            let inertia = body.world_inertia(&motion.rotation);
            let alpha = self.angular_acceleration(&q[at + 3..], &v[at + 3..], &k[at + 3..]);
            let force = body.force - body.mass * vector(&k[at..]);
            let gyroscopic =
                if body.gyroscopic { motion.spin.cross(&(inertia * motion.spin)) } else { Vector3::zeros() };
            let torque = body.torque - inertia * alpha - gyroscopic;
            rhs[at..at + 3].copy_from_slice((force * scale).as_slice());
            rhs[at + 3..at + 6].copy_from_slice((torque * scale).as_slice());
        }
        for pin in 0..self.pins.len() {
            let (_, rho) = self.lever(pin, q, v);
            let row = self.pin_at(pin);
            let passed = vector(&rhs[row..]);
            let at = self.body_at(self.pins[pin].body);
            let torque = rho.cross(&passed);
            for x in 0..3 {
                rhs[at + x] += passed[x];
                rhs[at + 3 + x] += torque[x];
            }
        }
    }

    /// Factors the matrix of the bodies: masses, condensed cables, and the geometric stiffness of levers under `passed` forces.
    fn factor_bodies(&mut self, mass: bool, q: &[f64], v: &[f64], rhs: &[f64]) -> Result<(), StepFailure> {
        let n = 6 * self.bodies.len();
        let mut border = core::mem::take(&mut self.workspace.border);
        border.clear();
        border.resize(n * n, 0.0);
        let mut add = |row: usize, column: usize, value: f64| border[row * n + column] += value;
        for i in 0..self.bodies.len() {
            let at = self.body_at(i);
            let motion = self.workspace.motion(i, &q[at..at + 6], &v[at..at + 6]);
            let inertia = self.workspace.bodies[i].world_inertia(&motion.rotation);
            for r in 0..3 {
                add(6 * i + r, 6 * i + r, self.workspace.bodies[i].mass);
                for c in 0..3 {
                    add(6 * i + 3 + r, 6 * i + 3 + c, inertia[(r, c)]);
                }
            }
        }
        for pin in 0..self.pins.len() {
            if mass {
                break;
            }
            let (_, rho) = self.lever(pin, q, v);
            let f = vector(&rhs[self.pin_at(pin)..]);
            let geometric = -skew(&f) * skew(&rho);
            let symmetric = (geometric + geometric.transpose()) * 0.5;
            let body = self.pins[pin].body;
            for (r, c) in pairs(3) {
                add(6 * body + 3 + r, 6 * body + 3 + c, symmetric[(r, c)]);
            }
        }
        for work in &self.workspace.cables {
            let w = if mass { &work.mass.w } else { &work.step.w };
            let count = 3 * work.pins.len();
            for (a, b) in pairs(work.pins.len()) {
                let block = Matrix3::from_fn(|r, c| w[(3 * a + r) * count + 3 * b + c]);
                let (pa, pb) = (work.pins[a], work.pins[b]);
                let (ga, gb) = (-skew(&self.lever(pa, q, v).1), -skew(&self.lever(pb, q, v).1));
                let (ia, ib) = (6 * self.pins[pa].body, 6 * self.pins[pb].body);
                let blocks = [block, block * gb, ga.transpose() * block, ga.transpose() * block * gb];
                for (r, c) in pairs(3) {
                    add(ia + r, ib + c, blocks[0][(r, c)]);
                    add(ia + r, ib + 3 + c, blocks[1][(r, c)]);
                    add(ia + 3 + r, ib + c, blocks[2][(r, c)]);
                    add(ia + 3 + r, ib + 3 + c, blocks[3][(r, c)]);
                }
            }
        }
        for (i, body) in self.workspace.bodies.iter().enumerate() {
            for x in (0..6).filter(|&x| !body.free[x]) {
                let row = 6 * i + x;
                for j in 0..n {
                    border[row * n + j] = 0.0;
                    border[j * n + row] = 0.0;
                }
                border[row * n + row] = 1.0;
            }
        }
        let outcome = self.workspace.dense.factor(&border, n);
        self.workspace.border = border;
        Ok(outcome?)
    }

    /// Solves for increments in place: rows in, increments out (pinned positions and spins of the bodies included).
    fn solve_rows(&mut self, mass: bool, q: &[f64], v: &[f64], rhs: &mut [f64]) {
        for c in 0..self.cables.len() {
            let work = &self.workspace.cables[c];
            let cable = &mut *self.cables[c];
            let rows = &mut rhs[work.at..work.at + work.size];
            project_vector(&cable.model, rows);
            let factorisation = if mass { &work.mass_factorisation } else { &cable.system.factorisation };
            factorisation.solve(cable.system.level, rows);
            cable.diagnostics_mut().solves += 1;
        }
        for c in 0..self.cables.len() {
            let work = &self.workspace.cables[c];
            let condensed = if mass { &work.mass } else { &work.step };
            for (p, &pin) in work.pins.iter().enumerate() {
                let rows = &rhs[work.at..work.at + work.size];
                let passed = Vector3::from_fn(|x, _| -condensed.border(3 * p + x, rows));
                let (_, rho) = self.lever(pin, q, v);
                let torque = rho.cross(&passed);
                let at = self.body_at(self.pins[pin].body);
                for x in 0..3 {
                    rhs[at + x] += passed[x];
                    rhs[at + 3 + x] += torque[x];
                }
            }
        }
        let at = self.workspace.bodies_at;
        for (i, body) in self.workspace.bodies.iter().enumerate() {
            for x in (0..6).filter(|&x| !body.free[x]) {
                rhs[at + 6 * i + x] = 0.0;
            }
        }
        let n = 6 * self.bodies.len();
        self.workspace.dense.solve(&mut rhs[at..at + n]);
        for c in 0..self.cables.len() {
            let work = &self.workspace.cables[c];
            let condensed = if mass { &work.mass } else { &work.step };
            for (p, &pin) in work.pins.iter().enumerate() {
                let (_, rho) = self.lever(pin, q, v);
                let at = self.body_at(self.pins[pin].body);
                let displacement = vector(&rhs[at..]) + vector(&rhs[at + 3..]).cross(&rho);
                let rows = &mut rhs[work.at..work.at + work.size];
                for x in 0..3 {
                    condensed.spread(3 * p + x, displacement[x], rows);
                }
                let node = self.pin_at(pin);
                rhs[node..node + 3].copy_from_slice(displacement.as_slice());
            }
        }
    }

    fn equations(&mut self, c: usize) -> (Equations<'_>, &mut CableWork) {
        (self.cables[c].equations().0, &mut self.workspace.cables[c])
    }

    /// Mass matrices of all cables, factored and condensed, and the bodies' matrix at this configuration.
    fn factor_mass(&mut self, q: &[f64], v: &[f64]) -> Result<(), StepFailure> {
        if !self.workspace.mass_ready {
            for c in 0..self.cables.len() {
                let cable = &mut *self.cables[c];
                let work = &mut self.workspace.cables[c];
                let system = &mut cable.system;
                system.matrix.clear();
                system.add_mass(1.0);
                work.mass.read(&system.matrix, &work.nodes);
                project_matrix(&cable.model, &mut system.matrix);
                work.mass_factorisation.factor(system.level, &system.matrix)?;
                work.mass
                    .complete(system.level, &work.mass_factorisation, &work.nodes, |x| project_vector(&cable.model, x));
            }
            self.workspace.mass_ready = true;
        }
        self.factor_bodies(true, q, v, &[])
    }

    /// Rows `scale F - M k'` of all cables, and the step matrix if asked; `k` times `scale` is `z`.
    fn cable_rows(
        &mut self,
        time: f64,
        scale: f64,
        q: &[f64],
        z: &[f64],
        rhs: &mut [f64],
        matrix: bool,
    ) -> Result<(), StepFailure> {
        let mut product = core::mem::take(&mut self.workspace.product);
        let mut outcome = Ok(());
        for c in 0..self.cables.len() {
            let (mut equations, work) = self.equations(c);
            let range = work.at..work.at + work.size;
            let rows = &mut rhs[range.clone()];
            if matrix {
                equations.force_and_matrix(time, &q[range.clone()], scale, 1.0, rows);
                work.step.read(&equations.system.matrix, &work.nodes);
                outcome = equations.factor().map(|_| ());
                if outcome.is_err() {
                    break;
                }
                let (level, model) = (equations.system.level, equations.model);
                work.step.complete(level, &equations.system.factorisation, &work.nodes, |x| project_vector(model, x));
            } else {
                equations.force(time, &q[range.clone()], scale, rows);
            }
            equations.system.multiply_mass(&z[range.clone()], &mut product[range.clone()]);
            for (r, m) in rows.iter_mut().zip(&product[range]) {
                *r -= m;
            }
        }
        self.workspace.product = product;
        outcome
    }

    /// Forces of the cables on the bodies at a phase, by pin.
    pub fn pin_forces(&mut self, phase: &Phase) -> Result<Vec<PinForce>, StepFailure> {
        let n = phase.q.len();
        let (mut q, mut v, mut k, mut rhs) = (phase.q.clone(), phase.v.clone(), vec![0.0; n], vec![0.0; n]);
        self.prescribe(phase.time, &mut q, &mut v);
        self.acceleration(phase.time, &q, &v, &mut k)?;
        self.cable_rows(phase.time, 1.0, &q, &k, &mut rhs, false)?;
        Ok((0..self.pins.len()).map(|pin| PinForce { force: vector(&rhs[self.pin_at(pin)..]) }).collect())
    }
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |r| (0..n).map(move |c| (r, c)))
}

/// One stage of an island, as Newton sees it.
struct IslandStage<'a, 'b, 'c> {
    work: &'a mut Work<'b, 'c>,
    stage: &'a Stage,
    base: &'a mut [f64],
    velocity_base: &'a [f64],
    y: &'a mut [f64],
    v: &'a mut [f64],
    z: &'a mut [f64],
    rhs: &'a mut [f64],
}

impl IslandStage<'_, '_, '_> {
    /// Positions and velocities from z, pinned ones from their bodies; z and base of pinned ones follow.
    fn update(&mut self) {
        for i in 0..self.z.len() {
            self.y[i] = self.base[i] + self.z[i];
            self.v[i] = self.velocity_base[i] + self.stage.rate * self.z[i];
        }
        self.work.follow(self.stage.time, self.y, self.v);
        let c2 = self.stage.c2;
        // z is c2 k: let the pinned accelerations follow, then restore the identity y = base + z
        self.z.iter_mut().for_each(|z| *z /= c2);
        self.work.follow_acceleration(self.stage.time, self.y, self.v, self.z);
        self.z.iter_mut().for_each(|z| *z *= c2);
        for pin in 0..self.work.pins.len() {
            let at = self.work.pin_at(pin);
            for i in at..at + 3 {
                self.base[i] = self.y[i] - self.z[i];
            }
        }
    }
}

impl Linearised for IslandStage<'_, '_, '_> {
    fn increment(&mut self, fresh: bool) -> Result<Increment, StepFailure> {
        let IslandStage { work, stage, y, v, z, rhs, .. } = self;
        for cable in work.cables.iter_mut() {
            cable.diagnostics_mut().newton_iterations += 1;
        }
        if fresh {
            work.workspace.factored = 0.0;
        }
        work.cable_rows(stage.time, stage.c2, y, z, rhs, fresh)?;
        if fresh {
            work.factor_bodies(false, y, v, rhs)?;
            work.workspace.factored = stage.c2;
        }
        let mut k = core::mem::take(&mut work.workspace.product);
        for i in 0..k.len() {
            k[i] = z[i] / stage.c2;
        }
        work.body_rows(stage.c2, y, v, &k, rhs);
        work.workspace.product = k;
        work.solve_rows(false, y, v, rhs);
        let mut size = Increment { displacement: work.norm_of(rhs), rotation: 0.0 };
        for (cable, part) in work.cables.iter().zip(&work.workspace.cables) {
            let (_, slope) = cable.system.extent(&rhs[part.at..part.at + part.size]);
            size.rotation = size.rotation.max(slope);
        }
        for i in 0..work.bodies.len() {
            let at = work.body_at(i);
            size.rotation = size.rotation.max(vector(&rhs[at + 3..]).norm());
        }
        Ok(size)
    }

    fn apply(&mut self, share: f64) {
        for i in 0..self.work.workspace.bodies_at {
            self.z[i] += share * self.rhs[i];
        }
        for body in 0..self.work.bodies.len() {
            let at = self.work.body_at(body);
            let turn = jacobian_inverse(&vector(&self.y[at + 3..])) * vector(&self.rhs[at + 3..]);
            for x in 0..3 {
                self.z[at + x] += share * self.rhs[at + x];
                self.z[at + 3 + x] += share * turn[x];
            }
        }
        self.update();
    }

    fn not_finite(&self) -> StepFailure {
        let node = self.rhs.iter().position(|x| !x.is_finite()).unwrap_or(0) / 6;
        StepFailure::NotFinite { what: "Newton increment", node }
    }
}

impl Work<'_, '_> {
    /// Size in m of a vector of increments, rotations by the lever they move.
    fn norm_of(&self, x: &[f64]) -> f64 {
        let mut worst = 0.0f64;
        let mut take = |size: f64| worst = if size > worst || size.is_nan() { size } else { worst };
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            take(cable.system.extent(&x[part.at..part.at + part.size]).0);
        }
        for (i, lever) in self.workspace.levers.iter().enumerate() {
            let at = self.body_at(i);
            take(vector(&x[at..]).norm());
            take(vector(&x[at + 3..]).norm() * lever);
        }
        worst
    }
}

impl Dynamics for Work<'_, '_> {
    fn size(&self) -> usize {
        self.workspace.bodies_at + 6 * self.bodies.len()
    }

    fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            for (node, support) in &cable.model.supports {
                let range = part.at + 6 * node..part.at + 6 * node + 6;
                support.prescribe(time, &mut q[range.clone()], &mut v[range]);
            }
        }
        for (i, body) in self.workspace.bodies.iter().enumerate() {
            let at = self.body_at(i);
            for x in (0..6).filter(|&x| !body.free[x]) {
                v[at + x] = 0.0;
            }
        }
        self.follow(time, q, v);
    }

    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], k: &mut [f64]) -> Result<(), StepFailure> {
        // accelerations that do not depend on unknown ones: supports, and the centripetal part of pins
        k.fill(0.0);
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            for (node, support) in &cable.model.supports {
                let at = part.at + 6 * node;
                k[at..at + 6].copy_from_slice(&support.acceleration(time));
            }
        }
        for i in 0..self.bodies.len() {
            // zero angular acceleration: theta'' = -J^-1 J' theta'
            let at = self.body_at(i);
            let (theta, rate) = (vector(&q[at + 3..]), vector(&v[at + 3..]));
            let k0 = -(jacobian_inverse(&theta) * (jacobian_rate(&theta, &rate) * rate));
            k[at + 3..at + 6].copy_from_slice(k0.as_slice());
        }
        self.follow_acceleration(time, q, v, k);
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        self.factor_mass(q, v)?;
        self.cable_rows(time, 1.0, q, k, &mut rhs, false)?;
        self.body_rows(1.0, q, v, k, &mut rhs);
        self.solve_rows(true, q, v, &mut rhs);
        for i in 0..self.workspace.bodies_at {
            k[i] += rhs[i];
        }
        for i in 0..self.bodies.len() {
            let at = self.body_at(i);
            let turn = jacobian_inverse(&vector(&q[at + 3..])) * vector(&rhs[at + 3..]);
            for x in 0..3 {
                k[at + x] += rhs[at + x];
                k[at + 3 + x] += turn[x];
            }
        }
        self.workspace.rhs = rhs;
        match k.iter().position(|x| !x.is_finite()) {
            None => Ok(()),
            Some(i) => Err(StepFailure::NotFinite { what: "acceleration", node: i / 6 }),
        }
    }

    fn solve_stage(
        &mut self,
        stage: &Stage,
        base: &mut [f64],
        velocity_base: &mut [f64],
        y: &mut [f64],
        acceleration: &mut [f64],
    ) -> Result<(), StepFailure> {
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            for (node, support) in &cable.model.supports {
                let at = part.at + 6 * node;
                support.prescribe_stage(
                    stage,
                    &mut base[at..at + 6],
                    &mut velocity_base[at..at + 6],
                    &mut acceleration[at..at + 6],
                );
            }
        }
        for (i, body) in self.workspace.bodies.iter().enumerate() {
            let at = self.workspace.bodies_at + 6 * i;
            for x in (0..6).filter(|&x| !body.free[x]) {
                acceleration[at + x] = 0.0;
            }
        }
        let mut z = core::mem::take(&mut self.workspace.z);
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        let mut velocity = core::mem::take(&mut self.workspace.velocity);
        for i in 0..z.len() {
            z[i] = stage.c2 * acceleration[i];
        }
        let wanted = stage.newton.tolerance();
        let mut tolerance = wanted;
        for c in 0..self.cables.len() {
            let (equations, part) = self.equations(c);
            let range = part.at..part.at + part.size;
            tolerance = tolerance.min(equations.tolerance(wanted, stage, &base[range.clone()], &z[range]));
        }
        let keep = stage.reuse && stage.c2 > 0.0 && self.workspace.factored == stage.c2;
        let mut problem =
            IslandStage { work: self, stage, base, velocity_base, y, v: &mut velocity, z: &mut z, rhs: &mut rhs };
        problem.update();
        let outcome = newton::iterate(&mut problem, tolerance, stage.newton.once(), keep);
        for i in 0..z.len() {
            acceleration[i] = z[i] / stage.c2;
        }
        // the velocities of pinned nodes are those of their bodies, not of the integrator's base
        for pin in 0..self.pins.len() {
            let at = self.pin_at(pin);
            for i in at..at + 3 {
                velocity_base[i] = velocity[i] - stage.rate * z[i];
            }
        }
        self.workspace.z = z;
        self.workspace.rhs = rhs;
        self.workspace.velocity = velocity;
        outcome
    }

    fn filter(&mut self, error: &mut [f64]) {
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        rhs.fill(0.0);
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            let range = part.at..part.at + part.size;
            cable.system.multiply_mass(&error[range.clone()], &mut rhs[range]);
        }
        for (i, body) in self.bodies.iter().enumerate() {
            let at = self.body_at(i);
            let spin = body.world_inertia(&body.rotation) * vector(&error[at + 3..]);
            for x in 0..3 {
                rhs[at + x] = body.mass * error[at + x];
                rhs[at + 3 + x] = spin[x];
            }
        }
        // attitudes at the start of the step are near enough for a filter
        let zero = core::mem::take(&mut self.workspace.zero);
        for pin in 0..self.pins.len() {
            let (_, rho) = self.lever(pin, &zero, &zero);
            let passed = vector(&rhs[self.pin_at(pin)..]);
            let torque = rho.cross(&passed);
            let at = self.body_at(self.pins[pin].body);
            for x in 0..3 {
                rhs[at + x] += passed[x];
                rhs[at + 3 + x] += torque[x];
            }
        }
        self.solve_rows(false, &zero, &zero, &mut rhs);
        error.copy_from_slice(&rhs);
        self.workspace.zero = zero;
        self.workspace.rhs = rhs;
    }

    fn norm(&self, error: &[f64]) -> f64 {
        self.norm_of(error)
    }

    fn frequency_bound(&self) -> f64 {
        self.cables.iter().map(|c| c.frequency_bound()).fold(0.0, f64::max)
    }
}
