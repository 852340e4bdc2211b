//! Dynamic relaxation with kinetic damping: an L-stable integrator moves the cable, and its
//! velocities are set to zero at every peak of kinetic energy.
//!
//! # References
//!
//! Barnes 1999.

use super::attempt::{Budget, Failure};
use crate::cable::Cable;
use crate::integrate::{Integrator, Method, StepControl};
use crate::model::LoadScale;
use crate::scales::statics::{RELAXATION_HALVINGS, RELAXATION_STEPS, REST_SHARE};

impl Cable {
    /// Moves the cable towards rest; it stays where the last successful step left it.
    pub(crate) fn relax(&mut self, budget: &mut Budget) -> Result<(), Failure> {
        let integrator = self.integrator();
        let scale = LoadScale::new(&self.model, self.positions());
        let mut step = 0.3 / scale.mu.sqrt();
        let method = Method::GeneralisedAlpha { rho: 0.0 };
        let damping = Integrator { method, control: StepControl::Substeps(1) };
        let time = self.time();
        let fits = self.set_integrator(damping).is_ok();
        // the ramp depends on time: hold it at full load
        let loads = self.model.loads.clone();
        self.model.loads.iter_mut().for_each(|load| load.ramp = 0.0);
        self.set_at_rest();
        let (mut kinetic, mut largest, mut halvings) = (0.0f64, 0.0f64, 0);
        for _ in 0..RELAXATION_STEPS {
            if !fits || !budget.take() {
                break;
            }
            if self.step(step).is_err() {
                if halvings == RELAXATION_HALVINGS {
                    break;
                }
                halvings += 1;
                step *= 0.5;
                self.set_at_rest();
                kinetic = 0.0;
                continue;
            }
            let now = self.energy().kinetic;
            if now < kinetic {
                largest = largest.max(kinetic);
                self.set_at_rest();
                if kinetic < REST_SHARE * largest {
                    break;
                }
                kinetic = 0.0;
            } else {
                kinetic = now;
            }
        }
        self.model.loads = loads;
        self.snapshot.state.time = time;
        // valid, because it was the cable's own
        let _ = self.set_integrator(integrator);
        if fits { Ok(()) } else { Err(Failure::default()) }
    }
}
