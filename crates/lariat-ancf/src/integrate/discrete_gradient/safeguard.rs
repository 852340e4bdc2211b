//! One step, by the cheapest means that keep its energy law.
//!
//! 1. One Newton iteration, accepted if its residual makes at most 1e-9 of the energy of the system beyond what the method loses and 1 % of
//!    what damping takes, loses no more energy than the method does, and leaves at most 1 % of the impulses unbalanced.
//! 2. Up to eight, up to four for the last condition: with the same factors where energy is not made and they bring the impulses nearer to
//!    balance, else with a new tangent.
//! 3. Velocities relative to rigid motion are scaled down, if that takes at most half of their energy; momenta stay.
//! 4. Four steps of a quarter, each by the same means; the one after a quarter that had to be divided in turn is divided at once.
//!
//! With a [limit](WorkLimit) to the work that is spent, one iteration is taken, rescaling may take all of that energy, and instead of a
//! division the step ends.
//!
//! Damping, friction and impact lose so much that any error of the iteration hides behind them: on a rotor whose rope is damped, errors of
//! the tension grow to a thousand times the tension. A step is therefore accepted only if its energy balance *closes*, to 1 % of what
//! they lose. Near an obstacle it must close to 1 % of all that the step loses, and the contact forces must be those of the linear solve, to
//! 1e-3 in sum; every iteration has a new tangent, and up to 20 are taken, those that swing by halves (relaxation.rs). After those the balance alone must close; and in the last
//! division the energy law alone must hold. Motors of reels must have the forces of their laws likewise, to 1e-3, with a new
//! tangent in every iteration that is needed for them. With stock of a reel on a body that moves freely the sum of all impulses must balance, to 1e-9
//! of them, or the velocities are not scaled down.
//!
//! When the iteration ends, contacts with thin and sharp parts of obstacles are looked for again; if any were missed it goes on with them, up to
//! three times. A step in which some are missed still, or in which the centre lines of cables that may touch go through each other, or through such parts, is divided too; in the last division it is counted, and a warning says so.
//! So is one in which the friction of a sheave stops it from running: a long step may have such a solution beside the one that runs on, and
//! Newton's iteration end there.
//!
//! # Alternatives considered
//!
//! A part broken off after six iterations without progress: no fewer iterations. Bounds of friction that reverse changed by half: no fewer.
//!
//! Anderson's mixing of 3 to 8 increments, in the norm of kinetic energy, in place of half ones: a rope that falls on a rod 0.79 to 0.89 of
//! the iterations, one that falls tilted on a floor 0.88 to 1.26, a heap 0.85 to 1.3. First iterates without acceleration, tangents without
//! the second derivatives of bending, with the stiffness of compression, or with gradients of strains half way between the mean and the end of the iterate (a rope that falls tilted 1.9 of the iterations), up to 12 iterations in place of 20, contact forces to 1e-2,
//! closure to 0.1: the same scatter (heaps 0.96 to 1.47), and none takes less than a half in the dearest host steps of all three.
//!
//! Impulses that a step leaves unbalanced, carried into the next one with the energy that they took: the example `fleet` takes 3.0 iterations per step for 2.7, and divides steps
//! where it divided none; 400 cables that swing calmly 2.0 for 1.2. What is unbalanced along a stiff cable is already in its strain when the next step begins, so that it is not owed.

use super::law::{Balance, CLOSURE, Closing, DiscreteGradientSystem, Event};
use super::relaxation::Relaxation;
use crate::error::StepFailure;
use crate::integrate::WorkLimit;

/// Share of the energy of the system that a step may make.
const TOLERANCE: f64 = 1e-9;
/// Share of the impulses of a step that may be unbalanced. The energy law alone lets errors of tension pass where the motion turns fast:
/// on a rotor, 0.13 rad per step, 20 N of 63.
const FORCE_TOLERANCE: f64 = 0.01;
/// The same for the sum of all impulses, where stock of a reel rides with a body that moves freely.
const DRIFT_TOLERANCE: f64 = 1e-9;
/// Number of iterations after which the balance of impulses is no longer asked for: a slack cable has hardly any.
const MAX_FOR_FORCES: usize = 4;
/// Share of the imbalance that an iteration with the factors of an earlier one may leave; if it leaves more the next has a new tangent.
const MAX_LEFT: f64 = 0.1;
/// Rounding error of the energy law as a share of its terms.
const ROUNDING: f64 = 1e-13;
/// Largest number of Newton iterations.
const MAX_ITERATIONS: usize = 8;
/// Largest number of Newton iterations near an obstacle.
const MAX_ITERATIONS_NEAR: usize = 20;
/// Number of times that contacts are looked for again when the iteration has ended.
const MAX_SEARCHES: usize = 3;
/// Largest number of times that the bounds of friction are set by the normal forces of the step itself.
const MAX_RENEWALS: usize = 40;
/// Energy by which it may miss in any case, as a share of the weight times 1 mm.
const CLOSURE_OF_WEIGHT: f64 = 1e-6;
/// Share of the impulses that may be unbalanced where velocities are rescaled near an obstacle.
const LARGEST_IMBALANCE: f64 = 0.1;
/// Share of the contact forces that the linear solve may miss, and of the other impulses that bounds of friction may.
const CONSISTENCY: f64 = 1e-3;
/// Share of the velocities relative to rigid motion that rescaling may take: that of half of their energy.
const SHARE_OF_HALF_THE_ENERGY: f64 = 0.292_893_218_813_452_5;
/// Number of parts into which a step is divided.
const PARTS: usize = 4;
/// Largest number of divisions of divisions.
const MAX_DEPTH: usize = 6;

