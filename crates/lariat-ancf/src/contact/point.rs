//! One contact over a step: its force, its tangent, and what it does to the energy.

use super::evaluation::{Between, Evaluation, Row};
use super::glide::Glide;
use super::impulse::Impact;
use super::law::{NormalLaw, Stick, friction, spring_energy, stick_damping};
use super::linear::{About, Linear, Roll, Tangents};
use super::path::ObstacleStep;
use super::rebound::{Push, Rebound, is_resolved, thrown};
use crate::element::shape::combine;
use crate::obstacle::Patch;
use crate::scales::contact::{CLOSING_TIME, IMPACT, LIFTED, SLOW};
use crate::state::{ContactMemory, Key};
use nalgebra::Vector3;

/// A material point that can touch an obstacle in the present step.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct ContactPoint {
    pub key: Key,
    /// Number of the obstacle.
    pub obstacle: usize,
    pub xi: f64,
    /// Shape functions of its element.
    pub shape: [f64; 4],
    /// Length in m that it stands for.
    pub weight: f64,
    pub law: NormalLaw,
    /// Mass in kg/m that moves with it, at least.
    pub mass: f64,
    /// What it may give back in the step.
    pub rebound: Rebound,
    /// Coefficient of friction.
    pub friction: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Speed in m/s across it with which the cable came when it first touched, negative once it
    /// leaves; 0 without restitution, and if it comes again.
    pub came: f64,
    /// Of two cables the speed in m/s with which came what it stores; 0 where that was pressed.
    pub speed: f64,
    /// Gap in m at which it touches: radius and skin.
    pub reach: f64,
    pub patch: Patch,
    /// Depth in m at the beginning, offset and all; negative where there is a gap.
    pub depth_before: f64,
    /// Depth in m that does not count, at the beginning.
    pub offset: f64,
    /// What of it counts at the end.
    pub closing: f64,
    /// Whether losses pay for that, not what moved the obstacle.
    pub pays: bool,
    /// Energy in J that others gave when they moved the obstacle, for closing the offset.
    pub given: f64,
    /// Whether it touched when the last step ended.
    pub touched: bool,
    /// Normal force in N at the end of the last step.
    pub remembered: f64,
    /// Where it acts, if that is between the closest points of beginning and end.
    pub between: Option<Between>,
    /// Distance in m from the surface at the beginning.
    pub distance: f64,
    /// Position at the beginning.
    pub start: Vector3<f64>,
    /// Spring of friction at the beginning, in the obstacle's axes.
    pub spring: Vector3<f64>,
    /// Largest friction in N.
    pub bound: f64,
    /// Whether that is the bound of the present step.
    pub renewed: bool,
    /// Distance in m by which it may move beside the obstacle without touching it: the gap of a
    /// patch changes no faster than that.
    pub free_way: f64,
    /// Number of the feature that it touches among those that are near.
    pub nearby: Option<usize>,
    /// Number of what it remembers.
    pub recalls: Option<usize>,
    /// How it moves along its element.
    pub roll: Option<Roll>,
    /// The tangent of the cable, of a sample beside a sharp part of the obstacle.
    pub glide: Option<Glide>,
    /// What the last linear solve was made with.
    pub linear: Linear,
    /// The depth and the friction about which the next one is.
    pub about: About,
    /// At the end of the present iterate.
    pub now: Evaluation,
    /// What it does to the velocity across it when the step ends.
    pub impact: Impact,
}

