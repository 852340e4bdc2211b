//! A contact in Newton's iteration: its tangent, and what the linear solve believed of it.
//!
//! # Equation
//!
//! The normal force is linear about the depth that belongs to the force of the last solve, and its
//! tangent `w p' m m^T`, `m = (gbar + n1)/2`, is symmetric: the force acts along the mean normal
//! gbar, and its depth changes along n1, that of the end. Of a contact that acts between two
//! closest points ([`slide`](super::slide)) the row is half way between its place and the one whose
//! depth counts, for the same reason.

use super::evaluation::Evaluation;
use super::linear::{About, Linear, Tangents};
use super::path::ObstacleStep;
use super::point::ContactPoint;
use nalgebra::Vector3;

impl ContactPoint {
    /// Makes it linear at changes of its position and of that of its row.
    #[inline]
    pub fn linearise(&mut self, obstacle: &ObstacleStep, changes: impl Fn(usize, &[f64; 4]) -> Vector3<f64>) {
        let (element, row) = (self.key.0 as usize, self.row());
        let mut tangents = Tangents::default();
        if let Some(glide) = &mut self.glide {
            glide.follow(&changes(element, &glide.slope));
        }
        let change = changes(element, &self.shape);
        let at = self.evaluate(obstacle, &change, self.about, Some(&mut tangents));
        let apart = self.between.is_some();
        let row_change = if apart { changes(element, &row.shape) } else { change };
        let row_slip = if apart { obstacle.slip(&row.start, &row_change) } else { at.slip };
        let Evaluation { force, slip, arm, normal, normal_force, .. } = at;
        let Evaluation { pressure, slope, depth, slides, .. } = at;
        let lever = obstacle.lever(&row.start, &row_change);
        self.linear = Linear {
            force,
            tangents,
            element,
            row,
            slip,
            row_slip,
            arm,
            lever,
            normal,
            normal_force,
            pressure,
            slope,
            depth,
            slides,
        };
    }

    /// Evaluates it at the result of the linear solve, and returns how far that was off in N.
    #[inline]
    pub fn follow(&mut self, obstacle: &ObstacleStep, changes: impl Fn(usize, &[f64; 4]) -> Vector3<f64>) -> f64 {
        if let Some(glide) = &mut self.glide {
            glide.follow(&changes(self.key.0 as usize, &glide.slope));
        }
        let linear = &self.linear;
        self.now = self.evaluate(obstacle, &changes(self.key.0 as usize, &self.shape), About::default(), None);
        let pressure = linear.pressure + linear.slope * (self.now.depth - linear.depth);
        let turned = linear.slides.zip(self.now.slides).is_some_and(|(a, b)| a.dot(&b) < 0.0);
        let pushes = linear.slope > 0.0 && pressure > 0.0;
        self.about =
            About { depth: pushes.then(|| self.push(self.now.start, obstacle.h).depth_of(pressure)), sticks: turned };
        let row_slip = obstacle.slip(&linear.row.start, &changes(linear.element, &linear.row.shape));
        let believed = linear.force
            - linear.tangents.normal * (row_slip - linear.row_slip)
            - linear.tangents.friction * (self.now.slip - linear.slip);
        (self.now.force - believed).norm()
    }
}
