//! Reels, sheaves and drums as a term of a step. Equations: `system/reel/law.rs`, `wheel.rs` and
//! `drum.rs`.
//!
//! Their verdicts: motors, sheaves and drums must have the forces of their laws, to 1e-3. With
//! stock of a reel on a body that moves freely the sum of all impulses must balance, to 1e-9 of
//! them, or velocities are not scaled down. A step in which the friction of a sheave stops it from
//! running is divided: a long step may have such a solution beside the one that runs on, and
//! Newton's iteration end there.

use super::IslandStep;
use crate::scales::reel::DRIFT_TOLERANCE;
use crate::system::CableStep;
use crate::term::{Account, Balance, Reason, Stage, StepStart, StepTerm, Verdict};

/// What moves material through the ends of cables.
pub(super) struct Reels;

impl StepTerm<IslandStep<'_, '_>> for Reels {
    fn name(names: &mut Vec<&'static str>) {
        names.push("reels");
    }

    fn begin(island: &mut IslandStep<'_, '_>, step: &StepStart) {
        for cable in island.cables.iter_mut() {
            let CableStep { mut equations, state, .. } = cable.step_parts();
            equations.begin_laws(state.time, step.h);
        }
        island.begin_wheels(step.h);
        island.begin_drums(step.h);
    }

    fn evaluate(island: &mut IslandStep<'_, '_>) {
        let h = island.cables[0].step_buffers.h;
        let (winches, rows) = (&island.buffers.unknowns.winches, &mut island.buffers.rows);
        winches.iter().for_each(|winch| winch.pass(winch.force, h, rows));
    }

    fn balance(island: &mut IslandStep<'_, '_>, balance: &mut Balance) {
        island.balance_wheels(balance);
    }

    fn verdict(island: &IslandStep<'_, '_>, balance: &Balance, stage: Stage) -> Verdict {
        if !balance.of(Account::Reels).is_consistent(balance.weight) {
            Verdict::Iterate(Reason::ReelLaws)
        } else if stage != Stage::Ended && island.drift() > DRIFT_TOLERANCE * balance.impulse {
            Verdict::Iterate(Reason::StockMomentum)
        } else {
            Verdict::Accept
        }
    }

    fn inspect(island: &mut IslandStep<'_, '_>, _: &Balance) -> Verdict {
        if island.do_sheaves_stop() { Verdict::Divide(Reason::SheaveStops) } else { Verdict::Accept }
    }

    fn accept(island: &mut IslandStep<'_, '_>) {
        island.accept_wheels();
    }
}

impl IslandStep<'_, '_> {
    /// Returns the sum over the axes of the impulse in N s that the residual leaves unbalanced in
    /// all; zero unless stock of a reel rides with a body that moves freely.
    fn drift(&self) -> f64 {
        if !self.cables.iter().any(|cable| cable.system.feeds.are_closed()) {
            return 0.0;
        }
        let mut drift = [0.0_f64; 3];
        let of_cables = self.cables.iter().flat_map(|cable| cable.step_buffers.rhs.chunks_exact(6));
        for row in of_cables.chain(self.buffers.rows.chunks_exact(6)) {
            (0..3).for_each(|x| drift[x] += row[x]);
        }
        drift.iter().map(|x| x.abs()).sum()
    }
}
