//! Static equilibrium from any start, slack or taut: F(q) = 0.
//!
//! The ways to it, each a file, tried in this order until one ends in a shape that is a cable's:
//! - loads with a moment: `follow` along the ramp of the loads by Newton steps, for beyond 90 degrees a moment holds
//!   a cable, which has no torsional stiffness, in unstable shapes only;
//! - `descend`: downhill by a regularised Newton iteration, to a stable shape;
//! - with other loads, `follow`;
//! - `lay`: downhill from the shape that a new cable would have between the supports;
//! - `relax`: dynamic relaxation, then downhill from there.
//!
//! In a flow there is nothing to go down: `drift` alone.
//!
//! A shape with folded elements is straightened once and goes downhill again; if it folds again it is not an answer.
//! A stable shape is preferred, an unstable one is returned if no stable one is found. Iterations are bounded, each
//! way and all together.
//!
//! *Validity.* Any cable that is held against its loads; without bending, slack parts without load are indeterminate
//! and any shape of zero force is returned. *Rejected.* Plain Newton (a slack cable is singular), arc length methods
//! (no branch is followed).

mod descend;
mod drift;
mod folded;
mod follow;
mod lay;
mod potential;
mod relax;
mod scale;

use crate::cable::{Cable, Fluid, Model};
use crate::error::{EquilibriumFailure, Error, StepFailure, require};
use crate::integrate::Dynamics;
use crate::support::SlopeSupport;
use nalgebra::Vector3;

/// When a shape counts as an equilibrium, and when to give up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumOptions {
    /// Largest residual force over the sum of the loads. Default 1e-9.
    pub tolerance: f64,
    /// Iterations of each attempt; all attempts together take at most five times as many. Default 400.
    pub iterations: usize,
}

impl Default for EquilibriumOptions {
    fn default() -> Self {
        EquilibriumOptions { tolerance: 1e-9, iterations: 400 }
    }
}

/// What [`Cable::equilibrium`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumReport {
    /// Iterations done, all attempts together.
    pub iterations: usize,
    /// Largest residual force in N.
    pub residual: f64,
    /// True if the tangent stiffness is positive definite there; false for an unstable or indifferent shape.
    pub stable: bool,
}

/// Largest change of a slope vector in one iteration.
const SLOPE_CAP: f64 = 0.3;
/// Iterations of all attempts together, over those of one.
const ATTEMPTS: usize = 5;

/// Iterations done and left.
struct Budget {
    tolerance: f64,
    /// Iterations of one attempt.
    attempt: usize,
    done: usize,
}

impl Budget {
    /// One more, if any is left.
    fn take(&mut self) -> bool {
        let more = !self.spent();
        self.done += usize::from(more);
        more
    }

    fn spent(&self) -> bool {
        self.done >= ATTEMPTS.saturating_mul(self.attempt)
    }
}

/// Why an attempt failed.
struct Failure {
    cause: Option<StepFailure>,
    /// Largest residual force in N where it stopped.
    residual: f64,
}

impl Default for Failure {
    fn default() -> Self {
        Failure { cause: None, residual: f64::NAN }
    }
}

impl Cable {
    /// Moves the cable to static equilibrium under gravity, its full point loads, its effects and its supports; velocities become
    /// zero. A flow is that of the cable's time.
    ///
    /// # Errors
    /// [`Error::NoEquilibrium`] if none is found; the cable is then as before. [`Error::Attached`] for a cable with
    /// [attached](Self::attach) nodes.
    pub fn equilibrium(&mut self) -> Result<EquilibriumReport, Error> {
        self.equilibrium_with(EquilibriumOptions::default())
    }

    /// [`equilibrium`](Self::equilibrium) with options.
    ///
    /// # Errors
    /// As [`equilibrium`](Self::equilibrium).
    pub fn equilibrium_with(&mut self, options: EquilibriumOptions) -> Result<EquilibriumReport, Error> {
        let no_equilibrium = |cable: &Cable, failure: EquilibriumFailure, residual: f64, iterations: usize| {
            Error::NoEquilibrium { cable: cable.name().to_string(), time: cable.time(), failure, residual, iterations }
        };
        self.check_not_attached()?;
        require("equilibrium tolerance", options.tolerance, options.tolerance > 0.0, "> 0")?;
        if let Some(resultant) = unheld(&self.model) {
            return Err(no_equilibrium(self, EquilibriumFailure::NotHeld, resultant, 0));
        }
        self.system.static_time = self.time();
        let (before, revision, work) = (self.state.clone(), self.revision, self.state.work);
        let loads = self.model.loads.clone();
        // "time" runs from no load (0) to full load (1) while statics are solved
        self.model.loads.iter_mut().for_each(|load| (load.ramp, load.start) = (1.0, 0.0));
        let mut budget = Budget { tolerance: options.tolerance, attempt: options.iterations, done: 0 };
        let outcome = self.attempts(&mut budget);
        self.model.loads = loads;
        match outcome {
            Ok(report) => {
                // what drag takes on the way to rest is no part of the cable's history
                self.state.work = work;
                self.still();
                Ok(report)
            }
            Err(failure) => {
                let fold = folded::folded(&self.model, self.positions());
                self.state = before;
                self.revision = revision;
                let reason = match (failure.cause, fold) {
                    (Some(cause), _) => cause.into(),
                    (None, Some(element)) => EquilibriumFailure::Folded { element },
                    (None, None) => EquilibriumFailure::NotConverged,
                };
                Err(no_equilibrium(self, reason, failure.residual, budget.done))
            }
        }
    }

