//! All contacts of a cable over a step.

use super::border::{Border, Borders};
use super::linear::Tangents;
use super::nearby::Nearby;
use super::path::{BodyPath, ObstacleStep};
use super::place::Place;
use super::point::ContactPoint;
use crate::element::assembly::{add_force, add_tangent};
use crate::element::shape::combine;
use crate::linalg::BlockTridiagonal;
use crate::obstacle::Obstacle;
use crate::one_leg::OneLeg;
use crate::scales::contact::AGAINST;
use crate::state::{ContactMemory, Key};
use crate::term::{Account, Balance};
use nalgebra::{Matrix3, Vector3};

/// The contacts of a step, and what may become one; empty for a cable that is near nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactStep {
    pub(super) points: Vec<ContactPoint>,
    /// Samples that are near an obstacle, but not near enough to be a contact.
    pub(super) watched: Vec<ContactPoint>,
    /// Thin and sharp features that an element may touch.
    pub(super) nearby: Vec<Nearby>,
    /// Where an element went through one when that was last asked.
    pub passed: Option<Place>,
    /// Where an element entered one that was not found before, when that was last asked.
    pub missed: Option<Place>,
    /// Whether friction missed its bounds when that was last asked.
    pub lags: bool,
    pub(super) obstacles: Vec<ObstacleStep>,
    /// By contact of the memory, whether a point took it up.
    pub(super) recalled: Vec<bool>,
    /// Where the contact of the next sample is in the memory, if it is that of the sample after the
    /// last one found.
    pub(super) next: u32,
    /// Number of tests of whether elements are near obstacles and their features.
    pub(super) tests: u64,
    /// Length of the step in s.
    pub(super) h: f64,
    pub(super) leg: OneLeg,
    /// Share of every offset that closes in the step.
    pub(super) closes: f64,
    /// Columns of the bodies that are touched, as the last linear solve sees them.
    borders: Borders,
    /// Energy in J that the contacts store at the beginning.
    pub(super) before: f64,
    /// Energy in J that was remembered: what is more than that is lost.
    pub(super) stored: f64,
}

/// What contacts do to the energy in a step, in J, and how far the linear solve was off.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactBalance {
    /// Energy that they lose.
    pub loss: f64,
    /// Energy that was remembered and that no contact took up.
    pub left: f64,
    /// Work of obstacles that move.
    pub obstacles: f64,
    /// Work on the cable.
    pub work: f64,
    /// Energy that they stored at the beginning.
    pub before: f64,
    /// Sum in N of the differences between their forces and what the linear solve believed.
    pub missed: f64,
    /// Sum in N of their forces.
    pub forces: f64,
}

impl ContactBalance {
    /// Adds what contacts do in a step of length `h` (s) to its balance.
    pub fn add_to(&self, balance: &mut Balance, h: f64) {
        balance.nonsmooth = true;
        balance.held += self.before;
        balance.impulse += h * self.forces;
        let entry = balance.to(Account::Contacts);
        entry.loss += self.loss;
        entry.aside += self.left;
        entry.work += self.obstacles;
        entry.missed += self.missed;
        entry.forces += self.forces;
    }
}

