//! Statics of twisted cables that hold bodies.

use super::{G, down, moves};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, CableBuilder, Effects, Section, Torsion, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};
use std::f64::consts::TAU;

/// A cable of GJ (N m^2), EI (N m^2) and EA (N), without weight, twisted by a number of turns.
fn rope([from, to]: [Vector3<f64>; 2], [twist, bend, stretch]: [f64; 3], turns: f64) -> CableBuilder {
    let torsion = Torsion { initial_twist: turns, ..Torsion::new(twist) };
    Cable::builder()
        .points([from, to])
        .section(Section::from_stiffness(stretch, bend, 0.01).unwrap())
        .elements(8)
        .gravity(Vector3::zeros())
        .effects(Effects { torsion: Some(torsion), ..Effects::default() })
}

/// A body of a mass (kg) and a moment of inertia (kg m^2) at a point.
fn body(world: &mut PhysicsWorld, at: Vector3<f64>, mass: f64, inertia: f64) -> RigidBodyHandle {
    let place = Vector::new(at.x as f32, at.y as f32, at.z as f32);
    let own = MassProperties::new(Vector::ZERO, mass as f32, Vector::splat(inertia as f32));
    world.insert_body(RigidBodyBuilder::dynamic().translation(place).can_sleep(false).additional_mass_properties(own))
}

fn turned(world: &PhysicsWorld, body: RigidBodyHandle) -> f64 {
    vector(world.bodies[body].rotation().to_scaled_axis()).y
}

