//! The surface of a collider's shape.

use super::compound::{Compound, Part, Rounded};
use super::cone::Cone;
use super::mesh::Mesh;
use crate::convert::{rotation, vector};
use lariat_ancf::contact::{Ball, Capsule, Cuboid, Cylinder, HalfSpace, Surface};
use rapier::geometry::{ColliderHandle, SharedShape, TypedShape};
use rapier::parry::shape::Shape;
use std::sync::Arc;

/// The surfaces of colliders, made once for each shape. Nothing in it is state.
#[derive(Clone, Default)]
pub(crate) struct Surfaces(Vec<Entry>);

#[derive(Clone)]
struct Entry {
    collider: ColliderHandle,
    shape: SharedShape,
    /// `None`: a shape that cables cannot touch.
    surface: Option<Arc<dyn Surface>>,
}

impl core::fmt::Debug for Surfaces {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self.0.iter().map(|entry| &entry.surface)).finish()
    }
}

impl Surfaces {
    /// Returns the surface of a collider; `None` for a shape that is the program's own.
    pub fn of(&mut self, collider: ColliderHandle, shape: &SharedShape) -> Option<Arc<dyn Surface>> {
        let key = |handle: ColliderHandle| handle.into_raw_parts();
        let made =
            |shape: &SharedShape| Entry { collider, shape: shape.clone(), surface: surface(&**shape).map(Arc::from) };
        let i = match self.0.binary_search_by_key(&key(collider), |entry| key(entry.collider)) {
            Ok(i) => {
                if !Arc::ptr_eq(&self.0[i].shape.0, &shape.0) {
                    self.0[i] = made(shape);
                }
                i
            }
            Err(i) => {
                self.0.insert(i, made(shape));
                i
            }
        };
        self.0[i].surface.clone()
    }

    /// Drops those of colliders that are gone.
    pub fn retain(&mut self, exists: impl Fn(ColliderHandle) -> bool) {
        self.0.retain(|entry| exists(entry.collider));
    }
}

/// Returns the surface of a shape; `None` for one that is the program's own.
pub(super) fn surface(shape: &dyn Shape) -> Option<Box<dyn Surface>> {
    Some(match shape.as_typed_shape() {
        TypedShape::Ball(ball) => Box::new(Ball { radius: f64::from(ball.radius) }),
        TypedShape::Cuboid(cuboid) => Box::new(Cuboid { half_extents: vector(cuboid.half_extents) }),
        TypedShape::Capsule(capsule) => Box::new(Capsule {
            ends: [vector(capsule.segment.a), vector(capsule.segment.b)],
            radius: f64::from(capsule.radius),
        }),
        TypedShape::Segment(segment) => Box::new(Capsule { ends: [vector(segment.a), vector(segment.b)], radius: 0.0 }),
        TypedShape::Triangle(triangle) => {
            Box::new(Mesh::new(vec![triangle.a, triangle.b, triangle.c], vec![[0, 1, 2]], false)?)
        }
        TypedShape::TriMesh(mesh) => Box::new(Mesh::new(mesh.vertices().to_vec(), mesh.indices().to_vec(), false)?),
        TypedShape::HeightField(field) => {
            let (vertices, triangles) = field.to_trimesh();
            Box::new(Mesh::new(vertices, triangles, false)?)
        }
        TypedShape::Voxels(voxels) => {
            let (vertices, triangles) = voxels.to_trimesh();
            Box::new(Mesh::new(vertices, triangles, false)?)
        }
        TypedShape::ConvexPolyhedron(hull) => {
            let (vertices, triangles) = hull.to_trimesh();
            Box::new(Mesh::new(vertices, triangles, true)?)
        }
        TypedShape::Polyline(line) => Box::new(Compound::new(
            line.segments()
                .map(|segment| {
                    let ends = [vector(segment.a), vector(segment.b)];
                    Part::new(Box::new(Capsule { ends, radius: 0.0 }), Default::default(), Default::default())
                })
                .collect(),
        )),
        TypedShape::HalfSpace(half_space) => Box::new(HalfSpace { normal: vector(half_space.normal).normalize() }),
        TypedShape::Compound(compound) => {
            let parts = compound.shapes().iter().map(|(pose, shape)| {
                Some(Part::new(surface(&**shape)?, vector(pose.translation), rotation(pose.rotation)))
            });
            Box::new(Compound::new(parts.collect::<Option<Vec<_>>>()?))
        }
        TypedShape::Cylinder(cylinder) => {
            Box::new(Cylinder { half_height: f64::from(cylinder.half_height), radius: f64::from(cylinder.radius) })
        }
        TypedShape::Cone(cone) => {
            Box::new(Cone { half_height: f64::from(cone.half_height), radius: f64::from(cone.radius) })
        }
        TypedShape::RoundCuboid(round) => rounded(&round.inner_shape, round.border_radius)?,
        TypedShape::RoundTriangle(round) => rounded(&round.inner_shape, round.border_radius)?,
        TypedShape::RoundCylinder(round) => rounded(&round.inner_shape, round.border_radius)?,
        TypedShape::RoundCone(round) => rounded(&round.inner_shape, round.border_radius)?,
        TypedShape::RoundConvexPolyhedron(round) => rounded(&round.inner_shape, round.border_radius)?,
        TypedShape::Custom(_) => return None,
    })
}

