//! Random scenes of all families end well or in an error that names the culprit. A failing one is
//! kept in `random.proptest-regressions` and run first.

use super::check::{long, tell};
use lariat_bench::stability::job::run_recipe;
use lariat_bench::stability::outcome::Outcome;
use lariat_bench::stability::recipe::{NUMBERS, Recipe};
use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed, TestRunner};

/// Scenes of the quick and of the long test.
const SCENES: [u32; 2] = [60, 500];

/// Never a panic, never a number that is not finite, never an error without a culprit or with a
/// changed state.
///
/// *Source.* The contract of `CableSet::step`.
#[test]
fn random_scenes_end_well_or_in_an_error() {
    let [quick, most] = SCENES;
    let cases = if long() { most } else { quick };
    let file = FileFailurePersistence::Direct("tests/hard_cases/random.proptest-regressions");
    let config = ProptestConfig {
        cases,
        max_shrink_iters: 200,
        failure_persistence: Some(Box::new(file)),
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    };
    let outcome = TestRunner::new(config).run(&prop::array::uniform32(0.0..1.0f64), |numbers| {
        const { assert!(NUMBERS == 32) };
        let row = run_recipe(Recipe(numbers));
        let broken = matches!(row.outcome, Outcome::NotFinite | Outcome::Panicked(_) | Outcome::Failed(_));
        prop_assert!(!broken, "{}: {}: {}", row.host, row.outcome.name(), row.outcome.details());
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    tell(&format!("random scenes that end well: {cases} runs, {} skipped", most - cases));
}
