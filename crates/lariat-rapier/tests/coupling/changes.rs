//! What users do to bodies in the middle of a run: the cable goes on.

use super::bench::{add_cube, cable, gap, run, soft, v};
use lariat_rapier::lariat_ancf::At;
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet, Event};

struct Hung {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    rope: CableHandle,
    held: AttachmentHandle,
}

/// 5 kg swinging on a cable, after half a second.
fn hung() -> Hung {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 5.0, 0.1, [2.0, -0.1, 0.0]);
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [2.0, 0.0, 0.0], soft()).fix(At::Start).build().unwrap());
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
                assert!(v(b.translation()).iter().chain(v(b.linvel()).iter()).all(|x| x.is_finite()));
            }
        }
    }

    fn end(&self) -> ::nalgebra::Vector3<f64> {
        self.set.get(self.rope).unwrap().node_position(10)
    }

    fn anchor(&self) -> ::nalgebra::Vector3<f64> {
        v(*self.world.bodies[self.load].position() * Vector::new(0.0, 0.1, 0.0))
    }
}

/// A body that is removed: one event, the attachment gone, no ledger left, the end free.
///
/// *Source.* The contract; the cable alone conserves its energy.
#[test]
fn a_removed_body_lets_the_cable_go() {
    let mut h = hung();
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

/// A body that is removed while it swings against a wall: its ledger goes with it.
///
/// *Source.* The contract: one body, the wall, is left.
#[test]
fn a_body_removed_in_contact_takes_its_ledger_along() {
    let mut h = hung();
    let at = h.world.bodies[h.load].translation();
    let wall = RigidBodyBuilder::fixed().translation(at - Vector::new(0.32, 0.0, 0.0));
    h.world.insert(wall, ColliderBuilder::cuboid(0.1, 2.0, 1.0));
    h.run(30);
    assert_eq!(h.world.bodies.len(), 3, "the load, the wall and a ledger");
    h.world.remove_body(h.load);
    h.run(30);
    assert_eq!(h.world.bodies.len(), 1);
}

/// A disabled body holds the cable's end where it is; enabled, it swings on.
///
/// *Source.* A disabled body does not move; the end is on its anchor.
#[test]
fn a_disabled_body_holds_the_end_where_it_is() {
    let mut h = hung();
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

/// A swinging body becomes fixed or kinematic, and dynamic again: the end stays on it, and the run goes on.
///
/// *Source.* The contract.
#[test]
fn a_body_may_change_its_type() {
    let mut h = hung();
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

/// A body that is put elsewhere takes its end along at 10 m/s at most: 0.1 m of slack, or half a metre of stretch.
///
/// *Source.* The contract.
#[test]
fn a_teleported_body_takes_its_end_along() {
    for jump in [0.1, 0.5] {
        let mut h = hung();
        let to = h.world.bodies[h.load].translation() - Vector::new(jump, 0.0, 0.0);
        h.world.bodies[h.load].set_translation(to, true);
        h.run((60.0 * f64::from(jump) / 6.6).ceil() as usize);
        assert!(gap(&h.set) < 1e-3, "{jump} m: {:.1e} m", gap(&h.set));
        h.run(60);
        assert!(gap(&h.set) < 1e-3, "{jump} m: {:.1e} m", gap(&h.set));
    }
}

/// Wrong handles.
///
/// *Source.* The contract: typed errors, nothing changed.
#[test]
fn wrong_handles_are_refused() {
    let mut h = hung();
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
