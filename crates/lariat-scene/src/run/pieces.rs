//! The parts that the cables of a scene have become.

use lariat_ancf::Break;
use serde::{Deserialize, Serialize};

/// A part of a cable of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Position of the cable in the scene's list.
    pub cable: usize,
    /// Arc length in m of its start on that cable.
    pub from: f64,
}

/// A cable that became two, in `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parted {
    /// Name of the cable.
    pub cable: String,
    /// Time in s.
    pub time_s: f64,
    /// `tension`, `strain` or `cut`.
    pub cause: String,
    /// Arc length in m on the cable as the scene has it.
    pub arc_length_m: f64,
    /// Largest tension in N just before; of a cut, the tension there.
    pub tension_n: f64,
    /// Strain there.
    pub strain: f64,
    /// Strain energy in J of both parts at the break.
    pub strain_energy_j: f64,
    /// Change of the total energy in J by the edit itself.
    pub inserted_energy_j: f64,
}

impl Parted {
    /// Describes a break of a piece of the cable of this name.
    pub fn new(name: &str, piece: &Piece, time: f64, how: &Break) -> Self {
        Parted {
            cable: name.to_string(),
            time_s: time,
            cause: how.cause.name().to_string(),
            arc_length_m: piece.from + how.arc_length,
            tension_n: how.tension,
            strain: how.strain,
            strain_energy_j: how.strain_energy,
            inserted_energy_j: how.inserted_energy,
        }
    }
}
