//! Shapes of Rapier's colliders as those that pages draw.

use crate::scene::body::BodyShape;
use crate::scene::mesh::Mesh;
use lariat_rapier::convert::{rotation, vector};
use lariat_rapier::rapier::parry::shape::{Shape, TypedShape};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

/// Corners around a cone.
const ROUND: u32 = 20;

/// Returns what a shape looks like, each part with its place in the axes of the shape. Rounded shapes are drawn without their border,
/// the program's own not at all.
pub fn looks(shape: &dyn Shape) -> Vec<(Isometry3<f64>, BodyShape)> {
    let here = |shape| vec![(Isometry3::identity(), shape)];
    let size = f64::from;
    match shape.as_typed_shape() {
        TypedShape::Ball(ball) => here(BodyShape::Ball(size(ball.radius))),
        TypedShape::Cuboid(cuboid) => here(BodyShape::Cuboid(vector(cuboid.half_extents))),
        TypedShape::RoundCuboid(round) => looks(&round.inner_shape),
        TypedShape::Cylinder(c) => here(BodyShape::Cylinder([size(c.half_height), size(c.radius)])),
        TypedShape::RoundCylinder(round) => looks(&round.inner_shape),
        TypedShape::Capsule(round) => {
            vec![capsule([vector(round.segment.a), vector(round.segment.b)], size(round.radius))]
        }
        TypedShape::HalfSpace(half_space) => here(BodyShape::Plane(vector(half_space.normal).normalize())),
        TypedShape::Cone(cone) => here(mesh(cone.to_trimesh(ROUND))),
        TypedShape::RoundCone(round) => looks(&round.inner_shape),
        TypedShape::TriMesh(own) => here(mesh((own.vertices().to_vec(), own.indices().to_vec()))),
        TypedShape::HeightField(field) => here(mesh(field.to_trimesh())),
        TypedShape::Voxels(voxels) => here(mesh(voxels.to_trimesh())),
        TypedShape::ConvexPolyhedron(hull) => here(mesh(hull.to_trimesh())),
        TypedShape::RoundConvexPolyhedron(round) => looks(&round.inner_shape),
        TypedShape::Triangle(t) => here(mesh((vec![t.a, t.b, t.c], vec![[0, 1, 2]]))),
        TypedShape::RoundTriangle(round) => looks(&round.inner_shape),
        TypedShape::Segment(segment) => vec![capsule([vector(segment.a), vector(segment.b)], 0.0)],
        TypedShape::Polyline(line) => {
            line.segments().map(|segment| capsule([vector(segment.a), vector(segment.b)], 0.0)).collect()
        }
        TypedShape::Compound(compound) => {
            let part = |(pose, shape): &(_, _)| placed(pose, shape);
            compound.shapes().iter().flat_map(part).collect()
        }
        TypedShape::Custom(_) => Vec::new(),
    }
}

/// Returns the parts of a shape at a pose.
fn placed(
    pose: &lariat_rapier::rapier::math::Pose,
    shape: &lariat_rapier::rapier::geometry::SharedShape,
) -> Vec<(Isometry3<f64>, BodyShape)> {
    let at = Isometry3::from_parts(vector(pose.translation).into(), rotation(pose.rotation));
    looks(&**shape).into_iter().map(|(own, look)| (at * own, look)).collect()
}

/// Returns a capsule between two points (m), with its place.
pub fn capsule([a, b]: [Vector3<f64>; 2], radius: f64) -> (Isometry3<f64>, BodyShape) {
    let turn = UnitQuaternion::rotation_between(&Vector3::y(), &(b - a))
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), core::f64::consts::PI));
    let centre = Point3::from(0.5 * (a + b));
    (Isometry3::from_parts(centre.into(), turn), BodyShape::Capsule([0.5 * (b - a).norm(), radius]))
}

fn mesh((corners, triangles): (Vec<lariat_rapier::rapier::math::Vector>, Vec<[u32; 3]>)) -> BodyShape {
    let vertices = corners.into_iter().map(|corner| vector(corner).into()).collect();
    BodyShape::Mesh(Mesh { file: String::new(), vertices, triangles })
}
