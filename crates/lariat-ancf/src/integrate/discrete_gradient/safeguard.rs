//! One step, by the cheapest means that keep its energy law.
//!
//! 1. One Newton iteration, accepted if its residual makes at most 1e-9 of the energy of the system beyond what the step loses, loses no
//!    more energy than the method does, and leaves at most 3 % of the impulses unbalanced.
//! 2. Up to eight, up to three for the last condition: with a new tangent if energy is made, else with the same factors.
//! 3. Velocities relative to rigid motion are scaled down, if that takes at most half of their energy; momenta stay.
//! 4. Four steps of a quarter, each by the same means.

use super::law::{Balance, DiscreteGradientSystem, Event};
use crate::error::StepFailure;

/// Share of the energy of the system that a step may make.
const TOLERANCE: f64 = 1e-9;
/// Share of the impulses of a step that may be unbalanced. The energy law alone lets errors of tension pass where the motion turns fast:
/// on a rotor, 0.13 rad per step, 20 N of 63.
const FORCE_TOLERANCE: f64 = 0.03;
/// Number of iterations after which the balance of impulses is no longer asked for: a slack cable has hardly any.
const MAX_FOR_FORCES: usize = 3;
/// Rounding error of the energy law as a share of its terms.
const ROUNDING: f64 = 1e-13;
/// Largest number of Newton iterations.
const MAX_ITERATIONS: usize = 8;
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
    -balance.residual <= balance.numerical + balance.effects + TOLERANCE * balance.scale()
}

/// Returns whether the residual leaves a small share of the impulses unbalanced.
fn are_forces_right(balance: &Balance) -> bool {
    balance.imbalance <= FORCE_TOLERANCE * balance.impulse
}

/// Returns whether the terms of the law are small enough for their sum to be known to the tolerance.
fn is_certain(balance: &Balance) -> bool {
    ROUNDING * (balance.numerical + balance.residual.abs()) <= TOLERANCE * balance.scale()
}

/// Advances the system by `h` (s).
///
/// # Errors
/// If a step of h/4^6 neither keeps its energy law nor can be made to.
pub(super) fn step(system: &mut dyn DiscreteGradientSystem, h: f64, depth: usize) -> Result<(), StepFailure> {
    system.predict(h);
    let mut last = Err(StepFailure::NotConverged { iterations: 0, increment: 0.0 });
    let mut fresh = true;
    for iteration in 1..=MAX_ITERATIONS {
        last = system.iterate(fresh);
        match &last {
            Ok(balance) if keeps_law(balance) => {
                if is_dissipation_right(balance) && (iteration >= MAX_FOR_FORCES || are_forces_right(balance)) {
                    break;
                }
                fresh = false;
            }
            Ok(balance) if balance.excess().is_finite() => fresh = true,
            _ => break,
        }
    }
    if let Ok(balance) = &last
        && keeps_law(balance)
    {
        system.accept(balance);
        return Ok(());
    }
    if let Ok(balance) = &mut last
        && is_certain(balance)
        && system.rescale(balance)
    {
        system.count(Event::Rescaled);
        system.accept(balance);
        return Ok(());
    }
    if depth == MAX_DEPTH {
        let balance = last?;
        return Err(StepFailure::EnergyMade { energy: balance.excess(), scale: balance.scale() });
    }
    system.count(Event::Split);
    for _ in 0..PARTS {
        step(system, h / PARTS as f64, depth + 1)?;
    }
    Ok(())
}
