//! scratch
use lariat_rapier::lariat_ancf::*;
use lariat_rapier::CableSet;
use rapier::prelude::*;
use ::nalgebra as na;
fn soft() -> Section { Section::square(0.01, 1e9, 4000.0).unwrap() }
fn steel() -> Section { Section::square(0.01, 2e11, 7850.0).unwrap() }
fn v(b: Vector) -> na::Vector3<f64> { na::Vector3::new(b.x as f64, b.y as f64, b.z as f64) }
fn payload(section: Section, mass: f32, hz: f32, preset: Option<Preset>) {
    let mut world = PhysicsWorld::new();
    world.integration_parameters.dt = 1.0 / hz;
    let (b, _) = world.insert(RigidBodyBuilder::dynamic().translation(Vector::new(2.0, -0.1, 0.0)), ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(mass));
    let mut set = CableSet::new();
    let mut builder = Cable::builder().points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)]).section(section).rule("G5-3".parse().unwrap()).fix(At::Start);
    if let Some(p) = preset { builder = builder.preset(p); }
    let c = set.insert(builder.build().unwrap());
    set.attach(&world, c, At::End, b, Vector::new(0.0, 0.1, 0.0)).unwrap();
    let t = std::time::Instant::now();
    let mut gap = 0.0f64; let mut emax = f64::MIN;
    let mut out = vec![];
    for k in 0..hz as usize {
        if let Err(e) = set.step(&mut world) { println!("FAIL {e}"); return; }
        gap = gap.max(set.attachments().next().unwrap().1.gap());
        let body = &world.bodies[b];
        let e = set.get(c).unwrap().energy().total() + body.kinetic_energy() as f64 + 9.81 * mass as f64 * (body.translation().y as f64 + 0.1);
        emax = emax.max(e);
        if (k + 1) % (hz as usize / 2) == 0 { out.push(v(body.translation()).xy()); }
    }
    let ms = t.elapsed().as_secs_f64() * 1e3;
    println!("payload m {mass} {hz} Hz {preset:?}: {:.5?} {:.5?} gap {gap:.1e} emax {emax:.2e} {ms:.1} ms = {:.1} us/host step", out[0].as_slice(), out[1].as_slice(), ms * 1e3 / hz as f64);
}
fn dumbbell(section: Section) {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::ZERO;
    let l = 2.0; let w = 5.0f32;
    let com = 10.0 * l as f32 / 11.0;
    let mk = |m: f32, x: f32| RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.0, 0.0)).linvel(Vector::new(0.0, w * (x - com), 0.0)).angvel(Vector::new(0.0, 0.0, w));
    let _ = mk;
    let (a, _) = world.insert(mk(1.0, 0.0), ColliderBuilder::ball(0.1).mass(1.0));
    let (b, _) = world.insert(mk(10.0, 2.0), ColliderBuilder::ball(0.1).mass(10.0));
    let mut set = CableSet::new();
    let c = set.insert(Cable::builder().points([Vector3::new(0.1, 0.0, 0.0), Vector3::new(1.9, 0.0, 0.0)]).section(section).gravity(Vector3::zeros())
        .velocity(Vector3::new(0.0, w as f64 * (0.1 - com as f64), 0.0)).angular_velocity(Vector3::new(0.0, 0.0, w as f64)).build().unwrap());
    set.attach(&world, c, At::Start, a, Vector::new(0.1, 0.0, 0.0)).unwrap();
    set.attach(&world, c, At::End, b, Vector::new(-0.1, 0.0, 0.0)).unwrap();
    let momentum = |world: &PhysicsWorld, set: &CableSet| {
        let m = set.get(c).unwrap().momentum();
        let (mut p, mut ang) = (m.linear, m.angular);
        for h in [a, b] { let x = &world.bodies[h]; let mass = x.mass() as f64; let vel = v(x.linvel()) * mass; p += vel; ang += v(x.center_of_mass()).cross(&vel) + v(x.angvel()) * (0.4 * mass * 0.01); }
        (p, ang)
    };
    let (p0, l0) = momentum(&world, &set);
    let t = std::time::Instant::now();
    let (mut tmin, mut tmax) = (f64::MAX, f64::MIN);
    for k in 0..600 { if let Err(e) = set.step(&mut world) { println!("FAIL {e}"); return; }
        if k > 60 { let s = set.get(c).unwrap().sample(0.9).unwrap().tension; tmin = tmin.min(s); tmax = tmax.max(s); } }
    let (p1, l1) = momentum(&world, &set);
    println!("dumbbell: dp {:.2e} of {:.2}, dL/L {:.2e}, tension {tmin:.3}..{tmax:.3} gap {:.1e} {:.1} ms", (p1 - p0).norm(), p0.norm(), (l1 - l0).norm() / l0.norm(), set.attachments().map(|a| a.1.gap()).fold(0.0, f64::max), t.elapsed().as_secs_f64() * 1e3);
}
fn hoist(section: Section) {
    // 10 kg box on the ground, winch (kinematic) above lifts at 0.2 m/s
    let mut world = PhysicsWorld::new();
    world.insert(RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.5, 0.0)), ColliderBuilder::cuboid(5.0, 0.5, 5.0));
    let (b, _) = world.insert(RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.1, 0.0)), ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(10.0));
    let w = world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(0.0, 2.1, 0.0)));
    let mut set = CableSet::new();
    let c = set.insert(Cable::builder().points([Vector3::new(0.0, 2.1, 0.0), Vector3::new(0.0, 0.2, 0.0)]).length(2.0).section(section).build().unwrap());
    set.attach(&world, c, At::Start, w, Vector::ZERO).unwrap();
    let at = set.attach(&world, c, At::End, b, Vector::new(0.0, 0.1, 0.0)).unwrap();
    let t = std::time::Instant::now();
    let (mut jitter, mut tens) = (0.0f32, vec![]);
    let mut gap = 0.0f64;
    for k in 0..600 {
        let time = k as f32 / 60.0;
        world.bodies[w].set_linvel(if time > 2.0 && time < 6.0 { Vector::new(0.0, 0.2, 0.0) } else { Vector::ZERO }, true);
        if let Err(e) = set.step(&mut world) { println!("FAIL {e}"); return; }
        if time > 1.0 && time < 2.0 { jitter = jitter.max(world.bodies[b].linvel().length()); }
        gap = gap.max(set.attachment(at).unwrap().gap());
        if time > 8.0 { tens.push(set.get(c).unwrap().sample(1.99).unwrap().tension); }
        if k % 60 == 0 && std::env::args().count() > 2 { println!("  t {time:.1} y {:.4} vy {:.5} T {:.3} f {:?}", world.bodies[b].translation().y, world.bodies[b].linvel().y, set.get(c).unwrap().sample(1.99).unwrap().tension, 0); }
    }
    let (lo, hi) = tens.iter().fold((f64::MAX, f64::MIN), |a, x| (a.0.min(*x), a.1.max(*x)));
    println!("hoist: jitter {jitter:.2e} tension {lo:.3}..{hi:.3} y {:.4} gap {gap:.1e} {:.1} ms, body {:?}", world.bodies[b].translation().y, t.elapsed().as_secs_f64() * 1e3, world.bodies[b].linvel());
}
fn jam(section: Section, mass: f32, pull: f64, n_iter: usize) {
    // a box behind two posts; the winch pulls until the cable carries `pull`
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::ZERO;
    world.integration_parameters.num_solver_iterations = n_iter;
    for y in [-0.35f32, 0.35] { world.insert(RigidBodyBuilder::fixed().translation(Vector::new(0.25, y, 0.0)), ColliderBuilder::cuboid(0.1, 0.3, 1.0)); }
    let (b, _) = world.insert(RigidBodyBuilder::dynamic(), ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(mass));
    let w = world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(2.1, 0.0, 0.0)));
    let mut set = CableSet::new();
    let c = set.insert(Cable::builder().points([Vector3::new(2.1, 0.0, 0.0), Vector3::new(0.1, 0.0, 0.0)]).section(section).gravity(Vector3::zeros()).build().unwrap());
    set.attach(&world, c, At::Start, w, Vector::ZERO).unwrap();
    let at = set.attach(&world, c, At::End, b, Vector::new(0.1, 0.0, 0.0)).unwrap();
    let mut gap = 0.0f64; let mut tens = vec![]; let mut stopped = None;
    let mut winch_t = 0.0;
    for k in 0..600 {
        winch_t = set.get(c).unwrap().sample(1.0).unwrap().tension;
        if stopped.is_none() && winch_t >= pull { stopped = Some(k); }
        let speed = if stopped.is_some() { 0.0 } else { (0.5 * (1.0 - winch_t / pull)).clamp(0.002, 0.1) as f32 };
        world.bodies[w].set_linvel(Vector::new(speed, 0.0, 0.0), true);
        if let Err(e) = set.step(&mut world) { println!("FAIL jam {mass} at {k}: {e}"); return; }
        let g = set.attachment(at).unwrap().gap();
        if k > 300 { gap = gap.max(g); tens.push(set.get(c).unwrap().sample(1.0).unwrap().tension); }
        if k % 30 == 0 && std::env::args().count() > 2 { println!("  k {k} x {:.5} vx {:.5} T {winch_t:.1} gap {g:.1e}", world.bodies[b].translation().x, world.bodies[b].linvel().x); }
    }
    let (lo, hi) = tens.iter().fold((f64::MAX, f64::MIN), |a, x| (a.0.min(*x), a.1.max(*x)));
    println!("jam m {mass} N {n_iter}: stopped {stopped:?} tension {lo:.1}..{hi:.1} gap {gap:.1e} pos {:?} vel {:?} {winch_t:.1}", world.bodies[b].translation(), world.bodies[b].linvel());
}
fn two_cables(section: Section) {
    let mut world = PhysicsWorld::new();
    let (b, _) = world.insert(RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -1.0, 0.0)), ColliderBuilder::cuboid(0.3, 0.1, 0.1).mass(10.0));
    let mut set = CableSet::new();
    for s in [-1.0f32, 1.0] {
        let x = if s < 0.0 { -1.0 } else { 0.8 };
        let c = set.insert(Cable::builder().points([Vector3::new(x, 0.0, 0.0), Vector3::new(0.3 * s as f64, -0.9, 0.0)]).section(section).fix(At::Start).build().unwrap());
        set.attach(&world, c, At::End, b, Vector::new(0.3 * s, 0.1, 0.0)).unwrap();
    }
    world.bodies[b].set_linear_damping(2.0); world.bodies[b].set_angular_damping(2.0);
    let t = std::time::Instant::now();
    for _ in 0..1200 { if let Err(e) = set.step(&mut world) { println!("FAIL two {e}"); return; } }
    let body = &world.bodies[b];
    let ts: Vec<f64> = set.iter().map(|(_, c)| c.sample(c.length()).unwrap().tension).collect();
    println!("two cables: T {ts:.2?} pos {:?} vel {:?} {:.1} ms", body.translation(), body.linvel(), t.elapsed().as_secs_f64() * 1e3);
}
fn main() {
    let which = std::env::args().nth(1).unwrap_or_default();
    if which.is_empty() || which == "payload" {
    for (s, m) in [(soft(), 50.0), (soft(), 0.8), (soft(), 0.08), (steel(), 50.0), (steel(), 800.0)] {
        payload(s, m, 60.0, None); payload(s, m, 240.0, None); payload(s, m, 60.0, Some(Preset::Game)); }}
    if which.is_empty() || which == "dumbbell" { dumbbell(soft()); dumbbell(steel()); }
    if which.is_empty() || which == "hoist" { hoist(soft()); hoist(steel()); }
    if which.is_empty() || which == "jam" { for n in [4, 1] { jam(soft(), 1.0, 5000.0, n); jam(steel(), 1.0, 5000.0, n); jam(steel(), 100.0, 5000.0, n); } }
    if which.is_empty() || which == "two" { two_cables(soft()); two_cables(steel()); }
}
