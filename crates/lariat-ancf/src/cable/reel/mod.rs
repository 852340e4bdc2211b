//! Reels at the ends of a cable: they pay it out and take it in.
//!
//! # Equation
//!
//! Only the element at the eye, the last one of that end, is of changing material
//! ([`element::variable_length`](crate::element)): its length l is a function of time, given by the
//! rate of the reel. All others are made of the same particles for ever, so supports and loads keep
//! their material. Arc lengths count from the first node as it is: those of all material grow with
//! what a reel at the start pays out. [`remesh`] keeps l near the length of the elements, and
//! [`plan`] chooses the rate.
//!
//! # Validity
//!
//! The rate is prescribed, and the winch as strong as it must be: [`ReelReading::force`] says how
//! strong that is; or the motor slips above a [largest force](Reel::max_force), and the rate is an
//! unknown of the discrete gradient (system/reel/law.rs). A rate above 0.3 of the speed of
//! transverse waves, `sqrt(T/rho A)`, needs internal damping. A rope that is paid out faster than
//! it falls crumples at the eye; what splitting and merging crumpled elements adds of strain energy
//! is taken back by [`settle`], and [`ReelReading::remeshed`] says what is left. The node at the
//! eye is held by a support, or by an attachment to a body. On a body that moves freely the stock
//! rides with it, as a point mass at the eye beside the body's own mass; [`Reel::stock`] says how
//! much there is, and energy and momentum of the cable include it. That takes the discrete
//! gradient. Implicit methods only. Gravity, axial laws, internal damping, a uniform rest shape,
//! drag, buoyancy, forces per length of your own, and line loads on all of the cable act on the
//! element at the eye, stock at most weighs (less buoyancy); [torsion](crate::Torsion) acts on its
//! length, and stock is not twisted; other effects are refused ([`Error::NotWithReel`]). Contact
//! acts on all other elements: the one at the eye goes into the device, and touches nothing.
//!
//! # Alternatives considered
//!
//! Arc lengths from the far end of a reel at the start: a cable with two reels has none.

mod plan;
mod reading;
mod remesh;
mod settle;
mod static_feed;
mod step;
mod winding;

use crate::scales::SAME;
pub use reading::ReelReading;
pub(crate) use winding::Winding;

use super::{Cable, Snapshot};
use crate::at::At;
use crate::effect::RestShape;
use crate::element::side::Side;
use crate::error::{Error, require};
use crate::integrate::{Fidelity, Integrator};
use crate::model::Model;
use crate::reel::{Feed, Reel, Reels};
use crate::system::Source;

impl Snapshot {
    /// Returns the number of nodes that the state must have: its own with a reel, else that of the
    /// cable.
    pub(super) fn nodes_with_reel(&self, reel: bool, nodes: usize) -> usize {
        let wound = self.windings.iter().any(Option::is_some);
        if reel && wound { (self.state.q.len() / 6).max(2) } else { nodes }
    }

    /// Returns the number of elements that came through the eye at the start, on balance.
    pub(super) fn nodes_from_start(&self) -> i64 {
        self.windings[Side::Start as usize].map_or(0, |winding| winding.splits as i64 - winding.merges as i64)
    }

    /// Returns the length in m that came through the eye at the start, on balance.
    pub(crate) fn passed_at_start(&self) -> f64 {
        self.windings[Side::Start as usize].map_or(0.0, |winding| winding.passed)
    }
}

