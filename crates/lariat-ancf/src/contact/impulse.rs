//! What a contact does to the velocity across it when a step ends. Equation:
//! [`impact`](super::impact).

use nalgebra::{Matrix3, Vector3};

/// A contact that pushes when the step ends.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Impact {
    /// Velocity in m/s of the obstacle there.
    pub obstacle: Vector3<f64>,
    /// Velocity in m/s beside it.
    pub beside: Vector3<f64>,
    /// Normal along which it acts.
    pub normal: Vector3<f64>,
    /// Velocity in m/s along it that restitution leaves.
    pub rebound: f64,
    /// Whether it gives velocity that it lacks.
    pub gives: bool,
    /// Of one that does, the impulse -R along the normal of the last solve, in N s.
    pub given: f64,
    /// G in kg: its part along the normal, 0 if it does not push, and that of friction.
    pub gain: f64,
    pub friction: Matrix3<f64>,
    /// What the linear solve sees of it, in N s: -R + G w.
    pub row: Vector3<f64>,
}

impl Impact {
    /// Returns whether the contact takes velocity.
    pub fn acts(&self) -> bool {
        self.gain > 0.0
    }

    /// Returns G times a velocity.
    pub fn gained(&self, velocity: &Vector3<f64>) -> Vector3<f64> {
        self.normal * (self.gain * self.normal.dot(velocity)) + self.friction * velocity
    }
}
