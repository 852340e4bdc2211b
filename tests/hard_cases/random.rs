//! Scenes drawn by chance from all families. A failing one is kept in `random.proptest-regressions` and run first.

use super::suite::check;
use lariat_bench::stability::Family;
use lariat_bench::stability::outcome::Outcome;
use lariat_bench::stability::recipe::{NUMBERS, Recipe};
use lariat_bench::stability::run_recipe;
use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed};

/// The first three hundred of the scenes of `lariat stability`: no energy made beyond the work put in, momentum kept where nothing external
/// acts, gaps closed; but for those that docs/stability.md lists.
///
/// *Source.* Conservation laws; the contract.
#[test]
fn random_scenes_keep_energy_and_momentum() {
    check(Family::Random);
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        max_shrink_iters: 200,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct("tests/hard_cases/random.proptest-regressions"))),
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    /// Never a panic, never a number that is not finite: success, or an error that names the culprit and leaves the last good state.
    ///
    /// *Source.* The contract.
    #[test]
    fn random_scenes_end_well_or_in_an_error(numbers in prop::array::uniform32(0.0..1.0f64)) {
        const { assert!(NUMBERS == 32) };
        let row = run_recipe(Recipe(numbers));
        let broken = matches!(row.outcome, Outcome::NotFinite | Outcome::Panicked(_) | Outcome::Failed(_));
        prop_assert!(!broken, "{}: {}: {}", row.host, row.outcome.word(), row.outcome.reason());
    }
}
