//! The runs of a [study](super): their mesh, their tolerance, and what they recorded.

use super::claim::{FailedRun, StudyError};
use super::record::Record;
use super::target::Target;
use crate::integrate::{ErrorNorm, Integrator, Method, StepControl};

/// The mesh and the tolerance of a run of a [`Study`](super::Study).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Number of elements of the cable that has most.
    pub elements: usize,
    /// Error of position per host step in m; `None` for an equilibrium, and for equal steps.
    pub tolerance: Option<f64>,
    /// Length of equal steps in s, in the run that judges steps which the host step limits.
    pub max_step: Option<f64>,
    /// Number of equal parts that a host step is to be divided into, each a host step of its own; 1
    /// unless the study is [coupled](super::Study::coupled). Positions are recorded at the times of
    /// whole host steps.
    pub parts: u32,
    /// Whether the [integrator](Self::integrator) is the discrete gradient; the tolerance is then
    /// that of a part of a host step.
    pub coupled: bool,
}

impl Default for Resolution {
    fn default() -> Self {
        Resolution { elements: 0, tolerance: None, max_step: None, parts: 1, coupled: false }
    }
}

impl Resolution {
    /// Returns the number of elements of a cable that would have `own` of them in a world where the
    /// largest has `largest`: in this proportion, but not below half of
    /// [`elements`](Self::elements), because a mesh that is not refined shows no error.
    pub fn elements_of(&self, own: usize, largest: usize) -> usize {
        (self.elements * own).div_ceil(largest.max(1)).max(self.elements.div_ceil(2))
    }

    /// Returns the integrator: ESDIRK4 with the tolerance for every node and body, or in equal
    /// steps; where the study is coupled [`Integrator::COUPLED`] with the tolerance; for an
    /// equilibrium the default one.
    pub fn integrator(&self) -> Integrator {
        if let (true, None, None) = (self.coupled, self.tolerance, self.max_step) {
            return Integrator::COUPLED;
        }
        if let (true, Some(tolerance)) = (self.coupled, self.tolerance) {
            return Integrator {
                control: StepControl::ToleranceOf(tolerance, ErrorNorm::Bodies),
                ..Integrator::COUPLED
            };
        }
        let control = self.max_step.map(StepControl::MaxStep).or(self.tolerance.map(StepControl::Tolerance));
        control.map_or(Integrator::default(), |control| Integrator { method: Method::Esdirk4, control })
    }
}

/// Host steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// Their number; a fraction is a shorter step.
    pub(super) steps: f64,
    /// Their length in s.
    pub(super) host_step: f64,
}

/// One run.
pub(super) struct Run<W> {
    pub(super) elements: usize,
    pub(super) world: W,
    pub(super) record: Record,
}

/// The runs so far.
pub(super) struct Runs<F> {
    pub(super) run: F,
    /// What is asked for, and its error.
    pub(super) target: Target,
    pub(super) error: f64,
    /// That error as one of positions in m, from which tolerances begin.
    pub(super) length: f64,
    pub(super) span: Option<Span>,
    /// Whether the world has what only the discrete gradient steps.
    pub(super) coupled: bool,
    pub(super) count: usize,
    pub(super) evaluations: u64,
    /// The last run that worked, and the last that failed.
    pub(super) worked: Option<Resolution>,
    pub(super) failed: Option<FailedRun>,
}

impl<F> Runs<F> {
    /// Returns the error of what is asked for that an error of positions in m has as its
    /// consequence.
    pub(super) fn of_length(&self, length: f64) -> f64 {
        if self.length == self.error { length } else { length * (self.error / self.length) }
    }

    /// Runs the world at a resolution.
    pub(super) fn run<W, E>(&mut self, resolution: Resolution) -> Result<Run<W>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let mut record = Record::of(self.target);
        let Resolution { elements, tolerance, parts, .. } = resolution;
        self.count += 1;
        let world = match (self.run)(&resolution, &mut record) {
            Ok(world) => world,
            Err(source) => {
                self.failed = Some(FailedRun { elements, tolerance_m: tolerance, parts });
                return Err(StudyError::Run { elements, tolerance, source });
            }
        };
        self.worked = Some(resolution);
        self.evaluations += record.evaluations();
        if record.is_empty() {
            return Err(StudyError::NothingRecorded);
        }
        Ok(Run { elements, world, record })
    }

    /// Runs the world at a resolution that is finer than one that works; `None` if that fails,
    /// which is [noted](Self::failed).
    pub(super) fn attempt<W, E>(&mut self, resolution: Resolution) -> Result<Option<Run<W>>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        match self.run(resolution) {
            Err(StudyError::Run { .. }) => Ok(None),
            outcome => outcome.map(Some),
        }
    }
}
