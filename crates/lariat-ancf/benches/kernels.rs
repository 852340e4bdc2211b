//! Force, force with its exact tangent, and the whole implicit step, per element; the throughput is in elements.
//!
//! `cargo bench -p lariat-ancf --bench kernels`. One cable, one thread. The step is one of the trapezoidal rule, so short that it
//! ends after one Newton iteration with a fresh tangent (checked): force, tangent, factor, solve, update, and the step control
//! around them.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::Level;
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::{At, Cable, Integrator, Method, Rule, Section, Vector3};
use std::hint::black_box;
use std::time::{Duration, Instant};

const RULES: [&str; 5] = ["projected-3", "G5-3", "ST2", "L2T2", "G5-none"];
const STEP: f64 = 1e-7;
/// Steps from the same state before it is restored.
const RUN: u64 = 64;

/// A soft cable, bent and moving.
fn cable(rule: &str, elements: usize) -> Cable {
    let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0), Vector3::new(2.0, 1.0, 0.3)];
    let section = Section::square(0.01, 1.0e8, 4000.0).unwrap();
    let builder = Cable::builder().points(points).section(section).elements(elements).fix(At::Start);
    let mut cable = builder.rule(rule.parse::<Rule>().unwrap()).build().unwrap();
    cable.step(0.05).unwrap();
    cable.set_integrator(Integrator::substeps(Method::Trapezoid, 1).unwrap()).unwrap();
    cable.step(STEP).unwrap();
    cable
}

fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[allow(unused_mut)]
    let mut levels = vec![("best", best)];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(best.as_avx2().map(|t| ("avx2", Level::Avx2(t))));
        levels.extend(best.as_sse2().map(|t| ("sse2", Level::Sse2(t))));
    }
    levels
}

/// Time of `count` steps; putting the state back is not part of it.
fn implicit_steps(cable: &mut Cable, count: u64) -> Duration {
    let state = cable.snapshot().clone();
    cable.diagnostics_mut().reset();
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
    let d = cable.diagnostics();
    assert_eq!((d.newton_iterations, d.factorisations), (count, count), "one Newton iteration per step");
    time
}

fn bench(criterion: &mut Criterion, group: &str, id: &str, mut cable: Cable) {
    let n = cable.elements().len();
    let mut force = vec![0.0; 6 * (n + 1)];
    for what in ["force", "force_tangent", "implicit_step"] {
        let mut group = criterion.benchmark_group(format!("{what}/{group}"));
        group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1)).sample_size(40);
        group.throughput(Throughput::Elements(n as u64));
        let id = BenchmarkId::new(id, n);
        match what {
            "force" => group.bench_function(id, |b| b.iter(|| cable.evaluate(black_box(&mut force)))),
            "force_tangent" => group.bench_function(id, |b| {
                b.iter(|| {
                    black_box(cable.evaluate_with_stiffness(black_box(&mut force)));
                })
            }),
            _ => group.bench_function(id, |b| b.iter_custom(|count| implicit_steps(&mut cable, count))),
        };
        group.finish();
    }
}

fn kernels(criterion: &mut Criterion) {
    for elements in [16, 64] {
        for rule in RULES {
            bench(criterion, "best", rule, cable(rule, elements));
        }
    }
    for (name, level) in levels().into_iter().skip(1) {
        let mut cable = cable(RULES[0], 64);
        cable.set_simd_level(level).unwrap();
        bench(criterion, name, RULES[0], cable);
    }
}

criterion_group!(benches, kernels);
criterion_main!(benches);
