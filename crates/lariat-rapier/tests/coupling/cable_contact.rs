//! Contact of cables with colliders.

use lariat_ancf::coupling::Coupling;
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, PointLoad, Section, Vector3};
use lariat_rapier::rapier::dynamics::CoefficientCombineRule;
use lariat_rapier::rapier::math::Vector as RVector;
use lariat_rapier::rapier::pipeline::{DebugColor, DebugRenderBackend, DebugRenderObject};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableHandle, CableSet, ContactFilter, ContactRules, DrawStyle, Event};
use std::f64::consts::PI;

const RADIUS: f64 = 5e-3;

fn half_space(normal: RVector) -> ColliderBuilder {
    ColliderBuilder::new(SharedShape::halfspace(normal))
}

fn rope(from: Vector3<f64>, to: Vector3<f64>, elements: usize) -> Cable {
    Cable::builder()
        .points([from, to])
        .section(Section::from_stiffness(1e5, 1e-2, 0.14).unwrap())
        .elements(elements)
        .damping(Damping { axial: 1e-3, bending: 1e-3 })
        .build()
        .unwrap()
}

fn touching(cables: &mut CableSet, cable: Cable, friction: f64) -> CableHandle {
    let handle = cables.insert(cable);
    cables.set_contact(handle, Contact::with_friction(friction).with_radius(RADIUS)).unwrap();
    handle
}

/// A rope of 1 m, 0.3 m above the origin, along x.
fn above(cables: &mut CableSet) -> CableHandle {
    touching(cables, rope(Vector3::new(-0.5, 0.3, 0.01), Vector3::new(0.5, 0.3, 0.01), 16), 0.5)
}

fn lowest(cable: &Cable) -> f64 {
    (0..=100)
        .map(|i| cable.sample(cable.length() * f64::from(i) / 100.0).unwrap().position.y)
        .fold(f64::INFINITY, f64::min)
}

/// A rope falls on a floor of every shape and comes to rest on it, at the height of its radius.
///
/// *Source.* Geometry; parry's precision is 1e-7 m, height fields and meshes are exact.
#[test]
fn a_rope_lies_on_a_floor_of_every_shape() {
    let v = RVector::new;
    let square = vec![v(-1.0, 0.0, -1.0), v(1.0, 0.0, -1.0), v(1.0, 0.0, 1.0), v(-1.0, 0.0, 1.0)];
    let mut below = square.clone();
    below.extend(square.iter().map(|p| *p - v(0.0, 0.5, 0.0)));
    let heights = lariat_rapier::rapier::parry::utils::Array2::zeros(5, 5);
    let floors = [
        ("half-space", half_space(v(0.0, 1.0, 0.0))),
        ("cuboid", ColliderBuilder::cuboid(1.0, 0.2, 1.0).translation(v(0.0, -0.2, 0.0))),
        ("round cuboid", ColliderBuilder::round_cuboid(0.9, 0.1, 0.9, 0.1).translation(v(0.0, -0.2, 0.0))),
        ("cylinder", ColliderBuilder::cylinder(0.2, 1.0).translation(v(0.0, -0.2, 0.0))),
        ("cone", ColliderBuilder::cone(0.2, 1.0).translation(v(0.0, -0.2, 0.0)).rotation(v(PI as Real, 0.0, 0.0))),
        ("hull", ColliderBuilder::convex_hull(&below).unwrap()),
        ("mesh", ColliderBuilder::trimesh(square.clone(), vec![[0, 2, 1], [0, 3, 2]]).unwrap()),
        ("height field", ColliderBuilder::heightfield(heights, v(2.0, 1.0, 2.0))),
        (
            "compound",
            ColliderBuilder::compound(vec![
                (Pose::from_translation(v(-0.5, -0.2, 0.0)), SharedShape::cuboid(0.5, 0.2, 1.0)),
                (Pose::from_translation(v(0.5, -0.2, 0.0)), SharedShape::cuboid(0.5, 0.2, 1.0)),
            ]),
        ),
    ];
    for (name, floor) in floors {
        let mut world = PhysicsWorld::new();
        world.insert_collider(floor, None);
        let mut cables = CableSet::new();
        let cable = above(&mut cables);
        for _ in 0..120 {
            cables.step(&mut world).unwrap();
        }
        let cable = cables.get(cable).unwrap();
        let (height, speed) = (lowest(cable) - RADIUS, cable.speed());
        let force: f64 = cable.contacts().map(|touch| touch.normal_force).sum();
        println!("{name}: {height:.1e} m above, {speed:.1e} m/s, {force:.4} N");
        assert!(height.abs() < 1e-5 && speed < 1e-3, "{name}: {height} {speed}");
        assert!((force / (0.14 * 9.81) - 1.0).abs() < 1e-3, "{name}: {force}");
    }
}

