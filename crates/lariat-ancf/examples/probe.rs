//! scratch
use lariat_ancf::*;
use std::time::Instant;
fn pendulum(integrator: Integrator, rule: Rule) -> Cable {
    Cable::builder().points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0).unwrap()).elements(10).fix(At::Start)
        .rule(rule).integrator(integrator).build().unwrap()
}
fn main() {
    let rule: Rule = "projected-3".parse().unwrap();
    let h = 0.01;
    let mut cable = pendulum(Integrator { method: Method::Rkn6, control: StepControl::Stable(0.5) }, rule);
    let mut reference = vec![];
    for _ in 0..200 { cable.step(h).unwrap(); reference.push(cable.node_position(10)); }
    let args: Vec<String> = std::env::args().collect();
    let methods: Vec<Method> = if args.len() > 1 { args[1].split(',').map(|m| m.parse().unwrap()).collect() } else { Method::ALL.to_vec() };
    let reps: usize = args.get(2).map_or(3, |r| r.parse().unwrap());
    for method in methods {
        let controls: Vec<StepControl> = if method.properties().estimate_order.is_some() && !method.to_string().contains("once") {
            [1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9].map(StepControl::Tolerance).to_vec()
        } else if method.properties().implicit { [4, 8, 16, 32, 64].map(StepControl::Substeps).to_vec() } else { [0.95, 0.5, 0.25].map(StepControl::Stable).to_vec() };
        for control in controls {
            let mut best = f64::INFINITY;
            let mut line = String::new();
            for _ in 0..reps {
                let mut cable = pendulum(Integrator { method, control }, rule);
                let e0 = cable.energy().total();
                let t0 = Instant::now();
                let (mut worst, mut failed) = (0.0f64, None);
                for r in &reference {
                    if let Err(e) = cable.step(h) { failed = Some(e); break; }
                    worst = worst.max((cable.node_position(10) - r).norm());
                }
                best = best.min(t0.elapsed().as_secs_f64() * 1e3);
                let d = cable.diagnostics();
                line = format!("err {worst:.2e} dE {:.1e} steps {} rej {} newton {} fact {} force {} {failed:?}", cable.energy().total() - e0, d.steps, d.rejected_steps, d.newton_iterations, d.factorisations, d.force_evaluations);
            }
            println!("{method:22} {:22} {best:7.2} ms {line}", format!("{control:?}"));
        }
    }
}
