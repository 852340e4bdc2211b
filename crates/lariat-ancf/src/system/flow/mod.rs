//! The element at the eye of a reel within the equations of its cable.
//!
//! # Equation
//!
//! Implicit stages evaluate the element at its length l(t): its stiffness, mass and weight are those of l, and the
//! [forces of the flow](crate::element::flow) are added. Internal damping sees the rates of the control vectors, of which
//! `d1 = 3 (r_j - r_i)/l` changes with l, too.
//!
//! In a step of the discrete gradient from l0 to l1 the strain energy is `U = l C_a u_a(g) + C_b u_b(g)/l`. With the means over the step
//!
//! ```text
//! D d1 = 3 [D(r_j - r_i) (1/l)_m + (r_j - r_i)_m D(1/l)]      D U = f . D q + Y D l to rounding
//! ```
//!
//! The loop over the elements keeps its form: it is given the eye where it would be on an element of the length l0 with the same control
//! vectors, and its force is scaled by `l0 (1/l)_m`. Weight is that of the mean length. Inertia
//! is the change of the momentum p = M v + l' G q over the step, from one length to the other ([`step`]), so its sum over a cable is the
//! change of the cable's momentum, less what flows in with the material.
//!
//! Where the eye is on a body that moves freely, the stock rides with it: as a mass point m at the eye, whose momentum and weight are
//! those of the node there. What leaves the stock enters the element, so the momentum of cable, stock and body stays to rounding.
//!
//! # Validity
//!
//! Elastic work and momentum are exact for any step; kinetic energy and angular momentum to the second order of the step: means of `l' G q` and of M over the step are
//! not those of its ends. Where nothing holds the system, angular momentum is [restored](crate::system::angular). The tangent takes the symmetric part
//! of the forces of the flow, and with riding stock its sums over rows are exact. Stock has no inertia about the eye.

mod drum;
mod effects;
mod law;
mod linear;
mod sheave;
mod step;
mod unknowns;
mod wheel;
mod work;

pub(crate) use drum::Winch;
pub(crate) use law::{Law, Motor, MotorState, rates};
pub use sheave::Sheave;
pub(crate) use unknowns::Unknowns;
pub(crate) use wheel::{STOP, Wheel};

use super::System;
use super::elements::Elements;
use crate::effect::acts::{ForceInput, Single};
use crate::element::flow::{Extent, FlowElement};
use crate::element::gram::{Control, gram};
use crate::element::kernel::{ElementState, GramState, Kernel, Stiffness, energy};
use crate::element::side::Side;
use crate::linalg::BlockTridiagonal;
use crate::model::Model;
use crate::reel::Feed;

/// The element at the eye of a reel during a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flow {
    /// The end of the cable at which it is.
    pub side: Side,
    /// Time in s at which the extent is.
    pub start: f64,
    /// Extent at that time; the acceleration stays.
    pub extent: Extent,
    /// Length in m of its mass and weight in the equations as they are set.
    weighed: f64,
    /// Lengths and stock in m to which the equations are set; `None` if they are not set.
    set: Option<[f64; 4]>,
    /// Force of the loop over the elements on the eye in the last iterate of the discrete gradient, in N.
    eye_force: [f64; 3],
    /// Rate in m/s with which the last step ended, where this one begins with that of a drum.
    pub left_rate: Option<f64>,
    /// Length in m at the beginning of the last step.
    pub length_before: f64,
    /// Whether an end of the cable stops it.
    pub stopped: bool,
    /// How material comes to the eye.
    pub feed: Feed,
    /// What drives it, if its rate is an unknown.
    pub law: Option<Law>,
    /// Length in m that a reel with a motor can take in beside this element, with the revision of the cable of which that is.
    pub beside: Option<(u64, f64)>,
    /// Acceleration of the iterate about which the equations of a step are linear.
    linearised: f64,
    /// Force in N of effects at Gauss points on the length, in the last iterate of the discrete gradient.
    of_points: f64,
    /// Forces on the length in an iterate of the discrete gradient: of a reel with a motor in the last one.
    on_length: OnLength,
    /// Mean pull of the winch over the last step of the discrete gradient in N.
    pub pull: Option<f64>,
    /// Where the material at the eye comes from and goes to.
    pub source: Source,
}

