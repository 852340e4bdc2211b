//! A contact in Newton's iteration: its tangent, and what the linear solve believed of it.
//!
//! # Equation
//!
//! The normal force is linear about the depth that belongs to the force of the last solve, and its tangent `w p' m m^T`, `m = (gbar + n1)/2`, is symmetric:
//! the force acts along the mean normal gbar, and its depth changes along n1, that of the end. Of a contact that acts between two closest points
//! ([`slide`](super::slide)) the row is half way between its place and the one whose depth counts, for the same reason.

use super::path::ObstacleStep;
use super::point::{ContactPoint, Evaluation, Row};
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
    slip: Vector3<f64>,
    row_slip: Vector3<f64>,
    /// Arm of the force about the centre of the body that carries the obstacle.
    pub arm: Vector3<f64>,
    pub normal: Vector3<f64>,
    pub normal_force: f64,
    pressure: f64,
    pub slope: f64,
    depth: f64,
    slides: Option<Vector3<f64>>,
}

/// How a contact is made linear.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct About {
    /// The depth that belongs to the force that the last linear solve gave: on the quadratic start of the law, Newton's iteration about the
    /// depth itself only halves it.
    pub depth: Option<f64>,
    /// As if it stuck, because the direction of slip turned round: the solution lies between.
    pub sticks: bool,
}

impl ContactPoint {
    /// Makes it linear at changes of its position and of that of its row.
    pub fn linearise(&mut self, obstacle: &ObstacleStep, changes: impl Fn(usize, &[f64; 4]) -> Vector3<f64>) {
        let (element, row) = (self.key.0 as usize, self.row());
        let mut tangents = Tangents::default();
        let at = self.evaluate(obstacle, &changes(element, &self.shape), self.about, Some(&mut tangents));
        let apart = self.between.is_some();
        let row_slip = if apart { obstacle.slip(&row.start, &changes(element, &row.shape)) } else { at.slip };
        let Evaluation { force, slip, arm, normal, normal_force, .. } = at;
        let Evaluation { pressure, slope, depth, slides, .. } = at;
        self.linear = Linear {
            force,
            tangents,
            element,
            row,
            slip,
            row_slip,
            arm,
            normal,
            normal_force,
            pressure,
            slope,
            depth,
            slides,
        };
    }

    /// Evaluates it at the result of the linear solve, and returns how far that was off in N.
    pub fn follow(&mut self, obstacle: &ObstacleStep, changes: impl Fn(usize, &[f64; 4]) -> Vector3<f64>) -> f64 {
        let linear = &self.linear;
        self.now = self.evaluate(obstacle, &changes(self.key.0 as usize, &self.shape), About::default(), None);
        let pressure = linear.pressure + linear.slope * (self.now.depth - linear.depth);
        let turned = linear.slides.zip(self.now.slides).is_some_and(|(a, b)| a.dot(&b) < 0.0);
        let pushes = linear.slope > 0.0 && pressure > 0.0;
        self.about = About { depth: pushes.then(|| self.law.depth_of(pressure)), sticks: turned };
        let row_slip = obstacle.slip(&linear.row.start, &changes(linear.element, &linear.row.shape));
        let believed = linear.force
            - linear.tangents.normal * (row_slip - linear.row_slip)
            - linear.tangents.friction * (self.now.slip - linear.slip);
        (self.now.force - believed).norm()
    }
}
