//! Impacts without restitution of cables on each other.

use crate::bench::{rope, steps, up};
use crate::bodies::World;
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
