//! Two weights on a rope over a pulley: `cargo run --release --example pulley`.
//!
//! The pulley is a fixed drum that the rope lies on. Without friction the weights of 5 and 10 kg accelerate; with a coefficient of 0.3 the rope holds
//! 5 kg against 10 kg, and slips with 15 kg.
//!
//! # References
//!
//! Atwood: a = g (m2 - m1)/(m1 + m2 + m_rope). Euler-Eytelwein: the rope slips if m2/m1 > exp(pi mu) = 2.566, with
//! a = g (m2 - m1 e)/(m2 + m1 e), e = exp(pi mu), for a rope without mass.

use lariat_rapier::lariat_ancf::{At, Cable, Contact, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet, Event};
use std::f64::consts::{FRAC_PI_2, PI};

const DRUM: f64 = 0.1;
const ROPE: f64 = 0.005;
const GRAVITY: f64 = 9.81;

/// Returns the acceleration in m/s^2 of the heavier weight over the second quarter of a second.
fn acceleration(masses: [f64; 2], friction: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld::new();
    let lying = Vector::new(FRAC_PI_2 as Real, 0.0, 0.0);
    world
        .insert_collider(ColliderBuilder::cylinder(0.2, DRUM as Real).rotation(lying).friction(friction as Real), None);
    // half a turn over the drum, 1 m down on both sides
    let arm = DRUM + ROPE;
    let mut points = vec![Vector3::new(-arm, -1.0, 0.0)];
    points.extend((0..=24).map(|i| PI * f64::from(i) / 24.0).map(|a| Vector3::new(-a.cos(), a.sin(), 0.0) * arm));
    points.push(Vector3::new(arm, -1.0, 0.0));
    let rope = Cable::builder()
        .points(points)
        .section(Section::from_stiffness(1e6, 1e-3, 0.05)?) // EA, EI, 0.05 kg/m
        .elements(42);
    let mut cables = CableSet::new();
    let rope = cables.insert(rope.build()?);
    cables.set_contact(rope, Contact::with_friction(friction).with_radius(ROPE))?;
    let mut weights = Vec::new();
    for (x, mass, end) in [(-arm, masses[0], At::Start), (arm, masses[1], At::End)] {
        let place = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, -1.05, 0.0));
        let (weight, _) = world.insert(place, ColliderBuilder::cuboid(0.05, 0.05, 0.05).mass(mass as Real));
        cables.attach(&world, rope, end, weight, Vector::new(0.0, 0.05, 0.0), AttachmentKind::Ball)?;
        weights.push(weight);
    }
    let speed = |world: &PhysicsWorld| -f64::from(world.bodies[weights[1]].linvel().y);
    let mut before = 0.0;
    for step in 0..30 {
        cables.step(&mut world)?;
        for event in cables.events() {
            if let Event::ContactStarted { arc_length, force, .. } = event {
                println!("  touches the drum at {arc_length:.3} m with {force:.1} N");
            }
        }
        if step == 14 {
            before = speed(&world);
        }
    }
    Ok((speed(&world) - before) / 0.25)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grip = (0.3 * PI).exp();
    let rope = 0.05 * (2.0 + PI * (DRUM + ROPE));
    let cases = [
        ("frictionless, 5 and 10 kg", [5.0, 10.0], 0.0, GRAVITY * 5.0 / (15.0 + rope)),
        ("mu = 0.3, 5 and 10 kg", [5.0, 10.0], 0.3, 0.0),
        ("mu = 0.3, 5 and 15 kg", [5.0, 15.0], 0.3, GRAVITY * (15.0 - 5.0 * grip) / (15.0 + 5.0 * grip)),
    ];
    let mut right = true;
    for (name, masses, friction, exact) in cases {
        println!("{name}:");
        let a = acceleration(masses, friction)?;
        println!("  {a:.4} m/s^2, in theory {exact:.4}");
        right &= (a - exact).abs() < 0.02 * GRAVITY;
    }
    if right { Ok(()) } else { Err("an acceleration differs from theory".into()) }
}
