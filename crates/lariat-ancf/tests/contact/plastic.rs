//! Impacts without restitution of cables on each other, and of bodies on cables.

use crate::bench::{GRAVITY, rope, steps, up, with};
use crate::bodies::{World, cube, on_body};
use lariat_ancf::contact::{Cuboid, HalfSpace, Obstacle};
use lariat_ancf::{Cable, Contact, Section, Vector3};
use std::f64::consts::PI;

/// Radius of the bars in m, and their length.
const RADIUS: f64 = 0.025;
const LENGTH: f64 = 0.2;

/// A bar that does not bend, so that none of what it loses comes back, with contact of a modulus
/// (Pa).
fn bar(line: [Vector3<f64>; 2], modulus: f64, mass: f64, velocity: Vector3<f64>) -> lariat_ancf::CableBuilder {
    let area = PI * RADIUS * RADIUS;
    // its lowest vibration is ten times as fast as the contact
    let bending = mass * f64::max(1e3, 1e-4 * modulus);
    let section = Section::from_stiffness(modulus * area, bending, mass).unwrap();
    rope(10.0, &line, 2).section(section).velocity(velocity)
}

fn touching(bar: lariat_ancf::CableBuilder) -> Cable {
    let mut bar = bar.build().unwrap();
    bar.set_contact(Contact { cables: true, ..Contact::with_friction(0.0).with_radius(RADIUS) }).unwrap();
    bar
}

/// Free bars that cross and hit each other in their middles do not bounce: they part with at most
/// 0.13 of the speed with which they met and 1 cm/s, about those of the law of contact, at every step,
/// stiffness, mass and speed; momentum stays and no energy is made.
///
/// *Source.* Impact without restitution, of which the law leaves a tenth (docs/theory.md, 7.5).
#[test]
fn bars_do_not_bounce_off_each_other() {
    let (mut worst, mut drift, mut failed) = (0.0f64, 0.0f64, Vec::new());
    for modulus in [1e5, 1e6, 1e7, 1e8, 1e10] {
        for rate in [60.0, 240.0, 960.0, 3840.0] {
            let mut row = 0.0f64;
            for (i, masses) in [[1.0, 1.0], [0.3, 1.0], [1.0, 10.0], [20.0, 20.0]].into_iter().enumerate() {
                for (j, speed) in [0.3, 1.0, 3.0].into_iter().enumerate() {
                    let part = 0.07 + 0.09 * (i + 4 * j) as f64;
                    let gap = speed * (1.0 + part) / rate;
                    let half = 0.5 * LENGTH;
                    let at = up() * (2.0 * RADIUS + gap);
                    let line = [at - half * Vector3::z(), at + half * Vector3::z()];
                    let below = bar([-half * Vector3::x(), half * Vector3::x()], modulus, masses[0], Vector3::zeros());
                    let above = bar(line, modulus, masses[1], up() * -speed);
                    let bars = [below, above].map(|bar| touching(bar.gravity(Vector3::zeros())));
                    let mut world = World::new(bars.into(), vec![]);
                    world.integrator = steps(rate);
                    let before = world.momentum().0;
                    let reduced = LENGTH * masses[0] * masses[1] / (masses[0] + masses[1]);
                    let stiffness = modulus * PI / 80.0 * LENGTH / 8.0;
                    // softer ones go through each other
                    if speed * (reduced / stiffness).sqrt() > RADIUS {
                        continue;
                    }
                    // what comes up does so in some 10/omega
                    let time = gap / speed + 4.0 / rate + 15.0 * (reduced / stiffness).sqrt();
                    world.run((60.0 * time).ceil() as usize, |_| {});
                    let held = 0.5 * LENGTH * (masses[0] + masses[1]) * speed * speed;
                    let made = world.cables[0].energy_law().made / held;
                    let velocity = |k: usize| world.cables[k].momentum().linear.y / (masses[k] * LENGTH);
                    let share = (velocity(1) - velocity(0)) / speed;
                    let off = (world.momentum().0 - before).norm() / before.norm();
                    (row, drift) = (row.max(share), drift.max(off));
                    let name = format!("E {modulus:.0e}, {rate} Hz, {masses:?} kg/m, {speed} m/s");
                    if share.abs() > 0.13 + 0.01 / speed || off > 1e-10 || made > 1e-9 {
                        failed.push(format!("{name}: {share:.3} {off:.0e} {made:.0e}"));
                    }
                }
            }
            println!("E {modulus:.0e}, {rate} Hz: part with at most {row:.3}");
            worst = worst.max(row);
        }
    }
    println!("at most {worst:.3} of their speed, momentum off by {drift:.0e}");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// How a cube of 0.4 by 0.2 by 0.4 m that falls 0.1 m comes back from two bars on a floor, of a radius of 25 mm and 500 kg/m^3: by how much
/// of its fall it rises above where it touched them, and the largest growth of energy.
fn fallen_on_bars(mass: f64, modulus: f64, rate: f64) -> [f64; 2] {
    let radius = RADIUS;
    let section = Section::round(2.0 * radius, modulus, 500.0).unwrap();
    let floor = |key| Obstacle::new(key, HalfSpace { normal: up() }, Vector3::zeros(), 0.4);
    let bars = [0.15, -0.15].map(|z| {
        let line = [Vector3::new(0.0, radius, z), Vector3::new(1.0, radius, z)];
        let bar = rope(1.0, &line, 10).section(section).integrator(steps(rate)).build().unwrap();
        let half_extents = Vector3::new(0.2, 0.1, 0.2);
        let mut bar = with(bar, vec![on_body(Cuboid { half_extents }, 0.4), floor(2)]);
        bar.set_contact(Contact::with_friction(0.4).with_radius(radius)).unwrap();
        bar
    });
    let top = 2.0 * radius + 0.1;
    let mut body = cube(mass, 0.3, Vector3::new(0.5, top + 0.1, 0.0));
    body.force = -GRAVITY * mass * up();
    let mut world = World::new(bars.into(), vec![body]);
    world.integrator = steps(rate);
    let (mut low, mut high, mut made) = (f64::INFINITY, f64::NEG_INFINITY, 0.0f64);
    for _ in 0..(0.8 * rate) as usize {
        made = made.max(world.part(1.0 / rate));
        let height = world.bodies[0].position.y - top;
        low = low.min(height);
        // it has turned back
        if height > low + 1e-9 && low < 0.01 {
            high = high.max(height);
        }
    }
    [high / 0.1, made / (mass * GRAVITY * 0.1)]
}

/// A body that falls on cables that lie does not rise again, whatever it weighs, how soft they are, and at any step.
///
/// *Source.* Newton's law of restitution, e = 0: a tenth of the speed is left, 1 % of the fall.
#[test]
fn a_body_that_falls_on_cables_on_a_floor_stays_there() {
    let mut worst = [0.0f64; 2];
    for modulus in [1e6, 1e8, 1e10] {
        // 500 kg would crush the softest to nothing
        for mass in [0.1, 1.0, 10.0, 50.0, 500.0].into_iter().filter(|mass| mass / modulus < 4e-4) {
            for rate in [60.0, 240.0, 1000.0] {
                let [rises, made] = fallen_on_bars(mass, modulus, rate);
                worst = [worst[0].max(rises), worst[1].max(made)];
                println!("{modulus:.0e} Pa, {mass} kg, {rate} Hz: rises by {rises:.4} of its fall, {made:.1e} made");
            }
        }
    }
    println!("{worst:?}");
    assert!(worst[0] < 0.012 && worst[1] < 1e-6, "{worst:?}");
}