impl ContactPoint {
    /// Takes up what was remembered of it: the spring and the bound of friction, and the depth,
    /// beyond which nothing counts: the offset. Of an obstacle on a body that was moved since then,
    /// by an engine, the difference has either sign, and closes by the engine's work.
    pub fn recall(&mut self, y: &Vector3<f64>, obstacle: &ObstacleStep, memory: Option<&ContactMemory>) {
        let depth = self.depth_at(self.patch.gap(y).0);
        self.depth_before = depth;
        self.free_way = if memory.is_none() { -depth } else { 0.0 };
        let difference = depth.max(0.0) - memory.map_or(0.0, |memory| memory.depth);
        (self.offset, self.closing, self.pays) = (difference.max(0.0), 0.0, false);
        self.given = memory.map_or(0.0, |memory| memory.given);
        self.touched = memory.is_some();
        self.remembered = memory.map_or(0.0, |memory| memory.force);
        if let Some(memory) = memory {
            let difference = depth - memory.depth;
            if obstacle.moved && difference > -LIFTED * self.reach {
                self.given = (memory.given + memory.force * (difference - memory.offset)).max(0.0);
                self.offset = difference;
                self.closing = (difference * (obstacle.h / CLOSING_TIME).min(1.0)).min(self.affordable(memory.depth));
                self.remembered = 0.0;
            }
            self.spring = memory.spring;
            self.came = memory.came;
            self.speed = memory.speed;
            self.bound = self.friction * memory.force;
        }
        self.rebound = Rebound::default();
    }

    /// Returns by how much in m it can become deeper than a depth (m) by the energy that others
    /// gave.
    fn affordable(&self, depth: f64) -> f64 {
        let depth = depth.max(0.0);
        let energy = self.law.at(depth).energy + self.given / self.weight;
        (self.law.depth_of_energy(energy) - depth).max(0.0)
    }

    /// Returns whether a step of length `h` (s) resolves a touch at a speed (m/s).
    pub fn is_resolved(&self, h: f64, speed: f64) -> bool {
        is_resolved(&self.law, h, self.mass, speed)
    }

    /// Returns the speed in m/s with which a depth (m), offset and all, would be left: that at
    /// which its store throws its own mass, and no more than what came with a `speed`.
    pub fn returns(&self, depth: f64, speed: f64) -> f64 {
        let thrown = thrown(&self.law, self.mass, depth);
        if speed > 0.0 { thrown.min(speed) } else { thrown }
    }

    /// Returns its speed at the end of a step of length `h` (s): what is stored comes up with the
    /// same share of the speed with which it came.
    pub fn speed_after(&self, h: f64) -> f64 {
        let Evaluation { start, depth, .. } = self.now;
        let closes = (depth - start) / h;
        if self.speed == 0.0 && closes <= IMPACT {
            return 0.0;
        }
        let before = self.law.at(start + self.offset).energy;
        let after = self.law.at(depth + self.offset - self.closing).energy;
        let kept = if after < before { self.speed * (after / before).sqrt() } else { self.speed };
        let speed = if closes > IMPACT { kept.max(closes) } else { kept };
        if speed > SLOW { speed } else { 0.0 }
    }

    /// Returns whether restitution gives back what comes: of one that touches first, or came and
    /// has not come again.
    pub fn bounces(&self) -> bool {
        self.restitution > 0.0 && (!self.touched || self.came != 0.0)
    }

    /// Finds what restitution gives back in the step, in a formula with the coefficient b; `moves`
    /// is its motion beside the obstacle in the step with the velocities at the beginning.
    pub fn find_rebound(&mut self, obstacle: &ObstacleStep, b: f64, moves: impl FnOnce() -> Vector3<f64>) {
        if self.restitution > 0.0 && !self.bounces() {
            return;
        }
        let normal = self.patch.over_step(obstacle, &self.start, &Vector3::zeros(), None).normal;
        self.find_law(normal.dot(&moves()) / obstacle.h, (obstacle.h, b));
    }

    /// Finds what it gives back in a step of length `h` (s), if it opens with a speed (m/s) when
    /// that begins, in a formula with the coefficient b. Without restitution what is born deep
    /// counts as what fell so deep.
    pub fn find_law(&mut self, opens: f64, (h, b): (f64, f64)) {
        if self.restitution > 0.0 {
            let came = if self.touched { self.came.abs() } else { (-opens).max(0.0) };
            self.rebound = Rebound::new(self.restitution * came, opens, b, self.is_resolved(h, came));
            return;
        }
        if self.speed > 0.0 {
            self.speed = self.speed.max(thrown(&self.law, self.mass, self.offset));
        }
        self.rebound = Rebound::dead(self.returns(self.depth_before, self.speed), opens, b);
    }