/// What is behind an eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Source {
    /// Stock that is no part of the system.
    #[default]
    Outside,
    /// Stock that rides with the body at the eye; length in m of stock and element together.
    Stock(f64),
    /// Another cable, over a sheave.
    Cable,
}

/// Mean forces in N on the length of an element at an eye over a step of the discrete gradient.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OnLength {
    /// All: B.
    force: f64,
    /// Of inertia and weight.
    inertial: f64,
    /// Strain energies in J, axial and bending, at the beginning of the step, once they are known, and at its end.
    begin: Option<(f64, f64)>,
    end: (f64, f64),
}

/// The elements at eyes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flows {
    pub list: Vec<Flow>,
    /// Impulses of their inertia over the last step of the discrete gradient.
    impulses: Vec<step::Impulse>,
    /// Velocities as internal damping sees them, and those of the material.
    velocities: [Vec<f64>; 2],
}

impl Flow {
    /// A flow at rest.
    pub fn new(side: Side, length: f64) -> Self {
        let extent = Extent { length, ..Extent::default() };
        Flow {
            side,
            start: 0.0,
            extent,
            weighed: length,
            set: None,
            eye_force: [0.0; 3],
            left_rate: None,
            length_before: length,
            stopped: false,
            feed: Feed::Drum,
            law: None,
            beside: None,
            linearised: 0.0,
            of_points: 0.0,
            on_length: OnLength::default(),
            pull: None,
            source: Source::Outside,
        }
    }

    /// Returns the length in m of the stock that rides with the body at the eye, when the element has this length.
    fn stock(&self, length: f64) -> f64 {
        if let Source::Stock(both) = self.source { both - length } else { 0.0 }
    }

    /// Returns whether it stands, did so in the last step, and is not driven by an unknown force: it is then an element like others, if no
    /// stock rides at the eye.
    fn stands(&self) -> bool {
        let Extent { length, rate, acceleration } = self.extent;
        let alone = self.law.is_none() && self.source == Source::Outside;
        alone && rate == 0.0 && acceleration == 0.0 && self.length_before == length
    }

    /// Returns the extent at a time in s.
    pub fn at(&self, time: f64) -> Extent {
        let Extent { length, rate, acceleration } = self.extent;
        let t = time - self.start;
        Extent { length: length + t * (rate + 0.5 * t * acceleration), rate: rate + t * acceleration, acceleration }
    }

    /// Returns the mean of a step from `time` of length `h` (s), and the lengths at both ends.
    fn over(&self, time: f64, h: f64) -> (Extent, [f64; 2]) {
        let [first, last] = [self.at(time), self.at(time + h)];
        let mean = Extent {
            length: 0.5 * (first.length + last.length),
            rate: (last.length - first.length) / h,
            acceleration: first.acceleration,
        };
        (mean, [first.length, last.length])
    }

    /// Returns the number of the element.
    fn element(&self, model: &Model) -> usize {
        self.side.element(model.elements.len())
    }

    /// Returns the element with an extent.
    fn with(&self, model: &Model, extent: Extent) -> FlowElement {
        FlowElement { inertia: model.inertia(&model.elements[self.element(model)]), extent }
    }

    /// Returns the weight per length of the element in N/m.
    fn weight(&self, model: &Model) -> [f64; 3] {
        model.weight(&model.elements[self.element(model)]).into()
    }

    /// Returns the stiffness of the element at a length in m.
    fn stiffness(&self, model: &Model, length: f64) -> Stiffness<f64> {
        let section = &model.elements[self.element(model)].section;
        Stiffness { axial: 0.25 * section.axial_stiffness * length, bending: 2.0 * section.bending_stiffness / length }
    }

    /// Adds the forces of the flow to `out`, and their negative derivatives to the matrix.
    fn add(&self, model: &Model, at: &ForceInput<'_>, out: &mut [f64], matrix: Option<&mut BlockTridiagonal>) {
        let element = self.with(model, self.at(at.time));
        let mut force = [0.0; 12];
        element.add_force(at.scale, &self.side.gather(at.q), &self.side.gather(at.v), &mut force);
        self.side.add(&force, out);
        if let Some(matrix) = matrix {
            let [by_velocity, by_position] = element.matrices();
            let entry = |r: usize, c: usize| at.scale * (at.dv_dq * by_velocity[r][c] + by_position[r][c]);
            self.add_symmetric(model, matrix, entry);
        }
    }

