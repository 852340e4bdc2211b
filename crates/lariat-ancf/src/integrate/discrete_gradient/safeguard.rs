//! One step, by the cheapest means that keep its energy law.
//!
//! 1. One Newton iteration, accepted if its residual makes at most 1e-9 of the energy of the system
//!    beyond what the method loses and 1 % of what damping takes, loses no more energy than the
//!    method does, and leaves at most 1 % of the impulses unbalanced.
//! 2. Up to eight, after four with a tenth of the impulses of all and of each body: with the same
//!    factors where energy is not made and they bring the impulses nearer to balance, else with a
//!    new tangent.
//! 3. Velocities relative to rigid motion are scaled down, if that takes at most a hundredth of
//!    their energy, half in the last division and where a nonsmooth term acts, whose impulses are
//!    balanced to a tenth by then; momenta stay. A residual that makes more is far from a solution:
//!    the axial law of a rope that whips took 0.09 of all energy in a step.
//! 4. Four steps of a quarter, each by the same means; the one after a quarter that had to be
//!    divided in turn is divided at once.
//!
//! With a [limit](WorkLimit) to the work that is spent, one iteration is taken, rescaling may take
//! all of that energy, and instead of a division the step ends.
//!
//! Damping, friction and impact lose so much that any error of the iteration hides behind them: on
//! a rotor whose rope is damped, errors of the tension grow to a thousand times the tension. A step
//! is therefore accepted only if its energy balance *closes*, to 1 % of what they lose. Where a
//! term with corners in its law acts (nonsmooth, most often contact), it must close to 1 % of all
//! that the step loses; every iteration has a new tangent, up to 20 are taken, and those that swing
//! by halves (relaxation.rs). After those the balance alone must close, and bodies must have the
//! momentum that their forces give; in the last division the energy law alone must hold. A step
//! that is accepted so, or by rescaling, without that is *not solved*: it is counted, and its
//! contacts are said to have lost what the energy lost, not what their laws say.
//!
//! # Verdicts
//!
//! These tests are about the sum of all [terms](crate::term). What they accept each term judges in
//! turn: whether its forces are those of its law and of the linear solve, to 1e-3; and whether it
//! must change its law for this step, whereupon the iteration goes on. When the iteration has ended
//! a term may find what no iteration makes good; then the step is divided, but in the last
//! division. So it is where a term finds, when all have taken from the end of the step what they
//! take, that momentum is lost; up to three deep. Every iteration beyond the first and every
//! division is counted with its reason.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

use super::law::{DiscreteGradientSystem, Event};
use super::relaxation::Relaxation;
use crate::error::StepFailure;
use crate::integrate::WorkLimit;
use crate::one_leg::OneLeg;
use crate::scales::integrate::{
    ALPHA, CLOSURE_OF_WEIGHT, FORCE_TOLERANCE_OF_STEP, FORCE_TOLERANCE_UNDER_CONTROL, LARGEST_IMBALANCE, LAW_ROUNDING,
    MAX_DEPTH, MAX_DEPTH_OF_ENDS, MAX_FOR_FORCES, MAX_ITERATIONS_OF_LAWS, MAX_ITERATIONS_OF_STEP, MAX_LEFT,
    MOMENTUM_TOLERANCE_OF_STEP, MOMENTUM_TOLERANCE_UNDER_CONTROL, PARTS, SHARE_OF_A_HUNDREDTH_OF_THE_ENERGY,
    SHARE_OF_HALF_THE_ENERGY,
};
use crate::scales::term::CLOSURE;
use crate::term::{Balance, Reason, Settled, Stage, StepStart, Verdict};

/// Which error of a step is estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Estimate {
    /// None.
    No,
    /// That which a tolerance bounds: 0 where it is not known.
    Tolerance,
    /// That of all cables and bodies: infinite where it is not known.
    Pace,
}

/// What is demanded of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Demand<'a> {
    /// Its formula.
    pub leg: OneLeg,
    /// Share of the impulses that may be unbalanced.
    pub imbalance: f64,
    /// Share of the motion by which momenta may be off at the end.
    pub may_owe: f64,
    /// Number of iterations after which that is no longer asked for: a slack cable has hardly any.
    pub for_forces: usize,
    /// Largest estimated error in m.
    pub allowed: f64,
    /// Which error is estimated.
    pub estimate: Estimate,
    pub limit: Option<&'a WorkLimit>,
}

