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
        let made = |shape: &SharedShape| Entry { collider, shape: shape.clone(), surface: surface(&**shape).map(Arc::from) };
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
        TypedShape::Segment(segment) => {
            Box::new(Capsule { ends: [vector(segment.a), vector(segment.b)], radius: 0.0 })
        }
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
        TypedShape::Cylinder(cylinder) => Box::new(Cylinder {
            half_height: f64::from(cylinder.half_height),
            radius: f64::from(cylinder.radius),
        }),
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