    /// Adds the symmetric part of a 4x4 table to the blocks of the element.
    fn add_symmetric(&self, model: &Model, matrix: &mut BlockTridiagonal, local: impl Fn(usize, usize) -> f64) {
        let e = self.element(model);
        for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
            let value = 0.5 * (self.side.entry(&local, a, b) + self.side.entry(&local, b, a));
            // rows of coordinate a, columns of coordinate b; only one triangle of blocks is stored
            let block = match (a / 2, b / 2) {
                (0, 0) => &mut matrix.diag[e],
                (1, 1) => &mut matrix.diag[e + 1],
                (1, 0) => &mut matrix.lower[e],
                _ => continue,
            };
            for x in 0..3 {
                block.0[3 * (b % 2) + x][3 * (a % 2) + x] += value;
            }
        }
    }
}

impl Flows {
    /// The flows of the reels of a cable, at rest.
    pub fn new(model: &Model) -> Self {
        let length = |side: Side| model.elements[side.element(model.elements.len())].length;
        let list = model.reels.sides().map(|side| Flow::new(side, length(side))).collect();
        Flows { list, ..Flows::default() }
    }

    /// Returns whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Returns whether what is behind an eye is a part of the system.
    pub fn are_closed(&self) -> bool {
        self.list.iter().any(|flow| flow.source != Source::Outside)
    }

    /// Returns whether all stand still.
    pub fn are_still(&self) -> bool {
        self.list.iter().all(|flow| flow.extent.rate == 0.0 && flow.extent.acceleration == 0.0)
    }

    /// Makes the equations be set anew, whatever their lengths.
    pub fn forget_lengths(&mut self) {
        self.list.iter_mut().for_each(|flow| flow.set = None);
    }

    /// Makes of velocities those that internal damping sees, at `time` (s).
    fn strain_velocity(&self, time: f64, q: &[f64], v: &mut [f64]) {
        for flow in &self.list {
            let Extent { length, rate, .. } = flow.at(time);
            let [far, eye] = flow.side.nodes(v.len() / 6);
            for x in 0..3 {
                v[6 * eye + x] -= (q[6 * eye + x] - q[6 * far + x]) * rate / length;
            }
        }
    }

    /// Adds the forces of all flows to `out`, and their negative derivatives to the matrix; at rest there are none.
    pub fn add(&self, model: &Model, at: &ForceInput<'_>, out: &mut [f64], mut matrix: Option<&mut BlockTridiagonal>) {
        for flow in self.list.iter().filter(|_| !at.v.is_empty()) {
            flow.add(model, at, out, matrix.as_deref_mut());
        }
    }
}

impl System {
    /// Sets what depends on the lengths of the elements at eyes to `time` (s).
    pub fn set_flows(&mut self, model: &Model, time: f64) {
        for k in 0..self.flows.list.len() {
            let length = self.flows.list[k].at(time).length;
            self.set_each_length(model, k, [length, length, 1.0 / length]);
        }
    }

    /// Sets what depends on the lengths of the elements at eyes to those at the beginning of the host step.
    pub fn set_flows_at_start(&mut self, model: &Model) {
        for k in 0..self.flows.list.len() {
            let length = self.flows.list[k].extent.length;
            self.set_each_length(model, k, [length, length, 1.0 / length]);
        }
    }

    /// Sets the lengths of an element at an eye: that of its control vectors, that of axial stiffness and mass, and the inverse of that
    /// of bending.
    fn set_each_length(&mut self, model: &Model, k: usize, [shape, mean, inverse]: [f64; 3]) {
        let System { flows, forces, mass, loads, .. } = self;
        let set = Some([shape, mean, inverse, flows.list[k].stock(mean)]);
        if flows.list[k].set == set {
            return;
        }
        (flows.list[k].set, flows.list[k].weighed) = (set, mean);
        let e = flows.list[k].element(model);
        let element = &model.elements[e];
        let elements = &mut forces.elements;
        elements.scale[e] = 3.0 / shape;
        elements.axial[e] = 0.25 * element.section.axial_stiffness * mean;
        elements.flexural[e] = 2.0 * element.section.bending_stiffness * inverse;
        elements.set_mass(e, model.inertia(element), mean);
        forces.at_points.set_length(e, mean);
        let length = |e: usize| {
            let flow = flows.list.iter().find(|flow| flow.element(model) == e);
            flow.map_or(model.elements[e].length, |flow| flow.weighed)
        };
        let stock = Side::BOTH.map(|side| {
            let flow = flows.list.iter().find(|flow| flow.side == side);
            flow.map_or(0.0, |flow| flow.stock(flow.weighed))
        });
        let inertia = |side: Side| model.inertia(&model.elements[side.element(model.elements.len())]);
        mass.set_element(model, e, length, Side::BOTH.map(|side| stock[side as usize] * inertia(side)));
        loads.weigh_element(model, e, length, stock);
    }

