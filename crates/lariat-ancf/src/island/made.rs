//! Energy that a step of an island makes: what cables and bodies gain beyond the work of the forces on the bodies.
//!
//! ```text
//! rotation   T1 - T0 = 1/2 (w0 + w1) . I (w1 - w0)       (w x I w has no power, whether an engine knows it or not)
//! work       f . (x1 - x0) + h tau . (w0 + w1)/2
//! ```

use super::body::RigidBody;
use super::system::Work;
use super::workspace::Motion;
use crate::integrate::Phase;
use nalgebra::Vector3;

/// Speed in m/s with which a gap may close without its work being asked for.
const CLOSING: f64 = 1e-6;

impl Work<'_, '_> {
    /// Energy made between two phases in J, and the energy to measure it by; none where bodies are driven or gaps close.
    pub(super) fn energy_between(&mut self, before: &Phase, after: &Phase, h: f64) -> Option<(f64, f64)> {
        let moves = |body: &RigidBody| body.velocity != Vector3::zeros() || body.angular_velocity != Vector3::zeros();
        let driven = |body: &RigidBody| body.free == [false; 6] && moves(body);
        if self.workspace.bodies.iter().any(driven) {
            return None;
        }
        for pin in 0..self.pins.len() {
            if self.workspace.gap(pin, before.time).1.norm() > CLOSING {
                return None;
            }
        }
        let (mut made, mut scale) = (0.0, [0.0; 2]);
        for c in 0..self.cables.len() {
            let (mut equations, part) = self.equations(c);
            let of_cable = equations.energy_between(before, after, h, part.at..part.at + part.size)?;
            made += of_cable.made;
            scale[0] += of_cable.before;
            scale[1] += of_cable.after;
        }
        for i in 0..self.bodies.len() {
            let at = self.body_at(i);
            let [start, end] = [before, after].map(|p| self.workspace.motion(i, &p.q[at..at + 6], &p.v[at..at + 6]));
            let body = &self.workspace.bodies[i];
            if body.free == [false; 6] {
                continue;
            }
            let mean = 0.5 * (start.spin + end.spin);
            let inertia = body.world_inertia(&end.rotation);
            let kinetic = |m: &Motion| 0.5 * (body.mass * m.velocity.norm_squared() + m.spin.dot(&(inertia * m.spin)));
            let gained = 0.5 * body.mass * (end.velocity.norm_squared() - start.velocity.norm_squared())
                + mean.dot(&(inertia * (end.spin - start.spin)));
            made += gained - body.force.dot(&(end.position - start.position)) - h * body.torque.dot(&mean);
            scale[0] += kinetic(&start);
            scale[1] += kinetic(&end);
        }
        Some((made, scale[0].max(scale[1])))
    }
}
