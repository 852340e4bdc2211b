//! Where contacts are: samples on faces, closest points on features, found when a step begins and
//! completed while it is iterated.
//!
//! # Validity
//!
//! An element is looked at if the ball about its Bezier polygon, of a long one a part of its curve
//! ([`tube`](super::tube)), grown by 1.5 times its way relative to the obstacle, comes near, and so
//! is a feature. What a point cannot reach in the way that it moves (distances grow no faster than
//! the way) is not looked at again; the rest is traced along its way to the surface, at every
//! iterate.

use super::motion::Motion;
use super::nearby::Nearby;
use super::pair::{PLACES, Pair, bounding_ball, is_thin, samples};
use super::path::ObstacleStep;
use super::point::ContactPoint;
use super::step::{ContactStep, find, find_from};
use super::tube::Tube;
use crate::element::shape::combine;
use crate::obstacle::Patch;
use crate::obstacle::trace;
use crate::obstacle::{Feature, Nearest};
use crate::scales::contact::{APART, LONG, NEAR, OFFSET_TIME, PAID, SWEEP};
use crate::state::ContactMemory;
use nalgebra::Vector3;

impl ContactStep {
    /// Begins a step.
    pub fn begin(&mut self, motion: &Motion<'_>) {
        self.points.clear();
        self.watched.clear();
        self.nearby.clear();
        (self.before, self.next) = (0.0, 0);
        self.stored = motion.memory.iter().map(|memory| memory.energy).sum();
        let Some(contact) = &motion.model.effects.contact else { return };
        let obstacles = &motion.model.obstacles.0;
        if obstacles.is_empty() {
            return;
        }
        (self.h, self.leg) = (motion.h, motion.leg);
        self.obstacles.clear();
        self.obstacles.extend(obstacles.iter().map(|obstacle| match &obstacle.mount {
            Some(mount) => ObstacleStep::carried(mount, &motion.bodies[mount.body], motion.h),
            None => ObstacleStep::new(&obstacle.motion, motion.time, motion.h),
        }));
        self.recalled.clear();
        self.recalled.resize(motion.memory.len(), false);
        let mut begin = 0.0;
        for (element, section) in motion.model.elements.iter().enumerate() {
            let from = begin;
            begin += section.length;
            if motion.model.is_at_eye(element) {
                continue;
            }
            let (centre, size, way) = bounding_ball(motion, element, section.length);
            let radius = contact.radius_of(&section.section);
            for (number, obstacle) in obstacles.iter().enumerate() {
                let step = self.obstacles[number];
                let way = SWEEP * (way + step.way(&centre, size));
                let margin = radius * (1.0 + APART) + obstacle.skin + way;
                let near = size + margin;
                let own = step.start.own(&centre);
                let is_long = size > LONG * margin;
                let tube = Tube { q: motion.q, element, length: section.length, pose: &step.start, margin };
                let mut may_meet = |centre: &Vector3<f64>, radius: f64| {
                    self.tests += 1;
                    obstacle.surface.may_meet(centre, radius)
                };
                if !may_meet(&own, near) || is_long && !tube.any(&mut may_meet) {
                    continue;
                }
                let pair = Pair { motion, contact, element, section, from, number, obstacle, step, radius };
                let first = [self.points.len(), self.watched.len()];
                self.add_samples(&pair);
                let mut sharp = false;
                obstacle.surface.features(&own, near, &mut |feature| {
                    let mut is_near = |centre: &Vector3<f64>, radius: f64| {
                        let limit = radius + feature.radius;
                        feature.distance_squared(centre) <= limit * limit
                    };
                    self.tests += 1;
                    let close = is_near(&own, near);
                    sharp |= close && feature.radius == 0.0;
                    if !close || is_long && !tube.any(&mut is_near) {
                        return;
                    }
                    let straight = if pair.is_wide(feature.radius) { pair.straightness(&feature) } else { Some(1.0) };
                    if let Some(straight) = straight {
                        let round = pair.is_wide(feature.radius).then_some(straight);
                        self.nearby.push(Nearby { element, from, obstacle: number, feature, round, start: None });
                        self.add_feature(&pair, &feature);
                    }
                });
                if sharp {
                    let samples = self.points[first[0]..].iter_mut().chain(&mut self.watched[first[1]..]);
                    samples
                        .filter(|point| point.key.2 < PLACES)
                        .for_each(|point| point.glide = Some(pair.glide(point.xi)));
                }
            }
        }
        self.hand_over(motion.memory);
        self.leave_to_closest(motion);
        self.close_offsets(PAID * motion.lost * motion.h);
        self.before = self.points.iter().map(ContactPoint::energy_before).sum();
        for point in &mut self.points {
            point.find_rebound_of(&self.obstacles, motion);
        }
        self.follow_closest(motion);
    }

