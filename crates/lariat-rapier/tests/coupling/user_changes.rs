//! Bodies that the user removes, disables, moves or changes during a run.

use super::common::{add_cube, cable, gap, run, soft, tension};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Damping, Fidelity, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet, Event, Gap};

struct Hung {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    rope: CableHandle,
    held: AttachmentHandle,
}

/// Returns a load of 5 kg swinging on a cable, after half a second.
fn hanging_load() -> Hung {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 5.0, 0.1, [2.0, -0.1, 0.0]);
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [2.0, 0.0, 0.0], soft()).fix(At::Start).fidelity(Fidelity::Engineering);
    let rope = set.insert(rope.build().unwrap());
    let held = set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 30);
    Hung { world, set, load, rope, held }
}

impl Hung {
    fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            self.set.step(&mut self.world).unwrap();
            assert!(self.set.get(self.rope).unwrap().positions().iter().all(|x| x.is_finite()));
            if let Some(b) = self.world.bodies.get(self.load) {
                assert!(vector(b.translation()).iter().chain(vector(b.linvel()).iter()).all(|x| x.is_finite()));
            }
        }
    }

    fn end(&self) -> ::nalgebra::Vector3<f64> {
        self.set.get(self.rope).unwrap().node_position(10)
    }

    fn anchor(&self) -> ::nalgebra::Vector3<f64> {
        vector(*self.world.bodies[self.load].position() * Vector::new(0.0, 0.1, 0.0))
    }
}

/// A body is removed from the world: one event, no attachment and no ledger left, and the end of
/// the cable is free.
///
/// Reference: the contract; the energy of the cable alone is conserved.
#[test]
fn removing_a_body_ends_its_attachment_and_frees_the_cable() {
    let mut h = hanging_load();
    h.world.remove_body(h.load);
    h.run(1);
    assert_eq!(h.set.events(), [Event::AttachmentEnded { attachment: h.held, body: h.load }]);
    assert!(h.set.attachment(h.held).is_err());
    h.run(1);
    assert!(h.set.events().is_empty());
    let energy = |h: &Hung| h.set.get(h.rope).unwrap().energy().total();
    let before = energy(&h);
    h.run(60);
    assert_eq!(h.world.bodies.len(), 0);
    assert!((energy(&h) - before).abs() < 1e-3 * 0.8 * 9.81 * 2.0, "{} J, {before} J", energy(&h));
    assert!(h.end().norm() < 2.05, "{:?}", h.end());
}

/// A body is removed from the world while it is in contact with a wall.
///
/// Reference: the contract: one body, the wall, is left.
#[test]
fn removing_a_body_in_contact_removes_its_ledger() {
    let mut h = hanging_load();
    let at = h.world.bodies[h.load].translation();
    let wall = RigidBodyBuilder::fixed().translation(at - Vector::new(0.32, 0.0, 0.0));
    h.world.insert(wall, ColliderBuilder::cuboid(0.1, 2.0, 1.0));
    h.run(30);
    assert_eq!(h.world.bodies.len(), 4, "the load, the wall, a ledger and the mark of the world");
    h.world.remove_body(h.load);
    h.run(30);
    assert_eq!(h.world.bodies.len(), 1);
}

/// A body is disabled, and enabled again: its cable holds still with it, and swings on.
///
/// Reference: a disabled body does not move; the end of the cable is on its anchor.
#[test]
fn a_disabled_body_holds_the_end_of_its_cable_fixed() {
    let mut h = hanging_load();
    h.world.bodies[h.load].set_enabled(false);
    h.run(1);
    let at = h.world.bodies[h.load].translation();
    h.run(60);
    assert_eq!(h.world.bodies[h.load].translation(), at);
    let held = (h.end() - h.anchor()).norm();
    h.world.bodies[h.load].set_enabled(true);
    h.run(60);
    assert!(held < 5e-7 && gap(&h.set) < 1e-6, "{held:.1e} m");
    assert!((h.world.bodies[h.load].translation() - at).length() > 0.1, "it swings on");
}

/// A swinging body becomes fixed or kinematic, and dynamic again: the end of the cable stays on it.
///
/// Reference: the contract.
#[test]
fn a_body_may_change_between_dynamic_fixed_and_kinematic() {
    let mut h = hanging_load();
    for kind in [RigidBodyType::Fixed, RigidBodyType::KinematicVelocityBased, RigidBodyType::KinematicPositionBased] {
        h.world.bodies[h.load].set_body_type(kind, true);
        h.world.bodies[h.load].set_linvel(Vector::ZERO, true);
        h.world.bodies[h.load].set_angvel(Vector::ZERO, true);
        h.run(30);
        let held = (h.end() - h.anchor()).norm();
        h.world.bodies[h.load].set_body_type(RigidBodyType::Dynamic, true);
        h.run(30);
        assert!(held < 5e-7 && gap(&h.set) < 1e-3, "{kind:?}: {held:.1e} m, {:.1e} m", gap(&h.set));
    }
}

