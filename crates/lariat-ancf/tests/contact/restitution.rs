//! Cables that bounce: Newton's coefficient of restitution.

use crate::bench::{GRAVITY, RADIUS, rope, run, steps, up, with};
use crate::bodies::{World, cube, on_body};
use crate::common::Random;
use lariat_ancf::contact::{Capsule, Cuboid, HalfSpace, LARGEST_RESTITUTION, Obstacle, RigidMotion};
use lariat_ancf::{Cable, Contact, Section, Vector3};

fn floor(friction: f64, restitution: f64) -> Obstacle {
    Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), friction).with_restitution(restitution)
}

/// A stiff bar of 0.2 m that flies flat towards a floor at a height in m, without gravity.
fn flat_bar((axial, mass): (f64, f64), gap: f64, velocity: Vector3<f64>, rate: f64, floor: Obstacle) -> Cable {
    let line = [up() * (RADIUS + gap), Vector3::new(0.2, RADIUS + gap, 0.0)];
    let section = Section::from_stiffness(axial, 10.0, mass).unwrap();
    let bar = rope(10.0, &line, 2).section(section).gravity(Vector3::zeros()).velocity(velocity);
    let friction = floor.friction;
    let mut bar = with(bar.integrator(steps(rate)).build().unwrap(), vec![floor]);
    bar.set_contact(Contact::with_friction(friction).with_radius(RADIUS)).unwrap();
    bar
}

/// A stiff bar that lands flat leaves with e times its speed, with any part of a step left when it lands, at any speed, mass, stiffness and step, from a floor at
/// rest and from one that moves; no step makes energy.
///
/// *Source.* Newton's law of restitution.
#[test]
fn a_bar_that_lands_flat_leaves_with_its_share_of_the_speed() {
    let mut worst = 0.0f64;
    for rate in [30.0, 60.0, 120.0, 240.0, 960.0] {
        for stiff in [(1e4, 0.02), (1e6, 0.14), (1e6, 5.0), (1e8, 0.14)] {
            for i in 0..12 {
                let restitution = [0.1, 0.35, 0.6, 0.88][i % 4];
                let i = i as f64;
                let (speed, gap) = (0.3 + 0.67 * i, 0.02 * (1.0 + 0.083 * i));
                let lift = if i % 3.0 == 0.0 { 0.3 * speed } else { 0.0 };
                let motion = RigidMotion { velocity: up() * lift, ..RigidMotion::at(Vector3::zeros()) };
                let floor = floor(0.0, restitution).moving(motion);
                let mut bar = flat_bar(stiff, gap, up() * (lift - speed), rate, floor);
                let time = 2.0 * gap / (speed - lift).abs() + 4.0 / rate;
                let made = run(&mut bar, (60.0 * time).ceil() as usize, |_| {});
                let left = (bar.momentum().linear.y / (0.2 * stiff.1) - lift) / speed;
                worst = worst.max((left - restitution).abs());
                assert!(
                    (left - restitution).abs() < 0.02,
                    "{rate} Hz, {stiff:?}, {speed} m/s: {left} for {restitution}"
                );
                // what it cannot know of the strain energy by rounding
                let rounding = 2.0 * f64::EPSILON * 0.2 * stiff.0 / (0.1 * stiff.1 * speed * speed);
                assert!(made < 1e-8 + rounding, "{rate} Hz, {stiff:?}, {speed} m/s: {made:e}");
                assert!(bar.energy_law().made <= 1e-9 * 0.1 * stiff.1 * speed * speed, "{:?}", bar.energy_law());
            }
        }
    }
    println!("differs by at most {worst:.1e} of the speed");
}

