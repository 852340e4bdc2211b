//! A host step of a swinging cable without and with a reel; the throughput is in steps.
//!
//! `cargo bench -p lariat-ancf --bench reels`. One cable, one thread, the method `discrete-gradient` at 1/240 s. Every variant takes the same number of
//! Newton iterations but for what the motion of the eye asks for.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lariat_ancf::{At, Cable, Damping, Integrator, Method, Reel, Section, StepControl, Vector3};
use std::hint::black_box;
use std::time::{Duration, Instant};

const STEP: f64 = 1.0 / 240.0;
/// Steps from the same state before it is restored: no element is split or merged in them.
const RUN: u64 = 24;

/// A rope that swings from its last node.
fn rope(elements: usize) -> Cable {
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
    cable
}

/// Time of `count` steps; putting the state back is not part of it.
fn steps(cable: &mut Cable, count: u64) -> Duration {
    let state = cable.snapshot().clone();
    let (mut time, mut left) = (Duration::ZERO, count);
    while left > 0 {
        let run = left.min(RUN);
        let start = Instant::now();
        for _ in 0..run {
            cable.step(black_box(STEP)).unwrap();
        }
        time += start.elapsed();
        cable.restore(state.clone()).unwrap();
        left -= run;
    }
    time
}

fn reels(criterion: &mut Criterion) {
    for elements in [16, 64] {
        let rate = 0.2 / elements as f64 / STEP / RUN as f64;
        for (name, reel) in [
            ("none", None),
            ("standing", Some(Reel::default())),
            ("turning", Some(Reel::with_rate(rate))),
            ("clutch", Some(Reel { max_force: Some(40.0), ..Reel::with_rate(rate) })),
        ] {
            let mut cable = rope(elements);
            if let Some(reel) = reel {
                cable.add_reel(At::End, reel).unwrap();
            }
            (0..8).for_each(|_| cable.step(STEP).unwrap());
            let mut group = criterion.benchmark_group("step");
            group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1)).sample_size(40);
            group.bench_function(BenchmarkId::new(name, elements), |b| {
                b.iter_custom(|count| steps(&mut cable, count));
            });
            group.finish();
            cable.diagnostics_mut().reset();
            steps(&mut cable, RUN);
            let iterations = cable.diagnostics().newton_iterations as f64 / RUN as f64;
            println!("{name}, {elements} elements: {iterations:.2} iterations a step");
        }
    }
}

criterion_group!(benches, reels);
criterion_main!(benches);
