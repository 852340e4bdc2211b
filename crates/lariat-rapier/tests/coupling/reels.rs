//! Winches in a world.

use super::common::{add_cube, cable, run};
use lariat_rapier::lariat_ancf::{At, Damping, Reel, Section};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

fn section() -> Section {
    Section::from_stiffness(1e5, 0.05, 0.3).unwrap()
}

/// A crate of 20 kg hangs from a reel on a fixed or kinematic body, which takes in and pays out over several elements: the crate follows,
/// the attachments at eye and hook stay, and the cable sleeps only while the reel stands.
///
/// *Source.* The height of the crate is that of the eye less what is out and its stretch, 20 kg g L/EA.
#[test]
fn a_reel_on_a_fixed_or_moving_body_lifts_its_load() {
    for kinematic in [false, true] {
        let mut world = PhysicsWorld::new();
        let load = add_cube(&mut world, 20.0, 0.1, [0.0, -2.1, 0.0]);
        let winch = if kinematic {
            RigidBodyBuilder::kinematic_velocity_based().linvel(Vector::new(0.0, 0.1, 0.0))
        } else {
            RigidBodyBuilder::fixed()
        };
        let winch = world.insert_body(winch);
        let mut set = CableSet::new();
        let rope = cable([0.0, -2.0, 0.0], [0.0; 3], section()).damping(Damping { axial: 0.01, bending: 0.01 });
        let rope = set.insert(rope.build().unwrap());
        let hook = set.attach(&world, rope, At::Start, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        let eye = set.attach(&world, rope, At::End, winch, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.get_mut(rope).unwrap().add_reel(At::End, Reel::default()).unwrap();
        let mut seconds = 0.0;
        for (rate, steps) in [(0.0, 60), (-0.4, 180), (0.4, 120), (0.0, 240)] {
            set.get_mut(rope).unwrap().set_reel_rate(At::End, rate).unwrap();
            run(&mut world, &mut set, steps);
            seconds += f64::from(steps as u32) / 60.0;
        }
        let reel = set.get(rope).unwrap().reel(At::End).unwrap();
        assert!(reel.merges >= 3 && reel.splits >= 2 && reel.rate == 0.0, "{reel:?}");
        let top = if kinematic { 0.1 * seconds } else { 0.0 };
        let stretch = 20.0 * 9.81 * reel.length_out / 1e5;
        let height = f64::from(world.bodies[load].translation().y) + 0.1;
        assert!((height - (top - reel.length_out - stretch)).abs() < 4e-3, "{height} m, {top} {reel:?}");
        let at = set.attachment(eye).unwrap();
        assert_eq!(at.node() + 1, set.get(rope).unwrap().nodes());
        assert!((at.arc_length() - reel.length_out).abs() < 1e-9 && at.gap() < 1e-5, "{at:?}");
        assert!(set.attachment(hook).unwrap().gap() < 1e-5);
        let pull = -set.attachment(hook).unwrap().force().y;
        assert!((reel.tension - (20.0 + 0.3 * reel.length_out) * 9.81).abs() < 8.0 && pull < 0.0, "{reel:?} {pull}");
    }
}

/// The eye on a body that the cable moves is refused by name, because the stock's momentum is not accounted for.
#[test]
fn a_reel_on_a_free_body_is_refused_by_name() {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 20.0, 0.1, [0.0, 0.1, 0.0]);
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0, -2.0, 0.0], [0.0; 3], section()).build().unwrap());
    set.attach(&world, rope, At::End, load, Vector::new(0.0, -0.1, 0.0), AttachmentKind::Ball).unwrap();
    set.get_mut(rope).unwrap().add_reel(At::End, Reel::default()).unwrap();
    let refused = set.step(&mut world).unwrap_err().to_string();
    assert!(refused.contains("moves freely"), "{refused}");
}
