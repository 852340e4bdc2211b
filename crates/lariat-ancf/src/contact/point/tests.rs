//! A contact over a step: its tangent, and its energy.

use super::super::path::BodyPath;
use super::*;
use crate::obstacle::{Mount, RigidMotion};
use nalgebra::UnitQuaternion;

fn point(patch: Patch, friction: f64) -> ContactPoint {
    let (xi, shape, weight, reach) = (0.5, [0.5, 0.0, 0.5, 0.0], 0.03, 5e-3);
    let law = NormalLaw::new(1e9, 5e-3);
    ContactPoint { xi, shape, weight, law, mass: 0.14, friction, reach, patch, ..ContactPoint::default() }
}

/// Without friction the tangent is minus the derivative of the force, but for the turn of the mean
/// normal, on a plane; and no contact with an obstacle, moving or turning or at rest, loses less
/// than nothing: `F . D x = work - D (W + U) - loss` with a loss above zero.
///
/// *Source.* Central differences, and the energies by their formulas.
#[test]
fn a_contact_makes_no_energy_but_the_work_of_its_obstacle() {
    let turning = RigidMotion {
        velocity: Vector3::new(0.3, -0.2, 0.1),
        angular_velocity: Vector3::new(3.0, 10.0, -5.0),
        ..RigidMotion::default()
    };
    let normal = Vector3::new(0.0, 0.6, 0.8);
    let patches = [
        Patch::Plane { point: Vector3::zeros(), normal },
        Patch::Line { point: Vector3::zeros(), direction: Vector3::x(), radius: 0.1 },
        Patch::Point { point: Vector3::zeros(), radius: 0.1 },
    ];
    for patch in patches {
        let (origin, spin) = (Vector3::zeros(), UnitQuaternion::identity());
        let mount = Mount { body: 0, position: origin, rotation: spin };
        let half = Vector3::new(0.05, -0.1, 0.2);
        let path = BodyPath { centre: origin, displacement: 3e-5 * half, rotation: spin, half, moved: false };
        let h = 1.0 / 240.0;
        let still = ObstacleStep::new(&RigidMotion::default(), 0.0, h);
        let carried = ObstacleStep::carried(&mount, &path, h);
        for step in [still, ObstacleStep::new(&turning, 0.0, h), carried] {
            for i in 0..64 {
                let way = |k: i32, n: i32| f64::from((i * n + k * 5) % 11 - 5) * 4e-5;
                let mut p = point(patch, 0.4);
                let height = patch.radius().unwrap_or(0.0) + 5e-3 + 2e-5 * f64::from(i % 5 - 3);
                p.start = height * normal;
                p.spring = 1e-6 * Vector3::new(1.0, -0.8, 0.6) * f64::from(i % 3);
                p.bound = f64::from(i % 4) * 20.0;
                p.depth_before = p.depth_at(patch.gap(&p.start).0);
                let before = p.energy_before();
                let change = Vector3::new(way(1, 3), way(2, 7), way(3, 2));
                let now = p.evaluate(&step, &change, About::default(), None);
                let way = step.slip(&p.start, &change);
                let made = now.force.dot(&way) + now.energy - before + now.loss;
                let work = if step.driven { now.force.dot(&(change - way)) } else { 0.0 };
                assert_eq!(now.work, work);
                assert!(made.abs() < 1e-12, "{patch:?} {i} {made:e}");
                assert!(now.loss > -1e-13, "{patch:?} {i} {:e}", now.loss);
            }
        }
    }
}

/// What closes of an offset is paid by the contact itself, `F . D x = -D (W + U) - loss`, or by
/// what moved the obstacle, with its work.
///
/// *Source.* The energies by their formulas.
#[test]
fn an_offset_that_closes_is_paid_for() {
    let step = ObstacleStep::new(&RigidMotion::default(), 0.0, 1.0 / 240.0);
    for pays in [true, false] {
        let mut p = point(Patch::Plane { point: Vector3::zeros(), normal: Vector3::y() }, 0.4);
        p.start = Vector3::new(0.0, 5e-3 - 6e-5, 0.0);
        (p.bound, p.offset, p.closing, p.pays) = (30.0, 4e-5, 1e-5, pays);
        p.depth_before = p.depth_at(p.patch.gap(&p.start).0);
        let before = p.energy_before();
        let change = Vector3::new(3e-4, -1e-5, 0.0);
        let now = p.evaluate(&step, &change, About::default(), None);
        let made = now.force.dot(&change) + now.energy - before + now.loss - now.work;
        assert!(now.normal_force > 0.0 && made.abs() < 1e-12, "{made:e}");
        assert_eq!(now.work, if pays { 0.0 } else { now.normal_force * p.closing });
    }
}

/// On a plane the tangent is exact: of the normal force, of sticking and of slipping.
///
/// *Source.* Central differences.
#[test]
fn the_tangent_of_a_plane_is_the_derivative_of_the_force() {
    let step = ObstacleStep::new(&RigidMotion::default(), 0.0, 1.0 / 240.0);
    for bound in [0.0, 2.0, 1e4] {
        let mut p = point(Patch::Plane { point: Vector3::zeros(), normal: Vector3::y() }, 0.4);
        p.start = Vector3::new(0.0, 5e-3 - 2e-5, 0.0);
        p.bound = bound;
        let change = Vector3::new(3e-6, -2e-5, 2e-6);
        let at = |change: &Vector3<f64>| p.evaluate(&step, change, About::default(), None);
        let mut tangents = Tangents::default();
        p.evaluate(&step, &change, About::default(), Some(&mut tangents));
        for c in 0..3 {
            let d = 1e-10 * Vector3::ith(c, 1.0);
            let slope = (at(&(change - d)).force - at(&(change + d)).force) / 2e-10;
            let column = (tangents.normal + tangents.friction).column(c).into_owned();
            assert!((slope - column).norm() < 1e-4 * 3e7, "{bound} {slope:?} {column:?}");
        }
    }
}
