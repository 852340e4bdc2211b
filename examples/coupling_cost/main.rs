//! What a cable on a body costs: whole runs of boxes on cables, Lariat's and what Rapier itself offers, as Markdown.
//!
//! `cargo run --release --example coupling_cost -- --out docs/coupling.md`
//!
//! Times are CPU time on one thread, the mean over a run of 2 s, the least of several runs; what is timed is the step of the
//! world with its cables and nothing else.

mod measure;
mod peers;
mod report;
mod rig;
mod scene;

use lariat::{Fidelity, Integrator, Method, Vector3};
use lariat_bench::machine;
use measure::Row;
use peers::Chain;
use rig::{Make, Rig, Split, host_steps};
use scene::{SOFT, STEEL, Scene};
use std::error::Error;
use std::fmt::Write as _;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The command that makes the report, printed in it.
const COMMAND: &str = "cargo run --release --example coupling_cost -- --out docs/coupling.md";

/// Centre of the box of the soft pendulum at 0.5 s and 1 s in m: a fine run of an independent monolithic code, good to 2e-5.
const CENTRES: [[f64; 3]; 2] = [[1.70292, -1.21801, 0.0], [-0.82138, -1.91419, 0.0]];

/// Rapier's own settings, the split that is Lariat's default, and both with more iterations.
const SPLITS: [Split; 4] = [
    Split { steps: 1, iterations: 4 },
    Split { steps: 1, iterations: 16 },
    Split { steps: 4, iterations: 4 },
    Split { steps: 4, iterations: 16 },
];

fn makes() -> Vec<(Make, Vec<Split>)> {
    let presets = [Fidelity::Game, Fidelity::Engineering, Fidelity::Reference].map(Make::Lariat);
    let peers =
        [Make::SoftRope(30.0), Make::SoftRope(1e6), Make::Capsules(Chain::Impulse), Make::Capsules(Chain::Multibody)];
    let ours = presets.map(|make| (make, vec![SPLITS[0], SPLITS[2]]));
    ours.into_iter().chain(peers.map(|make| (make, SPLITS.to_vec()))).collect()
}

/// The centre of the box by Lariat at 1e-9 m per host step, coupled 960 times a second.
fn fine(scene: &Scene) -> Outcome<[Vector3<f64>; 2]> {
    let make = Make::Exact(Integrator::tolerance(Method::Esdirk4, 1e-9)?);
    let mut rig = Rig::new(scene, make, Split { steps: 16, iterations: 4 })?;
    let mut out = [Vector3::zeros(); 2];
    for k in 1..=host_steps(1.0) {
        rig.step()?;
        for (centre, t) in out.iter_mut().zip(measure::READ) {
            if k == host_steps(t) {
                *centre = rig.centre();
            }
        }
    }
    Ok(out)
}

/// Some ways in a scene, and the boxes alone.
fn rows(scene: &Scene, ways: &[(Make, Vec<Split>)]) -> Outcome<(Vec<Row>, Vec<Row>)> {
    let mut all = Vec::new();
    for (make, splits) in ways {
        for split in splits {
            let row = measure::row(scene, *make, *split)?;
            eprintln!("{}", report::line(&row));
            all.push(row);
        }
    }
    let bare = SPLITS.map(|split| measure::row(scene, Make::Nothing, split));
    Ok((all, bare.into_iter().collect::<Outcome<_>>()?))
}

/// The ways whose runs with many boxes take less than some seconds.
fn quick(ways: &[(Make, Vec<Split>)]) -> Vec<(Make, Vec<Split>)> {
    let slow = [Make::Lariat(Fidelity::Engineering), Make::Lariat(Fidelity::Reference)];
    let mut quick: Vec<_> = ways.iter().filter(|(make, _)| !slow.contains(make)).cloned().collect();
    for (_, splits) in quick.iter_mut().filter(|(make, _)| *make == Make::Capsules(Chain::Multibody)) {
        splits.truncate(1);
    }
    quick
}

fn main() -> Outcome<()> {
    let mut file = None;
    let mut arguments = std::env::args().skip(1);
    while let Some(flag) = arguments.next() {
        match (flag.as_str(), arguments.next()) {
            ("--out", Some(value)) => file = Some(value),
            _ => return Err("usage: coupling_cost [--out FILE]".into()),
        }
    }
    let machine = machine::line();
    let soft = Scene { material: SOFT, count: 1, mass: 50.0, swings: true };
    let steel = Scene { material: STEEL, ..soft };
    let rest = Scene { mass: 10.0, swings: false, ..soft };
    let many = Scene { count: 20, ..soft };

    let ways = makes();
    let mut out = report::head(COMMAND, &machine);
    let centres = CENTRES.map(Vector3::from);
    let (soft_fine, steel_fine) = (fine(&soft)?, fine(&steel)?);
    let off = report::distances(&soft_fine, &centres);
    write!(
        out,
        "\n## A payload swings\n\n50 kg on the soft cable of 0.8 kg, released from horizontal. *Error* is the distance of the box's \
         centre from that of an independent monolithic code (one fine run, good to 2e-5 m). For reference: Lariat at 1e-9 m per host \
         step, coupled 960 times a second, is {:.1e} and {:.1e} m from it.\n\n",
        off[0], off[1]
    )?;
    let (ours, bare) = rows(&soft, &ways)?;
    out += &report::swinging(&ours, &bare, &centres);
    out += &report::target(&ours);
    out += &report::counts(&ours);
    out += &report::shares(&soft)?;
    write!(
        out,
        "\n## The same in steel\n\nA cable of 1.57 kg. *Error* is the distance from Lariat's own run at 1e-9 m, coupled 960 times a \
         second: not an independent reference.\n\n"
    )?;
    let (ours, bare) = rows(&steel, &ways)?;
    out += &report::swinging(&ours, &bare, &steel_fine);
    out += &report::counts(&ours);
    write!(
        out,
        "\n## A load at rest\n\n10 kg hang on the soft cable; the box has a linear damping of 5/s and came to rest for 4 s before the \
         2 s that are measured; nothing sleeps. By statics the cable is stretched by {:.4} %.\n\n",
        100.0 * rest.static_stretch()
    )?;
    let (ours, bare) = rows(&rest, &ways)?;
    out += &report::hanging(&ours, &bare);
    out += &report::counts(&ours);
    write!(
        out,
        "\n## Twenty of them\n\nTwenty payload pendulums (50 kg, soft) side by side in one world. *Per cable* is the time without that \
         of Rapier alone, by twenty: a cable with its one attachment. Left out: the slower presets, and multibody joints but once.\n\n"
    )?;
    let (ours, bare) = rows(&many, &quick(&ways))?;
    out += &report::many(&ours, &bare, many.count);
    print!("{out}");
    if let Some(file) = file {
        std::fs::write(file, out)?;
    }
    Ok(())
}