/// Returns whether a step keeps the law, beyond doubt by rounding.
fn keeps_law(balance: &Balance) -> bool {
    let allowed = TOLERANCE * balance.scale();
    balance.excess() <= allowed && is_certain(balance)
}

/// Returns whether the residual loses no more than the method itself.
fn is_dissipation_right(balance: &Balance) -> bool {
    -balance.residual <= balance.losses() + TOLERANCE * balance.scale()
}

/// Returns whether the balance of a step closes: what damping, friction and impact take does not hide what the residual makes. Near an
/// obstacle the dissipation of the method hides nothing either.
fn closes(balance: &Balance) -> bool {
    let tolerance = TOLERANCE * balance.scale();
    if balance.near {
        balance.residual <= CLOSURE * balance.losses() + tolerance.max(CLOSURE_OF_WEIGHT * balance.weight)
    } else {
        balance.to_take() <= tolerance
    }
}

/// Returns whether contact forces are those of the linear solve, to a share of them and of the weight (its energy at 1 mm is its thousandth in
/// N).
fn is_consistent(balance: &Balance) -> bool {
    balance.missed <= CONSISTENCY * balance.forces + balance.weight
}

/// Returns whether an iterate near an obstacle is close to a solution: rescaling does not repair one that is thrown to and fro.
fn is_almost_solved(balance: &Balance) -> bool {
    !balance.near || balance.imbalance <= LARGEST_IMBALANCE * balance.impulse
}

/// Returns whether contacts with obstacles that close offsets give back more than they lose. In parts of the step they close none.
fn gives_back(balance: &Balance) -> bool {
    balance.given_back > TOLERANCE * balance.scale()
}

/// Returns whether motors of reels have the forces of their laws.
fn are_motors_right(balance: &Balance) -> bool {
    let [missed, forces] = balance.slip;
    missed <= CONSISTENCY * forces + balance.weight
}

/// Returns whether the residual leaves a small share of the impulses unbalanced.
fn are_forces_right(balance: &Balance) -> bool {
    balance.imbalance <= FORCE_TOLERANCE * balance.impulse
}

/// Returns whether the residual keeps the momentum of all.
fn is_momentum_right(balance: &Balance) -> bool {
    balance.drift.iter().map(|x| x.abs()).sum::<f64>() <= DRIFT_TOLERANCE * balance.impulse
}

/// Returns whether the terms of the law are small enough for their sum to be known to the tolerance.
fn is_certain(balance: &Balance) -> bool {
    ROUNDING * (balance.numerical + balance.contacts + balance.residual.abs()) <= TOLERANCE * balance.scale()
}

/// Makes the end of the step the present state.
fn accept(
    system: &mut dyn DiscreteGradientSystem,
    balance: &Balance,
    limit: Option<&WorkLimit>,
    crosses: bool,
) -> Result<bool, StepFailure> {
    let mut balance = *balance;
    if balance.near {
        let least = TOLERANCE * balance.scale();
        system.land(&mut balance, least);
    }
    if crosses {
        system.count(Event::Crossed);
    }
    system.accept(&balance);
    limit.into_iter().for_each(WorkLimit::note_progress);
    Ok(true)
}

