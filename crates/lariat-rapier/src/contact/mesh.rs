//! Triangle meshes, hulls and height fields: the nearest triangle by parry's tree, its geometry in
//! `f64`.
//!
//! # Validity
//!
//! Vertices are exact in `f64`. Both sides of a triangle are its outside, but for a hull, whose
//! triangles know theirs. An edge is sharp, and a feature, if it has one triangle, or two that meet
//! with an outward angle above [`FLAT`]; edges that point inwards are none.

use crate::convert::{to_vector, vector};
use crate::scales::contact::FLAT;
use ::nalgebra::Vector3;
use lariat_ancf::contact::{Feature, FeatureShape, Nearest, Patch, Surface};
use rapier::geometry::{Aabb, TriMesh};
use rapier::math::Vector;
use rapier::parry::query::PointQueryWithLocation;
use rapier::parry::shape::TrianglePointLocation;
use std::collections::BTreeMap;

/// Triangles.
#[derive(Debug)]
pub(super) struct Mesh {
    vertices: Vec<Vector3<f64>>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vector3<f64>>,
    /// Whether each triangle has an inside, behind it.
    solid: bool,
    /// Features by the triangle that owns them: the first of those that share them.
    owned: Vec<(u32, Feature)>,
    tree: TriMesh,
}

impl Mesh {
    /// Makes a mesh of triangles; `None` if there is none.
    pub fn new(vertices: Vec<Vector>, triangles: Vec<[u32; 3]>, solid: bool) -> Option<Self> {
        let points: Vec<Vector3<f64>> = vertices.iter().map(|v| vector(*v)).collect();
        let corners = |t: &[u32; 3]| t.map(|i| points[i as usize]);
        let triangles: Vec<[u32; 3]> = triangles
            .into_iter()
            .filter(|t| {
                let [a, b, c] = corners(t);
                (b - a).cross(&(c - a)).norm() > 0.0
            })
            .collect();
        let tree = TriMesh::new(vertices, triangles.clone()).ok()?;
        let normals: Vec<Vector3<f64>> = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = corners(t);
                (b - a).cross(&(c - a)).normalize()
            })
            .collect();
        let mut edges: BTreeMap<(u32, u32), Vec<u32>> = BTreeMap::new();
        for (number, t) in triangles.iter().enumerate() {
            for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                edges.entry((t[i].min(t[j]), t[i].max(t[j]))).or_default().push(number as u32);
            }
        }
        let mut mesh = Mesh { vertices: points, triangles, normals, solid, owned: Vec::new(), tree };
        let mut ends: BTreeMap<u32, u32> = BTreeMap::new();
        for (edge, of) in &edges {
            let sharp = mesh.is_sharp(*edge, of);
            if sharp {
                let [a, b] = [edge.0, edge.1].map(|i| mesh.vertices[i as usize]);
                mesh.own(of[0], FeatureShape::Segment(a, b));
            }
            for end in [edge.0, edge.1].into_iter().filter(|_| sharp) {
                let owner = ends.entry(end).or_insert(of[0]);
                *owner = (*owner).min(of[0]);
            }
        }
        for (vertex, owner) in ends {
            mesh.own(owner, FeatureShape::Point(mesh.vertices[vertex as usize]));
        }
        mesh.owned.sort_by_key(|(owner, feature)| (*owner, feature.id));
        Some(mesh)
    }

    fn own(&mut self, owner: u32, shape: FeatureShape) {
        self.owned.push((owner, Feature { id: self.owned.len() as u32, shape, radius: 0.0 }));
    }

    /// Returns whether an edge stands out between its triangles, seen from a side on which neither
    /// hides it.
    fn is_sharp(&self, edge: (u32, u32), of: &[u32]) -> bool {
        let [one, two] = of else { return true };
        let [n1, n2] = [*one, *two].map(|t| self.normals[t as usize]);
        if n1.cross(&n2).norm() < FLAT && n1.dot(&n2) > 0.0 {
            return false;
        }
        // a mesh without an inside may be touched from where the edge stands out
        let third = self.triangles[*two as usize].into_iter().find(|v| *v != edge.0 && *v != edge.1);
        let across = self.vertices[third.unwrap_or(edge.0) as usize] - self.vertices[edge.0 as usize];
        !self.solid || n1.dot(&across) < 0.0
    }

    fn edge(&self, t: &[u32; 3], number: u32) -> (u32, u32) {
        // parry counts AB, BC, AC
        let (i, j) = [(0, 1), (1, 2), (0, 2)][number.min(2) as usize];
        (t[i].min(t[j]), t[i].max(t[j]))
    }

    fn face(&self, triangle: usize, y: &Vector3<f64>) -> Nearest {
        let point = self.vertices[self.triangles[triangle][0] as usize];
        let mut normal = self.normals[triangle];
        let mut distance = normal.dot(&(y - point));
        if !self.solid && distance < 0.0 {
            (normal, distance) = (-normal, -distance);
        }
        Nearest { patch: Patch::Plane { point, normal }, distance, feature: false }
    }
}

/// Returns whether a place at a distance (m) that is on the border of a triangle is within its
/// face: the way there is along the normal.
fn is_within(face: &Nearest, distance: f64) -> bool {
    (face.distance.abs() - distance).abs() <= FLAT * FLAT * distance
}

/// Returns the box about a ball.
fn about(centre: &Vector3<f64>, radius: f64) -> Aabb {
    let (c, r) = (to_vector(centre), to_vector(&Vector3::repeat(radius)));
    Aabb::new(c - r, c + r)
}

impl Surface for Mesh {
    fn has_facets(&self) -> bool {
        true
    }

    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let (_, (triangle, location)) = self.tree.project_local_point_and_get_location(to_vector(y), false);
        let (number, corners) = (triangle as usize, &self.triangles[triangle as usize]);
        match location {
            TrianglePointLocation::OnEdge(edge, _) => {
                let edge = self.edge(corners, edge);
                let [a, b] = [edge.0, edge.1].map(|i| self.vertices[i as usize]);
                let direction = (b - a).normalize();
                let z = y - a;
                let distance = (z - direction * direction.dot(&z)).norm();
                let face = self.face(number, y);
                if is_within(&face, distance) {
                    return face;
                }
                Nearest { patch: Patch::Line { point: a, direction, radius: 0.0 }, distance, feature: true }
            }
            TrianglePointLocation::OnVertex(i) => {
                let point = self.vertices[corners[i.min(2) as usize] as usize];
                let face = self.face(number, y);
                let distance = (y - point).norm();
                if is_within(&face, distance) {
                    return face;
                }
                Nearest { patch: Patch::Point { point, radius: 0.0 }, distance, feature: true }
            }
            _ => self.face(number, y),
        }
    }

    fn features(&self, centre: &Vector3<f64>, radius: f64, visit: &mut dyn FnMut(Feature)) {
        for triangle in self.tree.bvh().intersect_aabb(&about(centre, radius)) {
            let first = self.owned.partition_point(|(owner, _)| *owner < triangle);
            self.owned[first..].iter().take_while(|(owner, _)| *owner == triangle).for_each(|(_, f)| visit(*f));
        }
    }

    fn may_meet(&self, centre: &Vector3<f64>, radius: f64) -> bool {
        self.tree.bvh().intersect_aabb(&about(centre, radius)).next().is_some()
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        let low = self.vertices.iter().fold(Vector3::repeat(f64::INFINITY), |low, v| low.inf(v));
        Some([low, self.vertices.iter().fold(-low.map(|_| f64::INFINITY), |high, v| high.sup(v))])
    }
}