/// A bar between two twisted vertical cables turns to where their torques are equal, stays there, and its attachments read that torque.
///
/// *Source.* Two torsion springs: K1 (2 pi n - a) = K2 a with K = GJ/L.
#[test]
fn a_bar_between_two_cables_turns_to_equal_torque() {
    for (turns, above, below, length) in [(0.25, 0.05, 0.02, 1.0), (-0.4, 0.02, 0.2, 1.7), (2.3, 0.03, 0.03, 0.6)] {
        let mut world = PhysicsWorld::new();
        // its weight would buckle the lower one
        world.gravity = Vector::ZERO;
        let bar = body(&mut world, down(1.0), 5.0, 0.05);
        let mut set = CableSet::new();
        let upper = rope([Vector3::zeros(), down(1.0)], [above, 0.05, 1e5], turns).clamp(At::Start).build().unwrap();
        let lower = [down(1.0), down(1.0 + length)];
        let lower = rope(lower, [below, 0.05, 1e5], 0.0).clamp(At::End).build().unwrap();
        let (upper, lower) = (set.insert(upper), set.insert(lower));
        let up = set.attach(&world, upper, At::End, bar, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        set.attach(&world, lower, At::Start, bar, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        let found = set.equilibrium(&mut world).unwrap();
        let stiffness = [above, below / length];
        let angle = TAU * turns * stiffness[0] / (stiffness[0] + stiffness[1]);
        let torque = stiffness[1] * angle;
        let twists = [upper, lower].map(|cable| set.get(cable).unwrap().torsion()[0]);
        println!("{turns}: {twists:?}, {angle}, {:?}", found.cables[0].1);
        assert!(found.is_stable());
        for reading in twists {
            assert!((reading.torque / torque - 1.0).abs() < 1e-6, "{reading:?} {torque}");
        }
        let moment = set.attachment(up).unwrap().reading().moment;
        assert!((moment.norm() / torque.abs() - 1.0).abs() < 1e-6, "{moment:?} {torque}");
        // it turns back the twist of the upper cable, which points down
        let off = (turned(&world, bar) - angle) / TAU;
        assert!((off - off.round()).abs() < 1e-6, "{off}");
        let moved = moves(&mut world, &mut set, bar);
        println!("moves by {moved:e}");
        let stays = (turned(&world, bar) - angle) / TAU - off;
        assert!(moved < 1e-6 && stays.abs() < 1e-6, "{moved:e} {stays:e}");
    }
}

/// A column between a clamp and a body that cannot turn is stable below Greenhill's torque, and above it is reported as unstable: the number of
/// negative eigenvalues is that with the stiffness of the whole segment.
///
/// *Source.* The characteristic equation of the clamped rod (Greenhill 1883): 8.98682 EI/L without an axial force.
#[test]
fn a_column_with_a_body_at_its_end_is_stable_up_to_greenhills_torque() {
    for (share, straight) in [(0.5, true), (0.99, true), (1.01, false), (1.2, false)] {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let end = body(&mut world, down(1.0), 1.0, 0.01);
        let free = LockedAxes::all() ^ LockedAxes::TRANSLATION_LOCKED_Y;
        world.bodies[end].set_locked_axes(free, true);
        let mut set = CableSet::new();
        let turns = 8.98682 * share / TAU;
        let column = rope([Vector3::zeros(), down(1.0)], [1.0, 1.0, 1e5], turns).elements(16).clamp(At::Start);
        let column = set.insert(column.build().unwrap());
        set.attach(&world, column, At::End, end, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        let found = set.equilibrium(&mut world).unwrap();
        println!("{share}: {:?}", found.cables[0].1);
        assert_eq!(found.is_stable(), straight, "{share}");
    }
}

/// A hook on a stranded rope turns until the rope has no torque.
///
/// *Source.* k T L/GJ with k = c d and the tension T of its weight, T and GJ by hand (Green's law: the weight over the stretch).
#[test]
fn a_hook_on_a_stranded_rope_turns_until_it_has_no_torque() {
    let (stiffness, factor, mass) = (0.5, 0.1 * 0.01, 10.0);
    let mut world = PhysicsWorld::new();
    let hook = body(&mut world, down(1.0), mass, 0.05);
    let mut set = CableSet::new();
    let effects = Effects { torsion: Some(Torsion::stranded(stiffness, 0.1, 0.01)), ..Effects::default() };
    let own = rope([Vector3::zeros(), down(1.0)], [stiffness, 0.6, 1e5], 0.0).effects(effects).clamp(At::Start);
    let cable = set.insert(own.build().unwrap());
    set.attach(&world, cable, At::End, hook, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    set.equilibrium(&mut world).unwrap();
    let end = set.get(cable).unwrap().node_position(8);
    let exact = -factor * G * mass / -end.y / stiffness;
    let reading = set.get(cable).unwrap().torsion()[0];
    println!("{reading:?} {exact}");
    assert!((reading.twist / exact - 1.0).abs() < 1e-6, "{reading:?} {exact}");
    assert!(reading.torque.abs() < 1e-8, "{reading:?}");
    assert!((turned(&world, hook) + exact).abs() < 1e-6, "{} {exact}", turned(&world, hook));
    assert!(moves(&mut world, &mut set, hook) < 1e-6);
}

/// A bar on two parallel twisted ropes turns until its weight balances their torques, and rises.
///
/// *Source.* The bifilar suspension: 2 K (2 pi n - a) = m g b^2 sin(a)/h, h^2 = L^2 - 4 b^2 sin^2(a/2), 2 b between the ropes; their bending at
/// both clamps shortens L by 2 sqrt(EI/T).
#[test]
fn a_bar_on_two_twisted_ropes_turns_as_a_bifilar_suspension() {
    let (b, mass, stiffness, length, bend) = (0.2, 10.0, 1.0, 2.0, 0.03);
    let layer = f64::sqrt(bend / (0.5 * mass * G));
    for turns in [0.1, -0.5] {
        let mut world = PhysicsWorld::new();
        let bar = body(&mut world, down(length), mass, 0.1);
        let mut set = CableSet::new();
        for x in [-b, b] {
            let side = Vector3::x() * x;
            let own = rope([side, side + down(length)], [stiffness, bend, 1e7], turns).elements(80).clamp(At::Start);
            let cable = set.insert(own.build().unwrap());
            set.attach(&world, cable, At::End, bar, Vector::new(x as f32, 0.0, 0.0), AttachmentKind::Clamp).unwrap();
        }
        set.equilibrium(&mut world).unwrap();
        let short = length - 2.0 * layer;
        let height = |a: f64| (short * short - 4.0 * b * b * (0.5 * a).sin().powi(2)).sqrt();
        let excess =
            |a: f64| 2.0 * stiffness / length * (TAU * turns.abs() - a) - mass * G * b * b * a.sin() / height(a);
        let (mut low, mut high) = (0.0, 1.5);
        for _ in 0..60 {
            let a = 0.5 * (low + high);
            if excess(a) > 0.0 { low = a } else { high = a }
        }
        let angle = turned(&world, bar) * f64::signum(turns);
        let y = vector(world.bodies[bar].translation()).y;
        let sag = 0.5 * mass * G * length / 1e7;
        let rises = y + length + sag - (short - height(low));
        println!("{turns}: {angle} {low}, {y}, {rises}");
        assert!((angle / low - 1.0).abs() < 5e-3, "{angle} {low}");
        assert!(rises.abs() < 0.02 * (y + length), "{y} {rises}");
        assert!(moves(&mut world, &mut set, bar) < 1e-6);
    }
}
