//! Contacts of the cables of an island, with obstacles, bodies and each other, as a term of a step.
//!
//! Their verdicts: contact forces must be those of the linear solve, to 1e-3 in sum. When the
//! iteration has ended, bounds of friction follow the normal forces of the step itself (lag.rs), up
//! to forty times; then contacts with thin and sharp parts of obstacles are looked for again, and
//! the iteration goes on with those that were missed, up to three times. A step is divided in which
//! some are missed still, in which the centre lines of cables that may touch go through each other,
//! or through such parts, or in which contacts that close offsets give back more than they take;
//! parts of a step close none. In the last division what went through is counted, and a warning
//! says so.

use super::IslandStep;
use super::rounds::ContactRounds;
use crate::contact::{ContactStep, Crossed, Place};
use crate::scales::island::{MAX_RENEWALS, MAX_SEARCHES};
use crate::scales::term::CONSISTENCY;
use crate::system::CableStep;
use crate::term::{Account, Balance, Reason, Settled, Stage, StepStart, StepTerm, Verdict};
use crate::watch::Through;

/// All contacts.
pub(super) struct Contacts;

impl StepTerm<IslandStep<'_, '_>> for Contacts {
    fn name(names: &mut Vec<&'static str>) {
        names.push("contacts");
    }

    fn begin(island: &mut IslandStep<'_, '_>, step: &StepStart) {
        island.buffers.rounds = ContactRounds::default();
        for cable in island.cables.iter_mut() {
            let CableStep { equations, state, buffers } = cable.step_parts();
            equations.find_contacts(state, buffers, (&island.buffers.paths, !step.divided));
            let tests = buffers.contact.take_tests();
            cable.diagnostics_mut().search_tests += tests;
        }
        island.find_pairs((step.h, step.leg), step.divisible);
    }

    fn evaluate(island: &mut IslandStep<'_, '_>) {
        island.buffers.rounds.pairs = island.balance_pairs();
    }

    fn balance(island: &mut IslandStep<'_, '_>, balance: &mut Balance) {
        if let Some(pairs) = &island.buffers.rounds.pairs {
            let first = &mut *island.cables[0];
            pairs.add_to(balance, first.step_buffers.h);
            first.system.meter.work_of_step.contact += pairs.work;
        }
    }

    fn verdict(_: &IslandStep<'_, '_>, balance: &Balance, _: Stage) -> Verdict {
        if balance.of(Account::Contacts).is_consistent(balance.weight) {
            Verdict::Accept
        } else {
            Verdict::Iterate(Reason::ContactForces)
        }
    }

    fn settle(island: &mut IslandStep<'_, '_>, balance: &Balance) -> Settled {
        let rounds = island.buffers.rounds;
        let others = balance.impulse / island.cables[0].step_buffers.h - balance.of(Account::Contacts).forces;
        if balance.nonsmooth && rounds.renewals <= MAX_RENEWALS && island.renew_friction(CONSISTENCY * others) {
            island.buffers.rounds.renewals += 1;
            if rounds.renewals < MAX_RENEWALS {
                return Settled::Renewed(Reason::FrictionBounds);
            }
            island.count_lagging();
        }
        let missed = island.add_missed();
        if missed && rounds.searches < MAX_SEARCHES {
            island.buffers.rounds.searches += 1;
            return Settled::Extended(Reason::LateContacts);
        }
        island.buffers.rounds.missed = Some(missed);
        Settled::Stays
    }

    fn inspect(island: &mut IslandStep<'_, '_>, balance: &Balance) -> Verdict {
        let crosses = island.crosses();
        let known = island.buffers.rounds.missed;
        let missed = !crosses && known.unwrap_or_else(|| island.add_missed());
        island.buffers.rounds.passes = crosses || missed;
        if crosses {
            Verdict::Divide(Reason::PassesThrough)
        } else if missed {
            Verdict::Divide(Reason::LateContacts)
        } else if island.given_back() > balance.tolerance() {
            Verdict::Divide(Reason::ContactsGive)
        } else {
            Verdict::Accept
        }
    }