/// A body is set to another position: the gap of 0.1 m, or of 0.5 m that stretches the cable,
/// closes at 10 m/s at most.
///
/// Reference: the contract.
#[test]
fn the_gap_to_a_teleported_body_closes() {
    for jump in [0.1, 0.5] {
        let mut h = hanging_load();
        let to = h.world.bodies[h.load].translation() - Vector::new(jump, 0.0, 0.0);
        h.world.bodies[h.load].set_translation(to, true);
        h.run((60.0 * f64::from(jump) / 6.6).ceil() as usize);
        assert!(gap(&h.set) < 1e-3, "{jump} m: {:.1e} m", gap(&h.set));
        h.run(60);
        assert!(gap(&h.set) < 1e-3, "{jump} m: {:.1e} m", gap(&h.set));
    }
}

/// Wrong handles and points give errors, and change nothing.
///
/// Reference: the contract.
#[test]
fn wrong_handles_give_typed_errors() {
    let mut h = hanging_load();
    let other = add_cube(&mut h.world, 1.0, 0.1, [9.0; 3]);
    let twice = h.set.attach(&h.world, h.rope, At::End, other, Vector::ZERO, AttachmentKind::Ball).unwrap_err();
    assert!(matches!(twice, lariat_rapier::Error::AlreadyAttached { node: 10, .. }), "{twice}");
    let nowhere =
        h.set.attach(&h.world, h.rope, At::ArcLength(2.123), other, Vector::ZERO, AttachmentKind::Ball).unwrap_err();
    assert!(matches!(nowhere, lariat_rapier::Error::Cable(_)), "{nowhere}");
    h.world.remove_body(other);
    let gone = h.set.attach(&h.world, h.rope, At::Start, other, Vector::ZERO, AttachmentKind::Ball).unwrap_err();
    assert_eq!(gone, lariat_rapier::Error::NoBody(other));
    h.run(5);
    h.set.remove(&mut h.world, h.rope).unwrap();
    assert!(h.set.get(h.rope).is_err() && h.set.attachment(h.held).is_err());
    h.set.step(&mut h.world).unwrap();
}

/// The ground that bears half of a box is taken away, a rope bears the other half: what bore the box is forgotten at once, or the prediction
/// would be wrong by it, and open the attachment by F h^2/2m, 0.7 mm.
///
/// Reference: the load oscillates about its weight, by the half that it lost; the rope hardly damps.
#[test]
fn a_box_hangs_on_its_rope_when_the_ground_is_removed() {
    let mut world = PhysicsWorld::new();
    let ground = ColliderBuilder::cuboid(2.0, 0.5, 2.0).translation(Vector::new(0.0, -0.5, 0.0));
    let (ground, _) = world.insert(RigidBodyBuilder::fixed(), ground);
    let load = add_cube(&mut world, 50.0, 0.1, [0.0, 0.1, 0.0]);
    *world.bodies[load].activation_mut() = RigidBodyActivation::cannot_sleep();
    let hook = world.insert_body(RigidBodyBuilder::fixed().translation(Vector::new(0.0, 2.2, 0.0)));
    let mut set = CableSet::new();
    let weight = 50.0 * 9.81;
    // stretched by half the weight when it is closed
    let to = 2.2 - 2.0 / (1.0 + 0.5 * weight / 1e5);
    let rope = cable([0.0, 2.2, 0.0], [0.0, to, 0.0], soft()).damping(Damping { axial: 1e-3, bending: 1e-3 });
    let rope = set.insert(rope.gravity(Vector3::zeros()).build().unwrap());
    set.attach(&world, rope, At::Start, hook, Vector::ZERO, AttachmentKind::Ball).unwrap();
    let ball = AttachmentKind::Ball.with_gap(Gap::Close);
    set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), ball).unwrap();
    run(&mut world, &mut set, 60);
    let borne = tension(&set, rope, 1.0);
    world.remove_body(ground);
    let (mut widest, mut largest) = (0.0_f64, 0.0_f64);
    for _ in 0..60 {
        run(&mut world, &mut set, 1);
        widest = widest.max(gap(&set));
        largest = largest.max(tension(&set, rope, 1.0));
    }
    println!("{borne:.1} N of {:.1}, then up to {largest:.1} N, gap {widest:.1e} m", 0.5 * weight);
    assert!((borne / weight - 0.5).abs() < 0.02 && widest < 1e-6, "{borne} N, {widest:.1e} m");
    assert!((largest / (2.0 * weight - borne) - 1.0).abs() < 0.03, "{largest} N");
}

