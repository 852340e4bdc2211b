//! Loads at rest: stretch, tensions and tilt.

use super::common::{add_cube, cable, gap, l_stable_integrator, run, soft, steel, tension, wire};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Drag, Effects, Flow, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet, Error};

/// Returns position and rotation of the box, and the tensions at mid cable. Taut cables are springs
/// of Green's law along straight lines, with half of their weight at the lower end; Newton's method
/// with differences makes two forces and a moment zero.
fn tilted_box(section: Section, tops: [f64; 2], lengths: [f64; 2], mass: f64) -> (Vector3<f64>, [f64; 2]) {
    use ::nalgebra::{Matrix3, Vector2};
    let (ea, half) = (section.axial_stiffness, section.mass_per_length * 0.5);
    let forces = |u: &Vector3<f64>| {
        let (s, c) = u.z.sin_cos();
        let mut out = Vector3::new(0.0, -9.81 * mass, 0.0);
        let mut pulls = [0.0; 2];
        for k in 0..2 {
            let a = [-0.3, 0.3][k];
            let lever = Vector2::new(c * a - s * 0.1, s * a + c * 0.1);
            let line = Vector2::new(tops[k], 0.0) - u.xy() - lever;
            let f = line.norm() / lengths[k];
            pulls[k] = ea * 0.5 * (f * f - 1.0) * f;
            // half of each cable's weight hangs on its lower end
            let force = line.normalize() * pulls[k] - Vector2::new(0.0, half * lengths[k] * 9.81);
            out += Vector3::new(force.x, force.y, lever.x * force.y - lever.y * force.x);
        }
        (out, pulls)
    };
    let mut u = Vector3::new(0.0, -1.0, 0.0);
    for _ in 0..200 {
        let now = forces(&u).0;
        let jacobian = Matrix3::from_columns(&[0, 1, 2].map(|k| {
            let mut moved = u;
            moved[k] += 1e-8;
            (forces(&moved).0 - now) / 1e-8
        }));
        let step = jacobian.lu().solve(&now).unwrap();
        u -= step * (0.05 / step.norm()).min(1.0);
    }
    (u, forces(&u).1)
}

/// A box of 50 kg hangs by the ends of its top face from two points of equal height, on cables of
/// different length; a soft cable and a steel wire.
///
/// Reference: [`tilted_box`].
#[test]
fn a_box_on_unequal_cables_hangs_at_its_static_tilt() {
    for section in [soft(), wire()] {
        let mut world = PhysicsWorld::new();
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(0.0, -1.0, 0.0))
            .linear_damping(2.0)
            .angular_damping(2.0)
            .can_sleep(false);
        let (load, _) = world.insert(body, ColliderBuilder::cuboid(0.3, 0.1, 0.1).mass(50.0));
        let mut set = CableSet::new();
        let tops = [-1.0, 0.8];
        let mut lengths = [0.0; 2];
        let ropes = [0, 1].map(|k| {
            let side = [-0.3, 0.3][k];
            let rope = cable([tops[k], 0.0, 0.0], [side, -0.9, 0.0], section)
                .integrator(l_stable_integrator())
                .fix(At::Start)
                .build()
                .unwrap();
            lengths[k] = rope.length();
            let rope = set.insert(rope);
            set.attach(&world, rope, At::End, load, Vector::new(side as Real, 0.1, 0.0), AttachmentKind::Ball).unwrap();
            rope
        });
        run(&mut world, &mut set, 1500);
        let (u, pulls) = tilted_box(section, tops, lengths, 50.0);
        let b = &world.bodies[load];
        let angle = vector(b.rotation().to_scaled_axis()).z;
        let off = (vector(b.translation()).xy() - u.xy()).norm();
        assert!(off < 1e-4 && (angle - u.z).abs() < 1e-4, "{off:.1e} m, tilt {angle} of {}", u.z);
        for k in 0..2 {
            let pull = tension(&set, ropes[k], 0.5 * lengths[k]);
            assert!((pull / pulls[k] - 1.0).abs() < 2e-3, "cable {k}: {pull} N of {}", pulls[k]);
        }
        assert!(b.linvel().length() < 1e-3 && gap(&set) < 1e-6);
    }
}