    fn finish(island: &mut IslandStep<'_, '_>, balance: &mut Balance) {
        if balance.nonsmooth {
            let least = balance.tolerance();
            island.land_contacts(balance, least);
        }
    }

    fn accept(island: &mut IslandStep<'_, '_>) {
        if island.buffers.rounds.passes {
            island.count_crossed();
        }
        island.remember_pairs();
    }
}

impl IslandStep<'_, '_> {
    /// Sets the bounds of friction by the present normal forces, of cables that miss them, and of
    /// contacts between cables if those do, if all miss them by more than `least` (N); returns
    /// whether they did.
    fn renew_friction(&mut self, least: f64) -> bool {
        let on_obstacles: f64 = self.cables.iter_mut().map(|cable| cable.step_buffers.contact.find_lag()).sum();
        let pairs = &mut self.buffers.pairs;
        let missed = on_obstacles + pairs.find_lag();
        pairs.lags &= missed > least;
        let mut any = pairs.lags;
        if pairs.lags {
            pairs.renew_friction();
        }
        for cable in self.cables.iter_mut() {
            let contact = &mut cable.step_buffers.contact;
            contact.lags &= missed > least;
            if contact.lags {
                contact.renew_friction();
            }
            any |= contact.lags;
        }
        any
    }

    /// Adds contacts with what the iterate entered although they were not found before; returns
    /// whether there are any.
    fn add_missed(&mut self) -> bool {
        // each cable, although one will do
        self.cables.iter_mut().fold(false, |any, cable| {
            let CableStep { equations, state, buffers } = cable.step_parts();
            equations.add_missed_contacts(state, buffers) || any
        })
    }

    /// Returns whether centre lines of cables go through each other, or through thin parts of
    /// obstacles, in the step.
    fn crosses(&mut self) -> bool {
        let passes = self.cables.iter_mut().fold(false, |any, cable| {
            let CableStep { equations, state, buffers } = cable.step_parts();
            equations.passes_obstacles(state, buffers) || any
        });
        self.do_pairs_cross() || passes
    }

    /// Returns the energy in J that contacts with obstacles give back of what they lost before.
    fn given_back(&self) -> f64 {
        self.cables.iter().map(|cable| (-cable.step_buffers.lost).max(0.0)).sum()
    }

    /// Counts a step in which something goes through something else, for the cables that do.
    fn count_crossed(&mut self) {
        let crossed = self.buffers.pairs.crossed();
        for c in 0..self.cables.len() {
            let ContactStep { passed, missed, .. } = self.cables[c].step_buffers.contact;
            let of_obstacle =
                || passed.or(missed).map(|Place { arc_length, obstacle }| (arc_length, Through::Obstacle(obstacle)));
            let Some((arc_length_m, through)) = self.passed_cable(c, crossed).or_else(of_obstacle) else { continue };
            self.cables[c].count_passage(arc_length_m, through);
        }
    }

    /// Returns the arc length in m at which a cable went through another one or itself, and what
    /// that is.
    fn passed_cable(&self, c: usize, crossed: Option<Crossed>) -> Option<(f64, Through)> {
        let Crossed { strands, arcs } = crossed?;
        let own = strands.iter().position(|strand| *strand == c)?;
        let other = strands[1 - own];
        let through = if other == c { Through::Itself } else { Through::Cable(self.cables[other].name().to_string()) };
        Some((arcs[own], through))
    }

    /// Counts a step whose friction does not settle on the normal forces of the step itself.
    fn count_lagging(&mut self) {
        let pairs = &self.buffers.pairs;
        for (c, cable) in self.cables.iter_mut().enumerate() {
            let lags = cable.step_buffers.contact.lags || pairs.lags && pairs.has(c);
            cable.diagnostics_mut().lagging_steps += u64::from(lags);
        }
    }
}
