//! A load and its cable fall asleep together, wake up together, and do not drift.

use super::common::{add_cube, cable, gap, run, soft, tension};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{
    At, AxialLaw, Buoyancy, CablePoint, Contact, Damping, Drag, Effects, Flow, ForceDensity, GravityScale, LineLoad,
    Motion, PointLoad, Reel, RestShape, Torsion, Vector3,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Event, Gap};

struct Hoist {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    winch: RigidBodyHandle,
    rope: CableHandle,
}

/// Returns 10 kg on a damped rope of 2 m under a kinematic winch, released at its natural length:
/// it bounces and comes to rest.
fn hoist() -> Hoist {
    hoist_under(RigidBodyBuilder::kinematic_velocity_based(), AttachmentKind::Ball)
}

/// The same under another winch, or clamped to it.
fn hoist_under(winch: RigidBodyBuilder, kind: AttachmentKind) -> Hoist {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 10.0, 0.1, [0.0, -2.1, 0.0]);
    let winch = world.insert_body(winch);
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [0.0, -2.0, 0.0], soft()).damping(Damping::from_ratio(0.1, 70.0).unwrap());
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::Start, winch, Vector::ZERO, kind).unwrap();
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    Hoist { world, set, load, winch, rope }
}

impl Hoist {
    /// Steps until the load sleeps; returns how many steps.
    fn step_until_asleep(&mut self) -> usize {
        for k in 0..1200 {
            self.set.step(&mut self.world).unwrap();
            if self.world.bodies[self.load].is_sleeping() && self.set.is_asleep(self.rope).unwrap() {
                return k;
            }
        }
        panic!("still awake: {:?}", self.world.bodies[self.load].linvel());
    }

    fn height(&self) -> f64 {
        vector(self.world.bodies[self.load].translation()).y
    }
}

/// It falls asleep at static equilibrium; the winch wakes it up and lifts it by half a metre, and
/// it falls asleep there. While it sleeps no element is evaluated, and ten minutes do not change
/// its state by a bit.
///
/// Reference: the stretch of the rope under 10 kg and its own weight; the displacement of the
/// winch.
#[test]
fn a_load_at_rest_sleeps_until_its_winch_moves() {
    let mut h = hoist();
    h.step_until_asleep();
    assert!(h.set.events().contains(&Event::Asleep(h.rope)));
    let stretch = 2.0 * 9.81 * (10.0 + 0.5 * 2.0 * 0.4) / 1e5;
    assert!((h.height() + 2.1 + stretch).abs() < 2e-5, "{} m of {}", h.height(), -2.1 - stretch);
    assert!((tension(&h.set, h.rope, 2.0) / 98.1 - 1.0).abs() < 5e-3, "{}", tension(&h.set, h.rope, 2.0));
    // the motors that hold it are those of the length of a step
    run(&mut h.world, &mut h.set, 1);
    let (asleep, work) = (h.height(), *h.set.get(h.rope).unwrap().diagnostics());
    let time = h.set.get(h.rope).unwrap().time();
    run(&mut h.world, &mut h.set, 36_000);
    assert_eq!(h.height(), asleep);
    assert_eq!(*h.set.get(h.rope).unwrap().diagnostics(), work);
    assert!((h.set.get(h.rope).unwrap().time() - time - 600.0).abs() < 1e-2, "time passes");
    for k in 0..150 {
        // half a metre in two and a half seconds, smoothly
        let s = (f64::from(k) + 0.5) / 150.0;
        h.world.bodies[h.winch].set_linvel(Vector::new(0.0, (0.2 * 6.0 * s * (1.0 - s)) as Real, 0.0), true);
        h.set.step(&mut h.world).unwrap();
        assert!(k > 0 || h.set.events().contains(&Event::Awake(h.rope)));
    }
    h.world.bodies[h.winch].set_linvel(Vector::ZERO, true);
    h.step_until_asleep();
    let lifted = vector(h.world.bodies[h.winch].translation()).y;
    assert!((lifted - 0.5).abs() < 1e-4 && (h.height() - asleep - lifted).abs() < 2e-5, "{} m", h.height() - asleep);
}