/// Loads from 10 g to 100 t on a vertical cable, released suddenly: after 10 s the stretch is
/// static, and it never exceeded twice that (5 % more for the waves of the cable).
///
/// Reference: `m g + mu g (L - s) = EA (f^2 - 1)/2 f` at mid cable; the overshoot of a sudden load.
#[test]
fn a_hanging_load_stretches_its_cable_by_its_stiffness_for_any_mass() {
    for section in [soft(), steel()] {
        for mass in [0.01, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5] {
            let mut world = PhysicsWorld::new();
            let load = add_cube(&mut world, mass as Real, 0.1, [0.0, -2.1, 0.0]);
            world.bodies[load].set_linear_damping(5.0);
            let mut set = CableSet::new();
            let rope = cable([0.0; 3], [0.0, -2.0, 0.0], section).integrator(l_stable_integrator()).fix(At::Start);
            let rope = set.insert(rope.build().unwrap());
            set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
            let (mut lowest, mut rests) = (0.0f64, 0.0);
            for _ in 0..600 {
                set.step(&mut world).unwrap();
                let l = -set.get(rope).unwrap().node_position(10).y;
                lowest = lowest.max(l - 2.0);
                rests = l - 2.0;
            }
            // force at mid cable, and its stretch
            let w = 9.81 * (mass + 0.5 * 2.0 * section.mass_per_length);
            let mut f = 1.0;
            for _ in 0..100 {
                f -= (0.5 * (f * f - 1.0) * f - w / section.axial_stiffness) / (1.5 * f * f - 0.5);
            }
            let stretch = 2.0 * (f - 1.0);
            assert!((rests / stretch - 1.0).abs() < 1e-3, "{mass} kg: {rests:.6e} m of {stretch:.6e}");
            assert!(lowest < 2.1 * stretch, "{mass} kg: {lowest:.3e} m of {stretch:.3e}");
            assert!(
                (tension(&set, rope, 2.0) / (9.81 * mass) - 1.0).abs() < 1e-3 && gap(&set) < 1e-6,
                "{mass} kg {} {:.1e}",
                tension(&set, rope, 2.0),
                gap(&set)
            );
        }
    }
}

