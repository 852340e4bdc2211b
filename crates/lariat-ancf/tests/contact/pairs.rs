//! Cables that touch each other and themselves.

use crate::bench::{GRAVITY, MASS, RADIUS, rope, run, steps, up};
use crate::bodies::World;
use crate::common::Random;
use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, CableBuilder, Contact, Damping, Drag, Flow, Motion, PointLoad, Section, Vector3};

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
    let points = [Vector3::new(0.0, 0.05, 0.0), Vector3::new(0.02, 2.05, 0.01)];
    let mut cable = touching(rope(1e-3, &points, 80), 0.5);
    cable.set_obstacles([Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), 0.5)]).unwrap();
    let mut most = 0;
    let mut deep = 0.0f64;
    let made = run(&mut cable, 300, |cable| {
        most = most.max(cable.cable_contacts().count());
        deep = deep.max(cable.cable_contacts().fold(0.0, |most, touch| most.max(touch.depth)));
    });
    let kinetic = cable.energy().kinetic;
    println!("heap: made {made:.1e}, kinetic {kinetic:.1e} J, {most} contacts, {:.2} r deep", deep / RADIUS);
    assert!(most > 3 && deep < RADIUS, "{most} {deep}");
    assert!(made < 1e-7, "{made:e}");
    assert!(kinetic < 1e-6, "{kinetic:e}");
}

/// Thin ropes that fall on their ends into heaps never pass through themselves: the diameter, the stiffness, the mass, friction, damping and the mesh are
/// random.
///
/// *Source.* The definition: points that are more than sixteen radii apart along the rope stay further from each other than 0.8 diameters, and no centre
/// lines cross.
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
    assert!(crossed == 0 && nearest > 0.8, "{crossed} {nearest}");
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

/// An overhand knot that is pulled to 100 N holds for 10 s, whatever its friction, mesh and haste: from 5 s to 10 s its ends only
/// swing, and no strand passes another.
///
/// *Source.* The definition: without a knot the pulled end would be gone; and [`crossed_steps`](lariat_ancf::Diagnostics::crossed_steps).
#[test]
fn an_overhand_knot_holds() {
    let long = std::env::var_os("LARIAT_LONG_TESTS").is_some();
    let more = [(0.2, 80, 4.0), (0.7, 80, 4.0), (0.4, 60, 4.0), (0.4, 110, 4.0), (0.4, 80, 2.0), (0.3, 70, 6.0)];
    for (friction, elements, time) in [(0.4, 80, 4.0)].into_iter().chain(more.into_iter().filter(|_| long)) {
        pull_a_knot(friction, elements, time);
    }
}

/// Points of an open trefoil of a size in m, with its ends drawn out.
fn overhand_knot(size: f64) -> Vec<Vector3<f64>> {
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
    points
}

/// Pulls a knot tight within a time in s.
fn pull_a_knot(friction: f64, elements: usize, time: f64) {
    let points = overhand_knot(0.06);
    let away = points[points.len() - 1];
    let builder = rope(1e-2, &points, elements).gravity(Vector3::zeros()).fix(At::Start);
    let mut cable = touching(builder, friction);
    let towards = (away - points[0]).normalize();
    let deepest = |cable: &Cable| cable.cable_contacts().fold(0.0f64, |most, touch| most.max(touch.depth)) / RADIUS;
    let mut deep = 0.0f64;
    let hosts = (60.0 * time) as usize;
    for i in 0..hosts {
        let load = PointLoad::force(cable.length(), towards * (100.0 * (i + 1) as f64 / hosts as f64));
        cable.set_loads(&[load]).unwrap();
        cable.step(1.0 / 60.0).unwrap();
        deep = deep.max(deepest(&cable));
    }
    let span = |cable: &Cable| (cable.sample(cable.length()).unwrap().position - points[0]).norm();
    let hold = |cable: &mut Cable| {
        (0..300).for_each(|_| cable.step(1.0 / 60.0).map(|_| ()).unwrap());
        span(cable)
    };
    let [before, after] = [hold(&mut cable), hold(&mut cable)];
    let crossed = cable.diagnostics().crossed_steps;
    println!(
        "knot, mu {friction}, {elements} elements, {time} s: span {before:.5} {after:.5} of {:.4}, {} contacts, {deep:.2} r deep, then {:.2}, crossed {crossed}",
        cable.length(),
        cable.cable_contacts().count(),
        deepest(&cable)
    );
    assert!(after < cable.length() - 0.05, "no knot");
    assert!((after - before).abs() < 0.005 * before, "{before} {after}");
    assert!(crossed == 0 && deepest(&cable) < 2.0, "{crossed}");
}

