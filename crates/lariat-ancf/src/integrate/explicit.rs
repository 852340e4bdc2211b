//! Symmetric compositions of kicks and drifts: the explicit symplectic methods, each given by its
//! weights.
//!
//! # Equation
//!
//! ```text
//! for each i:  v += b_i h k(q);   q += a_i h v
//! ```
//!
//! Where k depends on v (rotating bodies, drag), it is evaluated at v extrapolated with the
//! previous k to the time of q: then Verlet keeps its order, and the methods of higher order have
//! order 2 in that part.
//!
//! The step begins and ends with a kick, and k at its end serves the next step. M is factored once;
//! a step costs one force evaluation and one mass solve per drift.
//!
//! # Validity
//!
//! Soft cables; drag, with order 2. The methods are symplectic: energy errors stay bounded while h
//! omega_max stays below [`Composition::stability_limit`]. Internal damping is an error, because it
//! lowers the stability limit to h < 2/(tau omega_max^2), far below practical steps.
//!
//! # References
//!
//! Hairer, Lubich & Wanner 2006, II and VI; Blanes & Casas 2016.
//!
//! # Alternatives considered
//!
//! Error control: it destroys the symplectic structure.

use super::dynamics::Dynamics;
use super::one_step::{OneStep, Scratch, StepRequest, add_scaled, set_sum};
use crate::error::StepFailure;
use crate::state::State;

/// Weights of the first half of a symmetric composition b1 a1 b2 a2 ...; the rest follows by
/// symmetry.
#[derive(Clone, Copy, Debug)]
pub struct Composition {
    /// Name of the method.
    pub name: &'static str,
    /// Kicks b1, b2, ... up to the middle.
    pub kicks: &'static [f64],
    /// Drifts a1, a2, ... up to the middle.
    pub drifts: &'static [f64],
    /// Number of drifts (and force evaluations) in a step.
    pub stages: usize,
    /// Largest h omega below which a harmonic oscillator stays bounded (a test scans for it).
    pub stability_limit: f64,
}

impl Composition {
    fn kick(&self, i: usize) -> f64 {
        self.kicks[i.min(self.stages - i)]
    }

    fn drift(&self, i: usize) -> f64 {
        self.drifts[i.min(self.stages - 1 - i)]
    }
}

impl OneStep for Composition {
    fn name(&self) -> String {
        self.name.to_string()
    }

    fn stability_limit(&self) -> Option<f64> {
        Some(self.stability_limit)
    }

    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        StepRequest { h, .. }: StepRequest,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        let Scratch { next, velocity_base, .. } = scratch;
        let mut time = now.time;
        let (mut kicked, mut drifted) = (0.0, 0.0);
        for i in 0..self.stages {
            if i == 0 {
                // without copies of the state: they are a twentieth of a step
                set_sum(&mut next.v, &now.v, h * self.kick(0), &now.memory.acceleration);
                set_sum(&mut next.q, &now.q, h * self.drift(0), &next.v);
            } else {
                add_scaled(&mut next.v, h * self.kick(i), &next.memory.acceleration);
                add_scaled(&mut next.q, h * self.drift(i), &next.v);
            }
            time += h * self.drift(i);
            if i + 1 == self.stages {
                time = now.time + h;
            }
            system.prescribe(time, &mut next.q, &mut next.v);
            kicked += self.kick(i);
            drifted += self.drift(i);
            if system.depends_on_velocity() {
                velocity_base.copy_from_slice(&next.v);
                let acceleration = if i == 0 { &now.memory.acceleration } else { &next.memory.acceleration };
                add_scaled(velocity_base, h * (drifted - kicked), acceleration);
                system.prescribe(time, &mut next.q, velocity_base);
                system.acceleration(time, &next.q, velocity_base, &mut next.memory.acceleration)?;
            } else {
                system.acceleration(time, &next.q, &next.v, &mut next.memory.acceleration)?;
            }
        }
        add_scaled(&mut next.v, h * self.kick(self.stages), &next.memory.acceleration);
        system.prescribe(now.time + h, &mut next.q, &mut next.v);
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::Composition;
    use crate::integrate::{rkn, verlet};

    /// Returns half the trace of the step matrix of q' = v, v' = -x^2 q with h = 1: bounded while
    /// it stays within [-1, 1].
    fn half_trace(method: &Composition, x: f64) -> f64 {
        let image = |mut q: f64, mut v: f64| {
            for i in 0..method.stages {
                v -= method.kick(i) * x * x * q;
                q += method.drift(i) * v;
            }
            (q, v - method.kick(method.stages) * x * x * q)
        };
        0.5 * (image(1.0, 0.0).0 + image(0.0, 1.0).1)
    }

    #[test]
    fn the_stability_limit_is_where_the_oscillator_stops_being_bounded() {
        for method in [&verlet::METHOD, &rkn::ORDER_4, &rkn::ORDER_6] {
            let mut x = 1e-3;
            while half_trace(method, x).abs() <= 1.0 + 1e-9 {
                x += 1e-3;
            }
            assert!((x - 1e-3 - method.stability_limit).abs() < 2e-3, "{x} {}", method.stability_limit);
        }
    }
}