/// Cables and bodies found at rest by `equilibrium` are where a damped run leaves them after a long time; they stay there when they are
/// stepped; readings are those at rest.
///
/// Reference: the long-time limit of the motion, and [`tilted_box`].
#[test]
fn equilibrium_is_where_a_damped_run_ends() {
    let tops = [-1.0, 0.8];
    let build = |damping: Real| {
        let mut world = PhysicsWorld::new();
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(0.1, -1.0, 0.05))
            .linear_damping(damping)
            .angular_damping(damping)
            .can_sleep(false);
        let (load, _) = world.insert(body, ColliderBuilder::cuboid(0.3, 0.1, 0.1).mass(50.0));
        let mut set = CableSet::new();
        let ropes = [0, 1].map(|k| {
            let side = [-0.3, 0.3][k];
            let rope = cable([tops[k], 0.0, 0.0], [side + 0.1, -0.9, 0.05], soft())
                .length((tops[k] - side).hypot(0.9))
                .integrator(l_stable_integrator())
                .fix(At::Start);
            let rope = set.insert(rope.build().unwrap());
            set.attach(&world, rope, At::End, load, Vector::new(side as Real, 0.1, 0.0), AttachmentKind::Ball).unwrap();
            rope
        });
        (world, set, load, ropes)
    };
    let (mut world, mut set, load, ropes) = build(0.0);
    let report = set.equilibrium(&mut world).unwrap();
    assert!(report.is_stable() && report.moved == [load] && report.held.is_empty() && report.unattached.is_empty());
    let (mut moving, mut moving_set, moving_load, _) = build(2.0);
    run(&mut moving, &mut moving_set, 1500);
    let (a, b) = (*world.bodies[load].position(), *moving.bodies[moving_load].position());
    assert!((a.translation - b.translation).length() < 1e-4, "{a:?} {b:?}");
    assert!(a.rotation.angle_between(b.rotation) < 2e-3, "{a:?} {b:?}");
    let (u, pulls) = tilted_box(soft(), tops, tops.map(|top| (top - 0.3f64.copysign(top)).hypot(0.9)), 50.0);
    let angle = vector(world.bodies[load].rotation().to_scaled_axis()).z;
    assert!((vector(a.translation).xy() - u.xy()).norm() < 1e-4 && (angle - u.z).abs() < 1e-4, "{a:?} {u:?}");
    for k in 0..2 {
        let pull = tension(&set, ropes[k], 0.5);
        assert!((pull / pulls[k] - 1.0).abs() < 2e-3, "{pull} {pulls:?}");
    }
    // force balance of the readings
    let sum: Vector3<f64> = set.attachments().map(|(_, a)| a.force()).sum();
    assert!((sum - Vector3::y() * 50.0 * 9.81).norm() < 1e-4, "{sum:?}");
    assert!(gap(&set) < 1e-12);
    run(&mut world, &mut set, 60);
    let after = *world.bodies[load].position();
    assert!((a.translation - after.translation).length() < 1e-5, "{a:?} {after:?}");
}

/// What statics cannot compute is an error that names the body, and changes nothing: a joint; where another body falls for ever, a contact
/// where the body is, or where it would come to rest; a load that nothing holds. What is held and what is not attached is listed.
///
/// Reference: the contract.
#[test]
fn equilibrium_refuses_joints_and_contacts_and_lists_what_it_held() {
    let build = |floor: Option<Real>| {
        let mut world = PhysicsWorld::new();
        let (hook, _) = world.insert(RigidBodyBuilder::fixed(), ColliderBuilder::ball(0.01));
        let loose = add_cube(&mut world, 1.0, 0.1, [20.0, 0.0, 0.0]);
        let load = add_cube(&mut world, 10.0, 0.1, [0.0, -1.5, 0.0]);
        if let Some(y) = floor {
            let floor = RigidBodyBuilder::fixed().translation(Vector::new(0.0, y, 0.0));
            world.insert(floor, ColliderBuilder::cuboid(5.0, 0.1, 5.0));
        }
        let mut set = CableSet::new();
        let rope = cable([0.0; 3], [0.0, -1.4, 0.0], wire()).length(2.0);
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::Start, hook, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        (world, set, [hook, loose, load])
    };
    let (mut world, mut set, [hook, loose, load]) = build(None);
    let report = set.equilibrium(&mut world).unwrap();
    assert_eq!((report.moved, report.held, report.unattached), (vec![load], vec![hook], vec![loose]));
    assert!((world.bodies[load].translation().y + 2.1).abs() < 1e-3);
    // the floor where the box stands, where it comes to rest, and below
    for (floor, refused) in [(-1.7, true), (-2.2, true), (-2.4, false)] {
        let (mut world, mut set, [_, _, load]) = build(Some(floor));
        let before = *world.bodies[load].position();
        match set.equilibrium(&mut world) {
            Err(Error::ContactInStatics { body, other }) => {
                assert!(refused && body == load && other.is_some(), "{floor}");
                assert_eq!(*world.bodies[load].position(), before);
            }
            outcome => assert!(!refused && outcome.is_ok(), "{floor}: {outcome:?}"),
        }
    }
    let (mut world, mut set, [_, loose, load]) = build(None);
    let driven = SphericalJointBuilder::new().motor_velocity(JointAxis::AngX, 1.0, 1.0).build();
    world.insert_impulse_joint(loose, load, driven);
    let error = set.equilibrium(&mut world).unwrap_err();
    assert!(matches!(error, Error::JointInStatics { reason: "the motor of a joint drives it", .. }), "{error}");
    let (mut world, mut set, [hook, _, load]) = build(None);
    let held: Vec<_> = set.attachments().filter(|(_, a)| a.body() == hook).map(|(handle, _)| handle).collect();
    set.detach(&mut world, held[0]).unwrap();
    let before = *world.bodies[load].position();
    let error = set.equilibrium(&mut world).unwrap_err();
    assert!(matches!(&error, Error::NotHeldInStatics { bodies, .. } if *bodies == [load]), "{error}");
    assert_eq!(*world.bodies[load].position(), before);
}

