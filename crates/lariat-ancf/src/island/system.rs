//! The rows and matrices of an island: see [`island`](super) for the equations.

use super::rotation::{jacobian, jacobian_rate, skew};
use super::workspace::{CableWork, Motion, Workspace, vector};
use super::{Pin, PinForce, RigidBody};
use crate::cable::{Cable, Equations, Rates, project_matrix, project_vector};
use crate::error::StepFailure;
use crate::integrate::{Dynamics, Phase};
use nalgebra::{Matrix3, Vector3};

/// Jumps of velocity at pins below this in m/s are rounding.
const LEAST_JUMP: f64 = 1e-10;

/// An island with its buffers: what the integrators see.
pub(crate) struct Work<'a, 'b> {
    pub cables: &'a mut [&'b mut Cable],
    pub bodies: &'a [RigidBody],
    pub pins: &'a [Pin],
    pub workspace: &'a mut Workspace,
}

impl Work<'_, '_> {
    pub(super) fn body_at(&self, body: usize) -> usize {
        self.workspace.bodies_at + 6 * body
    }

    pub(super) fn pin_at(&self, pin: usize) -> usize {
        self.workspace.cables[self.pins[pin].cable].at + 6 * self.pins[pin].node
    }

    /// The lever of a pin in world axes, with the body's motion.
    pub(super) fn lever(&self, pin: usize, q: &[f64], v: &[f64]) -> (Motion, Vector3<f64>) {
        let body = self.pins[pin].body;
        let at = self.body_at(body);
        let motion = self.workspace.motion(body, &q[at..at + 6], &v[at..at + 6]);
        (motion, motion.rotation * self.pins[pin].anchor)
    }

    /// Puts pinned positions and velocities where their bodies have them.
    pub(super) fn follow(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (motion, rho) = self.lever(pin, q, v);
            let (gap, closing) = self.workspace.gap(pin, time);
            let at = self.pin_at(pin);
            q[at..at + 3].copy_from_slice((motion.position + rho + gap).as_slice());
            v[at..at + 3].copy_from_slice((motion.velocity + motion.spin.cross(&rho) + closing).as_slice());
        }
    }

    /// Puts pinned accelerations where their bodies have them; `k` holds chart accelerations of the bodies.
    pub(super) fn follow_acceleration(&self, time: f64, q: &[f64], v: &[f64], k: &mut [f64]) {
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
    pub(super) fn body_rows(&mut self, scale: f64, q: &[f64], v: &[f64], k: &[f64], rhs: &mut [f64]) {
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
        self.pass_pinned_rows(q, v, rhs);
    }

    /// Adds the rows of pinned positions to those of their bodies, as force and moment.
    pub(super) fn pass_pinned_rows(&self, q: &[f64], v: &[f64], rhs: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (_, rho) = self.lever(pin, q, v);
            let passed = vector(&rhs[self.pin_at(pin)..]);
            let at = self.body_at(self.pins[pin].body);
            let torque = rho.cross(&passed);
            for x in 0..3 {
                rhs[at + x] += passed[x];
                rhs[at + 3 + x] += torque[x];
            }
        }
    }

    /// Brings pinned nodes to the velocity of their bodies as an inelastic impact does: with the impulse that it takes on both
    /// sides, so that momentum is kept when an engine, a user or a collision has changed a body's velocity.
    pub(super) fn meet(&mut self, phase: &mut Phase) -> Result<(), StepFailure> {
        let Phase { time, q, v, .. } = phase;
        let mut jump = core::mem::take(&mut self.workspace.product);
        jump.copy_from_slice(v);
        self.prescribe(*time, q, v);
        let mut largest = 0.0f64;
        for (jump, v) in jump.iter_mut().zip(v.iter()) {
            *jump -= v;
        }
        for (c, part) in self.workspace.cables.iter().enumerate() {
            for node in 0..part.size / 6 {
                let at = part.at + 6 * node;
                let pinned = self.pins.iter().any(|p| p.cable == c && p.node == node);
                jump[at + 3..at + 6].fill(0.0);
                if pinned {
                    largest = largest.max(vector(&jump[at..]).norm());
                } else {
                    jump[at..at + 3].fill(0.0);
                }
            }
        }
        let outcome = if largest > LEAST_JUMP { self.share_jump(&jump, q, v) } else { Ok(()) };
        self.workspace.product = jump;
        outcome?;
        self.follow(*time, q, v);
        Ok(())
    }

    fn share_jump(&mut self, jump: &[f64], q: &[f64], v: &mut [f64]) -> Result<(), StepFailure> {
        self.factor_mass(q, v)?;
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        rhs.fill(0.0);
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            let range = part.at..part.at + part.size;
            cable.system.multiply_mass(&jump[range.clone()], &mut rhs[range]);
        }
        self.pass_pinned_rows(q, v, &mut rhs);
        self.solve_rows(true, q, v, &mut rhs);
        // the chart is at its origin: rates of the rotation vector are angular velocities
        for (v, change) in v.iter_mut().zip(&rhs) {
            *v += change;
        }
        self.workspace.rhs = rhs;
        Ok(())
    }

    /// Factors the matrix of the bodies: masses, condensed cables, and the geometric stiffness of levers under `passed` forces.
    pub(super) fn factor_bodies(&mut self, mass: bool, q: &[f64], v: &[f64], rhs: &[f64]) -> Result<(), StepFailure> {
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
    pub(super) fn solve_rows(&mut self, mass: bool, q: &[f64], v: &[f64], rhs: &mut [f64]) {
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

    pub(super) fn equations(&mut self, c: usize) -> (Equations<'_>, &mut CableWork) {
        (self.cables[c].equations().0, &mut self.workspace.cables[c])
    }

    /// Mass matrices of all cables, factored and condensed, and the bodies' matrix at this configuration.
    pub(super) fn factor_mass(&mut self, q: &[f64], v: &[f64]) -> Result<(), StepFailure> {
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
    pub(super) fn cable_rows(
        &mut self,
        time: f64,
        scale: f64,
        q: &[f64],
        rates: Rates<'_>,
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
                let rates = Rates { v: &rates.v[range.clone()], ..rates };
                equations.moving_force_and_matrix(time, &q[range.clone()], rates, scale, 1.0, rows);
                work.step.read(&equations.system.matrix, &work.nodes);
                outcome = equations.factor().map(|_| ());
                if outcome.is_err() {
                    break;
                }
                let (level, model) = (equations.system.level, equations.model);
                work.step.complete(level, &equations.system.factorisation, &work.nodes, |x| project_vector(model, x));
            } else {
                equations.moving_force(time, &q[range.clone()], &rates.v[range.clone()], scale, rows);
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
        self.cable_rows(phase.time, 1.0, &q, Rates { v: &v, rate: 0.0 }, &k, &mut rhs, false)?;
        Ok((0..self.pins.len()).map(|pin| PinForce { force: vector(&rhs[self.pin_at(pin)..]) }).collect())
    }
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |r| (0..n).map(move |c| (r, c)))
}
