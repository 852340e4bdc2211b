//! A helicopter starts at 3 m/s with a load on a cable and stops after one period of the pendulum, when the load is at rest below it.
//! `cargo run --release --example slung_load`
//!
//! # References
//!
//! A simple pendulum of length L with the initial speed v swings to `a = acos(1 - v^2/2gL)`; its period is `4 sqrt(L/g) K(sin(a/2))`,
//! which is 6.4 s (384 host steps) for L = 10.06165 m, the length of the stretched cable.

use lariat_rapier::lariat_ancf::{At, Cable, Damping, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

const LENGTH: f64 = 10.06165; // m, with 200 kg on it
const SPEED: f64 = 3.0; // m/s

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld::new();
    let helicopter = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
    let (load, _) = world.insert(
        RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -LENGTH as Real, 0.0)).can_sleep(false),
        ColliderBuilder::cuboid(0.35, 0.35, 0.35).mass(200.0),
    );
    let mut cables = CableSet::new();
    let line = cables.insert(
        Cable::builder()
            .points([Vector3::zeros(), -LENGTH * Vector3::y()])
            .length(LENGTH / 1.0019562558513324) // EA (f^2 - 1) f/2 = 200 kg x g
            .section(Section::from_stiffness(1.0e6, 0.1, 0.02)?) // EA N, EI N m^2, kg/m
            .damping(Damping { axial: 0.005, bending: 0.0 }) // s
            .integrator(Integrator {
                method: "generalised-alpha-0".parse()?,
                control: StepControl::MaxStep(1.0 / 240.0),
            })
            .build()?,
    );
    cables.attach(&world, line, At::Start, helicopter, Vector::ZERO, AttachmentKind::Ball)?;
    cables.attach(&world, line, At::End, load, Vector::ZERO, AttachmentKind::Ball)?;
    let (mut out, mut left) = (0.0f64, 0.0f64);
    for step in 0..600 {
        let speed = if step < 384 { SPEED as Real } else { 0.0 };
        world.bodies[helicopter].set_linvel(Vector::new(speed, 0.0, 0.0), true);
        cables.step(&mut world)?;
        let below = world.bodies[load].translation() - world.bodies[helicopter].translation();
        let angle = f64::from(below.x).atan2(f64::from(-below.y)).to_degrees();
        if step % 96 == 95 {
            println!("{:.1} s: angle of the cable {angle:+.2} degrees", f64::from(step + 1) / 60.0);
        }
        if step < 384 { out = out.max(angle.abs()) } else { left = left.max(angle.abs()) }
    }
    let expected = (1.0 - SPEED * SPEED / (2.0 * 9.81 * LENGTH)).acos().to_degrees();
    println!("largest angle {out:.3} degrees, pendulum {expected:.3}; after the stop at most {left:.3} degrees");
    if (out / expected - 1.0).abs() < 5e-3 && left < 0.1 {
        Ok(())
    } else {
        Err("angles differ from the pendulum's".into())
    }
}