/// A load on two ropes of different integrators moves by the finer one, whichever of the ropes comes first.
///
/// Reference: the same with two ropes of the finer integrator, to the bit.
#[test]
fn the_finer_integrator_of_two_ropes_on_a_body_steps_both() {
    let height = |integrators: [Integrator; 2]| {
        let mut world = PhysicsWorld::new();
        let load = add_cube(&mut world, 5.0, 0.1, [0.0; 3]);
        let mut set = CableSet::new();
        for (x, integrator) in [-0.1, 0.1].into_iter().zip(integrators) {
            let rope = cable([10.0 * x, 1.0, 0.0], [x, 0.0, 0.0], soft()).fix(At::Start).integrator(integrator);
            let rope = set.insert(rope.build().unwrap());
            set.attach_here(&world, rope, At::End, load, AttachmentKind::Ball).unwrap();
        }
        run(&mut world, &mut set, 60);
        world.bodies[load].translation().y
    };
    let coarse = Integrator { control: StepControl::MaxStep(1.0 / 240.0), ..l_stable_integrator() };
    let fine = Integrator { control: StepControl::MaxStep(1.0 / 960.0), ..l_stable_integrator() };
    let expected = height([fine; 2]);
    assert!(height([coarse; 2]) != expected);
    assert_eq!([height([coarse, fine]), height([fine, coarse])], [expected; 2]);
}

/// A load on a slack rope comes to rest at the limit of a slider, on the shorter rope of a joint, or at the limit of a hinge.
///
/// Reference: the limits. The rope is slack and carries its own weight at most.
#[test]
fn limits_of_joints_hold_a_load_in_statics() {
    let slider = PrismaticJointBuilder::new(Vector::Y).limits([-1.2, 0.3]).build();
    let hinge = RevoluteJointBuilder::new(Vector::Z).local_anchor2(Vector::new(-1.0, 0.0, 0.0)).limits([-0.4, 0.9]);
    let cases: [(GenericJoint, [Real; 3], [f64; 2]); 3] = [
        (slider.into(), [0.0, -1.0, 0.0], [0.0, -1.2]),
        (RopeJointBuilder::new(1.1).build().into(), [0.1, -1.0, 0.0], [0.0, -1.1]),
        (hinge.build().into(), [1.0, 0.0, 0.0], [0.4f64.cos(), -0.4f64.sin()]),
    ];
    let limp = Section::round(0.003, 1e8, 1000.0).unwrap();
    for (joint, start, expected) in cases {
        let mut world = PhysicsWorld::new();
        let hook = world.insert_body(RigidBodyBuilder::fixed());
        let load = add_cube(&mut world, 5.0, 0.1, start);
        world.insert_impulse_joint(hook, load, joint);
        let mut set = CableSet::new();
        let foot = [f64::from(start[0]), f64::from(start[1]), f64::from(start[2])];
        let rope = set.insert(cable([-0.5, 0.0, 0.0], foot, limp).length(2.2).fix(At::Start).build().unwrap());
        set.attach(&world, rope, At::End, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let found = set.equilibrium(&mut world).unwrap();
        let at = vector(world.bodies[load].translation());
        let pull = set.attachments().map(|(_, a)| a.force().norm()).sum::<f64>();
        println!("{at:?} for {expected:?}, rope {pull} N, {found:?}");
        // the pull of the slack rope moves a load on a rope aside
        let far = if joint.locked_axes.is_empty() { 0.02 } else { 1e-6 };
        assert!((at.xy() - Vector3::new(expected[0], expected[1], 0.0).xy()).norm() < far, "{at:?} {expected:?}");
        if joint.locked_axes.is_empty() {
            assert!((at.norm() - 1.1).abs() < 1e-6, "{at:?}");
        }
        assert!(pull < 2.2 * limp.mass_per_length * 9.81, "{pull} N");
    }
}

/// Colliders are where statics put their bodies, before Rapier steps: a rope beside a body that came to rest is not told as in it.
///
/// *Source.* The pose of the body.
#[test]
fn colliders_follow_their_bodies_in_statics() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let rope =
        set.insert(cable([0.0; 3], [1.5, 0.0, 0.0], steel()).elements(8).length(2.0).fix(At::Start).build().unwrap());
    let load = add_cube(&mut world, 5.0, 0.1, [1.5, -0.1, 0.0]);
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    set.equilibrium(&mut world).unwrap();
    let body = &world.bodies[load];
    assert!(body.translation().y < -1.9);
    let collider = &world.colliders[body.colliders()[0]];
    assert!((collider.position().translation - body.translation()).length() < 1e-6, "{:?}", collider.position());
    assert_eq!(set.warnings(&world), []);
}

