//! Cost of a reel: a step of a swinging cable without one, with one that stands or turns, and with clutches that hold and that slip. All in
//! one run, one after the other in short pieces, of which the fastest counts, so that what else the machine does hardly shows.
//!
//! `cargo bench -p lariat-ancf --bench reels`

use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Damping, Integrator, Method, Reel, Section, StepControl, Vector3};
use std::hint::black_box;
use std::time::{Duration, Instant};

const STEP: f64 = 1.0 / 240.0;
/// Steps from the same state before it is restored: no element is split or merged in them.
const RUN: u64 = 240;
/// Steps that are timed together.
const PIECE: u64 = 12;
const REPEATS: u64 = 200;
const NAMES: [&str; 5] = ["none", "standing", "turning", "clutch", "slipping"];

/// A rope that swings from its last node, with a reel or without.
fn rope(elements: usize, name: &str) -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::new(0.0, -4.0, 0.0), Vector3::zeros()])
        .section(Section::from_stiffness(1.0e4, 0.02, 0.4).unwrap())
        .elements(elements)
        .damping(Damping { axial: 2e-3, bending: 2e-3 })
        .integrator(Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) })
        .fix(At::End)
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    let q = cable.positions().to_vec();
    let mut v = cable.velocities().to_vec();
    v.chunks_exact_mut(6).zip(q.chunks_exact(6)).for_each(|(v, q)| (v[0], v[3]) = (0.5 * q[1], 0.5));
    cable.set_coordinates(&q, &v).unwrap();
    let turning = Reel::with_rate(0.2 / elements as f64 / STEP / RUN as f64);
    let reel = match name {
        "standing" => Some(Reel::default()),
        "turning" => Some(turning),
        "clutch" => Some(Reel { max_force: Some(40.0), ..turning }),
        // the load is 15.7 N; the wheel is heavy, so that the rope does not run far
        "slipping" => Some(Reel { max_force: Some(14.0), inertia: 50.0, ..Reel::default() }),
        _ => None,
    };
    reel.into_iter().for_each(|reel| cable.add_reel(At::End, reel).unwrap());
    (0..8).for_each(|_| cable.step(STEP).unwrap());
    cable
}

fn main() {
    println!(
        "elements, reel: us a step, over that without; iterations a step; factorisations, solutions and evaluations an iteration"
    );
    for elements in [16, 64] {
        let mut cables = NAMES.map(|name| rope(elements, name));
        let states = cables.each_ref().map(|cable| cable.snapshot().clone());
        let mut best = [Duration::MAX; NAMES.len()];
        cables.iter_mut().for_each(|cable| cable.diagnostics_mut().reset());
        for _ in 0..REPEATS {
            for (k, cable) in cables.iter_mut().enumerate() {
                for _ in 0..RUN / PIECE {
                    let start = Instant::now();
                    (0..PIECE).for_each(|_| cable.step(black_box(STEP)).unwrap());
                    best[k] = best[k].min(start.elapsed());
                }
                cable.restore(states[k].clone()).unwrap();
            }
        }
        for (k, cable) in cables.iter().enumerate() {
            let d = cable.diagnostics();
            let (n, each) = (d.newton_iterations as f64, elements as f64);
            println!(
                "{elements}, {}: {:.2} us, x {:.3}; {:.3}; {:.2}, {:.2}, {:.2} with and {:.2} without tangent",
                NAMES[k],
                best[k].as_secs_f64() * 1e6 / PIECE as f64,
                best[k].as_secs_f64() / best[0].as_secs_f64(),
                n / (REPEATS * RUN) as f64,
                d.factorisations as f64 / n,
                d.solves as f64 / n,
                d.tangent_evaluations as f64 / n / each,
                d.force_evaluations as f64 / n / each,
            );
        }
    }
}
