//! Cables that touch each other and themselves.

use crate::bench::{GRAVITY, MASS, RADIUS, rope, run, steps, up};
use crate::bodies::World;
use crate::common::Random;
use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::{At, Cable, CableBuilder, Contact, Damping, Motion, PointLoad, Section, Vector3};

/// Gives it contact with other cables.
fn beside(builder: CableBuilder, friction: f64) -> Cable {
    let mut cable = builder.build().unwrap();
    let contact = Contact { cables: true, ..Contact::with_friction(friction).with_radius(RADIUS) };
    cable.set_contact(contact).unwrap();
    cable
}

/// Gives it contact with cables and with itself.
fn touching(builder: CableBuilder, friction: f64) -> Cable {
    let mut cable = builder.build().unwrap();
    cable.set_contact(Contact::with_friction(friction).with_radius(RADIUS).with_cables()).unwrap();
    cable
}

fn weightless(ei: f64, points: &[Vector3<f64>], elements: usize) -> CableBuilder {
    rope(ei, points, elements).gravity(Vector3::zeros()).damping(Damping { axial: 1e-2, bending: 1e-2 })
}

/// Sum of the vertical forces on a cable by its list of contacts.
fn vertical_force(cable: &Cable) -> f64 {
    cable.cable_contacts().map(|touch| (touch.normal * touch.normal_force + touch.friction).y).sum()
}

/// Largest depth in m of contacts between cables.
fn deepest(cables: &[Cable]) -> f64 {
    cables.iter().flat_map(Cable::cable_contacts).fold(0.0, |most, touch| most.max(touch.depth))
}

/// Two ropes that cross, each bent by the other between its ends, press with the force of beams under tension.
///
/// *Source.* A beam on two supports under the tension T with a force F in its middle: `w = F L/(4 T) (1 - tanh(u)/u)`, `u = L/2 sqrt(T/EI)`
/// (Timoshenko, Theory of Elastic Stability, section 1.11); w is known from the ends and the radius.
#[test]
fn crossing_ropes_press_with_the_force_of_beams() {
    let (half, ei) = (0.5, 2.0);
    for (d, angle) in [(0.01, 1.571), (0.03, 1.571), (0.02, 0.6f64)] {
        let rope = |side: f64, along: Vector3<f64>| {
            let (end, middle) = (up() * (d * side), up() * (-1.05 * RADIUS * side));
            let points = [end - along * half, middle, end + along * half];
            let mut cable = beside(weightless(ei, &points, 20).fix(At::Start).fix(At::End), 0.3);
            // taut: beams in compression are soft
            let last = cable.nodes() - 1;
            cable.set_motion(last, Motion::fixed(end + along * (half + 2e-4))).unwrap();
            cable
        };
        let other = Vector3::new(f64::cos(angle), 0.0, f64::sin(angle));
        let mut world = World::new(vec![rope(1.0, Vector3::x()), rope(-1.0, other)], vec![]);
        world.run(600, |_| {});
        let [force, deep] = [-vertical_force(&world.cables[0]), deepest(&world.cables)];
        let cable = &world.cables[0];
        let tension = cable.sample(0.25 * cable.length()).unwrap().tension;
        let u = half * (tension.abs() / ei).sqrt();
        // a compressed beam has tan for tanh
        let share = if tension > 0.0 { 1.0 - u.tanh() / u } else { u.tan() / u - 1.0 };
        let exact = (d + RADIUS - 0.5 * deep) * 4.0 * tension.abs() / (2.0 * half) / share;
        println!(
            "{d} {angle}: {force:.4} N for {exact:.4}, tension {tension:.3}, kin {:.1e}, n {}, deep {:.2} %",
            world.cables[0].energy().kinetic,
            cable.cable_contacts().count(),
            100.0 * deep / RADIUS
        );
        assert!((force / exact - 1.0).abs() < 0.02, "{force} {exact}");
    }
}

