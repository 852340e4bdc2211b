//! What effects cost: ns per element of a whole implicit step, bare, each effect alone, and all together.
//!
//! `cargo bench -p lariat-ancf --bench effects`. One cable, one thread; the step of `kernels`: the trapezoidal rule, so short that one
//! iteration with a fresh tangent is enough without effects; the inexact tangents of effects take a second with the same factors.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use lariat_ancf::{
    At, Buoyancy, Cable, Damping, Drag, Effects, Flow, GravityScale, Integrator, LineLoad, Method, RestShape, Rule,
    Section, Vector3,
};
use std::hint::black_box;
use std::time::{Duration, Instant};

const STEP: f64 = 1e-7;
const ELEMENTS: usize = 64;
/// Steps from the same state before it is restored.
const RUN: u64 = 64;

fn cases() -> Vec<(&'static str, &'static str, Effects)> {
    let flow = Flow::uniform(Vector3::new(1.0, 0.0, 0.2));
    let wind = Flow::power_law(Vector3::new(1.0, 0.0, 0.2), Vector3::y(), 10.0, 0.14, 100.0);
    let damping = |axial, bending| Effects { damping: Some(Damping { axial, bending }), ..Effects::default() };
    let drag = |flow| Effects { drag: Some(Drag::new(1000.0, 1.2, 0.01, flow)), ..Effects::default() };
    let rest = |rest| Effects { rest_shape: Some(rest), ..Effects::default() };
    let buoyancy = Effects { buoyancy: Some(Buoyancy::new(1000.0, 1.0)), ..Effects::default() };
    let constant = Effects {
        line_loads: vec![LineLoad::uniform(Vector3::x())],
        gravity_scale: GravityScale(0.5),
        ..Effects::default()
    };
    let all = Effects {
        damping: Some(Damping { axial: 1e-3, bending: 1e-3 }),
        drag: Some(Drag::new(1000.0, 1.2, 0.01, flow.clone())),
        rest_shape: Some(RestShape::curved(0.1)),
        buoyancy: Some(Buoyancy::new(1000.0, 1.0)),
        ..constant.clone()
    };
    vec![
        ("limp", "projected-none", Effects::default()),
        ("bare", "projected-3", Effects::default()),
        ("damping_axial", "projected-3", damping(1e-3, 0.0)),
        ("damping", "projected-3", damping(1e-3, 1e-3)),
        ("drag", "projected-3", drag(flow)),
        ("drag_profile", "projected-3", drag(wind)),
        ("buoyancy", "projected-3", buoyancy),
        ("rest_stretch", "projected-3", rest(RestShape::stretched(0.999))),
        ("rest_curvature", "projected-3", rest(RestShape::curved(0.1))),
        ("line_load_gravity_scale", "projected-3", constant),
        ("all", "projected-3", all),
    ]
}

/// A soft cable, bent and moving.
fn cable(rule: &str, effects: Effects) -> Cable {
    let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0), Vector3::new(2.0, 1.0, 0.3)];
    let section = Section::round(0.01, 1.0e8, 4000.0).unwrap();
    let builder = Cable::builder().points(points).section(section).elements(ELEMENTS).fix(At::Start);
    let mut cable = builder.rule(rule.parse::<Rule>().unwrap()).build().unwrap();
    cable.step(0.05).unwrap();
    cable.set_effects(effects).unwrap();
    cable.set_integrator(Integrator::substeps(Method::Trapezoid, 1).unwrap()).unwrap();
    cable.step(STEP).unwrap();
    cable
}

/// Time of `count` steps; putting the state back is not part of it.
fn steps(cable: &mut Cable, count: u64) -> Duration {
    let state = cable.state().clone();
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

fn effects(criterion: &mut Criterion) {
    for (name, rule, effects) in cases() {
        let mut cable = cable(rule, effects);
        let mut force = vec![0.0; cable.positions().len()];
        for what in ["force", "force_tangent", "implicit_step"] {
            let mut group = criterion.benchmark_group(format!("effects/{what}"));
            group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(600)).sample_size(20);
            group.throughput(Throughput::Elements(ELEMENTS as u64));
            let id = BenchmarkId::from_parameter(name);
            match what {
                "force" => group.bench_function(id, |b| b.iter(|| cable.evaluate(black_box(&mut force)))),
                "force_tangent" => group.bench_function(id, |b| {
                    b.iter(|| {
                        black_box(cable.evaluate_with_stiffness(black_box(&mut force)));
                    })
                }),
                _ => group.bench_function(id, |b| b.iter_custom(|count| steps(&mut cable, count))),
            };
            group.finish();
        }
    }
}

criterion_group!(benches, effects);
criterion_main!(benches);