    fn attempts(&mut self, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        self.place_supports();
        if self.system.fluid.as_ref().is_some_and(Fluid::flows) {
            return self.drift(budget);
        }
        let start = self.state.clone();
        let moments = self.model.loads.iter().any(|load| load.moment != Vector3::zeros());
        let pure = moments
            && self.model.gravity == Vector3::zeros()
            && self.model.loads.iter().all(|load| load.force == Vector3::zeros());
        let loads = !self.model.loads.is_empty();
        let mut unstable = None;
        let mut last = Failure::default();
        for way in 0..5 {
            let outcome = match way {
                0 if moments => self.follow(budget),
                1 => self.descend(1.0, budget),
                2 if loads && !moments => self.follow(budget),
                3 => {
                    lay::lay(&self.model, &mut self.state.phase.q);
                    self.descend(1.0, budget)
                }
                4 => {
                    let relaxed = self.relax(budget);
                    relaxed.and_then(|()| self.descend(1.0, budget))
                }
                _ => continue,
            };
            match outcome.and_then(|report| self.unfolded(report, budget)) {
                // a first shape that nothing pushes away is taken as it is, and so is what a moment alone makes
                Ok(report) if report.stable || way == 1 || pure => return Ok(report),
                Ok(report) => unstable = unstable.or(Some((report, self.state.clone()))),
                Err(failure) => {
                    // an attempt that ran out at once knows no residual of its own
                    let residual = if failure.residual.is_nan() { last.residual } else { failure.residual };
                    last = Failure { residual, ..failure };
                }
            }
            if budget.spent() {
                break;
            }
            if way < 4 {
                self.state = start.clone();
            }
        }
        match unstable {
            Some((report, state)) => {
                self.state = state;
                Ok(EquilibriumReport { iterations: budget.done, ..report })
            }
            None => Err(last),
        }
    }

    /// Puts the supports at their places and takes the cable along.
    fn place_supports(&mut self) {
        let mut phase = core::mem::take(&mut self.state.phase);
        let before = phase.q.clone();
        let (equations, _) = self.equations();
        equations.prescribe(phase.time, &mut phase.q, &mut phase.v);
        lay::take_along(equations.model, &before, &mut phase.q);
        self.state.phase = phase;
    }

    /// The same, if no element is folded; else what comes of straightening them.
    fn unfolded(&mut self, report: EquilibriumReport, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        if folded::folded(&self.model, self.positions()).is_none() {
            return Ok(report);
        }
        folded::unfold(&self.model, &mut self.state.phase.q);
        let report = self.descend(1.0, budget)?;
        match folded::folded(&self.model, self.positions()) {
            None => Ok(report),
            Some(_) => Err(Failure { cause: None, residual: report.residual }),
        }
    }
}

/// The resultant of the loads in N that no support can take, if there is one: a force on a cable whose position
/// nothing holds, or nothing but moments (over the length) on one that may turn about the one point that is held.
fn unheld(model: &Model) -> Option<f64> {
    let (weight, size) = model.dead_resultant();
    let size = model.loads.iter().fold(size, |sum, load| sum + load.force.norm());
    let held = model.supports.iter().filter(|(_, support)| support.holds_position()).count();
    let turns = model.supports.iter().all(|(_, support)| support.slope == SlopeSupport::Free);
    let force = model.loads.iter().fold(weight, |sum, load| sum + load.force).norm();
    let moment = model.loads.iter().map(|load| load.moment).sum::<Vector3<f64>>().norm();
    match held {
        0 => (force > 1e-12 * size).then_some(force),
        1 => (turns && size == 0.0 && moment > 0.0).then_some(moment / model.length()),
        _ => None,
    }
}

/// Largest change of a position (m) and of a slope component.
fn largest_change(dq: &[f64]) -> (f64, f64) {
    let largest = |from: usize| {
        dq.chunks_exact(6).flat_map(|x| &x[from..from + 3]).fold(0.0f64, |m, x| {
            if x.is_nan() {
                f64::NAN
            } else if m.is_nan() {
                m
            } else {
                m.max(x.abs())
            }
        })
    };
    (largest(0), largest(3))
}