    /// Closes offsets, at a cost of at most `budget` (J).
    fn close_offsets(&mut self, budget: f64) {
        self.closes = ContactPoint::affordable_share(self.points.iter(), (self.h / OFFSET_TIME).min(1.0), budget);
        self.points.iter_mut().for_each(|point| point.close(self.closes));
    }

    /// Adds the samples of an element that are near an obstacle.
    fn add_samples(&mut self, pair: &Pair<'_>) {
        for (place, xi, weight) in samples(pair.contact, pair.motion.model, pair.element) {
            if pair.is_apart(xi) {
                continue;
            }
            // written where it stays: a contact is large
            let count = self.points.len();
            self.points.resize_with(count + 1, ContactPoint::default);
            let point = &mut self.points[count];
            pair.place(point, (place, xi, weight));
            let y = pair.step.start.own(&point.start);
            let nearest = pair.obstacle.surface.nearest(&y);
            point.distance = nearest.distance;
            let index = find_from(pair.motion.memory, self.next as usize, point.key);
            self.next = index.map_or(self.next, |i| i as u32 + 1);
            let memory = index.map(|i| &pair.motion.memory[i]);
            if let Some(kept) = memory.filter(|memory| is_behind(&memory.patch, &y, &nearest)) {
                point.patch = kept.patch;
            } else {
                point.patch = nearest.patch;
                if pair.is_thin(&nearest) || nearest.distance - point.reach > NEAR * pair.radius {
                    let end = pair.step.end.own(&(point.start + point.change(pair.motion.change)));
                    match trace(&*pair.obstacle.surface, [&y, &end], point.reach, |found| !pair.is_thin(found)) {
                        Some(met) if !point.is_inside(&met.patch, &y) => point.patch = met.patch,
                        _ => {
                            self.watched.extend(self.points.pop());
                            continue;
                        }
                    }
                }
            }
            point.recall(&y, &pair.step, memory);
            index.into_iter().for_each(|i| self.recalled[i] = true);
        }
    }

    /// Adds the closest point of an element on a feature, if it has one that is near.
    fn add_feature(&mut self, pair: &Pair<'_>, feature: &Feature) {
        let share = pair.meeting(feature);
        let Some(xi) = pair.closest(feature, share).filter(|xi| !pair.is_apart(*xi)) else { return };
        let mut point = pair.feature_point(feature, xi);
        let y = pair.step.start.own(&point.start);
        let Some((patch, z)) = feature.patch(&y) else { return };
        let end = pair.step.end.own(&(point.start + point.change(pair.motion.change)));
        point.distance = z.norm() - feature.radius;
        if point.distance - point.reach > APART * pair.radius + SWEEP * (end - y).norm() {
            return;
        }
        let index = find(pair.motion.memory, point.key);
        let memory = index.map(|i| &pair.motion.memory[i]);
        point.patch = pair.one_sided(feature, (patch, y, z), memory);
        if memory.is_none() && point.patch != patch && point.distance > point.reach {
            return;
        }
        point.recall(&y, &pair.step, memory);
        (point.nearby, point.recalls) = (Some(self.nearby.len() - 1), index);
        index.into_iter().for_each(|i| self.recalled[i] = true);
        self.points.push(point);
    }

    /// Hands what a feature remembers of one element to its neighbour, where the closest point has
    /// moved over their node.
    fn hand_over(&mut self, memory: &[ContactMemory]) {
        for point in self.points.iter_mut().filter(|point| point.key.2 >= PLACES) {
            let (element, obstacle, place) = point.key;
            if find(memory, point.key).is_some() {
                continue;
            }
            let neighbours = [element.checked_sub(1), element.checked_add(1)];
            let left = neighbours.into_iter().flatten().filter_map(|e| find(memory, (e, obstacle, place)));
            for i in left {
                if !self.recalled[i] && memory[i].weight == point.weight {
                    self.recalled[i] = true;
                    let y = self.obstacles[point.obstacle].start.own(&point.start);
                    point.recall(&y, &self.obstacles[point.obstacle], Some(&memory[i]));
                    point.recalls = Some(i);
                    break;
                }
            }
        }
    }