impl Demand<'_> {
    /// Of steps of fixed length. The energy law alone lets errors of tension pass where the motion
    /// turns fast: on a rotor, 0.13 rad per step, 20 N of 63.
    pub const FIXED: Self = Demand {
        leg: OneLeg::new(ALPHA),
        imbalance: FORCE_TOLERANCE_OF_STEP,
        may_owe: MOMENTUM_TOLERANCE_OF_STEP,
        for_forces: MAX_FOR_FORCES,
        allowed: f64::INFINITY,
        estimate: Estimate::No,
        limit: None,
    };
    /// Of steps whose error is controlled: what the iteration leaves is then below the estimate.
    pub const CONTROLLED: Self = Demand {
        imbalance: FORCE_TOLERANCE_UNDER_CONTROL,
        may_owe: MOMENTUM_TOLERANCE_UNDER_CONTROL,
        for_forces: MAX_ITERATIONS_OF_STEP,
        estimate: Estimate::Tolerance,
        ..Demand::FIXED
    };
}

/// What became of a step.
#[derive(Clone, Copy, Debug)]
pub(super) enum Advanced {
    /// It was taken, with this estimated error in m; 0 where that is not known.
    Whole(f64),
    /// It was not taken: its estimated error in m is too large.
    TooFar(f64),
    /// The limit ended it before.
    Ended,
}

/// Returns whether a step keeps the law, beyond doubt by rounding.
fn keeps_law(balance: &Balance) -> bool {
    balance.excess() <= balance.tolerance() && is_certain(balance)
}

/// Returns whether the terms of the law are small enough for their sum to be known to the
/// tolerance.
fn is_certain(balance: &Balance) -> bool {
    LAW_ROUNDING * (balance.losses() + balance.residual.abs()) <= balance.tolerance()
}

/// Returns whether the residual loses no more than method and terms do.
fn is_dissipation_right(balance: &Balance) -> bool {
    -balance.residual <= balance.losses() + balance.tolerance()
}

/// Returns whether the balance of a step closes: what terms take does not hide what the residual
/// makes. Where a nonsmooth one acts the dissipation of the method hides nothing either.
fn closes(balance: &Balance) -> bool {
    let tolerance = balance.tolerance();
    if balance.nonsmooth {
        let left = balance.residual - balance.rescaled;
        left <= CLOSURE * balance.losses() + tolerance.max(CLOSURE_OF_WEIGHT * balance.weight)
    } else {
        balance.surplus() <= tolerance
    }
}

/// Returns whether the residual leaves a small share of the impulses unbalanced.
fn are_forces_right(balance: &Balance, demand: &Demand<'_>) -> bool {
    balance.imbalance <= demand.imbalance * balance.impulse
}

/// Returns whether an iterate leaves at most a tenth of its impulses unbalanced.
fn is_almost_solved(balance: &Balance) -> bool {
    are_bodies_balanced(balance) && balance.imbalance <= LARGEST_IMBALANCE * (balance.impulse + balance.of_gravity)
}

/// Returns whether the bodies of an iterate have the momentum that their forces give, to a tenth.
/// The energy law alone lets one pass that a contact pushed in the linear solve and not in its law:
/// a ball of 0.8 kg lost half of its 4 m/s to nothing.
fn are_bodies_balanced(balance: &Balance) -> bool {
    balance.imbalance_of_bodies <= LARGEST_IMBALANCE
}

/// Returns whether the last iterate leaves no more unbalanced than a step may. The dissipation of
/// the method hides what is left of a jolt: a load had a sixth of the impulse of the rope that
/// stopped it, and an element read 14 kN between neighbours with 1 kN. Where a nonsmooth term acts
/// cables are not asked: where they are stiff, axial forces that balance each other are far larger
/// than all impulses.
fn is_balanced(balance: &Balance) -> bool {
    if balance.nonsmooth { are_bodies_balanced(balance) } else { is_almost_solved(balance) }
}

/// Returns whether rescaling may repair an iterate: not the momentum of bodies, nor a nonsmooth one
/// that is thrown to and fro.
fn is_rescalable(balance: &Balance) -> bool {
    if balance.nonsmooth { is_almost_solved(balance) } else { are_bodies_balanced(balance) }
}

