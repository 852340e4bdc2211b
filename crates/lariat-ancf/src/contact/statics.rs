//! Contact in statics: the potential of the normal law, without friction.
//!
//! # Equation
//!
//! ```text
//! V = sum w W(d)      d = r + skin - g      F = w W' n      -dF/dx = w (W'' n n^T - W' H)
//! ```
//!
//! at the samples of the elements; g is the distance from the patch that a sample sees, n its
//! gradient and H its Hessian. Friction takes nothing: in the shape that is found none is needed.
//!
//! The search begins with a softer law where it has to ([`continuation`](crate::statics)).
//!
//! # Validity
//!
//! Obstacles that stand still, as they are at the cable's time; bodies that carry obstacles are
//! left out. Samples do not see what is thinner than their spacing, nor sharp edges between them:
//! the shape is compared with all surfaces in the end, and refused where the centre line runs
//! through one; where the cable is a part of its radius deep between samples, the warning `sinks`
//! tells. A step of the search that takes a sample through an obstacle is not taken
//! ([`StaticContact::passes`]); what passes between samples may end on the other side. Within four
//! radii of a held node, and as much further as it is deep, there is no contact.
//!
//! # References
//!
//! Wriggers, Computational Contact Mechanics, 2006, section 6.3 (penalty); Allgower & Georg 1990
//! (continuation).
//!
//! # Alternatives considered
//!
//! Motion with damping until it rests: its last digits take as long as all before.

use super::law::NormalLaw;
use super::pair::{ball, is_thin, samples};
use crate::effect::Contact;
use crate::element::assembly::add_tangent;
use crate::element::shape;
use crate::element::shape::combine;
use crate::linalg::BlockTridiagonal;
use crate::model::LoadScale;
use crate::model::Model;
use crate::obstacle::Obstacle;
use crate::obstacle::Patch;
use crate::obstacle::trace;
use crate::scales::contact::{APART, LEAST_GROWTH, MOST_GROWTH};
use crate::state::ContactMemory;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// Whether statics are solved with contact, and where there is none.
#[derive(Clone, Debug, Default)]
pub(crate) struct StaticContact {
    on: bool,
    time: f64,
    /// Load per length in N/m, and the depth in m that it has in a softened law; 0 for the law
    /// itself.
    load: f64,
    depth: f64,
    /// Obstacle and arc lengths in m of the pieces at held nodes.
    held: Vec<(usize, [f64; 2])>,
}

/// Growth of the stiffness from one search to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Growth(f64);

impl Default for Growth {
    fn default() -> Self {
        Growth(MOST_GROWTH)
    }
}

impl Growth {
    /// Adapts it to the outcome of a search, and returns whether one that failed is tried again
    /// with less.
    pub fn adapt(&mut self, found: bool) -> bool {
        let last = self.0;
        self.0 = if found { (last * last).min(MOST_GROWTH) } else { last.sqrt() };
        !found && self.0 >= LEAST_GROWTH
    }
}

/// A sample of a cable that may touch an obstacle.
#[derive(Clone, Copy)]
struct Place<'a> {
    element: usize,
    number: u32,
    xi: f64,
    /// Arc length in m.
    at: f64,
    shape: [f64; 4],
    weight: f64,
    obstacle: &'a Obstacle,
    /// Gap at which it touches, and of it the radius of the cable.
    reach: f64,
    radius: f64,
    contact: Contact,
}

/// One that is in it.
struct Sample<'a> {
    place: Place<'a>,
    patch: Patch,
    /// Whether a feature of the obstacle acts there, in motion.
    thin: bool,
    depth: f64,
    normal: Vector3<f64>,
    /// Axes of the obstacle.
    axes: UnitQuaternion<f64>,
    force: f64,
    slope: f64,
    energy: f64,
}

impl StaticContact {
    /// Begins to solve the statics of a cable at a time (s), with its held nodes at their places in
    /// `q`.
    pub fn begin(&mut self, model: &Model, time: f64, q: &[f64]) {
        (self.load, self.depth) = (0.0, 0.0);
        (self.on, self.time) = (model.effects.contact.is_some() && !model.obstacles.0.is_empty(), time);
        self.held.clear();
        let Some(contact) = model.effects.contact.filter(|_| self.on) else { return };
        for &(node, _) in model.supports.iter().filter(|(_, support)| support.holds_position()) {
            let at: f64 = model.elements[..node].iter().map(|element| element.length).sum();
            let radius = contact.radius_of(&model.elements[node.min(model.elements.len() - 1)].section);
            for (i, obstacle) in model.obstacles.0.iter().enumerate() {
                let y = own(obstacle, time, &Vector3::from_column_slice(&q[6 * node..6 * node + 3])).0;
                let depth = -obstacle.surface.nearest(&y).distance;
                if depth + radius > 0.0 {
                    let reach = APART * radius + depth.max(0.0);
                    self.held.push((i, [at - reach, at + reach]));
                }
            }
        }
    }

