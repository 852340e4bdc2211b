//! What the elements carry at nodes that are held, loaded or ends: where neither side judges the
//! other.
//!
//! # Equation
//!
//! An elastica that a force F pulls out of a clamp or a load, where its tangent is at an angle
//! theta to the force, turns to the force within a few `sqrt(EI/F)`, with the moment
//!
//! ```text
//! M = 2 sqrt(EI F) sin(theta/2)
//! ```
//!
//! there, for `EI kappa^2/2 + F cos` of its angle is constant along it. Longer elements have the
//! moment M_h instead, which is larger, and the line of the force is off by `(M_h - M)/F`: so is
//! the node, where it may move.
//!
//! Where it is free to turn between two pieces, at a load, a held point or a ball joint, the moment
//! is that of both, and the angles to both forces F_1 and F_2 add up to Theta, the one between
//! them:
//!
//! ```text
//! a sin(theta_1/2) = b sin(theta_2/2)     theta_1 + theta_2 = Theta     a = sqrt(EI_1 F_1), b likewise
//! M = 2 a b sin(Theta/2)/sqrt(a^2 + 2 a b cos(Theta/2) + b^2) + (b K_1 + a K_2)/(a + b)
//! ```
//!
//! K = EI |F x dF/ds|/F^2 is the moment that the cable has beyond the layer, as a string that its
//! weight bends, to the first order. A small load P across a tension T makes `P sqrt(EI/T)/2`.
//! Forces are right on every mesh, since they are in equilibrium with the load, so that is what is
//! read there where the elements are longer than the layer. What a clamp carries is read as it is:
//! it is the reaction.
//!
//! # Validity
//!
//! Where nothing else bends it within the layer. Beside elements of 3.7, 4.9, 9.2 and 37
//! `sqrt(EI/F)` moments are 5, 11, 43 and 344 % too large, as the analytic beam says
//! (`tests/end_reading.rs`).
//!
//! # References
//!
//! Love 1944, section 262 (the elastica). Moments are those of [equilibrium](crate::system).

use super::Cable;
use crate::rule::BendingRule;
use crate::scales::cable::AT_NODE;
use crate::scales::watch::{CORNER, LAYER, ROOM};
use crate::system::Carried;
use nalgebra::Vector3;

/// What bends within a short piece at a node, on one side of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layer {
    /// Arc length of the node in m.
    pub arc_length: f64,
    /// Length of the element in m, and of the layer, `sqrt(EI/F)`.
    pub element: f64,
    pub scale: f64,
    /// Moment in N m: of the mesh, and of the elastica.
    pub moments: [f64; 2],
    /// The part of that of the mesh in N m that its bending makes, `EI kappa`.
    pub bent: f64,
    /// Force in N, and its share of EA.
    pub force: f64,
    pub strain: f64,
    /// Angle between tangent and force in rad.
    pub angle: f64,
    /// Whether the slope is held, so that the moment is felt.
    pub held: bool,
    /// Whether it is at a load inside the element, whose moment is read from the mesh.
    pub inside: bool,
}

impl Layer {
    /// Returns the moment in N m that the force makes of the mesh: all but that of its bending at a
    /// node, and at a load inside an element about what it would be at a node.
    fn of_force(&self) -> f64 {
        let [mesh, _] = self.moments;
        if self.inside { CORNER * self.force * self.element * self.angle } else { mesh - self.bent }
    }

    /// Returns by how much the mesh has more of a moment than the elastica, over the force, in m.
    pub fn lever(&self) -> f64 {
        let [mesh, elastica] = self.moments;
        ((if self.inside { self.of_force() } else { mesh }) - elastica) / self.force
    }

    /// Returns the length in m that the mesh loses on this side.
    fn excess(&self) -> f64 {
        (0.25 * self.angle).tan() * (2.0 * self.of_force() - self.moments[1]).max(0.0) / self.force
    }
}

/// A place at which a cable bends within a piece that is shorter than its elements there: a clamp,
/// a point load, or a point that a support, an attachment or a junction holds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SharpBend {
    /// Arc length in m.
    pub arc_length: f64,
    /// Length `sqrt(EI/T)` in m within which it bends, with the largest tension T there; 0 without
    /// bending stiffness.
    pub length: f64,
    /// Length in m of the cable that goes lost there to the mesh, which is smooth where the cable
    /// turns: as if the cable were shorter by it.
    pub excess: f64,
}

impl SharpBend {
    /// Adds what was read to bends, one for each place.
    pub(crate) fn add_to(self, bends: &mut Vec<Self>) {
        let at = self.arc_length;
        match bends.iter_mut().find(|bend| (bend.arc_length - at).abs() <= AT_NODE * at.max(f64::MIN_POSITIVE)) {
            Some(bend) => {
                bend.length = bend.length.min(self.length);
                bend.excess = bend.excess.max(self.excess);
            }
            None => bends.push(self),
        }
    }
}

