//! The surface of a cable as triangles.

use super::common::{cable_of, pin, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::CableBroken;
use lariat_bevy::lariat_ancf::{self, Vector3};
use lariat_bevy::{At, Attachment, Bending, BreakTension, RopeMesh, RopeVertices, Torsion};
use std::collections::HashMap;

const RADIUS: f64 = 0.02;
const SIDES: usize = 12;

fn vector(x: [f32; 3]) -> Vector3<f64> {
    Vector3::from(x.map(f64::from))
}

/// Volume in m^3 that the triangles enclose, positive if they turn anticlockwise from outside.
fn volume(mesh: &RopeVertices) -> f64 {
    let corner = |i: u32| vector(mesh.positions[i as usize]);
    let tetrahedra = mesh.indices.chunks(3).map(|t| corner(t[0]).dot(&corner(t[1]).cross(&corner(t[2]))) / 6.0);
    tetrahedra.sum()
}

/// A cable of 2 m between two points of the world, the surface of which has hung for a while.
fn hung(to: [f64; 3], length: f64, mesh: RopeMesh) -> (World, Entity) {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], to).length(length).elements(8), mesh)).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to_world());
    steps(&mut world, 10);
    (world, cable)
}

/// *Source.* A prism of n sides has the volume (n/2) sin(2 pi/n) r^2 L.
#[test]
fn a_straight_cable_is_a_closed_prism_that_faces_outward() {
    let mesh = RopeMesh::new(RADIUS).sides(SIDES);
    let (world, cable) = hung([0.0, -2.0, 0.0], 2.0, mesh);
    let vertices = world.get::<RopeVertices>(cable).unwrap();
    let n = SIDES as f64;
    let prism = 0.5 * n * (core::f64::consts::TAU / n).sin() * RADIUS * RADIUS * 2.0;
    assert!((volume(vertices) / prism - 1.0).abs() < 1e-3, "{} of {prism} m^3", volume(vertices));
    // each edge is that of two triangles, which run along it in opposite directions
    let weld = |i: u32| vertices.positions[i as usize].map(|x| (f64::from(x) * 1e5).round() as i64);
    let mut edges: HashMap<_, i32> = HashMap::new();
    for t in vertices.indices.chunks(3) {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            let (a, b) = (weld(a), weld(b));
            *edges.entry(if a < b { (a, b) } else { (b, a) }).or_default() += if a < b { 1 } else { -1 };
        }
    }
    assert!(edges.values().all(|sum| *sum == 0));
    let count = vertices.positions.len();
    assert_eq!((vertices.normals.len(), vertices.uvs.len(), vertices.colours.len()), (count, count, 0));
    let v = vertices.uvs.iter().map(|uv| uv[1]).fold(0.0, f32::max);
    assert!((f64::from(v) * core::f64::consts::TAU * RADIUS - 2.0).abs() < 1e-5, "{v}");
}

/// A frame that does not twist keeps its angle to the normal of a plane curve's plane.
#[test]
fn the_frame_of_a_plane_curve_does_not_twist() {
    let (world, cable) = hung([1.2, 0.0, 0.5], 2.0, RopeMesh::new(RADIUS).sides(SIDES));
    let vertices = world.get::<RopeVertices>(cable).unwrap();
    let plane = Vector3::new(0.5, 0.0, -1.2).normalize();
    let first: Vec<f64> =
        vertices.normals[SIDES + 1..].iter().step_by(SIDES + 1).map(|n| vector(*n).dot(&plane)).collect();
    let rings = &first[..8 * 4 + 1];
    assert!(rings.iter().all(|x| (x - rings[0]).abs() < 1e-5), "{rings:?}");
    assert!(vertices.normals.iter().all(|n| (vector(*n).norm() - 1.0).abs() < 1e-6));
}