/// A stiff bar that lands on its end leaves as a rigid rod of which the end bounces, with any part of a step left when it lands.
///
/// *Source.* A uniform rod on a smooth floor: the impulse is `(1 + e) m v/(1 + 3 cos^2 a)`, a the angle to the floor.
#[test]
fn a_bar_that_bounces_on_its_end_turns_as_a_rod() {
    let mut worst = 0.0f64;
    for rate in [60.0, 240.0, 960.0] {
        for (angle, restitution) in [(0.6f64, 0.3), (0.9, 0.8), (1.2, 0.5)] {
            for i in 0..8 {
                let (speed, gap) = (1.0 + 0.31 * f64::from(i), 1e-3 + 7e-3 * f64::from(i) / 8.0);
                let (start, along) = (up() * (RADIUS + gap), Vector3::new(f64::cos(angle), f64::sin(angle), 0.0));
                let line = [start, start + 0.4 * along];
                let bar = rope(1e3, &line, 2).gravity(Vector3::zeros()).velocity(up() * -speed);
                let mut bar = with(bar.integrator(steps(rate)).build().unwrap(), vec![floor(0.0, restitution)]);
                while bar.contacts().next().is_none() {
                    bar.step(1.0 / rate).unwrap();
                }
                bar.step(1.0 / rate).unwrap();
                let left = -bar.momentum().linear.y / (0.4 * 0.14 * speed);
                let ((sine, cosine), twice) = (angle.sin_cos(), 1.0 + restitution);
                let lever = 1.0 + 3.0 * cosine * cosine;
                let exact = 1.0 - twice / lever;
                // the two steps in which it turns
                let turned = 6.0 * speed * cosine * twice / (0.4 * lever) * 2.0 / rate;
                let change = twice * 6.0 * cosine * sine / (lever * lever) * turned;
                worst = worst.max((left - exact).abs() - change);
                assert!((left - exact).abs() < 6e-3 + change, "{rate} Hz, {angle}, {speed} m/s: {left} for {exact}");
            }
        }
    }
    println!("differs by at most {worst:.1e} of the speed");
}

/// A bar that bounces while it moves along the floor loses `mu (1 + e) v` of the speed along it.
///
/// *Source.* Coulomb's law for impulses: the normal impulse is m (1 + e) v.
#[test]
fn a_bounce_takes_its_share_of_the_speed_along_the_floor() {
    for (friction, restitution) in [(0.1, 0.8), (0.3, 0.5), (0.5, 0.2), (0.5, 0.0), (0.9, 0.0)] {
        for rate in [60.0, 240.0, 960.0] {
            for phase in [0.0, 0.23, 0.51, 0.87] {
                let (fall, along) = (2.0, 5.0);
                let gap = fall * (5.0 + phase) / rate;
                let floor = floor(friction, restitution);
                let mut bar = flat_bar((1e6, 0.14), gap, Vector3::new(along, -fall, 0.0), rate, floor);
                let made = run(&mut bar, 12, |_| {});
                let speed = bar.momentum().linear / (0.2 * 0.14);
                let exact = along - friction * (1.0 + restitution) * fall;
                println!(
                    "mu {friction}, e {restitution}, 1/{rate} s: {:.4} m/s for {exact:.4}, made {made:.0e}",
                    speed.x
                );
                assert!(made < 1e-8, "{made:e}");
                assert!((speed.x - exact).abs() < 0.02 * fall, "{} for {exact}", speed.x);
                assert!((speed.y - restitution * fall).abs() < 0.02 * fall, "{}", speed.y);
            }
        }
    }
}

