use lariat_ancf::*;
use std::time::Instant;
fn reference() -> Vec<Vec<f64>> {
    std::fs::read_to_string("assets/reference/pendulum_G10-10_10el.csv").unwrap().lines().skip(1)
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect()
}
fn main() {
    let r = reference();
    let level = format!("{:?}", fearless_simd::Level::new());
    println!("{}", &level[..level.len().min(40)]);
    for (method, controls) in [
        (Method::Rkn6, vec![StepControl::Stable(0.9), StepControl::Stable(0.5)]),
        (Method::Rkn4, vec![StepControl::Stable(0.9), StepControl::Stable(0.45)]),
        (Method::Verlet, vec![StepControl::Stable(0.9), StepControl::Stable(0.45)]),
        (Method::Esdirk3, vec![StepControl::Tolerance(1e-3),StepControl::Tolerance(1e-4), StepControl::Tolerance(1e-5), StepControl::Tolerance(1e-6)]),
        (Method::Esdirk4, vec![StepControl::Tolerance(1e-3),StepControl::Tolerance(1e-4), StepControl::Tolerance(1e-5), StepControl::Tolerance(1e-6), StepControl::Tolerance(1e-8)]),
        (Method::TrBdf2, vec![StepControl::Tolerance(1e-3),StepControl::Tolerance(1e-4), StepControl::Tolerance(1e-5)]),
        (Method::Trapezoid, vec![StepControl::MaxStep(4e-3), StepControl::MaxStep(1e-3), StepControl::MaxStep(5e-4)]),
        (Method::Midpoint, vec![StepControl::MaxStep(1e-3), StepControl::MaxStep(5e-4)]),
        (Method::GeneralisedAlpha { rho: 0.5, newton: lariat_ancf::integrate::NewtonMode::Converged }, vec![StepControl::MaxStep(2e-3), StepControl::MaxStep(1e-3), StepControl::Tolerance(1e-4), StepControl::Tolerance(1e-5)]),
        (Method::GeneralisedAlpha { rho: 0.5, newton: lariat_ancf::integrate::NewtonMode::Once }, vec![StepControl::MaxStep(2e-3), StepControl::MaxStep(1e-3), StepControl::MaxStep(5e-4)]),
    ] {
        for control in controls {
            let mut cable = Cable::builder().points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
                .section(Section::square(0.01, 1.0e8, 4000.0).unwrap()).elements(10).fix(At::Start)
                .rule(Rule::gauss(5, 3).unwrap()).integrator(Integrator { method, control }).build().unwrap();
            let t0 = Instant::now();
            let (mut worst, mut worst_e) = (0.0f64, 0.0f64);
            let mut failed = None;
            for row in &r[1..] {
                if let Err(e) = cable.step(row[0] - cable.time()) { failed = Some(e); break; }
                let p = cable.node_position(10);
                worst = worst.max((p - Vector3::new(row[1], row[2], row[3])).norm());
                worst_e = worst_e.max((cable.energy().total() - row[11]).abs());
            }
            let ms = t0.elapsed().as_secs_f64() * 1e3;
            let d = cable.diagnostics();
            println!("{method:24} {control:?} {ms:8.2} ms err {worst:.3e} E {worst_e:.2e} end {:?} steps {} rej {} newton {} fact {} force {} {failed:?}",
                cable.node_position(10).as_slice(), d.steps, d.rejected_steps, d.newton_iterations, d.factorisations, d.force_evaluations);
        }
    }
}
