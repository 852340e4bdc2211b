//! The state of a mechanical system between two steps: positions, velocities, and what a method
//! carries from step to step.

mod contact;
mod differences;
mod pace;
mod torsion;

pub use contact::{ContactMemory, PairMemory};
pub(crate) use contact::{Key, renumber};
pub use differences::Differences;
pub use pace::Pace;
pub use torsion::SegmentTwist;

use crate::error::{Error, require};
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// What a method carries from step to step, besides positions and velocities. Plain data, part of a
/// snapshot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Acceleration at the present state, if `valid`.
    pub acceleration: Vec<f64>,
    /// Algorithmic acceleration of a method that [has
    /// one](crate::integrate::OneStep::has_algorithmic_acceleration), as generalised-alpha; else
    /// empty.
    pub algorithmic: Vec<f64>,
    /// Whether the accelerations belong to the present state.
    pub valid: bool,
    /// Revision of the system's description that the accelerations belong to: every change of
    /// supports, loads or method makes another.
    #[serde(default)]
    pub revision: u64,
    /// Length in s that error control proposes for the next step; 0 = no proposal.
    pub step: f64,
    /// Coherence of the errors of the last host step, 0 to 1; see
    /// [`error_budget`](crate::integrate::error_budget).
    #[serde(default = "coherent")]
    pub coherence: f64,
    /// Spurious energy in J on the account of the [check](crate::integrate::energy_check).
    #[serde(default)]
    pub energy_made: f64,
    /// Largest kinetic and strain energy in J so far, for that check.
    #[serde(default)]
    pub largest_energy: f64,
    /// The last step of the discrete gradient.
    #[serde(default)]
    pub differences: Differences,
    /// Power in W that contacts with obstacles took in the last step of the discrete gradient.
    #[serde(default)]
    pub lost: f64,
    /// Power in W that damping took in that step.
    #[serde(default)]
    pub damped: f64,
    /// Contacts at the end of the last step of the discrete gradient.
    #[serde(default)]
    pub contacts: Vec<ContactMemory>,
    /// Contacts with other cables and with itself, likewise.
    #[serde(default)]
    pub pairs: Vec<PairMemory>,
    /// Twists of a cable with torsion, by segment; `None` until they are known.
    #[serde(default)]
    pub torsion: Option<Vec<SegmentTwist>>,
    /// Least axial damping time in s that the accelerations were computed with; see
    /// [`Cable::set_least_damping`](crate::coupling::Coupling::set_least_damping).
    #[serde(default)]
    pub least_damping: f64,
    /// By free span, the largest compressive strain at which it was bent last, straight as it was;
    /// zero since it was under tension, or never bent.
    #[serde(default)]
    pub bent_at: Vec<f64>,
    /// How many steps host steps took by the discrete gradient.
    #[serde(default)]
    pub pace: Pace,
}

fn coherent() -> f64 {
    1.0
}

impl Default for Memory {
    fn default() -> Self {
        Memory {
            acceleration: Vec::new(),
            algorithmic: Vec::new(),
            valid: false,
            revision: 0,
            step: 0.0,
            coherence: coherent(),
            energy_made: 0.0,
            largest_energy: 0.0,
            differences: Differences::default(),
            lost: 0.0,
            damped: 0.0,
            contacts: Vec::new(),
            pairs: Vec::new(),
            torsion: None,
            least_damping: 0.0,
            bent_at: Vec::new(),
            pace: Pace::default(),
        }
    }
}

/// Positions, velocities and method memory at a time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time in s.
    pub time: f64,
    /// Positions: flat (r, t) by node, m and 1.
    pub q: Vec<f64>,
    /// Velocities: flat (r', t') by node, m/s and 1/s.
    pub v: Vec<f64>,
    /// Memory of the method.
    pub memory: Memory,
}