/// A rope falls on a drum, a ball, a capsule and a cone and hangs or slides off without passing through it.
///
/// *Source.* Geometry: no point of the centre line is nearer than the radius, by more than 5 % of it.
#[test]
fn a_rope_does_not_pass_through_round_shapes() {
    let lying = RVector::new(core::f64::consts::FRAC_PI_2 as Real, 0.0, 0.0);
    let shapes = [
        ("drum", ColliderBuilder::cylinder(1.0, 0.1).rotation(lying)),
        ("ball", ColliderBuilder::ball(0.1)),
        ("rod", ColliderBuilder::capsule_z(1.0, 0.004)),
        ("cone", ColliderBuilder::cone(0.2, 0.2)),
        ("round cylinder", ColliderBuilder::round_cylinder(1.0, 0.08, 0.02).rotation(lying)),
    ];
    for (name, shape) in shapes {
        let mut world = PhysicsWorld::new();
        let collider = world.insert_collider(shape, None);
        let mut cables = CableSet::new();
        let cable = above(&mut cables);
        let mut deepest = 0.0f64;
        let mut touched = false;
        for _ in 0..90 {
            cables.step(&mut world).unwrap();
            let (cable, collider) = (cables.get(cable).unwrap(), &world.colliders[collider]);
            touched |= cable.contacts().count() > 0;
            for i in 0..=200 {
                let x = cable.sample(cable.length() * f64::from(i) / 200.0).unwrap().position;
                let point = RVector::new(x.x as Real, x.y as Real, x.z as Real);
                let distance = f64::from(collider.shape().distance_to_point(collider.position(), point, true));
                deepest = deepest.max(RADIUS - distance);
            }
        }
        println!("{name}: deepest {deepest:.1e} m");
        // near its tip a cone is sharper than the spacing of the samples that its side is met by
        let allowed = if name == "cone" { 0.5 } else { 0.05 };
        assert!(touched && deepest < allowed * RADIUS, "{name}: {deepest}");
    }
}

/// Kinematic colliders carry ropes: a belt that is moved by its velocity or to poses, also with a collider beside the body's origin.
///
/// *Source.* The rope has the speed of the belt.
#[test]
fn a_moving_belt_carries_a_rope() {
    for by_pose in [false, true] {
        let mut world = PhysicsWorld::new();
        let body = if by_pose {
            RigidBodyBuilder::kinematic_position_based()
        } else {
            RigidBodyBuilder::kinematic_velocity_based()
        };
        let body = body.translation(RVector::new(0.0, 1.0, 0.0)).linvel(RVector::new(0.4, 0.0, 0.3));
        let belt = ColliderBuilder::cuboid(3.0, 0.1, 3.0).translation(RVector::new(0.2, -1.1, 0.1)).friction(0.5);
        let (body, _) = world.insert(body, belt);
        let mut cables = CableSet::new();
        let cable =
            touching(&mut cables, rope(Vector3::new(-0.5, RADIUS, 0.0), Vector3::new(0.5, RADIUS, 0.0), 10), 0.5);
        for i in 1..=60 {
            if by_pose {
                let t = i as Real / 60.0;
                world.bodies[body].set_next_kinematic_translation(RVector::new(0.4 * t, 1.0, 0.3 * t));
            }
            cables.step(&mut world).unwrap();
        }
        let v = &cables.get(cable).unwrap().velocities()[30..33];
        println!("by pose {by_pose}: {v:?}");
        assert!((v[0] - 0.4).hypot(v[2] - 0.3) < 1e-3, "{v:?}");
    }
}

