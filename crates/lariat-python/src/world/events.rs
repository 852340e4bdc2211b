//! What a world says: events, warnings, what statics moved, and contacts of cables with each other.

use super::{Contents, World};
use crate::cable::Cable;
use crate::convert::{result, vector};
use crate::error::raise;
use lariat_ancf::warning::Interface;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{CableHandle, Event, Warning};
use pyo3::prelude::*;

impl Contents {
    /// Returns the lines to tell of a world before its first step.
    pub(super) fn of_start(&mut self) -> Vec<String> {
        let warnings = if self.time == 0.0 { self.set.warnings(&self.world) } else { Vec::new() };
        warnings.into_iter().filter_map(|warning| self.first_of_kind(&warning)).collect()
    }

    /// Returns the lines to tell of the last step.
    pub(super) fn of_events(&mut self) -> Vec<String> {
        let name = |attachment| {
            let cable = self.set.attachment(attachment).ok()?.cable();
            Some(self.set.get(cable).ok()?.name().to_string())
        };
        let warning = |event: &Event| match *event {
            Event::Warning { cable, ref warning } => Some(Warning::Cable { cable, warning: warning.clone() }),
            Event::GapOpened { attachment, gap } => Some(Warning::OpenGap { attachment, name: name(attachment)?, gap }),
            Event::Unsettled { attachment, how } => {
                Some(Warning::Unsettled { attachment, name: name(attachment)?, how })
            }
            _ => None,
        };
        let warnings: Vec<_> = self.set.events().iter().filter_map(warning).collect();
        warnings.into_iter().filter_map(|warning| self.first_of_kind(&warning)).collect()
    }

    /// Returns the text of a warning, unless one of its kind was told.
    fn first_of_kind(&mut self, warning: &Warning) -> Option<String> {
        self.told.is_first(warning.name()).then(|| Interface::Python.text(warning))
    }
}

#[pymethods]
impl World {
    /// Returns the events of the last step.
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let events = self.0.with(py, |contents| contents.set.events().to_vec());
        events.into_iter().map(|event| self.event(py, event)).collect()
    }

    /// Returns what all cables say about their mesh, steps, energy, law and sizes, and about
    /// colliders that they are in or do not bounce off. Worth a look when a world has been built.
    fn warnings(&self, py: Python<'_>) -> Vec<String> {
        let warnings = self.0.compute(py, |contents| contents.set.warnings(&contents.world));
        warnings.iter().map(|warning| Interface::Python.text(warning)).collect()
    }

    /// Moves cables and the bodies on them, as their joints allow, to static equilibrium; true if
    /// all is stable. Cables with contact lie on fixed and kinematic colliders, without friction;
    /// where bodies touch others or would fall on them, or cables touch each other, themselves or
    /// bodies that they move, all comes to rest by its motion, from where it is drawn. Raises
    /// NoEquilibriumError, JointInStaticsError, CableTouchesInStaticsError, and, where not all
    /// comes to rest, NotHeldInStaticsError, ContactInStaticsError, CablesPassInStaticsError,
    /// CablePassesBodyInStaticsError, MovesInStaticsError; all is then as before.
    fn equilibrium<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let found = self.0.compute(py, |contents| contents.set.equilibrium(&mut contents.world)).map_err(raise)?;
        let handles = |bodies: &[RigidBodyHandle]| -> PyResult<Vec<Bound<'py, PyAny>>> {
            bodies.iter().map(|body| result(py, "RigidBodyHandle", body.into_raw_parts())).collect()
        };
        let bodies = (handles(&found.moved)?, handles(&found.held)?, handles(&found.unattached)?);
        result(py, "WorldEquilibrium", (found.is_stable(), bodies.0, bodies.1, bodies.2))
    }

    /// Returns what a cable touched of others and of itself at the end of the last step, if its
    /// contact says that it may. Raises NoCableError.
    fn cable_contacts<'py>(&self, py: Python<'py>, cable: &Cable) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let handle = cable.handle_in(&self.0)?;
        let touches = self.0.with(py, |contents| contents.set.cable_contacts(handle)).map_err(raise)?;
        let made = touches.into_iter().map(|(other, touch)| {
            let (normal, friction) = (vector(py, &touch.normal), vector(py, &touch.friction));
            let places = (touch.arc_length, touch.other_arc_length);
            let values =
                (self.cable(other), places.0, places.1, normal, touch.normal_force, friction, touch.depth, touch.slips);
            result(py, "CableTouch", values)
        });
        made.collect()
    }
}

impl World {
    /// Returns a cable of this world.
    pub(super) fn cable(&self, handle: CableHandle) -> Cable {
        Cable::of_world(self.0.clone(), handle)
    }

    fn event<'py>(&self, py: Python<'py>, event: Event) -> PyResult<Bound<'py, PyAny>> {
        let (mut rest, mut arc_length, mut tension, mut force) = (None, None, None, None);
        let mut collider = None;
        let (kind, cable) = match event {
            Event::Asleep(cable) => ("asleep".to_string(), Some(cable)),
            Event::Awake(cable) => ("awake".to_string(), Some(cable)),
            Event::Degraded { cable, .. } => ("degraded".to_string(), Some(cable)),
            Event::Broken { cable, rest: behind, how } => {
                (rest, arc_length, tension) = (Some(self.cable(behind)), Some(how.arc_length), Some(how.tension));
                ("broken".to_string(), Some(cable))
            }
            Event::ContactStarted { cable, collider: other, arc_length: s, force: normal } => {
                (collider, arc_length, force) = (Some(other), Some(s), Some(normal));
                ("contact started".to_string(), Some(cable))
            }
            Event::ContactEnded { cable, collider: other, arc_length: s } => {
                (collider, arc_length) = (Some(other), Some(s));
                ("contact ended".to_string(), Some(cable))
            }
            Event::ContactIgnored { cable, collider: other } => {
                collider = Some(other);
                ("contact ignored".to_string(), Some(cable))
            }
            Event::AttachmentEnded { .. } => ("attachment ended".to_string(), None),
            Event::GapOpened { attachment, gap } => {
                let cable = self.0.with(py, |contents| contents.set.attachment(attachment).map(|a| a.cable()).ok());
                (format!("gap opened: {:.1e} m at {:.4} s", gap.gap, gap.time), cable)
            }
            Event::Unsettled { attachment, how } => {
                let cable = self.0.with(py, |contents| contents.set.attachment(attachment).map(|a| a.cable()).ok());
                (format!("unsettled: the joints of the body did not hold it, {}", how.text()), cable)
            }
            Event::Warning { cable, warning } => {
                (format!("warning: {}", Interface::Python.text(&warning)), Some(cable))
            }
            other => (format!("{other:?}"), None),
        };
        let collider = collider.map(|c| result(py, "ColliderHandle", c.into_raw_parts())).transpose()?;
        result(py, "Event", (kind, cable.map(|c| self.cable(c)), rest, arc_length, tension, collider, force))
    }
}
