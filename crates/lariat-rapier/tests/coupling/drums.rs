//! Drums in a world.

use super::common::{add_cube, cable, run};
use lariat_rapier::lariat_ancf::{At, Damping, Error as Mechanics, Reel, Section};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Drum, Error};

const G: f64 = 9.81;
const RADIUS: f64 = 0.2;

/// Adds a drum about z, of this inertia in kg m^2.
fn drum(world: &mut PhysicsWorld, inertia: Real, locked: bool) -> RigidBodyHandle {
    let own = MassProperties::new(Vector::ZERO, 4.0, Vector::new(inertia, inertia, inertia));
    let builder =
        RigidBodyBuilder::dynamic().translation(Vector::new(RADIUS as Real, 0.0, 0.0)).additional_mass_properties(own);
    let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Y;
    world.insert_body(if locked { builder.locked_axes(axes) } else { builder })
}

/// Hangs a crate of a mass in kg on a rope from a point of a body, over a drum.
fn hoist(
    set: &mut CableSet,
    world: &mut PhysicsWorld,
    mass: Real,
    (holder, winch): (RigidBodyHandle, RigidBodyHandle),
) -> (CableHandle, RigidBodyHandle) {
    let load = add_cube(world, mass, 0.1, [0.0, -1.6, 0.0]);
    let section = Section::from_stiffness(1e5, 1e-3, 0.1).unwrap();
    let rope = cable([0.0, -1.5, 0.0], [0.0; 3], section).elements(6).damping(Damping { axial: 5e-3, bending: 5e-3 });
    let rope = set.insert(rope.build().unwrap());
    set.attach(world, rope, At::Start, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    set.attach_here(world, rope, At::End, holder, AttachmentKind::Ball).unwrap();
    let drum = Drum { body: winch, axis: Vector::new(0.0, 0.0, 3.0), radius: RADIUS as Real };
    set.add_drum(&world.bodies, (rope, At::End), drum, Reel { stock: Some(6.0), ..Reel::default() }).unwrap();
    (rope, load)
}

/// A crate turns a drum on locked axes or on a joint to a fixed body, free or against a torque that hoists it: crate and drum move as the
/// equation says. A removed drum leaves the rope as long as it is.
///
/// *Source.* `(J/R^2 + rho S + m) a = g (rho L + m) + M/R`, L as at the start; the rope weighs 1 % of the crate at most.
#[test]
fn a_crate_and_a_drum_move_as_their_equation_says() {
    for (mass, inertia, torque, locked) in
        [(5.0, 0.1, 0.0, true), (20.0, 0.5, 0.0, false), (8.0, 0.3, -25.0, true), (30.0, 2.0, -100.0, false)]
    {
        let mut world = PhysicsWorld::new();
        let mut set = CableSet::new();
        let ground = world.insert_body(RigidBodyBuilder::fixed());
        let winch = drum(&mut world, inertia, locked);
        if !locked {
            let joint = RevoluteJointBuilder::new(Vector::Z).local_anchor1(Vector::new(RADIUS as Real, 0.0, 0.0));
            world.insert_impulse_joint(ground, winch, joint);
        }
        let (rope, load) = hoist(&mut set, &mut world, mass, (ground, winch));
        world.bodies[winch].add_torque(Vector::new(0.0, 0.0, torque), true);
        let steps = 30;
        run(&mut world, &mut set, steps);
        let time = f64::from(steps as u32) / 60.0;
        let (mass, inertia, torque) = (f64::from(mass), f64::from(inertia), f64::from(torque));
        let moved = inertia / (RADIUS * RADIUS) + 0.1 * 6.0 + mass;
        let speed = (G * (0.15 + mass) + torque / RADIUS) / moved * time;
        let fall = -f64::from(world.bodies[load].linvel().y);
        let spin = f64::from(world.bodies[winch].angvel().z) * RADIUS;
        let reel = set.get(rope).unwrap().reel(At::End).unwrap();
        println!("{fall} and {spin} of {speed} m/s, {reel:?}");
        assert!((fall / speed - 1.0).abs() < 0.02 && (spin / speed - 1.0).abs() < 0.02, "{fall} {spin} {speed}");
        assert_eq!(set.drums().count(), 1);
        world.remove_body(winch);
        run(&mut world, &mut set, 2);
        assert!(set.drums().next().is_none() && set.get(rope).unwrap().reel(At::End).is_none());
    }
}

/// A drum on a joint of a dynamic body is refused by name in a step, since the cable does not know their common inertia.
#[test]
fn a_drum_on_a_joint_of_a_dynamic_body_is_refused_by_name() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let boat = add_cube(&mut world, 40.0, 0.4, [0.0, 0.4, 0.0]);
    let winch = drum(&mut world, 0.2, false);
    let joint = RevoluteJointBuilder::new(Vector::Z).local_anchor1(Vector::new(RADIUS as Real, -0.4, 0.0));
    world.insert_impulse_joint(boat, winch, joint);
    hoist(&mut set, &mut world, 10.0, (boat, winch));
    let outcome = set.step(&mut world);
    assert!(
        matches!(&outcome, Err(Error::StepRefused { cause, .. }) if **cause == Error::DrumJoined(winch)),
        "{outcome:?}"
    );
}