/// The surface of a twisted cable turns with it, from ring to ring by the same angle, also where it
/// is straight and only its twist changes.
///
/// *Source.* The twist of the cable between its clamps, less that of before.
#[test]
fn the_surface_of_a_twisted_cable_turns_with_it() {
    let mut world = world();
    let motor = lariat_ancf::EndSpin::Motor { rate: 0.5, from: 0.0, until: 0.5 };
    let torsion = lariat_ancf::Torsion { end: motor, ..lariat_ancf::Torsion::new(0.02) };
    let mesh = RopeMesh::new(RADIUS).sides(SIDES);
    let rope = (soft([0.0; 3], [0.0, -2.0, 0.0]).elements(8), Bending, Torsion(torsion), mesh);
    let cable = world.spawn(rope).id();
    world.spawn(Attachment::clamp(cable, At::Start).to_world());
    world.spawn(Attachment::clamp(cable, At::End).to_world());
    let turned = |world: &World| {
        let normals = &world.get::<RopeVertices>(cable).unwrap().normals;
        let rings: Vec<Vector3<f64>> =
            normals[SIDES + 1..].iter().step_by(SIDES + 1).take(8 * 4 + 1).map(|n| vector(*n)).collect();
        // about the direction of arc length, -y
        let angle = |a: &Vector3<f64>, b: &Vector3<f64>| (-a.cross(b).y).atan2(a.dot(b));
        rings.windows(2).map(|pair| angle(&pair[0], &pair[1])).collect::<Vec<f64>>()
    };
    for count in [10, 40] {
        steps(&mut world, count);
        let (own, twist) = (turned(&world), cable_of(&world, cable).torsion()[0].twist);
        assert!(twist > 0.1, "{twist}");
        assert!(own.iter().all(|angle| (angle - twist / 32.0).abs() < 1e-5), "{twist}: {own:?}");
    }
}

#[test]
fn vertices_stay_in_place_and_change_only_with_the_cable() {
    let (mut world, cable) = hung([1.2, 0.0, 0.0], 2.0, RopeMesh::new(RADIUS));
    let place = |world: &World| world.get::<RopeVertices>(cable).unwrap().positions.as_ptr();
    let before = (place(&world), world.get::<RopeVertices>(cable).unwrap().clone());
    steps(&mut world, 5);
    assert_eq!(place(&world), before.0);
    assert_ne!(world.get::<RopeVertices>(cable).unwrap().positions, before.1.positions);
    let drawn = cable_of(&world, cable).clone();
    let mesh = world.get::<RopeMesh>(cable).unwrap().clone();
    let mut vertices = world.get_mut::<RopeVertices>(cable).unwrap();
    assert!(!vertices.draw(&mesh, &drawn, drawn.positions()));
    assert!(vertices.draw(&mesh.rings(2), &drawn, drawn.positions()));
}

#[test]
fn both_parts_of_a_broken_cable_have_a_surface() {
    let mut world = world();
    let colours = RopeMesh::new(RADIUS).sides(SIDES).coloured_by_tension(0.0, 1e-3);
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]).elements(8), colours, BreakTension(3.0))).id();
    world.spawn(pin(cable));
    steps(&mut world, 200);
    let broken: Vec<_> = world.resource_mut::<Messages<CableBroken>>().drain().collect();
    assert!(!broken.is_empty());
    let length = |world: &mut World| {
        let mut parts = world.query::<&RopeVertices>();
        parts.iter(world).map(volume).sum::<f64>()
    };
    let n = SIDES as f64;
    let prism = 0.5 * n * (core::f64::consts::TAU / n).sin() * RADIUS * RADIUS * 2.0;
    let whole = length(&mut world);
    assert!((whole / prism - 1.0).abs() < 1e-2, "{whole} of {prism}");
    let vertices = world.get::<RopeVertices>(cable).unwrap();
    assert_eq!(vertices.colours.len(), vertices.positions.len());
    assert_eq!(vertices.colours[0], [1.0, 0.0, 0.0, 1.0]);
}
