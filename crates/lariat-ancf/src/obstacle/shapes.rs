//! Shapes in closed form.

use super::patch::Patch;
use super::surface::{Feature, FeatureShape, Nearest, Surface};
use nalgebra::Vector3;

/// Everything below a plane through the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Outward unit normal.
    pub normal: Vector3<f64>,
}

/// A ball about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Radius in m.
    pub radius: f64,
}

/// A segment with a radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Ends of the segment in m.
    pub ends: [Vector3<f64>; 2],
    /// Radius in m; 0 makes an edge.
    pub radius: f64,
}

/// A cylinder about the y axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Half of its height in m.
    pub half_height: f64,
    /// Radius in m.
    pub radius: f64,
}

/// A box about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Halves of its sides in m.
    pub half_extents: Vector3<f64>,
}

impl Surface for HalfSpace {
    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let patch = Patch::Plane { point: Vector3::zeros(), normal: self.normal };
        Nearest { patch, distance: self.normal.dot(y), feature: false }
    }

    fn features(&self, _: &Vector3<f64>, _: f64, _: &mut dyn FnMut(Feature)) {}

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        None
    }
}

impl Surface for Ball {
    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let patch = Patch::Point { point: Vector3::zeros(), radius: self.radius };
        Nearest { patch, distance: y.norm() - self.radius, feature: true }
    }

    fn features(&self, _: &Vector3<f64>, _: f64, visit: &mut dyn FnMut(Feature)) {
        visit(Feature { id: 0, shape: FeatureShape::Point(Vector3::zeros()), radius: self.radius });
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        Some([Vector3::repeat(-self.radius), Vector3::repeat(self.radius)])
    }
}

impl Surface for Capsule {
    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let ([a, b], radius) = (self.ends, self.radius);
        let along = b - a;
        let t = (y - a).dot(&along) / along.norm_squared();
        let (point, patch) = if t > 0.0 && t < 1.0 {
            (a + t * along, Patch::Line { point: a, direction: along.normalize(), radius })
        } else {
            let end = if t >= 1.0 { b } else { a };
            (end, Patch::Point { point: end, radius })
        };
        Nearest { patch, distance: (y - point).norm() - radius, feature: true }
    }

    fn features(&self, _: &Vector3<f64>, _: f64, visit: &mut dyn FnMut(Feature)) {
        let ([a, b], radius) = (self.ends, self.radius);
        if a != b {
            visit(Feature { id: 0, shape: FeatureShape::Segment(a, b), radius });
            visit(Feature { id: 2, shape: FeatureShape::Point(b), radius });
        }
        visit(Feature { id: 1, shape: FeatureShape::Point(a), radius });
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        let ([a, b], r) = (self.ends, Vector3::repeat(self.radius));
        Some([a.inf(&b) - r, a.sup(&b) + r])
    }
}

impl Surface for Cylinder {
    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let Cylinder { half_height, radius } = *self;
        let radial = Vector3::new(y.x, 0.0, y.z);
        let side = radial.norm() - radius;
        let end = y.y.abs() - half_height;
        let up = Vector3::y() * y.y.signum();
        if side > 0.0 && end > 0.0 {
            let outward = radial.normalize();
            let point = radius * outward + half_height * up;
            let patch = Patch::Line { point, direction: Vector3::y().cross(&outward), radius: 0.0 };
            return Nearest { patch, distance: side.hypot(end), feature: true };
        }
        if end > side {
            return Nearest {
                patch: Patch::Plane { point: half_height * up, normal: up },
                distance: end,
                feature: false,
            };
        }
        let patch = Patch::Line { point: Vector3::zeros(), direction: Vector3::y(), radius };
        Nearest { patch, distance: side, feature: true }
    }

    fn features(&self, _: &Vector3<f64>, _: f64, visit: &mut dyn FnMut(Feature)) {
        let (end, normal) = (self.half_height * Vector3::y(), Vector3::y());
        visit(Feature { id: 0, shape: FeatureShape::Segment(-end, end), radius: self.radius });
        for (id, centre) in [(1, end), (2, -end)] {
            let shape = FeatureShape::Circle { centre, normal, radius: self.radius };
            visit(Feature { id, shape, radius: 0.0 });
        }
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        let corner = Vector3::new(self.radius, self.half_height, self.radius);
        Some([-corner, corner])
    }
}

