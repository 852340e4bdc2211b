//! Joints between bodies in statics.
//!
//! # Equation
//!
//! With u a unit vector in the axes of the first frame, x the points of the frames and r the
//! rotation from the first to the second, in the world, a joint has the coordinates
//!
//! ```text
//! c = u . (x2 - x1)        along u
//! c = 2 u . im(r)          about u: 2 sin(angle/2) of a rotation about u
//! c = |x2 - x1|            distance
//! ```
//!
//! of which each stays between two bounds, equal ones for a coordinate that is held. A coordinate
//! has the potential of an augmented Lagrangian,
//!
//! ```text
//! V = k/2 (m - p)^2        m = c + l/k,  p = m between the bounds
//! ```
//!
//! whose forces are those of the multiplier k (m - p). It becomes l when the search has come to
//! rest, and the search begins again, until the multipliers stay: then c is within its bounds, and
//! k has no part in the result.
//!
//! # Validity
//!
//! Rotations of less than pi between the frames. Joints that hold more than they need to do are
//! allowed: their multipliers are not unique, the shape is.
//!
//! # References
//!
//! Nocedal & Wright, Numerical Optimization, 2006, section 17.3 (augmented Lagrangian); its
//! derivatives by expansion in exp(d1), exp(d2), compared with differences below.
//!
//! # Alternatives considered
//!
//! - Stiff springs without multipliers: they yield by load/k.
//! - Multipliers as unknowns of the border: joints that hold more than they need to do make it
//!   singular.

use super::super::body::RigidBody;
use super::super::coupling::CoupledInertia;
use super::super::hold::stack;
use super::super::rotation::skew;
use crate::error::{Error, require, require_finite};
use crate::island::bordered::Bordered;
use crate::scales::statics::{JOINT_STAYS, JOINT_STIFFNESS};
use core::f64::consts::PI;
use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};

/// A frame of a joint on a body, from its centre of mass and in its axes, or in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointFrame {
    /// Point in m.
    pub position: Vector3<f64>,
    /// Axes.
    pub rotation: UnitQuaternion<f64>,
}

/// A joint between two bodies, or a body and the world, in statics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticJoint {
    /// Indices of the bodies; `None` is the world.
    pub bodies: [Option<usize>; 2],
    /// A frame on each of them.
    pub frames: [JointFrame; 2],
    /// Least and largest place in m of the second frame along the axes of the first: equal where
    /// it is held, infinite where it is free.
    pub along: [[f64; 2]; 3],
    /// Least and largest angle in rad of the second frame about the axes of the first.
    pub about: [[f64; 2]; 3],
    /// Largest distance in m between the points.
    pub distance: f64,
}

/// Layout: the bounds of a coordinate that is free.
pub const FREE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl StaticJoint {
    /// Checks that it fits `count` bodies.
    pub(super) fn check(&self, count: usize) -> Result<(), Error> {
        for body in self.bodies.into_iter().flatten() {
            require("body of a joint", body as f64, body < count, "the index of a body of the island")?;
        }
        self.frames.iter().try_for_each(|frame| require_finite("point of a joint (m)", &frame.position))?;
        for [least, largest] in self.along.iter().chain(&self.about) {
            // what is free has no number
            let number = if least.is_finite() { *least } else { 0.0 };
            require("bounds of a joint (m, rad)", number, least <= largest, "at most the upper one")?;
        }
        let number = if self.distance.is_finite() { self.distance } else { 0.0 };
        require("distance of a joint (m)", number, self.distance >= 0.0, ">= 0")
    }

    fn rows(&self, number: usize) -> impl Iterator<Item = Row> {
        let row = move |coordinate, bounds| Row { joint: number, coordinate, bounds, multiplier: 0.0 };
        let along = (0..3).map(move |x| row(Coordinate::Along(x), self.along[x]));
        let about = (0..3).map(move |x| {
            let [least, largest] = self.about[x].map(|angle| angle.clamp(-PI, PI));
            let (centre, bound) = (0.5 * (least + largest), 2.0 * (0.25 * (largest - least)).sin());
            let bounds = if largest - least < 2.0 * PI { [-bound, bound] } else { FREE };
            row(Coordinate::About(x, centre), bounds)
        });
        let distance = row(Coordinate::Distance, [f64::NEG_INFINITY, self.distance]);
        along.chain(about).chain([distance]).filter(|row| row.bounds.iter().any(|x| x.is_finite()))
    }
}

/// A coordinate of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Coordinate {
    /// Along an axis.
    Along(usize),
    /// About an axis, from an angle in rad on.
    About(usize, f64),
    /// Between the points.
    Distance,
}

