//! Two balls connected by a cable spin without gravity: `cargo run --release --example dumbbell`.
//!
//! # References
//!
//! Nothing acts from outside, so momentum and angular momentum are conserved. The cable starts unstretched and vibrates along its axis;
//! the energy is conserved up to the numerical damping of the integrator (1e-3 of it is allowed).

use lariat_rapier::lariat_ancf::{At, Cable, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

const SPIN: f64 = 5.0; // rad/s
const CENTRE: f64 = -0.36 / 8.72; // m: of 2 kg at -1.5 m, 6 kg at 0.5 m and 0.72 kg of cable at -0.5 m

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::ZERO;
    let balls = [(-1.5, 2.0), (0.5, 6.0)].map(|(x, mass)| {
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(x, 0.0, 0.0))
            .linvel(Vector::new(0.0, (SPIN * (f64::from(x) - CENTRE)) as Real, 0.0))
            .angvel(Vector::new(0.0, 0.0, SPIN as Real));
        world.insert(body, ColliderBuilder::ball(0.1).mass(mass)).0
    });
    let mut cables = CableSet::new();
    let line = cables.insert(
        Cable::builder()
            .points([Vector3::new(-1.4, 0.0, 0.0), Vector3::new(0.4, 0.0, 0.0)])
            .section(Section::square(0.01, 1.0e9, 4000.0)?) // m, Pa, kg/m^3
            .gravity(Vector3::zeros())
            .velocity(Vector3::new(0.0, SPIN * (-1.4 - CENTRE), 0.0)) // of the start point
            .angular_velocity(Vector3::new(0.0, 0.0, SPIN))
            .build()?,
    );
    cables.attach(&world, line, At::Start, balls[0], Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball)?;
    cables.attach(&world, line, At::End, balls[1], Vector::new(-0.1, 0.0, 0.0), AttachmentKind::Ball)?;
    let (before, energy) = (cables.momentum(&world)?, cables.energy(&world)?.total());
    for second in 1..=3 {
        for _ in 0..60 {
            cables.step(&mut world)?;
        }
        let tension = cables.get(line)?.sample(0.9)?.tension;
        println!("{second} s: light ball at {:.4?} m, tension {tension:.1} N", world.bodies[balls[0]].translation());
    }
    let (after, left) = (cables.momentum(&world)?, cables.energy(&world)?.total());
    let (linear, angular) = ((after.linear - before.linear).norm(), (after.angular / before.angular.z).z - 1.0);
    println!(
        "momentum changed by {linear:.1e} kg m/s, angular momentum by {angular:.1e} of itself, energy by {:.1e}",
        left / energy - 1.0
    );
    if linear < 1e-4 && angular.abs() < 1e-4 && (left / energy - 1.0).abs() < 1e-3 {
        Ok(())
    } else {
        Err("momentum or energy is not conserved".into())
    }
}
