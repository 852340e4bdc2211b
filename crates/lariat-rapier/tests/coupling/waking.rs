//! Bodies on cables that Rapier wakes within its step feel their cables in that step.

use super::common::{add_cube, cable, gap, run, soft, tension};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Damping};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

/// A box of 10 kg on a ground, and a rope from a point above it, at angle to the vertical.
struct Scene {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    /// What the box stands on.
    ground: RigidBodyHandle,
    /// A joint that holds the box to the world.
    joint: Option<ImpulseJointHandle>,
    rope: CableHandle,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Case {
    /// Natural length of the rope over its distance.
    slack: f64,
    kind: AttachmentKind,
    ground: RigidBodyType,
    jointed: bool,
    /// Whether it hangs on the rope alone.
    hung: bool,
    /// Whether the other end is on a body that never sleeps.
    partner: bool,
}

const TAUT: Case = Case {
    slack: 0.9995,
    kind: AttachmentKind::Ball,
    ground: RigidBodyType::Fixed,
    jointed: false,
    hung: false,
    partner: false,
};
const SLACK: Case = Case { slack: 1.02, ..TAUT };

impl Scene {
    fn new(case: Case, can_sleep: bool) -> Scene {
        let mut world = PhysicsWorld::new();
        let ground = RigidBodyBuilder::new(case.ground).translation(Vector::new(0.0, -2.3, 0.0));
        let (ground, _) = world.insert(ground, ColliderBuilder::cuboid(0.5, 0.1, 0.5).mass(20.0).friction(0.7));
        if case.ground == RigidBodyType::Dynamic {
            let floor = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -2.5, 0.0));
            world.insert(floor, ColliderBuilder::cuboid(5.0, 0.1, 5.0).friction(0.0));
        }
        let load = add_cube(&mut world, 10.0, 0.1, [0.0, -2.1, 0.0]);
        if !can_sleep {
            world.bodies[load].activation_mut().normalized_linear_threshold = -1.0;
        }
        let joint = case.jointed.then(|| {
            let post = world.insert_body(RigidBodyBuilder::fixed());
            world.insert_impulse_joint(post, load, FixedJointBuilder::new().local_anchor1(Vector::new(0.0, -2.1, 0.0)))
        });
        if case.jointed || case.hung {
            world.remove_body(ground);
        }
        let mut set = CableSet::new();
        let damping = Damping { axial: 3e-3, bending: 0.5 };
        let rope = cable([0.0; 3], [0.0, -2.0, 0.0], soft()).damping(damping).length(2.0 * case.slack);
        let mut rope = rope.fix(At::Start).fix(At::End).build().unwrap();
        rope.equilibrium().unwrap();
        rope.release(At::End).unwrap();
        if case.partner {
            rope.release(At::Start).unwrap();
        }
        let rope = set.insert(rope);
        if case.partner {
            let partner = add_cube(&mut world, 100.0, 0.2, [0.0, 0.2, 0.0]);
            world.bodies[partner].activation_mut().normalized_linear_threshold = -1.0;
            for x in [-0.3, 0.3] {
                let shelf = ColliderBuilder::cuboid(0.2, 0.1, 0.5).translation(Vector::new(x, -0.1, 0.0));
                world.insert_collider(shelf, None);
            }
            set.attach(&world, rope, At::Start, partner, Vector::new(0.0, -0.2, 0.0), AttachmentKind::Ball).unwrap();
        }
        set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), case.kind).unwrap();
        Scene { world, set, load, ground, joint, rope }
    }

    fn velocity(&self) -> [f64; 6] {
        let body = &self.world.bodies[self.load];
        let (v, w) = (vector(body.linvel()), vector(body.angvel()));
        [v.x, v.y, v.z, w.x, w.y, w.z]
    }
}

/// Steps a box until it sleeps and another that never does as often, disturbs both, and compares their velocities
/// after one step and the largest tensions in the second after it.
fn compare(what: &str, case: Case, disturb: fn(&mut Scene)) {
    let mut scenes = [true, false].map(|can_sleep| Scene::new(case, can_sleep));
    for k in 0.. {
        scenes.iter_mut().for_each(|s| run(&mut s.world, &mut s.set, 1));
        if scenes[0].world.bodies[scenes[0].load].is_sleeping() {
            break;
        }
        assert!(k < 3000, "{what}, {case:?}: still awake");
    }
    scenes.iter_mut().for_each(|s| run(&mut s.world, &mut s.set, 5));
    assert!(
        scenes[0].world.bodies[scenes[0].load].is_sleeping() && !scenes[1].world.bodies[scenes[1].load].is_sleeping()
    );
    let tensions = scenes.each_ref().map(|s| tension(&s.set, s.rope, 1.0));
    let outcomes = scenes.map(|mut s| {
        disturb(&mut s);
        run(&mut s.world, &mut s.set, 1);
        let (first, opened) = (s.velocity(), gap(&s.set));
        let mut peak = 0.0f64;
        for _ in 0..60 {
            run(&mut s.world, &mut s.set, 1);
            peak = peak.max(tension(&s.set, s.rope, 1.0));
        }
        (first, opened, peak)
    });
    let [woken, awake] = outcomes;
    let off = (0..6).map(|i| (woken.0[i] - awake.0[i]).abs()).fold(0.0, f64::max);
    let case = format!(
        "{what}, {case:?}: at rest {:.2} and {:.2} N; velocities differ by {off:.1e}, gap {:.0e} m, peaks {:.2} and {:.2} N",
        tensions[0], tensions[1], woken.1, woken.2, awake.2
    );
    println!("{case}");
    let speed = awake.0.iter().fold(0.0f64, |a, x| a.max(x.abs()));
    assert!(woken.1 < 1e-3 && (woken.2 - awake.2).abs() < 0.05 * awake.2 + 5.0, "{case}");
    // what a ball does to a body in the step in which Rapier lists their pair differs for one that sleeps
    assert!(off < 0.05 + 0.1 * f64::from(u8::from(case.starts_with("struck"))) + 0.02 * speed, "{case}");
}

