//! A contact as the linear solve of an iteration sees it. Equation: [`newton`](super::newton).

use super::evaluation::Row;
use nalgebra::{Matrix3, Vector3};

/// Minus the derivatives of the normal force, by the motion of its row, and of friction.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Tangents {
    pub normal: Matrix3<f64>,
    /// The vector m of it.
    pub across: Vector3<f64>,
    pub friction: Matrix3<f64>,
}

/// A contact as a linear solve sees it.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Linear {
    pub force: Vector3<f64>,
    pub tangents: Tangents,
    pub element: usize,
    pub row: Row,
    /// Motion beside the obstacle of that iterate, of the point and of the row.
    pub slip: Vector3<f64>,
    pub row_slip: Vector3<f64>,
    /// Arm of the force about the centre of the body that carries the obstacle.
    pub arm: Vector3<f64>,
    /// The arm in the tangent: on the line of its normal, that of the row between that of the force
    /// and that of the end.
    pub lever: Vector3<f64>,
    pub normal: Vector3<f64>,
    pub normal_force: f64,
    pub pressure: f64,
    pub slope: f64,
    pub depth: f64,
    pub slides: Option<Vector3<f64>>,
}

/// How a contact is made linear.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct About {
    /// The depth that belongs to the force that the last linear solve gave: on the quadratic start
    /// of the law, Newton's iteration about the depth itself only halves it.
    pub depth: Option<f64>,
    /// As if it stuck, because the direction of slip turned round: the solution lies between.
    pub sticks: bool,
}

/// How the closest point of an element moves with it.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Roll {
    /// Shape functions of the slope.
    pub slope: [f64; 4],
    /// 1/D in m.
    pub length: f64,
    /// Share of the closest point's motion by which the contact moves.
    pub share: f64,
}
