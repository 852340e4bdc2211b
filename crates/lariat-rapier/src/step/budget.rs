//! A limit to the work of a host step.
//!
//! # Scheme
//! An island is integrated by its own integrator until it has spent its budget in this host step.
//! What is left of the host step is then integrated by the discrete gradient with one Newton
//! iteration per step of 1/240 s, which [cannot make energy](WorkLimit) but has errors without a
//! bound. Where even that does not do, the island stays behind: cables and bodies move less far
//! than the host step is long, and go on in the next one. An
//! [`Event::Degraded`](crate::Event::Degraded) names the cables.
//!
//! # Validity
//! The budget is that of integration; Rapier's own steps, whose number
//! [`Settings::max_rapier_steps`](crate::Settings::max_rapier_steps) bounds, are not in it. By how
//! much it can be exceeded: [`WorkLimit`].

use crate::scales::step::CHEAPEST_STEP;
use lariat_ancf::integrate::{IntegratorRef, OneStep, WorkLimit};
use lariat_ancf::{Error, Integrator, Method, StepControl, StepFailure};
use serde::{Deserialize, Serialize};
use web_time::{Duration, Instant};

/// The integrator of what is left of a host step.
pub(crate) const CHEAPEST: Integrator =
    Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(CHEAPEST_STEP) };

/// The largest amount of work in a host step; beyond it, accuracy is reduced.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Budget {
    /// Newton iterations of each island. Repeatable to the bit.
    NewtonIterations(u64),
    /// Wall-clock time in s since the host step began, the same for all islands. Not repeatable.
    Time(f64),
}

/// What is left of a budget in a host step, for one island.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Remaining {
    iterations: Option<u64>,
    deadline: Option<Instant>,
}

impl Remaining {
    /// Begins a host step.
    pub fn new(budget: Option<Budget>) -> Self {
        match budget {
            None => Remaining::default(),
            Some(Budget::NewtonIterations(iterations)) => Remaining { iterations: Some(iterations), deadline: None },
            Some(Budget::Time(time)) => {
                let time = Duration::try_from_secs_f64(time).unwrap_or_default();
                Remaining { iterations: None, deadline: Instant::now().checked_add(time) }
            }
        }
    }

    /// Returns the limit of a step, if there is a budget.
    pub fn limit(&self) -> Option<WorkLimit> {
        self.iterations.map(WorkLimit::iterations).or_else(|| self.deadline.map(WorkLimit::until))
    }

    /// Takes what a step has spent.
    pub fn update(&mut self, limit: &WorkLimit) {
        self.iterations = self.iterations.map(|_| limit.left());
    }
}

/// Steps with an integrator within a limit, and with the cheapest one if that is reached.
pub(crate) fn step_within(
    limit: Option<&WorkLimit>,
    integrator: &Integrator,
    mut step: impl FnMut(IntegratorRef<'_>) -> Result<(), Error>,
) -> Result<(), Error> {
    match step(IntegratorRef::from(integrator).within(limit)) {
        Err(Error::StepFailed { failure: StepFailure::WorkLimit, .. })
            if !integrator.method.uses_discrete_gradients() =>
        {
            step(IntegratorRef::from(&CHEAPEST).within(limit))
        }
        outcome => outcome,
    }
}