impl Cable {
    /// Puts a reel at an end of the cable: from the next step on, it pays cable out and takes it in
    /// through that node, the eye. Hold it by a support or an attachment.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers out of range, [`Error::ReelPlace`] for another place
    /// than an end, for a second reel there, or for two reels on one element,
    /// [`Error::ExplicitReel`] for an explicit integrator, [`Error::ReelMethod`] for a largest
    /// force under another integrator than the discrete gradient, and for one without an estimate
    /// of its error, [`Error::NotWithReel`] for effects and point loads that the flowing element
    /// does not carry. The cable is then as before.
    pub fn add_reel(&mut self, at: impl Into<At>, reel: Reel) -> Result<(), Error> {
        reel.check().map_err(|e| e.of_cable(self.name()))?;
        let refused = |reason| Error::ReelPlace { cable: self.name().to_string(), reason };
        let Some(side) = self.side(at.into()) else { return Err(refused("a reel is at an end of a cable")) };
        if self.model.reels.get(side).is_some() {
            return Err(refused("it has a reel there already"));
        }
        if self.has_reel() && self.elements().len() < 2 {
            return Err(refused("two reels need two elements"));
        }
        let mut model = self.model.clone();
        let length = self.length();
        if let Some(stock) = reel.stock {
            // to rounding: a reel ends at its stock
            let enough = stock >= self.out(side) * (1.0 - 1e-9);
            require("stock of a reel (m)", stock, enough, "at least the length that is out")
                .map_err(|e| e.of_cable(self.name()))?;
        }
        model.effects.line_loads.iter_mut().for_each(|loads| loads.extend(length));
        model.reels.add(side, reel, self.elements(), self.number(self.elements().len() - 1));
        model.check_effects().and_then(|()| model.check_loads_at_eyes()).map_err(|e| e.of_cable(self.name()))?;
        let integrator = self.integrator_with_reels(&model);
        super::check_integrator(&model, &integrator.method)?;
        let length = self.elements()[side.element(self.elements().len())].length;
        self.rebuild(model)?;
        self.integrator = integrator;
        self.snapshot.windings[side as usize] = Some(Winding::new(length));
        self.sync_reel();
        self.revise();
        Ok(())
    }

    /// Returns the integrator that the cable has with the reels of a model: where their rates are
    /// unknown and a fidelity chose it, the one that solves for them, as contact has it.
    fn integrator_with_reels(&self, model: &Model) -> Integrator {
        match self.integrator() {
            own if !model.reels.have_laws() || own != Integrator::default() => own,
            _ if self.default_integrator => self.integrator_for(Fidelity::Game),
            _ => Integrator::COUPLED,
        }
    }

    /// Changes what the reel at an end does from now on. The rate follows with the acceleration of
    /// the reel.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers out of range, [`Error::ReelPlace`] for an end without a
    /// reel, [`Error::ReelMethod`] for a largest force under another integrator than the discrete
    /// gradient.
    pub fn set_reel(&mut self, at: impl Into<At>, reel: Reel) -> Result<(), Error> {
        reel.check().map_err(|e| e.of_cable(self.name()))?;
        let Some(side) = self.side(at.into()).filter(|&side| self.model.reels.get(side).is_some()) else {
            return Err(Error::ReelPlace { cable: self.name().to_string(), reason: "it has none there" });
        };
        let Some(own) = self.model.reels.get_mut(side) else { return Ok(()) };
        let before = core::mem::replace(own, reel);
        let integrator = self.integrator_with_reels(&self.model);
        let outcome = super::check_integrator(&self.model, &integrator.method);
        if let (Err(_), Some(own)) = (&outcome, self.model.reels.get_mut(side)) {
            *own = before;
        } else {
            self.integrator = integrator;
            self.snapshot.windings[side as usize].iter_mut().for_each(|winding| winding.plan = None);
        }
        outcome
    }

    /// Changes the rate of the reel at an end in m/s: positive pays out. It is reached at the end
    /// of the next step, linearly, if the acceleration of the reel lets it.
    ///
    /// # Errors
    /// As [`set_reel`](Self::set_reel).
    pub fn set_reel_rate(&mut self, at: impl Into<At>, rate: f64) -> Result<(), Error> {
        let at = at.into();
        let own = self.reel_description(at).cloned().unwrap_or_default();
        self.set_reel(at, Reel { rate: Reel::with_rate(rate).rate, to_length: None, ..own })
    }