    /// Returns whether the cable at `q` is deeper in an obstacle than its radius, where the law
    /// itself is of no use.
    pub fn is_deep(&self, model: &Model, q: &[f64]) -> bool {
        let mut deep = false;
        self.visit(model, q, |sample| deep |= sample.depth > sample.place.reach);
        deep
    }

    /// Softens the law, so that the loads per length have a share of the depth in which the cable
    /// is at `q`, or of a radius. Returns whether there is anything to touch.
    pub fn soften(&mut self, model: &Model, q: &[f64], share: f64) -> bool {
        let Some(contact) = model.effects.contact.filter(|_| self.on) else { return false };
        let mut deepest = model.elements.iter().map(|e| contact.radius_of(&e.section)).fold(0.0, f64::max);
        self.visit(model, q, |sample| deepest = deepest.max(sample.depth));
        (self.load, self.depth) = (LoadScale::new(model, q).force / model.length(), share * deepest);
        true
    }

    /// Makes a softened law harder, and returns the depth that the loads had; `None` if it was not
    /// softened.
    pub fn harden(&mut self, model: &Model, growth: &Growth) -> Option<f64> {
        let contact = model.effects.contact.filter(|_| self.on && self.depth > 0.0)?;
        let before = self.depth;
        self.depth /= growth.0;
        let mut laws = model.elements.iter().map(|element| NormalLaw::of(&contact, &element.section));
        if laws.all(|law| law.softened(self.load, self.depth).stiffness == law.stiffness) {
            self.depth = 0.0;
        }
        Some(before)
    }

    /// Returns whether a sample goes through an obstacle on the straight way from coordinates to
    /// others: into a side, and to where an opposite one is nearer.
    pub fn passes(&self, model: &Model, from: &[f64], to: &[f64]) -> bool {
        let mut passes = false;
        self.visit_samples(model, to, Some(from), |place| {
            let [start, end] =
                [from, to].map(|q| own(place.obstacle, self.time, &combine(q, place.element, &place.shape)).0);
            let (way, surface) = (end - start, &*place.obstacle.surface);
            let first = surface.nearest(&start);
            if passes || first.distance - place.reach >= way.norm() {
                return;
            }
            let entered = if first.distance <= place.reach {
                Some(first)
            } else {
                trace(surface, [&start, &end], place.reach, |_| true)
            };
            let Some(entered) = entered else { return };
            let [inward, outward] =
                [(entered.patch, &start), (surface.nearest(&end).patch, &end)].map(|(patch, y)| patch.gap(y).1);
            passes = inward.dot(&way) < 0.0 && inward.dot(&outward) < 0.0;
        });
        passes
    }

    /// Returns to the law in which the loads have a depth (m).
    pub fn retreat(&mut self, depth: f64) {
        self.depth = depth;
    }

    /// Ends it.
    pub fn end(&mut self) {
        self.on = false;
    }

    /// Adds `scale` times the forces at `q` to `out`, and times their tangents to the matrix.
    pub fn add(
        &self,
        model: &Model,
        (q, scale): (&[f64], f64),
        out: &mut [f64],
        mut matrix: Option<&mut BlockTridiagonal>,
    ) {
        self.visit(model, q, |sample| {
            let (Place { element: e, shape, .. }, n) = (&sample.place, &sample.normal);
            for (k, weight) in shape.iter().enumerate() {
                for x in 0..3 {
                    out[6 * e + 3 * k + x] += scale * weight * sample.force * n[x];
                }
            }
            if let Some(matrix) = &mut matrix {
                add_tangent(matrix, *e, shape, &(sample.tangent() * scale));
            }
        });
    }

    /// Returns the potential in J at `q`.
    pub fn energy(&self, model: &Model, q: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.visit(model, q, |sample| sum += sample.energy);
        sum
    }

    /// Returns the largest force in N by which an obstacle holds the cable at `q` along itself, of
    /// which contact without friction has none, with the key of the obstacle and the arc length in
    /// m where it does so most.
    pub fn snag(&self, model: &Model, q: &[f64]) -> Option<(u64, f64, f64)> {
        let mut of_obstacles: Vec<(u64, f64, [f64; 2])> = Vec::new();
        self.visit(model, q, |sample| {
            let Place { element, xi, at, obstacle, .. } = sample.place;
            let slope = shape::slope(xi, model.elements[element].length);
            let force = sample.force * sample.normal.dot(&combine(q, element, &slope).normalize());
            let (key, here) = (obstacle.key, [force.abs(), at]);
            match of_obstacles.iter_mut().find(|(own, ..)| *own == key) {
                Some((_, sum, most)) => {
                    *sum += force;
                    *most = if here[0] > most[0] { here } else { *most };
                }
                None => of_obstacles.push((key, force, here)),
            }
        });
        let largest = of_obstacles.into_iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        Some((largest.0, largest.2[1], largest.1.abs()))
    }

