use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, Fidelity, Integrator, Method, Section, StepControl, Vector3};
use nalgebra::Matrix3;

fn game(control: StepControl) -> Integrator { Integrator { method: Method::DiscreteGradient, control } }

type Build = fn(usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>);

fn alone(c: Cable) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { (c, vec![], vec![]) }

fn pendulum(_: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) {
    alone(Cable::builder().points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1e8, 4000.0).unwrap()).elements(10).fidelity(Fidelity::Game).fix(At::Start).build().unwrap())
}
fn hanging(i: usize, amount: f64) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) {
    let x = i as f64;
    let length = 2.0 + 0.5 * (1.3 * x).sin();
    let angle = amount * (1.0 + 0.3 * (0.7 * x).sin());
    let end = Vector3::new(angle.sin(), -angle.cos(), 0.2 * amount * x.cos()) * length;
    alone(Cable::builder().points([Vector3::zeros(), end]).section(Section::round(0.01, 1e8, 1200.0).unwrap())
        .elements(16).fidelity(Fidelity::Game).fix(At::Start).build().unwrap())
}
fn still(i: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { hanging(i, 0.0) }
fn calm(i: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { hanging(i, 0.05) }
fn calm2(i: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { hanging(i, 0.2) }
fn calm3(i: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { hanging(i, 0.5) }
fn fleet(number: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) {
    let x = number as f64;
    let middle = Vector3::new(1.0, -0.5 - 0.3 * (0.7 * x).sin(), 0.4 * (1.3 * x).cos());
    let end = Vector3::new(1.8 + 0.1 * (0.9 * x).sin(), 0.2, 0.3 * (0.4 * x).sin());
    alone(Cable::builder().points([Vector3::zeros(), middle, end]).section(Section::round(0.01, 1.0e8, 1200.0).unwrap())
        .elements(16).fix(At::Start).fidelity(Fidelity::Game).build().unwrap())
}
fn payload_with(ea: f64, angle: f64) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) {
    let end = Vector3::new(angle.sin(), -angle.cos(), 0.0) * 2.0;
    let mut rope = Cable::builder().points([Vector3::zeros(), end]).section(Section::from_stiffness(ea, 0.8, 0.4).unwrap())
        .elements(10).fidelity(Fidelity::Game).fix(At::Start).build().unwrap();
    let node = rope.attach(At::End).unwrap();
    let mut body = RigidBody::new(50.0, Matrix3::identity() * 0.33, end + Vector3::new(0.0, -0.1, 0.0)).unwrap();
    body.force = Vector3::new(0.0, -9.81 * 50.0, 0.0);
    let pin = PinConstraint { cable: 0, node, body: 0, anchor: Vector3::new(0.0, 0.1, 0.0), direction: None };
    (rope, vec![body], vec![pin])
}
fn payload(_: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { payload_with(1e5, std::f64::consts::FRAC_PI_2) }
fn steel(_: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { payload_with(2e7, 0.3) }
fn calm_load(_: usize) -> (Cable, Vec<RigidBody>, Vec<PinConstraint>) { payload_with(1e5, 0.1) }

fn run(build: Build, i: usize, control: StepControl, dt: f64, n: usize) -> (Vec<Vec<f64>>, lariat_ancf::Diagnostics) {
    let (mut cable, mut bodies, pins) = build(i);
    let mut island = Island::default();
    cable.set_integrator(game(control)).unwrap();
    cable.diagnostics_mut().reset();
    let mut out = vec![];
    for _ in 0..n {
        if bodies.is_empty() { cable.step(dt).unwrap(); } else {
            island.step(&mut [&mut cable], &mut bodies, &pins, game(control), dt).unwrap();
        }
        let mut q: Vec<f64> = (0..cable.nodes()).flat_map(|k| { let p = cable.node_position(k); [p.x, p.y, p.z] }).collect();
        bodies.iter().for_each(|b| q.extend(b.position.iter()));
        out.push(q);
    }
    (out, *cable.diagnostics())
}
fn spin(omega: f64, length: f64, pinned: bool, control: StepControl) -> (f64, f64) {
    let end = Vector3::new(length, 0.0, 0.0);
    let mut b = Cable::builder().points([Vector3::zeros(), end]).section(Section::round(0.01 * length, 1e8, 1200.0).unwrap())
        .elements(10).fidelity(Fidelity::Game).gravity(Vector3::zeros()).angular_velocity(Vector3::new(0.0, 0.0, omega));
    if pinned { b = b.fix(At::Start); }
    let mut cable = b.build().unwrap();
    cable.set_integrator(game(control)).unwrap();
    let l = |c: &Cable| c.momentum().angular.z;
    let start = l(&cable);
    for _ in 0..120 { cable.step(1.0 / 60.0).unwrap(); }
    (l(&cable) / start - 1.0, cable.diagnostics().steps as f64 / 120.0)
}
fn main() {
    let controls: Vec<StepControl> = [StepControl::MaxStep(1.0 / 240.0), StepControl::MaxStep(1.0 / 60.0)].into_iter()
        .chain([3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6].map(StepControl::Adaptive)).collect();
    let which = std::env::args().nth(1);
    let scenes: [(&str, Build, f64, usize, usize); 10] = [
        ("pendulum", pendulum, 0.01, 200, 1), ("pendulum60", pendulum, 1.0 / 60.0, 120, 1), ("still", still, 1.0 / 60.0, 120, 4), ("calm .05", calm, 1.0 / 60.0, 120, 4),
        ("calm .2", calm2, 1.0 / 60.0, 120, 4), ("calm .5", calm3, 1.0 / 60.0, 120, 4), ("fleet", fleet, 1.0 / 60.0, 30, 20),
        ("payload", payload, 1.0 / 60.0, 60, 1), ("steel", steel, 1.0 / 60.0, 60, 1), ("calm load", calm_load, 1.0 / 60.0, 120, 1)];
    for (name, build, dt, n, count) in scenes {
        if which.as_ref().is_some_and(|w| !name.contains(w.as_str())) { continue; }
        let exact: Vec<_> = (0..count).map(|i| run(build, i, StepControl::MaxStep(1.0 / 1920.0), dt, n).0).collect();
        let exact2: Vec<_> = (0..count).map(|i| run(build, i, StepControl::MaxStep(1.0 / 3840.0), dt, n).0).collect();
        let error = |a: &Vec<Vec<f64>>, b: &Vec<Vec<f64>>| -> f64 { a.iter().zip(b).flat_map(|(a, b)| a.chunks(3).zip(b.chunks(3)).map(|(a, b)|
            ((a[0]-b[0]).powi(2) + (a[1]-b[1]).powi(2) + (a[2]-b[2]).powi(2)).sqrt())).fold(0.0, f64::max) };
        println!("{name}: fine against finer {:.1e}", exact.iter().zip(&exact2).map(|(a, b)| error(a, b)).fold(0.0, f64::max));
        for control in &controls {
            let (mut errors, mut d) = (vec![], lariat_ancf::Diagnostics::default());
            for i in 0..count {
                let (path, counts) = run(build, i, *control, dt, n);
                d += counts;
                errors.push(error(&path, &exact2[i]));
            }
            errors.sort_by(f64::total_cmp);
            let per = |x: u64| x as f64 / (n * count) as f64;
            println!("  {:28} steps {:5.2} it {:5.2} fact {:5.2} rej {:4.2} elem {:7.0} | err median {:.2e} worst {:.2e}", format!("{control:?}"), per(d.steps), per(d.newton_iterations),
                per(d.factorisations), per(d.rejected_steps), per(d.element_evaluations()), errors[errors.len() / 2], errors[errors.len() - 1]);
        }
    }
    if which.as_ref().is_some_and(|w| !"spin".contains(w.as_str())) { return; }
    for (length, pinned) in [(1.0, false), (1.0, true), (0.1, true), (10.0, true)] {
        for omega in [2.0, 5.0, 10.0, 20.0, 40.0, 80.0] {
            print!("L {length} pinned {pinned} {omega:4} rad/s:");
            for control in &controls { let (l, s) = spin(omega, length, pinned, *control); print!(" {l:.1e} ({s:.2})"); }
            println!();
        }
    }
}
