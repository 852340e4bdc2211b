//! Every iteration and every division of a step has a reason, which is counted.

use crate::chain::Chain;
use crate::recipe::{Scene, disturb, scene};
use lariat_ancf::{Diagnostics, Method, ReasonCounts};

/// Returns the number of iterations that steps and reasons account for: one for each step that was
/// tried, of which a division makes four, but for those that are divided at once.
fn accounted(d: &Diagnostics) -> u64 {
    d.steps + 4 * d.split_steps - d.divisions_for.like_the_last + d.iterations_for.total()
}

/// Adds the counts of thrown cables, or of chains of cables and bodies.
fn thrown(chains: bool) -> Diagnostics {
    let mut sum = Diagnostics::default();
    for seed in 20_000..20_030 {
        let rule = "projected-3".parse().unwrap();
        let counts = if chains {
            let mut chain = Chain::new(seed, rule, 1.0 / 60.0);
            (0..18).for_each(|_| chain.step(1.0 / 60.0).unwrap());
            *chain.cables[0].diagnostics()
        } else {
            let Scene { mut cable, disturbance, .. } = scene(seed, rule, Method::DiscreteGradient, 1.0 / 60.0);
            for step in 0..18 {
                if step == 9 {
                    disturb(&mut cable, disturbance);
                }
                cable.step(1.0 / 60.0).unwrap();
            }
            *cable.diagnostics()
        };
        assert_eq!((counts.newton_iterations, counts.split_steps), (accounted(&counts), counts.divisions_for.total()));
        sum += counts;
    }
    sum
}

/// Reasons account for all iterations and divisions of cables that are thrown; terms that are
/// absent ask for none.
///
/// *Source.* Counting: the definition of the counters. Contacts and reels are absent.
#[test]
fn reasons_account_for_all_iterations_and_divisions() {
    for chains in [false, true] {
        let sum = thrown(chains);
        println!("{:?}\n{:?}", sum.iterations_for, sum.divisions_for);
        let of_the_sum = ["makes_energy", "uncertain", "loses_energy", "hides_energy", "unbalanced"];
        let general = |counts: &ReasonCounts, also: &[&str]| {
            let known = |key: &str| of_the_sum.contains(&key) || also.contains(&key);
            counts.by_key().filter(|(key, _)| known(key)).map(|(_, count)| count).sum::<u64>()
        };
        let iterations = (general(&sum.iterations_for, &[]), sum.iterations_for.total());
        let divisions =
            (general(&sum.divisions_for, &["not_solved", "like_the_last", "owed_momentum"]), sum.divisions_for.total());
        assert!(iterations.0 == iterations.1 && iterations.1 > 100, "{iterations:?}");
        assert!(divisions.0 == divisions.1 && divisions.1 > 10, "{divisions:?}");
        assert!(sum.divisions_for.like_the_last < sum.split_steps);
    }
}
