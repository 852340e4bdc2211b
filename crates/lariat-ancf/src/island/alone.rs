//! A cable alone by the discrete gradient: an island without bodies.

use super::discrete_gradient::{IslandStep, StepBuffers};
use super::layout::Layout;
use super::pin_accounts::PinAccounts;
use crate::cable::Cable;
use crate::integrate::step_control::{Counts, FailedStep};
use crate::integrate::{IntegratorRef, discrete_gradient};
use core::cell::RefCell;

/// What such a step overwrites.
#[derive(Debug, Default)]
struct Buffers {
    layout: Layout,
    accounts: PinAccounts,
    step: StepBuffers,
}

thread_local! {
    /// Those of a thread, as many as are lent at once.
    static POOL: RefCell<Vec<Buffers>> = const { RefCell::new(Vec::new()) };
}

/// Advances a cable in its workspace by `dt` (s), and returns the numbers of steps with the
/// outcome. After a failure the state is the last accepted one.
pub(crate) fn advance(cable: &mut Cable, integrator: IntegratorRef<'_>, dt: f64) -> (Counts, Result<(), FailedStep>) {
    let mut buffers = POOL.with_borrow_mut(Vec::pop).unwrap_or_default();
    let Buffers { layout, accounts, step } = &mut buffers;
    let cables = &mut [cable][..];
    layout.begin(cables, &[], &[], dt);
    accounts.begin(cables, layout);
    step.begin(layout);
    if cables[0].model.effects.torsion.is_some() {
        step.cables[0].start.copy_from(&cables[0].before);
    }
    let outcome =
        discrete_gradient::advance(&mut IslandStep { cables, layout, accounts, buffers: step }, integrator, dt);
    POOL.with_borrow_mut(|pool| pool.push(buffers));
    outcome
}
