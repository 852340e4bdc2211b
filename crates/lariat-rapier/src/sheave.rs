//! Sheaves of a set: one cable runs into another where both are attached.

use crate::contents::Contents;
use crate::error::Error;
use crate::handle::{CableHandle, SheaveHandle};
use crate::set::CableSet;
use lariat_ancf::island::Sheave as Wheel;
use lariat_ancf::{At, Reel};
use serde::{Deserialize, Serialize};

/// A sheave: inertia, friction, brake.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SheaveOptions {
    /// Inertia of the wheel over the square of its radius in kg. Default 0.
    pub inertia: f64,
    /// Coefficient of friction of the rope on the wheel: tensions differ by up to exp(friction angle). Default 0.
    pub friction: f64,
    /// Angle in rad beyond that between the directions of both cables, by which the rope is wound around the wheel. Default 0.
    pub turns: f64,
    /// Constant friction in N. Default 0.
    pub brake: f64,
    /// Radius of the wheel in m: both ends are within it of one centre, as points of one body. Default 0, where they are one point.
    pub radius: f64,
}

/// A sheave of a [`CableSet`](crate::CableSet), and what it did so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Sheave {
    /// Cables, and whether they are there with their start: material runs from the first to the second at positive rates.
    pub(crate) ends: [(CableHandle, bool); 2],
    /// The mechanics, with the indices of another set of cables.
    pub(crate) wheel: Wheel,
    /// Whether both are parts of one cable.
    #[serde(default)]
    pub(crate) along: bool,
}

/// Returns the end of a cable.
fn end(start: bool) -> At {
    if start { At::Start } else { At::End }
}

impl Sheave {
    /// Returns the cables and their ends there; material runs from the first to the second at positive rates.
    pub fn ends(&self) -> [(CableHandle, At); 2] {
        self.ends.map(|(cable, start)| (cable, end(start)))
    }

    /// Returns whether both ends are [parts of one cable](crate::CableSet::add_sheave_at).
    pub fn is_along_a_cable(&self) -> bool {
        self.along
    }

    /// Returns the length in m that ran over it so far.
    pub fn passed(&self) -> f64 {
        self.wheel.passed
    }

    /// Returns the energy in J that friction took so far.
    pub fn lost(&self) -> f64 {
        self.wheel.lost
    }

    /// Returns the friction in N in the last step: what the pull on one side exceeds that on the other by, but for inertia.
    pub fn force(&self) -> f64 {
        self.wheel.force
    }

    /// Returns the sheave for an island with these cables; `None` if it has not both.
    pub(crate) fn within(&self, cables: &[usize]) -> Option<Wheel> {
        let [from, to] = self
            .ends
            .map(|(cable, start)| cables.iter().position(|&c| c == cable.0 as usize).map(|index| (index, start)));
        Some(Wheel { from: from?, to: to?, ..self.wheel })
    }
}

impl CableSet {
    /// Lets a cable run into another over a sheave: `from` and `to` are ends of cables that are attached at one point, to a body or to the
    /// world. Both need the integrator `discrete-gradient`, and one mass per length. The sheave ends with one of the attachments.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::Cable`] for a point that is not an end, an end with a reel, or an effect that does not go with one. What
    /// makes no sheave beyond that is an error of the next step.
    pub fn add_sheave(
        &mut self,
        from: (CableHandle, impl Into<At>),
        to: (CableHandle, impl Into<At>),
        options: SheaveOptions,
    ) -> Result<SheaveHandle, Error> {
        add(&mut self.contents, (from.0, from.1.into()), (to.0, to.1.into()), options)
    }

    /// Ends a sheave: what is on its sides stays there, and nothing runs over it any more.
    ///
    /// # Errors
    /// [`Error::NoSheave`].
    pub fn remove_sheave(&mut self, sheave: SheaveHandle) -> Result<(), Error> {
        remove(&mut self.contents, sheave)
    }

    /// Returns a sheave.
    ///
    /// # Errors
    /// [`Error::NoSheave`].
    pub fn sheave(&self, sheave: SheaveHandle) -> Result<&Sheave, Error> {
        self.contents.sheaves.get(sheave.0 as usize).ok_or(Error::NoSheave(sheave))
    }
}

/// Lets one cable run into another.
pub(crate) fn add(
    contents: &mut Contents,
    from: (CableHandle, At),
    to: (CableHandle, At),
    options: SheaveOptions,
) -> Result<SheaveHandle, Error> {
    let ends = [from, to].map(|(cable, at)| (cable, at == At::Start));
    for (i, (cable, at)) in [from, to].into_iter().enumerate() {
        if let Err(error) = contents.cable_mut(cable)?.add_reel(at, Reel::over_sheave()) {
            if i == 1 {
                contents.cable_mut(from.0)?.remove_reel(from.1)?;
            }
            return Err(error.into());
        }
    }
    let mut wheel = Wheel::new((0, At::End), (0, At::Start));
    let SheaveOptions { inertia, friction, turns, brake, radius } = options;
    (wheel.inertia, wheel.friction, wheel.turns, wheel.brake) = (inertia, friction, turns, brake);
    wheel.radius = radius;
    contents.changed = true;
    Ok(SheaveHandle(contents.sheaves.push(Sheave { ends, wheel, along: false }) as u32))
}

/// Ends a sheave: what is on its sides stays there.
fn remove(contents: &mut Contents, sheave: SheaveHandle) -> Result<(), Error> {
    let removed = contents.sheaves.remove(sheave.0 as usize).ok_or(Error::NoSheave(sheave))?;
    contents.changed = true;
    for (cable, at) in removed.ends() {
        if let Ok(cable) = contents.cable_mut(cable) {
            cable.remove_reel(at)?;
        }
    }
    Ok(())
}

/// Ends the sheaves at an end of a cable, or at both.
pub(crate) fn remove_at(contents: &mut Contents, cable: CableHandle, start: Option<bool>) -> Result<(), Error> {
    for i in 0..contents.sheaves.len() {
        let is_there = |(c, s): &(CableHandle, bool)| *c == cable && start.is_none_or(|start| start == *s);
        if contents.sheaves.get(i).is_some_and(|sheave| sheave.ends.iter().any(is_there)) {
            remove(contents, SheaveHandle(i as u32))?;
        }
    }
    Ok(())
}

/// Gives the sheave at the end of a cable that was cut to the part behind the cut.
pub(crate) fn follow_cut(contents: &mut Contents, cable: CableHandle, tail: CableHandle) {
    for (of, start) in contents.sheaves.values_mut().flat_map(|sheave| &mut sheave.ends) {
        if *of == cable && !*start {
            *of = tail;
        }
    }
}
