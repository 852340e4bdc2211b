//! A cone: its side is the cylinder that osculates it.
//!
//! # Equation
//!
//! At distance s of a point of the side from the axis, along the normal, the radius of curvature is
//! `s/cos b` with the half angle b of the apex; the other curvature is zero. So the patch is the
//! cylinder along the generator whose axis passes through the foot of the normal on the cone's
//! axis.
//!
//! # Validity
//!
//! A cable meets the side by its samples, however sharp it is: near the tip it may sink in by a
//! part of its radius.

use ::nalgebra::Vector3;
use lariat_ancf::contact::{Feature, FeatureShape, Nearest, Patch, Surface};

/// A cone about the y axis, its apex at the top.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// Half of its height in m.
    pub half_height: f64,
    /// Radius of its base in m.
    pub radius: f64,
}

impl Surface for Cone {
    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let Cone { half_height: h, radius } = *self;
        let radial = Vector3::new(y.x, 0.0, y.z);
        let s = radial.norm();
        let outward = radial.try_normalize(0.0).unwrap_or_else(Vector3::x);
        // in the plane of the point: along the side from the rim to the apex
        let length = radius.hypot(2.0 * h);
        let (along, normal) = ([-radius / length, 2.0 * h / length], [2.0 * h / length, radius / length]);
        let (a, b) = (s - radius, y.y + h);
        let (t, side) = (a * along[0] + b * along[1], a * normal[0] + b * normal[1]);
        let base = -b;
        if t >= length && side > -f64::EPSILON {
            let point = h * Vector3::y();
            return Nearest { patch: Patch::Point { point, radius: 0.0 }, distance: (y - point).norm(), feature: true };
        }
        let in_base = s <= radius;
        if (side <= 0.0 || base > 0.0) && in_base && base >= side {
            let patch = Patch::Plane { point: -h * Vector3::y(), normal: -Vector3::y() };
            return Nearest { patch, distance: base, feature: false };
        }
        if t <= 0.0 {
            let point = radius * outward - h * Vector3::y();
            let patch = Patch::Line { point, direction: Vector3::y().cross(&outward), radius: 0.0 };
            return Nearest { patch, distance: (y - point).norm(), feature: true };
        }
        let n = outward * normal[0] + Vector3::y() * normal[1];
        let foot = outward * (radius + t * along[0]) + Vector3::y() * (t * along[1] - h);
        let curvature = ((radius + t * along[0]) / normal[0]).max(0.0);
        let direction = outward * along[0] + Vector3::y() * along[1];
        let patch = Patch::Line { point: foot - n * curvature, direction, radius: curvature };
        Nearest { patch, distance: side, feature: false }
    }

    fn features(&self, _: &Vector3<f64>, _: f64, visit: &mut dyn FnMut(Feature)) {
        let (end, normal) = (self.half_height * Vector3::y(), Vector3::y());
        visit(Feature { id: 0, shape: FeatureShape::Point(end), radius: 0.0 });
        let shape = FeatureShape::Circle { centre: -end, normal, radius: self.radius };
        visit(Feature { id: 1, shape, radius: 0.0 });
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        let corner = Vector3::new(self.radius, self.half_height, self.radius);
        Some([-corner, corner])
    }
}