/// A bent rope that falls over another one which is held hangs on it, with its weight; no energy is made, and what is not near does no work.
///
/// *Source.* Statics: the vertical forces of the contacts are the weight.
#[test]
fn a_rope_falls_over_another_and_hangs_on_it() {
    let held = rope(1e-2, &[Vector3::x() * -0.5, Vector3::x() * 0.5], 20).fix(At::Start).fix(At::End);
    let points = [[-0.5, -0.035], [0.06, -0.035], [0.09, 0.0], [0.06, 0.035], [-0.5, 0.035]]
        .map(|[y, z]| Vector3::new(0.0, y, z));
    let falling = rope(1e-2, &points, 30).damping(Damping { axial: 1e-2, bending: 2e-2 });
    let mut world = World::new(vec![beside(held, 0.5), beside(falling, 0.5)], vec![]);
    let calls = |world: &World| world.cables[0].diagnostics().effects.contact;
    world.step();
    assert_eq!(calls(&world), 0);
    // it swings on: the mean of the last 4 s
    let (mut hosts, mut up_force) = (0, 0.0);
    let made = world.run(479, |world| {
        hosts += 1;
        up_force += if hosts > 239 { vertical_force(&world.cables[0]) / 240.0 } else { 0.0 };
    });
    assert!(calls(&world) > 0);
    let weight = MASS * world.cables[1].length() * GRAVITY;
    let speed = world.cables.iter().flat_map(|c| c.velocities()).fold(0.0f64, |most, v| most.max(v.abs()));
    println!(
        "hangs with {up_force:.4} N of {weight:.4}, made {made:.1e}, speed {speed:.1e}, deep {:.1e}",
        deepest(&world.cables)
    );
    assert!(made < 1e-8, "{made:e}");
    assert!((-up_force / weight - 1.0).abs() < 0.02, "{up_force}");
}

/// Two free ropes that collide keep their momentum to rounding, with friction. Of the angular momentum the numerical dissipation of the method takes a
/// share, which vanishes with the step.
///
/// *Source.* The laws of conservation, in units of the mass, the speed and the length.
#[test]
fn free_ropes_that_collide_keep_their_momenta() {
    for friction in [0.0, 0.4] {
        let rope = |middle: Vector3<f64>, along: Vector3<f64>, velocity: Vector3<f64>| {
            let points = [middle - along * 0.5, middle + along * 0.5];
            beside(rope(1e-2, &points, 12).gravity(Vector3::zeros()).velocity(velocity), friction)
        };
        let along = Vector3::new(0.3, 0.0, 0.95).normalize();
        let run = |rate: f64| {
            let one = rope(Vector3::zeros(), Vector3::x(), Vector3::zeros());
            let other = rope(Vector3::new(0.13, 0.04, 0.05), along, Vector3::new(0.3, -2.0, 0.1));
            let mut world = World::new(vec![one, other], vec![]);
            world.integrator = steps(rate);
            let (linear, angular) = world.momentum();
            let mut touched = false;
            let made = world.run(15, |world| touched |= world.cables[0].cable_contacts().next().is_some());
            let (after, turned) = world.momentum();
            let (p, l) = ((after - linear).norm() / (MASS * 2.0), (turned - angular).norm() / (MASS * 2.0));
            println!("mu {friction}, 1/{rate} s: momentum off by {p:.1e}, angular {l:.1e}, made {made:.1e}");
            assert!(touched && p < 1e-12 && made < 1e-8, "{touched} {p:e} {made:e}");
            l
        };
        let (coarse, fine) = (run(240.0), run(1920.0));
        assert!(coarse < 1e-4 && fine < 1e-6, "{coarse:e} {fine:e}");
    }
}

