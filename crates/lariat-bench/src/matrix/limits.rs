//! Why a scene differs from its finer run: it asks for finer steps, or it is sensitive.
//!
//! # Equation
//!
//! ```text
//! fine    |x(h/8) - x(h/32)| / D      what is left at an eighth of the host step; a method of the first order leaves
//!                                     (1/8 - 1/32)/(1 - 1/8) = 0.11 of what was missed
//! spread  |x(h/8) - x'(h/8)| / D      x' with velocities that are off by 1e-9 m/s
//! ```
//!
//! # Validity
//!
//! Neither changes what is a miss: they say what a miss is.

use super::draft::Draft;
use super::laws::{Ended, FINE, FINER, Plan, STEP, apart, built, finish};
use super::scene::Scene;
use crate::stability::outcome::Check;
use crate::stability::recipe::Recipe;
use lariat_ancf::Vector3;

/// What is left at an eighth of the host step, as a share of how far anything moved.
const LEFT: &str = "difference of dt/8 from dt/32";
/// How far runs part that begin with velocities which differ by [`ROUNDING`], as such a share.
const SPREAD: &str = "spread at dt/8";
/// Differences of velocities in m/s that are none in use.
const ROUNDING: f64 = 1e-9;

/// Measures why the run to `fine`, at an eighth of the host step, differs from that of the whole
/// one; `moved` is how far anything moved in m.
///
/// # Errors
/// [`Ended`].
pub fn measure(draft: &Draft, plan: Plan, fine: &[Vector3<f64>], moved: f64) -> Result<[Check; 2], Ended> {
    let mut finest = built(draft, plan, STEP / (4.0 * FINER))?;
    finish(&mut finest)?;
    let mut other = built(draft, plan, STEP / FINER)?;
    perturb(&mut other).map_err(|error| Ended::Failed(0.0, error.to_string()))?;
    finish(&mut other)?;
    let told = |quantity, scene: &Scene| {
        let value = apart(fine, &scene.positions()) / moved;
        Check::at_most(quantity, value, f64::INFINITY, "told, not judged")
    };
    Ok([told(LEFT, &finest), told(SPREAD, &other)])
}

/// Adds velocities of up to [`ROUNDING`] to all cables.
fn perturb(scene: &mut Scene) -> Result<(), lariat_rapier::Error> {
    let handles: Vec<_> = scene.set.iter().map(|(handle, _)| handle).collect();
    for (seed, handle) in (0..).zip(handles) {
        let cable = scene.set.get_mut(handle)?;
        let random = Recipe::from_seed(seed);
        let velocities = (0..).zip(cable.velocities()).map(|(i, v)| v + ROUNDING * random.signed(i % random.0.len()));
        let (positions, velocities) = (cable.positions().to_vec(), velocities.collect::<Vec<_>>());
        cable.set_coordinates(&positions, &velocities)?;
    }
    Ok(())
}

/// Says what was found; empty if nothing was looked for.
pub fn told(checks: &[Check]) -> String {
    let of = |quantity| checks.iter().find(|check| check.quantity == quantity).map(|check| check.value);
    match (of(LEFT), of(SPREAD)) {
        (Some(left), Some(spread)) if spread <= FINE => {
            let word = if left <= FINE { "asks for finer steps" } else { "not resolved at dt/8" };
            format!("{word}: dt/8 is {left:.3} off dt/32; not sensitive, 1e-9 m/s part it by {spread:.0e}")
        }
        (Some(left), Some(spread)) => {
            format!("sensitive: 1e-9 m/s part it by {spread:.3}; dt/8 is {left:.3} off dt/32")
        }
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* The contract.
    #[test]
    fn what_limits_a_scene_is_told_by_its_word() {
        let told_of = |left: f64, spread: f64| {
            told(&[(LEFT, left), (SPREAD, spread)].map(|(quantity, value)| Check::at_most(quantity, value, 1.0, "")))
        };
        assert!(told_of(0.01, 1e-8).starts_with("asks for finer steps: dt/8 is 0.010 off"));
        assert!(told_of(0.2, 1e-8).starts_with("not resolved at dt/8"));
        assert!(told_of(0.2, 0.3).starts_with("sensitive: "));
        // what is no number resolves nothing
        assert!(
            told_of(f64::NAN, 1e-8).starts_with("not resolved") && told_of(0.01, f64::NAN).starts_with("sensitive")
        );
        assert_eq!(told(&[]), "");
    }
}
