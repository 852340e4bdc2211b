//! Breaking a cable where its tension or strain exceeds what it withstands.
//!
//! # Equation
//!
//! Tension and strain are read at both ends of every element, as [`Cable::sample`] reads them but
//! without the tension of damping; the strain is `f/f_0 - 1`, f the stretch of the projected Green
//! strain and f_0 the rest stretch. The cable breaks at the inner node nearest to the reading that
//! exceeds its limit most.
//!
//! # Validity
//!
//! The load is [read](crate::system) after every integration step, and the cable breaks by the
//! largest load since it was asked last: [`Break`] says when that was. Who steps until
//! [`overloaded_at`](crate::coupling::Coupling::overloaded_at) and breaks it there, as a `CableSet`
//! of lariat-rapier does, goes on with the parts from the integration step that exceeded the limit.
//! What the steps themselves do not resolve they do not see;
//! [`Warning::UnseenLoad`](crate::Warning::UnseenLoad) says where that may have exceeded the limit.
//!
//! A part recoils with the strain energy that it had at the break: the wave of the break, of the
//! speed sqrt(EA/rho A), runs to and fro in it, and overshoots on a mesh; the part flies past the
//! end that is held, and snaps taut on the other side. As long as that takes at the speed of this
//! energy, a load breaks it only if its strain energy is larger than what is left of it: the least
//! sum, since the break, of strain energy, kinetic energy about the centre of mass, and kinetic
//! energy of the centre as seen from any node. More comes from others that do work on it. So it is
//! with parts of a cable that was cut. A part that nothing holds and nothing is tied to has no
//! tension but its recoil, however long. Until the wave has been everywhere in a part, no load
//! breaks it: what is at its limit then was so at the break. What else exceeds the limit at the
//! time of a break breaks by its own load once its part has recoiled: a rope breaks at one place.
//!
//! What flies freely and snaps taut again, behind a body that accelerates say, breaks by a load of
//! its own, and without damping that goes on until the parts are short: how often is a matter of
//! what a real rope dissipates, and [`Warning::BreaksAgain`](crate::Warning::BreaksAgain) says so.
//!
//! Breaking at a node
//! changes neither shape nor motion, so mass, momenta and energy of the parts are those of the
//! whole to rounding ([`Break`]); the strain energy becomes motion in the steps that follow. A
//! cable of one element has no inner node: [`Cable::set_strength`] refuses it, and a part of one
//! element stays whole.
//!
//! # References
//!
//! Conservation; `cut` for the parts.
//!
//! # Alternatives considered
//!
//! Splitting the element at the reading: it is at a node already, since readings are largest at the
//! ends of elements, and next to a support the part would be too short to step.

use crate::at::At;
use crate::cable::Cable;
use crate::error::Error;
use crate::scales::cable::{WAVE_PASSES, WAYS_OF_RECOIL};
use crate::scales::integrate::SINGLE_PRECISION_ROUNDING;
use crate::section::Element;
use crate::strength::{Break, BreakCause, Load, LoadRecord, Recoil, Strength};

impl Cable {
    /// Returns what the cable withstands.
    pub fn strength(&self) -> Strength {
        self.model.strength
    }

    /// Sets what the cable withstands: a [`Strength`], or a tension in N. The load is read after
    /// each integration step, and the cable breaks when
    /// [`break_overloaded`](Self::break_overloaded) is called; a `CableSet` of lariat-rapier does
    /// so where the limit is exceeded.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a limit that is not positive, [`Error::OneElement`] for a limit
    /// on a cable of one element.
    pub fn set_strength(&mut self, strength: impl Into<Strength>) -> Result<(), Error> {
        let strength = strength.into();
        strength.check().map_err(|e| e.of_cable(self.name()))?;
        if strength.is_limited() && self.elements().len() < 2 {
            return Err(Error::OneElement { cable: self.name().to_string() });
        }
        if strength != self.model.strength {
            (self.model.strength, self.snapshot.load) = (strength, LoadRecord::default());
        }
        Ok(())
    }

    /// Breaks the cable if it is overloaded: this one keeps the part before the break, the rest is
    /// returned, and both keep the [strength](Self::strength). Loads, effects and supports stay
    /// with their part.
    ///
    /// # Errors
    /// As [`cut`](Self::cut); not for a cable that was built.
    pub fn break_overloaded(&mut self) -> Result<Option<(Cable, Break)>, Error> {
        let strength = self.strength();
        if !strength.is_limited() {
            return Ok(None);
        }
        // those that were noted are no recoils, the present one may be
        let is_own = |load: &Load| load.share > 1.0 && !(load.time == self.time() && self.is_recoil());
        let noted = || self.snapshot.load.worst().filter(is_own);
        let Some(load) = self.peak_load().filter(is_own).or_else(noted) else {
            self.snapshot.load.take();
            return Ok(None);
        };
        self.snapshot.load.take();
        let Some(arc_length) = self.inner_node(load.arc_length) else { return Ok(None) };
        let Load { cause, tension, damping, strain, time, .. } = load;
        let breaks = 1 + self.snapshot.load.breaks();
        let (mut rest, how) =
            self.part(arc_length, |cable| Break { cause, tension, damping, strain, time, breaks, ..cable })?;
        [self, &mut rest].into_iter().for_each(|part| part.recoil(breaks));
        Ok(Some((rest, how)))
    }

