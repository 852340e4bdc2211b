//! What a cable can touch, and what it touches.

use super::Cable;
use crate::contact::{PairTouch, Touch};
use crate::error::Error;
use crate::obstacle::Obstacle;
use crate::state::PairMemory;
use crate::watch::{Passage, Through};

impl Cable {
    /// Returns the obstacles, by ascending key.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.model.obstacles.0
    }

    /// Sets what the cable can touch from the next step on, in place of the obstacles it had; it
    /// touches them if it has the effect [`Contact`](crate::Contact). Cheap enough for every step,
    /// and allocates only for more obstacles than ever before. Obstacles are no part of a snapshot
    /// or of a serialised cable, whose contacts know them by their keys.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a number out of range, [`Error::ObstacleKey`] for a key that two
    /// share; the obstacles are then as before.
    pub fn set_obstacles(&mut self, obstacles: impl IntoIterator<Item = Obstacle>) -> Result<(), Error> {
        let own = &mut self.model.obstacles.0;
        let before = own.len();
        own.extend(obstacles);
        own[before..].sort_unstable_by_key(|obstacle| obstacle.key);
        let twice = own[before..].windows(2).find(|pair| pair[0].key == pair[1].key).map(|pair| pair[0].key);
        let checked = own[before..].iter().try_for_each(Obstacle::check);
        let outcome = match twice {
            Some(key) => Err(Error::ObstacleKey { cable: self.model.name.clone(), key }),
            None => checked.map_err(|e| e.of_cable(&self.model.name)),
        };
        let (time, mut is_new) = (self.time(), false);
        let own = &mut self.model.obstacles.0;
        match outcome {
            Ok(()) => {
                let (old, new) = own.split_at(before);
                let is_known = |o: &Obstacle| old.binary_search_by_key(&o.key, |old| old.key).is_ok();
                is_new = self.watch.is_some() && self.model.contact_key == 0 && !new.iter().all(is_known);
                let posed = new.iter().find_map(|obstacle| obstacle.posed(old, time));
                self.posed = posed.map(|(key, distance)| (time, key, distance));
                drop(own.drain(..before));
            }
            Err(_) => own.truncate(before),
        }
        if is_new {
            self.note_inside();
        }
        outcome
    }

    /// Counts a step in which it passed through something at an arc length in m; the first one is
    /// remembered.
    pub(crate) fn count_passage(&mut self, arc_length_m: f64, through: Through) {
        if self.diagnostics.crossed_steps == 0 {
            self.passage = Some(Box::new(Passage { time_s: self.time(), arc_length_m, through }));
        }
        self.diagnostics.crossed_steps += 1;
    }

    /// Returns the contacts with obstacles at the end of the last step, by element.
    pub fn contacts(&self) -> impl Iterator<Item = Touch> {
        let (mut element, mut begin) = (0, 0.0);
        self.snapshot.state.memory.contacts.iter().map(move |contact| {
            while element < contact.element as usize {
                begin += self.model.elements[element].length;
                element += 1;
            }
            Touch {
                obstacle: contact.obstacle,
                arc_length: begin + contact.xi * self.model.elements[element].length,
                normal: contact.direction,
                normal_force: contact.force,
                friction: contact.friction,
                depth: contact.depth + contact.offset,
                slips: contact.slips,
            }
        })
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn contact_radius(&self) -> f64 {
        let Some(contact) = self.effects().contact else { return 0.0 };
        self.elements().iter().fold(0.0, |most: f64, element| most.max(contact.radius_of(&element.section)))
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn contact_energy(&self) -> f64 {
        let memory = &self.snapshot.state.memory;
        let pairs = memory.pairs.iter().map(PairMemory::energy);
        memory.contacts.iter().map(|contact| contact.energy).chain(pairs).sum()
    }

    /// Returns the contacts with other cables and with itself at the end of the last step. A
    /// contact of two cables is with the one of the lower key.
    pub fn cable_contacts(&self) -> impl Iterator<Item = PairTouch> {
        let now = self.snapshot.passed_at_start();
        self.snapshot.state.memory.pairs.iter().map(move |PairMemory { contact, arcs, passed }| PairTouch {
            other: contact.obstacle,
            arc_length: arcs[0] + (now - passed[0]),
            other_arc_length: arcs[1],
            normal: contact.direction,
            normal_force: contact.force,
            friction: contact.friction,
            depth: contact.depth + contact.offset,
            slips: contact.slips,
        })
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn contact_key(&self) -> u64 {
        self.model.contact_key
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn set_contact_key(&mut self, key: u64) {
        self.model.contact_key = key;
    }
}
