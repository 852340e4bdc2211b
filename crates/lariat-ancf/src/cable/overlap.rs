//! Whether a cable is in what it can touch: for shapes that were found without contact.

use super::Cable;
use crate::contact::{Overlap, between_samples};
use crate::element::shape::{self, combine};
use crate::scales::cable::{BETWEEN, OVERLAP_POINTS, SAME_SIDE, TOUCHDOWN_ERROR};
use crate::scales::contact::RAMP;
use core::ops::RangeInclusive;
use nalgebra::Vector3;

impl Cable {
    /// Returns by element whether it touched an obstacle in the last step.
    fn touching(&self) -> impl Iterator<Item = bool> + '_ {
        let mut touches = self.snapshot.state.memory.contacts.iter().map(|touch| touch.element as usize).peekable();
        (0..self.elements().len()).map(move |e| {
            let mut touching = false;
            while touches.next_if_eq(&e).is_some() {
                touching = true;
            }
            touching
        })
    }

    /// Returns the angle in rad between the slopes at two nodes.
    fn turn_between(&self, nodes: [usize; 2]) -> f64 {
        let q = self.positions();
        let [a, b] = nodes.map(|node| Vector3::from_column_slice(&q[6 * node + 3..6 * node + 6]));
        a.cross(&b).norm().atan2(a.dot(&b))
    }

    /// Returns the arc length (m) at which the cable leaves an obstacle within an element, and the
    /// share of the largest tension by which tensions may be off by that; where it is largest.
    /// Equation and validity: `warning/contact.rs`.
    pub(crate) fn touchdown_quality(&self) -> [f64; 2] {
        let (mut worst, mut begin, mut before) = ([0.0; 2], 0.0, None);
        for (e, (element, touches)) in self.elements().iter().zip(self.touching()).enumerate() {
            if before.is_some_and(|before| before != touches) && !self.model.is_at_eye(e) {
                // the element that touches last, and the one beside it
                let pair = [e - 1, e].map(|e| &self.elements()[e]);
                let length = f64::max(pair[0].length, pair[1].length);
                let mass = f64::max(pair[0].section.mass_per_length, pair[1].section.mass_per_length);
                let off = self.turn_between([e - 1, e + 1]) * length * mass * self.gravity().norm() / TOUCHDOWN_ERROR;
                if off > worst[1] {
                    worst = [begin, off];
                }
            }
            (begin, before) = (begin + element.length, Some(touches));
        }
        if worst[1] > 0.0 {
            let tension = self.peak_tension().1;
            worst[1] = if tension > 0.0 { worst[1] / tension } else { 0.0 };
        }
        worst
    }

    /// Returns the largest depth of the centre line between samples in obstacles that no body of an
    /// island carries, as a share of its radius: arc length in m and share; and the largest angle
    /// in rad by which an element turns that touches, as a share of that which a `turn` has.
    pub(crate) fn contact_quality(&self, turn: f64) -> [[f64; 2]; 2] {
        let mut worst = [[0.0; 2]; 2];
        let Some(contact) = self.effects().contact.filter(|_| !self.obstacles().is_empty()) else { return worst };
        let (q, mut from) = (self.positions(), 0.0);
        for (e, (element, touches)) in self.elements().iter().zip(self.touching()).enumerate() {
            let begin = from;
            from += element.length;
            if self.model.is_at_eye(e) {
                continue;
            }
            let radius = contact.radius_of(&element.section);
            let middle = combine(q, e, &shape::position(0.5, element.length));
            for obstacle in self.obstacles().iter().filter(|obstacle| obstacle.mount.is_none()) {
                let pose = obstacle.motion.pose(self.time());
                let depth = |x: &Vector3<f64>| radius + obstacle.skin - obstacle.surface.nearest(&pose.own(x)).distance;
                if depth(&middle) < -element.length {
                    continue;
                }
                for xi in between_samples() {
                    let at = begin + xi * element.length;
                    let held = [e, e + 1].into_iter().any(|node| self.model.support(node).is_some());
                    if held || obstacle.excepts(at) {
                        continue;
                    }
                    let share = depth(&combine(q, e, &shape::position(xi, element.length))) / radius;
                    if share > worst[0][1] {
                        worst[0] = [at, share];
                    }
                }
            }
            if touches {
                let share = self.turn_between([e, e + 1]) / turn;
                if share > worst[1][1] {
                    worst[1] = [begin, share];
                }
            }
        }
        worst
    }

    /// Returns where the cable runs through one of its [obstacles](Self::obstacles), or else where
    /// it is deepest in one, deeper than 2 % of its radius beyond what its contacts carry, as they
    /// are now; `None` if it is in none, or has no [`Contact`](crate::Contact). A piece that
    /// reaches to a supported node is left out: a cable may begin within what holds it.
    pub fn overlap(&self) -> Option<Overlap> {
        let contact = self.effects().contact?;
        // between samples that carry the cable it is a little deeper
        let carried = BETWEEN * self.contacts().fold(0.0, |most: f64, touch| most.max(touch.depth));
        let mut worst: Option<Overlap> = None;
        for obstacle in self.obstacles() {
            let mut first = 0;
            let motion = &obstacle.motion;
            let elapsed = self.time() - motion.start;
            let origin = motion.position + motion.velocity * elapsed;
            let axes = nalgebra::UnitQuaternion::new(motion.angular_velocity * elapsed) * motion.rotation;
            let (mut begin, mut held, mut deepest): (f64, bool, Option<Overlap>) = (0.0, false, None);
            // normals of the surface where the cable comes near it and where it leaves it
            let (mut last_normal, mut entry) = (None, None);
            let mut end = |deepest: &mut Option<Overlap>, held: bool, elements: RangeInclusive<usize>, faces| {
                let Some(mut found) = deepest.take().filter(|_| !held) else { return };
                found.crosses &= !self.is_kept_out(obstacle.key, elements, faces);
                if worst.is_none_or(|worst| (found.crosses, found.depth) > (worst.crosses, worst.depth)) {
                    worst = Some(found);
                }
            };
            for (e, element) in self.elements().iter().enumerate() {
                if self.model.is_at_eye(e) {
                    end(&mut deepest, held, first..=e, [entry, last_normal]);
                    (held, begin) = (false, begin + element.length);
                    continue;
                }
                let radius = contact.radius_of(&element.section);
                let last = usize::from(e + 1 == self.elements().len());
                for i in 0..OVERLAP_POINTS + last {
                    let xi = i as f64 / OVERLAP_POINTS as f64;
                    let arc_length = (begin + xi * element.length).min(self.length());
                    let Ok(sample) = self.sample(arc_length) else { continue };
                    let y: Vector3<f64> = axes.inverse() * (sample.position - origin) + motion.centre;
                    let nearest = obstacle.surface.nearest(&y);
                    let distance = nearest.distance;
                    let before = last_normal.replace(axes * nearest.patch.gap(&y).1);
                    let depth = radius + obstacle.skin - distance;
                    if depth <= RAMP * radius + carried {
                        end(&mut deepest, held, first..=e, [entry, last_normal]);
                        held = false;
                        continue;
                    }
                    held |= obstacle.excepts(arc_length);
                    let node = if i == 0 { Some(e) } else { (i == OVERLAP_POINTS).then_some(e + 1) };
                    held |= node.is_some_and(|node| self.model.support(node).is_some());
                    if deepest.is_none() {
                        // contacts at the end of the element before keep it out too
                        first = if i == 0 { e.saturating_sub(1) } else { e };
                        entry = before.or(last_normal);
                    }
                    let found =
                        deepest.get_or_insert(Overlap { obstacle: obstacle.key, arc_length, depth, crosses: false });
                    if depth > found.depth {
                        (found.arc_length, found.depth) = (arc_length, depth);
                    }
                    found.crosses |= distance < 0.0;
                }
                begin += element.length;
            }
            end(&mut deepest, held, first..=self.elements().len() - 1, [entry, last_normal]);
        }
        worst
    }

    /// Returns whether contacts in these elements keep the cable out of an obstacle, all on the
    /// side of it on which the cable comes near it and leaves it, by the normals of its surface
    /// there: what is in it between them is a bulge, which a finer mesh does not have. A cable that
    /// cuts an edge, or goes through a plate, leaves it on another side.
    fn is_kept_out(&self, obstacle: u64, elements: RangeInclusive<usize>, faces: [Option<Vector3<f64>>; 2]) -> bool {
        let touches = self.snapshot.state.memory.contacts.iter();
        let own = touches.filter(|touch| touch.obstacle == obstacle && elements.contains(&(touch.element as usize)));
        let sides: Vec<Vector3<f64>> = own.map(|touch| touch.direction).collect();
        let first = sides.first();
        first.is_some_and(|first| sides.iter().chain(faces.iter().flatten()).all(|a| a.dot(first) > SAME_SIDE))
    }
}