/// Of two balls of 1 kg that are one body on a rope, the lower is removed, so that the centre of mass jumps, and the user has the mass computed
/// anew: the body stays where it is, and the gap closed.
///
/// Reference: the contract.
#[test]
fn a_body_that_loses_half_its_mass_hangs_on_with_the_other() {
    let mut world = PhysicsWorld::new();
    let ball = || ColliderBuilder::ball(0.1).mass(1.0);
    let (load, _) = world.insert(RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -2.0, 0.0)), ball());
    let lower = world.insert_collider(ball().translation(Vector::new(0.0, -0.4, 0.0)), Some(load));
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [0.0, -2.0, 0.0], soft()).fix(At::Start).build().unwrap());
    set.attach(&world, rope, At::End, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 30);
    world.remove_collider(lower);
    let PhysicsWorld { bodies, colliders, .. } = &mut world;
    bodies[load].recompute_mass_properties_from_colliders(colliders);
    for _ in 0..60 {
        set.step(&mut world).unwrap();
        let height = world.bodies[load].translation().y;
        assert!((height + 2.0).abs() < 2e-3 && gap(&set) < 1e-6, "{height} m, {:.1e} m", gap(&set));
    }
}

/// Changes of mass between two host steps, by each of Rapier's ways.
const CHANGES_OF_MASS: [fn(&mut PhysicsWorld, RigidBodyHandle); 6] = [
    |world, load| world.bodies[load].set_additional_mass(7.0, true),
    |world, load| {
        let heavy = MassProperties::new(Vector::new(0.03, -0.05, 0.02), 3.0, Vector::new(0.1, 0.2, 0.3));
        world.bodies[load].set_additional_mass_properties(heavy, true);
    },
    |world, load| each_collider(world, load, |collider| collider.set_mass(0.5)),
    |world, load| each_collider(world, load, |collider| collider.set_density(9000.0)),
    |world, load| {
        let weight = ColliderBuilder::ball(0.05).mass(2.0).translation(Vector::new(0.0, -0.2, 0.1));
        world.insert_collider(weight, Some(load));
    },
    |world, load| {
        each_collider(world, load, |collider| collider.set_position_wrt_parent(Pose::translation(0.05, -0.1, 0.0)));
    },
];

fn each_collider(world: &mut PhysicsWorld, load: RigidBodyHandle, change: fn(&mut Collider)) {
    for collider in world.bodies[load].colliders().to_vec() {
        change(&mut world.colliders[collider]);
    }
}

/// The mass, the centre of mass or the inertia of a swinging load is changed between two host
/// steps: it acts in the next one, as if the user had called
/// `recompute_mass_properties_from_colliders`, to the bit, and no gap opens.
///
/// Reference: the same run with that call, which this crate's step does not need.
#[test]
fn a_change_of_mass_acts_in_the_next_step() {
    for (i, change) in CHANGES_OF_MASS.into_iter().enumerate() {
        let run = |by_hand: bool| {
            let mut h = hanging_load();
            let before = h.world.bodies[h.load].mass_properties().local_mprops;
            change(&mut h.world, h.load);
            let PhysicsWorld { bodies, colliders, .. } = &mut h.world;
            if by_hand {
                bodies[h.load].recompute_mass_properties_from_colliders(colliders);
            }
            let mut places = Vec::new();
            for _ in 0..10 {
                h.run(1);
                assert!(gap(&h.set) < 1e-6, "change {i}: gap {:.1e} m", gap(&h.set));
                places.push((h.end(), vector(h.world.bodies[h.load].linvel()), tension(&h.set, h.rope, 1.0)));
            }
            assert_ne!(before, h.world.bodies[h.load].mass_properties().local_mprops, "change {i}");
            places
        };
        assert_eq!(run(false), run(true), "change {i}");
    }
}

