//! scratch
use lariat_ancf::*;
use std::time::Instant;
fn main() {
    for rule in ["projected-3"] {
        for n in [64usize] {
            let mut cable = Cable::builder().points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0), Vector3::new(2.0,1.0,0.3)])
                .section(Section::square(0.01, 1.0e8, 4000.0).unwrap()).elements(n).fix(At::Start)
                .rule(rule.parse().unwrap()).build().unwrap();
            let mut f = vec![0.0; 6 * (n + 1)];
            let reps = 2_000_000 / n;
            let mut best = [f64::INFINITY; 4];
            for _ in 0..5 {
                let t = Instant::now();
                for _ in 0..reps { cable.evaluate(&mut f); }
                best[0] = best[0].min(t.elapsed().as_secs_f64() / (reps * n) as f64 * 1e9);
                let t = Instant::now();
                for _ in 0..reps { cable.evaluate_with_stiffness(&mut f); }
                best[1] = best[1].min(t.elapsed().as_secs_f64() / (reps * n) as f64 * 1e9);
                cable.set_integrator(Integrator::substeps(Method::Trapezoid, 1).unwrap()).unwrap();
                let before = *cable.diagnostics();
                let t = Instant::now();
                let st = cable.state().clone();
                for i in 0..reps / 10 { if i % 100 == 0 { cable.restore(st.clone()).unwrap(); } cable.step(1e-4).unwrap(); }
                let dt = t.elapsed().as_secs_f64() * 1e9;
                let newton = cable.diagnostics().newton_iterations - before.newton_iterations;
                best[2] = best[2].min(dt / (newton as usize * n) as f64);
                cable.restore(st).unwrap();
            }
            println!("{rule:12} n={n:4} force {:.1} force+tangent {:.1} newton iteration {:.1} ns/element", best[0], best[1], best[2]);
        }
    }
}
