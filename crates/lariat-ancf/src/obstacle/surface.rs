//! The surface of an obstacle: what a shape must be able to tell.

use super::patch::Patch;
use core::fmt::Debug;
use nalgebra::Vector3;

/// The point of a surface that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// What the surface looks like there.
    pub patch: Patch,
    /// Distance in m; negative inside.
    pub distance: f64,
    /// Whether a [`Feature`] covers the place: if it is thin, the closest point of an element acts
    /// on it, in place of samples.
    pub feature: bool,
}

/// A sharp or round part of a surface that a cable can meet between its samples: an edge, a corner,
/// a rod, a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feature {
    /// Number of the feature within its surface, the same in every call.
    pub id: u32,
    /// Its core.
    pub shape: FeatureShape,
    /// Radius in m about the core; 0 for edges and corners.
    pub radius: f64,
}

/// The core of a feature, in the obstacle's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FeatureShape {
    /// A point.
    Point(Vector3<f64>),
    /// A segment without its ends.
    Segment(Vector3<f64>, Vector3<f64>),
    /// A circle of a radius (m) about a centre, in the plane with a unit normal.
    Circle {
        /// Its centre.
        centre: Vector3<f64>,
        /// Unit normal of its plane.
        normal: Vector3<f64>,
        /// Its radius in m.
        radius: f64,
    },
}

/// A shape in its own axes, SI units.
///
/// A shape that is not convex must return the nearest of all its parts. One without an inside (a
/// mesh that is not closed) returns distances above zero, and patches that face the point.
pub trait Surface: Debug + Send + Sync {
    /// Returns the nearest point of the surface.
    fn nearest(&self, point: &Vector3<f64>) -> Nearest;

    /// Calls `visit` with every feature that may be within a ball of `radius` (m) about `centre`,
    /// others too if that is cheaper.
    fn features(&self, centre: &Vector3<f64>, radius: f64, visit: &mut dyn FnMut(Feature));

    /// Returns the corners of a box about the shape; `None` for one without bounds.
    fn bounds(&self) -> Option<[Vector3<f64>; 2]>;

    /// Returns whether it has many plane faces, as a mesh. Default: no.
    fn has_facets(&self) -> bool {
        false
    }

    /// Returns false only if no point of the shape is within a ball of `radius` (m) about `centre`.
    /// By its bounds, or without them by its distance; a shape of many parts knows better.
    fn may_meet(&self, centre: &Vector3<f64>, radius: f64) -> bool {
        match self.bounds() {
            Some([low, high]) => {
                let outside = (low - centre).sup(&(centre - high)).sup(&Vector3::zeros());
                outside.norm_squared() <= radius * radius
            }
            None => self.nearest(centre).distance <= radius,
        }
    }
}

impl Feature {
    /// Returns the patch that a point nearest to the core sees, and the vector from the core to it;
    /// `None` if the nearest point of a segment is an end, which belongs to another feature.
    #[inline]
    pub(crate) fn patch(&self, point: &Vector3<f64>) -> Option<(Patch, Vector3<f64>)> {
        let radius = self.radius;
        match self.shape {
            FeatureShape::Point(p) => Some((Patch::Point { point: p, radius }, point - p)),
            FeatureShape::Segment(a, b) => {
                let along = b - a;
                let t = (point - a).dot(&along) / along.norm_squared();
                let patch = Patch::Line { point: a, direction: along.normalize(), radius };
                (t > 0.0 && t < 1.0).then(|| (patch, point - a - t * along))
            }
            FeatureShape::Circle { centre, normal, radius: ring } => {
                let z = point - centre;
                let radial = (z - normal * normal.dot(&z)).try_normalize(1e-12)?;
                let core = centre + ring * radial;
                Some((Patch::Line { point: core, direction: normal.cross(&radial), radius }, point - core))
            }
        }
    }

    /// Returns the point of the core that is nearest to a point, ends included.
    #[inline]
    pub(crate) fn core(&self, point: &Vector3<f64>) -> Vector3<f64> {
        match self.shape {
            FeatureShape::Point(p) => p,
            FeatureShape::Segment(a, b) => {
                let along = b - a;
                a + along * ((point - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0)
            }
            FeatureShape::Circle { centre, normal, radius } => {
                let z = point - centre;
                centre + radius * (z - normal * normal.dot(&z)).try_normalize(1e-12).unwrap_or_default()
            }
        }
    }

    /// Returns the square of the distance of a point from the core, ends included.
    #[inline]
    pub(crate) fn distance_squared(&self, point: &Vector3<f64>) -> f64 {
        (point - self.core(point)).norm_squared()
    }
}