    /// Lets the reel at an end come to a length of cable in m that is out, and stop there to
    /// rounding, with a rate in m/s of at most the size of `rate` and within the acceleration of
    /// the reel. Where it moves too fast to stop there, it comes back. A motor that slips comes
    /// there once it holds again.
    ///
    /// ```
    /// use lariat_ancf::{At, Cable, Reel, Section, Vector3};
    ///
    /// let mut cable = Cable::builder()
    ///     .points([Vector3::zeros(), Vector3::new(0.0, -2.0, 0.0)])
    ///     .section(Section::square(0.01, 1.0e8, 1000.0)?)
    ///     .fix(At::Start)
    ///     .elements(8)
    ///     .build()?;
    /// cable.add_reel(At::Start, Reel::default())?;
    /// cable.set_reel_length(At::Start, 2.5, 1.0)?;
    /// for _ in 0..120 {
    ///     cable.step(1.0 / 60.0)?;
    /// }
    /// assert!((cable.length() - 2.5).abs() < 1e-9);
    /// # Ok::<(), lariat_ancf::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`set_reel`](Self::set_reel).
    pub fn set_reel_length(&mut self, at: impl Into<At>, length: f64, rate: f64) -> Result<(), Error> {
        let at = at.into();
        let own = self.reel_description(at).cloned().unwrap_or_default();
        self.set_reel(at, Reel { rate: Reel::with_rate(rate).rate, to_length: Some(length), ..own })
    }

    /// Takes the reel at an end away: what is out stays, and nothing moves through the eye any
    /// more. Does nothing without a reel.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix cannot be factored; not for a cable that was built.
    pub fn remove_reel(&mut self, at: impl Into<At>) -> Result<(), Error> {
        let Some(side) = self.side(at.into()).filter(|&side| self.model.reels.get(side).is_some()) else {
            return Ok(());
        };
        let mut model = self.model.clone();
        let e = side.element(model.elements.len());
        model.reels.remove(side, self.number(e), model.elements[e]);
        if side == Side::Start {
            model.force_densities = model.force_densities.behind(-self.snapshot.passed_at_start());
        }
        if model.reels.is_empty() {
            model.reels = Reels::default();
        }
        self.rebuild(model)?;
        self.snapshot.windings[side as usize] = None;
        self.disturb();
        self.revise();
        Ok(())
    }

    /// Returns the number of element `e` by its material: see [`Reels`].
    pub(crate) fn number(&self, e: usize) -> i64 {
        e as i64 - self.nodes_from_start()
    }

    /// Sets the equations to the present state of the reels.
    pub(crate) fn sync_reel(&mut self) {
        if !self.has_reel() {
            return;
        }
        self.system.scales.measure_ends(&self.model);
        let forgotten = self.snapshot.state.memory.differences.is_empty();
        for feed in &mut self.system.feeds.list {
            let Some(winding) = &self.snapshot.windings[feed.side as usize] else { continue };
            (feed.start, feed.left_rate) = (self.snapshot.state.time, None);
            feed.extent = winding.extent();
            // without memory of coordinates there is none of lengths: at a split at the other end
            feed.length_before = if forgotten { feed.extent.length } else { winding.length_before };
            let stock = self.model.reels.get(feed.side).and_then(|reel| reel.stock).filter(|_| winding.rides);
            // what came from the other end is none of this reel
            let other = self.snapshot.windings[1 - feed.side as usize].map_or(0.0, |other| other.passed - other.beyond);
            let both = stock.map(|stock| (stock + other - self.model.length()).max(0.0) + feed.extent.length);
            let over_sheave = self.model.reels.get(feed.side).is_some_and(|reel| reel.feed == Feed::Sheave);
            feed.source = if over_sheave { Source::Cable } else { both.map_or(Source::Outside, Source::Stock) };
        }
        self.system.set_feeds(&self.model, self.snapshot.state.time);
        let winding =
            self.snapshot.windings[Side::Start as usize].filter(|_| self.model.reels.get(Side::Start).is_some());
        if let (Some(winding), Some(densities)) = (winding, &mut self.system.forces.densities) {
            densities.set_origin(winding.extent[0] - winding.passed);
        }
    }