/// A wind that is zero when the lamp is put into equilibrium, and rises later, blows it aside as it does without statics; and one that
/// falls to zero.
///
/// *Source.* The same world that was not put into equilibrium, and the balance of moments about the top: tan a = (F L/2)/(m g L + w g L/2)
/// for a straight rope, F its drag.
#[test]
fn a_wind_that_is_zero_in_statics_blows_afterwards() {
    let angle = |rows: [[f64; 2]; 2], settled: bool| {
        let mut world = PhysicsWorld::new();
        let flow = Flow::uniform(Vector3::new(0.0, 0.0, 15.0)).with_history(rows);
        let drag = Some(Drag::new(1.2, 1.2, 0.01, flow));
        let rope =
            cable([0.0; 3], [0.0, -1.0, 0.0], steel()).elements(4).effects(Effects { drag, ..Effects::default() });
        let mut set = CableSet::new();
        let rope = rope.fidelity(lariat_rapier::lariat_ancf::Fidelity::Game).fix(At::Start);
        let rope = set.insert(rope.build().unwrap());
        let lamp = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -1.1, 0.0)).linear_damping(2.0);
        let (lamp, _) = world.insert(lamp.angular_damping(2.0), ColliderBuilder::ball(0.1).mass(2.0));
        set.attach(&world, rope, At::End, lamp, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        if settled {
            set.equilibrium(&mut world).unwrap();
        }
        run(&mut world, &mut set, 1200);
        let end = set.get(rope).unwrap().sample(1.0).unwrap().position;
        end.z.atan2(-end.y)
    };
    let weight = 9.81 * (2.0 + 0.5 * steel().mass_per_length);
    let expected = 0.5 * (0.5 * 1.2 * 1.2 * 0.01 * 15.0 * 15.0) / weight;
    for rows in [[[2.0, 0.0], [3.0, 1.0]], [[0.0, 0.0], [0.5, 1.0]], [[0.0, 0.5], [1.0, 1.0]]] {
        let [settled, drawn] = [true, false].map(|settled| angle(rows, settled));
        println!("{rows:?}: {settled} {drawn} {expected}");
        assert!(
            (settled / drawn - 1.0).abs() < 5e-3 && (drawn / expected - 1.0).abs() < 0.03,
            "{settled} {drawn} {expected}"
        );
    }
    assert!(angle([[1.0, 1.0], [2.0, 0.0]], true).abs() < 1e-3);
}
