//! A limit to the work of a host step.
//!
//! # Scheme
//! An island is integrated by its own integrator until it has spent its budget in this host step.
//! What is left of the host step is then integrated by the discrete gradient with one Newton
//! iteration per step of 1/240 s, which [cannot make energy](WorkLimit) but has errors without a
//! bound. Where even that does not do, the island stays behind: cables and bodies move less far
//! than the host step is long, and go on in the next one. An
//! [`Event::Degraded`](crate::Event::Degraded) names the cables, with what the island cost, and
//! [`Warning::CutShort`](lariat_ancf::Warning::CutShort) says how often. No momentum is lost, as in
//! any other step, though more may be owed to later ones: up to 2.3e-4 of it, and 3.4e-4 of the
//! angular momentum, after host steps of two iterations (tests of lariat-ancf, island/momentum.rs).
//!
//! By default games have a budget, [`Budget::Games`]: so many iterations that no host step of the
//! shipped scenes reaches it, and none of random worlds comes near, and so few that the worst is
//! bounded.
//!
//! # Validity
//! The budget is that of integration; Rapier's own steps, whose number
//! [`Settings::max_rapier_steps`](crate::Settings::max_rapier_steps) bounds, are not in it. By how
//! much it can be exceeded: [`WorkLimit`].

use crate::scales::step::{CHEAPEST_STEP, FRAME, ITERATIONS_OF_GAMES};
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
    /// That of games, the default: 2000 Newton iterations of each island that steps by fidelity
    /// game in a host step of 1/60 s or less, and in proportion in longer ones; no limit for
    /// others, nor for shorter steps than 1/240 s. Repeatable to the bit.
    Games,
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
    /// Whether it is for steps of games only.
    of_games: bool,
    /// Newton iterations that were taken in the host step.
    pub spent: u64,
}

impl Remaining {
    /// Begins a host step of `dt` (s).
    pub fn new(budget: Option<Budget>, dt: f64) -> Self {
        match budget {
            None => Remaining::default(),
            Some(Budget::Games) => {
                let frames = (dt / FRAME).max(1.0);
                // beyond the largest number it is no limit
                let iterations = Some((frames * ITERATIONS_OF_GAMES) as u64);
                Remaining { iterations, of_games: true, ..Remaining::default() }
            }
            Some(Budget::NewtonIterations(iterations)) => {
                Remaining { iterations: Some(iterations), ..Remaining::default() }
            }
            Some(Budget::Time(time)) => {
                let time = Duration::try_from_secs_f64(time).unwrap_or_default();
                Remaining { deadline: Instant::now().checked_add(time), ..Remaining::default() }
            }
        }
    }

    /// Returns the limit of a step with an integrator: a very large one where there is none, which
    /// counts.
    pub fn limit(&self, integrator: &Integrator) -> WorkLimit {
        let is_of_games = integrator.method.uses_discrete_gradients()
            && match integrator.control {
                StepControl::MaxStep(step) => step >= CHEAPEST_STEP,
                control => matches!(control, StepControl::Adaptive(_)),
            };
        match (self.iterations, self.deadline) {
            (Some(iterations), _) if is_of_games || !self.of_games => WorkLimit::iterations(iterations),
            (None, Some(deadline)) => WorkLimit::until(deadline),
            _ => WorkLimit::iterations(u64::MAX),
        }
    }

    /// Takes what a step has spent.
    pub fn update(&mut self, limit: &WorkLimit) {
        self.spent += limit.spent();
        self.iterations = self.iterations.map(|iterations| iterations.saturating_sub(limit.spent()));
    }
}

/// Steps with an integrator within a limit, and with the cheapest one if that is reached.
pub(crate) fn step_within(
    limit: &WorkLimit,
    integrator: &Integrator,
    mut step: impl FnMut(IntegratorRef<'_>) -> Result<(), Error>,
) -> Result<(), Error> {
    match step(IntegratorRef::from(integrator).within(Some(limit))) {
        Err(Error::StepFailed { failure: StepFailure::WorkLimit, .. })
            if !integrator.method.uses_discrete_gradients() =>
        {
            step(IntegratorRef::from(&CHEAPEST).within(Some(limit)))
        }
        outcome => outcome,
    }
}
