//! scratch
use lariat_ancf::island::*;
use lariat_ancf::*;
use nalgebra::Matrix3;
fn main() {
    let (e, rho) = if std::env::args().count() > 1 { (2e11, 7850.0) } else { (1e9, 4000.0) };
    for (mass, n) in [
        (50.0f64, 1),
        (50.0, 4),
        (50.0, 16),
        (50.0, 64),
        (0.8, 4),
        (0.8, 16),
        (0.8, 64),
        (0.08, 4),
        (0.08, 64),
        (800.0, 4),
        (800.0, 64),
        (8000.0, 4),
        (8000.0, 64),
    ] {
        for (name, integrator) in [
            ("esdirk4 1e-6", Integrator::default()),
            ("1e-8", Integrator::tolerance(Method::Esdirk4, 1e-8).unwrap()),
            ("esdirk3 1e-6", Integrator::tolerance(Method::Esdirk3, 1e-6).unwrap()),
            ("tr-bdf2 1e-6", Integrator::tolerance(Method::TrBdf2, 1e-6).unwrap()),
            ("ga0 1e-5", Integrator::tolerance("generalised-alpha-0".parse().unwrap(), 1e-5).unwrap()),
            ("game", Preset::Game.integrator(0.0)),
            ("verlet", Integrator { method: Method::Verlet, control: StepControl::Stable(0.9) }),
        ] {
            if e > 1e10 && name == "verlet" {
                continue;
            }
            let mut cable = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
                .section(Section::square(0.01, e, rho).unwrap())
                .elements(10)
                .fix(At::Start)
                .rule("G5-3".parse().unwrap())
                .build()
                .unwrap();
            let node = cable.attach(At::End).unwrap();
            let i = mass / 12.0 * 0.08;
            let mut body =
                RigidBody::new(mass, Matrix3::from_diagonal_element(i), Vector3::new(2.0, -0.1, 0.0)).unwrap();
            body.force = Vector3::new(0.0, -9.81 * mass, 0.0);
            let pins = [Pin { cable: 0, node, body: 0, anchor: Vector3::new(0.0, 0.1, 0.0) }];
            let mut bodies = [body];
            let mut island = Island::default();
            let dt = 1.0 / 60.0 / n as f64;
            let t = std::time::Instant::now();
            let energy = |c: &Cable, b: &RigidBody| {
                c.energy().total() + b.kinetic_energy() + b.mass * 9.81 * (b.position.y + 0.1)
            };
            let mut out = vec![];
            let mut worst = f64::MIN;
            let mut fail = None;
            for k in 0..60 * n {
                if let Err(e) = island.step(&mut [&mut cable], &mut bodies, &pins, integrator, dt) {
                    fail = Some(e.to_string());
                    break;
                }
                worst = worst.max(energy(&cable, &bodies[0]));
                if (k + 1) % (30 * n) == 0 {
                    out.push((bodies[0].position.x, bodies[0].position.y));
                }
            }
            let d = cable.diagnostics();
            println!(
                "m {mass} n {n} {name:14} {:7.2} ms {out:.5?} E {:.2e} max {worst:.1e} steps {} rej {} newton {} fact {} {fail:?}",
                t.elapsed().as_secs_f64() * 1e3,
                energy(&cable, &bodies[0]),
                d.steps,
                d.rejected_steps,
                d.newton_iterations,
                d.factorisations
            );
        }
    }
}
