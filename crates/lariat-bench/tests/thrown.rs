//! The section of thrown cables: no energy is made, and the cost of an undamped pendulum stays.

use lariat_bench::report::thrown::{minute, run};

/// *Source.* The energy law, read from the cables' energies.
#[test]
fn fresh_thrown_cables_keep_the_energy_law() {
    let seeds = 900_000..900_150;
    let (calm, thrown) = (run(seeds.clone(), false).unwrap(), run(seeds, true).unwrap());
    for tally in [&calm, &thrown] {
        println!("{tally:?}");
        assert_eq!(tally.refused, 0);
    }
    assert!(thrown.broken.unwrap() < 1e-9, "{:?}", thrown.broken);
    assert!(thrown.counts.factorisations > calm.counts.factorisations);
}

/// *Source.* The motion is periodic but for what the method loses, so its cost cannot grow.
#[test]
fn an_undamped_pendulum_costs_the_same_after_a_minute() {
    let seconds = minute(20).unwrap();
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    println!("{seconds:?}");
    assert!(mean(&seconds[50..]) <= 1.1 * mean(&seconds[..10]));
}