/// A drum that is not dynamic, not there, or holds the end on it itself is refused by name.
#[test]
fn what_is_no_drum_is_refused_by_name() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    let winch = drum(&mut world, 0.1, true);
    let (rope, _) = hoist(&mut set, &mut world, 1.0, (ground, winch));
    let of = |body, radius| Drum { body, axis: Vector::Z, radius };
    let again = set.add_drum(&world.bodies, (rope, At::End), of(winch, 0.1), Reel::default());
    assert!(matches!(again, Err(Error::Cable(Mechanics::ReelPlace { .. }))), "{again:?}");
    let fixed = set.add_drum(&world.bodies, (rope, At::Start), of(ground, 0.1), Reel::default());
    assert_eq!(fixed, Err(Error::DrumBody(ground)));
    let removed = set.remove_drum(rope, At::End).unwrap();
    assert!(removed.is_some_and(|drum| drum.body == winch) && set.remove_drum(rope, At::End).unwrap().is_none());
    let limited = Reel { max_force: Some(3.0), ..Reel::default() };
    let limited = set.add_drum(&world.bodies, (rope, At::End), of(winch, 0.1), limited);
    assert!(matches!(limited, Err(Error::Cable(Mechanics::InvalidValue { .. }))), "{limited:?}");
    assert!(set.drums().next().is_none() && set.get(rope).unwrap().reel(At::End).is_none());
}

/// A rope on a drum that is locked in its rotation is in equilibrium as one that is tied where it
/// leaves, and stays there; on one that is free to turn it is refused.
///
/// *Source.* A drum that does not turn gives no rope: the boundary conditions are the same. The pull
/// of a weight on a free one has nothing that balances it.
#[test]
fn a_drum_that_cannot_turn_is_a_fixed_end_in_statics() {
    let mut ends = Vec::new();
    for on_drum in [true, false] {
        let mut world = PhysicsWorld::new();
        let mut set = CableSet::new();
        let ground = world.insert_body(RigidBodyBuilder::fixed());
        let winch = drum(&mut world, 0.2, true);
        let (rope, load) = hoist(&mut set, &mut world, 10.0, (ground, winch));
        if on_drum {
            let outcome = set.equilibrium(&mut world);
            assert!(matches!(outcome, Err(Error::Cable(Mechanics::ReelPlace { .. }))), "{outcome:?}");
            world.bodies[winch].set_locked_axes(LockedAxes::all(), true);
        } else {
            set.remove_drum(rope, At::End).unwrap();
        }
        set.equilibrium(&mut world).unwrap();
        let rest = set.get(rope).unwrap().positions().to_vec();
        run(&mut world, &mut set, 60);
        let now = set.get(rope).unwrap().positions().to_vec();
        let moved = rest.iter().zip(&now).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(moved < 1e-6, "{moved} m in a second");
        ends.push((rest, world.bodies[load].translation().y));
    }
    let apart = ends[0].0.iter().zip(&ends[1].0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-8 && (ends[0].1 - ends[1].1).abs() < 1e-6, "{apart} m");
}
