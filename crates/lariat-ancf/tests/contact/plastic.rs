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

fn touching(bar: lariat_ancf::CableBuilder, restitution: f64) -> Cable {
    let mut bar = bar.build().unwrap();
    let contact = Contact::with_friction(0.0).with_radius(RADIUS).with_restitution(restitution);
    bar.set_contact(Contact { cables: true, ..contact }).unwrap();
    bar
}

/// Two free bars that cross, of masses (kg/m), of which one flies at a speed (m/s) against the middle of the other; `part` is the share of a
/// step after which they meet.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    modulus: f64,
    rate: f64,
    masses: [f64; 2],
    speed: f64,
    part: f64,
    restitution: f64,
}

impl Meeting {
    /// Returns all of some stiffnesses and steps, masses and speeds; bars so soft that they go through each other are none.
    fn all(moduli: &[f64], rates: &[f64], restitution: f64) -> Vec<Meeting> {
        let mut all = Vec::new();
        for (&modulus, &rate) in moduli.iter().flat_map(|modulus| rates.iter().map(move |rate| (modulus, rate))) {
            for (i, masses) in [[1.0, 1.0], [0.3, 1.0], [1.0, 10.0], [20.0, 20.0]].into_iter().enumerate() {
                for (j, speed) in [0.3, 1.0, 3.0].into_iter().enumerate() {
                    let part = 0.07 + 0.09 * (i + 4 * j) as f64;
                    all.push(Meeting { modulus, rate, masses, speed, part, restitution });
                }
            }
        }
        all.retain(|meeting| meeting.speed * meeting.period() <= RADIUS);
        all
    }

    /// Returns the period of the contact over two pi in s.
    fn period(&self) -> f64 {
        let reduced = LENGTH * self.masses[0] * self.masses[1] / (self.masses[0] + self.masses[1]);
        (reduced / (self.modulus * PI / 80.0 * LENGTH / 8.0)).sqrt()
    }

    /// Returns the share of their speed with which they part, how far momentum is off, and the energy made as a share.
    fn run(&self) -> [f64; 3] {
        let Meeting { modulus, rate, masses, speed, part, restitution } = *self;
        let (gap, half) = (speed * (1.0 + part) / rate, 0.5 * LENGTH);
        let at = up() * (2.0 * RADIUS + gap);
        let line = [at - half * Vector3::z(), at + half * Vector3::z()];
        let below = bar([-half * Vector3::x(), half * Vector3::x()], modulus, masses[0], Vector3::zeros());
        let above = bar(line, modulus, masses[1], up() * -speed);
        let bars = [below, above].map(|bar| touching(bar.gravity(Vector3::zeros()), restitution));
        let mut world = World::new(bars.into(), vec![]);
        world.integrator = steps(rate);
        let before = world.momentum().0;
        // what comes up does so in some 10/omega
        let time = gap / speed + 4.0 / rate + 15.0 * self.period();
        world.run((60.0 * time).ceil() as usize, |_| {});
        let held = 0.5 * LENGTH * (masses[0] + masses[1]) * speed * speed;
        let velocity = |k: usize| world.cables[k].momentum().linear.y / (masses[k] * LENGTH);
        let off = (world.momentum().0 - before).norm() / before.norm();
        [(velocity(1) - velocity(0)) / speed, off, world.cables[0].energy_law().made / held]
    }
}

/// Free bars that cross and hit each other in their middles do not bounce: they part with at most
/// 0.13 of the speed with which they met and 1 cm/s, about those of the law of contact, at every step,
/// stiffness, mass and speed; momentum stays and no energy is made.
///
/// *Source.* Impact without restitution, of which the law leaves a tenth (docs/theory.md, 7.5).
#[test]
fn bars_do_not_bounce_off_each_other() {
    let (mut worst, mut drift, mut failed) = (0.0f64, 0.0f64, Vec::new());
    for meeting in Meeting::all(&[1e5, 1e6, 1e7, 1e8, 1e10], &[60.0, 240.0, 960.0, 3840.0], 0.0) {
        let [share, off, made] = meeting.run();
        (worst, drift) = (worst.max(share), drift.max(off));
        if share.abs() > 0.13 + 0.01 / meeting.speed || off > 1e-10 || made > 1e-9 {
            failed.push(format!("{meeting:?}: {share:.3} {off:.0e} {made:.0e}"));
        }
    }
    println!("at most {worst:.3} of their speed, momentum off by {drift:.0e}");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// With restitution they part with that share of their speed, to about what bounces off obstacles do (docs/decisions/restitution.md).
///
/// *Source.* Newton's law of restitution.
#[test]
fn bars_bounce_off_each_other_by_their_restitution() {
    let (mut failed, mut least, mut most) = (Vec::new(), f64::INFINITY, 0.0f64);
    for restitution in [0.3, 0.6, 0.8] {
        for meeting in Meeting::all(&[1e6, 1e8, 1e10], &[60.0, 240.0, 960.0, 3840.0], restitution) {
            let [share, off, made] = meeting.run();
            (least, most) = (least.min(share / restitution), most.max(share / restitution));
            if !(0.87..1.1).contains(&(share / restitution)) || off > 1e-10 || made > 1e-9 {
                failed.push(format!("{meeting:?}: {share:.3} {off:.0e} {made:.0e}"));
            }
        }
    }
    println!("{least:.3} to {most:.3} of e");
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