/// Advances the system by `h` (s); returns false if the limit ended the step before.
///
/// # Errors
/// If a step of h/4^6 neither keeps its energy law nor can be made to.
pub(super) fn step(
    system: &mut dyn DiscreteGradientSystem,
    h: f64,
    depth: usize,
    limit: Option<&WorkLimit>,
) -> Result<bool, StepFailure> {
    system.predict(h, Closing { obstacles: depth == 0, cables: depth < MAX_DEPTH });
    let mut last = Err(StepFailure::NotConverged { iterations: 0, increment: 0.0 });
    let (mut fresh, mut most) = (true, MAX_ITERATIONS);
    let (mut iteration, mut imbalance) = (0, f64::INFINITY);
    let (mut searches, mut misses) = (0, None);
    let (mut renewals, mut renewed) = (0, 0);
    let mut relaxation = Relaxation::new();
    let is_spent = || limit.is_some_and(WorkLimit::is_spent);
    while iteration < most && !(iteration > 0 && is_spent()) {
        iteration += 1;
        last = system.iterate(fresh, relaxation.share);
        if let Ok(balance) = &last {
            relaxation.note(balance);
        }
        if let Some(limit) = limit {
            limit.spend(1);
        }
        match &last {
            Ok(balance) if keeps_law(balance) => {
                let forces = iteration >= MAX_FOR_FORCES || are_forces_right(balance);
                let forces = forces && is_momentum_right(balance);
                let motors = are_motors_right(balance);
                if is_dissipation_right(balance) && forces && closes(balance) && is_consistent(balance) && motors {
                    let least = CONSISTENCY * (balance.impulse / h - balance.forces);
                    if balance.near && renewals <= MAX_RENEWALS && system.renew_friction(least) {
                        renewals += 1;
                        if renewals <= MAX_RENEWALS {
                            (renewed, most) = (iteration, iteration + MAX_ITERATIONS_NEAR);
                            relaxation.restart();
                            (fresh, imbalance) = (true, f64::INFINITY);
                            continue;
                        }
                    }
                    misses = Some(system.add_missed());
                    if misses == Some(false) || searches == MAX_SEARCHES {
                        break;
                    }
                    misses = None;
                    (searches, most) = (searches + 1, renewed + MAX_ITERATIONS_NEAR);
                    (fresh, imbalance) = (true, f64::INFINITY);
                    continue;
                }
                fresh = balance.near || !closes(balance) || !motors || balance.imbalance > MAX_LEFT * imbalance;
                imbalance = balance.imbalance;
            }
            Ok(balance) if balance.excess().is_finite() => fresh = true,
            _ => break,
        }
        if last.as_ref().is_ok_and(|balance| balance.near || balance.slip[1] > 0.0) {
            most = renewed + MAX_ITERATIONS_NEAR;
        }
    }
    if renewals > MAX_RENEWALS {
        system.count(Event::Lagging);
    }
    let reduced = limit.is_some_and(WorkLimit::reduces);
    let crosses = last.as_ref().is_ok_and(|balance| balance.excess().is_finite())
        && (system.crosses() || misses.unwrap_or_else(|| system.add_missed()));
    let stops = last.as_ref().is_ok_and(|balance| balance.stops);
    let gives_back = last.as_ref().is_ok_and(gives_back);
    let may_end = !(crosses || stops || gives_back) || depth == MAX_DEPTH || reduced;
    if let Ok(balance) = &last
        && keeps_law(balance)
        && (is_dissipation_right(balance) && closes(balance) && is_consistent(balance) && are_motors_right(balance)
            || depth == MAX_DEPTH)
        && may_end
    {
        return accept(system, balance, limit, crosses);
    }
    let largest_share = if reduced { 1.0 } else { SHARE_OF_HALF_THE_ENERGY };
    if let Ok(balance) = &mut last
        && is_certain(balance)
        && (is_consistent(balance)
            && are_motors_right(balance)
            && is_almost_solved(balance)
            && is_momentum_right(balance)
            || depth == MAX_DEPTH
            || reduced)
        && balance.to_take() > 0.0
        && may_end
        && system.rescale(balance, largest_share)
    {
        system.count(Event::Rescaled);
        return accept(system, balance, limit, crosses);
    }
    if reduced
        && let Ok(balance) = &last
        && keeps_law(balance)
    {
        return accept(system, balance, limit, crosses);
    }
    if reduced && limit.is_some_and(WorkLimit::stops) {
        return Ok(false);
    }
    if depth == MAX_DEPTH {
        let balance = last?;
        return Err(StepFailure::EnergyMade { energy: balance.excess(), scale: balance.scale() });
    }
    divide(system, h, depth, limit)
}

/// Advances the system by `h` (s) in [`PARTS`] steps. The one after a step that had to be divided is divided without a try: what kept the iteration
/// from its end, a cable that kinks most often, goes on, and a try in vain costs more than four short steps.
fn divide(
    system: &mut dyn DiscreteGradientSystem,
    h: f64,
    depth: usize,
    limit: Option<&WorkLimit>,
) -> Result<bool, StepFailure> {
    system.count(Event::Split);
    let (part, depth) = (h / PARTS as f64, depth + 1);
    let mut at_once = false;
    for _ in 0..PARTS {
        let before = system.splits();
        let advance = if at_once { divide } else { step };
        if !advance(system, part, depth, limit)? {
            return Ok(false);
        }
        at_once = !at_once && depth < MAX_DEPTH && system.splits() > before;
    }
    Ok(true)
}