/// A rope that is dropped flat bounces to e^2 times the height of its fall, and comes to rest; no host step makes energy.
///
/// *Source.* Newton's law of restitution, free fall. A step takes the velocity at its beginning for that of the impact: the error is below e g h.
#[test]
fn a_rope_bounces_to_its_height_and_comes_to_rest() {
    for restitution in [0.3, 0.6, 0.88] {
        for rate in [60.0, 240.0, 960.0] {
            let height = 0.5;
            let line = [up() * (RADIUS + height), Vector3::new(1.0, RADIUS + height, 0.0)];
            let cable = rope(0.1, &line, 10).integrator(steps(rate)).build().unwrap();
            let mut cable = with(cable, vec![floor(0.5, restitution)]);
            let (mut landed, mut top, mut time, mut rest) = (false, 0.0f64, 0.0, 0.0);
            let made = run(&mut cable, 900, |cable| {
                time += 1.0 / 60.0;
                let (y, v) = (cable.node_position(5).y - RADIUS, cable.velocities()[31]);
                if !landed && v > 0.0 {
                    landed = true;
                }
                if landed && time < 1.2 {
                    top = top.max(y);
                }
                if cable.energy().kinetic > 1e-6 {
                    rest = time;
                }
            });
            let impact = f64::sqrt(2.0 * GRAVITY * height);
            let exact = (restitution * impact).powi(2) / (2.0 * GRAVITY);
            // and 2 % by the rope's own damping and the host steps between which it turns
            let error = restitution * restitution * impact / rate + 0.02 * exact;
            println!(
                "e {restitution}, 1/{rate} s: {top:.4} m for {exact:.4}, at rest after {rest:.2} s, made {made:.0e}"
            );
            assert!(made < 1e-8, "{made:e}");
            assert!((top - exact).abs() < error, "{top} for {exact}, {error}");
            assert!(rest < 14.0, "{rest}");
        }
    }
}

/// A bar that flies against a free box: momentum stays, and they part with e times the speed with which they met.
///
/// *Source.* Newton's law of restitution and the conservation of momentum.
#[test]
fn a_bar_bounces_off_a_free_box() {
    for (mass, restitution) in [(0.01, 0.5), (0.1, 0.8), (3.0, 0.3)] {
        for rate in [60.0, 240.0] {
            for phase in [0.1, 0.42, 0.77] {
                let speed = 2.0;
                let gap = speed * (3.0 + phase) / rate;
                let line = [Vector3::new(-0.1, 0.0, 0.0), Vector3::new(0.1, 0.0, 0.0)]
                    .map(|x| x + up() * (0.1 + RADIUS + gap));
                let bar = rope(10.0, &line, 2).gravity(Vector3::zeros()).velocity(up() * -speed).build().unwrap();
                let box_ = on_body(Cuboid { half_extents: Vector3::repeat(0.1) }, 0.0).with_restitution(restitution);
                let bar = with(bar, vec![box_]);
                let mut world = World::new(vec![bar], vec![cube(mass, 0.2, Vector3::zeros())]);
                world.integrator = steps(rate);
                let before = world.momentum();
                let made = world.run(20, |_| {});
                let after = world.momentum();
                let own = world.cables[0].momentum().linear.y / (0.2 * 0.14);
                let other = (after.0.y - world.cables[0].momentum().linear.y) / mass;
                println!(
                    "{mass} kg, e {restitution}: part at {:.4} for {:.4}, made {made:.0e}",
                    own - other,
                    restitution * speed
                );
                assert!((after.0 - before.0).norm() < 1e-10 * before.0.norm(), "{:?} {:?}", before, after);
                assert!(made < 1e-8, "{made:e}");
                assert!((own - other - restitution * speed).abs() < 0.02 * speed, "{own} {other}");
            }
        }
    }
}

/// More than the energy law allows, and what is no coefficient, is an error.
#[test]
fn restitution_out_of_range_is_an_error() {
    for restitution in [-0.1, 0.89, f64::NAN] {
        let line = [up(), up() + Vector3::x()];
        let mut cable = rope(0.1, &line, 2).build().unwrap();
        assert!(cable.set_obstacles([floor(0.0, restitution)]).is_err(), "{restitution}");
    }
    for restitution in [-0.1, 1.1, f64::NAN] {
        let mut cable = rope(0.1, &[up(), up() + Vector3::x()], 2).build().unwrap();
        let contact = Contact::default().with_radius(RADIUS).with_restitution(restitution);
        assert!(cable.set_contact(contact).is_err(), "{restitution}");
    }
}

