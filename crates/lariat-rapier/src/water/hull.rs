//! The volume of a body, and what of it is below a plane.
//!
//! # Equation
//!
//! A closed surface of triangles that is cut at a plane, P any point on the plane:
//!
//! ```text
//! V_s = sum (a - P) . ((b - P) x (c - P))/6        V_s x_s = sum of the volumes times (a + b + c + P)/4
//! ```
//!
//! over the parts (a, b, c) of the triangles below the plane: the cut itself adds nothing, since P
//! is in it. A ball of radius R whose centre is h below: V_s = pi (R + h)^2 (2R - h)/3, its
//! centroid 3 (R - h)^2/(4 (2R - h)) below its centre.
//!
//! # Validity
//!
//! Exact for balls, boxes, convex and closed meshes at every attitude. Cylinders, cones and
//! capsules are prisms and lathed bodies with 48 sides and the true volume; the rounding of an edge
//! is left out. Colliders that overlap count twice; sensors count nothing.
//!
//! # References
//!
//! Mirtich 1996 (volume integrals of polyhedra); spherical cap: any table.

use crate::convert::{rotation, vector};
use crate::scales::water::{RINGS, SIDES};
use ::nalgebra::{UnitQuaternion, Vector3};
use core::f64::consts::{PI, TAU};
use rapier::geometry::{Shape, TypedShape};
use serde::{Deserialize, Serialize};

/// Triangles of a shape: corners and indices.
type Mesh = (Vec<Vector3<f64>>, Vec<[u32; 3]>);

/// A part of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Part {
    Ball { centre: Vector3<f64>, radius: f64 },
    Mesh { corners: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]> },
}

/// Volume and centroid of what is wet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Wet {
    /// Volume in m^3.
    pub volume: f64,
    /// Centroid in m, in the axes of the body from its origin; that of the whole where it is dry.
    pub centre: Vector3<f64>,
}

/// The volume of a body, in its axes from its origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hull {
    parts: Vec<Part>,
    volume: f64,
    centre: Vector3<f64>,
    /// Radius in m about the centre within which all of it is.
    radius: f64,
    /// Displaced volume over that of the parts.
    share: f64,
}

impl Hull {
    /// Returns the volume of shapes, each with its position (m) and rotation in the axes of the
    /// body; `None` if one of them encloses none (a half space, a height field), or there are none.
    pub fn of_shapes<'a>(
        shapes: impl IntoIterator<Item = (&'a dyn Shape, Vector3<f64>, UnitQuaternion<f64>)>,
    ) -> Option<Self> {
        let mut parts = Vec::new();
        for (shape, position, turn) in shapes {
            add_parts(shape, &position, &turn, &mut parts)?;
        }
        Self::of_parts(parts)
    }

    /// Returns a ball of a volume (m^3) about a point (m).
    pub fn ball(volume: f64, centre: Vector3<f64>) -> Option<Self> {
        Self::of_parts(vec![Part::Ball { centre, radius: libm::cbrt(volume / PI * 0.75) }])
    }

    fn of_parts(parts: Vec<Part>) -> Option<Self> {
        let whole = parts.iter().map(Part::whole).fold((0.0, Vector3::zeros()), add);
        let volume = whole.0;
        if !(volume > 0.0 && volume.is_finite()) {
            return None;
        }
        let centre = whole.1 / volume;
        let radius = parts.iter().map(|part| part.reach(&centre)).fold(0.0, f64::max);
        Some(Hull { parts, volume, centre, radius, share: 1.0 })
    }

    /// Returns the same hull with another volume (m^3): all that is displaced is scaled, not the
    /// shape.
    pub fn with_volume(mut self, volume: f64) -> Self {
        self.share *= volume / self.volume;
        self.volume = volume;
        self
    }

    /// Returns its volume in m^3.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Returns its centroid in m, in the axes of the body from its origin.
    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// Returns the radius in m about the centroid within which all of it is.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns what is below a plane: `normal` its unit normal, upwards, in the axes of the body,
    /// and `depth` how far the centroid is below it in m.
    pub fn below(&self, normal: &Vector3<f64>, depth: f64) -> Wet {
        if depth >= self.radius {
            return Wet { volume: self.volume, centre: self.centre };
        }
        if depth <= -self.radius {
            return Wet { volume: 0.0, centre: self.centre };
        }
        let point = self.centre + normal * depth;
        let (volume, moment) =
            self.parts.iter().map(|part| part.below(normal, &point)).fold((0.0, Vector3::zeros()), add);
        // what is left of a cut that touches no more than a corner is rounding
        if volume <= f64::EPSILON * self.volume / self.share {
            return Wet { volume: 0.0, centre: self.centre };
        }
        Wet { volume: (volume * self.share).min(self.volume), centre: moment / volume }
    }
}