/// A drum that turns drags a rope that is held, with the ratio of the capstan.
///
/// *Source.* T2/T1 = exp(mu phi), Euler-Eytelwein, with mu the mean of 0.2 and 0.4.
#[test]
fn a_turning_drum_drags_a_rope() {
    let (drum, middle) = (0.1, 0.1 + RADIUS);
    let mut world = PhysicsWorld::new();
    world.gravity = RVector::ZERO;
    let body = RigidBodyBuilder::kinematic_velocity_based().angvel(RVector::new(0.0, 0.0, -5.0));
    let side = ColliderBuilder::cylinder(1.0, drum as Real).friction(0.4);
    world.insert(body, side.rotation(RVector::new(core::f64::consts::FRAC_PI_2 as Real, 0.0, 0.0)));
    // half a turn over the drum, both ends down
    let turn: Vec<Vector3<f64>> =
        (0..=48).map(|i| PI * f64::from(i) / 48.0).map(|a| Vector3::new(-a.cos(), a.sin(), 0.0) * middle).collect();
    let mut points = vec![turn[0] - Vector3::y() * 0.25];
    points.extend(&turn);
    points.push(turn[48] - Vector3::y() * 0.25);
    let cable = Cable::builder()
        .points(points)
        .section(Section::from_stiffness(1e6, 1e-3, 0.14).unwrap())
        .elements(16)
        .damping(Damping { axial: 1e-3, bending: 1e-3 })
        .gravity(Vector3::zeros())
        .fix(At::Start)
        .build()
        .unwrap();
    let length = cable.length();
    let mut cables = CableSet::new();
    let cable = touching(&mut cables, cable, 0.2);
    cables.get_mut(cable).unwrap().add_load(PointLoad::force(length, Vector3::new(0.0, -50.0, 0.0))).unwrap();
    for _ in 0..120 {
        cables.step(&mut world).unwrap();
    }
    let tension = |s: f64| cables.get(cable).unwrap().sample(s).unwrap().tension;
    let (ratio, exact) = (tension(length - 0.1) / tension(0.1), (0.3 * PI).exp());
    println!("{ratio} for {exact}, or its inverse");
    assert!((ratio / exact - 1.0).abs() < 0.02 || (ratio * exact - 1.0).abs() < 0.02, "{ratio} {exact}");
}

/// Sensors, groups, disabled colliders and the filter are what they are for Rapier; the skin is kept.
///
/// *Source.* Rapier's documentation of each.
#[test]
fn a_cable_touches_what_rapier_would() {
    let floor = || ColliderBuilder::cuboid(1.0, 0.1, 1.0).translation(RVector::new(0.0, -0.1, 0.0));
    let group = |of: Group, with: Group| InteractionGroups::new(of, with, InteractionTestMode::And);
    let rules = ContactRules { collision_groups: group(Group::GROUP_1, Group::GROUP_1), ..ContactRules::default() };
    let solver = ContactRules { solver_groups: group(Group::GROUP_1, Group::GROUP_1), ..ContactRules::default() };
    let only_2 = group(Group::GROUP_2, Group::ALL);
    let none = ContactRules::default();
    let cases: [(&str, ColliderBuilder, ContactRules, bool, Option<f64>); 8] = [
        ("floor", floor(), none, true, Some(0.0)),
        ("sensor", floor().sensor(true), none, true, None),
        ("disabled", floor().enabled(false), none, true, None),
        ("collision groups", floor().collision_groups(only_2), rules, true, None),
        ("solver groups", floor().solver_groups(only_2), solver, true, None),
        ("same groups", floor().collision_groups(group(Group::GROUP_1, Group::ALL)), rules, true, Some(0.0)),
        ("filter", floor(), none, false, None),
        ("skin", floor().contact_skin(0.02), none, true, Some(0.02)),
    ];
    for (name, collider, rules, allowed, height) in cases {
        let mut world = PhysicsWorld::new();
        let collider = world.insert_collider(collider, None);
        let mut cables = CableSet::new();
        let cable = above(&mut cables);
        cables.set_contact_rules(cable, rules).unwrap();
        cables.set_contact_filter(Some(ContactFilter::new(move |_, other| allowed || other != collider)));
        for _ in 0..90 {
            cables.step(&mut world).unwrap();
        }
        let found = lowest(cables.get(cable).unwrap()) - RADIUS;
        println!("{name}: {found:.2e}");
        match height {
            None => assert!(found < -1.0, "{name}: {found}"),
            Some(height) => assert!((found - height).abs() < 1e-5, "{name}: {found}"),
        }
    }
}

