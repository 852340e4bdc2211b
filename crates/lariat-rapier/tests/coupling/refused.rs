//! Islands that cannot step: they keep their state, and everything else goes on.

use super::common::{add_cube, cable, run, soft};
use lariat_rapier::lariat_ancf::{At, PointLoad, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Error, Gap};

/// Adds a load of 5 kg on 2 m of cable, released from horizontal, at z (m).
fn add_pendulum(world: &mut PhysicsWorld, set: &mut CableSet, z: f64, name: &str) -> (CableHandle, RigidBodyHandle) {
    let load = add_cube(world, 5.0, 0.1, [2.0, -0.1, z as Real]);
    let rope = cable([0.0, 0.0, z], [2.0, 0.0, z], soft()).name(name).fix(At::Start).build().unwrap();
    let rope = set.insert(rope);
    set.attach(world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    (rope, load)
}

/// Returns coordinates and clock of a cable, and the state of a body, to the bit.
fn state(world: &PhysicsWorld, set: &CableSet, (rope, load): (CableHandle, RigidBodyHandle)) -> (Vec<u64>, Vec<u64>) {
    let (rope, load) = (set.get(rope).unwrap(), &world.bodies[load]);
    let cable = rope.positions().iter().chain(rope.velocities()).chain([&rope.time()]).map(|x| x.to_bits()).collect();
    let body = [load.translation(), load.linvel(), load.angvel()].into_iter().flat_map(|v| v.to_array());
    (cable, body.chain(load.rotation().to_array()).map(|x| f64::from(x).to_bits()).collect())
}

/// One of two pendulums has an infinite force for ten host steps: it keeps its state to the bit, the
/// other moves as it does alone, and the error names the one. Without the force it goes on.
///
/// Reference: a run of the other pendulum alone, to the bit.
#[test]
fn a_refused_step_concerns_its_island_alone() {
    let (mut alone, mut set_alone) = (PhysicsWorld::new(), CableSet::new());
    let reference = add_pendulum(&mut alone, &mut set_alone, 1.0, "good");
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    let good = add_pendulum(&mut world, &mut set, 1.0, "good");
    let bad = add_pendulum(&mut world, &mut set, -1.0, "bad");
    run(&mut alone, &mut set_alone, 20);
    run(&mut world, &mut set, 20);
    world.bodies[bad.1].add_force(Vector::new(0.0, Real::INFINITY, 0.0), true);
    let before = state(&world, &set, bad);
    for _ in 0..10 {
        let error = set.step(&mut world).unwrap_err();
        assert_eq!(set.failures().len(), 1);
        assert_eq!(set.failures()[0].cables, [bad.0]);
        let Error::StepRefused { cables, cause, .. } = error else { panic!("{error}") };
        assert!(cables == ["bad"] && matches!(*cause, Error::BodyNotFinite { .. }), "{cause}");
        set_alone.step(&mut alone).unwrap();
        assert!(state(&world, &set, bad) == before);
        assert!(state(&world, &set, good) == state(&alone, &set_alone, reference));
    }
    world.bodies[bad.1].reset_forces(true);
    run(&mut world, &mut set, 20);
    assert!(set.failures().is_empty());
    assert!(state(&world, &set, bad) != before);
    let times = [bad, good].map(|(rope, _)| set.get(rope).unwrap().time());
    assert!((times[0] - 40.0 / 60.0).abs() < 1e-5 && (times[1] - 50.0 / 60.0).abs() < 1e-5, "{times:?}");
    // the two clocks are aligned when the cables become one island
    set.join_with_gap((bad.0, 1.0), (good.0, 1.0), Gap::Close).unwrap();
    run(&mut world, &mut set, 5);
    assert_eq!(set.get(bad.0).unwrap().time(), set.get(good.0).unwrap().time());
}

/// Two cables that are tied to each other are one island: the error names both.
#[test]
fn the_error_names_all_cables_of_the_island() {
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    let [a, b] = [-1.0, 1.0].map(|z| add_pendulum(&mut world, &mut set, z, if z < 0.0 { "left" } else { "right" }));
    let middle = cable([1.0, 0.0, -1.0], [1.0, 0.0, 1.0], soft()).name("middle").build().unwrap();
    let middle = set.insert(middle);
    set.join((a.0, At::ArcLength(1.0)), (middle, At::Start)).unwrap();
    set.join((b.0, At::ArcLength(1.0)), (middle, At::End)).unwrap();
    run(&mut world, &mut set, 5);
    let load = PointLoad::force(1.0, Vector3::new(0.0, 1e300, 0.0));
    set.get_mut(middle).unwrap().add_load(load).unwrap();
    let before = [a, b].map(|pendulum| state(&world, &set, pendulum));
    let Err(Error::StepRefused { mut cables, .. }) = set.step(&mut world) else { panic!("it steps") };
    cables.sort();
    assert_eq!(cables, ["left", "middle", "right"]);
    assert!(before == [a, b].map(|pendulum| state(&world, &set, pendulum)));
}

/// A box, lighter or much heavier, falls onto a body that stands still in the air because its cable cannot step, and comes to
/// rest on it.
#[test]
fn a_body_that_cannot_step_is_an_obstacle_for_others() {
    [1.0, 200.0].into_iter().for_each(fall_on_refused);
}

fn fall_on_refused(mass: Real) {
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    let bad = add_pendulum(&mut world, &mut set, 0.0, "bad");
    run(&mut world, &mut set, 10);
    let load = PointLoad::force(1.0, Vector3::new(0.0, 1e300, 0.0));
    set.get_mut(bad.0).unwrap().add_load(load).unwrap();
    let before = state(&world, &set, bad);
    let (at, top) = (
        world.bodies[bad.1].translation(),
        world.bodies[bad.1].translation().y + (0.1 * core::f64::consts::SQRT_2) as Real,
    );
    let above = add_cube(&mut world, mass, 0.2, [at.x, at.y + 0.6, at.z]);
    for _ in 0..90 {
        set.step(&mut world).unwrap_err();
        assert!(state(&world, &set, bad) == before);
        // Rapier lets touching bodies overlap by a few millimetres
        assert!(world.bodies[above].translation().y > at.y + 0.25, "{}", world.bodies[above].translation());
    }
    assert!(world.bodies[above].translation().y < top + 0.25, "{}", world.bodies[above].translation());
}

/// A cable on the last link of a multibody cannot step: all links keep their states.
#[test]
fn a_multibody_on_a_cable_that_cannot_step_keeps_its_state() {
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    let base = world.insert_body(RigidBodyBuilder::fixed());
    let links = [1.0, 2.0].map(|x| add_cube(&mut world, 2.0, 0.1, [x, 0.0, 0.0]));
    for (parent, link) in [(base, links[0]), (links[0], links[1])] {
        let joint = RevoluteJointBuilder::new(Vector::Z).local_anchor1(Vector::X * 0.5).local_anchor2(Vector::X * -0.5);
        world.insert_multibody_joint(parent, link, joint).unwrap();
    }
    let rope = cable([2.0, 0.0, 0.0], [2.0, -1.0, 0.0], soft()).name("bad").build().unwrap();
    let rope = set.insert(rope);
    set.attach(&world, rope, At::Start, links[1], Vector::ZERO, AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 10);
    let load = PointLoad::force(1.0, Vector3::new(0.0, 1e300, 0.0));
    set.get_mut(rope).unwrap().add_load(load).unwrap();
    let all = |world: &PhysicsWorld, set: &CableSet| links.map(|link| state(world, set, (rope, link)));
    let before = all(&world, &set);
    for _ in 0..5 {
        set.step(&mut world).unwrap_err();
        assert!(all(&world, &set) == before);
    }
    set.get_mut(rope).unwrap().clear_loads();
    run(&mut world, &mut set, 20);
    assert!(world.bodies[links[1]].translation().y < -0.2);
}

/// A body whose position is not a number keeps it, with its velocities, and goes on when it is set
/// right.
#[test]
fn a_body_without_a_position_keeps_its_velocities() {
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    let bad = add_pendulum(&mut world, &mut set, 0.0, "bad");
    run(&mut world, &mut set, 20);
    let at = world.bodies[bad.1].translation();
    world.bodies[bad.1].set_translation(Vector::new(Real::NAN, 0.0, 0.0), true);
    let before = state(&world, &set, bad);
    for _ in 0..5 {
        set.step(&mut world).unwrap_err();
        assert!(state(&world, &set, bad) == before);
    }
    world.bodies[bad.1].set_translation(at, true);
    run(&mut world, &mut set, 20);
    assert!(world.bodies[bad.1].is_enabled());
}