impl ContactStep {
    /// Returns whether nothing is near.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty() && self.watched.is_empty()
    }

    /// Returns whether an obstacle is near that no body of the island carries.
    pub fn is_held(&self) -> bool {
        let mut near = self.points.iter().chain(&self.watched);
        near.any(|point| self.obstacles[point.obstacle].body.is_none())
    }

    /// Returns the number of contacts that are evaluated.
    pub fn count(&self) -> u64 {
        self.points.len() as u64
    }

    /// Returns the number of tests of whether elements are near obstacles and their features, since
    /// that was last asked.
    pub fn take_tests(&mut self) -> u64 {
        core::mem::take(&mut self.tests)
    }

    /// Moves the obstacles that bodies of the island carry with these.
    pub fn follow(&mut self, obstacles: &[Obstacle], bodies: &[BodyPath]) {
        for (step, obstacle) in self.obstacles.iter_mut().zip(obstacles) {
            if let Some(mount) = &obstacle.mount {
                *step = ObstacleStep::carried(mount, &bodies[mount.body], self.h);
            }
        }
    }

    /// Returns the bodies that are touched as the last linear solve sees them.
    pub fn borders(&self) -> &[Border] {
        if self.points.is_empty() { &[] } else { self.borders.get() }
    }

    /// Adds the impulses on bodies to their rows, about their centres: those at the iterate, or
    /// those about which the next solve is linear.
    pub fn pass_impulses(&self, linear: bool, rows: &mut [f64]) {
        for point in &self.points {
            let Some(body) = self.obstacles[point.obstacle].body else { continue };
            let (force, arm) =
                if linear { (point.linear.force, point.linear.arm) } else { (point.now.force, point.now.arm) };
            let impulse = force * -self.h;
            let angular = arm.cross(&impulse);
            for x in 0..3 {
                rows[6 * body + x] += impulse[x];
                rows[6 * body + 3 + x] += angular[x];
            }
        }
    }

    /// Adds h times the forces, linear about an iterate, to `rhs`, and `b h^2` times their tangents
    /// to the matrix and to the columns of the bodies that carry obstacles.
    pub fn linearise(&mut self, change: &[f64], rhs: &mut [f64], matrix: &mut BlockTridiagonal) {
        let (h, b) = (self.h, self.leg.b);
        self.borders.begin(rhs.len());
        for point in &mut self.points {
            point.linearise(&self.obstacles[point.obstacle], |e, shape| combine(change, e, shape));
            let linear = &point.linear;
            let Tangents { normal, friction, .. } = linear.tangents;
            if normal == Matrix3::zeros() && linear.force == Vector3::zeros() {
                continue;
            }
            add_force(rhs, point.key.0 as usize, &point.shape, &(linear.force * h));
            let element = point.key.0 as usize;
            // one matrix where both act at the same place
            let parts = match point.between {
                None => [(normal + friction, &point.shape), (Matrix3::zeros(), &point.shape)],
                Some(_) => [(normal, &linear.row.shape), (friction, &point.shape)],
            };
            for (tangent, shape) in parts.into_iter().filter(|(tangent, _)| *tangent != Matrix3::zeros()) {
                let tangent = tangent * (b * h * h);
                if let Some(body) = self.obstacles[point.obstacle].body {
                    self.borders.add(body, element, shape, &tangent, &linear.lever);
                }
                add_tangent(matrix, element, shape, &tangent);
            }
            if let Some(roll) = &point.roll {
                let stiffness = linear.normal_force * roll.length * (roll.share * b * h * h);
                let normal = linear.normal;
                add_tangent(matrix, element, &roll.slope, &(normal * normal.transpose() * stiffness));
            }
        }
    }

    /// Adds h times the forces at an iterate to `rhs`, and returns what they do.
    pub fn balance(&mut self, change: &[f64], rhs: &mut [f64]) -> ContactBalance {
        let left = (self.stored - self.before).max(0.0);
        let mut sum = ContactBalance { before: self.before, left, ..ContactBalance::default() };
        for point in &mut self.points {
            let moved = point.change(change);
            sum.missed += point.follow(&self.obstacles[point.obstacle], |e, shape| combine(change, e, shape));
            let now = &point.now;
            sum.forces += now.force.norm();
            sum.loss += now.loss;
            sum.obstacles += now.work;
            sum.work += now.force.dot(&moved);
            if now.force != Vector3::zeros() {
                let force = now.force * self.h;
                add_force(rhs, point.key.0 as usize, &point.shape, &force);
            }
        }
        sum
    }

    /// Remembers the contacts that touch at the end of the step.
    pub fn remember(&self, memory: &mut Vec<ContactMemory>) {
        memory.clear();
        for point in self.points.iter().filter(|point| point.is_kept()) {
            let speed = if point.restitution == 0.0 { point.speed_after(self.h) } else { 0.0 };
            memory.push(ContactMemory { speed, ..point.memory(&self.obstacles[point.obstacle]) });
        }
        // of several points on a feature the one that carries most
        memory.sort_unstable_by(|a, b| a.key().cmp(&b.key()).then(b.force.total_cmp(&a.force)));
        memory.dedup_by_key(|contact| contact.key());
        forget_speeds(memory);
    }
}

/// Forgets with which speed came what contacts store that do not press the cable against others:
/// their mass is that of the cable. Contacts are in the order of their keys.
fn forget_speeds(memory: &mut [ContactMemory]) {
    let mut first = 0;
    for i in 0..memory.len() {
        let ContactMemory { element, obstacle, direction, speed, .. } = memory[i];
        if speed == 0.0 {
            continue;
        }
        first += memory[first..i].iter().take_while(|other| other.element + 1 < element).count();
        let near = memory[first..].iter().take_while(|other| other.element <= element + 1);
        let mut others = near.filter(|other| other.obstacle != obstacle);
        if !others.any(|other| other.direction.dot(&direction) < AGAINST) {
            memory[i].speed = 0.0;
        }
    }
}

/// Returns the contact with a key; `next` is where it is looked for first.
pub(super) fn find_from(memory: &[ContactMemory], next: usize, key: Key) -> Option<usize> {
    if memory.get(next).is_some_and(|memory| memory.key() == key) { Some(next) } else { find(memory, key) }
}

/// Returns the contact with a key.
pub(super) fn find(memory: &[ContactMemory], key: Key) -> Option<usize> {
    memory.binary_search_by_key(&key, ContactMemory::key).ok()
}
