//! The trait of a term of a step, and lists of terms.

use super::balance::Balance;
use super::verdict::{Reason, Verdict};
use crate::one_leg::OneLeg;

/// The step that begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepStart {
    /// Its length in s.
    pub h: f64,
    /// Its formula.
    pub leg: OneLeg,
    /// Whether it is part of a step that was divided.
    pub divided: bool,
    /// Whether it may be divided in turn.
    pub divisible: bool,
    /// Share of the motion by which momenta may be off at its end.
    pub may_owe: f64,
}

/// What a verdict is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Whether to iterate.
    Iterating,
    /// Whether the last iterate can be accepted although no other follows.
    Ended,
    /// Whether it can be accepted if velocities are scaled down.
    Rescaling,
}

/// What a term made of its law when an iterate was accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Settled {
    /// Nothing: the iteration has ended.
    Stays,
    /// Its law has other parameters: the iteration begins anew.
    Renewed(Reason),
    /// It acts at more places: the iteration goes on.
    Extended(Reason),
}

/// Something that acts in a step of the system `S`: it has no data but those of the system. What it
/// does not say is that of a term that is absent. A pair of terms is a term, so a list of them is
/// `(A, (B, (C, D)))`, dispatched statically.
pub(crate) trait StepTerm<S: ?Sized> {
    /// Adds its name to a list of all, by which tests of all terms ask for it.
    fn name(names: &mut Vec<&'static str>);

    /// Begins a host step.
    fn begin_host_step(_: &mut S) {}

    /// Begins a step: sets the first iterate.
    fn begin(_: &mut S, _: &StepStart) {}

    /// Evaluates at the present iterate what others need before they are
    /// [balanced](StepTerm::balance).
    fn evaluate(_: &mut S) {}

    /// Adds its part of the residual and of the matrix where the equations are made linear at the
    /// present iterate; those of the cables are there.
    fn linearise(_: &mut S) {}

    /// Adds its part of the residual and of the energy law of the present iterate.
    fn balance(_: &mut S, _: &mut Balance) {}

    /// Judges the present iterate; asked only if the general tests accept it.
    fn verdict(_: &S, _: &Balance, _: Stage) -> Verdict {
        Verdict::Accept
    }

    /// Changes its law for this step by an iterate that was accepted.
    fn settle(_: &mut S, _: &Balance) -> Settled {
        Settled::Stays
    }

    /// Looks for what no iteration makes good, when the iteration has ended.
    fn inspect(_: &mut S, _: &Balance) -> Verdict {
        Verdict::Accept
    }

    /// Takes what must not be left when the accepted step ends.
    fn finish(_: &mut S, _: &mut Balance) {}

    /// Judges the end of the step, when all have taken from it what they take.
    fn examine(_: &mut S, _: &mut Balance) -> Verdict {
        Verdict::Accept
    }

    /// Makes the end of the step the present state. The last term of a list is the first.
    fn accept(_: &mut S) {}
}

impl<S: ?Sized, A: StepTerm<S>, B: StepTerm<S>> StepTerm<S> for (A, B) {
    fn name(names: &mut Vec<&'static str>) {
        A::name(names);
        B::name(names);
    }

    fn begin_host_step(system: &mut S) {
        A::begin_host_step(system);
        B::begin_host_step(system);
    }

    fn begin(system: &mut S, step: &StepStart) {
        A::begin(system, step);
        B::begin(system, step);
    }

    fn evaluate(system: &mut S) {
        A::evaluate(system);
        B::evaluate(system);
    }

    fn linearise(system: &mut S) {
        A::linearise(system);
        B::linearise(system);
    }

    fn balance(system: &mut S, balance: &mut Balance) {
        A::balance(system, balance);
        B::balance(system, balance);
    }

    fn verdict(system: &S, balance: &Balance, stage: Stage) -> Verdict {
        match A::verdict(system, balance, stage) {
            Verdict::Accept => B::verdict(system, balance, stage),
            verdict => verdict,
        }
    }

    fn settle(system: &mut S, balance: &Balance) -> Settled {
        match A::settle(system, balance) {
            Settled::Stays => B::settle(system, balance),
            settled => settled,
        }
    }

    fn inspect(system: &mut S, balance: &Balance) -> Verdict {
        // each looks, also for its counts
        let (first, second) = (A::inspect(system, balance), B::inspect(system, balance));
        if first == Verdict::Accept { second } else { first }
    }

    fn finish(system: &mut S, balance: &mut Balance) {
        A::finish(system, balance);
        B::finish(system, balance);
    }

    fn examine(system: &mut S, balance: &mut Balance) -> Verdict {
        match A::examine(system, balance) {
            Verdict::Accept => B::examine(system, balance),
            verdict => verdict,
        }
    }

    fn accept(system: &mut S) {
        B::accept(system);
        A::accept(system);
    }
}
