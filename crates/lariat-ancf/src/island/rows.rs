//! The rows of the bodies: inertia and loads, and the rows of pinned coordinates, which virtual
//! work passes to the bodies as force and moment.

use super::hold::{Hold, stack, vector};
use super::layout::Layout;
use super::rotation::angular_acceleration;
use nalgebra::Vector3;

impl Layout {
    /// Adds to the rows of the bodies: their own loads times `scale`, their inertia, and what the
    /// pins pass on from the rows of the cables. `k` holds accelerations times `scale`, in the
    /// chart.
    pub(super) fn body_rows(&self, scale: f64, q: &[f64], v: &[f64], k: &[f64], rhs: &mut [f64]) {
        for (i, body) in self.bodies.iter().enumerate() {
            let at = self.body_at(i);
            let motion = self.motion(i, &q[at..at + 6], &v[at..at + 6]);
            let inertia = body.world_inertia(&motion.rotation);
            let (theta, rate) = (vector(&q[at + 3..]), vector(&v[at + 3..]));
            let alpha = angular_acceleration(scale, &theta, &rate, &vector(&k[at + 3..]));
            let mut force = body.force * scale - body.mass * vector(&k[at..]);
            let gyroscopic =
                if body.gyroscopic { motion.spin.cross(&(inertia * motion.spin)) } else { Vector3::zeros() };
            let mut torque = (body.torque - gyroscopic) * scale - inertia * alpha;
            if let Some(points) = &body.at_points {
                force += points.force * scale;
                torque += points.torque(&motion.rotation) * scale;
            }
            if let Some((momentum, spin)) = body.carried_momentum(&vector(&k[at..]), &alpha) {
                force -= momentum;
                torque -= spin;
            }
            rhs[at..at + 3].copy_from_slice(force.as_slice());
            rhs[at + 3..at + 6].copy_from_slice(torque.as_slice());
        }
        let acceleration = |i: usize| {
            let at = self.body_at(i);
            let (theta, rate) = (vector(&q[at + 3..]), vector(&v[at + 3..]));
            stack(&vector(&k[at..]), &angular_acceleration(scale, &theta, &rate, &vector(&k[at + 3..])))
        };
        self.add_coupled_momenta(-1.0, acceleration, rhs);
        self.joints.add_forces(scale, &self.bodies, self.pose(q), |body, load| {
            let at = self.body_at(body);
            rhs[at..at + 6].iter_mut().zip(load).for_each(|(row, x)| *row += x);
        });
        self.pass_pinned_rows(q, rhs);
    }

    /// Adds the rows of held coordinates to those of their bodies, as force and moment.
    pub(super) fn pass_pinned_rows(&self, q: &[f64], rhs: &mut [f64]) {
        for hold in self.holds() {
            let row = vector(&rhs[hold.at..]);
            self.pass(hold, &row, &self.rotating_vector(hold, q), rhs);
        }
    }

    /// Adds the `row` of held coordinates to the rows of their body.
    pub(super) fn pass(&self, hold: &Hold, row: &Vector3<f64>, rotating: &Vector3<f64>, rhs: &mut [f64]) {
        let at = self.body_at(self.pins[hold.pin].body);
        let torque = rotating.cross(row);
        for x in 0..3 {
            if !hold.slope {
                rhs[at + x] += row[x];
            }
            rhs[at + 3 + x] += torque[x];
        }
    }
}
