//! Surfaces made of others: parts with poses, and shapes with a rounded border.

use ::nalgebra::{UnitQuaternion, Vector3};
use lariat_ancf::contact::{Feature, FeatureShape, Nearest, Patch, Surface};

/// Layout: bits of a feature's number that are its part's own.
const PART: u32 = 16;

/// A shape within another's axes.
#[derive(Debug)]
pub(super) struct Part {
    surface: Box<dyn Surface>,
    position: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
}

impl Part {
    pub fn new(surface: Box<dyn Surface>, position: Vector3<f64>, rotation: UnitQuaternion<f64>) -> Self {
        Part { surface, position, rotation }
    }

    fn to_own(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.inverse() * (x - self.position)
    }

    fn point(&self, y: Vector3<f64>) -> Vector3<f64> {
        self.position + self.rotation * y
    }

    fn patch(&self, patch: Patch) -> Patch {
        match patch {
            Patch::Plane { point, normal } => Patch::Plane { point: self.point(point), normal: self.rotation * normal },
            Patch::Line { point, direction, radius } => {
                Patch::Line { point: self.point(point), direction: self.rotation * direction, radius }
            }
            Patch::Point { point, radius } => Patch::Point { point: self.point(point), radius },
        }
    }

    fn feature(&self, number: usize, feature: Feature) -> Feature {
        let shape = match feature.shape {
            FeatureShape::Point(p) => FeatureShape::Point(self.point(p)),
            FeatureShape::Segment(a, b) => FeatureShape::Segment(self.point(a), self.point(b)),
            FeatureShape::Circle { centre, normal, radius } => {
                FeatureShape::Circle { centre: self.point(centre), normal: self.rotation * normal, radius }
            }
        };
        Feature { id: (number as u32) << PART | feature.id, shape, ..feature }
    }
}

/// The union of parts.
#[derive(Debug)]
pub(super) struct Compound {
    parts: Vec<Part>,
    bounds: Option<[Vector3<f64>; 2]>,
}

impl Compound {
    pub fn new(parts: Vec<Part>) -> Self {
        let mut bounds = Some([Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)]);
        for part in &parts {
            bounds = bounds.zip(part.surface.bounds()).map(|([low, high], [a, b])| {
                let corners = (0..8).map(|i| {
                    part.point(Vector3::from_fn(|axis, _| if (i >> axis) & 1 == 1 { a[axis] } else { b[axis] }))
                });
                corners.fold([low, high], |[low, high], x| [low.inf(&x), high.sup(&x)])
            });
        }
        Compound { parts, bounds }
    }
}

impl Surface for Compound {
    fn has_facets(&self) -> bool {
        self.parts.iter().any(|part| part.surface.has_facets())
    }

    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let each = self.parts.iter().map(|part| {
            let nearest = part.surface.nearest(&part.to_own(y));
            Nearest { patch: part.patch(nearest.patch), ..nearest }
        });
        each.min_by(|a, b| a.distance.total_cmp(&b.distance)).unwrap_or(Nearest {
            patch: Patch::Point { point: Vector3::zeros(), radius: 0.0 },
            distance: f64::INFINITY,
            feature: false,
        })
    }

    fn features(&self, centre: &Vector3<f64>, radius: f64, visit: &mut dyn FnMut(Feature)) {
        for (number, part) in self.parts.iter().enumerate() {
            part.surface.features(&part.to_own(centre), radius, &mut |feature| visit(part.feature(number, feature)));
        }
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        self.bounds
    }

    fn may_meet(&self, centre: &Vector3<f64>, radius: f64) -> bool {
        self.parts.iter().any(|part| part.surface.may_meet(&part.to_own(centre), radius))
    }
}

/// A shape grown by a radius.
#[derive(Debug)]
pub(super) struct Rounded {
    pub inner: Box<dyn Surface>,
    /// The radius in m.
    pub border: f64,
}

impl Surface for Rounded {
    fn nearest(&self, y: &Vector3<f64>) -> Nearest {
        let Nearest { patch, distance, feature } = self.inner.nearest(y);
        let patch = match patch {
            Patch::Plane { point, normal } => Patch::Plane { point: point + self.border * normal, normal },
            Patch::Line { point, direction, radius } => Patch::Line { point, direction, radius: radius + self.border },
            Patch::Point { point, radius } => Patch::Point { point, radius: radius + self.border },
        };
        Nearest { patch, distance: distance - self.border, feature }
    }

    fn features(&self, centre: &Vector3<f64>, radius: f64, visit: &mut dyn FnMut(Feature)) {
        let border = self.border;
        self.inner.features(centre, radius, &mut |f| visit(Feature { radius: f.radius + border, ..f }));
    }

    fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        let border = Vector3::repeat(self.border);
        self.inner.bounds().map(|[low, high]| [low - border, high + border])
    }

    fn may_meet(&self, centre: &Vector3<f64>, radius: f64) -> bool {
        self.inner.may_meet(centre, radius + self.border)
    }
}