/// A coordinate that is bounded.
#[derive(Clone, Copy, Debug)]
struct Row {
    joint: usize,
    coordinate: Coordinate,
    bounds: [f64; 2],
    /// l in N or N m.
    multiplier: f64,
}

/// A coordinate with its derivatives by the displacements and rotations, in world axes, of both
/// bodies.
#[derive(Clone, Copy, Debug)]
struct Jet {
    value: f64,
    slope: [Vector6<f64>; 2],
    /// Of the first, the second, and the first by the second.
    curvature: [Matrix6<f64>; 3],
}

/// All joints of an island, with their multipliers.
#[derive(Clone, Debug, Default)]
pub(in crate::island) struct Joints {
    list: Vec<StaticJoint>,
    rows: Vec<Row>,
    /// k in N/m, and in N m.
    stiffness: [f64; 2],
}

impl Joints {
    /// Of joints in an island of a stiffness (N/m) and a length (m).
    pub fn new(list: &[StaticJoint], stiffness: f64, length: f64) -> Self {
        let rows = list.iter().enumerate().flat_map(|(i, joint)| joint.rows(i)).collect();
        let stiffness = JOINT_STIFFNESS * stiffness;
        Joints { list: list.to_vec(), rows, stiffness: [stiffness, stiffness * length * length] }
    }

    /// Returns whether one holds a body to the world.
    pub fn hold(&self) -> bool {
        let holds = |row: &Row| !matches!(row.coordinate, Coordinate::About(..));
        self.rows.iter().any(|row| holds(row) && self.list[row.joint].bodies.contains(&None))
    }

    /// Lengthens the levers of bodies to those of the joints.
    pub fn lengthen(&self, levers: &mut [f64]) {
        for joint in &self.list {
            for (body, frame) in joint.bodies.iter().zip(&joint.frames) {
                if let Some(body) = body {
                    levers[*body] = levers[*body].max(frame.position.norm());
                }
            }
        }
    }

    fn stiffness_of(&self, row: &Row) -> f64 {
        self.stiffness[usize::from(matches!(row.coordinate, Coordinate::About(..)))]
    }

    /// Returns m - p of a row at the value of its coordinate.
    fn beyond(&self, row: &Row, value: f64) -> f64 {
        let m = value + row.multiplier / self.stiffness_of(row);
        m - m.clamp(row.bounds[0], row.bounds[1])
    }

    /// Returns the potential in J at coordinates `q`.
    pub fn energy(&self, bodies: &[RigidBody], q: impl Fn(usize) -> Pose) -> f64 {
        let of = |row: &Row| {
            let beyond = self.beyond(row, self.jet(row, bodies, &q).value);
            0.5 * self.stiffness_of(row) * beyond * beyond
        };
        self.rows.iter().map(of).sum()
    }

    /// Adds `scale` times the forces and torques to the rows of the bodies.
    pub fn add_forces(
        &self,
        scale: f64,
        bodies: &[RigidBody],
        q: impl Fn(usize) -> Pose,
        mut add: impl FnMut(usize, &Vector6<f64>),
    ) {
        for row in &self.rows {
            let jet = self.jet(row, bodies, &q);
            let multiplier = self.stiffness_of(row) * self.beyond(row, jet.value);
            for (body, slope) in self.list[row.joint].bodies.iter().zip(&jet.slope) {
                if let Some(body) = body {
                    add(*body, &(slope * (-multiplier * scale)));
                }
            }
        }
    }

    /// Adds `scale` times the stiffness to the matrix of the bodies.
    pub fn add_stiffness(&self, scale: f64, bodies: &[RigidBody], q: impl Fn(usize) -> Pose, matrix: &mut Bordered) {
        for row in &self.rows {
            let jet = self.jet(row, bodies, &q);
            let (k, beyond) = (self.stiffness_of(row), self.beyond(row, jet.value));
            let held = row.bounds[0] == row.bounds[1];
            if beyond == 0.0 && !held {
                continue;
            }
            let block = |one: usize, other: usize, curvature: &Matrix6<f64>| {
                (jet.slope[one] * jet.slope[other].transpose() + curvature * beyond) * (k * scale)
            };
            let bodies = self.list[row.joint].bodies;
            for (i, body) in bodies.iter().enumerate() {
                if let Some(body) = body {
                    matrix.add_inertia(*body, &block(i, i, &jet.curvature[i]));
                }
            }
            if let [Some(one), Some(other)] = bodies {
                let matrix_of = block(0, 1, &jet.curvature[2]);
                matrix.add_coupled(&CoupledInertia { bodies: [one, other], matrix: matrix_of });
            }
        }
    }