    /// Remembers the contacts at `q`, from which motion goes on.
    pub fn remember(&self, model: &Model, q: &[f64], memory: &mut Vec<ContactMemory>) {
        memory.clear();
        self.visit(model, q, |sample| {
            if !sample.thin {
                let Place { element, number, xi, weight, obstacle, .. } = sample.place;
                memory.push(ContactMemory {
                    element: element as u32,
                    place: number,
                    obstacle: obstacle.key,
                    xi,
                    weight,
                    patch: sample.patch,
                    normal: sample.axes.inverse() * sample.normal,
                    depth: sample.depth,
                    offset: 0.0,
                    given: 0.0,
                    speed: 0.0,
                    spring: Vector3::zeros(),
                    force: sample.force,
                    energy: sample.energy,
                    friction_power: 0.0,
                    direction: sample.normal,
                    friction: Vector3::zeros(),
                    slips: false,
                    came: 0.0,
                });
            }
        });
        memory.sort_unstable_by_key(ContactMemory::key);
    }

    /// Calls `f` with every sample that is in an obstacle.
    fn visit(&self, model: &Model, q: &[f64], mut f: impl FnMut(&Sample<'_>)) {
        self.visit_samples(model, q, None, |place| {
            let Place { element, shape, weight, obstacle, reach, radius, contact, .. } = *place;
            let section = &model.elements[element];
            let (y, axes) = own(obstacle, self.time, &combine(q, element, &shape));
            let nearest = obstacle.surface.nearest(&y);
            let (gap, normal) = nearest.patch.gap(&y);
            let depth = reach - gap;
            if depth <= 0.0 {
                return;
            }
            let law = NormalLaw::of(&contact, &section.section);
            let law = if self.depth > 0.0 { law.softened(self.load, self.depth) } else { law };
            let pressure = law.at(depth);
            f(&Sample {
                place: *place,
                patch: nearest.patch,
                thin: is_thin(&nearest, radius, section.length),
                depth,
                normal: axes * normal,
                axes,
                force: weight * pressure.force,
                slope: weight * pressure.slope,
                energy: weight * pressure.energy,
            });
        });
    }

    /// Calls `f` with every sample of elements that may be in an obstacle, at coordinates, or on
    /// the way to them from others.
    fn visit_samples(&self, model: &Model, q: &[f64], from: Option<&[f64]>, mut f: impl FnMut(&Place<'_>)) {
        let Some(contact) = model.effects.contact.filter(|_| self.on) else { return };
        let mut begin = 0.0;
        for (element, section) in model.elements.iter().enumerate() {
            let start = begin;
            begin += section.length;
            if model.is_at_eye(element) {
                continue;
            }
            let radius = contact.radius_of(&section.section);
            let (centre, mut size) = ball(q, element, section.length);
            if let Some((before, own)) = from.map(|from| ball(from, element, section.length)) {
                size = size.max(own + (before - centre).norm());
            }
            for (i, obstacle) in model.obstacles.0.iter().enumerate().filter(|(_, obstacle)| obstacle.mount.is_none()) {
                let reach = radius + obstacle.skin;
                if obstacle.surface.nearest(&own(obstacle, self.time, &centre).0).distance > size + reach {
                    continue;
                }
                for (number, xi, weight) in samples(&contact, model, element) {
                    let at = start + xi * section.length;
                    let held = self.held.iter().any(|(k, [low, high])| *k == i && (*low..=*high).contains(&at));
                    if !held && !obstacle.excepts(at) {
                        let shape = shape::position(xi, section.length);
                        f(&Place { element, number, xi, at, shape, weight, obstacle, reach, radius, contact });
                    }
                }
            }
        }
    }
}

impl Sample<'_> {
    /// Returns -dF/dx.
    fn tangent(&self) -> Matrix3<f64> {
        let n = self.normal;
        let normal = n * n.transpose();
        let reach = |radius: f64| (self.gap() + radius).max(f64::MIN_POSITIVE);
        let hessian = match self.patch {
            Patch::Plane { .. } => Matrix3::zeros(),
            Patch::Line { direction, radius, .. } => {
                let axis = self.axes * direction;
                (Matrix3::identity() - axis * axis.transpose() - normal) / reach(radius)
            }
            Patch::Point { radius, .. } => (Matrix3::identity() - normal) / reach(radius),
        };
        normal * self.slope - hessian * self.force
    }

    fn gap(&self) -> f64 {
        self.place.reach - self.depth
    }
}

/// Returns a point in the axes of an obstacle at a time (s), and these.
fn own(obstacle: &Obstacle, time: f64, x: &Vector3<f64>) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let motion = &obstacle.motion;
    let elapsed = time - motion.start;
    let origin = motion.position + motion.velocity * elapsed;
    let axes = UnitQuaternion::new(motion.angular_velocity * elapsed) * motion.rotation;
    (axes.inverse() * (x - origin) + motion.centre, axes)
}
