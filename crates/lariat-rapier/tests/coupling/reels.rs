//! Winches in a world.

use super::common::{add_cube, cable, run};
use lariat_rapier::lariat_ancf::{At, Damping, Feed, Reel, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

fn section() -> Section {
    Section::from_stiffness(1e5, 0.05, 0.3).unwrap()
}

/// A crate of 20 kg hangs from a reel on a fixed or kinematic body, which takes in and pays out over several elements: the crate follows,
/// the attachments at eye and hook stay, and the cable sleeps only while the reel stands. The eye is at the end of the cable or at its
/// start, where the numbers of all other nodes change.
///
/// *Source.* The height of the crate is that of the eye less what is out and its stretch, 20 kg g L/EA.
#[test]
fn a_reel_on_a_fixed_or_moving_body_lifts_its_load() {
    for (kinematic, eye_at) in [(false, At::End), (true, At::End), (true, At::Start)] {
        let hook_at = if eye_at == At::End { At::Start } else { At::End };
        let mut world = PhysicsWorld::new();
        let load = add_cube(&mut world, 20.0, 0.1, [0.0, -2.1, 0.0]);
        let winch = if kinematic {
            RigidBodyBuilder::kinematic_velocity_based().linvel(Vector::new(0.0, 0.1, 0.0))
        } else {
            RigidBodyBuilder::fixed()
        };
        let winch = world.insert_body(winch);
        let mut set = CableSet::new();
        let [from, to] = if eye_at == At::End { [-2.0, 0.0] } else { [0.0, -2.0] };
        let rope = cable([0.0, from, 0.0], [0.0, to, 0.0], section()).damping(Damping { axial: 0.01, bending: 0.01 });
        let rope = set.insert(rope.build().unwrap());
        let hook = set.attach(&world, rope, hook_at, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        let eye = set.attach(&world, rope, eye_at, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.get_mut(rope).unwrap().add_reel(eye_at, Reel::default()).unwrap();
        let mut seconds = 0.0;
        for (rate, steps) in [(0.0, 60), (-0.4, 180), (0.4, 120), (0.0, 240)] {
            set.get_mut(rope).unwrap().set_reel_rate(eye_at, rate).unwrap();
            run(&mut world, &mut set, steps);
            seconds += f64::from(steps as u32) / 60.0;
        }
        let reel = set.get(rope).unwrap().reel(eye_at).unwrap();
        assert!(reel.merges >= 3 && reel.splits >= 2 && reel.rate == 0.0, "{reel:?}");
        let top = if kinematic { 0.1 * seconds } else { 0.0 };
        let stretch = 20.0 * 9.81 * reel.length_out / 1e5;
        let height = f64::from(world.bodies[load].translation().y) + 0.1;
        assert!((height - (top - reel.length_out - stretch)).abs() < 4e-3, "{height} m, {top} {reel:?}");
        let ends = [0, set.get(rope).unwrap().nodes() - 1];
        for (attachment, end) in [(eye, eye_at), (hook, hook_at)] {
            let (at, last) = (set.attachment(attachment).unwrap(), end == At::End);
            assert_eq!(at.node(), ends[usize::from(last)]);
            let s = if last { reel.length_out } else { 0.0 };
            assert!((at.arc_length() - s).abs() < 1e-9 && at.gap() < 1e-5, "{at:?}");
        }
        let pull = -set.attachment(hook).unwrap().force().y;
        assert!((reel.tension - (20.0 + 0.3 * reel.length_out) * 9.81).abs() < 8.0 && pull < 0.0, "{reel:?} {pull}");
    }
}

/// A cable between fixed bodies, with a reel at its start or end: attachments stay with their nodes over splits and merges within steps,
/// and after a cut.
#[test]
fn attachments_of_a_cable_without_a_load_follow_its_reel() {
    for eye_at in [At::Start, At::End] {
        let mut world = PhysicsWorld::new();
        let mut set = CableSet::new();
        let rope =
            cable([0.0; 3], [2.0, 0.0, 0.0], section()).length(2.4).damping(Damping { axial: 0.01, bending: 0.01 });
        let rope = set.insert(rope.build().unwrap());
        let posts = [(At::Start, 0.0), (At::ArcLength(1.2), 1.0), (At::End, 2.0)].map(|(at, x)| {
            let post = world.insert_body(RigidBodyBuilder::fixed().translation(Vector::new(x, 0.0, 0.0)));
            set.attach(&world, rope, at, post, Vector::ZERO, AttachmentKind::Ball.with_gap(lariat_rapier::Gap::Close))
                .unwrap()
        });
        set.get_mut(rope).unwrap().add_reel(eye_at, Reel::default()).unwrap();
        for (rate, steps) in [(0.5, 90), (-0.4, 60)] {
            set.get_mut(rope).unwrap().set_reel_rate(eye_at, rate).unwrap();
            for _ in 0..steps {
                run(&mut world, &mut set, 1);
                let cable = set.get(rope).unwrap();
                let arcs = cable.node_arc_lengths();
                let passed = cable.length() - 2.4;
                let middle = if eye_at == At::Start { 1.2 + passed } else { 1.2 };
                for (post, s) in posts.iter().zip([0.0, middle, cable.length()]) {
                    let at = set.attachment(*post).unwrap();
                    assert!((at.arc_length() - s).abs() < 1e-9 && (arcs[at.node()] - s).abs() < 1e-9, "{at:?} {s}");
                }
            }
        }
        for post in posts {
            assert!(set.attachment(post).unwrap().gap() < 1e-5);
        }
        let reel = set.get(rope).unwrap().reel(eye_at).unwrap();
        assert!(reel.splits >= 2 && reel.merges >= 1, "{reel:?}");
        let middle = set.attachment(posts[1]).unwrap().arc_length();
        let rest = set.cut(rope, middle + if eye_at == At::Start { 0.3 } else { -0.3 }).unwrap();
        run(&mut world, &mut set, 30);
        let keeps = if eye_at == At::Start { rope } else { rest };
        assert!(set.get(keeps).unwrap().reel(eye_at).is_some());
        assert_eq!(set.attachment(posts[1]).unwrap().cable(), keeps);
    }
}

/// A winch with a clutch lifts a crate and never pulls more than the clutch holds; of two crates on two such winches, the one that is too
/// heavy runs out.
///
/// *Source.* `m a = m g - F`.
#[test]
fn clutches_of_a_world_slip_at_their_force() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let hoists = [(20.0, 0.0), (28.0, 3.0)].map(|(mass, x)| {
        let load = add_cube(&mut world, mass, 0.1, [x, -2.1, 0.0]);
        let winch = world.insert_body(RigidBodyBuilder::fixed());
        let rope = cable([f64::from(x), -2.0, 0.0], [f64::from(x), 0.0, 0.0], section())
            .damping(Damping { axial: 0.01, bending: 0.01 });
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::Start, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::End, winch, Vector::new(x, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        let reel = Reel { max_force: Some(240.0), ..Reel::with_rate(-0.3) };
        set.get_mut(rope).unwrap().add_reel(At::End, reel).unwrap();
        (rope, load)
    });
    let (mut most, mut before, mut out) = (0.0f64, [0.0; 2], 0.0);
    for step in 0..70 {
        if step == 30 {
            before = hoists.map(|(_, load)| f64::from(world.bodies[load].linvel().y));
            out = set.get(hoists[1].0).unwrap().length();
        }
        run(&mut world, &mut set, 1);
        for (rope, _) in hoists {
            most = most.max(set.get(rope).unwrap().reel(At::End).unwrap().force);
        }
    }
    let speeds = hoists.map(|(_, load)| f64::from(world.bodies[load].linvel().y));
    // over 40 steps, without the first ones in which the rope is stretched; with the rope that is out in the mean
    let out = 0.5 * (out + set.get(hoists[1].0).unwrap().length());
    let fall = (9.81 - 240.0 / (28.0 + 0.3 * out)) * 40.0 / 60.0;
    println!("{most} N, {speeds:?} m/s, not {}", -fall);
    assert!(most < 240.0 * 1.02, "{most} N");
    assert!((speeds[0] - 0.3).abs() < 0.01 && ((speeds[1] - before[1]) / -fall - 1.0).abs() < 0.05, "{speeds:?}");
}

/// A winch on a body that floats freely draws in another one, off its centre: the momentum of all stays, the stock's included, and the bodies
/// come nearer by what was taken in. Without a stock, whose mass would be unknown, the eye is refused by name.
///
/// *Source.* Conservation of momentum, to Rapier's single precision; the length out.
#[test]
fn a_winch_on_a_free_body_draws_in_another() {
    for eye_at in [At::End, At::Start] {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let tug = add_cube(&mut world, 20.0, 0.2, [0.2, -0.1, 0.0]);
        let barge = add_cube(&mut world, 50.0, 0.2, [-3.2, 0.0, 0.0]);
        let mut set = CableSet::new();
        let (from, to) = if eye_at == At::End { (-3.0, 0.0) } else { (0.0, -3.0) };
        let rope = cable([from, 0.0, 0.0], [to, 0.0, 0.0], section()).gravity([0.0; 3]);
        let rope = set.insert(rope.damping(Damping { axial: 0.01, bending: 0.01 }).build().unwrap());
        let hook_at = if eye_at == At::End { At::Start } else { At::End };
        set.attach(&world, rope, eye_at, tug, Vector::new(-0.2, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, hook_at, barge, Vector::new(0.2, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        set.get_mut(rope).unwrap().add_reel(eye_at, Reel { acceleration: 0.5, ..Reel::default() }).unwrap();
        let refused = set.step(&mut world).unwrap_err().to_string();
        assert!(refused.contains("moves freely") && refused.contains("stock"), "{refused}");
        let reel = Reel { stock: Some(20.0), acceleration: 0.5, ..Reel::with_rate(-0.5) };
        set.get_mut(rope).unwrap().set_reel(eye_at, reel).unwrap();
        run(&mut world, &mut set, 240);
        set.get_mut(rope).unwrap().set_reel_rate(eye_at, 0.3).unwrap();
        run(&mut world, &mut set, 60);
        let momentum = set.momentum(&world).unwrap().linear.norm();
        let moved = 50.0 * f64::from(world.bodies[barge].linvel().length());
        let reel = set.get(rope).unwrap().reel(eye_at).unwrap();
        let gap = (world.bodies[tug].translation() - world.bodies[barge].translation()).length();
        println!("{momentum:e} kg m/s of {moved}, {gap} m, {reel:?}");
        assert!(momentum < 1e-4 * moved.max(1.0), "{momentum:e} kg m/s");
        assert!(reel.merges > 2 && reel.length_out < 1.6, "{reel:?}");
        assert!(f64::from(gap) < reel.length_out + 0.6, "{gap} m, {reel:?}");
    }
}

/// The stock of a winch on a free body counts from the beginning: momentum, angular momentum and kinetic energy are those after the
/// first step.
///
/// *Source.* Conservation, without gravity; the mass of the stock by hand.
#[test]
fn stock_on_a_free_body_has_momentum_before_the_first_step() {
    for (stock, rate) in [(9.0, 0.0), (20.0, -0.4), (6.0, 0.3)] {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let (tug, barge) =
            (add_cube(&mut world, 20.0, 0.2, [0.2, 0.0, 0.0]), add_cube(&mut world, 50.0, 0.2, [-3.2, 0.0, 0.0]));
        for body in [tug, barge] {
            world.bodies[body].set_linvel(Vector::new(0.0, 1.5, -0.5), true);
        }
        let mut set = CableSet::new();
        let velocity = [0.0, 1.5, -0.5];
        let mut rope =
            cable([-3.0, 0.0, 0.0], [0.0; 3], section()).gravity([0.0; 3]).velocity(velocity).build().unwrap();
        let mass = rope.elements()[0].section.mass_per_length;
        let reel = Reel { stock: Some(stock), acceleration: 0.5, ..Reel::with_rate(rate) };
        rope.add_reel(At::End, reel).unwrap();
        let rope = set.insert(rope);
        set.attach(&world, rope, At::Start, barge, Vector::new(0.2, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::End, tug, Vector::new(-0.2, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        let before = set.momentum(&world).unwrap();
        let by_hand = (70.0 + mass * stock) * 2.5f64.sqrt();
        assert!((before.linear.norm() / by_hand - 1.0).abs() < 1e-6, "{} {by_hand}", before.linear.norm());
        run(&mut world, &mut set, 10);
        let after = set.momentum(&world).unwrap();
        let sizes = [before.linear.norm(), before.angular.norm()];
        for (off, size) in [after.linear - before.linear, after.angular - before.angular].iter().zip(sizes) {
            assert!(off.norm() < 1e-5 * size, "stock of {stock} m: {off} of {size}");
        }
    }
}

/// A lure is thrown away from a free spool, faster than elements are long in a host step, and from rest of the line: the rate
/// of the spool grows within one step to that of the lure. Nothing is refused, and the lure flies as far as its equation says.
///
/// *Source.* Balances of a straight line of mass m + w s, with no gravity and no force of the spool: from a drum that turns with the
/// line v is constant; from a bag (m + w s) v^2 is; from a coil (m + w s) v (Irschik, Humer, The equations of Lagrange for a continuous
/// deformable body with rigid body degrees of freedom and variable mass; the falling folded chain).
#[test]
fn a_line_runs_off_a_free_spool_faster_than_its_elements() {
    for k in 0..24u32 {
        let share = |factor: f64| (f64::from(k) * factor).fract();
        let (speed, mass) = (10.0 + 30.0 * share(0.618), 0.01 * 10.0f64.powf(share(0.414)));
        let per_length = mass * 0.004 * 10.0f64.powf(share(0.732));
        // at most 32 steps in a host step, of a third of an element each
        let most = 32.0 * 60.0 / (3.0 * speed);
        let elements = (most * (0.4 + 0.6 * share(0.236))) as usize;
        let feed = [Feed::Drum, Feed::Bag, Feed::Coil][k as usize % 3];
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters.dt = [1.0 / 60.0, 1.0 / 120.0][k as usize / 3 % 2];
        let lure = RigidBodyBuilder::dynamic().translation(Vector::X).linvel(Vector::new(speed as Real, 0.0, 0.0));
        let (lure, _) = world.insert(lure, ColliderBuilder::ball(0.01).mass(mass as Real));
        let rod = world.insert_body(RigidBodyBuilder::fixed());
        let mut set = CableSet::new();
        let line = cable([0.0; 3], [1.0, 0.0, 0.0], Section::from_stiffness(200.0, 0.0, per_length).unwrap());
        let line = line.elements(elements).gravity(Vector3::zeros()).damping(Damping { axial: 5e-3, bending: 0.0 });
        let moving = k % 2 == 0;
        let line = if moving { line.velocity(Vector3::new(speed, 0.0, 0.0)) } else { line };
        let line = set.insert(line.build().unwrap());
        set.attach(&world, line, At::Start, rod, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach(&world, line, At::End, lure, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let spool = Reel { max_force: Some(0.0), feed, ..Reel::default() };
        set.get_mut(line).unwrap().add_reel(At::Start, spool).unwrap();
        let case =
            format!("{k}: {speed:.1} m/s, {mass:.3} kg, {per_length:.1e} kg/m, {elements}, {feed:?}, moving: {moving}");
        let start = mass + per_length;
        // a line at rest is jerked to the speed of the lure
        let speed = if moving { speed } else { speed * mass / start };
        // s with (1 + b s)^p ds/dt = v
        let (time, b) = (0.3, per_length / start);
        let power = match feed {
            Feed::Bag => 0.5,
            Feed::Coil => 1.0,
            _ => 0.0,
        };
        let way = ((1.0 + (power + 1.0) * b * speed * time).powf(1.0 / (power + 1.0)) - 1.0) / b;
        let steps = (time / f64::from(world.integration_parameters.dt)).round() as usize;
        for _ in 0..steps {
            set.step(&mut world).unwrap_or_else(|error| panic!("{case}: {error}"));
        }
        let flown = f64::from(world.bodies[lure].translation().x) - 1.0;
        println!("{case}: {flown:.4} m of {way:.4}");
        assert!((flown / way - 1.0).abs() < 0.01, "{case}: {flown} m of {way} m");
    }
}

/// Tables of rates with rows at tenths of seconds, which single precision puts on either side of the ends of host steps, and at any
/// times: the length that is out is that of the table at each row, on a fixed body and with a motor that is strong enough.
///
/// *Source.* The table, ramped from each row on by the acceleration: its integral. Where a ramp begins or ends within a host step of h, a
/// rate that is linear over the step is off by a h^2/8 of length.
#[test]
fn a_table_of_rates_counts_from_its_rows() {
    for k in 0..24u32 {
        let share = |factor: f64| (f64::from(k + 1) * factor).fract();
        let tenths = k % 3 != 0;
        let time = |x: f64| if tenths { (10.0 * x).round() / 10.0 } else { x };
        let rows = [
            [time(0.2 + 0.3 * share(0.618)), 0.8 * share(0.414) - 0.4],
            [time(0.8 + 0.3 * share(0.732)), 0.8 * share(0.236) - 0.4],
            [time(1.4 + 0.3 * share(0.549)), 0.0],
        ];
        let acceleration = 1.5 + 3.0 * share(0.303);
        let dt = [1.0 / 60.0, 0.01, 1.0 / 50.0, 1.0 / 240.0][k as usize % 4];
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = dt as Real;
        let load = add_cube(&mut world, 5.0, 0.1, [0.0, -2.1, 0.0]);
        let post = world.insert_body(RigidBodyBuilder::fixed());
        let mut set = CableSet::new();
        let rope = cable([0.0; 3], [0.0, -2.0, 0.0], section()).damping(Damping { axial: 0.01, bending: 0.01 });
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::Start, post, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let max_force = (k % 2 == 1).then_some(1e4);
        let reel = Reel { rate: rows.to_vec(), acceleration, max_force, ..Reel::default() };
        set.get_mut(rope).unwrap().add_reel(At::Start, reel).unwrap();
        // the integral of the table
        let (mut rate, mut length, mut corners) = (0.0f64, 2.0, 0.0);
        for (i, row) in rows.iter().enumerate() {
            let until = rows.get(i + 1).map_or(2.0, |next| next[0]) - row[0];
            let rising = ((row[1] - rate).abs() / acceleration).min(until);
            let reached = rate + rising * acceleration.copysign(row[1] - rate);
            length += 0.5 * (rate + reached) * rising + reached * (until - rising);
            (rate, corners) = (reached, corners + 2.0);
        }
        let steps = (2.0 / dt).round() as usize;
        run(&mut world, &mut set, steps);
        let out = set.get(rope).unwrap().reel(At::Start).unwrap().length_out;
        let bound = corners * acceleration * dt * dt / 8.0 + 1e-6;
        println!("{k}: {dt}, {rows:?}, {max_force:?}: {out} m of {length}, {:.1e} of {bound:.1e}", out - length);
        assert!((out - length).abs() < bound, "{k}: {rows:?}, {acceleration}, {dt} s: {out} m of {length}, {bound}");
    }
}
