//! Reading a set: its events, totals and warnings.

use super::CableSet;
use crate::body::unsettled::Unsettled;
use crate::contents::gaps::OpenGap;
use crate::error::{Error, Failure};
use crate::events::Event;
use crate::handle::{AttachmentHandle, CableHandle};
#[cfg(feature = "debug-render")]
use crate::read::draw::{self, DrawStyle};
use crate::read::totals::{self, WorldEnergy};
use crate::read::warnings::{self, Warning};
use lariat_ancf::Momentum;
use lariat_ancf::integrate::OneStep;
#[cfg(feature = "debug-render")]
use rapier::pipeline::DebugRenderBackend;
use rapier::pipeline::PhysicsWorld;

impl CableSet {
    /// Returns the events of the last host step.
    pub fn events(&self) -> &[Event] {
        &self.stepper.events
    }

    /// Removes and returns the events of the last host step.
    pub fn take_events(&mut self) -> Vec<Event> {
        core::mem::take(&mut self.stepper.events)
    }

    /// Returns the islands that could not step in the last host step, with their cables and errors.
    /// They are as they were before the Rapier step that failed, and are tried again in the next
    /// host step.
    pub fn failures(&self) -> &[Failure] {
        &self.stepper.failures
    }

    /// Returns whether the island of a cable took its last step by the discrete gradient, or the
    /// cable is to do so if it was not stepped: an island has one integrator, which need not be
    /// that of each of its cables.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn steps_by_discrete_gradient(&self, cable: CableHandle) -> Result<bool, Error> {
        let slot = self.contents.cables.get(cable.0 as usize).ok_or(Error::NoCable(cable))?;
        Ok(slot.by_law.unwrap_or_else(|| slot.cable.integrator().method.uses_discrete_gradients()))
    }

    /// Returns the linear momentum (kg m/s) and the angular momentum about the origin (kg m^2/s) of
    /// all cables and enabled dynamic bodies.
    ///
    /// # Errors
    /// [`Error::BodyNotFinite`].
    pub fn momentum(&self, world: &PhysicsWorld) -> Result<Momentum, Error> {
        totals::momentum(&self.contents, world)
    }

    /// Returns the energy of all cables and enabled dynamic bodies.
    ///
    /// # Errors
    /// [`Error::BodyNotFinite`].
    pub fn energy(&self, world: &PhysicsWorld) -> Result<WorldEnergy, Error> {
        totals::energy(&self.contents, world)
    }

    /// Returns the warnings about all cables: those that the cables have
    /// ([`Cable::warnings`](lariat_ancf::Cable::warnings)), places inside colliders, restitution
    /// beyond what impacts of cables have, gaps, and attachments that start with a shock. They are
    /// sorted by [`Level`](lariat_ancf::Level), up to that of
    /// [`Settings::warn_level`](crate::Settings::warn_level); what follows from one that is told is
    /// left out. Worth a look when a world has been built.
    pub fn warnings(&self, world: &PhysicsWorld) -> Vec<Warning> {
        warnings::told(&self.contents, world, self.settings.warn_level)
    }

    /// Returns the gap of an attachment if it is longer than 2e-3 of the length of its cable: the
    /// largest since the two sides met, or if they did not, the least.
    ///
    /// # Errors
    /// [`Error::NoAttachment`].
    pub fn open_gap(&self, attachment: AttachmentHandle) -> Result<Option<OpenGap>, Error> {
        warnings::open_gap(&self.contents, attachment)
    }

    /// Returns the worst half second in which the body of an attachment, one that joints hold, did
    /// not move as predicted, if there was one: its cables' forces are then not to be trusted.
    ///
    /// # Errors
    /// [`Error::NoAttachment`].
    pub fn unsettled(&self, attachment: AttachmentHandle) -> Result<Option<Unsettled>, Error> {
        warnings::unsettled(&self.contents, attachment)
    }

    /// Draws all cables and the forces of their contacts with Rapier's debug renderer, as lines of
    /// a body with an invalid handle.
    #[cfg(feature = "debug-render")]
    pub fn draw(&self, backend: &mut impl DebugRenderBackend, style: &DrawStyle) {
        draw::draw(self.iter().map(|(_, cable)| cable), backend, style);
    }
}
