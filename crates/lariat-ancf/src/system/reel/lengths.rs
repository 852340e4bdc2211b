//! What depends on the lengths of the elements at eyes: their stiffness, mass and weight, energies
//! and momenta.

use super::FeedElement;
use super::feeds::control;
use crate::effect::acts::Single;
use crate::element::gram::{Control, gram};
use crate::element::kernel::{ElementState, GramState, Kernel, energy};
use crate::element::side::Side;
use crate::element::variable_length::Extent;
use crate::model::Model;
use crate::system::System;
use crate::system::elements::Elements;

impl System {
    /// Sets what depends on the lengths of the elements at eyes to `time` (s).
    pub fn set_feeds(&mut self, model: &Model, time: f64) {
        for k in 0..self.feeds.list.len() {
            let length = self.feeds.list[k].at(time).length;
            self.set_each_length(model, k, [length, length, 1.0 / length]);
        }
    }

    /// Sets what depends on the lengths of the elements at eyes to those at the beginning of the
    /// host step.
    pub fn set_feeds_at_start(&mut self, model: &Model) {
        for k in 0..self.feeds.list.len() {
            let length = self.feeds.list[k].extent.length;
            self.set_each_length(model, k, [length, length, 1.0 / length]);
        }
    }

    /// Sets the lengths of an element at an eye: that of its control vectors, that of axial
    /// stiffness and mass, and the inverse of that of bending.
    pub(super) fn set_each_length(&mut self, model: &Model, k: usize, [shape, mean, inverse]: [f64; 3]) {
        let System { feeds, forces, mass, loads, .. } = self;
        let set = Some([shape, mean, inverse, feeds.list[k].stock(mean)]);
        if feeds.list[k].set == set {
            return;
        }
        (feeds.list[k].set, feeds.list[k].weighed) = (set, mean);
        let e = feeds.list[k].element(model);
        let element = &model.elements[e];
        let elements = &mut forces.elements;
        elements.scale[e] = 3.0 / shape;
        elements.axial[e] = 0.25 * element.section.axial_stiffness * mean;
        elements.flexural[e] = 2.0 * element.section.bending_stiffness * inverse;
        elements.set_mass(e, model.inertia(element), mean);
        if let Some(effects) = &mut forces.in_element {
            effects.set_length_over(e, mean, inverse);
        }
        forces.at_points.set_length(e, mean);
        if let Some(densities) = &mut forces.densities {
            densities.set_length(feeds.list[k].side, mean);
        }
        let length = |e: usize| {
            let feed = feeds.list.iter().find(|feed| feed.element(model) == e);
            feed.map_or(model.elements[e].length, |feed| feed.weighed)
        };
        let stock = Side::BOTH.map(|side| {
            let feed = feeds.list.iter().find(|feed| feed.side == side);
            feed.map_or(0.0, |feed| feed.stock(feed.weighed))
        });
        let inertia = |side: Side| model.inertia(&model.elements[side.element(model.elements.len())]);
        mass.set_element(model, e, length, Side::BOTH.map(|side| stock[side as usize] * inertia(side)));
        loads.weigh_element(model, e, length, stock);
    }

    /// Returns the kinetic energy in J that the feeds add to that of the mass matrix.
    pub fn feed_kinetic(&self, model: &Model, time: f64, q: &[f64], v: &[f64]) -> f64 {
        let kinetic = |f: &FeedElement| f.with(model, f.at(time)).kinetic_energy(&f.side.gather(q), &f.side.gather(v));
        self.feeds.list.iter().map(kinetic).sum()
    }

    /// Adds the momentum of the feeds at `time` (s) to `p`.
    pub fn add_feed_momentum(&self, model: &Model, time: f64, q: &[f64], p: &mut [f64]) {
        for feed in &self.feeds.list {
            let mut own = [0.0; 12];
            feed.with(model, feed.at(time)).add_momentum(&feed.side.gather(q), &mut own);
            feed.side.add(&own, p);
        }
    }

    /// Returns the parts of the strain energy in J of an element at an eye, at a length and control
    /// vectors, that grow with the length and with its inverse: axial and bending.
    pub(super) fn feed_energy(&self, model: &Model, feed: &FeedElement, d: &Control<f64>, length: f64) -> (f64, f64) {
        let stiffness = feed.stiffness(model, length);
        let elements = &self.forces.elements;
        let own = energy(&elements.table, &elements.bending, stiffness, d);
        let state = GramState { table: &elements.table, stiffness, g: gram(d), rates: None };
        let e = feed.element(model);
        let of_effects =
            self.forces.in_element.as_ref().map_or((0.0, 0.0), |effects| effects.energy_by_length(e, &state));
        (own.0 + of_effects.0, own.1 + of_effects.1)
    }

    /// Returns the force in N on the length of an element at an eye over a step, at control vectors
    /// that stay, of the energy that is in no part of [`feed_energy`](Self::feed_energy).
    pub(super) fn rest_on_length(
        &self,
        model: &Model,
        feed: &FeedElement,
        d: [&Control<f64>; 2],
        lengths: [f64; 2],
    ) -> f64 {
        let Some(effects) = &self.forces.in_element else { return 0.0 };
        let e = feed.element(model);
        effects.on_length(e, model.elements[e].section.bending_stiffness, d, lengths)
    }

    /// Returns the forces in N that strains and internal damping exert on the length of an element
    /// at an eye: dU/dl at fixed coordinates, and the power that damping loses by a rate of the
    /// length, over the rate; the lengths must be [set](Self::set_feeds) to it.
    pub(super) fn strain_length_force(
        &self,
        model: &Model,
        feed: &FeedElement,
        extent: &Extent,
        [q, v]: [&[f64; 12]; 2],
    ) -> [f64; 2] {
        let Extent { length, rate, .. } = *extent;
        let (d, mut velocity) = (control(q, length), control(v, length));
        (0..3).for_each(|x| velocity[1][x] -= rate / length * d[1][x]);
        let stiffness = feed.stiffness(model, length);
        let (axial, bending) = self.feed_energy(model, feed, &d, length);
        let along = |velocity: Option<Control<f64>>| {
            let gradient = self.feed_gradient(feed.element(model), &ElementState { stiffness, d, velocity });
            (0..3).map(|x| d[1][x] * gradient[1][x]).sum::<f64>() / length
        };
        let elastic = along(None);
        let damping = if self.forces.in_element.is_some() { elastic - along(Some(velocity)) } else { 0.0 };
        let rest = self.rest_on_length(model, feed, [&d, &d], [length, length]);
        [(axial - bending) / length + rest - elastic, damping]
    }

    /// Returns the forces that oppose changes of the control vectors of an element.
    pub(super) fn feed_gradient(&self, element: usize, state: &ElementState<f64>) -> Control<f64> {
        let Elements { table, bending, .. } = &self.forces.elements;
        let effects = &self.forces.in_element.as_ref();
        Kernel { table, bending, effects }.force(state, &Single(element))
    }
}
