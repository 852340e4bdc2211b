//! The rows and matrices of an island: see [`island`](super) for the equations.

use super::rotation::{angular_acceleration, skew};
use super::workspace::{CableWork, Hold, Workspace, direction, vector};
use super::{PinConstraint, RigidBody};
use crate::cable::Cable;
use crate::effect::acts::{ForceInput, VelocityInput};
use crate::error::StepFailure;
use crate::integrate::{Dynamics, State};
use crate::support::SlopeSupport;
use crate::system::{Equations, project_matrix, project_vector};
use nalgebra::{Matrix3, Vector3};

/// Jumps of velocity at pins below this in m/s are rounding.
const LEAST_JUMP: f64 = 1e-10;

/// An island with its buffers: what the integrators see.
pub(crate) struct Work<'a, 'b> {
    pub cables: &'a mut [&'b mut Cable],
    pub bodies: &'a [RigidBody],
    pub pins: &'a [PinConstraint],
    pub workspace: &'a mut Workspace,
}

impl Work<'_, '_> {
    pub(super) fn body_at(&self, body: usize) -> usize {
        self.workspace.bodies_at + 6 * body
    }

    pub(super) fn pin_at(&self, pin: usize) -> usize {
        self.workspace.cables[self.pins[pin].cable].at + 6 * self.pins[pin].node
    }

    /// Adds to the rows of the bodies: their own loads times `scale`, their inertia, and what pins pass on from the rows of the
    /// cables. `k` are accelerations times `scale`, in the chart.
    pub(super) fn body_rows(&mut self, scale: f64, q: &[f64], v: &[f64], k: &[f64], rhs: &mut [f64]) {
        for i in 0..self.bodies.len() {
            let at = self.body_at(i);
            let motion = self.workspace.motion(i, &q[at..at + 6], &v[at..at + 6]);
            let body = &self.workspace.bodies[i];
            let inertia = body.world_inertia(&motion.rotation);
            let (theta, rate) = (vector(&q[at + 3..]), vector(&v[at + 3..]));
            let alpha = angular_acceleration(scale, &theta, &rate, &vector(&k[at + 3..]));
            let mut force = body.force * scale - body.mass * vector(&k[at..]);
            let gyroscopic =
                if body.gyroscopic { motion.spin.cross(&(inertia * motion.spin)) } else { Vector3::zeros() };
            let mut torque = (body.torque - gyroscopic) * scale - inertia * alpha;
            if let Some((momentum, spin)) = body.carried_momentum(&vector(&k[at..]), &alpha) {
                force -= momentum;
                torque -= spin;
            }
            rhs[at..at + 3].copy_from_slice(force.as_slice());
            rhs[at + 3..at + 6].copy_from_slice(torque.as_slice());
        }
        self.pass_pinned_rows(q, rhs);
    }

    /// Adds the rows of held coordinates to those of their bodies, as force and moment.
    pub(super) fn pass_pinned_rows(&self, q: &[f64], rhs: &mut [f64]) {
        for hold in self.workspace.cables.iter().flat_map(|work| &work.holds) {
            let passed = vector(&rhs[hold.at..]);
            self.pass(hold, &passed, &self.arm(hold, q), rhs);
        }
    }

    /// Adds what a hold passes on to the rows of its body.
    fn pass(&self, hold: &Hold, passed: &Vector3<f64>, arm: &Vector3<f64>, rhs: &mut [f64]) {
        let at = self.body_at(self.pins[hold.pin].body);
        let torque = arm.cross(passed);
        for x in 0..3 {
            if !hold.slope {
                rhs[at + x] += passed[x];
            }
            rhs[at + 3 + x] += torque[x];
        }
    }

    /// Gives the supports of cable `c` the directions of its clamps at `q`, and notes them as those of the matrix to be factored.
    fn aim(&mut self, c: usize, mass: bool, q: &[f64]) {
        let work = &mut self.workspace.cables[c];
        let supports = &mut self.cables[c].model.supports;
        let directions = if mass { &mut work.mass_directions } else { &mut work.step_directions };
        directions.clear();
        for hold in &work.holds {
            let mut d = Vector3::zeros();
            if hold.slope
                && let Some(SlopeSupport::Attached(held)) =
                    supports.iter_mut().find(|(n, _)| *n == hold.node).map(|(_, s)| &mut s.slope)
            {
                *held = direction(&q[hold.at..], held);
                d = *held;
            }
            directions.push(d);
        }
    }

