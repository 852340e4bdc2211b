//! Throughput of a fleet: how many swinging 16-element cables keep up with 60 host steps per second in fidelity game.
//!
//! `cargo run --release -p lariat-ancf --example fleet [CABLES [RULE]]`, and with `RUSTFLAGS="-C target-cpu=native"`; on 1, 2, 4 ...
//! threads. Each cable is pinned at its start and released from a slack shape, no two alike.

use lariat_ancf::{At, Cable, Diagnostics, Fidelity, Rule, Section, Vector3, step_all};
use std::time::Instant;

const ELEMENTS: usize = 16;
/// Half a second.
const HOST_STEPS: usize = 30;
const HOST_STEP: f64 = 1.0 / 60.0;

fn cable(number: usize, rule: Rule) -> Result<Cable, lariat_ancf::Error> {
    let x = number as f64;
    let middle = Vector3::new(1.0, -0.5 - 0.3 * (0.7 * x).sin(), 0.4 * (1.3 * x).cos());
    let end = Vector3::new(1.8 + 0.1 * (0.9 * x).sin(), 0.2, 0.3 * (0.4 * x).sin());
    Cable::builder()
        .points([Vector3::zeros(), middle, end])
        .section(Section::round(0.01, 1.0e8, 1200.0)?)
        .elements(ELEMENTS)
        .fix(At::Start)
        .fidelity(Fidelity::Game)
        .rule(rule)
        .build()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(2000), |n| n.parse::<usize>())?;
    let rule = std::env::args().nth(2).map_or(Ok(Fidelity::Game.rule()), |rule| rule.parse())?;
    let cores = std::thread::available_parallelism()?.get();
    for threads in (0..).map(|k| 1 << k).take_while(|&threads| threads <= cores) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let mut cables = (0..count).map(|number| cable(number, rule)).collect::<Result<Vec<_>, _>>()?;
        let start = Instant::now();
        for _ in 0..HOST_STEPS {
            pool.install(|| step_all(&mut cables, HOST_STEP))?;
        }
        let per_cable = start.elapsed().as_secs_f64() / (HOST_STEPS * count) as f64;
        let mut work = Diagnostics::default();
        cables.iter().for_each(|cable| work += *cable.diagnostics());
        println!(
            "{threads} threads: {:.0} cables in real time, {:.2} us per cable and host step, {:.2} iterations and {:.2} factorisations per step",
            HOST_STEP / per_cable,
            1e6 * per_cable,
            work.newton_iterations as f64 / work.steps as f64,
            work.factorisations as f64 / work.steps as f64
        );
    }
    Ok(())
}