    /// Returns the depth in m of the closest point where the gap of this one is `gap`.
    fn depth_at(&self, gap: f64) -> f64 {
        self.reach + self.between.map_or(0.0, |between| between.excess) - gap
    }

    /// Returns the energy in J that it would cost to close the offset, under the force of the last
    /// step.
    fn cost(&self) -> f64 {
        self.remembered * self.offset
    }

    /// Returns the share of offsets that contacts can close at a cost of at most `budget` (J), and
    /// no more than `most`.
    pub fn affordable_share<'a>(points: impl Iterator<Item = &'a Self>, most: f64, budget: f64) -> f64 {
        let cost: f64 = points.map(ContactPoint::cost).sum();
        if most * cost > budget { budget / cost } else { most }
    }

    /// Makes its offset smaller by an energy (J), which it stores.
    pub fn take_up(&mut self, energy: f64) {
        if energy > 0.0 {
            let stored = self.law.at(self.depth_before - self.offset).energy + energy / self.weight;
            self.offset = (self.depth_before - self.law.depth_of_energy(stored)).clamp(0.0, self.offset);
        }
    }

    /// Closes a share of the offset.
    pub fn close(&mut self, share: f64) {
        if self.remembered > 0.0 && self.offset > 0.0 {
            (self.closing, self.pays) = (share * self.offset, true);
        }
    }

    /// Returns the energy in J that it stores at the beginning.
    pub fn energy_before(&self) -> f64 {
        let depth = self.depth_before - self.offset;
        self.weight * self.law.at(depth).energy + spring_energy(self.law.stiffness * self.weight, &self.spring)
    }

    /// Returns its normal force as a function of the depth at the end of a step of length `h` (s),
    /// from that at its start.
    pub fn push(&self, start: f64, h: f64) -> Push<'_> {
        Push { law: &self.law, rebound: self.rebound, start, h }
    }

    /// Returns the row of its normal force.
    pub fn row(&self) -> Row {
        self.between.map_or(Row { shape: self.shape, start: self.start }, |between| between.row)
    }

    /// Returns the change of its position.
    pub fn change(&self, change: &[f64]) -> Vector3<f64> {
        combine(change, self.key.0 as usize, &self.shape)
    }

    /// Evaluates it for a change of its position over the step, and sets its tangents, which are
    /// zero, if they are asked for.
    pub fn evaluate(
        &self,
        obstacle: &ObstacleStep,
        change: &Vector3<f64>,
        about: About,
        mut tangents: Option<&mut Tangents>,
    ) -> Evaluation {
        if self.free_way > 0.0 && about.depth.is_none() && self.linear.slope == 0.0 {
            let slip = obstacle.slip(&self.start, change);
            if slip.norm_squared() < self.free_way * self.free_way {
                return Evaluation { slip, ..Evaluation::default() };
            }
        }
        let meets = self.between.is_none().then_some(self.reach);
        let gap = self.patch.over_step(obstacle, &self.start, change, meets);
        let depth = self.depth_at(gap.end) - (self.offset - self.closing);
        let start = self.depth_at(gap.start) - self.offset;
        let stiffness = self.weight * self.law.stiffness;
        let u0 = obstacle.middle * self.spring;
        let before = self.weight * self.law.at(start).energy;
        let push = self.push(start, obstacle.h);
        let end = push.at(depth);
        let after = self.weight * end.energy;
        let slip = obstacle.slip(&self.start, change);
        let glide = self.glide.filter(|_| !self.rebound.elastic);
        let along = |pressure: f64| glide?.along(&self.law, (start, pressure), &gap.mean, &slip);
        if end.force <= 0.0 && about.depth.is_none() {
            let loss = before - after + spring_energy(stiffness, &u0);
            let mut out =
                Evaluation { depth, start, normal: gap.normal, slip, loss, energy: after, ..Evaluation::default() };
            if let Some(along) = along(0.0) {
                out.force = along.force * self.weight;
                out.arm = obstacle.arm(&self.start, change);
                out.loss -= along.work * self.weight;
            }
            return out;
        }
        let (mut pressure, mut slope) = (end.force, end.slope);
        if let Some(about) = about.depth {
            let at = push.at(about);
            (pressure, slope) = (at.force + at.slope * (depth - about), at.slope);
        }
        let normal = self.between.map_or(gap.normal, |between| obstacle.end.rotation * between.normal);
        if let Some(tangents) = &mut tangents {
            // symmetric, of the derivative between the mean normal and the one of the end
            let row = 0.5 * (gap.mean + normal);
            (tangents.normal, tangents.across) = (row * row.transpose() * (self.weight * slope), row);
        }
        let normal_force = self.weight * pressure;
        let mut out = Evaluation {
            force: gap.mean * normal_force,
            arm: obstacle.arm(&self.start, change),
            slip,
            replaced: gap.replaced,
            normal_force,
            normal,
            depth,
            start,
            energy: after,
            loss: before - after - normal_force * (gap.mean.dot(&slip) - self.closing),
            work: normal_force * self.closing,
            pressure,
            slope,
            ..Evaluation::default()
        };
        if let Some(along) = along(pressure) {
            out.force += along.force * self.weight;
            out.loss -= along.work * self.weight;
        }
        if self.pays {
            out.loss -= out.work;
            out.work = 0.0;
        }
        if self.friction > 0.0 {
            let is_constant = gap.mean == gap.normal;
            let mean = if is_constant { gap.mean } else { gap.mean.try_normalize(0.0).unwrap_or(gap.normal) };
            // on a body that is an unknown of the step the spring is alone
            let damping = match obstacle.body {
                None => self.weight * stick_damping(self.law.stiffness, self.mass) / obstacle.h,
                Some(_) => 0.0,
            };
            let stick = Stick { stiffness, damping, bound: self.bound, sticks: about.sticks };
            let friction = friction(&stick, &mean, &u0, &slip);
            out.friction = -friction.force;
            out.force += out.friction;
            if let Some(tangents) = tangents {
                tangents.friction = friction.tangent(&mean);
            }
            out.spring = friction.spring;
            out.slides = friction.slides;
            out.energy += spring_energy(stiffness, &friction.spring);
            out.loss += friction.loss;
            out.friction_loss = friction.loss;
        }
        if obstacle.driven {
            out.work += out.force.dot(&(change - slip));
        }
        out
    }

    /// Returns whether it is remembered: it pushes, or it opens too fast to push but is still deep.
    pub fn is_kept(&self) -> bool {
        self.now.normal_force > 0.0 || self.now.energy > 0.0
    }

    /// Returns what is remembered of it at the end of the step.
    pub fn memory(&self, obstacle: &ObstacleStep) -> ContactMemory {
        let (now, (element, key, place)) = (&self.now, self.key);
        ContactMemory {
            element,
            place,
            obstacle: key,
            xi: self.xi,
            weight: self.weight,
            patch: self.patch,
            normal: obstacle.end.rotation.tr_mul(&now.normal),
            depth: now.depth,
            offset: self.offset - self.closing,
            given: (self.given - if self.pays { 0.0 } else { now.normal_force * self.closing }).max(0.0),
            spring: obstacle.middle.tr_mul(&now.spring),
            force: now.normal_force,
            energy: now.energy,
            friction_power: now.friction_loss / obstacle.h,
            direction: now.normal,
            friction: now.friction,
            slips: now.slides.is_some(),
            came: self.came,
            speed: 0.0,
        }
    }
}

#[cfg(test)]
mod tests;