/// The loop of an overhand knot that is drawn tighter has the force of the theory of thin rods, F h^2/B = eps^4/2 + 0.492 mu eps^3 with
/// eps = sqrt(h/R), h the radius of the rope, and R that of the loop opposite of the crossing.
///
/// *Source.* Audoly, Clauvelin & Neukirch, Elastic knots, PRL 99 (2007) 164301. It is of leading order: strands that wind about each other by 1.5
/// turns at an angle of some 2 eps hold by exp(18 mu eps) as a capstan, so that mu is at most 0.1.
#[test]
fn the_loop_of_a_knot_has_the_force_of_its_theory() {
    let long = std::env::var_os("LARIAT_LONG_TESTS").is_some();
    let ei = 1e-2;
    for (friction, elements) in
        [(0.1, 200), (0.0, 200), (0.05, 200), (0.1, 260)].into_iter().take(if long { 4 } else { 1 })
    {
        let points = overhand_knot(0.06);
        let end = points[points.len() - 1];
        let towards = (end - points[0]).normalize();
        let builder = weightless(ei, &points, elements).fix(At::Start).fix(At::End);
        let mut cable = touching(builder.damping(Damping { axial: 1e-2, bending: 0.1 }), friction);
        cable.set_motion(elements, Motion::uniform(0.0, end, towards * 0.05)).unwrap();
        let (mut worst, mut last) = (0.0f64, 0.0);
        // what it is drawn with until the loop has come from its drawing to its shape
        (0..600).for_each(|_| cable.step(1.0 / 60.0).map(|_| ()).unwrap());
        while last < 0.33 {
            let [mut force, mut eps] = [0.0, 0.0];
            for _ in 0..60 {
                cable.step(1.0 / 60.0).unwrap();
                let arcs = cable.cable_contacts().flat_map(|touch| [touch.arc_length, touch.other_arc_length]);
                let (from, to) = arcs.fold((f64::INFINITY, 0.0f64), |(low, high), s| (low.min(s), high.max(s)));
                let curvature =
                    |i: usize| cable.sample(from + (to - from) * (0.45 + 0.01 * i as f64)).unwrap().curvature.norm();
                eps += (RADIUS * (0..=10).map(curvature).sum::<f64>() / 11.0).sqrt() / 60.0;
                force += cable.pull(0).0.dot(&towards) / 60.0;
            }
            let theory = ei / RADIUS.powi(2) * (0.5 * eps.powi(4) + 0.492 * friction * eps.powi(3));
            println!("mu {friction}, {elements} elements: eps {eps:.4}, {force:.3} N of {theory:.3} N");
            worst = worst.max((force / theory - 1.0).abs());
            assert!(eps > last, "{eps} after {last}");
            last = eps;
        }
        assert!(worst < 0.15 && cable.diagnostics().crossed_steps == 0, "{worst}");
    }
}

/// Two ropes that hang across each other without friction, the upper one on the lower one: the force between them is that of the elastica, the contact
/// does not sink in time, and stays in the middle, where chords of the mesh meet or not.
///
/// *Source.* `cosseratbench` 0.3.0, experiment crossing: the elasticas of both ropes as a boundary value problem (SciPy), of ropes 1 m long over 0.8 m, radius
/// 5 mm, E 1e5 and 1e6 Pa, 1000 kg/m^3, pins of the upper one 0.05 m lower. Stiffer ropes, or ropes pinned 0.1 m lower, slip off sideways.
#[test]
fn ropes_that_hang_across_each_other_press_with_the_force_of_elasticas() {
    let (drop, pi) = (0.05, std::f64::consts::PI);
    for (modulus, elements, exact) in [(1e6, 51, 0.188161), (1e6, 40, 0.188161), (1e5, 80, 0.115492)] {
        let (area, second) = (pi * RADIUS * RADIUS, 0.25 * pi * RADIUS.powi(4));
        let rope = |along: Vector3<f64>, height: f64, sag: f64| {
            let point = |i: i32| {
                let x = 0.1 * f64::from(i);
                along * (0.4 * x) + up() * (height - sag * (1.0 - x * x))
            };
            let section = Section::from_stiffness(modulus * area, modulus * second, 1000.0 * area).unwrap();
            let mut cable = Cable::builder()
                .points((-10..=10).map(point))
                .length(1.0)
                .section(section)
                .elements(elements)
                .damping(Damping { axial: 1e-2, bending: 1e-2 })
                .integrator(steps(240.0))
                .fix(At::Start)
                .fix(At::End)
                .build()
                .unwrap();
            // twenty times as stiff as by default: the depth is part of the way that the elasticas are apart
            let contact = Contact {
                cables: true,
                stiffness: Some(modulus * pi / 2.0),
                ..Contact::with_friction(0.0).with_radius(RADIUS)
            };
            cable.set_contact(contact).unwrap();
            cable.set_drag(Drag { diameter: Some(0.01), ..Drag::new(1e4, 1.2, 1.2, Flow::default()) }).unwrap();
            cable
        };
        let mut world =
            World::new(vec![rope(Vector3::x(), 0.0, 0.28), rope(Vector3::z(), -drop, 0.265 - drop)], vec![]);
        let mut depths = Vec::new();
        world.run(360, |world| depths.push(deepest(&world.cables)));
        let force = -vertical_force(&world.cables[0]);
        let middles = [0, 1].map(|k| world.cables[k].sample(0.5).unwrap().position);
        let aside = (middles[1] - middles[0]).x.hypot((middles[1] - middles[0]).z);
        println!(
            "E {modulus:.0e}, {elements} elements: {force:.5} N for {exact}, {aside:.1e} m aside, deep {:.2e} then {:.2e}",
            depths[179], depths[359]
        );
        assert!((force / exact - 1.0).abs() < 0.02, "{force}");
        assert!(aside < 1e-4 && depths[359] < 1.02 * depths[179], "{aside:e}");
    }
}
