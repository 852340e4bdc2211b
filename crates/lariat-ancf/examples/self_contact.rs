//! What contact with itself costs a rope that touches nothing: ratios in one run, and tests of boxes per element and step.
//!
//! `cargo run --release -p lariat-ancf --example self_contact`

use lariat_ancf::{At, Cable, Contact, Damping, Diagnostics, Error, Fidelity, Section, Vector3};
use std::time::Instant;

/// Repetitions, of which the shortest time counts.
const REPEATS: usize = 7;
/// Host steps of a run.
const STEPS: usize = 300;

/// Runs a rope of 40 m that hangs between two points and settles, or swings from one; returns its time per host step in us, and its counts.
fn run(elements: usize, swings: bool, touches: bool) -> Result<(f64, Diagnostics), Error> {
    let end = if swings { Vector3::new(0.0, -40.0, 0.0) } else { Vector3::new(30.0, 0.0, 0.0) };
    let rope = Cable::builder()
        .points([Vector3::zeros(), end])
        .length(40.0)
        .section(Section::from_stiffness(2e5, 0.5, 0.3)?)
        .elements(elements)
        .fidelity(Fidelity::Game)
        .damping(Damping { axial: 0.002, bending: 0.01 })
        .fix(At::Start);
    let rope = if swings { rope.velocity(Vector3::new(3.0, 0.0, 1.0)) } else { rope.fix(At::End) };
    let mut rope = rope.build()?;
    if touches {
        rope.set_contact(Contact::default().with_radius(0.01).with_cables())?;
    }
    let clock = Instant::now();
    for _ in 0..STEPS {
        rope.step(1.0 / 60.0)?;
    }
    Ok((clock.elapsed().as_secs_f64() * 1e6 / STEPS as f64, *rope.diagnostics()))
}

fn main() -> Result<(), Error> {
    println!("| rope | elements | us per host step | with contact | ratio | tests per element and step |");
    println!("|---|---:|---:|---:|---:|---:|");
    for (swings, elements) in [false, true].into_iter().flat_map(|swings| [50, 200, 800].map(|n| (swings, n))) {
        let mut best = [f64::INFINITY; 2];
        let mut tests = 0.0;
        for (k, touches) in (0..REPEATS).flat_map(|_| [(0, false), (1, true)]) {
            let (time, counts) = run(elements, swings, touches)?;
            best[k] = best[k].min(time);
            tests = counts.search_tests as f64 / (counts.steps * elements as u64) as f64;
        }
        let (name, [without, with]) = (if swings { "swings" } else { "hangs" }, best);
        println!("| {name} | {elements} | {without:.0} | {with:.0} | {:.2} | {tests:.2} |", with / without);
    }
    Ok(())
}
