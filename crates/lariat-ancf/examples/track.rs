//! scratch
use lariat_ancf::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let h = 1.0 / 60.0;
    let make = |i: Integrator| Cable::builder().points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(if args.len() > 2 { Section::round(0.01, 2.1e11, 7850.0).unwrap() } else {Section::square(0.01, 1.0e8, 4000.0).unwrap()}).elements(10).fix(At::Start).integrator(i).build().unwrap();
    for method in args[1].split(',').map(|m| m.parse::<Method>().unwrap()) {
        for tol in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let mut a = make(Integrator::tolerance(method, tol).unwrap());
            let mut b = make(Integrator::tolerance(Method::Esdirk4, tol * 1e-3).unwrap());
            let mut ratios = vec![];
            let mut global = 0.0f64;
            let mut exact = make(Integrator { method: Method::Esdirk4, control: StepControl::Tolerance(1e-9) });
            for i in 0..120 {
                b.set_coordinates(a.positions(), a.velocities()).unwrap();
                a.step(h).unwrap();
                exact.step(h).unwrap();
                if i % 4 == 0 {
                b.step(h).unwrap();
                let e = (0..11).map(|n| (a.node_position(n) - b.node_position(n)).norm()).fold(0.0, f64::max);
                ratios.push(e / tol);
                }
                global = global.max((a.node_position(10) - exact.node_position(10)).norm());
            }
            ratios.sort_by(f64::total_cmp);
            println!("{method:20} {tol:.0e}: min {:.3} q10 {:.3} median {:.3} q90 {:.3} max {:.2}   global/tol {:.1} steps {}", ratios[0], ratios[3], ratios[15], ratios[26], ratios[29], global / tol, a.diagnostics().steps);
        }
    }
}
