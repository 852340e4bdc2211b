//! The sheaves and drums of an island.

use super::member::Member;
use crate::contents::Contents;
use lariat_ancf::island::{Drum, Sheave};

/// Those of one island, with indices into its lists.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wheels {
    /// Indices of its sheaves among those of the set.
    pub sheaves: Vec<usize>,
    pub drums: Vec<Drum>,
}

impl Wheels {
    /// Returns the sheaves and drums of the cables of an island, and adds the bodies that are drums
    /// to its members.
    pub fn of(contents: &Contents, cables: &[usize], members: &mut Vec<Member>) -> Wheels {
        let mut wheels = Wheels::default();
        let sheaves = contents.wheels.sheaves.iter();
        wheels.sheaves = sheaves.filter(|(_, sheave)| sheave.within(cables).is_some()).map(|(i, _)| i).collect();
        for wound in contents.wheels.drums.iter().filter(|wound| cables.contains(&(wound.cable.0 as usize))) {
            let member = Member::Body(wound.drum.body);
            let body = members.iter().position(|m| *m == member).unwrap_or_else(|| {
                members.push(member);
                members.len() - 1
            });
            wheels.drums.extend(wound.within(cables, body));
        }
        wheels
    }

    pub fn is_empty(&self) -> bool {
        self.sheaves.is_empty() && self.drums.is_empty()
    }

    /// Adds those of another island, whose cables and members come behind so many.
    pub fn join(&mut self, other: Wheels, cables: usize, members: usize) {
        let shift = |drum: Drum| {
            let ((cable, start), body) = (drum.cable, drum.body);
            Drum { cable: (cable + cables, start), body: body + members, ..drum }
        };
        self.drums.extend(other.drums.into_iter().map(shift));
        self.sheaves.extend(other.sheaves);
    }

    /// Returns its sheaves for a step, as they are.
    pub fn over<'a>(&'a self, contents: &'a Contents, cables: &'a [usize]) -> impl Iterator<Item = Sheave> + 'a {
        self.sheaves.iter().filter_map(|&i| contents.wheels.sheaves.get(i)?.within(cables))
    }

    /// Keeps what its sheaves did in a step.
    pub fn keep(&self, contents: &mut Contents, stepped: &[Sheave]) {
        for (&i, wheel) in self.sheaves.iter().zip(stepped) {
            contents.wheels.sheaves.get_mut(i).into_iter().for_each(|sheave| sheave.wheel = *wheel);
        }
    }
}