    /// Brings pinned nodes to the velocity of their bodies as an inelastic impact does: with the impulse that it takes on both
    /// sides, so that momentum is kept when an engine, a user or a collision has changed a body's velocity.
    pub(super) fn meet(&mut self, phase: &mut State) -> Result<(), StepFailure> {
        let State { time, q, v, memory } = phase;
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
                let pin = self.pins.iter().position(|p| p.cable == c && p.node == node);
                if pin.is_none() {
                    jump[at..at + 3].fill(0.0);
                }
                if pin.is_none_or(|pin| self.workspace.clamps[pin].is_none()) {
                    jump[at + 3..at + 6].fill(0.0);
                }
                largest = largest.max(vector(&jump[at..]).norm()).max(vector(&jump[at + 3..]).norm());
            }
        }
        let outcome = if largest > LEAST_JUMP {
            memory.valid = false;
            self.share_jump(&jump, q, v)
        } else {
            Ok(())
        };
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
            cable.system.mass.multiply(cable.system.level, &jump[range.clone()], &mut rhs[range]);
        }
        self.pass_pinned_rows(q, &mut rhs);
        self.solve_rows(true, q, &mut rhs);
        self.account_jump(jump, q, v, &rhs);
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
            if let Some(carried) = &self.workspace.bodies[i].carried {
                for (r, c) in pairs(6) {
                    add(6 * i + r, 6 * i + c, carried[(r, c)]);
                }
            }
        }
        for work in &self.workspace.cables {
            let w = if mass { &work.mass.w } else { &work.step.w };
            let count = 3 * work.holds.len();
            for (a, hold) in work.holds.iter().enumerate() {
                let (arm, body) = (self.arm(hold, q), 6 * self.pins[hold.pin].body);
                if !mass {
                    let geometric = -skew(&vector(&rhs[hold.at..])) * skew(&arm);
                    let symmetric = (geometric + geometric.transpose()) * 0.5;
                    for (r, c) in pairs(3) {
                        add(body + 3 + r, body + 3 + c, symmetric[(r, c)]);
                    }
                }
                let ga = -skew(&arm);
                for (b, other) in work.holds.iter().enumerate() {
                    let block = Matrix3::from_fn(|r, c| w[(3 * a + r) * count + 3 * b + c]);
                    let gb = -skew(&self.arm(other, q));
                    let second = 6 * self.pins[other.pin].body;
                    let turned = block * gb;
                    for (r, c) in pairs(3) {
                        add(body + 3 + r, second + 3 + c, (ga.transpose() * turned)[(r, c)]);
                        if !hold.slope {
                            add(body + r, second + 3 + c, turned[(r, c)]);
                        }
                        if !other.slope {
                            add(body + 3 + r, second + c, (ga.transpose() * block)[(r, c)]);
                        }
                        if !hold.slope && !other.slope {
                            add(body + r, second + c, block[(r, c)]);
                        }
                    }
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
    pub(super) fn solve_rows(&mut self, mass: bool, q: &[f64], rhs: &mut [f64]) {
        for c in 0..self.cables.len() {
            let work = &self.workspace.cables[c];
            let cable = &mut *self.cables[c];
            let directions = if mass { &work.mass_directions } else { &work.step_directions };
            for (hold, factored) in work.holds.iter().zip(directions).filter(|(h, _)| h.slope) {
                // the matrix knows the direction that it was factored with
                let along = direction(&q[hold.at..], factored).dot(&vector(&rhs[hold.at..]));
                rhs[hold.at..hold.at + 3].copy_from_slice((factored * along).as_slice());
                if let Some((_, support)) = cable.model.supports.iter_mut().find(|(n, _)| *n == hold.node) {
                    support.slope = SlopeSupport::Attached(*factored);
                }
            }
            let rows = &mut rhs[work.at..work.at + work.size];
            project_vector(&cable.model, rows);
            let factorisation = if mass { &work.mass_factorisation } else { &cable.system.step.factorisation };
            factorisation.solve(cable.system.level, rows);
            cable.diagnostics_mut().solves += 1;
        }
        for work in &self.workspace.cables {
            let condensed = if mass { &work.mass } else { &work.step };
            for (h, hold) in work.holds.iter().enumerate() {
                let rows = &rhs[work.at..work.at + work.size];
                let passed = Vector3::from_fn(|x, _| -condensed.border(3 * h + x, rows));
                self.pass(hold, &passed, &self.arm(hold, q), rhs);
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
        for work in &self.workspace.cables {
            let (condensed, directions) =
                if mass { (&work.mass, &work.mass_directions) } else { (&work.step, &work.step_directions) };
            let displacement = |hold: &Hold, rhs: &[f64]| {
                let at = self.body_at(self.pins[hold.pin].body);
                let turned = vector(&rhs[at + 3..]).cross(&self.arm(hold, q));
                if hold.slope { turned } else { vector(&rhs[at..]) + turned }
            };
            for (h, hold) in work.holds.iter().enumerate() {
                let displacement = displacement(hold, rhs);
                let rows = &mut rhs[work.at..work.at + work.size];
                for x in 0..3 {
                    condensed.spread(3 * h + x, displacement[x], rows);
                }
            }
            for (hold, factored) in work.holds.iter().zip(directions) {
                let mut held = displacement(hold, rhs);
                if hold.slope {
                    let along = factored.dot(&vector(&rhs[hold.at..]));
                    held += direction(&q[hold.at..], factored) * along;
                }
                rhs[hold.at..hold.at + 3].copy_from_slice(held.as_slice());
            }
        }
    }

    pub(super) fn equations(&mut self, c: usize) -> (Equations<'_>, &mut CableWork) {
        (self.cables[c].equations().0, &mut self.workspace.cables[c])
    }

    /// Mass matrices of all cables, factored and condensed, and the bodies' matrix at this configuration.
    pub(super) fn factor_mass(&mut self, q: &[f64], v: &[f64]) -> Result<(), StepFailure> {
        let clamped = self.workspace.clamps.iter().any(Option::is_some);
        if !self.workspace.mass_ready || clamped {
            for c in 0..self.cables.len() {
                self.aim(c, true, q);
                let cable = &mut *self.cables[c];
                let work = &mut self.workspace.cables[c];
                let system = &mut cable.system;
                let matrix = &mut system.step.matrix;
                matrix.clear();
                system.mass.add_to(matrix, 1.0);
                work.mass.read(matrix, &work.holds);
                project_matrix(&cable.model, matrix);
                work.mass_factorisation.factor(system.level, matrix)?;
                work.mass
                    .complete(system.level, &work.mass_factorisation, &work.holds, |x| project_vector(&cable.model, x));
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
        velocity: VelocityInput<'_>,
        z: &[f64],
        rhs: &mut [f64],
        matrix: bool,
    ) -> Result<(), StepFailure> {
        let mut product = core::mem::take(&mut self.workspace.product);
        let mut outcome = Ok(());
        for c in 0..self.cables.len() {
            if matrix {
                self.aim(c, false, q);
            }
            let (mut equations, work) = self.equations(c);
            let range = work.at..work.at + work.size;
            let rows = &mut rhs[range.clone()];
            let velocity = VelocityInput { v: &velocity.v[range.clone()], ..velocity };
            let input = ForceInput { time, q: &q[range.clone()], velocity, scale };
            if matrix {
                equations.force_and_matrix(input, 1.0, rows);
                work.step.read(&equations.system.step.matrix, &work.holds);
                outcome = equations.factor_to_solve();
                if outcome.is_err() {
                    break;
                }
                let (level, model) = (equations.system.level, equations.model);
                work.step
                    .complete(level, &equations.system.step.factorisation, &work.holds, |x| project_vector(model, x));
            } else {
                equations.force(input, rows);
            }
            equations.system.mass.multiply(equations.system.level, &z[range.clone()], &mut product[range.clone()]);
            for (r, m) in rows.iter_mut().zip(&product[range]) {
                *r -= m;
            }
        }
        self.workspace.product = product;
        outcome
    }
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |r| (0..n).map(move |c| (r, c)))
}