impl Cable {
    /// Returns where it bends more sharply than its elements can, by arc length, as it is now:
    /// beside these places, positions converge with the first order of the elements. A mesh that is
    /// fine there ([`CableBuilder::finest`](crate::CableBuilder::finest), `2 length`) does; without
    /// bending stiffness, only a hinge.
    ///
    /// A force F that comes to the tangent at an angle theta turns an elastica with the energy `U =
    /// 4 sqrt(EI F) (1 - cos(theta/2))`, which takes the length `dU/dF = tan(theta/4) M/F` of it, M
    /// its moment. Of the moment that a mesh has instead, what is not `EI kappa` comes of the force
    /// itself, with an energy of `2 tan(theta/4)` times that, of the first order in F: by so much
    /// more length the mesh is short. A load inside an element takes about what it would at a node.
    pub fn sharp_bends(&self) -> Vec<SharpBend> {
        let mut bends: Vec<SharpBend> = Vec::new();
        self.visit_layers(|layer| {
            let (Layer { arc_length, scale: length, .. }, excess) = (layer, layer.excess());
            match bends.last_mut().filter(|bend| bend.arc_length == arc_length) {
                // the other side of it
                Some(bend) => {
                    bend.length = bend.length.min(length);
                    bend.excess += excess;
                }
                None => bends.push(SharpBend { arc_length, length, excess }),
            }
        });
        self.visit_inner_layers(|layer| {
            let (Layer { arc_length, scale: length, .. }, excess) = (layer, 2.0 * layer.excess());
            bends.push(SharpBend { arc_length, length, excess });
        });
        bends.sort_by(|a, b| a.arc_length.total_cmp(&b.arc_length));
        bends
    }

    /// Returns whether tension and moment at a node at an arc length in m are read by equilibrium:
    /// at an end, a support, a point load or a change of section.
    pub(super) fn is_read_by_equilibrium(&self, node: usize, s: f64) -> bool {
        node == 0 || node == self.elements().len() || !self.model.is_smooth_at(node, s)
    }

    /// Returns the arc length of a node in m.
    pub(super) fn arc_length_of(&self, node: usize) -> f64 {
        self.elements()[..node].iter().map(|element| element.length).sum()
    }

    /// Returns what an element carries at both ends, by equilibrium with the accelerations of the
    /// last step, the mean ones of a step of the discrete gradient, or those of the present forces;
    /// `None` where it is not known.
    pub(crate) fn carried(&self, e: usize) -> Option<[Carried; 2]> {
        let (reading, contacts) = (self.reading(), &self.snapshot.state.memory.contacts[..]);
        if let Some((sum, over)) = self.last_accelerations() {
            return reading.carried(e, |i| sum[i] / over, contacts);
        }
        let present = reading.acceleration(contacts)?;
        reading.carried(e, |i| present[i], contacts)
    }

    /// Returns the same without the accelerations that only an assembly of all forces would say:
    /// for the mean of two elements at a node, in which they cancel.
    pub(super) fn carried_nearly(&self, e: usize) -> Option<[Carried; 2]> {
        match self.last_accelerations() {
            Some(_) => self.carried(e),
            None => self.reading().carried(e, |_| 0.0, &self.snapshot.state.memory.contacts),
        }
    }

    /// Returns what the accelerations of the last step are, and what they are to be divided by;
    /// `None` where none is known.
    fn last_accelerations(&self) -> Option<(&[f64], f64)> {
        let memory = &self.snapshot.state.memory;
        let last = &memory.differences;
        if memory.valid && memory.revision == self.revision {
            return Some((&memory.acceleration, 1.0));
        }
        let is_known = !last.is_empty() && last.step > 0.0 && last.revision == self.revision;
        is_known.then_some((&last.velocity[..], last.step))
    }

    /// Returns the moment in N m at a node between two elements where it is free to turn at a load
    /// or a held point, if it bends there within a shorter piece than the elements: that of the
    /// elastica. `known`: what the element before the node, or the one behind it, carries.
    pub(super) fn layer_moment(&self, node: usize, known: &[Carried; 2], before: bool) -> Option<Vector3<f64>> {
        let inner = 0 < node && node < self.elements().len();
        if !inner || self.model.rule.bending == BendingRule::None {
            return None;
        }
        let s = self.arc_length_of(node);
        let support = self.model.support(node).copied().unwrap_or_default();
        let near = |at: f64| (at - s).abs() <= AT_NODE * self.length();
        let kinks = support.holds_position() || self.model.pulled_points().any(near);
        if support.holds_slope() || !kinks || self.has_moment(s) {
            return None;
        }
        let sides = if before { [*known, self.carried(node)?] } else { [self.carried(node - 1)?, *known] };
        // squares of lengths over sqrt(EI/F)
        let [mut shortest_room, mut longest_element] = [f64::INFINITY, 0.0f64];
        let (mut strengths, mut beyond) = ([0.0; 2], [Vector3::zeros(); 2]);
        for (k, side) in sides.iter().enumerate() {
            let Carried { force, tension, .. } = side[1 - k];
            let element = &self.elements()[node - 1 + k];
            let flexural = element.section.bending_stiffness;
            if flexural <= 0.0 || tension <= 0.0 {
                return None;
            }
            let (size, room) = (force.norm(), self.room(node, k == 0));
            shortest_room = shortest_room.min(room * room * size / flexural);
            longest_element = longest_element.max(element.length.powi(2) * size / flexural);
            strengths[k] = (flexural * size).sqrt();
            let rate = (side[1].force - side[0].force) / element.length;
            beyond[k] = flexural / (size * size) * force.cross(&rate);
        }
        if longest_element <= 1.0 || shortest_room <= ROOM * ROOM {
            return None;
        }
        let ([a, b], [first, second]) = (strengths, [sides[0][1].force, sides[1][0].force]);
        let axis = first.cross(&second).try_normalize(0.0).unwrap_or_default();
        let (sin, cos) = (0.5 * first.angle(&second)).sin_cos();
        let kink = axis * (2.0 * a * b * sin / (a * a + 2.0 * a * b * cos + b * b).sqrt());
        Some(kink + (b * beyond[0] + a * beyond[1]) / (a + b))
    }

