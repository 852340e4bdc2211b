//! Energy that a change of the mesh adds, taken back.
//!
//! # Equation
//!
//! One cubic in place of two has more strain energy where the cable is kinked, and two in place of
//! one see more of it: on a slack rope of large EA by far more than all work. Where the energy is
//! above a bound, nodes move by implicit Euler steps from rest,
//!
//! ```text
//! (M + tau^2 K) d = tau^2 F
//! ```
//!
//! each of which lowers the energy, shortened so that it ends at the bound. Velocities take up what
//! the feed at the eye then misses of its momentum.
//!
//! The bound is the energy before the change, and 1e-3 of the pull times the length of the element
//! at the eye: the share of the work of a reel to which its account is kept.
//!
//! # Validity
//!
//! tau is at most the time in which an element passes the eye, or an axial wave the cable: the step
//! is what the rope would do meanwhile. What is above the bound then is taken from velocities
//! relative to rigid motion, but for cables on bodies; the rest is on the account of the reel: the
//! energy that the coarser mesh cannot do without. Momentum is kept, and angular momentum of a
//! cable that no support holds, by a rigid rotation.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/reels.md.

use crate::cable::Cable;
use crate::element::side::Side;
use crate::error::{Error, StepFailure};
use crate::integrate::discrete_gradient::share_to_take;
use crate::linalg::Definiteness;
use crate::scales::reel::{HALVINGS, LEAST_INERTIA, PROGRESS, ROUNDS, SHARE, STEPS};
use crate::section::Element;
use crate::system::{System, relative_velocities};
use nalgebra::{Matrix3, Vector3};

impl Cable {
    /// Returns the energy in J that a change of the mesh at an end may add.
    pub(super) fn energy_to_add(&self, side: Side, length: f64) -> f64 {
        let energy = self.energy();
        let rounding = 1e-13 * (energy.kinetic + energy.axial + energy.bending + energy.gravity.abs());
        self.reel_at(side).map_or(0.0, |reel| SHARE * reel.force.abs() * length) + rounding
    }

    /// Returns the time in s in which an axial wave passes the cable.
    pub(super) fn longest_wave(&self) -> f64 {
        self.elements().iter().map(|e| self.wave_time(e)).sum()
    }

    /// Returns the time in s in which an axial wave passes an element.
    fn wave_time(&self, e: &Element) -> f64 {
        e.length * (self.model.inertia(e) / e.section.axial_stiffness).sqrt()
    }

    /// Moves nodes until the energy is at most `most` (J), or as far as strains can be relieved
    /// within `longest` (s).
    pub(super) fn settle(&mut self, most: f64, longest: f64) -> Result<(), Error> {
        let mut bound = most;
        for _ in 0..ROUNDS {
            let mut energy = self.energy().total();
            if energy <= most {
                return Ok(());
            }
            let (before, angular) = (self.generalised_momentum(), self.momentum().angular);
            let outcome = self.lower_energy(&mut energy, bound, longest);
            outcome.map_err(|failure| self.step_failed(self.time(), 0.0, failure))?;
            let mut missed = self.generalised_momentum();
            missed.iter_mut().zip(&before).for_each(|(new, old)| *new = old - *new);
            self.take_up(missed)?;
            self.keep_angular_momentum(&angular);
            // what the velocities gained
            bound -= (self.energy().total() - energy).max(0.0);
        }
        // the kinetic energy of what flows is not of the mass matrix alone
        (0..STEPS).for_each(|_| self.slow_down(self.energy().total() - most));
        Ok(())
    }

    /// Takes an energy in J from velocities relative to rigid motion, if there is so much; from
    /// none of a cable that bodies hold.
    fn slow_down(&mut self, excess: f64) {
        if excess <= 0.0 || self.model.supports.iter().any(|(_, support)| support.attached) {
            return;
        }
        let [mut relative, mut momentum, mut mode] = [(); 3].map(|()| self.velocities().to_vec());
        let Cable { model, system, snapshot, .. } = self;
        relative_velocities(model, system, &snapshot.state.q, &mut relative, &mut momentum, &mut mode);
        let energy = 0.5 * system.mass_square(&relative, &mut momentum);
        let product = snapshot.state.v.iter().zip(&momentum).map(|(v, p)| v * p).sum();
        if let Some(share) = share_to_take(energy, product, excess, 1.0) {
            snapshot.state.v.iter_mut().zip(&relative).for_each(|(v, d)| *v -= share * d);
        }
    }