    /// Makes the multipliers those at `q`, and returns whether they stay: the largest change of a
    /// coordinate that they stand for, as a share of a length (m) or an angle of 1 rad, is none.
    pub fn renew(&mut self, length: f64, bodies: &[RigidBody], q: impl Fn(usize) -> Pose) -> bool {
        let mut stays = true;
        for i in 0..self.rows.len() {
            let row = self.rows[i];
            let k = self.stiffness_of(&row);
            let multiplier = k * self.beyond(&row, self.jet(&row, bodies, &q).value);
            let size = if matches!(row.coordinate, Coordinate::About(..)) { 1.0 } else { length };
            stays &= (multiplier - row.multiplier).abs() <= JOINT_STAYS * size * k;
            self.rows[i].multiplier = multiplier;
        }
        stays
    }

    fn jet(&self, row: &Row, bodies: &[RigidBody], q: &impl Fn(usize) -> Pose) -> Jet {
        let joint = &self.list[row.joint];
        // centre, lever of the point, attitude of the frame
        let [first, second] = [0, 1].map(|i| {
            let JointFrame { position, rotation } = joint.frames[i];
            match joint.bodies[i] {
                None => (position, Vector3::zeros(), rotation),
                Some(body) => {
                    let (centre, turn) = q(body);
                    let attitude = turn * bodies[body].rotation;
                    (centre, attitude * position, attitude * rotation)
                }
            }
        });
        match row.coordinate {
            Coordinate::Along(x) => along(&(first.2 * Vector3::ith(x, 1.0)), &first, &second),
            Coordinate::About(x, from) => {
                let axis = nalgebra::Unit::new_unchecked(Vector3::ith(x, 1.0));
                let start = first.2 * UnitQuaternion::from_axis_angle(&axis, from);
                about(&(start * axis.into_inner()), &start, &second.2)
            }
            Coordinate::Distance => distance(&first, &second),
        }
    }
}

/// Position of a body's centre and its rotation from the attitude that it is counted from.
type Pose = (Vector3<f64>, UnitQuaternion<f64>);
/// Centre, lever of the point, and attitude of the frame.
type Placed = (Vector3<f64>, Vector3<f64>, UnitQuaternion<f64>);

/// The second derivative of `u . (R x)` by a rotation R from the present attitude.
fn turned_twice(u: &Vector3<f64>, x: &Vector3<f64>) -> Matrix3<f64> {
    let product = u * x.transpose();
    (product + product.transpose()) * 0.5 - Matrix3::identity() * u.dot(x)
}

/// `u . (x2 - x1)`, u fixed to the first body: `(E1 u) . (c2 + E2 b - c1) - u . a` with the levers
/// a and b of the points.
fn along(u: &Vector3<f64>, (c1, a, _): &Placed, (c2, b, _): &Placed) -> Jet {
    let y = c2 + b - c1;
    let [mut first, mut second, mut mixed] = [Matrix6::zeros(); 3];
    first.fixed_view_mut::<3, 3>(3, 3).copy_from(&turned_twice(u, &y));
    first.fixed_view_mut::<3, 3>(3, 0).copy_from(&-skew(u));
    first.fixed_view_mut::<3, 3>(0, 3).copy_from(&skew(u));
    second.fixed_view_mut::<3, 3>(3, 3).copy_from(&turned_twice(u, b));
    mixed.fixed_view_mut::<3, 3>(3, 0).copy_from(&skew(u));
    mixed.fixed_view_mut::<3, 3>(3, 3).copy_from(&(Matrix3::identity() * u.dot(b) - b * u.transpose()));
    let slope = [stack(&-u, &u.cross(&y)), stack(u, &b.cross(u))];
    Jet { value: u.dot(&(y - a)), slope, curvature: [first, second, mixed] }
}

/// `2 u . im(r)`, r the rotation from the first to the second frame in world axes, u of the first.
fn about(u: &Vector3<f64>, first: &UnitQuaternion<f64>, second: &UnitQuaternion<f64>) -> Jet {
    let r = second * first.inverse();
    let r = if r.w < 0.0 { -r.into_inner() } else { r.into_inner() };
    let im = r.imag();
    let slope = u * r.w + im.cross(u);
    let own = Matrix3::identity() * (-0.5 * u.dot(&im));
    let [mut first, mut second, mut mixed] = [Matrix6::zeros(); 3];
    first.fixed_view_mut::<3, 3>(3, 3).copy_from(&own);
    second.fixed_view_mut::<3, 3>(3, 3).copy_from(&own);
    mixed.fixed_view_mut::<3, 3>(3, 3).copy_from(&(skew(&slope) * 0.5 - own));
    let zero = Vector3::zeros();
    let slopes = [stack(&zero, &-slope), stack(&zero, &slope)];
    Jet { value: 2.0 * u.dot(&im), slope: slopes, curvature: [first, second, mixed] }
}

