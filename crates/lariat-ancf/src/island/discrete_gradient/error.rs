//! The estimated error of a step, at no cost of a solve for bodies and of one for a cable.
//!
//! # Equation
//!
//! One step of the one-leg formula moves a point off by
//!
//! ```text
//! e = h (1/12 (D v - r O v) + a (D v - k O v))        r = h/h_before
//! ```
//!
//! with the share k of the last step that counts in this one. The first term is the error of the
//! midpoint rule, `h^3 v''/12`, the second that of the formula's dissipation. Where a body of an
//! island moves freely the error is the largest of these bodies, at their centres and pins. Else it
//! is that of the cables, filtered by `S^-1 M` with the matrix S of the last linear solve, so that
//! vibrations which the step does not resolve do not determine it.
//!
//! # Validity
//!
//! Smooth motion. After a change by the host, and after an impact, O v is not that of the motion
//! which goes on: the error is not known there. It is proportional to that of the run: payload and
//! pendulum, tolerances of 1e-4, 1e-5 and 1e-6 m per host step (`tests/tolerance.rs`).
//!
//! # References
//!
//! Hairer, Norsett & Wanner 1993, III.2 (Milne's device: an estimate by differences of the steps at
//! hand).
//!
//! # Alternatives considered
//!
//! Two half steps and their difference (Richardson): three times the work; the extrapolated state
//! makes energy at any a below 1/16.

use super::body::BodyStep;
use super::{IslandStep, StepBuffers};
use crate::one_leg::{Factors, OneLeg};
use crate::system::{CableStep, project_vector};

impl IslandStep<'_, '_> {
    /// Returns the estimated error of the iterate in m; 0 where it is not known.
    pub(super) fn error_of_step(&mut self) -> f64 {
        if self.buffers.unsteady {
            return 0.0;
        }
        if self.buffers.bodies.iter().any(|body| body.free.contains(&true)) {
            return self.error_of_bodies(OneLeg::error_factors);
        }
        let errors = self.cables.iter_mut().map(|cable| error_of_cable(cable.step_parts(), OneLeg::error_factors));
        errors.fold(0.0, f64::max)
    }

    /// Returns the estimated error of the iterate in m, the largest of all cables and free bodies;
    /// `None` where it is not known.
    pub(super) fn estimate_of_step(&mut self) -> Option<f64> {
        let StepBuffers { unsteady, bodies, .. } = &*self.buffers;
        if *unsteady || bodies.iter().any(|body| body.free.contains(&true) && !body.is_estimated()) {
            return None;
        }
        let bodies = self.error_of_bodies(OneLeg::smooth_error_factors);
        self.cables.iter_mut().try_fold(bodies, |largest, cable| {
            let known = cable.snapshot.state.memory.differences.step > 0.0 && cable.step_buffers.kept > 0.0;
            known.then(|| largest.max(error_of_cable(cable.step_parts(), OneLeg::smooth_error_factors)))
        })
    }

    fn error_of_bodies(&self, factors: Factors) -> f64 {
        let centres = self.buffers.bodies.iter().map(|body| body.error([0.0; 3].into(), factors));
        let pins = self.layout.pins.iter().map(|pin| self.buffers.bodies[pin.body].error(pin.anchor, factors));
        centres.chain(pins).fold(0.0, f64::max)
    }

    /// Returns whether an impact changed velocities in the iterate.
    pub(super) fn has_impact(&self) -> bool {
        let landed = |x: &[f64]| x.iter().any(|x| *x != 0.0);
        self.cables.iter().any(|cable| landed(&cable.step_buffers.landed) || landed(&cable.step_buffers.taken))
            || self.buffers.bodies.iter().any(BodyStep::is_hit)
    }
}

/// Returns the error of a cable.
fn error_of_cable(CableStep { mut equations, state, buffers: b }: CableStep<'_>, factors: Factors) -> f64 {
    let before = state.memory.differences.step;
    if before == 0.0 || b.kept == 0.0 {
        return 0.0;
    }
    let [of_change, of_before] = factors(&b.leg, b.h / before, b.kept);
    for i in 0..b.external.len() {
        b.external[i] = b.h * (of_change * b.velocity_change[i] - of_before * b.velocity_before[i]);
    }
    let system = &mut *equations.system;
    system.mass.multiply(system.level, &b.external, &mut b.product);
    project_vector(equations.model, &mut b.product);
    equations.solve(&mut b.product);
    equations.system.scales.extent(&b.product).0
}