/// A sleeping load wakes up by a force, an impulse, a load on the cable, a change of gravity, a
/// fixed body that is moved, and another cable.
///
/// Reference: the contract.
#[test]
fn forces_impulses_loads_gravity_and_moved_supports_wake_a_load() {
    type Disturbance = fn(&mut Hoist);
    let disturbances: [(&str, Disturbance); 6] = [
        ("force", |h| h.world.bodies[h.load].add_force(Vector::new(5.0, 0.0, 0.0), true)),
        ("impulse", |h| h.world.bodies[h.load].apply_impulse(Vector::new(1.0, 0.0, 0.0), true)),
        ("load on the cable", |h| {
            let load = PointLoad::force(1.0, Vector3::new(3.0, 0.0, 0.0));
            h.set.get_mut(h.rope).unwrap().add_load(load).unwrap();
        }),
        ("gravity", |h| h.world.gravity = Vector::new(1.0, -9.81, 0.0)),
        ("teleported winch", |h| h.world.bodies[h.winch].set_translation(Vector::new(0.1, 0.0, 0.0), true)),
        ("another cable", |h| {
            let line = h.set.insert(cable([1.0, -2.0, 0.0], [0.1, -2.1, 0.0], soft()).fix(At::Start).build().unwrap());
            let closing = AttachmentKind::Ball.with_gap(Gap::Close);
            h.set.attach(&h.world, line, At::End, h.load, Vector::new(0.1, 0.0, 0.0), closing).unwrap();
            h.world.bodies[h.load].wake_up(true);
            h.set.get_mut(line).unwrap().add_load(PointLoad::force(0.4, Vector3::new(0.0, -20.0, 0.0))).unwrap();
        }),
    ];
    for (what, disturb) in disturbances {
        let mut h = hoist();
        h.step_until_asleep();
        let before = vector(h.world.bodies[h.load].translation());
        disturb(&mut h);
        run(&mut h.world, &mut h.set, 30);
        let moved = (vector(h.world.bodies[h.load].translation()) - before).norm();
        assert!(!h.set.is_asleep(h.rope).unwrap() && moved > 1e-4, "{what}: {moved:.1e} m");
        assert!(gap(&h.set) < 1e-6, "{what}");
    }
}

/// A swinging load does not fall asleep at its turning points.
///
/// Reference: the contract: no body sleeps while its cable moves.
#[test]
fn a_slow_pendulum_does_not_fall_asleep() {
    let mut world = PhysicsWorld::new();
    // an amplitude of 5 cm on 10 m: at most 0.05 m/s, slow enough for Rapier to put it to sleep
    let load = add_cube(&mut world, 10.0, 0.1, [0.05, -10.1, 0.0]);
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [0.05, -10.0, 0.0], soft()).fix(At::Start).build().unwrap());
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    let mut least = 1.0f64;
    for k in 0..1200 {
        set.step(&mut world).unwrap();
        assert!(!world.bodies[load].is_sleeping(), "step {k}");
        least = least.min(vector(world.bodies[load].translation()).x);
    }
    assert!(least < -0.04, "{least}");
}

/// A swinging load does not fall asleep in host steps that are longer than the time for which Rapier wants a body to be slow, and is where short
/// steps take it.
///
/// Reference: the same in steps of 1/60 s; conservation of energy.
#[test]
fn a_load_swings_on_in_host_steps_of_seconds() {
    let swing = |dt: f64, every: usize| {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = dt as Real;
        let (sine, cosine) = 0.4f64.sin_cos();
        let end = Vector3::new(5.0 * sine, -5.0 * cosine, 0.0);
        let load = add_cube(&mut world, 100.0, 0.1, [end.x as Real, end.y as Real - 0.1, 0.0]);
        let mut set = CableSet::new();
        let rope = set.insert(cable([0.0; 3], end.into(), soft()).fix(At::Start).build().unwrap());
        set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        let mut path = Vec::new();
        for k in 1..=(18.0 / dt).round() as usize {
            set.step(&mut world).unwrap();
            assert!(!world.bodies[load].is_sleeping() && !set.is_asleep(rope).unwrap(), "{dt} s: step {k}");
            if k % every == 0 {
                path.push(vector(world.bodies[load].translation()));
            }
        }
        path
    };
    for dt in [0.45, 0.6, 1.5, 4.5] {
        let (long, short) = (swing(dt, 1), swing(1.0 / 60.0, (60.0 * dt) as usize));
        let apart = long.iter().zip(&short).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        println!("{dt} s: {apart:.4} m");
        assert!(long.len() == short.len() && apart < 0.05, "{dt} s: {apart} m");
    }
}