/// `|x2 - x1|`, from its components along three fixed axes.
fn distance(first: &Placed, second: &Placed) -> Jet {
    let parts = [0, 1, 2].map(|x| fixed(&Vector3::ith(x, 1.0), first, second));
    let value = parts.iter().map(|part| part.value * part.value).sum::<f64>().sqrt();
    if value == 0.0 {
        return Jet { value, slope: [Vector6::zeros(); 2], curvature: [Matrix6::zeros(); 3] };
    }
    let mut slope = [Vector6::zeros(); 2];
    let mut curvature = [Matrix6::zeros(); 3];
    let pairs = [(0, 0), (1, 1), (0, 1)];
    for part in &parts {
        (0..2).for_each(|i| slope[i] += part.slope[i] * (part.value / value));
        for (k, (i, j)) in pairs.into_iter().enumerate() {
            curvature[k] += (part.curvature[k] * part.value + part.slope[i] * part.slope[j].transpose()) / value;
        }
    }
    for (k, (i, j)) in pairs.into_iter().enumerate() {
        curvature[k] -= slope[i] * slope[j].transpose() / value;
    }
    Jet { value, slope, curvature }
}

/// `u . (x2 - x1)`, u fixed in the world.
fn fixed(u: &Vector3<f64>, (c1, a, _): &Placed, (c2, b, _): &Placed) -> Jet {
    let [mut first, mut second] = [Matrix6::zeros(); 2];
    first.fixed_view_mut::<3, 3>(3, 3).copy_from(&-turned_twice(u, a));
    second.fixed_view_mut::<3, 3>(3, 3).copy_from(&turned_twice(u, b));
    let slope = [stack(&-u, &-a.cross(u)), stack(u, &b.cross(u))];
    Jet { value: u.dot(&(c2 + b - c1 - a)), slope, curvature: [first, second, Matrix6::zeros()] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::island::hold::vector;

    fn placed(q: &[f64], start: &Placed) -> Placed {
        let turn = UnitQuaternion::from_scaled_axis(vector(&q[3..]));
        (start.0 + vector(q), turn * start.1, turn * start.2)
    }

    /// Slopes and curvatures of all coordinates are those of finite differences.
    ///
    /// *Source.* Central differences of the value in exp(d) from the same attitudes.
    #[test]
    fn derivatives_are_those_of_differences() {
        let turn = |x: f64, y: f64, z: f64| UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z));
        let first = (Vector3::new(0.2, -0.4, 1.1), Vector3::new(0.3, 0.5, -0.2), turn(0.4, -0.2, 0.7));
        let second = (Vector3::new(-0.6, 0.3, 0.8), Vector3::new(-0.1, 0.7, 0.4), turn(-0.5, 0.6, 0.9));
        type Value = fn(&Placed, &Placed) -> Jet;
        let coordinates: [Value; 3] =
            [|a, b| along(&(a.2 * Vector3::y()), a, b), |a, b| about(&(a.2 * Vector3::x()), &a.2, &b.2), distance];
        for (number, coordinate) in coordinates.into_iter().enumerate() {
            let jet = coordinate(&first, &second);
            let value = |q: &[f64; 12]| coordinate(&placed(&q[..6], &first), &placed(&q[6..], &second)).value;
            let h = 1e-4;
            let moved = |steps: &[(usize, f64)]| {
                let mut q = [0.0; 12];
                steps.iter().for_each(|(i, d)| q[*i] += d);
                value(&q)
            };
            for i in 0..12 {
                let slope = (moved(&[(i, h)]) - moved(&[(i, -h)])) / (2.0 * h);
                assert!((slope - jet.slope[i / 6][i % 6]).abs() < 1e-7, "{number} {i}: {slope} {:?}", jet.slope);
                for j in 0..12 {
                    let curvature = (moved(&[(i, h), (j, h)]) - moved(&[(i, h), (j, -h)]) - moved(&[(i, -h), (j, h)])
                        + moved(&[(i, -h), (j, -h)]))
                        / (4.0 * h * h);
                    let (block, row, column) = match (i / 6, j / 6) {
                        (0, 0) => (0, i, j),
                        (1, 1) => (1, i - 6, j - 6),
                        (0, 1) => (2, i, j - 6),
                        _ => continue,
                    };
                    // about the same body, differences add rotation vectors: of two rotations the
                    // symmetric part is compared
                    let own = if block < 2 {
                        0.5 * (jet.curvature[block][(row, column)] + jet.curvature[block][(column, row)])
                    } else {
                        jet.curvature[block][(row, column)]
                    };
                    assert!((curvature - own).abs() < 1e-5, "{number} {i} {j}: {curvature} {own}");
                }
            }
        }
    }
}
