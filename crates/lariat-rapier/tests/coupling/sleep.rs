//! Sleep: a load and its cable come to rest together, wake together, and do not drift.

use super::bench::{add_cube, cable, gap, run, soft, tension, v};
use lariat_rapier::lariat_ancf::{At, Damping, PointLoad, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Event};

struct Hoist {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    winch: RigidBodyHandle,
    rope: CableHandle,
}

/// 10 kg on a damped rope of 2 m under a kinematic winch, hung in at its natural length: it bounces and comes to rest.
fn hoist() -> Hoist {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 10.0, 0.1, [0.0, -2.1, 0.0]);
    let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [0.0, -2.0, 0.0], soft()).damping(Damping::from_ratio(0.1, 70.0).unwrap());
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::Start, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    Hoist { world, set, load, winch, rope }
}

impl Hoist {
    /// Steps until the load sleeps; how many.
    fn until_asleep(&mut self) -> usize {
        for k in 0..1200 {
            self.set.step(&mut self.world).unwrap();
            if self.world.bodies[self.load].is_sleeping() && self.set.is_asleep(self.rope).unwrap() {
                return k;
            }
        }
        panic!("still awake: {:?}", self.world.bodies[self.load].linvel());
    }

    fn height(&self) -> f64 {
        v(self.world.bodies[self.load].translation()).y
    }
}

/// Hung in, it falls asleep where statics says; the winch wakes it, lifts it by half a metre, and it falls asleep half a metre higher. While
/// it sleeps no element is evaluated, and ten minutes of it do not move a bit.
///
/// *Source.* The stretch of the rope under 10 kg and its own weight; the winch's path.
#[test]
fn a_resting_load_sleeps_wakes_and_sleeps_higher() {
    let mut h = hoist();
    h.until_asleep();
    assert!(h.set.events().contains(&Event::Asleep(h.rope)));
    let stretch = 2.0 * 9.81 * (10.0 + 0.5 * 2.0 * 0.4) / 1e5;
    assert!((h.height() + 2.1 + stretch).abs() < 2e-5, "{} m of {}", h.height(), -2.1 - stretch);
    assert!((tension(&h.set, h.rope, 2.0) / 98.1 - 1.0).abs() < 5e-3, "{}", tension(&h.set, h.rope, 2.0));
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
    h.until_asleep();
    let lifted = v(h.world.bodies[h.winch].translation()).y;
    assert!((lifted - 0.5).abs() < 1e-4 && (h.height() - asleep - lifted).abs() < 2e-5, "{} m", h.height() - asleep);
}

/// What wakes it: a force of the user, a cube that falls on it, a load on the cable, gravity, a fixed body that is moved.
///
/// *Source.* The contract.
#[test]
fn whatever_stirs_it_wakes_it() {
    type Stir = fn(&mut Hoist);
    let stirs: [(&str, Stir); 6] = [
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
            h.set.attach(&h.world, line, At::End, h.load, Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
            h.world.bodies[h.load].wake_up(true);
            h.set.get_mut(line).unwrap().add_load(PointLoad::force(0.4, Vector3::new(0.0, -20.0, 0.0))).unwrap();
        }),
    ];
    for (what, stir) in stirs {
        let mut h = hoist();
        h.until_asleep();
        let before = v(h.world.bodies[h.load].translation());
        stir(&mut h);
        run(&mut h.world, &mut h.set, 30);
        let moved = (v(h.world.bodies[h.load].translation()) - before).norm();
        assert!(!h.set.is_asleep(h.rope).unwrap() && moved > 1e-4, "{what}: {moved:.1e} m");
        assert!(gap(&h.set) < 1e-6, "{what}");
    }
}

/// A swinging load does not fall asleep at its turning points.
///
/// *Source.* The contract: never let a body sleep while its cable moves.
#[test]
fn a_slow_pendulum_swings_on() {
    let mut world = PhysicsWorld::new();
    // 5 cm aside on 10 m: at most 0.05 m/s, slow enough for Rapier
    let load = add_cube(&mut world, 10.0, 0.1, [0.05, -10.1, 0.0]);
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [0.05, -10.0, 0.0], soft()).fix(At::Start).build().unwrap());
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    let mut least = 1.0f64;
    for k in 0..1200 {
        set.step(&mut world).unwrap();
        assert!(!world.bodies[load].is_sleeping(), "step {k}");
        least = least.min(v(world.bodies[load].translation()).x);
    }
    assert!(least < -0.04, "{least}");
}