fn rounded(inner: &dyn Shape, border: rapier::math::Real) -> Option<Box<dyn Surface>> {
    Some(Box::new(Rounded { inner: surface(inner)?, border: f64::from(border) }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::to_vector;
    use ::nalgebra::Vector3;
    use lariat_ancf::contact::Patch;
    use rapier::math::{Pose, Real, Vector};

    fn shapes() -> Vec<(&'static str, SharedShape)> {
        let v = |x: Real, y: Real, z: Real| Vector::new(x, y, z);
        let tent = vec![v(-0.5, 0.0, -0.5), v(0.5, 0.0, -0.5), v(0.0, 0.4, 0.0), v(-0.5, 0.0, 0.5), v(0.5, 0.1, 0.5)];
        let faces = vec![[0, 2, 1], [0, 3, 2], [3, 4, 2], [1, 2, 4]];
        let cloud: Vec<Vector> =
            (0..30).map(|i| 0.5 * v((i as Real).sin(), (1.7 * i as Real).sin(), (2.9 * i as Real).cos())).collect();
        let heights = rapier::parry::utils::Array2::new(4, 5, (0..20).map(|i| 0.2 * (i as Real).sin()).collect());
        let at = |x: Real| Pose::from_parts(v(x, 0.1, 0.0), rapier::math::Rotation::from_rotation_z(0.4));
        vec![
            ("ball", SharedShape::ball(0.3)),
            ("cuboid", SharedShape::cuboid(0.3, 0.2, 0.4)),
            ("capsule", SharedShape::capsule(v(-0.2, 0.0, 0.1), v(0.3, 0.2, 0.0), 0.1)),
            ("segment", SharedShape::segment(v(-0.2, 0.0, 0.1), v(0.3, 0.2, 0.0))),
            ("cylinder", SharedShape::cylinder(0.3, 0.2)),
            ("cone", SharedShape::cone(0.3, 0.2)),
            ("hull", SharedShape::convex_hull(&cloud).unwrap()),
            ("triangle", SharedShape::triangle(tent[0], tent[1], tent[2])),
            ("mesh", SharedShape::trimesh(tent.clone(), faces).unwrap()),
            ("height field", SharedShape::heightfield(heights, v(1.0, 1.0, 1.0))),
            ("polyline", SharedShape::polyline(tent, None)),
            ("half-space", SharedShape::halfspace(v(0.0, 0.6, 0.8).normalize())),
            ("round cuboid", SharedShape::round_cuboid(0.3, 0.2, 0.4, 0.05)),
            ("round cylinder", SharedShape::round_cylinder(0.3, 0.2, 0.05)),
            ("round cone", SharedShape::round_cone(0.3, 0.2, 0.05)),
            ("round hull", SharedShape::round_convex_hull(&cloud, 0.05).unwrap()),
            (
                "compound",
                SharedShape::compound(vec![
                    (at(0.4), SharedShape::ball(0.2)),
                    (at(-0.3), SharedShape::cuboid(0.1, 0.2, 0.3)),
                ]),
            ),
        ]
    }

    /// The surface of every shape has the distances that parry computes, with patches that have
    /// them too, and whose normal is the way from parry's nearest point; no feature is nearer than
    /// the surface, and a ball that holds a point of it may meet it.
    ///
    /// *Source.* parry's projection of points, to its precision.
    #[test]
    fn every_shape_has_the_surface_that_parry_has() {
        for (name, shape) in shapes() {
            let surface = surface(&*shape).unwrap();
            let mut compared = 0;
            // parry makes one face of a hull of triangles that are nearly in a plane
            let rounding = if name.contains("hull") { 2e-4 } else { 2e-5 };
            // its projection on a rounded shape iterates and is 2e-3 m off at the corner of a box:
            // that on the shape within is exact
            let (within, border): (&dyn Shape, Real) = match shape.as_typed_shape() {
                TypedShape::RoundCuboid(round) => (&round.inner_shape, round.border_radius),
                TypedShape::RoundCylinder(round) => (&round.inner_shape, round.border_radius),
                TypedShape::RoundCone(round) => (&round.inner_shape, round.border_radius),
                TypedShape::RoundConvexPolyhedron(round) => (&round.inner_shape, round.border_radius),
                _ => (&*shape.0, 0.0),
            };
            let border = f64::from(border);
            for i in 0..1331 {
                let y =
                    Vector3::new(f64::from(i % 11) - 5.05, f64::from(i / 11 % 11) - 4.95, f64::from(i / 121) - 5.02)
                        * 0.16;
                let projection = within.project_local_point(to_vector(&y), false);
                // inside, only the nearest face of a single convex part is meant
                if projection.is_inside {
                    continue;
                }
                let exact = (y - crate::convert::vector(projection.point)).norm() - border;
                let nearest = surface.nearest(&y);
                assert!((nearest.distance - exact).abs() < rounding, "{name} {y:?} {nearest:?} {}", exact);
                let z = match nearest.patch {
                    Patch::Plane { point, normal } => normal.dot(&(y - point)),
                    Patch::Line { point, direction, radius } => {
                        let z = y - point;
                        (z - direction * direction.dot(&z)).norm() - radius
                    }
                    Patch::Point { point, radius } => (y - point).norm() - radius,
                };
                assert!((z - nearest.distance).abs() < 1e-7, "{name} {y:?} {nearest:?} {z}");
                surface.features(&y, 3.0, &mut |feature| {
                    use lariat_ancf::contact::FeatureShape;
                    let distance = match feature.shape {
                        FeatureShape::Point(p) => (y - p).norm(),
                        FeatureShape::Segment(a, b) => {
                            let t = (y - a).dot(&(b - a)) / (b - a).norm_squared();
                            // its ends are other features
                            if t <= 0.0 || t >= 1.0 {
                                return;
                            }
                            (y - a - (b - a) * t).norm()
                        }
                        FeatureShape::Circle { .. } => return,
                    };
                    assert!(distance - feature.radius > exact - rounding, "{name} {feature:?}");
                });
                assert!(surface.may_meet(&y, exact.abs() + 1e-4), "{name} {y:?}");
                let [low, high] = surface.bounds().unwrap_or([Vector3::repeat(-9.0), Vector3::repeat(9.0)]);
                let near = crate::convert::vector(projection.point);
                assert!((0..3).all(|x| near[x] > low[x] - 1e-5 && near[x] < high[x] + 1e-5), "{name}");
                compared += 1;
            }
            assert!(compared > 300, "{name}: {compared}");
        }
    }

    /// The distance from a rounded box is that from the box less the border.
    ///
    /// *Source.* By hand: the corner is at (0.3, 0.2, 0.4) m, the point 0.5, 0.6 and 0.4 m beyond
    /// it.
    #[test]
    fn a_rounded_box_is_its_border_nearer() {
        let surface = surface(&*SharedShape::round_cuboid(0.3, 0.2, 0.4, 0.05)).unwrap();
        let distance = surface.nearest(&Vector3::new(-0.8, 0.8, -0.8)).distance;
        assert!((distance - (0.77f64.sqrt() - 0.05)).abs() < 1e-7, "{distance}");
    }

    /// A box as a mesh and as a hull has its twelve edges and eight corners as features, and none
    /// within its faces.
    ///
    /// *Source.* Geometry.
    #[test]
    fn the_features_of_a_box_are_its_edges_and_corners() {
        let corners: Vec<Vector> =
            (0..8).map(|i| Vector::new((i & 1) as Real, (i >> 1 & 1) as Real, (i >> 2) as Real)).collect();
        let (vertices, triangles) = rapier::parry::shape::Cuboid::new(Vector::splat(0.5)).to_trimesh();
        for shape in [SharedShape::convex_hull(&corners).unwrap(), SharedShape::trimesh(vertices, triangles).unwrap()] {
            let (mut edges, mut points) = (0, 0);
            surface(&*shape).unwrap().features(&Vector3::repeat(0.5), 3.0, &mut |feature| match feature.shape {
                lariat_ancf::contact::FeatureShape::Point(_) => points += 1,
                lariat_ancf::contact::FeatureShape::Segment(a, b) => {
                    assert!(((a - b).norm() - 1.0).abs() < 1e-6);
                    edges += 1;
                }
                lariat_ancf::contact::FeatureShape::Circle { .. } => panic!(),
            });
            assert_eq!((edges, points), (12, 8));
        }
    }
}
