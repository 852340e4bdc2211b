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
//! largest load since it was asked last, at the end of a host step usually: [`Break`] says when
//! within it the limit was exceeded most. What the steps themselves do not resolve they do not see;
//! [`Warning::UnseenLoad`](crate::Warning::UnseenLoad) says where that may have exceeded the limit.
//! A part keeps the load that it had at the break until the wave of the break, of the speed
//! sqrt(EA/rho A), has run through: until then that load breaks it no more. Breaking at a node
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
use crate::section::Element;
use crate::strength::{Break, BreakCause, Load, LoadRecord, Strength};

impl Cable {
    /// Returns what the cable withstands.
    pub fn strength(&self) -> Strength {
        self.model.strength
    }

    /// Sets what the cable withstands: a [`Strength`], or a tension in N. The load is read after
    /// each integration step, and the cable breaks when
    /// [`break_overloaded`](Self::break_overloaded) is called; a `CableSet` of lariat-rapier does
    /// so after each host step.
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
        // of what a part has had since its cable broke, only what is its own counts
        let is_own = |load: &Load| load.share > 1.0 && !self.snapshot.load.is_passing(load);
        let Some(load) = self.peak_load().filter(is_own).or_else(|| self.snapshot.load.worst().filter(is_own)) else {
            self.snapshot.load.take();
            return Ok(None);
        };
        self.snapshot.load.take();
        let Some(arc_length) = self.inner_node(load.arc_length) else { return Ok(None) };
        let Load { cause, tension, damping, strain, time, .. } = load;
        let (mut rest, how) =
            self.part(arc_length, |cable| Break { cause, tension, damping, strain, time, ..cable })?;
        [self, &mut rest].into_iter().for_each(Cable::know_load);
        Ok(Some((rest, how)))
    }

    /// Lets the present load of a part of a cable that broke count no more until the wave of the
    /// break has run through it.
    fn know_load(&mut self) {
        let load = self.reading().largest_load(self.strength());
        let passing = |e: &Element| e.length * (self.model.inertia(e) / e.section.axial_stiffness).sqrt();
        let until = load.time + self.elements().iter().map(passing).sum::<f64>();
        self.snapshot.load = LoadRecord::of_part(load.share, [load.time, until]);
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
        let s = self.arc_length(at)?;
        self.part(s, |cut| cut)
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
