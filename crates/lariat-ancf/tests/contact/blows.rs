//! Cables that hit each other.

use crate::bench::{RADIUS, rope, steps, up};
use crate::bodies::World;
use lariat_ancf::{Cable, Contact, Section, Vector3};

/// Length of the bars in m.
const LENGTH: f64 = 0.2;

/// A stiff bar through `middle`, which touches cables.
fn bar(middle: Vector3<f64>, along: Vector3<f64>, section: Section, velocity: Vector3<f64>) -> Cable {
    let line = [middle - 0.5 * LENGTH * along, middle + 0.5 * LENGTH * along];
    let bar = rope(10.0, &line, 2).section(section).gravity(Vector3::zeros()).velocity(velocity);
    let mut bar = bar.build().unwrap();
    bar.set_contact(Contact { cables: true, ..Contact::with_friction(0.0).with_radius(RADIUS) }).unwrap();
    bar
}

fn momentum(world: &World) -> Vector3<f64> {
    world.momentum().0
}

/// Two free stiff bars that cross and hit each other in their middles go on with one velocity, with any part of a step left when they touch, at any speed,
/// angle, mass, stiffness and step. Momentum is kept to rounding, and no energy is made.
///
/// *Source.* Impact without restitution.
#[test]
fn bars_that_hit_each_other_do_not_part() {
    let (mut worst, mut drift) = (0.0f64, 0.0f64);
    for rate in [60.0, 120.0, 240.0, 480.0, 960.0] {
        for (axial, masses) in [(1e4, [0.02, 0.02]), (1e6, [0.14, 0.14]), (1e6, [0.14, 5.0]), (1e8, [0.5, 0.14])] {
            for i in 0..12 {
                let (part, speed) = (f64::from(i) / 12.0, 0.3 + 0.67 * f64::from(i));
                let gap = 0.02 * (1.0 + part);
                let sections = masses.map(|mass| Section::from_stiffness(axial, 1e3 * mass, mass).unwrap());
                let angle = 0.5 + part;
                let across = Vector3::new(angle.cos(), 0.0, angle.sin());
                let beside = Vector3::new(0.1, 0.0, 0.2);
                let below = bar(Vector3::zeros(), Vector3::x(), sections[0], beside);
                let above = bar(up() * (2.0 * RADIUS + gap), across, sections[1], beside - up() * speed);
                let mut world = World::new(vec![below, above], vec![]);
                world.integrator = steps(rate);
                let before = momentum(&world);
                let time = 1.5 * gap / speed + 4.0 / rate;
                world.run((60.0 * time).ceil() as usize, |_| {});
                let made = world.cables[0].energy_law().made;
                let velocity = |k: usize| world.cables[k].momentum().linear / (masses[k] * LENGTH);
                let share = (velocity(1) - velocity(0)).y.abs() / speed;
                let off = (momentum(&world) - before).norm() / before.norm();
                (worst, drift) = (worst.max(share), drift.max(off));
                let held = 0.5 * masses.iter().sum::<f64>() * LENGTH * speed * speed;
                // twice as fine steps resolve the softest contacts in part
                let bound = if rate <= 240.0 { 0.02 } else { 0.1 };
                assert!(share < bound, "{rate} Hz, {axial:.0e} N, {masses:?} kg/m, {speed} m/s: {share}");
                assert!(off < 1e-11 && made <= 1e-9 * held, "{off:e} {made:e} of {held:e}");
            }
        }
    }
    println!("part with at most {worst:.1e} of their speed, momentum off by {drift:.1e}");
}

/// Two free stiff bars that hit each other beside their middles turn as rigid rods after an impact without restitution.
///
/// *Source.* Uniform rods, the points of which that touch go on with one velocity along the normal: the impulse is `v/sum (1 + 12 b^2/L^2)/m`, b the arms.
#[test]
fn bars_that_hit_beside_their_middles_turn_as_rods() {
    for rate in [60.0, 240.0, 960.0] {
        for arms in [[0.0, 0.04], [0.03, 0.06], [0.07, 0.0]] {
            for i in 0..8 {
                let (speed, gap) = (1.0 + 0.31 * f64::from(i), 1e-3 + 7e-3 * f64::from(i) / 8.0);
                let section = Section::from_stiffness(1e6, 1e3, 0.14).unwrap();
                let below = bar(Vector3::x() * -arms[0], Vector3::x(), section, Vector3::zeros());
                let middle = up() * (2.0 * RADIUS + gap) - Vector3::z() * arms[1];
                let above = bar(middle, Vector3::z(), section, up() * -speed);
                let mut world = World::new(vec![below, above], vec![]);
                world.integrator = steps(rate);
                let hit = |world: &World| world.cables[0].momentum().linear.norm() > 1e-3 * 0.14 * LENGTH * speed;
                while !hit(&world) {
                    world.part(1.0 / rate);
                }
                world.part(1.0 / rate);
                let mass = 0.14 * LENGTH;
                let impulse = -world.cables[0].momentum().linear.y / mass / speed;
                let lever = arms.iter().map(|b| 1.0 + 12.0 * b * b / (LENGTH * LENGTH)).sum::<f64>();
                let exact = 1.0 / lever;
                println!("{rate} Hz, {arms:?} m, {speed:.2} m/s: {impulse:.4} for {exact:.4}");
                assert!((impulse / exact - 1.0).abs() < 0.02, "{impulse} for {exact}");
            }
        }
    }
}
