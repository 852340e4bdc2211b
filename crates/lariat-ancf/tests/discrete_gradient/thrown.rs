//! Thrown cables: no step is refused, and no energy is made.

use crate::recipe::{disturb, scene};
use lariat_ancf::{Cable, Method, Rule};

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

fn energies(cable: &Cable) -> (f64, f64) {
    let energy = cable.energy();
    (energy.total(), energy.kinetic + energy.axial + energy.bending)
}

/// Runs scenes by host steps of 1/60 s for 0.6 s.
pub fn run(seeds: std::ops::Range<u64>, rule: Rule, longest: f64) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let crate::recipe::Scene { mut cable, disturbance, driven: _ } = scene(seed, rule, Method::DiscreteGradient, longest);
        tally.scenes += 1;
        let (mut largest, mut broken, mut rise, mut rose_from) = (0.0f64, 0.0f64, 0.0f64, f64::INFINITY);
        // the first host step puts supports in place
        for step in 0..36 {
            if step == 9 {
                disturb(&mut cable, disturbance);
                rose_from = f64::INFINITY;
            }
            let (before, scale) = energies(&cable);
            let (store, law, account) = (cable.energy_in_store(), *cable.energy_law(), *cable.effect_work());
            let counts = *cable.diagnostics();
            largest = largest.max(scale);
            if let Err(error) = cable.step(1.0 / 60.0) {
                tally.refused.push((seed, error.to_string()));
                break;
            }
            let (after, scale) = energies(&cable);
            largest = largest.max(scale);
            let work = cable.energy_law().supports - law.supports + cable.energy_law().loads - law.loads;
            let heat = cable.effect_work().dissipated() - account.dissipated();
            if step != 0 && step != 9 {
                broken = broken.max(after + cable.energy_in_store() - before - store - work + heat);
                rose_from = rose_from.min(before);
                if work == 0.0 { rise = rise.max(after - rose_from); }
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

#[test]
fn explore() {
    let seeds: u64 = std::env::var("SEEDS").map_or(200, |s| s.parse().unwrap());
    let from: u64 = std::env::var("FROM").map_or(0, |s| s.parse().unwrap());
    let rules = std::env::var("RULES").unwrap_or("projected-T1,projected-3,projected-none,ST2,G5-3".to_string());
    for rule in rules.split(',') {
        for longest in [1.0 / 240.0, 1.0 / 480.0] {
            let start = std::time::Instant::now();
            let t = run(from..from + seeds, rule.parse().unwrap(), longest);
            println!(
                "{rule} 1/{:.0}: refused {:?} broken {:.1e} rise {:.1e} iterations/step {:.3} rescaled {} split {} indefinite {} of {} steps, worst host step {} , {:.1} s",
                1.0 / longest, t.refused, t.broken, t.rise, t.iterations as f64 / t.steps as f64, t.rescaled, t.split, t.indefinite, t.steps, t.worst_host_step, start.elapsed().as_secs_f64()
            );
        }
    }
}