    /// Returns the kinetic energy in J that the flows add to that of the mass matrix.
    pub fn flow_kinetic(&self, model: &Model, time: f64, q: &[f64], v: &[f64]) -> f64 {
        let kinetic = |f: &Flow| f.with(model, f.at(time)).kinetic_energy(&f.side.gather(q), &f.side.gather(v));
        self.flows.list.iter().map(kinetic).sum()
    }

    /// Adds the momentum of the flows at `time` (s) to `p`.
    pub fn add_flow_momentum(&self, model: &Model, time: f64, q: &[f64], p: &mut [f64]) {
        for flow in &self.flows.list {
            let mut own = [0.0; 12];
            flow.with(model, flow.at(time)).add_momentum(&flow.side.gather(q), &mut own);
            flow.side.add(&own, p);
        }
    }

    /// Returns the strain energy in J of an element at an eye, axial and bending, at a length and control vectors.
    fn flow_energy(&self, model: &Model, flow: &Flow, d: &Control<f64>, length: f64) -> (f64, f64) {
        let stiffness = flow.stiffness(model, length);
        let elements = &self.forces.elements;
        let own = energy(&elements.table, &elements.bending, stiffness, d);
        let state = GramState { table: &elements.table, stiffness, g: gram(d), rates: None };
        let e = flow.element(model);
        let of_effects = self.forces.in_element.as_ref().map_or((0.0, 0.0), |effects| effects.energy(e, &state));
        (own.0 + of_effects.0, own.1 + of_effects.1)
    }

    /// Returns the forces in N that strains and internal damping exert on the length of an element at an eye: dU/dl at fixed coordinates,
    /// and the power that damping loses by a rate of the length, over the rate.
    fn strain_length_force(&self, model: &Model, flow: &Flow, extent: &Extent, [q, v]: [&[f64; 12]; 2]) -> [f64; 2] {
        let Extent { length, rate, .. } = *extent;
        let (d, mut velocity) = (control(q, length), control(v, length));
        (0..3).for_each(|x| velocity[1][x] -= rate / length * d[1][x]);
        let stiffness = flow.stiffness(model, length);
        let (axial, bending) = self.flow_energy(model, flow, &d, length);
        let along = |velocity: Option<Control<f64>>| {
            let gradient = self.flow_gradient(flow.element(model), &ElementState { stiffness, d, velocity });
            (0..3).map(|x| d[1][x] * gradient[1][x]).sum::<f64>() / length
        };
        let elastic = along(None);
        let damping = if self.forces.in_element.is_some() { elastic - along(Some(velocity)) } else { 0.0 };
        [(axial - bending) / length - elastic, damping]
    }

    /// Returns the forces that oppose changes of the control vectors of an element.
    fn flow_gradient(&self, element: usize, state: &ElementState<f64>) -> Control<f64> {
        let Elements { table, bending, .. } = &self.forces.elements;
        let effects = &self.forces.in_element.as_ref();
        Kernel { table, bending, effects }.force(state, &Single(element))
    }
}

/// Control vectors of an element with 12 coordinates.
fn control(q: &[f64; 12], length: f64) -> Control<f64> {
    let s = 3.0 / length;
    [[q[3], q[4], q[5]], core::array::from_fn(|x| s * (q[6 + x] - q[x])), [q[9], q[10], q[11]]]
}

/// Any number in -1..1, for tests.
#[cfg(test)]
fn some(seed: usize) -> f64 {
    (1.7 * seed as f64 + 0.3).sin()
}