/// Returns the verdict of the general tests about the energy.
fn judge_energy(balance: &Balance) -> Verdict {
    if balance.excess() > balance.tolerance() {
        Verdict::Iterate(Reason::MakesEnergy)
    } else if !keeps_law(balance) {
        Verdict::Iterate(Reason::Uncertain)
    } else if !is_dissipation_right(balance) {
        Verdict::Iterate(Reason::LosesEnergy)
    } else if !closes(balance) {
        Verdict::Iterate(Reason::HidesEnergy)
    } else {
        Verdict::Accept
    }
}

/// Returns the verdict about an iterate: first by the sum of all terms, then that of each.
fn judge<S: DiscreteGradientSystem>(
    system: &S,
    balance: &Balance,
    (iteration, demand): (usize, &Demand<'_>),
) -> Verdict {
    match judge_energy(balance) {
        Verdict::Accept if iteration < demand.for_forces && !are_forces_right(balance, demand) => {
            Verdict::Iterate(Reason::Unbalanced)
        }
        Verdict::Accept if !is_balanced(balance) => Verdict::Iterate(Reason::Unbalanced),
        Verdict::Accept => system.verdict(balance, Stage::Iterating),
        verdict => verdict,
    }
}

/// Iterates until a result is accepted, or no other may follow, and returns the last one.
fn iterate<S: DiscreteGradientSystem>(system: &mut S, demand: &Demand<'_>) -> Result<Balance, StepFailure> {
    let limit = demand.limit;
    let (mut fresh, mut most, mut begun) = (true, MAX_ITERATIONS_OF_STEP, 0);
    let (mut iteration, mut imbalance) = (0, f64::INFINITY);
    let mut relaxation = Relaxation::new();
    loop {
        iteration += 1;
        let outcome = system.iterate(fresh, relaxation.share);
        if let Ok(balance) = &outcome {
            relaxation.note(balance);
        }
        limit.into_iter().for_each(|limit| limit.spend(1));
        let balance = outcome?;
        if !balance.excess().is_finite() {
            return Ok(balance);
        }
        let reason = match judge(system, &balance, (iteration, demand)) {
            Verdict::Accept => {
                let reason = match system.settle(&balance) {
                    Settled::Stays => return Ok(balance),
                    Settled::Renewed(reason) => {
                        begun = iteration;
                        relaxation.restart();
                        reason
                    }
                    Settled::Extended(reason) => reason,
                };
                most = begun + MAX_ITERATIONS_OF_LAWS;
                (fresh, imbalance) = (true, f64::INFINITY);
                reason
            }
            Verdict::Divide(_) => return Ok(balance),
            Verdict::Iterate(reason) => {
                fresh = !keeps_law(&balance)
                    || balance.nonsmooth
                    || !closes(&balance)
                    || !balance.is_consistent()
                    || balance.imbalance > MAX_LEFT * imbalance;
                if keeps_law(&balance) {
                    imbalance = balance.imbalance;
                }
                reason
            }
        };
        if balance.nonsmooth || balance.has_laws() {
            most = begun + MAX_ITERATIONS_OF_LAWS;
        }
        if iteration >= most || limit.is_some_and(WorkLimit::is_spent) {
            return Ok(balance);
        }
        system.count(Event::Iterated(reason));
    }
}

/// Makes the end of the step of `h` (s) the present state, if its error is not too large; divides
/// it where a term finds something there that shorter steps do not leave. What is not solved is
/// counted, and what its residual hides is not among the losses of contacts.
fn accept<S: DiscreteGradientSystem>(
    system: &mut S,
    (mut balance, solved): (Balance, bool),
    (h, depth): (f64, usize),
    demand: &Demand<'_>,
) -> Result<Advanced, StepFailure> {
    // the parts of a step are taken in any case
    let error = match demand.estimate {
        Estimate::Tolerance if depth == 0 => system.error(),
        Estimate::Pace if depth == 0 => system.estimate().unwrap_or(f64::INFINITY),
        _ => 0.0,
    };
    if error > demand.allowed {
        return Ok(Advanced::TooFar(error));
    }
    let verdict = system.finish(&mut balance);
    let may_divide = depth < MAX_DEPTH_OF_ENDS && !demand.limit.is_some_and(WorkLimit::is_spent);
    if let Some(reason) = verdict.reason().filter(|_| may_divide) {
        return divide(system, h, (depth, reason), demand);
    }
    if !solved {
        balance.take_hidden();
        // what a limit cut short is counted as that
        if !demand.limit.is_some_and(WorkLimit::is_spent) {
            system.count(Event::Unsolved);
        }
    }
    system.accept(balance);
    demand.limit.into_iter().for_each(WorkLimit::note_progress);
    Ok(Advanced::Whole(error))
}

/// Advances the system by `h` (s).
///
/// # Errors
/// If a step of h/4^6 neither keeps its energy law nor can be made to.
pub(super) fn step<S: DiscreteGradientSystem>(
    system: &mut S,
    h: f64,
    depth: usize,
    demand: &Demand<'_>,
) -> Result<Advanced, StepFailure> {
    let limit = demand.limit;
    // of the shortest step the energy law alone must hold
    let shortest = depth == MAX_DEPTH;
    system.predict(&StepStart {
        h,
        leg: demand.leg,
        divided: depth > 0,
        divisible: !shortest,
        may_owe: demand.may_owe,
    });
    let outcome = iterate(system, demand);
    let reduced = limit.is_some_and(WorkLimit::reduces);
    let mut reason = Reason::NotSolved;
    if let Ok(mut balance) = outcome
        && balance.excess().is_finite()
    {
        let found = system.inspect(&balance);
        let may_end = found == Verdict::Accept || shortest || reduced;
        let law = match judge_energy(&balance) {
            Verdict::Accept if !is_balanced(&balance) && (balance.nonsmooth || !shortest) => {
                Verdict::Iterate(Reason::Unbalanced)
            }
            Verdict::Accept => system.verdict(&balance, Stage::Ended),
            verdict => verdict,
        };
        let kept = keeps_law(&balance);
        if may_end && kept && (law == Verdict::Accept || shortest) {
            return accept(system, (balance, law == Verdict::Accept), (h, depth), demand);
        }
        let may_rescale = || {
            let right = is_rescalable(&balance) && system.verdict(&balance, Stage::Rescaling) == Verdict::Accept;
            right || shortest || reduced
        };
        let may_rescale = may_end && is_certain(&balance) && balance.surplus() > 0.0 && may_rescale();
        let largest_share = match () {
            () if reduced => 1.0,
            () if shortest || balance.nonsmooth => SHARE_OF_HALF_THE_ENERGY,
            () => SHARE_OF_A_HUNDREDTH_OF_THE_ENERGY,
        };
        if may_rescale && system.rescale(&mut balance, largest_share) {
            system.count(Event::Rescaled);
            let solved = closes(&balance) && (!balance.nonsmooth || are_bodies_balanced(&balance));
            return accept(system, (balance, solved), (h, depth), demand);
        }
        if reduced && kept {
            return accept(system, (balance, law == Verdict::Accept), (h, depth), demand);
        }
        reason = law.reason().or(found.reason()).unwrap_or(reason);
    }
    if reduced && limit.is_some_and(WorkLimit::stops) {
        return Ok(Advanced::Ended);
    }
    if shortest {
        let balance = outcome?;
        return Err(StepFailure::EnergyMade { energy: balance.excess(), scale: balance.scale() });
    }
    divide(system, h, (depth, reason), demand)
}

/// Advances the system by `h` (s) in [`PARTS`] steps. The one after a step that had to be divided
/// is divided without a try: what kept the iteration from its end, a cable that kinks most often,
/// goes on, and a try in vain costs more than four short steps.
fn divide<S: DiscreteGradientSystem>(
    system: &mut S,
    h: f64,
    (depth, reason): (usize, Reason),
    demand: &Demand<'_>,
) -> Result<Advanced, StepFailure> {
    system.count(Event::Divided(reason));
    let (part, depth) = (h / PARTS as f64, depth + 1);
    let mut at_once = false;
    for _ in 0..PARTS {
        let before = system.splits();
        let advanced = if at_once {
            divide(system, part, (depth, Reason::LikeTheLast), demand)?
        } else {
            step(system, part, depth, demand)?
        };
        if let Advanced::Ended = advanced {
            return Ok(advanced);
        }
        at_once = !at_once && depth < MAX_DEPTH && system.splits() > before;
    }
    Ok(Advanced::Whole(0.0))
}
