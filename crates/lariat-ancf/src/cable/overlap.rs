//! Whether a cable is in what it can touch: for shapes that were found without contact.

use super::Cable;
use crate::contact::{Overlap, between_samples};
use crate::element::shape::{self, combine};
use nalgebra::Vector3;

/// Depth as a share of the radius below which a cable only touches.
const TOUCH: f64 = 0.02;
/// Depth between samples as a multiple of that at the deepest of them.
const BETWEEN: f64 = 2.0;
/// Points of an element that are looked at, without its last node.
const POINTS: usize = 8;

impl Cable {
    /// Returns the largest depth of the centre line between samples in obstacles that no body of an island carries, as a share of its radius: arc length in m and share; and the
    /// largest angle in rad by which an element turns that touches, as a share of that which a `turn` has.
    pub(crate) fn contact_quality(&self, turn: f64) -> [[f64; 2]; 2] {
        let mut worst = [[0.0; 2]; 2];
        let Some(contact) = self.effects().contact.filter(|_| !self.obstacles().is_empty()) else { return worst };
        let (q, mut from) = (self.positions(), 0.0);
        let mut touches = self.snapshot.state.memory.contacts.iter().peekable();
        for (e, element) in self.elements().iter().enumerate() {
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
            let mut touched = false;
            while touches.next_if(|touch| touch.element as usize == e).is_some() {
                touched = true;
            }
            if touched {
                let [a, b] = [e, e + 1].map(|node| Vector3::from_column_slice(&q[6 * node + 3..6 * node + 6]));
                let share = a.cross(&b).norm().atan2(a.dot(&b)) / turn;
                if share > worst[1][1] {
                    worst[1] = [begin, share];
                }
            }
        }
        worst
    }

    /// Returns where the cable is deepest in one of its [obstacles](Self::obstacles), deeper than 2 % of its radius beyond what its
    /// contacts carry, as they are now; `None` if
    /// it is in none, or has no [`Contact`](crate::Contact). A piece that reaches to a supported node is left out: a cable may begin within
    /// what holds it.
    pub fn overlap(&self) -> Option<Overlap> {
        let contact = self.effects().contact?;
        // between samples that carry the cable it is a little deeper
        let carried = BETWEEN * self.contacts().fold(0.0, |most: f64, touch| most.max(touch.depth));
        let mut worst: Option<Overlap> = None;
        for obstacle in self.obstacles() {
            let motion = &obstacle.motion;
            let elapsed = self.time() - motion.start;
            let origin = motion.position + motion.velocity * elapsed;
            let axes = nalgebra::UnitQuaternion::new(motion.angular_velocity * elapsed) * motion.rotation;
            let (mut begin, mut held, mut deepest): (f64, bool, Option<Overlap>) = (0.0, false, None);
            let mut end = |deepest: &mut Option<Overlap>, held: bool| {
                let found = deepest.take().filter(|_| !held);
                if let Some(found) = found.filter(|found| worst.is_none_or(|worst| found.depth > worst.depth)) {
                    worst = Some(found);
                }
            };
            for (e, element) in self.elements().iter().enumerate() {
                if self.model.is_at_eye(e) {
                    end(&mut deepest, held);
                    (held, begin) = (false, begin + element.length);
                    continue;
                }
                let radius = contact.radius_of(&element.section);
                let last = usize::from(e + 1 == self.elements().len());
                for i in 0..POINTS + last {
                    let xi = i as f64 / POINTS as f64;
                    let arc_length = (begin + xi * element.length).min(self.length());
                    let Ok(sample) = self.sample(arc_length) else { continue };
                    let y: Vector3<f64> = axes.inverse() * (sample.position - origin) + motion.centre;
                    let depth = radius + obstacle.skin - obstacle.surface.nearest(&y).distance;
                    if depth <= TOUCH * radius + carried {
                        end(&mut deepest, held);
                        held = false;
                        continue;
                    }
                    held |= obstacle.excepts(arc_length);
                    let node = if i == 0 { Some(e) } else { (i == POINTS).then_some(e + 1) };
                    held |= node.is_some_and(|node| self.model.support(node).is_some());
                    if deepest.is_none_or(|deepest| depth > deepest.depth) {
                        deepest = Some(Overlap { obstacle: obstacle.key, arc_length, depth });
                    }
                }
                begin += element.length;
            }
            end(&mut deepest, held);
        }
        worst
    }
}