/// Ropes that are thrown at a floor, a box and a rod with any restitution and friction make no energy, no step is refused, and none sinks into the floor.
///
/// *Source.* The energy law. Fresh seeds with `LARIAT_SEEDS=a..b`.
#[test]
fn thrown_ropes_that_bounce_make_no_energy() {
    let seeds = std::env::var("LARIAT_SEEDS").ok().map(|range| {
        let (first, last) = range.split_once("..").expect("LARIAT_SEEDS=a..b");
        first.parse().unwrap()..last.parse().unwrap()
    });
    let (mut worst, mut split) = (0.0f64, 0);
    for seed in seeds.unwrap_or(500..540u64) {
        let mut random = Random::new(seed);
        let mut unit = || 0.5 * (random.next() + 1.0);
        let power = |x: f64, low: f64, high: f64| 10f64.powf(low + (high - low) * x);
        let (ea, ei, mass) = (power(unit(), 3.0, 7.0), power(unit(), -5.0, 0.0), power(unit(), -2.0, 0.5));
        let elements = 4 + (unit() * 16.0) as usize;
        let (friction, rate) = (unit(), [60.0, 120.0, 240.0][(3.0 * unit()) as usize]);
        let mut vector = |size: f64| Vector3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5) * size;
        let along = vector(1.0).normalize();
        let middle = vector(0.4) + up() * 1.3;
        let (velocity, spin) = (vector(8.0) - 3.0 * up(), vector(6.0));
        let cable = Cable::builder()
            .points([middle - along, middle + along])
            .section(Section::from_stiffness(ea, ei, mass).unwrap())
            .elements(elements)
            .gravity(-GRAVITY * up())
            .velocity(velocity - spin.cross(&along))
            .angular_velocity(spin)
            .integrator(steps(rate));
        let mut bounces = |obstacle: Obstacle| obstacle.with_restitution(LARGEST_RESTITUTION * unit());
        let rod = Capsule { ends: [Vector3::z() * -3.0, Vector3::z() * 3.0], radius: 0.004 };
        let floor = Obstacle::new(1, HalfSpace { normal: up() }, up() * -0.5, friction);
        let block = Cuboid { half_extents: Vector3::new(0.3, 0.2, 0.4) };
        let block = Obstacle::new(2, block, Vector3::new(0.5, -0.2, 0.0), friction);
        let rod = Obstacle::new(3, rod, Vector3::new(-0.4, 0.0, 0.0), friction);
        let obstacles = [floor, block, rod].map(&mut bounces);
        let mut cable = with(cable.build().unwrap(), obstacles.to_vec());
        cable.set_contact(Contact::with_friction(friction).with_radius(RADIUS)).unwrap();
        let mut deep = 0;
        let made = run(&mut cable, 60, |cable| {
            let sinks = cable.contacts().any(|touch| touch.obstacle == 1 && touch.depth > 0.2 * RADIUS);
            deep = if sinks { deep + 1 } else { 0 };
            assert!(deep < 7, "seed {seed}: in the floor for 0.1 s");
        });
        worst = worst.max(made);
        split += cable.diagnostics().split_steps;
        assert!(made < 1e-7, "seed {seed}: {made:e}");
    }
    println!("made {worst:.1e}, {split} divided steps");
}

