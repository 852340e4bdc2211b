//! Junctions, loops and locked axes.

use super::bench::{Scene, cube, payload, soft};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Cable, Integrator, Method, Section, StepControl, Vector3};
use nalgebra::Matrix3;

/// A damping integrator that converges to the equilibrium.
const DAMPING: Integrator =
    Integrator { method: Method::GeneralisedAlpha { rho: 0.0 }, control: StepControl::Substeps(1) };

/// A cube that is free along x only, moving towards the other end of its sagging cable, does not
/// leave its axis or rotate, and the energy is conserved.
///
/// *Source.* The constraint does no work.
#[test]
fn locked_axes_keep_their_coordinates() {
    let mut scene = payload(soft(), 5.0, Integrator::default());
    scene.bodies[0].free = [true, false, true, false, true, false];
    scene.bodies[0].velocity = Vector3::new(-1.0, 0.0, 0.0);
    // the first step gives the cable's end, initially at rest, the velocity of the cube
    scene.run(1.0 / 60.0, 1);
    let start = scene.energy();
    scene.run(1.0 / 60.0, 60);
    let after = &scene.bodies[0];
    assert_eq!((after.position.y, after.velocity.y), (-0.1, 0.0));
    assert_eq!((after.rotation.scaled_axis(), after.angular_velocity), (Vector3::zeros(), Vector3::zeros()));
    assert!(after.position.x < 1.9, "slides: {}", after.position.x);
    let energy = scene.energy() - start;
    assert!(energy.abs() < 1e-3, "{energy:.1e} J");
}

/// Three cables of 1 g/m meet at a point without mass; two are fixed above, the third carries 5 kg.
/// At rest each cable pulls along its line: 16.35 N sideways, 16.35 and 32.70 N up.
///
/// *Source.* Statics of three concurrent forces on taut cables, directions (-1, 1) and (1, 2):
/// sideways H = W/3, up H and 2 H, W = 49.05 N. The stays stretch by 2e-4 and sag by their 2 g:
/// 1e-3.
#[test]
fn a_junction_without_mass_balances_its_three_cables() {
    let light = Section::from_stiffness(2e5, 0.0, 1e-3).unwrap();
    let hub = Vector3::new(0.0, -1.0, 0.0);
    let stay = |x: f64| {
        Cable::builder()
            .points([Vector3::new(x, 0.0, 0.0), hub])
            .section(light)
            .elements(4)
            .fix(At::Start)
            .build()
            .unwrap()
    };
    let load = Vector3::new(0.0, -2.0, 0.0);
    let hanger = Cable::builder().points([hub, load]).section(light).elements(4).build().unwrap();
    let mut bob = RigidBody::new(5.0, cube(5.0, 0.1), load).unwrap();
    bob.force = Vector3::new(0.0, -9.81 * 5.0, 0.0);
    let bodies = vec![RigidBody::junction(hub).unwrap(), bob];
    let mut scene = Scene::new(vec![stay(-1.0), stay(0.5), hanger], bodies, DAMPING)
        .pin(0, At::End, 0, Vector3::zeros())
        .pin(1, At::End, 0, Vector3::zeros())
        .pin(2, At::Start, 0, Vector3::zeros())
        .pin(2, At::End, 1, Vector3::zeros());
    for _ in 0..600 {
        scene.run(1.0 / 60.0, 1);
    }
    let forces = scene.pin_forces();
    let side = 9.81 * 5.0 / 3.0;
    let statics = [(-side, side), (side, 2.0 * side), (0.0, -3.0 * side), (0.0, 3.0 * side)];
    for (force, (x, y)) in forces.iter().zip(statics) {
        assert!((force - Vector3::new(x, y, 0.0)).norm() < 1e-3 * 3.0 * side, "{force:?}, statics {x} {y}");
    }
    // on a point without mass the cables balance exactly
    assert!((forces[0] + forces[1] + forces[2]).norm() < 1e-9, "{:?}", forces[0] + forces[1] + forces[2]);
}

/// Three bodies and three cables in a closed ring that rotates at 3 rad/s: after 1 s the ring is
/// still equilateral, and linear momentum, angular momentum and energy are conserved.
///
/// *Source.* Conservation laws and the threefold symmetry of the start.
#[test]
fn a_rotating_closed_ring_keeps_its_shape_and_invariants() {
    let at = |k: usize, r: f64, offset: f64| {
        let a = std::f64::consts::TAU / 3.0 * (k as f64 + offset);
        Vector3::new(r * a.cos(), r * a.sin(), 0.0)
    };
    let spin = Vector3::new(0.0, 0.0, 3.0);
    let mut bodies = Vec::new();
    let mut cables = Vec::new();
    for k in 0..3 {
        let mut body = RigidBody::new(2.0, Matrix3::from_diagonal_element(0.01), at(k, 1.0, 0.0)).unwrap();
        body.velocity = spin.cross(&body.position);
        body.angular_velocity = spin;
        bodies.push(body);
        let (a, b) = (at(k, 1.0, 0.0), at(k + 1, 1.0, 0.0));
        let inset = (b - a).normalize() * 0.1;
        cables.push(
            Cable::builder()
                .points([a + inset, b - inset])
                .section(soft())
                .elements(4)
                .gravity(Vector3::zeros())
                .velocity(spin.cross(&(a + inset)))
                .angular_velocity(spin)
                .build()
                .unwrap(),
        );
    }
    let mut scene = Scene::new(cables, bodies, Integrator::default());
    for k in 0..3 {
        let (a, b) = (at(k, 1.0, 0.0), at(k + 1, 1.0, 0.0));
        let inset = (b - a).normalize() * 0.1;
        scene = scene.pin(k, At::Start, k, inset).pin(k, At::End, (k + 1) % 3, -inset);
    }
    let ((p0, l0), e0) = (scene.momentum(), scene.energy());
    scene.run(1.0 / 60.0, 60);
    let ((p, l), e) = (scene.momentum(), scene.energy());
    let radii: Vec<f64> = scene.bodies.iter().map(|b| b.position.norm()).collect();
    assert!(radii.iter().all(|r| (r - radii[0]).abs() < 1e-12 && (r - 1.0).abs() < 1e-3), "{radii:?}");
    assert!((p - p0).norm() < 1e-11, "{:?}", p - p0);
    assert!((l - l0).norm() < 2e-6 * l0.norm(), "{:.1e}", (l - l0).norm() / l0.norm());
    assert!((e - e0).abs() < 1e-5 * e0, "{:.1e}", (e - e0) / e0);
    assert!(scene.gap() < 1e-13);
}