/// Volume, and volume times centroid.
type Moments = (f64, Vector3<f64>);

fn add(a: Moments, b: Moments) -> Moments {
    (a.0 + b.0, a.1 + b.1)
}

impl Part {
    fn whole(&self) -> Moments {
        match self {
            Part::Ball { centre, radius } => {
                let volume = 4.0 / 3.0 * PI * radius.powi(3);
                (volume, centre * volume)
            }
            Part::Mesh { corners, triangles } => {
                let corner = |i: u32| corners[i as usize];
                let from = corners[0];
                let tetrahedra = triangles.iter().map(|t| tetrahedron(&from, &t.map(corner)));
                tetrahedra.fold((0.0, Vector3::zeros()), add)
            }
        }
    }

    fn reach(&self, from: &Vector3<f64>) -> f64 {
        match self {
            Part::Ball { centre, radius } => (centre - from).norm() + radius,
            Part::Mesh { corners, .. } => corners.iter().map(|x| (x - from).norm()).fold(0.0, f64::max),
        }
    }

    /// Returns what is below the plane through a point.
    fn below(&self, normal: &Vector3<f64>, point: &Vector3<f64>) -> Moments {
        match self {
            Part::Ball { centre, radius } => {
                let h = normal.dot(&(point - centre)).clamp(-radius, *radius);
                let volume = PI / 3.0 * (radius + h).powi(2) * (2.0 * radius - h);
                let down = 0.75 * (radius - h).powi(2) / (2.0 * radius - h);
                (volume, (centre - normal * down) * volume)
            }
            Part::Mesh { corners, triangles } => {
                // the point of the plane that is nearest to the body, for rounding
                let from = corners[0] + normal * normal.dot(&(point - corners[0]));
                let mut sum = (0.0, Vector3::zeros());
                for triangle in triangles {
                    let [a, b, c] = triangle.map(|i| corners[i as usize]);
                    sum = add(sum, cut(&from, normal, [a, b, c]));
                }
                sum
            }
        }
    }
}

/// Returns the moments of the tetrahedron between a point and a triangle.
fn tetrahedron(from: &Vector3<f64>, [a, b, c]: &[Vector3<f64>; 3]) -> Moments {
    let volume = (a - from).dot(&(b - from).cross(&(c - from))) / 6.0;
    (volume, (a + b + c + from) * (0.25 * volume))
}

/// Returns the moments between a point of a plane and what of a triangle is below it.
fn cut(from: &Vector3<f64>, normal: &Vector3<f64>, triangle: [Vector3<f64>; 3]) -> Moments {
    let depth = triangle.map(|x| normal.dot(&(from - x)));
    let below = depth.iter().filter(|d| **d > 0.0).count();
    match below {
        0 => (0.0, Vector3::zeros()),
        3 => tetrahedron(from, &triangle),
        _ => {
            // the corner that is alone on its side comes first
            let alone = (0..3).find(|&i| (depth[i] > 0.0) == (below == 1)).unwrap_or(0);
            let [i, j, k] = [alone, (alone + 1) % 3, (alone + 2) % 3];
            let meet =
                |a: usize, b: usize| triangle[a] + (triangle[b] - triangle[a]) * (depth[a] / (depth[a] - depth[b]));
            let (p, q) = (meet(i, j), meet(i, k));
            if below == 1 {
                tetrahedron(from, &[triangle[i], p, q])
            } else {
                add(tetrahedron(from, &[p, triangle[j], triangle[k]]), tetrahedron(from, &[p, triangle[k], q]))
            }
        }
    }
}