/// Ropes that are thrown at ropes, all held at their ends, never pass each other, and make no energy.
///
/// *Source.* The energy law; seen from above, the one that began above stays above where they cross.
#[test]
fn thrown_ropes_do_not_pass_each_other() {
    let seeds = if std::env::var_os("LARIAT_LONG_TESTS").is_some() { 300 } else { 30 };
    let (mut worst, mut passed, mut deep, mut sweeps) = (0.0f64, 0, 0.0f64, 0);
    for seed in 0..seeds {
        let mut random = Random::new(500 + seed);
        let mut unit = || 0.5 * (random.next() + 1.0);
        let power = |x: f64, low: f64, high: f64| 10f64.powf(low + (high - low) * x);
        let friction = if unit() < 0.3 { 0.0 } else { unit() };
        let angle = 0.3 + 2.5 * unit();
        let speed = power(unit(), 0.0, 2.0);
        let mut rope = |along: Vector3<f64>, at: Vector3<f64>, velocity: Vector3<f64>| {
            let (ea, ei, mass) = (power(unit(), 4.0, 6.5), power(unit(), -4.0, -1.0), power(unit(), -1.5, 0.0));
            let elements = 8 + (unit() * 10.0) as usize;
            let builder = Cable::builder()
                .points([at - along * 0.5, at + along * 0.5])
                .section(Section::from_stiffness(ea, ei, mass).unwrap())
                .elements(elements)
                .gravity(Vector3::zeros())
                .damping(Damping { axial: 1e-3, bending: 1e-3 })
                .velocity(velocity)
                .fix(At::Start)
                .fix(At::End)
                .integrator(steps(240.0));
            touching(builder, friction)
        };
        let along = Vector3::new(angle.cos(), 0.0, angle.sin());
        let at = up() * (2.0 * RADIUS + 0.1 * speed.min(1.0))
            + (Vector3::x() + along) * 0.2 * (0.5 - (seed % 7) as f64 / 6.0);
        let below = rope(Vector3::x(), Vector3::zeros(), Vector3::zeros());
        let above = rope(along, at, -up() * speed);
        let mut world = World::new(vec![below, above], vec![]);
        let mut ok = true;
        let made = world.run(30, |world| {
            ok &= is_above(&world.cables[1], &world.cables[0]);
            deep = deep.max(deepest(&world.cables));
        });
        if made > 1e-8 || !ok {
            println!("seed {seed}: made {made:.1e} passed {} speed {speed:.1} mu {friction:.2}", !ok);
        }
        worst = worst.max(made);
        passed += usize::from(!ok);
        sweeps += world.cables[0].diagnostics().newton_iterations;
    }
    println!(
        "{seeds} seeds: made {worst:.1e}, {passed} passed, {:.2} r deep, {:.1} sweeps/host",
        deep / RADIUS,
        sweeps as f64 / (30 * seeds) as f64
    );
    assert!(worst < 1e-7, "{worst:e}");
    assert_eq!(passed, 0);
}

/// Returns whether one cable is above another wherever they cross, seen from above.
fn is_above(one: &Cable, other: &Cable) -> bool {
    let points = |cable: &Cable| -> Vec<Vector3<f64>> {
        (0..=200).map(|i| cable.sample(cable.length() * f64::from(i) / 200.0).unwrap().position).collect()
    };
    let (a, b) = (points(one), points(other));
    let cross = |u: Vector3<f64>, v: Vector3<f64>| u.z * v.x - u.x * v.z;
    a.windows(2).all(|p| {
        b.windows(2).all(|q| {
            let (u, v, w) = (p[1] - p[0], q[1] - q[0], q[0] - p[0]);
            let d = cross(u, v);
            let (s, t) = (cross(w, v) / d, cross(w, u) / d);
            !(0.0..=1.0).contains(&s) || !(0.0..=1.0).contains(&t) || (p[0] + u * s).y > (q[0] + v * t).y
        })
    })
}

/// A rope that falls on its end into a heap comes to rest, without energy made.
///
/// *Source.* The energy law.
#[test]
fn a_heap_comes_to_rest() {
    let points = [Vector3::new(0.0, 0.05, 0.0), Vector3::new(0.02, 1.05, 0.01)];
    let mut cable = touching(rope(1e-2, &points, 40), 0.5);
    cable.set_obstacles([Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), 0.5)]).unwrap();
    let mut most = 0;
    let mut deep = 0.0f64;
    let made = run(&mut cable, 300, |cable| {
        most = most.max(cable.cable_contacts().count());
        deep = deep.max(cable.cable_contacts().fold(0.0, |most, touch| most.max(touch.depth)));
    });
    let kinetic = cable.energy().kinetic;
    println!("heap: made {made:.1e}, kinetic {kinetic:.1e} J, {most} contacts, {:.2} r deep", deep / RADIUS);
    assert!(most > 3);
    assert!(made < 1e-7, "{made:e}");
    assert!(kinetic < 1e-6, "{kinetic:e}");
}

