//! An island: cables that are connected, and what connects them.

use super::member::Member;
use super::wheels::Wheels;
use crate::contents::Contents;
use crate::error::{Error, Failure};
use crate::handle::CableHandle;
use lariat_ancf::contact::CablePair;
use lariat_ancf::island::PinConstraint;
use rapier::dynamics::RigidBodyHandle;

/// Cables that are connected, and what connects them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Island {
    /// Indices of its cables.
    pub cables: Vec<usize>,
    pub members: Vec<Member>,
    /// Pins, with indices into the two lists above.
    pub pins: Vec<PinConstraint>,
    /// By pin, the index of its attachment; `None` at a junction.
    pub attachments: Vec<Option<usize>>,
    /// Attachments whose nodes have a prescribed position.
    pub supports: Vec<usize>,
    pub wheels: Wheels,
    /// Those of its cables that may touch each other, with indices into the first list.
    pub pairs: Vec<CablePair>,
}

impl Island {
    /// Adds the cables and members of another.
    pub fn join(&mut self, other: Island) {
        let (cables, members) = (self.cables.len(), self.members.len());
        let shift = |mut pin: PinConstraint| {
            (pin.cable, pin.body) = (pin.cable + cables, pin.body + members);
            pin
        };
        self.pins.extend(other.pins.into_iter().map(shift));
        self.wheels.join(other.wheels, cables, members);
        let shift = |pair: CablePair| CablePair { cables: pair.cables.map(|c| c + cables), ..pair };
        self.pairs.extend(other.pairs.into_iter().map(shift));
        self.cables.extend(other.cables);
        self.members.extend(other.members);
        self.attachments.extend(other.attachments);
        self.supports.extend(other.supports);
    }

    /// Returns whether nothing connects its cables.
    pub fn is_loose(&self) -> bool {
        self.members.is_empty() && self.wheels.is_empty() && self.pairs.is_empty()
    }

    /// Returns the handles of its integrated bodies.
    pub fn bodies(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.members.iter().filter_map(Member::body)
    }

    /// Returns that it could not step, with the names of its cables and their time.
    pub fn failure(&self, contents: &Contents, cause: Error) -> Failure {
        let slots = || self.cables.iter().filter_map(|&c| contents.cables.get(c));
        let cables = slots().map(|slot| slot.cable.name().to_string()).collect();
        let time = slots().next().map_or(0.0, |slot| slot.cable.time());
        let error = Error::StepRefused { cables, time, cause: Box::new(cause) };
        Failure { cables: self.cables.iter().map(|&c| CableHandle(c as u32)).collect(), error }
    }

    /// Returns the indices of the pins on a member.
    pub fn pins_on(&self, member: usize) -> impl Iterator<Item = usize> {
        self.pins.iter().enumerate().filter(move |(_, p)| p.body == member).map(|(i, _)| i)
    }
}