    /// Sets the mesh to that of the state of reels in a snapshot with this number of nodes.
    pub(crate) fn mesh_of_reel(&mut self, snapshot: &Snapshot, nodes: usize) -> Result<(), Error> {
        if !self.has_reel() {
            return Ok(());
        }
        let mut model = self.model.clone();
        let from_start = snapshot.nodes_from_start();
        model.reels.check_numbers(-from_start, nodes - 1).map_err(|e| e.of_cable(&model.name))?;
        model.elements = (0..nodes - 1).map(|e| model.reels.element(e as i64 - from_start)).collect();
        for side in self.model.reels.sides() {
            if let Some(winding) = &snapshot.windings[side as usize] {
                model.elements[side.element(nodes - 1)].length = winding.extent[0];
            }
        }
        let passed = snapshot.passed_at_start();
        if model.elements == self.model.elements && passed == self.snapshot.passed_at_start() {
            return Ok(());
        }
        model.renumber(self.nodes(), from_start - self.nodes_from_start());
        model.move_loads(passed);
        self.rebuild(model)
    }
}

impl Model {
    /// Renumbers the supports of a cable that had so many nodes, of which `added` more are at a
    /// reel at its start now.
    fn renumber(&mut self, before: usize, added: i64) {
        let number = self.renumbering(before, added);
        self.supports.iter_mut().for_each(|(node, _)| *node = number(*node));
    }

    /// Returns the new numbers of its nodes.
    fn renumbering(&self, before: usize, added: i64) -> impl Fn(usize) -> usize + use<> {
        let (last, [at_start, at_end]) = (self.nodes() - 1, Side::BOTH.map(|side| self.reels.get(side).is_some()));
        move |node| match node {
            0 if at_start => 0,
            eye if at_end && eye + 1 == before => last,
            inner => (inner as i64 + added).clamp(0, last as i64) as usize,
        }
    }

    /// Puts the loads where their material is after a length in m came through the eye at the
    /// start: whatever the way to it, to the last bit.
    pub(super) fn move_loads(&mut self, passed: f64) {
        let length = self.length();
        self.potentials.move_to(passed, length);
        for (load, origin) in self.loads.iter_mut().zip(&self.load_origins) {
            load.arc_length = (origin + passed).clamp(0.0, length);
        }
    }

    /// Notes which material the loads are on, when so much in m has come through the eye at the
    /// start.
    pub(super) fn note_load_origins(&mut self, passed: f64) {
        self.load_origins.clear();
        self.load_origins.extend(self.loads.iter().map(|load| load.arc_length - passed));
    }

    /// Returns the distances in m of the point loads and potentials from the end at a side.
    pub(super) fn loads_from(&self, side: Side) -> impl Iterator<Item = f64> {
        let length = if self.pulled_points().next().is_none() { 0.0 } else { self.length() };
        self.pulled_points().map(move |at| if side == Side::End { length - at } else { at })
    }

    /// Refuses point loads on elements at eyes: their force on its length is not there.
    pub(crate) fn check_loads_at_eyes(&self) -> Result<(), Error> {
        for side in self.reels.sides() {
            let length = self.elements[side.element(self.elements.len())].length;
            if self.loads_from(side).any(|distance| distance < length - SAME * length) {
                return Err(Error::NotWithReel {
                    cable: self.name.clone(),
                    what: "a point load or potential on the element at the eye",
                });
            }
        }
        Ok(())
    }

    /// Refuses effects that the element at the eye of a reel does not carry.
    pub(crate) fn check_with_reel(&self) -> Result<(), Error> {
        let in_pieces =
            |shape: &RestShape| shape.pieces.len() > 1 || shape.pieces.first().is_some_and(|piece| piece.from > 0.0);
        let refused = [
            ("a sampled flow", self.effects.drag.as_ref().is_some_and(|drag| !drag.flow.samples.is_empty())),
            (
                "added mass: it acts along the cable, too, and what comes out along itself moves no fluid",
                self.effects.buoyancy.is_some_and(|buoyancy| buoyancy.added_mass > 0.0),
            ),
            (
                "line loads on a part of the cable",
                self.effects.line_loads.as_ref().is_some_and(|loads| !loads.are_whole()),
            ),
            (
                "a rest shape in pieces: stock has no memory of where a piece begins",
                self.effects.rest_shape.as_ref().is_some_and(in_pieces),
            ),
        ];
        match refused.iter().find(|(_, is_there)| *is_there) {
            None => Ok(()),
            Some((what, _)) => Err(Error::NotWithReel { cable: self.name.clone(), what }),
        }
    }
}