/// Adds the parts of a shape; `None` if it encloses no volume.
fn add_parts(
    shape: &dyn Shape,
    position: &Vector3<f64>,
    turn: &UnitQuaternion<f64>,
    parts: &mut Vec<Part>,
) -> Option<()> {
    let points = |list: Vec<rapier::math::Vector>| list.into_iter().map(vector).collect::<Vec<_>>();
    let (corners, triangles): Mesh = match shape.as_typed_shape() {
        TypedShape::Ball(ball) => {
            parts.push(Part::Ball { centre: *position, radius: f64::from(ball.radius) });
            return Some(());
        }
        TypedShape::Cuboid(cuboid) => of_points(points, cuboid.to_trimesh()),
        TypedShape::RoundCuboid(round) => of_points(points, round.inner_shape.to_trimesh()),
        TypedShape::ConvexPolyhedron(hull) => of_points(points, hull.to_trimesh()),
        TypedShape::RoundConvexPolyhedron(round) => of_points(points, round.inner_shape.to_trimesh()),
        TypedShape::TriMesh(mesh) => (mesh.vertices().iter().map(|x| vector(*x)).collect(), mesh.indices().to_vec()),
        TypedShape::Cylinder(own) => cylinder(f64::from(own.half_height), f64::from(own.radius)),
        TypedShape::RoundCylinder(round) => {
            cylinder(f64::from(round.inner_shape.half_height), f64::from(round.inner_shape.radius))
        }
        TypedShape::Cone(own) => cone(f64::from(own.half_height), f64::from(own.radius)),
        TypedShape::RoundCone(round) => {
            cone(f64::from(round.inner_shape.half_height), f64::from(round.inner_shape.radius))
        }
        TypedShape::Capsule(own) => {
            let [a, b] = [own.segment.a, own.segment.b].map(vector);
            let along = UnitQuaternion::rotation_between(&Vector3::y(), &(b - a))
                .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI));
            let (corners, triangles) = capsule(0.5 * (b - a).norm(), f64::from(own.radius));
            (corners.into_iter().map(|x| along * x + 0.5 * (a + b)).collect(), triangles)
        }
        TypedShape::Compound(compound) => {
            for (pose, shape) in compound.shapes() {
                let (at, own) = (vector(pose.translation), rotation(pose.rotation));
                add_parts(&**shape, &(position + turn * at), &(turn * own), parts)?;
            }
            return Some(());
        }
        _ => return None,
    };
    let part = Part::Mesh { corners: corners.into_iter().map(|x| position + turn * x).collect(), triangles };
    (part.whole().0 > 0.0).then(|| parts.push(part))
}

fn of_points<P>(points: impl Fn(Vec<P>) -> Vec<Vector3<f64>>, (list, triangles): (Vec<P>, Vec<[u32; 3]>)) -> Mesh {
    (points(list), triangles)
}

/// Returns the area of a regular polygon with a circle of radius 1 about it, over that of the
/// circle.
fn polygon_share() -> f64 {
    libm::sin(TAU / f64::from(SIDES)) * f64::from(SIDES) / TAU
}

fn cylinder(half: f64, radius: f64) -> Mesh {
    let r = radius / polygon_share().sqrt();
    lathe(&[[-half, r], [half, r]], -half, half)
}

fn cone(half: f64, radius: f64) -> Mesh {
    lathe(&[[-half, radius / polygon_share().sqrt()]], -half, half)
}

fn capsule(half: f64, radius: f64) -> Mesh {
    let ring = |i: u32| libm::sincos(PI * f64::from(i) / f64::from(2 * RINGS));
    let below = (1..=RINGS).map(&ring).map(|(s, c)| [-half - radius * c, radius * s]);
    let above = (RINGS..2 * RINGS).map(&ring).map(|(s, c)| [half - radius * c, radius * s]);
    let rings: Vec<[f64; 2]> = below.chain(above).collect();
    let (mut corners, triangles) = lathe(&rings, -half - radius, half + radius);
    // its true volume, by a scale of all radii
    let exact = PI * radius * radius * (2.0 * half + 4.0 / 3.0 * radius);
    let part = Part::Mesh { corners: corners.clone(), triangles: triangles.clone() };
    let wider = (exact / part.whole().0).sqrt();
    corners.iter_mut().for_each(|x| (x.x, x.z) = (x.x * wider, x.z * wider));
    (corners, triangles)
}

