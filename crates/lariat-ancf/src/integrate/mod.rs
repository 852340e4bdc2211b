//! Time integrators, one file each, over one trait.
//!
//! A method takes one step of any length on anything that is a [`Dynamics`]; [`drive`] chooses the steps: it lands exactly on
//! the host's step, estimates the error where the method can, rejects and retries shorter, and gives up with the last good
//! state in place.
//!
//! | file | method | order |
//! |---|---|---|
//! | [`midpoint`] | implicit midpoint | 2 |
//! | [`trapezoid`] | trapezoidal rule | 2 |
//! | [`generalised_alpha`] | generalised-alpha(rho), converged or one Newton iteration | 2 |
//! | [`tr_bdf2`] | TR-BDF2 | 2 |
//! | [`esdirk3`], [`esdirk4`] | L-stable singly diagonally implicit Runge-Kutta | 3, 4 |
//! | [`verlet`], [`rkn`] | symplectic explicit | 2, 4, 6 |

mod backward_euler;
pub mod dirk;
pub mod drive;
pub mod dynamics;
pub mod esdirk3;
pub mod esdirk4;
pub mod explicit;
mod fidelity;
pub mod generalised_alpha;
mod method;
pub mod midpoint;
pub mod newton;
pub mod rkn;
pub mod tr_bdf2;
pub mod trapezoid;
pub mod verlet;

pub use drive::{Counts, Refusal};
pub use dynamics::{Dynamics, Newton, Stage};
pub use fidelity::{Fidelity, Integrator, StepControl};
pub use method::{Method, NewtonMode, Properties};

use crate::error::StepFailure;
use serde::{Deserialize, Serialize};

/// What a method carries from step to step, besides positions and velocities. Plain data, part of a snapshot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Acceleration at the present state, if `valid`.
    pub acceleration: Vec<f64>,
    /// The algorithmic acceleration of generalised-alpha.
    pub algorithmic: Vec<f64>,
    /// Whether the accelerations belong to the present state.
    pub valid: bool,
    /// Which state of the system's description they belong to: a change of supports, loads or method makes another.
    #[serde(default)]
    pub revision: u64,
    /// Length of the next step in s as error control proposes it; 0 = no proposal.
    pub step: f64,
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
    /// Copies `other` into the buffers that are there; the derived `clone_from` would allocate new ones.
    pub(crate) fn copy_from(&mut self, other: &State) {
        let State { time, q, v, memory: Memory { acceleration, algorithmic, valid, step, revision } } = other;
        self.time = *time;
        self.q.clone_from(q);
        self.v.clone_from(v);
        self.memory.revision = *revision;
        self.memory.acceleration.clone_from(acceleration);
        self.memory.algorithmic.clone_from(algorithmic);
        self.memory.valid = *valid;
        self.memory.step = *step;
    }
}

impl State {
    /// Refuses a phase that is not one of `size` coordinates, or not finite; says why.
    pub(crate) fn check(&self, size: usize) -> Result<(), String> {
        let memory = &self.memory;
        let lengths = [self.q.len(), self.v.len()];
        if lengths.iter().any(|&n| n != size) {
            return Err(format!("a state of {lengths:?} coordinates does not fit {size}"));
        }
        let fits = |v: &Vec<f64>| v.is_empty() || v.len() == size;
        if memory.valid && memory.acceleration.len() != size
            || !fits(&memory.acceleration)
            || !fits(&memory.algorithmic)
        {
            return Err("a state whose accelerations do not fit its coordinates".to_string());
        }
        let all = [&self.q, &self.v, &memory.acceleration, &memory.algorithmic];
        if !all.into_iter().flatten().chain([&self.time, &memory.step]).all(|x| x.is_finite()) || memory.step < 0.0 {
            return Err("a state that is not finite".to_string());
        }
        Ok(())
    }
}

/// Scratch vectors of a method; allocated once.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    pub(crate) next: State,
    pub(crate) base: Vec<f64>,
    pub(crate) velocity_base: Vec<f64>,
    pub(crate) error: Vec<f64>,
    pub(crate) stage_v: Vec<Vec<f64>>,
    pub(crate) stage_k: Vec<Vec<f64>>,
}

impl Scratch {
    /// Makes room for `size` coordinates and `stages` stages.
    pub(crate) fn resize(&mut self, size: usize, stages: usize) {
        let phase = &mut self.next;
        for v in [
            &mut phase.q,
            &mut phase.v,
            &mut phase.memory.acceleration,
            &mut phase.memory.algorithmic,
            &mut self.base,
            &mut self.velocity_base,
            &mut self.error,
        ] {
            v.resize(size, 0.0);
        }
        for stages_of in [&mut self.stage_v, &mut self.stage_k] {
            if stages_of.len() < stages {
                stages_of.resize(stages, Vec::new());
            }
            stages_of.iter_mut().for_each(|v| v.resize(size, 0.0));
        }
    }
}

/// One step of one method.
pub trait OneStep {
    /// Number of scratch stages.
    fn stages(&self) -> usize;

    /// Steps from `now` by `h` (s) into `scratch.next`, and returns the estimated position error of the step in m, if the
    /// method has an estimate and it is `wanted`. `now.memory.acceleration` is valid on entry, that of `scratch.next` on return.
    ///
    /// # Errors
    /// As the stages and accelerations of `system`.
    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        h: f64,
        newton_tolerance: f64,
        wanted: bool,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure>;
}
