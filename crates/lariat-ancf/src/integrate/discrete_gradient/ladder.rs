//! One step, by the cheapest means that keep its energy law.
//!
//! 1. One Newton iteration, accepted if it makes at most 1e-9 of the energy of the system.
//! 2. Up to eight, as long as each makes less than half of the energy that the one before made.
//! 3. Velocities relative to rigid motion are scaled down, if that takes at most half of their energy; momenta stay.
//! 4. Four steps of a quarter, each by the same means.

use super::law::{Balance, Event, SecantSystem};
use crate::error::StepFailure;

/// Share of the energy of the system that a step may make.
const TOLERANCE: f64 = 1e-9;
/// Rounding error of the energy law as a share of its terms.
const ROUNDING: f64 = 1e-13;
/// Largest number of Newton iterations.
const MAX_ITERATIONS: usize = 8;
/// Largest ratio of energies made by successive iterations that converge.
const CONTRACTION: f64 = 0.5;
/// Number of parts into which a step is divided.
const PARTS: usize = 4;
/// Largest number of divisions of divisions.
const MAX_DEPTH: usize = 6;

/// Returns whether a step keeps the law, beyond doubt by rounding.
fn keeps_law(balance: &Balance) -> bool {
    let allowed = TOLERANCE * balance.scale();
    balance.excess() <= allowed && ROUNDING * (balance.numerical + balance.residual.abs()) <= allowed
}

/// Advances the system by `h` (s).
///
/// # Errors
/// If a step of h/4^6 neither keeps its energy law nor can be made to.
pub(super) fn step(system: &mut dyn SecantSystem, h: f64, depth: usize) -> Result<(), StepFailure> {
    system.predict(h);
    let mut last = Err(StepFailure::NotConverged { iterations: 0, increment: 0.0 });
    let mut made = f64::INFINITY;
    for _ in 0..super::KNOBS.iterations as usize {
        last = system.iterate();
        if std::env::var("TRACE").is_ok() { match &last { Ok(b) => println!("  depth {depth} h {h:.2e} t {:.5}: residual {:.2e} num {:.2e} sup {:.2e} scale {:.2e}", system.time(), b.residual, b.numerical, b.supports, b.scale()), Err(e) => println!("  depth {depth} h {h:.2e} {e}") } }
        match &last {
            Ok(balance) if keeps_law(balance) => {
                system.accept(balance);
                return Ok(());
            }
            Ok(balance) if balance.excess().is_finite() => made = balance.excess().abs(),
            _ => break,
        }
    }
    if super::KNOBS.rescale > 0.0
        && let Ok(balance) = &mut last
        && ROUNDING * (balance.numerical + balance.residual.abs()) <= TOLERANCE * balance.scale()
        && system.rescale(balance)
    {
        system.count(Event::Rescaled);
        system.accept(balance);
        return Ok(());
    }
    if depth == super::KNOBS.depth as usize {
        let balance = last?;
        return Err(StepFailure::EnergyMade { energy: balance.excess(), scale: balance.scale() });
    }
    system.count(Event::Split);
    for _ in 0..PARTS {
        step(system, h / PARTS as f64, depth + 1)?;
    }
    Ok(())
}