    /// Returns the length in m from a node to the next one where something holds or loads the
    /// cable, or to its end.
    fn room(&self, node: usize, before: bool) -> f64 {
        let (count, mut room, mut at) = (self.elements().len(), 0.0, node);
        let mut s = self.arc_length_of(node);
        loop {
            let element = if before { at - 1 } else { at };
            let length = self.elements()[element].length;
            room += length;
            (at, s) = if before { (at - 1, s - length) } else { (at + 1, s + length) };
            if at == 0 || at == count || !self.model.is_smooth_at(at, s) {
                return room;
            }
        }
    }

    /// Calls `visit` with each layer that is shorter than the elements beside its node.
    pub(crate) fn visit_layers(&self, mut visit: impl FnMut(Layer)) {
        let (elements, mut from) = (self.elements(), 0.0);
        for (e, element) in elements.iter().enumerate() {
            let ends = [from, from + element.length];
            from = ends[1];
            let mut carried = None;
            for (k, arc_length) in ends.into_iter().enumerate() {
                let (node, inner) = (e + k, 0 < e + k && e + k < elements.len());
                let held = self.model.support(node).is_some_and(|support| support.holds_slope());
                if !(held || inner) || !self.is_read_by_equilibrium(node, arc_length) || self.has_moment(arc_length) {
                    continue;
                }
                let flexural = element.section.bending_stiffness;
                let long = LAYER * LAYER * flexural;
                if self.reading().ends(e)[k].tension * element.length.powi(2) <= long {
                    continue;
                }
                let Some(carried) = carried.get_or_insert_with(|| self.carried(e)) else { break };
                let Carried { slope, force, tension, moment } = carried[k];
                if tension * element.length.powi(2) <= long {
                    continue;
                }
                let (force, angle) = (force.norm(), slope.angle(&force));
                let elastica = 2.0 * (flexural * force).sqrt() * (0.5 * angle).sin();
                visit(Layer {
                    arc_length,
                    element: element.length,
                    scale: (flexural / force).sqrt(),
                    moments: [moment.norm(), elastica],
                    bent: self.sample_in(e, k as f64).moment.norm(),
                    force,
                    strain: force / element.section.axial_stiffness,
                    angle,
                    held,
                    inside: false,
                });
            }
        }
    }

    /// Calls `visit` with the layer at each load inside an element that is longer than it. No node
    /// is there to turn, so the mesh has less of a moment than the elastica: `M = 2 sqrt(EI F)
    /// sin(Theta/4)` between forces F at an angle Theta.
    pub(crate) fn visit_inner_layers(&self, mut visit: impl FnMut(Layer)) {
        let near = AT_NODE * self.length();
        for load in self.model.loads.iter().filter(|load| load.force != Vector3::zeros()) {
            let (e, xi) = self.model.locate(load.arc_length);
            let element = &self.elements()[e];
            let flexural = element.section.bending_stiffness;
            let beside = [xi, 1.0 - xi].map(|share| share * element.length);
            if beside.into_iter().any(|distance| distance <= near) || self.has_moment(load.arc_length) {
                continue;
            }
            let is_long = |tension: f64| tension * element.length.powi(2) > flexural;
            if !self.reading().ends(e).iter().any(|end| is_long(end.tension)) {
                continue;
            }
            let Some([before, behind]) = self.carried(e) else { continue };
            let force = 0.5 * (before.force.norm() + behind.force.norm());
            if !is_long(before.tension.min(behind.tension)) {
                continue;
            }
            let angle = 0.5 * before.force.angle(&behind.force);
            let elastica = 2.0 * (flexural * force).sqrt() * (0.5 * angle).sin();
            let mesh = self.sample_in(e, xi).moment.norm();
            visit(Layer {
                arc_length: load.arc_length,
                element: element.length,
                scale: (flexural / force).sqrt(),
                moments: [mesh, elastica],
                bent: mesh,
                force,
                strain: force / element.section.axial_stiffness,
                angle,
                held: false,
                inside: true,
            });
        }
    }

    /// Returns whether a moment of a load is at an arc length in m.
    fn has_moment(&self, s: f64) -> bool {
        let near = |at: f64| (at - s).abs() <= AT_NODE * self.length();
        self.model.loads.iter().any(|load| load.moment != Vector3::zeros() && near(load.arc_length))
    }
}
