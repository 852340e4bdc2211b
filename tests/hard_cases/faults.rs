//! Faults put in on purpose: the last good state stays, the error names the culprit, and the next
//! step works when the cause is gone.

use lariat_ancf::{At, PointLoad, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, BodyQuantity, CableHandle, CableSet, Error, lariat_ancf};

struct Hung {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    rope: CableHandle,
}

/// 5 kg on 2 m of rope called "sling", let go from horizontal, after half a second.
fn hung() -> Hung {
    let mut world = PhysicsWorld::new();
    let body = RigidBodyBuilder::dynamic().translation(Vector::new(2.0, 0.0, 0.0));
    let (load, _) = world.insert(body, ColliderBuilder::ball(0.1).mass(5.0));
    let mut set = CableSet::new();
    let rope = lariat_ancf::Cable::builder()
        .name("sling")
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1e9, 4000.0).unwrap())
        .fix(At::Start)
        .build()
        .unwrap();
    let rope = set.insert(rope);
    set.attach(&world, rope, At::End, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
    let mut h = Hung { world, set, load, rope };
    h.run(30);
    h
}

impl Hung {
    fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            self.set.step(&mut self.world).unwrap();
            assert!(self.state().iter().all(|x| x.is_finite()));
        }
    }

    /// Everything of the cable.
    fn state(&self) -> Vec<f64> {
        let cable = self.set.get(self.rope).unwrap();
        let mut all = cable.positions().to_vec();
        all.extend_from_slice(cable.velocities());
        all.push(cable.time());
        all
    }

    /// A step that must be refused: the cable as before to the bit, all finite.
    fn refused(&mut self) -> Error {
        let before = self.state();
        let error = self.set.step(&mut self.world).expect_err("an impossible step");
        assert_eq!(self.state(), before, "{error}");
        error
    }

    /// The cause is gone: half a second more, and the load is still on its rope.
    fn goes_on(&mut self) {
        self.run(30);
        let gap = self.set.attachments().map(|(_, a)| a.gap()).fold(0.0, f64::max);
        let place = self.world.bodies[self.load].translation();
        assert!(gap < 1e-3 && place.is_finite() && place.length() < 2.2, "{gap:.1e} m, {place}");
    }
}

/// A velocity or a spin that is not a number: the error names the body and what is wrong; set
/// right, the run goes on.
///
/// *Source.* The contract.
#[test]
fn a_velocity_that_is_not_a_number_is_refused_by_name() {
    for (bad, spins) in [(f32::NAN, false), (f32::INFINITY, false), (f32::NAN, true)] {
        let mut h = hung();
        let (v, w) = (h.world.bodies[h.load].linvel(), h.world.bodies[h.load].angvel());
        let wrong = Vector::new(bad, 0.0, 0.0);
        if spins {
            h.world.bodies[h.load].set_angvel(wrong, true);
        } else {
            h.world.bodies[h.load].set_linvel(wrong, true);
        }
        let error = h.refused();
        assert!(
            matches!(error, Error::BodyNotFinite { body, quantity: BodyQuantity::Velocity, .. } if body == h.load),
            "{error}"
        );
        h.world.bodies[h.load].set_linvel(v, true);
        h.world.bodies[h.load].set_angvel(w, true);
        h.goes_on();
    }
}

/// A force or a torque that is not finite: as above.
///
/// *Source.* The contract.
#[test]
fn an_infinite_force_is_refused_by_name() {
    for torque in [false, true] {
        let mut h = hung();
        let wrong = Vector::new(0.0, f32::INFINITY, 0.0);
        if torque {
            h.world.bodies[h.load].add_torque(wrong, true);
        } else {
            h.world.bodies[h.load].add_force(wrong, true);
        }
        let error = h.refused();
        assert!(
            matches!(error, Error::BodyNotFinite { body, quantity: BodyQuantity::Force, .. } if body == h.load),
            "{error}"
        );
        h.world.bodies[h.load].reset_forces(true);
        h.world.bodies[h.load].reset_torques(true);
        h.goes_on();
    }
}

/// A body without mass cannot be integrated: it holds its end, as a fixed one does, and takes the
/// load again with its mass.
///
/// *Source.* Rapier does not move a dynamic body without mass by forces.
#[test]
fn a_body_that_loses_its_mass_holds_its_end() {
    let mut h = hung();
    let collider = h.world.bodies[h.load].colliders()[0];
    h.world.colliders[collider].set_mass(0.0);
    h.world.bodies[h.load].set_linvel(Vector::ZERO, true);
    h.run(30);
    h.world.colliders[collider].set_mass(5.0);
    h.goes_on();
}

/// A load on the cable that no step can carry, in the middle of the run: the error names the cable
/// and the time.
///
/// *Source.* The contract. 1e300 N overflows.
#[test]
fn an_impossible_load_is_refused_and_the_next_step_works_without_it() {
    let mut h = hung();
    let load = PointLoad::force(1.0, Vector3::new(0.0, 1e300, 0.0));
    h.set.get_mut(h.rope).unwrap().add_load(load).unwrap();
    let error = h.refused().to_string();
    assert!(error.contains("sling") && error.contains("t = "), "{error}");
    h.set.get_mut(h.rope).unwrap().clear_loads();
    h.goes_on();
}

/// A place that is not a number, and a step of the world that is not: refused; set right, the run
/// goes on.
///
/// *Source.* The contract.
#[test]
fn places_and_time_steps_that_are_not_numbers_are_refused() {
    let mut h = hung();
    let at = h.world.bodies[h.load].translation();
    h.world.bodies[h.load].set_translation(Vector::new(f32::NAN, 0.0, 0.0), true);
    let error = h.refused();
    assert!(matches!(error, Error::BodyNotFinite { quantity: BodyQuantity::Position, .. }), "{error}");
    h.world.bodies[h.load].set_translation(at, true);
    h.goes_on();
    let dt = h.world.integration_parameters.dt;
    for wrong in [f32::NAN, -1.0, f32::INFINITY] {
        h.world.integration_parameters.dt = wrong;
        let error = h.refused();
        assert!(matches!(error, Error::TimeStep { .. }), "{error}");
    }
    h.world.integration_parameters.dt = dt;
    h.goes_on();
}

/// Gravity that is not a number, or infinite: refused.
///
/// *Source.* The contract.
#[test]
fn gravity_that_is_not_a_number_is_refused() {
    for wrong in [f32::NAN, f32::INFINITY] {
        let mut h = hung();
        let gravity = h.world.gravity;
        h.world.gravity = Vector::new(0.0, wrong, 0.0);
        h.refused();
        h.world.gravity = gravity;
        h.goes_on();
    }
}
