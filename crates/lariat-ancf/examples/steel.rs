//! scratch
use lariat_ancf::*;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let host: f64 = args[1].parse().unwrap();
    let seconds: f64 = args[2].parse().unwrap();
    let make = |i: Integrator| Cable::builder().points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::round(0.01, 2.1e11, 7850.0).unwrap()).elements(20).fix(At::Start).integrator(i).build().unwrap();
    let n = (seconds / host).round() as usize;
    let mut reference = vec![];
    let mut c = make(Integrator::tolerance(Method::Esdirk4, 1e-8).unwrap());
    let t = Instant::now();
    let mut maxt = 0.0f64;
    for _ in 0..n.min((2.0/host) as usize) { c.step(host).unwrap(); let r = c.reactions().unwrap()[0].force.norm(); maxt = maxt.max(r); reference.push((c.node_position(20), r)); }
    println!("reference: {:.1} s, tension max {maxt:.2}, steps {} E {:.2e}", t.elapsed().as_secs_f64(), c.diagnostics().steps, c.energy().total());
    for method in [Method::Esdirk3, Method::Esdirk4, Method::TrBdf2, Method::GeneralisedAlpha { rho: 0.0, newton: lariat_ancf::integrate::NewtonMode::Converged }, Method::GeneralisedAlpha { rho: 0.5, newton: lariat_ancf::integrate::NewtonMode::Once }] {
        for control in [StepControl::Tolerance(1e-3), StepControl::Tolerance(1e-4), StepControl::Tolerance(1e-5), StepControl::Tolerance(1e-6), StepControl::MaxStep(1.0/60.0), StepControl::MaxStep(1.0/240.0), StepControl::MaxStep(1.0/960.0)] {
            let mut c = make(Integrator { method, control });
            let (mut e, mut et, mut maxt, mut emax, mut failed) = (0.0f64, 0.0f64, 0.0f64, f64::MIN, None);
            let mut el = 0.0;
            for i in 0..n {
                let t = Instant::now();
                if let Err(x) = c.step(host) { failed = Some(x.to_string()); break; }
                el += t.elapsed().as_secs_f64();
                let r = c.reactions().unwrap()[0].force.norm();
                maxt = maxt.max(r);
                emax = emax.max(c.energy().total());
                if let Some((p, tr)) = reference.get(i) { e = e.max((c.node_position(20) - p).norm()); et = et.max((r - tr).abs()); }
            }
            let d = c.diagnostics();
            println!("{method:22} {:24} {:8.2} ms/s tip {e:.2e} tension err {et:.3} max {maxt:.1} Emax {emax:.2e} Eend {:.3} steps {} rej {} newton {} fact {} indef {} {failed:?}", format!("{control:?}"), el*1e3/c.time(), c.energy().total(), d.steps, d.rejected_steps, d.newton_iterations, d.factorisations, d.indefinite_factorisations);
        }
    }
}