/// Returns the body of revolution about y with rings of height and radius, upwards, between two
/// poles.
fn lathe(rings: &[[f64; 2]], bottom: f64, top: f64) -> Mesh {
    let (n, count) = (SIDES, rings.len() as u32);
    let mut corners = vec![Vector3::new(0.0, bottom, 0.0), Vector3::new(0.0, top, 0.0)];
    for [y, r] in rings {
        corners.extend((0..n).map(|i| {
            let (s, c) = libm::sincos(TAU * f64::from(i) / f64::from(n));
            Vector3::new(r * c, *y, r * s)
        }));
    }
    let at = |ring: u32, i: u32| 2 + ring * n + i % n;
    let mut triangles = Vec::new();
    for i in 0..n {
        triangles.push([0, at(0, i), at(0, i + 1)]);
        triangles.push([1, at(count - 1, i + 1), at(count - 1, i)]);
        for ring in 1..count {
            let [a, b, c, d] = [at(ring - 1, i), at(ring - 1, i + 1), at(ring, i), at(ring, i + 1)];
            triangles.push([a, c, b]);
            triangles.push([b, c, d]);
        }
    }
    (corners, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rapier::geometry::SharedShape;

    fn hull(shape: &SharedShape) -> Hull {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.2, 0.9));
        Hull::of_shapes([(&**shape, Vector3::new(0.3, -0.1, 0.2), turn)]).unwrap()
    }

    /// *Source.* The volumes of the shapes; half of a body that is symmetric about its centre is
    /// below it.
    #[test]
    fn shapes_have_their_volume_and_half_of_it_below_their_centre() {
        let volumes = [
            (SharedShape::ball(0.5), PI / 6.0),
            (SharedShape::cuboid(0.5, 0.25, 1.0), 1.0),
            (SharedShape::cylinder(0.5, 0.25), PI / 16.0),
            (SharedShape::capsule_y(0.5, 0.25), PI / 16.0 + PI / 48.0),
        ];
        for (shape, volume) in volumes {
            let hull = hull(&shape);
            assert!((hull.volume() / volume - 1.0).abs() < 1e-6, "{} {volume}", hull.volume());
            let normal = Vector3::new(0.2, 0.8, -0.4).normalize();
            assert!((hull.below(&normal, 0.0).volume / volume - 0.5).abs() < 1e-6);
            assert_eq!(hull.below(&normal, 5.0).volume, hull.volume());
            assert_eq!(hull.below(&normal, -5.0).volume, 0.0);
        }
        assert!(Hull::of_shapes([]).is_none());
        let half_space = SharedShape::halfspace(rapier::math::Vector::new(0.0, 1.0, 0.0));
        assert!(Hull::of_shapes([(&*half_space, Vector3::zeros(), UnitQuaternion::identity())]).is_none());
    }

    /// *Source.* The derivative of the volume by the depth is the area of the cut, and its moment
    /// that of the area: by sums of the volumes themselves, V(d) = sum of slices; the closed forms
    /// of the ball; an upright box.
    #[test]
    fn what_is_below_a_plane_is_exact_for_a_box_and_a_ball() {
        let upright =
            |shape: &SharedShape| Hull::of_shapes([(&**shape, Vector3::zeros(), UnitQuaternion::identity())]).unwrap();
        let (cube, ball) = (upright(&SharedShape::cuboid(0.5, 0.25, 1.0)), upright(&SharedShape::ball(0.5)));
        for depth in [-0.2, -0.05, 0.0, 0.13, 0.24] {
            let wet = cube.below(&Vector3::y(), depth);
            assert!((wet.volume - 2.0 * (0.25 + depth)).abs() < 1e-12, "{wet:?}");
            assert!((wet.centre - Vector3::new(0.0, 0.5 * (depth - 0.25), 0.0)).norm() < 1e-12, "{wet:?}");
        }
        for depth in [-0.4, -0.1, 0.0, 0.2, 0.49] {
            let wet = ball.below(&Vector3::z(), depth);
            let n = 100_000;
            let slice = |i: usize| -0.5 + (depth + 0.5) * (i as f64 + 0.5) / n as f64;
            let area = |z: f64| PI * (0.25 - z * z) * (depth + 0.5) / n as f64;
            let volume: f64 = (0..n).map(|i| area(slice(i))).sum();
            let moment: f64 = (0..n).map(|i| area(slice(i)) * slice(i)).sum();
            assert!((wet.volume - volume).abs() < 1e-9 && (wet.centre.z - moment / volume).abs() < 1e-8, "{wet:?}");
        }
    }
}