/// A body that was given a mass besides its collider is hung up before Rapier has stepped it: the
/// first step knows all of it.
///
/// Reference: the same run with a call of `recompute_mass_properties_from_colliders`.
#[test]
fn a_new_body_has_its_whole_mass_in_the_first_step() {
    let run = |by_hand: bool| {
        let mut world = PhysicsWorld::new();
        let body = RigidBodyBuilder::dynamic().additional_mass(100.0).translation(Vector::new(2.0, 0.0, 0.0));
        let (load, _) = world.insert(body, ColliderBuilder::ball(0.1).mass(0.5));
        let PhysicsWorld { bodies, colliders, .. } = &mut world;
        if by_hand {
            bodies[load].recompute_mass_properties_from_colliders(colliders);
        }
        let mut set = CableSet::new();
        let rope = cable([0.0; 3], [2.0, 0.0, 0.0], soft()).fix(At::Start);
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::End, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.step(&mut world).unwrap();
        (vector(world.bodies[load].linvel()), set.get(rope).unwrap().positions().to_vec())
    };
    assert_eq!(run(false), run(true));
}

/// A cable is cut between the prediction of a step and its reconciliation.
///
/// Reference: the contract; the load falls, by g t^2/2 within 10 % for the swing of the cut end.
#[test]
fn a_cable_may_be_cut_while_rapier_steps() {
    let mut h = hanging_load();
    let start = h.world.bodies[h.load].linvel().y;
    let mut host = h.set.begin(&mut h.world).unwrap();
    let mut cut = false;
    while host.is_unfinished() {
        h.set.predict_next(&mut h.world, &mut host).unwrap();
        if !core::mem::replace(&mut cut, true) {
            h.set.cut(h.rope, 1.0).unwrap();
        }
        h.world.step();
        h.set.reconcile(&mut h.world);
    }
    h.set.finish(&mut h.world, host).unwrap();
    h.run(29);
    let fallen = f64::from(h.world.bodies[h.load].linvel().y - start);
    println!("{fallen} m/s");
    assert!((fallen / (-9.81 * 0.5) - 1.0).abs() < 0.1, "{fallen} m/s");
}

/// A dumbbell of two cubes on a rope with a third on a second one tied to its middle, swinging and
/// spinning without gravity, is moved and turned in one call: its run goes on as the moved one
/// would, without a gap, with the same tensions.
///
/// Reference: frame indifference. Bounds: single precision of the bodies over the way of a second.
#[test]
fn bodies_move_with_their_ropes_in_one_call() {
    let by = Pose::from_parts(Vector::new(30.0, -4.0, 7.0), Rotation::from_rotation_y(0.7));
    let run = |moved: bool| {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let cubes = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]].map(|at| add_cube(&mut world, 5.0, 0.1, at));
        world.bodies[cubes[0]].set_linvel(Vector::new(0.0, 2.0, 1.0), true);
        world.bodies[cubes[1]].set_angvel(Vector::new(3.0, 2.0, 1.0), true);
        let mut set = CableSet::new();
        let rope = cable([0.1, 0.0, 0.0], [1.9, 0.0, 0.0], soft()).fidelity(Fidelity::Game);
        let rope = set.insert(rope.gravity(Vector3::zeros()).build().unwrap());
        let tail = cable([1.0, 0.0, 0.0], [1.0, -1.0, 0.0], soft()).fidelity(Fidelity::Game).gravity(Vector3::zeros());
        let tail = set.insert(tail.build().unwrap());
        set.attach(&world, rope, At::Start, cubes[0], Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::End, cubes[1], Vector::new(-0.1, 0.0, 0.0), AttachmentKind::Clamp).unwrap();
        set.join((rope, At::Node(5)), (tail, At::Start)).unwrap();
        let mut forces = Vec::new();
        for step in 0..90 {
            if step == 30 && moved {
                set.move_bodies(&mut world, &cubes, &by).unwrap();
                assert!(gap(&set) < 1e-5, "{}", gap(&set));
            }
            set.step(&mut world).unwrap();
            forces.push(tension(&set, rope, 0.5));
        }
        let places = cubes.map(|cube| world.bodies[cube].center_of_mass());
        let end = set.get(tail).unwrap().node_position(10);
        (places, end, forces, gap(&set))
    };
    let (stayed, moved) = (run(false), run(true));
    let to = |p: Vector| by.rotation * p + by.translation;
    let off = (0..2).map(|i| (to(stayed.0[i]) - moved.0[i]).length()).fold(0.0, Real::max);
    let end = vector(to(lariat_rapier::convert::to_vector(&stayed.1))) - moved.1;
    let pulled = stayed.2.iter().zip(&moved.2).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let largest = stayed.2.iter().copied().fold(0.0, f64::max);
    println!(
        "off by {off:.1e} m, end {:.1e} m, tension {pulled:.1e} of {largest:.1} N, gap {:.1e} m",
        end.norm(),
        moved.3
    );
    assert!(off < 1e-3 && end.norm() < 5e-3 && pulled < 0.02 * largest && moved.3 < 1e-5);
}

