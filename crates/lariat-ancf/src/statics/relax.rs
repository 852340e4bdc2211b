//! Dynamic relaxation with kinetic damping: an L-stable integrator moves the cable, its velocities are dropped at
//! every peak of kinetic energy.
//!
//! *Source.* Barnes 1999.

use super::scale::LoadScale;
use super::{Budget, Failure};
use crate::cable::Cable;
use crate::integrate::{Integrator, Method, NewtonMode, StepControl};

/// Steps at most.
const STEPS: usize = 400;
/// A step that fails is halved, so many times.
const HALVINGS: usize = 4;
/// At rest: the kinetic energy peaks below this share of its largest peak.
const REST: f64 = 1e-10;

impl Cable {
    /// Moves the cable towards rest; it stays where the last step that could be done left it.
    pub(super) fn relax(&mut self, budget: &mut Budget) -> Result<(), Failure> {
        let integrator = self.integrator();
        let scale = LoadScale::of(&self.model, self.positions());
        let mut step = 0.3 / scale.mu.sqrt();
        let method = Method::GeneralisedAlpha { rho: 0.0, newton: NewtonMode::Converged };
        let quiet = Integrator { method, control: StepControl::Substeps(1) };
        let time = self.time();
        let fits = self.set_integrator(quiet).is_ok();
        // the ramp is in "time": hold it at full load
        let loads = self.model.loads.clone();
        self.model.loads.iter_mut().for_each(|load| load.ramp = 0.0);
        self.still();
        let (mut kinetic, mut largest, mut halvings) = (0.0f64, 0.0f64, 0);
        for _ in 0..STEPS {
            if !fits || !budget.take() {
                break;
            }
            if self.step(step).is_err() {
                if halvings == HALVINGS {
                    break;
                }
                halvings += 1;
                step *= 0.5;
                self.still();
                kinetic = 0.0;
                continue;
            }
            let now = self.energy().kinetic;
            if now < kinetic {
                largest = largest.max(kinetic);
                self.still();
                if kinetic < REST * largest {
                    break;
                }
                kinetic = 0.0;
            } else {
                kinetic = now;
            }
        }
        self.model.loads = loads;
        self.snapshot.state.time = time;
        // it was the cable's own a moment ago
        let _ = self.set_integrator(integrator);
        if fits { Ok(()) } else { Err(Failure::default()) }
    }

    /// Velocities become zero.
    pub(super) fn still(&mut self) {
        self.snapshot.state.v.fill(0.0);
        self.disturb();
    }
}