/// A load that hangs at rest on a cable clamped to a body wakes up when that body moves, turns, or is moved.
///
/// Reference: the contract.
#[test]
fn a_moved_clamp_wakes_a_load() {
    type Disturbance = fn(&mut PhysicsWorld, RigidBodyHandle);
    let disturbances: [(&str, Disturbance); 3] = [
        ("moves", |world, post| world.bodies[post].set_linvel(Vector::new(0.0, 0.1, 0.0), true)),
        ("turns", |world, post| world.bodies[post].set_angvel(Vector::new(0.0, 0.0, 1.0), true)),
        ("is moved", |world, post| world.bodies[post].set_translation(Vector::new(0.1, 0.0, 0.0), true)),
    ];
    for (what, disturb) in disturbances {
        let post = RigidBodyBuilder::kinematic_velocity_based();
        let Hoist { mut world, mut set, winch: post, rope, .. } = hoist_under(post, AttachmentKind::Clamp);
        run(&mut world, &mut set, 900);
        assert!(set.is_asleep(rope).unwrap(), "{what}");
        disturb(&mut world, post);
        run(&mut world, &mut set, 2);
        assert!(!set.is_asleep(rope).unwrap(), "{what}");
    }
}

/// A load on a winch that is moved to poses, to 8.3 m from the origin, falls asleep when the winch has stopped.
///
/// Reference: the contract.
#[test]
fn a_winch_that_stopped_at_a_pose_lets_its_load_sleep() {
    let winch = RigidBodyBuilder::kinematic_position_based();
    let Hoist { mut world, mut set, winch, rope, .. } = hoist_under(winch, AttachmentKind::Ball);
    for k in 0..1200 {
        let height = 8.3 * (k as Real / 600.0).min(1.0);
        world.bodies[winch].set_next_kinematic_translation(Vector::new(0.0, height, 0.0));
        set.step(&mut world).unwrap();
    }
    assert!(set.is_asleep(rope).unwrap());
}

/// A load that is let down at 1 mm/s by the prescribed motion of an end of its cable, or on which a force grows by 0.01 N/s, stays awake.
///
/// Reference: the contract.
#[test]
fn a_slow_motion_or_a_slow_ramp_keeps_a_load_awake() {
    for ramp in [false, true] {
        let mut world = PhysicsWorld::new();
        let load = add_cube(&mut world, 10.0, 0.1, [0.0, -2.1, 0.0]);
        let mut set = CableSet::new();
        let rope = cable([0.0; 3], [0.0, -2.0, 0.0], soft()).fix(At::Start);
        let mut rope = rope.damping(Damping::from_ratio(0.1, 70.0).unwrap()).build().unwrap();
        if ramp {
            let force = PointLoad::force(1.0, Vector3::new(0.0, -1.0, 0.0));
            rope.add_load(PointLoad { ramp: 100.0, ..force }).unwrap();
        } else {
            rope.set_motion(0, Motion::uniform(0.0, Vector3::zeros(), Vector3::new(0.0, -1e-3, 0.0))).unwrap();
        }
        let rope = set.insert(rope);
        set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        run(&mut world, &mut set, 1200);
        assert!(!set.is_asleep(rope).unwrap(), "ramp: {ramp}");
    }
}

