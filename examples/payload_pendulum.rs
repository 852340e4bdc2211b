//! A crate of 50 kg on a cable of 0.8 kg, released from horizontal: `cargo run --release --example payload_pendulum`.
//!
//! Compares the centre of the crate after 0.5 s and 1 s with a fine run of an independent monolithic program (error 2e-5 m).

use lariat_rapier::lariat_ancf::{At, Cable, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        let mut world = PhysicsWorld::new();
        let (crate_, _) = world.insert(
            RigidBodyBuilder::dynamic().translation(Vector::new(2.0, -0.1, 0.0)),
            ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0),
        );
        let sling = Cable::builder()
            .name("sling")
            .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)]) // m
            .section(Section::square(0.01, 1.0e9, 4000.0)?) // m, Pa, kg/m^3
            .rule("G5-3".parse()?)
            .fidelity(fidelity)
            .fix(At::Start)
            .build()?;
        let mut cables = CableSet::new();
        let sling = cables.insert(sling);
        let hook = cables.attach(&world, sling, At::End, crate_, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball)?;
        println!("{fidelity:?}");
        let start = std::time::Instant::now();
        for step in 1..=60 {
            cables.step(&mut world)?; // one host step of 1/60 s
            if step % 30 == 0 {
                let at = world.bodies[crate_].translation();
                let expected = [(1.70292, -1.21801), (-0.82138, -1.91419)][step / 30 - 1];
                let off = (f64::from(at.x) - expected.0).hypot(f64::from(at.y) - expected.1);
                println!(
                    "  {:.1} s: crate at {:.4}, {:.4} m, error {off:.1e} m; force of the cable {:.1} N, gap {:.0e} m",
                    step as f64 / 60.0,
                    at.x,
                    at.y,
                    cables.attachment(hook)?.force().norm(),
                    cables.attachment(hook)?.gap()
                );
                let most = if fidelity == Fidelity::Game { 2e-2 } else { 6e-3 };
                if off > most {
                    return Err(format!("the error is more than {most} m").into());
                }
            }
        }
        println!("  {:.0} us per host step", start.elapsed().as_secs_f64() / 60.0 * 1e6);
    }
    Ok(())
}
