//! Factor, solve, solve for twelve, mass solve; the throughput is in nodes (times right-hand sides).

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::Level;
use lariat_ancf::linalg::{BlockTridiagonal, Factorisation, MassFactorisation, MassMatrix, SchurComplement};
use std::hint::black_box;

fn matrix(nodes: usize) -> BlockTridiagonal {
    let mut a = BlockTridiagonal::zeros(nodes);
    for (i, b) in a.diag.iter_mut().enumerate() {
        for c in 0..6 {
            for r in 0..6 {
                b.0[c][r] = ((i + r + c) as f64).cos() / 2.0;
            }
            b.0[c][c] += 6.0;
        }
    }
    for (i, b) in a.lower.iter_mut().enumerate() {
        for c in 0..6 {
            for r in 0..6 {
                b.0[c][r] = ((i + 3 * r + 5 * c) as f64).sin() / 2.0;
            }
        }
    }
    a
}

fn mass(nodes: usize) -> MassMatrix {
    MassMatrix { diag: vec![[312.0, 0.0, 8.0]; nodes], lower: vec![[54.0, 13.0, -13.0, -3.0]; nodes - 1] }
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

fn linalg(criterion: &mut Criterion) {
    for n in [17, 101] {
        let a = matrix(n);
        let rhs: Vec<f64> = (0..6 * n).map(|i| (i as f64).sin()).collect();
        let mut mass_factors = MassFactorisation::default();
        mass_factors.factor(&mass(n)).unwrap();
        let mut indefinite = a.clone();
        indefinite.diag[n / 3].0[2][2] = -6.0;
        for (name, level) in levels() {
            let mut group = criterion.benchmark_group(format!("linalg/{name}"));
            let id = |what: &str| BenchmarkId::new(what.to_string(), n);
            let mut f = Factorisation::default();
            group.throughput(Throughput::Elements(n as u64));
            group.bench_function(id("factor_indefinite"), |b| b.iter(|| f.factor(level, black_box(&indefinite))));
            group.bench_function(id("factor"), |b| b.iter(|| f.factor(level, black_box(&a))));
            let small = BatchSize::SmallInput;
            group.bench_function(id("solve"), |b| b.iter_batched_ref(|| rhs.clone(), |x| f.solve(level, x), small));
            group.bench_function(id("mass_solve"), |b| {
                b.iter_batched_ref(|| rhs.clone(), |x| mass_factors.solve(level, x), small)
            });
            let (mut border, mut w) = (SchurComplement::default(), vec![0.0; 144]);
            group.bench_function(id("schur_12"), |b| {
                b.iter(|| {
                    border.begin(n, 12);
                    (0..12).for_each(|k| border.set(k, n * k / 12, &[1.0; 6]));
                    border.complete(level, &f);
                    border.subtract_from(level, black_box(&mut w));
                })
            });
            group.finish();
        }
    }
}

criterion_group!(benches, linalg);
criterion_main!(benches);
