//! A contact at an iterate.

use nalgebra::Vector3;

/// Where a contact acts between two closest points ([`slide`](super::slide)).
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Between {
    /// What its gap has more than that of the closest points, in m.
    pub excess: f64,
    /// Outward normal at the closest point of the end, in the obstacle's axes.
    pub normal: Vector3<f64>,
    /// The row of the normal force in the matrix.
    pub row: Row,
}

/// A place of an element: shape functions, and position at the beginning.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Row {
    pub shape: [f64; 4],
    pub start: Vector3<f64>,
}

/// A contact at the end of an iterate.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Evaluation {
    /// Force on the cable in N.
    pub force: Vector3<f64>,
    /// Friction alone.
    pub friction: Vector3<f64>,
    pub normal_force: f64,
    /// Outward normal.
    pub normal: Vector3<f64>,
    pub depth: f64,
    /// Depth in m that counts when the step begins.
    pub start: f64,
    /// Spring of friction in the obstacle's axes half way.
    pub spring: Vector3<f64>,
    pub slides: Option<Vector3<f64>>,
    /// Motion beside the obstacle.
    pub slip: Vector3<f64>,
    /// Whether a plane took the place of its patch.
    pub replaced: bool,
    /// Arm of the force about the centre of the body that carries the obstacle.
    pub arm: Vector3<f64>,
    /// Energy in J that it stores.
    pub energy: f64,
    /// Energy in J that it lost.
    pub loss: f64,
    /// What of it friction took.
    pub friction_loss: f64,
    /// Work in J of the obstacle's motion.
    pub work: f64,
    pub pressure: f64,
    pub slope: f64,
}