/// A body that Rapier wakes within its step feels its cables in that step, whatever wakes it: its velocity after the step and the largest
/// tension in the second after it are those of a body that was never asleep. Ropes taut and slack, on balls and clamps, to the world and to a
/// body that is awake.
///
/// Reference: the same scene with a body that may not sleep. When the cables of a sleeping body were missing in that step, its velocity was
/// 0.105 m/s too large and the tension 239 N for 136 N.
#[test]
fn a_body_that_rapier_wakes_within_its_step_feels_its_cable_in_it() {
    let clamped = Case { kind: AttachmentKind::Clamp, ..TAUT };
    let partner = Case { partner: true, ..TAUT };
    for case in [TAUT, SLACK, clamped, partner] {
        compare("ground removed", case, |s| {
            s.world.remove_body(s.ground);
        });
        compare("ground moved", case, |s| {
            s.world.bodies[s.ground].set_translation(Vector::new(0.0, -4.0, 0.0), true);
        });
        compare(
            "struck by a ball",
            Case { ground: RigidBodyType::Fixed, slack: case.slack.min(1.0), hung: true, ..case },
            |s| {
                let ball = RigidBodyBuilder::dynamic()
                    .translation(Vector::new(0.16, -2.1, 0.0))
                    .linvel(Vector::new(-3.0, 0.0, 0.0));
                s.world.insert(
                    ball,
                    ColliderBuilder::ball(0.05)
                        .mass(2.0)
                        .friction(0.0)
                        .friction_combine_rule(CoefficientCombineRule::Min),
                );
            },
        );
        // A box that slides at once turns by what Rapier's contacts have not converged to: within four iterations at -0.06 to 0.23 rad/s, by
        // rounding; with one iteration Rapier alone turns it at -1.5, with 16 both boxes turn at 0.035, and in steps a 32nd as long at -0.002:
        // it should not turn. That is not the subject here.
        if case != SLACK || size_of::<Real>() == 4 {
            compare("pushed", case, |s| s.world.bodies[s.load].apply_impulse(Vector::new(3.0, 0.0, 0.0), true));
        }
        let kinematic = Case { ground: RigidBodyType::KinematicVelocityBased, ..case };
        compare("ground sinks", kinematic, |s| {
            s.world.bodies[s.ground].set_linvel(Vector::new(0.0, -2.0, 0.0), true);
        });
        let dynamic = Case { ground: RigidBodyType::Dynamic, ..case };
        compare("neighbour kicked", dynamic, |s| {
            s.world.bodies[s.ground].apply_impulse(Vector::new(40.0, 0.0, 0.0), true);
        });
        let jointed = Case { jointed: true, ..case };
        compare("joint removed", jointed, |s| {
            s.world.remove_impulse_joint(s.joint.unwrap());
        });
        compare("joint changed", jointed, |s| {
            let joint = s.world.impulse_joints.get_mut(s.joint.unwrap(), true).unwrap();
            joint.data.set_local_anchor1(Vector::new(0.0, -2.098, 0.0));
        });
    }
}

/// A box of 1 kg that a rope pulls with 1 kN against two beams sleeps; a pebble that touches it wakes it, and it stays where it is.
///
/// Reference: statics, but for what Rapier does: a woken body has no contacts in its first step. The impulse of the rope in
/// that step is that of 16 m/s, and that of gravity of 0.16 m/s; the rope that holds it gives way by a few millimetres.
#[test]
fn a_sleeping_jammed_box_that_a_pebble_touches_stays() {
    let mut world = PhysicsWorld::new();
    for x in [-0.15, 0.15] {
        let beam = ColliderBuilder::cuboid(0.1, 0.1, 0.5).translation(Vector::new(x, -1.9, 0.0));
        world.insert_collider(beam, None);
    }
    let load = add_cube(&mut world, 1.0, 0.1, [0.0, -2.1, 0.0]);
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [0.0, -2.0, 0.0], soft()).damping(Damping { axial: 3e-3, bending: 0.5 });
    let rope = set.insert(rope.length(1.98).fix(At::Start).build().unwrap());
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    for k in 0.. {
        run(&mut world, &mut set, 1);
        if set.is_asleep(rope).unwrap() {
            break;
        }
        assert!(k < 3000, "still awake");
    }
    let before = tension(&set, rope, 1.0);
    let pebble =
        RigidBodyBuilder::dynamic().translation(Vector::new(0.13, -2.1, 0.0)).linvel(Vector::new(-0.8, 0.0, 0.0));
    world.insert(pebble, ColliderBuilder::ball(0.02).mass(1e-3));
    let (mut fastest, mut off, mut woke) = (0.0f64, 0.0f64, false);
    for _ in 0..30 {
        run(&mut world, &mut set, 1);
        woke |= !world.bodies[load].is_sleeping();
        fastest = fastest.max(f64::from(world.bodies[load].linvel().length()));
        off = off.max((tension(&set, rope, 1.0) / before - 1.0).abs());
    }
    println!("{before:.1} N, then off by {off:.1e} at {fastest:.1e} m/s");
    assert!(woke && before > 800.0 && off < 0.15 && fastest < 0.05, "{before} N, {off}, {fastest} m/s");
}
