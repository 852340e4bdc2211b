//! Invalid input in the middle of a run: the step ends in an error that names the culprit, the
//! state remains bitwise what it was, and the next step works once the cause is removed.

use lariat_ancf::{At, PointLoad, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, BodyQuantity, CableHandle, CableSet, Error, lariat_ancf};

struct Pendulum {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
    rope: CableHandle,
}

/// 5 kg on 2 m of rope called "sling", released from horizontal, after half a second.
fn pendulum() -> Pendulum {
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
    let mut p = Pendulum { world, set, load, rope };
    p.run(30);
    p
}

impl Pendulum {
    fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            self.set.step(&mut self.world).unwrap();
            let cable = self.set.get(self.rope).unwrap();
            assert!(cable.positions().iter().chain(cable.velocities()).all(|x| x.is_finite()));
        }
    }

    /// Every number of cable and body, to the bit.
    fn state(&self) -> (Vec<u64>, Vec<u32>) {
        let cable = self.set.get(self.rope).unwrap();
        let numbers =
            cable.positions().iter().chain(cable.velocities()).copied().chain([cable.time()]).map(f64::to_bits);
        let body = &self.world.bodies[self.load];
        let (x, r, v, w) = (body.translation(), body.rotation(), body.linvel(), body.angvel());
        let body = [x.x, x.y, x.z, r.x, r.y, r.z, r.w, v.x, v.y, v.z, w.x, w.y, w.z];
        (numbers.collect(), body.map(f32::to_bits).to_vec())
    }

    /// Does a step that must end in an error and leave the state as it was, and returns the error.
    fn failing_step(&mut self) -> Error {
        let (cable, body) = self.state();
        let snapshot = self.set.get(self.rope).unwrap().snapshot().clone();
        let error = self.set.step(&mut self.world).expect_err("an impossible step");
        assert!(self.state() == (cable, body), "{error}");
        assert_eq!(*self.set.get(self.rope).unwrap().snapshot(), snapshot, "{error}");
        error
    }

    /// As [`failing_step`](Self::failing_step); the error names the rope, and the cause is returned.
    fn refused_step(&mut self) -> Error {
        let error = self.failing_step();
        let Error::StepRefused { cables, cause, .. } = error else { panic!("{error}") };
        assert_eq!(cables, ["sling"]);
        *cause
    }

    /// The cause is removed: after half a second more, the load is still on its rope.
    fn continues(&mut self) {
        self.run(30);
        let gap = self.set.attachments().map(|(_, a)| a.gap()).fold(0.0, f64::max);
        let at = self.world.bodies[self.load].translation();
        assert!(gap < 1e-3 && at.is_finite() && at.length() < 2.2, "{gap:.1e} m, {at}");
    }
}

/// A velocity or a spin that is NaN or infinite: the error names the body and the quantity.
#[test]
fn a_body_velocity_that_is_not_finite_is_an_error() {
    for (bad, spins) in [(f32::NAN, false), (f32::INFINITY, false), (f32::NAN, true)] {
        let mut p = pendulum();
        let (v, w) = (p.world.bodies[p.load].linvel(), p.world.bodies[p.load].angvel());
        let wrong = Vector::new(bad, 0.0, 0.0);
        if spins {
            p.world.bodies[p.load].set_angvel(wrong, true);
        } else {
            p.world.bodies[p.load].set_linvel(wrong, true);
        }
        let error = p.refused_step();
        assert!(
            matches!(error, Error::BodyNotFinite { body, quantity: BodyQuantity::Velocity, .. } if body == p.load),
            "{error}"
        );
        p.world.bodies[p.load].set_linvel(v, true);
        p.world.bodies[p.load].set_angvel(w, true);
        p.continues();
    }
}

/// A force or a torque that is infinite: the error names the body and the quantity.
#[test]
fn an_infinite_force_on_a_body_is_an_error() {
    for torque in [false, true] {
        let mut p = pendulum();
        let wrong = Vector::new(0.0, f32::INFINITY, 0.0);
        if torque {
            p.world.bodies[p.load].add_torque(wrong, true);
        } else {
            p.world.bodies[p.load].add_force(wrong, true);
        }
        let error = p.refused_step();
        assert!(
            matches!(error, Error::BodyNotFinite { body, quantity: BodyQuantity::Force, .. } if body == p.load),
            "{error}"
        );
        p.world.bodies[p.load].reset_forces(true);
        p.world.bodies[p.load].reset_torques(true);
        p.continues();
    }
}

/// A body without mass cannot be integrated: it holds its end as a fixed one does, and is
/// integrated again once it has mass. Rapier does not move a dynamic body without mass by forces
/// either.
#[test]
fn a_body_that_loses_its_mass_holds_its_end() {
    let mut p = pendulum();
    let collider = p.world.bodies[p.load].colliders()[0];
    p.world.colliders[collider].set_mass(0.0);
    p.world.bodies[p.load].set_linvel(Vector::ZERO, true);
    p.run(30);
    p.world.colliders[collider].set_mass(5.0);
    p.continues();
}

/// A load of 1e300 N on the cable overflows in every step: the error names the cable and the time.
#[test]
fn a_load_that_overflows_is_an_error_and_the_next_step_works_without_it() {
    let mut p = pendulum();
    let load = PointLoad::force(1.0, Vector3::new(0.0, 1e300, 0.0));
    p.set.get_mut(p.rope).unwrap().add_load(load).unwrap();
    let now = p.set.get(p.rope).unwrap().time();
    let error = p.refused_step();
    let Error::Cable(lariat_ancf::Error::StepFailed { cable, time, .. }) = &error else { panic!("{error}") };
    assert!(cable == "sling" && *time == now, "{error}");
    p.set.get_mut(p.rope).unwrap().clear_loads();
    p.continues();
}

/// A position that is NaN, and a time step of the world that is NaN, negative or infinite.
#[test]
fn positions_and_time_steps_that_are_no_numbers_are_errors() {
    let mut p = pendulum();
    let at = p.world.bodies[p.load].translation();
    p.world.bodies[p.load].set_translation(Vector::new(f32::NAN, 0.0, 0.0), true);
    let error = p.refused_step();
    assert!(
        matches!(error, Error::BodyNotFinite { body, quantity: BodyQuantity::Position, .. } if body == p.load),
        "{error}"
    );
    p.world.bodies[p.load].set_translation(at, true);
    p.continues();
    let dt = p.world.integration_parameters.dt;
    for wrong in [f32::NAN, -1.0, f32::INFINITY] {
        p.world.integration_parameters.dt = wrong;
        let error = p.failing_step();
        assert!(matches!(error, Error::TimeStep { .. }), "{error}");
    }
    p.world.integration_parameters.dt = dt;
    p.continues();
}

/// Gravity that is NaN or infinite.
#[test]
fn gravity_that_is_not_finite_is_an_error() {
    for wrong in [f32::NAN, f32::INFINITY] {
        let mut p = pendulum();
        let gravity = p.world.gravity;
        p.world.gravity = Vector::new(0.0, wrong, 0.0);
        let error = p.failing_step();
        assert!(matches!(error, Error::Cable(lariat_ancf::Error::InvalidValue { .. })), "{error}");
        p.world.gravity = gravity;
        p.continues();
    }
}