/// A bar of a radius (m), modulus (Pa) and speed (m/s) lands flat on a slope, with restitution, at
/// a rate (Hz), with a part of a step left; returns the share of its speed with which it leaves.
fn bounce((r, modulus, speed): (f64, f64, f64), rate: f64, part: f64, restitution: f64) -> f64 {
    let area = std::f64::consts::PI * r * r;
    let (mass, axial, slope, h) = (1000.0 * area, modulus * area, 0.3 * part, 1.0 / rate);
    let normal = Vector3::new(-slope.sin(), slope.cos(), 0.0);
    let along = Vector3::new(slope.cos(), slope.sin(), 0.0);
    let middle = normal * (r + speed * h * (1.0 + part));
    let section = Section::from_stiffness(axial, axial * r * r, mass).unwrap();
    let bar = rope(10.0, &[middle - 2.0 * r * along, middle + 2.0 * r * along], 1).section(section);
    let bar = bar.gravity(Vector3::zeros()).velocity(normal * -speed).integrator(steps(rate));
    let floor = Obstacle::new(1, HalfSpace { normal }, Vector3::zeros(), 0.0).with_restitution(restitution);
    let mut bar = with(bar.build().unwrap(), vec![floor]);
    bar.set_contact(Contact::with_friction(0.0).with_radius(r)).unwrap();
    let period = std::f64::consts::PI * (40.0 * mass / axial).sqrt() * r;
    let mut left = -1.0f64;
    for _ in 0..((6.0 * period).min(0.5) / h).ceil() as usize + 6 {
        bar.step(h).unwrap();
        left = left.max(bar.momentum().linear.dot(&normal) / (4.0 * r * mass * speed));
    }
    let made = bar.energy_law().made;
    let held = 2.0 * r * mass * speed * speed;
    assert!(made <= 1e-8 * held + 1e-15 * axial * r, "r {r}, E {modulus:.0e}, 1/{rate} s: {made:e} of {held:e}");
    left
}

/// Radii in m and moduli in Pa of bars.
const BARS: [(f64, f64); 7] =
    [(2e-3, 1e5), (2e-3, 2e11), (5e-3, 1e7), (0.025, 1e6), (0.05, 1e5), (0.05, 1e9), (0.05, 2e11)];

/// A bar that lands flat leaves with e times its speed whether a step resolves the touch or not: at
/// 1 to 1024 steps per 1/60 s, moduli of 1e5 to 2e11 Pa, radii of 2 to 50 mm, and two speeds, on a
/// floor of any slope, with any part of a step left. No step makes energy.
///
/// *Source.* Newton's law of restitution. What is more than e is the speed of 1 cm/s over which the
/// force fades, and what a step that just resolves the touch sees of its mean speed.
#[test]
fn a_bounce_is_the_same_at_every_step_stiffness_and_radius() {
    // of the largest a step as long as the touch itself takes an eighth, by the dissipation of the
    // method
    for (restitution, low) in [(0.3, 0.99), (0.6, 0.99), (0.8, 0.95), (LARGEST_RESTITUTION, 0.86)] {
        let (mut least, mut most) = ((f64::INFINITY, String::new()), (0.0, String::new()));
        for (r, modulus) in BARS {
            for (k, phase, speed) in (0..=5).flat_map(|k| (0..6).flat_map(move |i| [(k, i, 2.0), (k, i, 0.3)])) {
                let (rate, part) = (60.0 * f64::from(4u32.pow(k)), f64::from(phase) / 6.0);
                let left = bounce((r, modulus, speed), rate, part, restitution);
                let share = left / restitution;
                let kind = || format!("r {r}, E {modulus:.0e}, 1/{rate} s, part {part:.2}, {speed} m/s");
                assert!(share > low && left < 1.07 * restitution + 0.01 / speed, "{restitution} {left} {}", kind());
                if share < least.0 {
                    least = (share, kind());
                }
                if share > most.0 {
                    most = (share, kind());
                }
            }
        }
        println!("e {restitution:.2}: {least:?} to {most:?}");
    }
}

