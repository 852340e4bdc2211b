//! A winch takes up the slack of a rope and lifts a box off the ground: `cargo run --release --example hoist`.
//!
//! # References
//!
//! At rest the rope carries the weight of the box, 10 kg x 9.81 m/s^2 = 98.10 N, and is elongated by (box + half the rope) g L/EA. The box
//! rises by the displacement of the winch less slack and elongation (single precision adds 0.5 mm to that displacement).

use lariat_rapier::lariat_ancf::{At, Cable, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld::new();
    world.insert_collider(ColliderBuilder::cuboid(2.0, 0.5, 2.0).translation(Vector::new(0.0, -0.5, 0.0)), None);
    let (load, _) = world.insert(
        RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.1, 0.0)).can_sleep(false),
        ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(10.0).friction(0.6),
    );
    let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(0.0, 2.1, 0.0)));
    let mut cables = CableSet::new();
    let rope = cables.insert(
        Cable::builder()
            .points([Vector3::new(0.0, 2.1, 0.0), Vector3::new(0.0, 0.2, 0.0)])
            .length(1.91) // m: 1 cm slack
            .section(Section::square(0.01, 1.0e9, 4000.0)?) // EA = 1e5 N, 0.4 kg/m
            // L-stable: damps the vibration of the box on the rope; the material has no damping here
            .integrator(Integrator {
                method: "generalised-alpha-0".parse()?,
                control: StepControl::MaxStep(1.0 / 240.0),
            })
            .build()?,
    );
    cables.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball)?;
    let hook = cables.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball)?;
    let (mut pull, mut lifted) = (0.0, 0.0);
    for step in 0..720 {
        // 0.5 m in all: slowly while the rope gets taut, faster, slowly to the stop
        let speed = match step {
            60..240 => 0.01,
            240..420 => 0.14,
            420..525 => 0.028571429,
            _ => 0.0,
        };
        world.bodies[winch].set_linvel(Vector::new(0.0, speed, 0.0), true);
        cables.step(&mut world)?;
        let (force, height) = (cables.attachment(hook)?.force().y, f64::from(world.bodies[load].translation().y) - 0.1);
        if step % 120 == 119 {
            println!("{:2} s: lifted {height:.4} m, the hook carries {force:.2} N", (step + 1) / 60);
        }
        if step >= 660 {
            (pull, lifted) = (pull + force / 60.0, lifted + height / 60.0);
        }
    }
    let displacement = f64::from(world.bodies[winch].translation().y) - 2.1;
    let expected = displacement - 0.01 - 1.91 * 9.81 * (10.0 + 0.5 * 1.91 * 0.4) / 1.0e5;
    println!("at rest: {pull:.3} N of 98.10 N, lifted {lifted:.5} m of {expected:.5} m");
    if (pull / 98.10 - 1.0).abs() < 2e-3 && (lifted - expected).abs() < 2e-4 {
        Ok(())
    } else {
        Err("force or height differ from statics".into())
    }
}
