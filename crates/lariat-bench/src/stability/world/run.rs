//! Runs a case on a host: steps, and after each step the measurements and bounds that hold for all
//! cases.

use super::case::{Case, EnergyBounds, Script, StepErrors};
use super::engine::Warning;
use super::test_world::{StepError, TestWorld};
use crate::stability::host::{CableModel, Host};
use crate::stability::outcome::{Check, Outcome, Row};
use cpu_time::ThreadTime;
use lariat_ancf::Level;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// One of Rapier's own ropes whose stretch, or whose gap in m, is larger than this has flown apart.
const FLOWN_APART: f64 = 10.0;
/// CPU time in s after which a run of Rapier's own ropes, which count no element evaluations, is
/// ended.
const PEER_LIMIT: f64 = 8.0;

/// Runs a case on a host. A panic is an outcome, and so is a budget that is used up.
pub fn run(case: &Case, host: Host, model: CableModel) -> Row {
    debug_assert!(case.applies(&host, model));
    let clock = ThreadTime::now();
    let mut world = TestWorld::new(host, model);
    let steps = ((case.duration * f64::from(host.rate)).round() as usize).max(1);
    let outcome = catch_unwind(AssertUnwindSafe(|| run_steps(case, &mut world, steps, &clock)));
    let outcome = outcome.unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_string()));
        Outcome::Panicked(text.unwrap_or_default())
    });
    let seconds = clock.elapsed().as_secs_f64();
    let counts = world.set.iter().map(|(_, c)| c.diagnostics()).max_by_key(|d| d.steps).copied().unwrap_or_default();
    let is_told = matches!(outcome, Outcome::OutOfBounds(_)) && model == CableModel::Lariat;
    let told = if is_told { told(&world) } else { Vec::new() };
    let monitor = &world.monitor;
    Row {
        family: case.family,
        case: case.name.clone(),
        host,
        model,
        outcome,
        told,
        completed: world.steps_done as f64 / steps as f64,
        energy_not_checked: match case.bounds.energy {
            EnergyBounds::Within { .. } => None,
            EnergyBounds::NotChecked(reason) => Some(reason),
        },
        energy: monitor.balance / monitor.scale.max(1e-9),
        energy_made: monitor.made_share(),
        energy_lost: monitor.lost_share(),
        gap: monitor.gap,
        constraint: monitor.constraint,
        stretch: monitor.stretch,
        steps: counts.steps,
        rejected: counts.rejected_steps,
        evaluations: world.element_evaluations(),
        micros: 1e6 * seconds / world.steps_done.max(1) as f64,
        seconds,
    }
}

/// Returns the names of what the run is warned of, each once.
fn told(world: &TestWorld) -> Vec<String> {
    let mut set = world.set.clone();
    set.settings.warn_level = Some(Level::Coarse);
    let mut names: Vec<String> = set.warnings(&world.physics).iter().map(Warning::name).collect();
    names.sort();
    names.dedup();
    names
}

fn run_steps(case: &Case, world: &mut TestWorld, steps: usize, clock: &ThreadTime) -> Outcome {
    let Script { mut before_step, checks } = match (case.build)(world) {
        Ok(script) => script,
        Err(error) => return Outcome::Failed(error.to_string()),
    };
    world.restart_balance();
    while world.steps_done < steps {
        if let Err(error) = before_step(world) {
            return Outcome::Failed(error.to_string());
        }
        if let Err(error) = world.step() {
            return judge_error(case.step_errors, world, &error);
        }
        world.steps_done += 1;
        world.time += world.dt();
        if !world.is_finite() {
            return Outcome::NotFinite;
        }
        world.measure();
        let lariat = world.model == CableModel::Lariat;
        if !lariat && (world.monitor.stretch > FLOWN_APART || world.monitor.gap > FLOWN_APART) {
            return Outcome::Failed("flew apart".to_string());
        }
        let used_up =
            if lariat { world.element_evaluations() > case.budget } else { clock.elapsed().as_secs_f64() > PEER_LIMIT };
        if used_up && world.steps_done < steps {
            let failed = failed(bounds(case, world));
            return if failed.is_empty() { Outcome::OverBudget } else { Outcome::OutOfBounds(failed) };
        }
    }
    let mut all = bounds(case, world);
    // the expectations of a case are computed without effects
    if !world.host.effects && world.model == CableModel::Lariat {
        all.extend(checks(world));
    }
    let failed = failed(all);
    if failed.is_empty() { Outcome::Passed } else { Outcome::OutOfBounds(failed) }
}

fn failed(checks: Vec<Check>) -> Vec<Check> {
    checks.into_iter().filter(|check| !check.holds()).collect()
}

/// Returns the checks that all cases share.
fn bounds(case: &Case, world: &TestWorld) -> Vec<Check> {
    if world.model != CableModel::Lariat {
        return Vec::new();
    }
    let monitor = &world.monitor;
    let mut all = vec![Check::at_most("gap, m", monitor.gap, case.bounds.gap, "the contract of an attachment")];
    if let EnergyBounds::Within { made, lost } = case.bounds.energy {
        all.push(Check::at_most("energy made", monitor.made_share(), made, "conservation of energy"));
        all.push(Check::at_most("energy lost", monitor.lost_share(), lost, "conservation of energy"));
    }
    all
}

/// Judges a step that ended in an error: is that an answer, does it name the culprit, is the state
/// what it was?
fn judge_error(expected: StepErrors, world: &TestWorld, error: &StepError) -> Outcome {
    let complaint = if !error.state_kept || !world.is_finite() {
        " (the state before the step is not kept)"
    } else if !error.names_culprit() {
        " (neither a cable nor a body is named)"
    } else if expected == StepErrors::Fail {
        ""
    } else {
        return Outcome::StepError(error.to_string());
    };
    Outcome::Failed(format!("{error}{complaint}"))
}
