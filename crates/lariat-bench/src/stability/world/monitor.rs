//! The extremes and the energy balance that a run is checked by.
//!
//! # Equation
//! With `E` the kinetic, strain and gravity energy, `W` the work from outside and `D` the energy
//! that damping and drag dissipated, each since the balance was begun,
//!
//! ```text
//! made = E - E0 - W
//! lost = -(E - E0 - W + D)
//! ```
//!
//! neither of which may exceed a share of the largest kinetic and strain energy of the run: after
//! the steps for `made`, that at the start included for `lost`.

use crate::numbers::largest;
use lariat_ancf::Vector3;

/// Which checks are made at present.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Checks {
    /// Gaps and energy.
    #[default]
    All,
    /// Gaps alone: the work from outside is not known accurately.
    Gaps,
    /// None: a user changes the world, which opens gaps and does work.
    None,
}

/// What is read from a world after a step.
pub struct Reading {
    /// Kinetic, strain and gravity energy in J.
    pub energy: f64,
    /// Kinetic and strain energy in J.
    pub kinetic_and_strain: f64,
    /// Work that bodies have received from cables so far, for each attachment in J, and whether the
    /// body is moved from outside.
    pub attachment_work: Vec<(f64, bool)>,
    /// Work of constant forces from outside, up to a constant, in J.
    pub known_work: f64,
    /// Work of line loads and of a flow that drives, so far, in J.
    pub effect_work: f64,
    /// Energy that damping and drag took so far, in J.
    pub dissipated: f64,
    /// Widest gap of an attachment in m.
    pub gap: f64,
    /// Largest error of Rapier's own joints in m.
    pub constraint: f64,
    /// Largest stretch of a rope.
    pub stretch: f64,
    /// Force of each attachment in N.
    pub forces: Vec<Vector3<f64>>,
}

/// Extremes over a run.
#[derive(Default)]
pub struct Monitor {
    pub checks: Checks,
    /// Energy when the balance was begun, and the work from outside since, in J.
    start: f64,
    external_work: f64,
    attachment_work: Vec<f64>,
    known_work: f64,
    effect_work: f64,
    dissipated: f64,
    /// Energy balance at the last step, and its extremes while energy was checked, in J.
    pub balance: f64,
    made: f64,
    lost: f64,
    /// Largest kinetic and strain energy, and at least what the weight of all does over 1 mm, in J.
    pub scale: f64,
    /// Largest kinetic and strain energy when a balance was begun, in J.
    start_scale: f64,
    pub gap: f64,
    pub constraint: f64,
    pub stretch: f64,
    /// Largest force of each attachment in N.
    pub peak_force: Vec<f64>,
    force_sum: Vec<Vector3<f64>>,
    force_samples: f64,
}

impl Monitor {
    /// Begins the energy balance anew, and all checks.
    pub fn restart_balance(&mut self, now: &Reading) {
        self.checks = Checks::All;
        (self.external_work, self.balance) = (0.0, 0.0);
        self.start = now.energy;
        if now.kinetic_and_strain.is_finite() {
            self.start_scale = self.start_scale.max(now.kinetic_and_strain);
        }

        self.attachment_work = now.attachment_work.iter().map(|(work, _)| *work).collect();
        (self.known_work, self.effect_work) = (now.known_work, now.effect_work);
        self.dissipated = now.dissipated;
    }

    /// Returns the largest energy made beyond the work from outside, as a share.
    pub fn made_share(&self) -> f64 {
        self.made / self.scale.max(1e-9)
    }

    /// Returns the largest energy lost beyond what damping and drag dissipated, as a share.
    pub fn lost_share(&self) -> f64 {
        self.lost / self.scale.max(self.start_scale).max(1e-9)
    }

    /// Returns the mean force of an attachment in N.
    pub fn mean_force(&self, attachment: usize) -> Vector3<f64> {
        self.force_sum.get(attachment).map_or(Vector3::repeat(f64::NAN), |sum| sum / self.force_samples.max(1.0))
    }

    /// Begins means and peaks of forces anew.
    pub fn restart_forces(&mut self) {
        self.force_samples = 0.0;
        self.force_sum.clear();
        self.peak_force.clear();
    }

    /// Takes in a reading after a step; `least_scale` is the smallest reference energy in J.
    pub fn record(&mut self, now: &Reading, least_scale: f64) {
        for (i, (work, external)) in now.attachment_work.iter().enumerate() {
            if *external {
                self.external_work -= work - self.attachment_work.get(i).copied().unwrap_or(0.0);
            }
        }
        self.attachment_work = now.attachment_work.iter().map(|(work, _)| *work).collect();
        self.external_work += now.effect_work - self.effect_work + now.known_work - self.known_work;
        (self.known_work, self.effect_work) = (now.known_work, now.effect_work);
        let gained = now.energy - self.start - self.external_work;
        self.balance = gained + now.dissipated - self.dissipated;
        if self.checks == Checks::All {
            self.made = largest(self.made, gained);
            self.lost = largest(self.lost, -self.balance);
        }
        if self.checks != Checks::None {
            self.gap = self.gap.max(now.gap);
        }
        self.scale = self.scale.max(now.kinetic_and_strain).max(least_scale);
        self.constraint = self.constraint.max(now.constraint);
        self.stretch = self.stretch.max(now.stretch);
        self.peak_force.resize(now.forces.len(), 0.0);
        self.force_sum.resize(now.forces.len(), Vector3::zeros());
        for (i, force) in now.forces.iter().enumerate() {
            self.peak_force[i] = self.peak_force[i].max(force.norm());
            self.force_sum[i] += force;
        }
        self.force_samples += 1.0;
    }
}