/// Without restitution a bar that lands flat leaves with at most 0.11 of its speed, 1 % of the
/// height, whether a step resolves the touch or not, and with less than 0.01 where the touch is a
/// small part of a step: at the steps, moduli, radii, slopes and speeds of the bars that bounce. No step
/// makes energy.
///
/// *Source.* Impact without restitution. What is left is the tenth with which the contact comes up,
/// and the speed of 1 cm/s.
#[test]
fn a_bar_without_restitution_does_not_bounce_at_any_step_stiffness_and_radius() {
    // h omega of the law of constant stiffness above which a cell counts, and what it may leave
    let bounds = [(50.0, 0.01), (2.5, 0.08), (0.2, 0.11), (0.0, 0.1)];
    let mut most = bounds.map(|_| (0.0, String::new()));
    for (r, modulus) in BARS {
        for (k, phase, speed) in (0..=5).flat_map(|k| (0..6).flat_map(move |i| [(k, i, 2.0), (k, i, 0.3)])) {
            let (rate, part) = (60.0 * f64::from(4u32.pow(k)), f64::from(phase) / 6.0);
            let left = bounce((r, modulus, speed), rate, part, 0.0) - 0.01 / speed;
            let steps = f64::sqrt(modulus / 4e4) / (r * rate);
            let i = bounds.iter().position(|bound| steps > bound.0).unwrap();
            let kind = format!("r {r}, E {modulus:.0e}, 1/{rate} s, part {part:.2}, {speed} m/s, h omega {steps:.2}");
            if left > most[i].0 {
                most[i] = (left, kind);
            }
        }
    }
    println!("leaves with {most:#?}");
    assert!(most.iter().zip(bounds).all(|(most, bound)| most.0 < bound.1), "{most:#?}");
}

/// A rope that is dropped flat on a floor without restitution leaves with at most a tenth of its
/// speed at 1 to 1024 steps per 1/60 s, and rests.
///
/// *Source.* Impact without restitution.
#[test]
fn a_rope_without_restitution_does_not_bounce_at_any_step() {
    for modulus in [1e5, 1e7, 1e9] {
        for n in [1, 4, 16, 64, 256, 1024] {
            let (r, height, rate) = (0.01, 0.5, 60.0 * f64::from(n));
            let area = std::f64::consts::PI * r * r;
            let line = [up() * (r + height), Vector3::new(1.0, r + height, 0.0)];
            let axial = modulus * area;
            let section = Section::from_stiffness(axial, 0.25 * axial * r * r, 1000.0 * area).unwrap();
            let rope = rope(0.1, &line, 10).section(section).integrator(steps(rate)).build().unwrap();
            let mut rope = with(rope, vec![floor(0.5, 0.0)]);
            rope.set_contact(Contact::with_friction(0.5).with_radius(r)).unwrap();
            let mut left = 0.0f64;
            for _ in 0..(0.7 * rate) as usize {
                rope.step(1.0 / rate).unwrap();
                left = left.max(rope.momentum().linear.y / (1000.0 * area * f64::sqrt(2.0 * GRAVITY * height)));
            }
            let (kinetic, made) = (rope.energy().kinetic, rope.energy_law().made);
            println!("E {modulus:.0e}, 1/{rate} s: leaves with {left:.4}, kinetic {kinetic:.1e} J, made {made:.1e} J");
            assert!(
                left < 0.1 && kinetic < 1e-6 && made < 1e-9,
                "E {modulus:.0e}, 1/{rate} s: {left} {kinetic} {made}"
            );
        }
    }
}

/// A rod of 1 kg and 1 m that lies on a floor of a coefficient of friction of 0.4, of a modulus
/// (Pa), in steps at a rate (Hz), and the way in m by which its weight times that stretches the
/// spring of friction: `10 mu m g/k` per length.
fn rod_on_a_floor(modulus: f64, rate: f64) -> (Cable, f64) {
    let (r, friction) = (0.025, 0.4);
    let axial = modulus * std::f64::consts::PI * r * r;
    let line = [up() * r, Vector3::new(1.0, r, 0.0)];
    let section = Section::from_stiffness(axial, 0.25 * axial * r * r, 1.0).unwrap();
    let rod = rope(0.1, &line, 10).section(section).gravity(-GRAVITY * up()).integrator(steps(rate));
    let mut rod = with(rod.build().unwrap(), vec![floor(friction, 0.0)]);
    rod.set_contact(Contact::with_friction(friction).with_radius(r)).unwrap();
    let mut rest = (rod, 10.0 * friction * GRAVITY / (axial / (40.0 * r * r)));
    push(&mut rest.0, [0.0, 0.0], 1.5, rate);
    rest
}