    /// Advances a cable by itself by `dt` (s) as [`step`](Self::step) does, and breaks it where its
    /// load exceeds its limit: the parts go on from the end of that integration step. Returns the
    /// parts behind the breaks, which are then at the same time. A cable with a limit is copied for
    /// it, and one that breaks takes the step once more up to the break.
    ///
    /// # Errors
    /// As [`step`](Self::step); the cable is then exactly as before.
    pub fn step_and_break(&mut self, dt: f64) -> Result<Vec<(Cable, Break)>, Error> {
        let before = self.strength().is_limited().then(|| self.clone());
        self.step(dt)?;
        let Some(before) = before else { return Ok(Vec::new()) };
        let Some(at) = self.snapshot.load.exceeded() else { return Ok(Vec::new()) };
        let (mut whole, done) = (before.clone(), (at - before.time()).max(0.0));
        let parts = whole.break_within(done, dt);
        *self = if parts.is_ok() { whole } else { before };
        parts
    }

    /// Advances by `done` (s), breaks if overloaded, and goes on until `dt` (s).
    fn break_within(&mut self, done: f64, dt: f64) -> Result<Vec<(Cable, Break)>, Error> {
        // what rounding leaves is no step
        let left = if dt - done > SINGLE_PRECISION_ROUNDING * dt { dt - done } else { 0.0 };
        self.step(done)?;
        let Some((mut rest, how)) = self.break_overloaded()? else {
            self.step(left)?;
            return Ok(Vec::new());
        };
        let (before, behind) = (self.step_and_break(left)?, rest.step_and_break(left)?);
        Ok([(rest, how)].into_iter().chain(before).chain(behind).collect())
    }

    /// Lets a part of a cable that broke or was cut recoil: it breaks no more by that. `breaks`
    /// made it what it is.
    fn recoil(&mut self, breaks: u32) {
        let energy = self.reading().strain_energy();
        let of = |f: &dyn Fn(&Element) -> f64| self.elements().iter().map(f).sum::<f64>();
        let wave = of(&|e| e.length * (self.model.inertia(e) / e.section.axial_stiffness).sqrt());
        let mass = of(&|e| e.length * self.model.inertia(e));
        // one without strain does not fly
        let flight = if energy > 0.0 { self.length() / (2.0 * energy / mass).sqrt() } else { 0.0 };
        let is_loose = self.model.supports.is_empty() && self.model.loads.is_empty() && !self.has_reel();
        let until = if is_loose { f64::MAX } else { self.time() + WAVE_PASSES * wave + WAYS_OF_RECOIL * flight };
        let relieved = self.time() + wave;
        self.snapshot.load = LoadRecord::of_part(Recoil { energy, until, relieved, breaks });
    }

    /// Returns whether the present load is a recoil of a break before.
    fn is_recoil(&self) -> bool {
        let recoil = self.snapshot.load.recoil(self.time());
        recoil.is_some_and(|recoil| recoil.explains(self.time(), self.reading().strain_energy()))
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn peak_load(&self) -> Option<Load> {
        let strength = self.strength();
        if !strength.is_limited() {
            return None;
        }
        let now = self.reading().largest_load(strength);
        let passed = self.snapshot.passed_at_start();
        let before = self.snapshot.load.worst().filter(|worst| worst.share > now.share);
        Some(before.map_or(now, |load| {
            let arc_length = (load.arc_length + passed).clamp(0.0, self.length());
            Load { arc_length, ..load }
        }))
    }

    /// Cuts the cable at a point as [`cut`](Self::cut) does, and returns beside the rest what it
    /// carried there.
    ///
    /// # Errors
    /// As [`cut`](Self::cut).
    pub fn break_at(&mut self, at: impl Into<At>) -> Result<(Cable, Break), Error> {
        let at = At::ArcLength(self.arc_length(at)?);
        let (mut rest, how) = self.divide_at(at)?;
        if self.strength().is_limited() {
            let breaks = self.snapshot.load.breaks();
            [self, &mut rest].into_iter().for_each(|part| part.recoil(breaks));
        }
        Ok((rest, how))
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn divide_at(&mut self, at: At) -> Result<(Cable, Break), Error> {
        self.part(self.arc_length(at)?, |cut| cut)
    }

    fn part(&mut self, arc_length: f64, told: impl FnOnce(Break) -> Break) -> Result<(Cable, Break), Error> {
        let (e, xi) = self.model.locate(arc_length);
        let (tension, strain) = self.load_in(e, xi);
        let (energy, inserted) = (self.energy(), self.inserted_energy());
        let rest = self.cut(At::ArcLength(arc_length))?;
        let cut = Break {
            cause: BreakCause::Cut,
            arc_length: self.length(),
            tension,
            damping: 0.0,
            strain,
            time: self.time(),
            strain_energy: energy.axial + energy.bending + energy.torsion,
            inserted_energy: self.inserted_energy() - inserted,
            breaks: self.snapshot.load.breaks(),
        };
        Ok((rest, told(cut)))
    }

    /// Returns tension (N) and strain at a local coordinate of an element.
    fn load_in(&self, e: usize, xi: f64) -> (f64, f64) {
        let sample = self.smooth_in(e, xi);
        let middle = || self.node_arc_lengths()[e] + 0.5 * self.elements()[e].length;
        let rest = self.effects().rest_shape.as_ref().map_or(1.0, |shape| shape.at(middle()).0);
        (sample.tension, (1.0 + 2.0 * sample.green_strain).max(0.0).sqrt() / rest - 1.0)
    }

    /// Returns the arc length in m of the inner node nearest to another; a cable of one element has
    /// none.
    fn inner_node(&self, arc_length: f64) -> Option<f64> {
        let nodes = self.node_arc_lengths();
        let distance = |node: &f64| (node - arc_length).abs();
        nodes[1..nodes.len() - 1].iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }
}