/// Returns 10 kg at rest on a rope of 2 m, held by the world, with effects.
fn hung(effects: Effects) -> (PhysicsWorld, CableSet, RigidBodyHandle, CableHandle) {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 10.0, 0.1, [0.0, -2.1, 0.0]);
    let mut set = CableSet::new();
    let damping = Some(Damping::from_ratio(0.1, 70.0).unwrap());
    let rope = cable([0.0; 3], [0.0, -2.0, 0.0], soft()).fix(At::Start).effects(Effects { damping, ..effects });
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    (world, set, load, rope)
}

/// Returns an effect of each kind of the list, that acts otherwise than none.
fn effect(key: &str) -> Effects {
    let mut effects = Effects::default();
    match key {
        "gravity_scale" => effects.gravity_scale = Some(GravityScale(-3.0)),
        "buoyancy" => effects.buoyancy = Some(Buoyancy::new(20_000.0, 0.0)),
        "line_load" => effects.line_loads = Some(LineLoad::uniform(Vector3::new(20.0, 0.0, 0.0)).into()),
        "rest_shape" => effects.rest_shape = Some(RestShape::stretched(0.99)),
        "axial_law" => effects.axial_law = Some(AxialLaw::Curve(vec![[0.0, 0.0], [0.01, 1000.0]])),
        "drag" => effects.drag = Some(Drag::new(1000.0, 1.2, 0.01, Flow::uniform(Vector3::new(2.0, 0.0, 0.0)))),
        "damping" => effects.damping = Some(Damping { axial: 0.1, bending: 0.1 }),
        "contact" => effects.contact = Some(Contact::with_friction(0.3)),
        "torsion" => effects.torsion = Some(Torsion::new(1e-2)),
        other => panic!("say here what an effect {other:?} changes of a rope at rest"),
    }
    effects
}

/// Each effect of the list wakes a load when it is given to its rope, and the load goes where it
/// goes in a world without sleep.
///
/// Reference: the same world without sleep. `damping` and `contact` do nothing to a rope at rest
/// that touches nothing, so it may fall asleep again; it is where it was.
#[test]
fn every_effect_wakes_a_load_when_it_is_given() {
    for &key in Effects::KEYS {
        let places = [true, false].map(|sleeps| {
            let (mut world, mut set, load, rope) = hung(Effects::default());
            if !sleeps {
                set.settings.sleep_speed = 0.0;
            }
            run(&mut world, &mut set, 900);
            assert_eq!(set.is_asleep(rope).unwrap(), sleeps, "{key}");
            let own = set.get(rope).unwrap().effects().clone();
            let given = effect(key);
            let damping = given.damping.or(own.damping);
            set.get_mut(rope).unwrap().set_effects(Effects { damping, ..given }).unwrap();
            run(&mut world, &mut set, 1);
            assert!(!set.is_asleep(rope).unwrap(), "{key}");
            run(&mut world, &mut set, 29);
            let middle = set.get(rope).unwrap().sample(1.0).unwrap().position;
            [vector(world.bodies[load].translation()), middle]
        });
        let moved = (places[1][1] - Vector3::new(0.0, -1.0, 0.0)).norm();
        let off = (0..2).map(|k| (places[0][k] - places[1][k]).norm()).fold(0.0, f64::max);
        println!("{key}: moved {moved:.1e} m, {off:.1e} m off");
        // sleep leaves out what is slower than 2 mm/s
        assert!(off < 1e-3, "{key}: {off:.1e} m");
    }
}