    /// Adds samples that an iterate carries into an obstacle although they were not near, or on
    /// another way than expected.
    pub fn complete(&mut self, motion: &Motion<'_>) {
        let Motion { model, change, .. } = *motion;
        self.follow_closest(motion);
        let Some(contact) = &model.effects.contact else { return };
        let surface = |point: &ContactPoint| &*model.obstacles.0[point.obstacle].surface;
        let thin = |point: &ContactPoint, found: &Nearest| {
            let element = &model.elements[point.key.0 as usize];
            is_thin(found, contact.radius_of(&element.section), element.length)
        };
        let meets = |point: &ContactPoint, obstacle: &ObstacleStep| {
            let (y0, y1) = point.way(obstacle, change);
            if (y1 - y0).norm() <= point.distance - point.reach {
                return None;
            }
            let met = trace(surface(point), [&y0, &y1], point.reach, |found| !thin(point, found))?;
            (point.is_inside(&met.patch, &y1) && !point.is_inside(&met.patch, &y0)).then_some((met.patch, y0))
        };
        let may_meet = |point: &&mut ContactPoint| point.key.2 < PLACES && point.depth_before <= 0.0;
        for point in self.points.iter_mut().filter(may_meet) {
            let obstacle = &self.obstacles[point.obstacle];
            let (_, y1) = point.way(obstacle, change);
            if !point.is_inside(&point.patch, &y1)
                && let Some((patch, _)) = meets(point, obstacle)
            {
                (point.patch, point.free_way) = (patch, 0.0);
            }
        }
        let mut i = 0;
        while i < self.watched.len() {
            let mut point = self.watched[i];
            match meets(&point, &self.obstacles[point.obstacle]) {
                None => i += 1,
                Some((patch, y0)) => {
                    self.watched.swap_remove(i);
                    point.patch = patch;
                    point.recall(&y0, &self.obstacles[point.obstacle], None);
                    point.find_rebound_of(&self.obstacles, motion);
                    self.points.push(point);
                }
            }
        }
    }
}

impl ContactPoint {
    /// Returns whether it is one of an element or of its neighbours, with an obstacle.
    pub(super) fn touches(&self, obstacle: usize, element: usize) -> bool {
        self.obstacle == obstacle && (self.key.0 as usize).abs_diff(element) <= 1
    }

    /// Finds what restitution gives back in the step.
    pub(super) fn find_rebound_of(&mut self, obstacles: &[ObstacleStep], motion: &Motion<'_>) {
        let (element, shape, start) = (self.key.0 as usize, self.shape, self.start);
        let obstacle = &obstacles[self.obstacle];
        self.find_rebound(obstacle, motion.leg.b, || {
            obstacle.slip(&start, &(combine(motion.v, element, &shape) * obstacle.h))
        });
    }

    /// Returns whether it touches a patch at `y`. A sample that comes from beside a face is behind
    /// the face's plane before it is at the face: it would begin deep there, where the contact of
    /// the edge holds it.
    fn is_inside(&self, patch: &Patch, y: &Vector3<f64>) -> bool {
        patch.gap(y).0 < self.reach
    }

    /// Returns its place in the obstacle's axes at the beginning and at the end of an iterate.
    pub(super) fn way(&self, obstacle: &ObstacleStep, change: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
        (obstacle.start.own(&self.start), obstacle.end.own(&(self.start + self.change(change))))
    }
}

impl Pair<'_> {
    /// Returns the patch of a feature at `y`, with the vector z to it from the core: where the
    /// memory is of the core's other side, the plane there. An edge that is met first pushes to its
    /// outer side, although the cable passes through the solid beside it.
    pub(super) fn one_sided(
        &self,
        feature: &Feature,
        (patch, y, z): (Patch, Vector3<f64>, Vector3<f64>),
        memory: Option<&ContactMemory>,
    ) -> Patch {
        let away = match memory {
            Some(memory) => (memory.normal.dot(&z) < 0.0).then_some(memory.normal),
            None if feature.radius == 0.0 => self.outer_side(&(y - z), &z),
            None => None,
        };
        away.map_or(patch, |normal| Patch::Plane { point: y - z, normal })
    }

    /// Returns the direction against z from an edge if that leads farther out of the solid than z.
    fn outer_side(&self, core: &Vector3<f64>, z: &Vector3<f64>) -> Option<Vector3<f64>> {
        let reach = self.radius + self.obstacle.skin;
        let direction = z.try_normalize(f64::MIN_POSITIVE)?;
        let out = |way: f64| self.obstacle.surface.nearest(&(core + direction * way)).distance;
        (out(-reach) > out(reach)).then_some(-direction)
    }
}

/// Returns whether a point that touched a patch is behind it, so that it keeps it.
fn is_behind(patch: &Patch, y: &Vector3<f64>, nearest: &Nearest) -> bool {
    let (gap, normal) = patch.gap(y);
    gap < 0.0 && (nearest.distance < 0.0 || nearest.patch.gap(y).1.dot(&normal) < 0.0)
}