impl Surface for Cuboid {
    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let half = self.half_extents;
        let sign = Vector3::from_fn(|i, _| if y[i] < 0.0 { -1.0 } else { 1.0 });
        let corner = half.component_mul(&sign);
        let beyond = y.abs() - half;
        let outside = [beyond.x > 0.0, beyond.y > 0.0, beyond.z > 0.0];
        match outside.iter().filter(|o| **o).count() {
            3 => Nearest { patch: Patch::Point { point: corner, radius: 0.0 }, distance: beyond.norm(), feature: true },
            2 => {
                let axis = outside.iter().position(|o| !o).unwrap_or(0);
                let mut point = corner;
                point[axis] = 0.0;
                let mut z = y - point;
                z[axis] = 0.0;
                let patch = Patch::Line { point, direction: Vector3::ith(axis, 1.0), radius: 0.0 };
                Nearest { patch, distance: z.norm(), feature: true }
            }
            _ => {
                let axis = beyond.imax();
                let normal = Vector3::ith(axis, sign[axis]);
                let patch = Patch::Plane { point: normal * half[axis], normal };
                Nearest { patch, distance: beyond[axis], feature: false }
            }
        }
    }

    fn features(&self, _: &Vector3<f64>, _: f64, visit: &mut dyn FnMut(Feature)) {
        let half = self.half_extents;
        let corner = |i: u32| Vector3::from_fn(|axis, _| if (i >> axis) & 1 == 1 { half[axis] } else { -half[axis] });
        let mut id = 0;
        for i in 0..8 {
            for axis in (0..3).filter(|axis| (i >> axis) & 1 == 0) {
                visit(Feature { id, shape: FeatureShape::Segment(corner(i), corner(i | 1 << axis)), radius: 0.0 });
                id += 1;
            }
        }
        for i in 0..8 {
            visit(Feature { id: id + i, shape: FeatureShape::Point(corner(i)), radius: 0.0 });
        }
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        Some([-self.half_extents, self.half_extents])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Around every shape the distance is that of the patch, and its gradient the patch's normal;
    /// so the patch touches the surface at the nearest point. The features of the box and the
    /// cylinder are where two faces meet.
    ///
    /// *Source.* The patch's own formulas, and central differences of the distance.
    #[test]
    fn the_patch_of_the_nearest_point_has_its_distance_and_direction() {
        let shapes: [Box<dyn Surface>; 5] = [
            Box::new(HalfSpace { normal: Vector3::new(0.0, 0.6, 0.8) }),
            Box::new(Ball { radius: 0.3 }),
            Box::new(Capsule { ends: [Vector3::new(0.1, 0.2, 0.0), Vector3::new(-0.2, 0.1, 0.4)], radius: 0.1 }),
            Box::new(Cylinder { half_height: 0.4, radius: 0.3 }),
            Box::new(Cuboid { half_extents: Vector3::new(0.3, 0.2, 0.4) }),
        ];
        for shape in &shapes {
            for i in 0..343 {
                let y =
                    Vector3::new(f64::from(i % 7) - 3.1, f64::from(i / 7 % 7) - 2.9, f64::from(i / 49) - 3.05) * 0.2;
                let near = shape.nearest(&y);
                let (gap, normal) = near.patch.gap(&y);
                assert!((gap - near.distance).abs() < 1e-14, "{shape:?} {y:?}");
                let mut slope = Vector3::zeros();
                for k in 0..3 {
                    let d = 1e-7 * Vector3::ith(k, 1.0);
                    slope[k] = (shape.nearest(&(y + d)).distance - shape.nearest(&(y - d)).distance) / 2e-7;
                }
                assert!((slope - normal).norm() < 1e-6, "{shape:?} {y:?} {slope:?} {normal:?}");
                shape.features(&y, 1.0, &mut |feature| {
                    if let Some((patch, z)) = feature.patch(&y) {
                        let distance = z.norm() - feature.radius;
                        assert!((patch.gap(&y).0 - distance).abs() < 1e-14, "{feature:?}");
                        // within the shape, a face is nearer than the side behind it
                        assert!(near.distance < 0.0 || distance >= near.distance - 1e-14, "{shape:?} {feature:?}");
                    }
                });
            }
        }
    }
}
