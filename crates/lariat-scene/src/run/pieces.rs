//! The parts that the cables of a scene have become.

use super::World;
use lariat_ancf::Break;
use lariat_ancf::coupling::Coupling;
use serde::{Deserialize, Serialize};

/// A part of a cable of the file: what a break or a sheave left of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Position of the cable in the file.
    pub cable: usize,
    /// Arc length in m, on that cable at t = 0, of the material that is at its start now; below 0 is what came through an eye there.
    pub from: f64,
}

/// A cable that became two, in `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Parted {
    /// Name of the cable.
    pub cable: String,
    /// Time in s.
    pub time_s: f64,
    /// `tension`, `strain` or `cut`.
    pub cause: String,
    /// Arc length in m on the cable as the scene has it.
    pub arc_length_m: f64,
    /// Time in s of the load, within the last host step.
    #[serde(default)]
    pub load_time_s: f64,
    /// Largest elastic tension in N in the last host step; of a cut, the whole tension there.
    pub tension_n: f64,
    /// Tension of damping in N beside it, which does not count.
    #[serde(default)]
    pub damping_tension_n: f64,
    /// Strain there.
    pub strain: f64,
    /// Strain energy in J of both parts at the break.
    pub strain_energy_j: f64,
    /// Change of the total energy in J by the edit itself.
    pub inserted_energy_j: f64,
    /// Breaks by loads, one after another, that made the parts, this one included.
    #[serde(default)]
    pub breaks: u32,
}

impl Parted {
    /// Describes a break of a piece, which begins at an arc length (m), of the cable of this name.
    fn new(name: &str, from: f64, time: f64, how: &Break) -> Self {
        Parted {
            cable: name.to_string(),
            time_s: time,
            cause: how.cause.name().to_string(),
            arc_length_m: from + how.arc_length,
            load_time_s: how.time,
            tension_n: how.tension,
            damping_tension_n: how.damping,
            strain: how.strain,
            strain_energy_j: how.strain_energy,
            inserted_energy_j: how.inserted_energy,
            breaks: how.breaks,
        }
    }
}

impl World {
    /// Returns what each of the [cables](Self::cables) is part of.
    pub fn pieces(&self) -> Vec<Piece> {
        let mut pieces = vec![Piece { cable: 0, from: 0.0 }; self.owners.len()];
        for cable in 0..self.order.len() {
            for (part, from, _) in self.spans(cable) {
                pieces[part] = Piece { cable, from };
            }
        }
        pieces
    }

    /// Returns the parts of a cable of the file along it, with the arc lengths of the material at their start and at their end.
    fn spans(&self, cable: usize) -> Vec<(usize, f64, f64)> {
        let cables = self.cables();
        // what came through an eye at the start is before all other material
        let mut from = if self.scene.eyes(cable)[0] { -cables[cable].length_from_start() } else { 0.0 };
        let span = |&part: &usize| {
            from += self.scene.cables.get(part).map_or(0.0, |own| own.lead);
            let start = from;
            from += cables[part].length();
            (part, start, from)
        };
        self.order[cable].iter().map(span).collect()
    }

    /// Returns the position in [`cables`](Self::cables) of the part of a cable of the file that holds the material at an arc length (m) at
    /// t = 0, and the arc length on it. A break and a sheave belong to the part before them; what a reel has taken in is at its eye, and so
    /// is its end.
    pub fn part(&self, cable: usize, arc_length: f64) -> (usize, f64) {
        let spans = self.spans(cable);
        let (length, last) = (self.scene.whole_length(cable), spans.len() - 1);
        let slack = 1e-9 * length;
        let at_end = self.scene.parts[cable].last().is_some_and(|&part| self.scene.eyes(part)[1]);
        if arc_length <= slack {
            return (spans[0].0, 0.0);
        }
        let arc_length = if at_end && arc_length >= length - slack { f64::INFINITY } else { arc_length };
        let holds = |k: &usize| arc_length <= spans[*k].2 + slack || *k == last;
        let k = (0..=last).find(holds).unwrap_or(last);
        let (part, from, to) = spans[k];
        match k.checked_sub(1) {
            // on a wheel
            Some(before) if arc_length < from - slack => (spans[before].0, spans[before].2 - spans[before].1),
            _ => (part, (arc_length - from).clamp(0.0, to - from)),
        }
    }

    /// Returns the part that holds a point of a part of the scene, and the arc length on it.
    pub(super) fn part_of(&self, part: usize, arc_length: f64) -> (usize, f64) {
        self.part(self.scene.whole(part), self.scene.along(part, arc_length))
    }

    /// Notes that a cable became two; the rest is the last of all cables.
    pub(super) fn note_break(&mut self, part: usize, how: &Break) {
        let owner = self.owners[part];
        let rest = self.owners.len();
        let place = self.order[owner].iter().position(|&other| other == part).map_or(0, |k| k + 1);
        self.order[owner].insert(place, rest);
        self.owners.push(owner);
        let from = self.pieces()[part].from;
        self.breaks.push(Parted::new(&self.scene.cables[owner].name, from, self.time(), how));
    }
}
