//! Adding and ending sheaves, and keeping them with the end of a cable that is cut.

use super::beyond;
use crate::contents::Contents;
use crate::contents::reel::sheave::{Sheave, SheaveOptions};
use crate::error::Error;
use crate::handle::{CableHandle, SheaveHandle};
use lariat_ancf::island::Sheave as Wheel;
use lariat_ancf::{At, Reel};

/// Lets one cable run into another.
pub(crate) fn add(
    contents: &mut Contents,
    from: (CableHandle, At),
    to: (CableHandle, At),
    options: SheaveOptions,
) -> Result<SheaveHandle, Error> {
    let ends = [(from.0, contents.is_start(from.0, from.1)?), (to.0, contents.is_start(to.0, to.1)?)];
    let mut wheel = Wheel::new((0, At::End), (0, At::Start));
    let SheaveOptions { inertia, friction, turns, brake, radius, along } = options;
    (wheel.inertia, wheel.friction, wheel.turns, wheel.brake) = (inertia, friction, turns, brake);
    wheel.radius = radius;
    wheel.check()?;
    for (i, (cable, at)) in [from, to].into_iter().enumerate() {
        if let Err(error) = contents.cable_mut(cable)?.add_reel(at, Reel::over_sheave()) {
            if i == 1 {
                contents.cable_mut(from.0)?.remove_reel(from.1)?;
            }
            return Err(error.into());
        }
    }
    contents.changed = true;
    let sheave = SheaveHandle(contents.wheels.sheaves.push(Sheave { ends, wheel, along }) as u32);
    beyond::count(contents);
    Ok(sheave)
}

/// Ends a sheave: what is on its sides stays there.
pub(crate) fn remove(contents: &mut Contents, sheave: SheaveHandle) -> Result<(), Error> {
    let removed = contents.wheels.sheaves.remove(sheave.0 as usize).ok_or(Error::NoSheave(sheave))?;
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
    for i in 0..contents.wheels.sheaves.len() {
        let is_there = |(c, s): &(CableHandle, bool)| *c == cable && start.is_none_or(|start| start == *s);
        if contents.wheels.sheaves.get(i).is_some_and(|sheave| sheave.ends.iter().any(is_there)) {
            remove(contents, SheaveHandle(i as u32))?;
        }
    }
    Ok(())
}

/// Gives the sheave at the end of a cable that was cut to the part behind the cut.
pub(crate) fn follow_cut(contents: &mut Contents, cable: CableHandle, tail: CableHandle) {
    for (of, start) in contents.wheels.sheaves.values_mut().flat_map(|sheave| &mut sheave.ends) {
        if *of == cable && !*start {
            *of = tail;
        }
    }
}