impl State {
    /// Copies `other` into the existing buffers; the derived `clone_from` would allocate new ones.
    pub(crate) fn copy_from(&mut self, other: &State) {
        let State { time, q, v, memory } = other;
        let Memory {
            acceleration,
            algorithmic,
            valid,
            step,
            coherence,
            revision,
            energy_made,
            largest_energy,
            differences,
            lost,
            damped,
            contacts,
            pairs,
            torsion,
            least_damping,
            bent_at,
            pace,
        } = memory;
        self.time = *time;
        self.q.clone_from(q);
        self.v.clone_from(v);
        self.memory.revision = *revision;
        self.memory.acceleration.clone_from(acceleration);
        self.memory.algorithmic.clone_from(algorithmic);
        self.memory.valid = *valid;
        self.memory.step = *step;
        self.memory.coherence = *coherence;
        self.memory.energy_made = *energy_made;
        self.memory.largest_energy = *largest_energy;
        self.memory.differences.copy_from(differences);
        self.memory.lost = *lost;
        self.memory.damped = *damped;
        self.memory.contacts.clone_from(contacts);
        self.memory.pairs.clone_from(pairs);
        self.memory.torsion.clone_from(torsion);
        self.memory.least_damping = *least_damping;
        self.memory.bent_at.clone_from(bent_at);
        self.memory.pace = *pace;
    }

    /// Moves the state rigidly: turned about the origin, then displaced by `by` (m). What the
    /// method carries turns with it; contacts, which are at other places then, are forgotten.
    pub(crate) fn move_by(&mut self, turn: &UnitQuaternion<f64>, by: &Vector3<f64>) {
        let turned = |x: &mut [f64]| {
            for x in x.chunks_exact_mut(3) {
                x.copy_from_slice((turn * Vector3::new(x[0], x[1], x[2])).as_slice());
            }
        };
        let Memory { acceleration, algorithmic, differences, contacts, pairs, torsion, .. } = &mut self.memory;
        for vectors in [&mut self.q, &mut self.v, acceleration, algorithmic, &mut differences.velocity] {
            turned(vectors);
        }
        turned(&mut differences.displacement);
        turned(&mut differences.owed);
        self.q.chunks_exact_mut(6).for_each(|q| q.iter_mut().zip(by.iter()).for_each(|(q, by)| *q += by));
        contacts.clear();
        pairs.clear();
        torsion.iter_mut().flatten().for_each(|twist| twist.turn(turn));
    }

    /// Checks that this is a finite state of `size` coordinates; `cable` is the name for the error.
    pub(crate) fn check(&self, cable: &str, size: usize) -> Result<(), Error> {
        let Memory {
            acceleration,
            algorithmic,
            valid,
            step,
            coherence,
            energy_made,
            largest_energy,
            differences,
            lost,
            damped,
            ..
        } = &self.memory;
        let lists = [
            ("positions", &self.q, false),
            ("velocities", &self.v, false),
            ("accelerations", acceleration, !valid),
            ("algorithmic accelerations", algorithmic, true),
            ("changes of velocities", &differences.velocity, true),
            ("changes of positions", &differences.displacement, differences.is_empty()),
        ];
        for (what, list, may_be_empty) in lists {
            let count = list.len();
            if count != size && !(may_be_empty && count == 0) {
                return Err(Error::WrongCount { cable: cable.to_string(), what, count, expected: size });
            }
        }
        let finite = |what: &str, x: f64| require(what, x, true, "a number");
        finite("time (s)", self.time)
            .and_then(|()| require("proposed step (s)", *step, *step >= 0.0, ">= 0"))
            .and_then(|()| require("coherence of errors", *coherence, *coherence >= 0.0 && *coherence <= 1.0, "0 to 1"))
            .and_then(|()| require("energy made (J)", *energy_made, *energy_made >= 0.0, ">= 0"))
            .and_then(|()| require("largest energy (J)", *largest_energy, *largest_energy >= 0.0, ">= 0"))
            .and_then(|()| require("power lost (W)", *lost, *lost >= 0.0, ">= 0"))
            .and_then(|()| require("power of damping (W)", *damped, *damped >= 0.0, ">= 0"))
            .and_then(|()| self.q.iter().try_for_each(|&x| finite("position", x)))
            .and_then(|()| self.v.iter().try_for_each(|&x| finite("velocity", x)))
            .and_then(|()| acceleration.iter().chain(algorithmic).try_for_each(|&x| finite("acceleration", x)))
            .and_then(|()| {
                let Differences { velocity, displacement, step, .. } = differences;
                let mut all = velocity.iter().chain(displacement).chain([step]);
                all.try_for_each(|&x| finite("change of the last step", x))
            })
            .and_then(|()| self.memory.contacts.iter().try_for_each(|contact| contact.check(size / 6 - 1)))
            .and_then(|()| self.memory.pairs.iter().try_for_each(|contact| contact.check(size / 6 - 1)))
            .and_then(|()| self.memory.torsion.iter().flatten().try_for_each(SegmentTwist::check))
            .map_err(|error| error.of_cable(cable))
    }
}