    /// Makes the angular momentum about the origin what it was in kg m^2/s, if nothing but bodies
    /// holds the cable.
    pub(super) fn keep_angular_momentum(&mut self, before: &Vector3<f64>) {
        if self.model.supports.iter().all(|(_, support)| support.attached) {
            self.turn_by(&(before - self.momentum().angular));
        }
    }

    /// Adds a rigid rotation about the centre of mass, of an angular momentum in kg m^2/s.
    fn turn_by(&mut self, angular: &Vector3<f64>) {
        let (level, nodes) = (self.system.level, self.nodes());
        let motion = |about: &Vector3<f64>, axis: &Vector3<f64>, q: &[f64]| -> Vec<f64> {
            let turned = |x: &[f64], from: &Vector3<f64>| axis.cross(&(Vector3::from_column_slice(x) - from));
            q.chunks_exact(6)
                .flat_map(|q| [turned(&q[..3], about), turned(&q[3..], &Vector3::zeros())])
                .flat_map(|x| [x.x, x.y, x.z])
                .collect()
        };
        let product = |system: &System, x: &[f64]| {
            let mut out = vec![0.0; x.len()];
            system.mass.multiply(level, x, &mut out);
            out
        };
        let q = self.positions().to_vec();
        let shift: Vec<f64> = (0..6 * nodes).map(|i| if i % 6 == 0 { 1.0 } else { 0.0 }).collect();
        let of_shift = product(&self.system, &shift);
        let mass: f64 = of_shift.iter().step_by(6).sum();
        let centre =
            Vector3::from_fn(|x, _| (0..2 * nodes).map(|k| of_shift[3 * k] * q[3 * k + x]).sum::<f64>() / mass);
        let fields = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| motion(&centre, &axis, &q));
        let of_fields = [0, 1, 2].map(|k| product(&self.system, &fields[k]));
        let inertia = Matrix3::from_fn(|i, k| fields[i].iter().zip(&of_fields[k]).map(|(a, b)| a * b).sum::<f64>());
        // a straight cable has none about itself
        if let Ok(rate) = inertia.pseudo_inverse(LEAST_INERTIA * inertia.trace()).map(|inverse| inverse * angular) {
            let added = motion(&centre, &rate, &q);
            self.snapshot.state.v.iter_mut().zip(&added).for_each(|(v, d)| *v += d);
        }
    }

    fn lower_energy(&mut self, energy: &mut f64, most: f64, longest: f64) -> Result<(), StepFailure> {
        let mut tau = self.elements().iter().map(|e| self.wave_time(e)).fold(longest, f64::min);
        let mut step = vec![0.0; self.positions().len()];
        for _ in 0..STEPS {
            let (time, q) = (self.time(), self.positions().to_vec());
            let (mut equations, _) = self.equations();
            equations.static_force_and_matrix(time, &q, tau * tau, 1.0, &mut step);
            if equations.factor()? != Definiteness::PositiveDefinite {
                tau *= 0.5;
                continue;
            }
            equations.solve(&mut step);
            let lowered = self.energy_at(&q, &step, 1.0);
            if lowered >= *energy || lowered.is_nan() {
                tau *= 0.5;
                self.snapshot.state.q.copy_from_slice(&q);
                continue;
            }
            if lowered <= most {
                // as little as is needed
                let [mut low, mut high] = [0.0, 1.0];
                for _ in 0..HALVINGS {
                    let share = 0.5 * (low + high);
                    if self.energy_at(&q, &step, share) <= most {
                        high = share;
                    } else {
                        low = share;
                    }
                }
                *energy = self.energy_at(&q, &step, high);
                return Ok(());
            }
            let taken = (*energy - lowered) / (*energy - most);
            *energy = lowered;
            if taken < PROGRESS && tau == longest {
                return Ok(());
            }
            tau = (2.0 * tau).min(longest);
        }
        Ok(())
    }

    /// Moves the nodes from `q` by a share of a step, and returns the energy in J there.
    fn energy_at(&mut self, q: &[f64], step: &[f64], share: f64) -> f64 {
        for (x, (q, d)) in self.snapshot.state.q.iter_mut().zip(q.iter().zip(step)) {
            *x = q + share * d;
        }
        self.energy().total()
    }
}