/// Friction is combined by the stronger rule of cable and collider: at 25 degrees a rope of 0.1 sticks to 0.9 by their mean, and slides by
/// their minimum.
///
/// *Source.* `CoefficientCombineRule`; tan 25 degrees = 0.466.
#[test]
fn friction_is_combined_as_rapier_combines_it() {
    let angle = 25f64.to_radians();
    for (rule, exact) in [
        (CoefficientCombineRule::Average, 0.0),
        (CoefficientCombineRule::Min, 9.81 * (angle.sin() - 0.1 * angle.cos())),
    ] {
        let mut world = PhysicsWorld::new();
        world.gravity = RVector::new((9.81 * angle.sin()) as Real, (-9.81 * angle.cos()) as Real, 0.0);
        world.insert_collider(half_space(RVector::new(0.0, 1.0, 0.0)).friction(0.9), None);
        let mut cables = CableSet::new();
        let cable =
            touching(&mut cables, rope(Vector3::new(0.0, RADIUS, 0.0), Vector3::new(1.0, RADIUS, 0.0), 10), 0.1);
        cables
            .set_contact_rules(cable, ContactRules { friction_combine_rule: rule, ..ContactRules::default() })
            .unwrap();
        for _ in 0..60 {
            cables.step(&mut world).unwrap();
        }
        let speed = cables.get(cable).unwrap().velocities()[30];
        println!("{rule:?}: {speed:.4} m/s for {exact:.4}");
        assert!((speed - exact).abs() < 0.01 * 9.81, "{rule:?}: {speed} {exact}");
    }
}

/// Contacts that begin and end are events, with the place and the force.
///
/// *Source.* The rope lands flat: the centre of the forces is its middle. It then leaves when the floor is removed.
#[test]
fn contacts_begin_and_end_with_events() {
    let mut world = PhysicsWorld::new();
    let floor = world.insert_collider(half_space(RVector::new(0.0, 1.0, 0.0)), None);
    let mut cables = CableSet::new();
    let cable = above(&mut cables);
    let mut began = Vec::new();
    for _ in 0..90 {
        cables.step(&mut world).unwrap();
        began.extend(cables.take_events());
    }
    // it may bounce: beginnings and ends alternate, from a beginning to a beginning
    assert!(began.len() % 2 == 1, "{began:?}");
    for (i, event) in began.iter().enumerate() {
        match *event {
            Event::ContactStarted { cable: c, collider, arc_length, force } if i % 2 == 0 => {
                assert!((c, collider) == (cable, floor) && (arc_length - 0.5).abs() < 0.05 && force > 0.0, "{event:?}");
            }
            Event::ContactEnded { cable: c, collider, .. } if i % 2 == 1 => assert!((c, collider) == (cable, floor)),
            ref other => panic!("{other:?}"),
        }
    }
    assert!(cables.contacts(cable).unwrap().all(|(collider, _)| collider == floor));
    world.remove_collider(floor);
    cables.step(&mut world).unwrap();
    let ended = cables.take_events();
    assert!(matches!(ended[..], [Event::ContactEnded { collider, .. }] if collider == floor), "{ended:?}");
}

/// A snapshot of world and set taken while a rope slips continues bitwise, and so does the set that was never saved.
///
/// *Source.* Equality.
#[test]
fn a_snapshot_in_contact_continues_bitwise() {
    let mut world = PhysicsWorld::new();
    world.insert_collider(half_space(RVector::new(0.3, 1.0, 0.0).normalize()), None);
    world.insert_collider(ColliderBuilder::cuboid(0.2, 0.1, 0.2).rotation(RVector::new(0.0, 0.4, 0.0)), None);
    let mut cables = CableSet::new();
    let cable = above(&mut cables);
    for _ in 0..30 {
        cables.step(&mut world).unwrap();
    }
    assert!(cables.contacts(cable).unwrap().count() > 0);
    let saved = bincode::serialize(&(&world, &cables)).unwrap();
    let (mut world_2, mut cables_2): (PhysicsWorld, CableSet) = bincode::deserialize(&saved).unwrap();
    for _ in 0..30 {
        cables.step(&mut world).unwrap();
        cables_2.step(&mut world_2).unwrap();
    }
    assert!(cables.get(cable).unwrap().snapshot() == cables_2.get(cable).unwrap().snapshot());
}