/// A load that swings on a body that is fixed, or led, moves with it under gravity, turned about the vertical.
///
/// Reference: frame indifference.
#[test]
fn what_holds_a_rope_is_moved_with_it() {
    let by = Pose::from_parts(Vector::new(3.0, 1.0, -2.0), Rotation::from_rotation_y(0.7));
    for holder in [RigidBodyBuilder::fixed(), RigidBodyBuilder::kinematic_position_based()] {
        let run = |moved: bool| {
            let mut world = PhysicsWorld::new();
            let hook = world.insert_body(holder.clone());
            let load = add_cube(&mut world, 20.0, 0.1, [1.5, -1.0, 0.5]);
            let mut set = CableSet::new();
            let rope = set.insert(cable([0.0; 3], [1.5, -1.0, 0.5], soft()).fidelity(Fidelity::Game).build().unwrap());
            set.attach(&world, rope, At::Start, hook, Vector::ZERO, AttachmentKind::Ball).unwrap();
            set.attach(&world, rope, At::End, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
            for step in 0..60 {
                if step == 30 && moved {
                    set.move_bodies(&mut world, &[hook, load], &by).unwrap();
                }
                set.step(&mut world).unwrap();
            }
            (world.bodies[load].center_of_mass(), set.get(rope).unwrap().node_position(5))
        };
        let (stayed, moved) = (run(false), run(true));
        let to = |p: Vector| by.rotation * p + by.translation;
        let off = (to(stayed.0) - moved.0).length();
        let node = (vector(to(lariat_rapier::convert::to_vector(&stayed.1))) - moved.1).norm();
        assert!(off < 1e-4 && node < 1e-4, "{off} m, {node} m");
    }
}

/// What cannot move as one is refused by name, and nothing has moved.
///
/// Reference: the contract.
#[test]
fn what_cannot_be_moved_with_its_ropes_is_refused() {
    let mut h = hanging_load();
    let before = (h.end(), h.anchor());
    let by = Pose::from_translation(Vector::new(1.0, 0.0, 0.0));
    let held = h.set.move_bodies(&mut h.world, &[h.load], &by);
    assert!(matches!(held, Err(lariat_rapier::Error::HeldInMove { .. })), "{held:?}");
    let nowhere = Pose::from_translation(Vector::new(Real::NAN, 0.0, 0.0));
    assert_eq!(h.set.move_bodies(&mut h.world, &[h.load], &nowhere), Err(lariat_rapier::Error::MoveNotFinite));
    let other = add_cube(&mut h.world, 1.0, 0.1, [9.0, 0.0, 0.0]);
    h.world.insert_impulse_joint(h.load, other, SphericalJointBuilder::new());
    let joined = h.set.move_bodies(&mut h.world, &[h.load], &by);
    assert_eq!(joined, Err(lariat_rapier::Error::JointInMove { body: h.load }));
    assert_eq!(before, (h.end(), h.anchor()));
}

/// A change of gravity, or of the gravity scale of a body, between two host steps acts in the next
/// one.
///
/// Reference: free fall at 10 m/s^2, less what a slack rope without weight of its own is carried
/// along: 0.6 kg, of which a share hangs on 5 kg.
#[test]
fn a_change_of_gravity_acts_in_the_next_step() {
    for by_scale in [false, true] {
        let mut world = PhysicsWorld::new();
        world.gravity = if by_scale { Vector::new(0.0, -10.0, 0.0) } else { Vector::ZERO };
        let load = add_cube(&mut world, 5.0, 0.1, [1.0, 0.0, 0.0]);
        world.bodies[load].set_gravity_scale(if by_scale { 0.0 } else { 1.0 }, true);
        let mut set = CableSet::new();
        let light = cable([0.0; 3], [1.0, 0.0, 0.0], soft()).length(1.5).elements(4).gravity(Vector3::zeros());
        let rope = set.insert(light.fix(At::Start).fidelity(Fidelity::Game).build().unwrap());
        set.attach(&world, rope, At::End, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
        run(&mut world, &mut set, 2);
        let before = world.bodies[load].linvel().y;
        if by_scale {
            world.bodies[load].set_gravity_scale(1.0, true);
        } else {
            world.gravity = Vector::new(0.0, -10.0, 0.0);
        }
        run(&mut world, &mut set, 1);
        let gained = f64::from(world.bodies[load].linvel().y - before) * 60.0;
        println!("by scale {by_scale}: {gained:.2} m/s^2");
        assert!((-10.1..-8.0).contains(&gained), "{gained}");
    }
}