/// Thin ropes that fall on their ends into heaps never pass through themselves: the diameter, the stiffness, the mass, friction, damping and the mesh are
/// random.
///
/// *Source.* The definition: points that are more than sixteen radii apart along the rope stay further from each other than a radius, and no centre lines
/// cross.
#[test]
fn thin_ropes_in_heaps_do_not_pass_themselves() {
    let seeds = if std::env::var_os("LARIAT_LONG_TESTS").is_some() { 0..40 } else { 10..14 };
    let (mut crossed, mut nearest) = (0, f64::INFINITY);
    for seed in seeds {
        let mut random = Random::new(7000 + seed);
        let mut unit = || 0.5 * (random.next() + 1.0);
        let power = |x: f64, low: f64, high: f64| 10f64.powf(low + (high - low) * x);
        let radius = power(unit(), -2.8, -2.2);
        let (ei, mass, friction) = (power(unit(), -4.0, -2.0), power(unit(), -2.0, -0.5), unit());
        let elements = 20 + (unit() * 60.0) as usize;
        let points = [Vector3::new(0.0, 0.05, 0.0), Vector3::new(0.02 * unit(), 1.05, 0.02 * unit())];
        let mut cable = Cable::builder()
            .points(points)
            .section(Section::from_stiffness(power(unit(), 4.0, 6.0), ei, mass).unwrap())
            .elements(elements)
            .damping(Damping { axial: 1e-3, bending: power(unit(), -3.0, -1.5) })
            .integrator(steps(240.0))
            .build()
            .unwrap();
        cable.set_contact(Contact::with_friction(friction).with_radius(radius).with_cables()).unwrap();
        cable.set_obstacles([Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), friction)]).unwrap();
        let mut least = f64::INFINITY;
        let made =
            run(&mut cable, 150, |cable| least = least.min(least_distance(cable, 16.0 * radius) / (2.0 * radius)));
        let d = cable.diagnostics();
        println!(
            "seed {seed}: r {radius:.1e}, n {elements}, EI {ei:.1e}, {mass:.2} kg/m: made {made:.1e}, crossed {}, least {least:.2} diameters",
            d.crossed_steps
        );
        crossed += d.crossed_steps;
        nearest = nearest.min(least);
        assert!(made < 1e-7, "{made:e}");
    }
    assert!(crossed == 0 && nearest > 0.5, "{crossed} {nearest}");
}

/// Returns the least distance of points of a cable that are further apart along it than a distance.
fn least_distance(cable: &Cable, apart: f64) -> f64 {
    let count = 300;
    let step = cable.length() / f64::from(count);
    let at = |i: i32| cable.sample(step * f64::from(i)).unwrap().position;
    let points: Vec<Vector3<f64>> = (0..=count).map(at).collect();
    let skip = (apart / step).ceil() as usize;
    let pairs = (0..points.len()).flat_map(|i| (i + skip..points.len()).map(move |j| (i, j)));
    pairs.fold(f64::INFINITY, |least, (i, j)| least.min((points[i] - points[j]).norm()))
}

/// An overhand knot that is pulled to 100 N holds for 10 s. Its strands sink into each other while it is drawn tight (`pairs`, Validity), so their depth is
/// printed, not bounded.
///
/// *Source.* The definition: without a knot the pulled end would be gone.
#[test]
fn an_overhand_knot_holds() {
    // an open trefoil, with its ends drawn out
    let size = 0.06;
    let knot = |t: f64| {
        Vector3::new(t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos(), -0.7 * (3.0 * t).sin()) * size
    };
    let count = 48;
    let (from, to) = (0.35, std::f64::consts::TAU - 0.35);
    let mut points: Vec<Vector3<f64>> =
        (0..=count).map(|i| knot(from + (to - from) * f64::from(i) / f64::from(count))).collect();
    let (first, last) = (points[0], points[points.len() - 1]);
    let out = |x: Vector3<f64>, y: Vector3<f64>| x + (x - y).normalize() * 0.5;
    points.insert(0, out(first, points[1]));
    points.push(out(last, points[points.len() - 2]));
    let n = points.len();
    let away = points[n - 1];
    let builder = rope(1e-2, &points, 80).gravity(Vector3::zeros()).fix(At::Start);
    let mut cable = touching(builder, 0.4);
    let towards = (away - points[0]).normalize();
    let pull = |cable: &mut Cable, force: f64| {
        let load = PointLoad::force(cable.length(), towards * force);
        cable.set_loads(&[load]).unwrap();
    };
    let mut deep = 0.0f64;
    for i in 0..240 {
        pull(&mut cable, 100.0 * f64::from(i + 1) / 240.0);
        cable.step(1.0 / 60.0).unwrap();
        deep = deep.max(cable.cable_contacts().fold(0.0, |most, touch| most.max(touch.depth)));
    }
    let span = |cable: &Cable| (cable.sample(cable.length()).unwrap().position - points[0]).norm();
    let before = span(&cable);
    for _ in 0..600 {
        cable.step(1.0 / 60.0).unwrap();
    }
    let after = span(&cable);
    let kinetic = cable.energy().kinetic;
    println!(
        "knot: span {before:.5} {after:.5} of {:.4}, kinetic {kinetic:.1e}, {} contacts, {:.2} r deep",
        cable.length(),
        cable.cable_contacts().count(),
        deep / RADIUS
    );
    assert!(after < cable.length() - 0.05, "no knot");
    assert!((after - before).abs() < 0.005 * before, "{before} {after}");
}