/// A wind that rises, a force per length that begins, a reel that starts by its table and a body
/// that moves into the rope wake a load that hangs still, without a call of its user; a force that
/// says that it does not depend on time lets it sleep.
///
/// Reference: the same world without sleep.
#[test]
fn what_changes_by_itself_wakes_a_load() {
    const WAKES: f64 = 10.0;
    #[derive(Debug)]
    struct Push {
        timed: bool,
    }
    impl ForceDensity for Push {
        fn force(&self, at: &CablePoint) -> Vector3<f64> {
            let begun = if self.timed { f64::from(u8::from(at.time > WAKES)) } else { 0.0 };
            Vector3::new(10.0 * begun, 0.0, 1e-3)
        }
        fn depends_on_velocity(&self) -> bool {
            false
        }
        fn depends_on_time(&self) -> bool {
            self.timed
        }
    }
    let wind = |rows: Vec<[f64; 2]>| {
        let flow = Flow::uniform(Vector3::new(1.0, 0.0, 0.5)).with_history(rows);
        Effects { drag: Some(Drag::new(1000.0, 1.2, 0.01, flow)), ..Effects::default() }
    };
    // what acts, whether it moves the rope, and whether it lets it sleep before
    for (what, moves, sleeps_before) in [
        ("wind", true, true),
        ("gust within a step", true, true),
        ("steady wind", false, true),
        ("force that depends on time", true, false),
        ("force that does not", false, true),
        ("reel", true, true),
        ("body that moves in", true, true),
    ] {
        let runs = [true, false].map(|sleeps| {
            let effects = match what {
                "wind" => wind(vec![[WAKES, 0.0], [WAKES + 0.2, 1.0]]),
                "gust within a step" => wind(vec![[WAKES + 1e-3, 0.0], [WAKES + 2e-3, 1.0]]),
                "steady wind" => wind(vec![[0.0, 0.3], [WAKES, 0.3]]),
                "body that moves in" => effect("contact"),
                _ => Effects::default(),
            };
            let (mut world, mut set, load, rope) = hung(effects);
            let pusher = RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(-0.5, -1.0, 0.0));
            let (pusher, _) = world.insert(pusher, ColliderBuilder::cuboid(0.2, 0.1, 0.5));
            if !sleeps {
                set.settings.sleep_speed = 0.0;
            }
            if what.starts_with("force") {
                let push = Push { timed: moves };
                set.get_mut(rope).unwrap().add_force_density(std::sync::Arc::new(push)).unwrap();
            }
            if what == "reel" {
                let reel = Reel { rate: vec![[WAKES, 0.3]], ..Reel::default() };
                set.get_mut(rope).unwrap().add_reel(At::Start, reel).unwrap();
            }
            // until shortly before; in a wind that blows from the start the load swings at first
            run(&mut world, &mut set, if what == "steady wind" { 1200 } else { 590 });
            let asleep = set.is_asleep(rope).unwrap();
            let before = set.get(rope).unwrap().sample(1.0).unwrap().position;
            if what == "body that moves in" {
                world.bodies[pusher].set_linvel(Vector::new(1.0, 0.0, 0.0), true);
            }
            run(&mut world, &mut set, 40);
            let cable = set.get(rope).unwrap();
            let middle = cable.sample(cable.length() - 1.0).unwrap().position;
            (asleep, (middle - before).norm(), [vector(world.bodies[load].translation()), middle])
        });
        let off = (0..2).map(|k| (runs[0].2[k] - runs[1].2[k]).norm()).fold(0.0, f64::max);
        println!("{what}: asleep {}, moved {:.1e} m, {off:.1e} m off", runs[0].0, runs[1].1);
        assert_eq!(runs[0].0, sleeps_before, "{what}");
        assert!(!moves || runs[1].1 > 5e-3, "{what}: {:.1e} m", runs[1].1);
        assert!(off < 1e-3, "{what}: {off:.1e} m");
    }
}

/// A body that a program puts to sleep by hand, at any time, is stepped on, asleep or awake.
#[test]
fn a_body_that_is_put_to_sleep_by_hand_is_stepped() {
    for steps in [1, 2, 3, 5, 8, 20, 60] {
        for still in [false, true] {
            let mut world = PhysicsWorld::new();
            let mut set = CableSet::new();
            let cube = add_cube(&mut world, 5.0, 0.1, [0.0, -2.1, 0.0]);
            let rope = cable([0.0; 3], [0.0, -2.0, 0.0], soft()).fix(At::Start).build().unwrap();
            let rope = set.insert(rope);
            set.attach(&world, rope, At::End, cube, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
            for step in 0..steps + 30 {
                if step == steps || still && step > steps {
                    world.bodies[cube].sleep();
                }
                set.step(&mut world).unwrap();
            }
            assert!(world.bodies[cube].translation().is_finite());
        }
    }
}