/// Pushes it for a time in s by shares of its friction that change from one to the other in a
/// second, and then stay, and returns where it is.
fn push(rod: &mut Cable, [from, to]: [f64; 2], time: f64, rate: f64) -> f64 {
    for i in 0..(time * rate) as usize {
        let load = from + (to - from) * (i as f64 / rate).min(1.0);
        rod.set_gravity(GRAVITY * Vector3::new(load * 0.4, -1.0, 0.0)).unwrap();
        rod.step(1.0 / rate).unwrap();
    }
    rod.node_position(5).x
}

/// Asserts that it slides under 1.01 of its friction with the exact acceleration.
fn assert_slides(rod: &mut Cable, name: &str, rate: f64) {
    let before = rod.momentum().linear.x;
    push(rod, [1.01, 1.01], 0.5, rate);
    let acceleration = (rod.momentum().linear.x - before) / 0.5;
    let exact = 0.01 * 0.4 * GRAVITY;
    println!("{name}: slides with {acceleration:.6} for {exact:.6} m/s^2");
    assert!((acceleration / exact - 1.0).abs() < 1e-3, "{name}: {acceleration} for {exact}");
}

/// A rod of 1 kg that lies on a floor holds while it is pushed with 0.99 of its friction, and
/// slides with the exact acceleration with 1.01, from 60 to 3840 Hz, whether it is rubber or not.
///
/// *Source.* Coulomb's law. What it moves before it slides is the spring of friction.
#[test]
fn a_rod_holds_below_its_friction_and_slides_above_at_any_step_and_stiffness() {
    for modulus in [1e5, 1e6, 1e7, 1e9] {
        for rate in [60.0, 240.0, 960.0, 3840.0] {
            let name = format!("E {modulus:.0e}, {rate} Hz");
            let (mut rod, spring) = rod_on_a_floor(modulus, rate);
            let start = rod.node_position(5).x;
            let held = push(&mut rod, [0.0, 0.99], 2.0, rate) - start;
            println!("{name}: holds within {held:.2e} m, spring {spring:.2e} m");
            assert!(held < 1.01 * spring, "{name}: {held} beside {spring}");
            push(&mut rod, [0.99, 1.01], 1.5, rate);
            assert_slides(&mut rod, &name, rate);
        }
    }
}

/// The same rod holds when 0.99 of its friction acts on it at once, and when it is pushed back with
/// 0.8 of it: it moves by the spring of friction, by 0.4 more where a step does not resolve how it
/// swings, and not again when it is pushed back.
///
/// *Source.* Coulomb's law, and the spring. Its angular frequency is 0.0886 /s times the root of
/// the modulus in Pa.
#[test]
fn a_rod_holds_what_is_put_on_it_at_once() {
    for modulus in [1e5, 1e7, 1e9] {
        for rate in [60.0, 240.0, 960.0, 3840.0] {
            let name = format!("E {modulus:.0e}, {rate} Hz");
            let (mut rod, spring) = rod_on_a_floor(modulus, rate);
            let start = rod.node_position(5).x;
            let held = push(&mut rod, [0.99, 0.99], 2.0, rate) - start;
            let back = push(&mut rod, [-0.8, -0.8], 2.0, rate) - start;
            println!("{name}: moves by {:.4} and {:.4} of the spring", held / spring, back / spring);
            let slipped = held / spring - 0.99;
            let most = if 0.0886 * modulus.sqrt() < 0.13 * rate { 0.01 } else { 0.4 };
            assert!(slipped > -0.01 && slipped < most, "{name}: {held} beside {spring}");
            assert!((back / spring + 0.8 - slipped).abs() < 0.03, "{name}: {back} beside {spring}");
            push(&mut rod, [1.01, 1.01], 1.0, rate);
            assert_slides(&mut rod, &name, rate);
        }
    }
}
