use lariat_rapier::lariat_ancf::{At, Cable, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};
fn run() -> Result<f64, Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld::new();
    let (crate_, _) = world.insert(
        RigidBodyBuilder::dynamic().translation(Vector::new(2.0, -0.1, 0.0)),
        ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0),
    );
    let sling = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1.0e9, 4000.0)?)
        .elements(10)
        .fidelity(Fidelity::Game)
        .fix(At::Start)
        .build()?;
    let mut cables = CableSet::new();
    let sling = cables.insert(sling);
    cables.attach(&world, sling, At::End, crate_, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball)?;
    let start = std::time::Instant::now();
    for _ in 0..120 {
        cables.step(&mut world)?;
    }
    let t = start.elapsed().as_secs_f64();
    if std::env::var("COUNT").is_ok() {
        let d = cables.get(sling).unwrap().diagnostics().clone();
        println!("{d:?} {:?}", world.bodies[crate_].translation());
    }
    Ok(t / 120.0 * 1e6)
}
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let n: usize = std::env::args().nth(1).map_or(Ok(50), |n| n.parse())?;
    let mut best = f64::INFINITY;
    for _ in 0..n {
        best = best.min(run()?);
    }
    println!("{best:.2} us per host step");
    Ok(())
}
