//! Thrown cables: no step is refused, and no energy is made.

use crate::chain::Chain;
use crate::law::{energies, work};
use crate::recipe::{disturb, scene};
use lariat_ancf::{Method, Rule};

/// What a run of many scenes did.
#[derive(Debug, Default)]
pub struct Tally {
    pub scenes: u64,
    pub refused: Vec<(u64, String)>,
    /// Most by which the energy law was broken in a host step, as a share of the largest kinetic and strain energy.
    pub broken: f64,
    /// Most by which the mechanical energy rose.
    pub rise: f64,
    pub host_steps: u64,
    pub steps: u64,
    pub iterations: u64,
    pub rescaled: u64,
    pub split: u64,
    pub indefinite: u64,
    pub worst_host_step: u64,
    pub lost: f64,
}


/// Runs scenes by host steps of 1/60 s for 0.6 s.
pub fn run(seeds: std::ops::Range<u64>, rule: Rule, longest: f64) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let crate::recipe::Scene { mut cable, disturbance, driven } = scene(seed, rule, Method::DiscreteGradient, longest);
        tally.scenes += 1;
        let (mut largest, mut broken, mut rise, mut rose_from) = (0.0f64, 0.0f64, 0.0f64, f64::INFINITY);
        // the first host step puts supports in place
        for step in 0..36 {
            if step == 9 {
                disturb(&mut cable, disturbance);
                rose_from = f64::INFINITY;
            }
            let ([before, scale], work_before) = (energies(&cable), work(&cable));
            let counts = *cable.diagnostics();
            largest = largest.max(scale);
            if let Err(error) = cable.step(1.0 / 60.0) {
                tally.refused.push((seed, error.to_string()));
                break;
            }
            let [after, scale] = energies(&cable);
            largest = largest.max(scale);
            // a step after a change puts supports in place
            if step != 0 && step != 9 {
                broken = broken.max(after - before - (work(&cable) - work_before));
            }
            let energy = cable.energy().total();
            if !driven {
                rose_from = rose_from.min(energy);
                rise = rise.max(energy - rose_from);
            }
            let done = cable.diagnostics().since(&counts);
            tally.worst_host_step = tally.worst_host_step.max(done.newton_iterations);
        }
        let counts = cable.diagnostics();
        if broken / largest > 1e-9 { println!("seed {seed}: law broken by {:.2e} of {largest:.2e} J", broken / largest); }
        tally.broken = tally.broken.max(broken / largest);
        tally.rise = tally.rise.max(rise / largest);
        tally.host_steps += counts.host_steps;
        tally.steps += counts.steps;
        tally.iterations += counts.newton_iterations;
        tally.rescaled += counts.rescaled_steps;
        tally.split += counts.split_steps;
        tally.indefinite += counts.indefinite_factorisations;
    }
    tally
}


/// Runs chains of ropes and bodies likewise.
pub fn run_chains(seeds: std::ops::Range<u64>, rule: Rule, longest: f64) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let mut chain = Chain::new(seed, rule, longest);
        tally.scenes += 1;
        let (mut largest, mut broken) = (0.0f64, 0.0f64);
        for step in 0..36 {
            if step == 9 {
                chain.disturb(seed);
            }
            let [before, scale] = chain.energies();
            let counts = chain.cables[0].diagnostics().newton_iterations;
            largest = largest.max(scale);
            if let Err(error) = chain.step(1.0 / 60.0) {
                tally.refused.push((seed, error.to_string()));
                break;
            }
            let [after, scale] = chain.energies();
            largest = largest.max(scale);
            // pinned nodes take the velocities of their bodies in the first step, and after a blow
            if step != 0 && step != 9 {
                broken = broken.max(after - before);
            }
            tally.worst_host_step = tally.worst_host_step.max(chain.cables[0].diagnostics().newton_iterations - counts);
        }
        if broken / largest > 1e-9 {
            println!("seed {seed}: law broken by {:.2e} of {largest:.2e} J", broken / largest);
        }
        tally.broken = tally.broken.max(broken / largest);
        let counts = chain.cables[0].diagnostics();
        tally.host_steps += counts.host_steps;
        tally.steps += counts.steps;
        tally.iterations += counts.newton_iterations;
        tally.rescaled += counts.rescaled_steps;
        tally.split += counts.split_steps;
        tally.indefinite += counts.indefinite_factorisations;
    }
    tally
}

#[test]
fn explore() {
    let number = |name: &str, default: u64| std::env::var(name).map_or(default, |s| s.parse().unwrap());
    let (from, seeds) = (number("FROM", 0), number("SEEDS", 200));
    let rules = std::env::var("RULES").unwrap_or("projected-T1,projected-3,projected-none,ST2,G5-3".to_string());
    for rule in rules.split(',') {
        for longest in [1.0 / 240.0, 1.0 / 480.0] {
            for chains in [false, true] {
                let start = std::time::Instant::now();
                let range = from..from + seeds;
                let t = if chains { run_chains(range, rule.parse().unwrap(), longest) } else { run(range, rule.parse().unwrap(), longest) };
                println!(
                    "{rule} 1/{:.0} {}: refused {:?} broken {:.1e} rise {:.1e} iterations/step {:.3} rescaled {} split {} indefinite {} of {} steps, worst host step {}, {:.1} s",
                    1.0 / longest, if chains { "chains" } else { "cables" }, t.refused, t.broken, t.rise,
                    t.iterations as f64 / t.steps as f64, t.rescaled, t.split, t.indefinite, t.steps, t.worst_host_step, start.elapsed().as_secs_f64()
                );
            }
        }
    }
}
