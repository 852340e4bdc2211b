//! A checked `[[body]]`, and where a fixed or kinematic one is at any time.

use lariat_ancf::Vector3;
use nalgebra::UnitQuaternion;

/// What moves a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKind {
    /// Forces.
    Dynamic,
    /// Nothing.
    Fixed,
    /// Its path, or its constant velocity.
    Kinematic,
}

/// The shape of a body, about its origin, in m.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyShape {
    /// No shape: it meets nothing.
    None,
    /// Half extents.
    Cuboid(Vector3<f64>),
    /// Radius.
    Ball(f64),
    /// Half height along y, and radius.
    Cylinder([f64; 2]),
    /// Half height of the cylindrical part along y, and radius.
    Capsule([f64; 2]),
    /// A half space: the unit normal of its surface, which goes through the origin.
    Plane(Vector3<f64>),
    /// Triangles; a dynamic body takes their convex hull.
    Mesh {
        /// Corners.
        vertices: Vec<[f64; 3]>,
        /// Three corners each.
        triangles: Vec<[u32; 3]>,
    },
}

/// How heavy a dynamic body is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyMass {
    /// In kg.
    Mass(f64),
    /// In kg/m^3, of the shape.
    Density(f64),
}

/// A checked body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyScene {
    /// Name.
    pub name: String,
    /// What moves it.
    pub kind: BodyKind,
    /// Shape.
    pub shape: BodyShape,
    /// Mass; `None` if it is not dynamic.
    pub mass: Option<BodyMass>,
    /// Moments of inertia in kg m^2 about the axes of the body through its centre of mass; `None` = those of the shape.
    pub inertia: Option<Vector3<f64>>,
    /// Origin at t = 0 in m.
    pub position: Vector3<f64>,
    /// Attitude at t = 0.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of the origin in m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity in rad/s, world axes.
    pub angular_velocity: Vector3<f64>,
    /// Coefficient of friction; `None` = Rapier's.
    pub friction: Option<f64>,
    /// Places at times, in s and m; times ascend. Empty: none.
    pub path: Vec<(f64, Vector3<f64>)>,
}

impl BodyScene {
    /// Origin and attitude that the scene gives at a time (s). A dynamic body is only there at t = 0.
    pub fn pose(&self, time: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        if self.kind != BodyKind::Kinematic {
            return (self.position, self.rotation);
        }
        let place = if self.path.is_empty() { self.position + self.velocity * time } else { along(&self.path, time).0 };
        (place, UnitQuaternion::from_scaled_axis(self.angular_velocity * time) * self.rotation)
    }

    /// Velocity of the origin (m/s) that the scene gives at a time (s); at a row of the path that of the part which begins there.
    pub fn velocity(&self, time: f64) -> Vector3<f64> {
        if self.path.is_empty() { self.velocity } else { along(&self.path, time).1 }
    }

    /// A point of the body, in body axes, as a point of the world at t = 0.
    pub fn to_world(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let (place, attitude) = self.pose(0.0);
        place + attitude * point
    }
}

/// Place and velocity on a path: linear between rows, constant before the first and after the last.
fn along(path: &[(f64, Vector3<f64>)], time: f64) -> (Vector3<f64>, Vector3<f64>) {
    let next = path.partition_point(|(t, _)| *t <= time);
    match (next.checked_sub(1).and_then(|i| path.get(i)), path.get(next)) {
        (Some((t0, x0)), Some((t1, x1))) => {
            let velocity = (x1 - x0) / (t1 - t0);
            (x0 + velocity * (time - t0), velocity)
        }
        (Some((_, x)), None) | (None, Some((_, x))) => (*x, Vector3::zeros()),
        (None, None) => (Vector3::zeros(), Vector3::zeros()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_linear_between_its_rows_and_constant_outside() {
        let path = [(1.0, Vector3::zeros()), (2.0, Vector3::new(0.0, 4.0, 0.0)), (4.0, Vector3::new(0.0, 2.0, 0.0))];
        for (time, y, v) in [
            (0.0, 0.0, 0.0),
            (1.0, 0.0, 4.0),
            (1.5, 2.0, 4.0),
            (2.0, 4.0, -1.0),
            (3.0, 3.0, -1.0),
            (4.0, 2.0, 0.0),
            (9.0, 2.0, 0.0),
        ] {
            let (place, velocity) = along(&path, time);
            assert_eq!((place.y, velocity.y), (y, v), "t = {time}");
        }
    }

    #[test]
    fn a_point_of_a_turned_body_goes_to_the_world() {
        let body = BodyScene {
            name: "hook".to_string(),
            kind: BodyKind::Kinematic,
            shape: BodyShape::None,
            mass: None,
            inertia: None,
            position: Vector3::new(1.0, 2.0, 3.0),
            rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2)),
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            friction: None,
            path: Vec::new(),
        };
        let point = Vector3::new(1.0, 0.0, 0.0);
        let world = body.to_world(&point);
        assert!((world - Vector3::new(1.0, 3.0, 3.0)).norm() < 1e-15);
    }
}
