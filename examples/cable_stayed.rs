//! A deck of 600 kg sinks on six stays, three from each tower: `cargo run --release --example cable_stayed`.
//!
//! # References
//!
//! A rigid deck on elastic bars sinks level by v. A stay of length L at the angle a carries `N = EA v sin(a)/L`, and
//! `v = W/sum(EA sin^2(a)/L)`, with the geometry before the deck sinks.

use lariat_rapier::lariat_ancf::{At, Cable, Damping, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

const STIFFNESS: f64 = 1.5e6; // EA, N

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld::new();
    let (deck, _) = world.insert(
        RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.9, 0.0)).can_sleep(false),
        ColliderBuilder::cuboid(6.0, 0.1, 0.8).mass(600.0),
    );
    let (mut cables, mut stays) = (CableSet::new(), Vec::new());
    for x in [-5.0, -3.0, -1.0, 1.0, 3.0, 5.0] {
        let top = Vector3::new(f64::copysign(6.5, x), 5.0, 0.0);
        let stay = Cable::builder()
            .name(format!("stay at {x} m"))
            .points([top, Vector3::new(x, 1.0, 0.0)])
            .section(Section::from_stiffness(STIFFNESS, 0.5, 0.05)?) // EA N, EI N m^2, kg/m
            .elements(6)
            .damping(Damping { axial: 0.01, bending: 0.0 }) // s
            .integrator(Integrator {
                method: "generalised-alpha-0".parse()?,
                control: StepControl::MaxStep(1.0 / 240.0),
            })
            .fix(At::Start)
            .build()?;
        let stay = cables.insert(stay);
        let end = cables.attach(&world, stay, At::End, deck, Vector::new(x as Real, 0.1, 0.0), AttachmentKind::Ball)?;
        stays.push((x, end));
    }
    for _ in 0..300 {
        cables.step(&mut world)?; // 5 s
    }
    let sine_and_length = |x: f64| (4.0 / (6.5 - x.abs()).hypot(4.0), (6.5 - x.abs()).hypot(4.0));
    let weight = 600.0 * 9.81;
    let sinks =
        weight / stays.iter().map(|(x, _)| sine_and_length(*x)).map(|(s, l)| STIFFNESS * s * s / l).sum::<f64>();
    let (mut lift, mut worst) = (0.0, 0.0f64);
    for (x, end) in &stays {
        let (force, (sine, length)) = (cables.attachment(*end)?.force(), sine_and_length(*x));
        let expected = STIFFNESS * sinks * sine / length;
        lift += force.y;
        worst = worst.max((force.norm() / expected - 1.0).abs());
        println!("stay at {x:+} m: {:7.1} N, linear theory {expected:7.1} N", force.norm());
    }
    let sunk = 0.9 - f64::from(world.bodies[deck].translation().y);
    println!(
        "deck sunk by {:.3} mm, linear theory {:.3} mm; lift {lift:.1} N of {weight:.1} N",
        1e3 * sunk,
        1e3 * sinks
    );
    if worst < 5e-3 && (lift / weight - 1.0).abs() < 1e-3 {
        Ok(())
    } else {
        Err("forces of the stays differ from linear theory".into())
    }
}