/// In statics a rope lies on a box that is fixed, and stays there when it moves on, or on that of a
/// body that no cable moves; one that hangs beside both is as without contact.
///
/// *Source.* Statics: box and ends carry the weight; the contract.
#[test]
fn in_statics_a_rope_lies_on_what_stays() {
    for (top, dynamic) in [(-0.2, false), (-0.15, false), (-0.2, true), (-0.6, false), (-0.6, true)] {
        let mut world = PhysicsWorld::new();
        let block = ColliderBuilder::cuboid(0.6, 1.0, 1.0);
        let body = if dynamic { RigidBodyBuilder::dynamic() } else { RigidBodyBuilder::fixed() };
        world.insert(body.translation(RVector::new(0.0, top - 1.0, 0.0)), block);
        let section = Section::from_stiffness(1e5, 1e-2, 0.14).unwrap();
        let hanging = Cable::builder()
            .points([Vector3::new(-0.5, 0.0, 0.0), Vector3::new(0.5, 0.0, 0.0)])
            .length(1.3)
            .elements(40)
            .section(section)
            .fix(At::Start)
            .fix(At::End);
        let mut cables = CableSet::new();
        let rope = touching(&mut cables, hanging.build().unwrap(), 0.5);
        cables.equilibrium(&mut world).unwrap();
        let carried: f64 = cables.contacts(rope).unwrap().map(|(_, touch)| touch.normal_force).sum();
        let cable = cables.get_mut(rope).unwrap();
        let ends = -(cable.pull(0).0.y + cable.pull(cable.nodes() - 1).0.y);
        let weight = 0.14 * 9.81 * 1.3;
        println!("top {top}: box {carried:.4}, ends {ends:.4} of {weight:.4} N");
        assert!((carried + ends - weight).abs() < 1e-5 * weight);
        assert_eq!(carried > 0.1, top > -0.3);
        if dynamic {
            // it falls
            continue;
        }
        for _ in 0..30 {
            cables.step(&mut world).unwrap();
        }
        let after: f64 = cables.contacts(rope).unwrap().map(|(_, touch)| touch.normal_force).sum();
        let kinetic = cables.get(rope).unwrap().energy().kinetic;
        println!("moved on: {after:.4} N, {kinetic:.1e} J");
        assert!((after - carried).abs() < 1e-2 * weight && kinetic < 1e-8, "{after} {carried} {kinetic:e}");
    }
}

#[derive(Default)]
struct Lines(Vec<(RVector, RVector)>);

impl DebugRenderBackend for Lines {
    fn draw_line(&mut self, _: DebugRenderObject, a: RVector, b: RVector, _: DebugColor) {
        self.0.push((a, b));
    }
}

/// Each contact is drawn as a line of its force, or none of them.
///
/// *Source.* The contract: 5 mm per N, and the forces carry the weight.
#[test]
fn contact_forces_are_drawn() {
    let mut world = PhysicsWorld::new();
    world.insert_collider(half_space(RVector::new(0.0, 1.0, 0.0)), None);
    let mut cables = CableSet::new();
    let cable = above(&mut cables);
    for _ in 0..120 {
        cables.step(&mut world).unwrap();
    }
    let contacts = cables.contacts(cable).unwrap().count();
    let (mut all, mut none) = (Lines::default(), Lines::default());
    cables.draw(&mut all, &DrawStyle::default());
    cables.draw(&mut none, &DrawStyle { force_length: 0.0, ..DrawStyle::default() });
    assert_eq!((all.0.len(), none.0.len()), (64 + contacts, 64));
    let up: f64 = all.0[..contacts].iter().map(|(a, b)| f64::from(b.y - a.y)).sum();
    assert!((up / (5e-3 * 0.14 * 9.81) - 1.0).abs() < 1e-2, "{up}");
}
