//! Static equilibrium from any start, slack or taut: F(q) = 0 by pseudo-transient Newton iteration.
//!
//! ```text
//! (K + mu M) dq = F(q)
//! ```
//!
//! Large mu follows the gradient of the potential energy in the metric of mass, mu = 0 is Newton's method. A step is kept if it
//! lowers the energy and the matrix is positive definite; then mu falls, else it grows. A moment enters by its work over the
//! step, the angle about its axis by which the tangent turns: it has no potential, but the work of each step is its own. So the iteration goes downhill to a *stable* shape, and ends quadratically. Increments are capped.
//! If it fails, point loads are ramped; if that fails, the ramp is followed by plain Newton steps, which also find unstable shapes;
//! if that fails or ends unstable, the cable is moved by an L-stable integrator whose velocities are dropped at every peak of
//! kinetic energy (dynamic relaxation), and the iteration starts again from there. An unstable shape is returned if no stable one is found.
//!
//! *Source.* Kelley & Keyes 1998 (pseudo-transient continuation); Barnes 1999 (dynamic relaxation with kinetic damping).
//! *Validity.* Any cable that is held against its loads; without bending, slack parts without load are indeterminate and any shape
//! of zero force is returned. *Rejected.* Plain Newton (a slack cable is singular), arc length methods (no branch is followed).

use crate::cable::{Cable, Equations, Model, project_vector};
use crate::element::shape;
use crate::error::{Error, StepFailure};
use crate::integrate::{Dynamics, Integrator, Method, NewtonMode, StepControl};
use crate::linalg::Definiteness;
use crate::load::PointLoad;
use nalgebra::Vector3;

/// When a shape counts as an equilibrium, and when to give up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumOptions {
    /// Largest residual force over the sum of the loads. Default 1e-9.
    pub tolerance: f64,
    /// Iterations of each attempt. Default 400.
    pub iterations: usize,
}

impl Default for EquilibriumOptions {
    fn default() -> Self {
        EquilibriumOptions { tolerance: 1e-9, iterations: 400 }
    }
}

/// What [`Cable::equilibrium`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumReport {
    /// Iterations done, all attempts together.
    pub iterations: usize,
    /// Largest residual force in N.
    pub residual: f64,
    /// True if the tangent stiffness is positive definite there; false for an unstable or indifferent shape.
    pub stable: bool,
}

/// Largest change of a slope vector in one iteration.
const SLOPE_CAP: f64 = 0.3;
/// Ramp steps of the second attempt.
const RAMP_STEPS: usize = 20;
/// Newton iterations of a ramp step in the third attempt.
const FOLLOW_ITERATIONS: usize = 25;
/// Steps of dynamic relaxation in the fourth attempt.
const RELAXATION_STEPS: usize = 400;

impl Cable {
    /// Moves the cable to static equilibrium under gravity, its full point loads and its supports; velocities become zero.
    ///
    /// # Errors
    /// [`Error::NoEquilibrium`] if none is found; the cable is then as before.
    pub fn equilibrium(&mut self) -> Result<EquilibriumReport, Error> {
        self.equilibrium_with(EquilibriumOptions::default())
    }

    /// [`equilibrium`](Self::equilibrium) with options.
    ///
    /// # Errors
    /// As [`equilibrium`](Self::equilibrium).
    pub fn equilibrium_with(&mut self, options: EquilibriumOptions) -> Result<EquilibriumReport, Error> {
        let before = self.state.clone();
        let loads = self.model.loads.clone();
        // "time" runs from no load (0) to full load (1) while statics are solved
        self.model.loads.iter_mut().for_each(|load| load.ramp = 1.0);
        let outcome = self.attempts(options);
        self.model.loads = loads;
        match outcome {
            Ok(report) => {
                let phase = &mut self.state.phase;
                phase.v.fill(0.0);
                self.disturb();
                Ok(report)
            }
            Err(failure) => {
                self.state = before;
                let held = !self.model.supports.is_empty();
                let reason = match &failure.cause {
                    _ if !held => "nothing holds the cable".to_string(),
                    Some(cause) => cause.to_string(),
                    None => "the iteration did not converge".to_string(),
                };
                Err(Error::NoEquilibrium {
                    cable: self.name().to_string(),
                    reason,
                    residual: failure.residual,
                    iterations: failure.iterations,
                })
            }
        }
    }

    fn attempts(&mut self, options: EquilibriumOptions) -> Result<EquilibriumReport, Failure> {
        let start = self.state.clone();
        let mut done = 0;
        let first = self.descend(1.0, options, &mut done);
        if first.is_ok() || self.model.supports.is_empty() {
            return first;
        }
        if !self.model.loads.is_empty() {
            self.state = start.clone();
            let ramp = (1..=RAMP_STEPS)
                .try_fold(None, |_, i| self.descend(i as f64 / RAMP_STEPS as f64, options, &mut done).map(Some));
            if let Ok(Some(report)) = ramp {
                return Ok(report);
            }
        }
        let unstable = if self.model.loads.is_empty() {
            None
        } else {
            // at full load from a shape near by, else from no load
            [RAMP_STEPS, 1].into_iter().find_map(|first| {
                self.state = start.clone();
                self.follow(first, options, &mut done).map(|report| (report, self.state.clone()))
            })
        };
        if let Some((report, state)) = unstable.as_ref().filter(|(report, _)| report.stable) {
            self.state = state.clone();
            return Ok(*report);
        }
        self.state = start;
        let relaxed = match self.relax() {
            Ok(()) => self.descend(1.0, options, &mut done),
            Err(cause) => Err(Failure { cause: Some(cause), residual: f64::NAN, iterations: done }),
        };
        match (relaxed, unstable) {
            (Ok(report), _) if report.stable => Ok(report),
            (_, Some((report, state))) => {
                self.state = state;
                Ok(EquilibriumReport { iterations: done, ..report })
            }
            (relaxed, None) => relaxed,
        }
    }

    /// Newton's method with capped increments along the ramp of the loads from its step `first` on: finds unstable shapes too. `None` if it does not converge.
    fn follow(&mut self, first: usize, options: EquilibriumOptions, done: &mut usize) -> Option<EquilibriumReport> {
        let scale = LoadScale::of(&self.model, self.positions());
        let mut phase = core::mem::take(&mut self.state.phase);
        let mut rhs = vec![0.0; phase.q.len()];
        let (mut equations, _) = self.equations();
        equations.prescribe(phase.time, &mut phase.q, &mut phase.v);
        let mut report = None;
        'ramp: for i in first..=RAMP_STEPS {
            report = None;
            for _ in 0..FOLLOW_ITERATIONS {
                *done += 1;
                equations.force_and_matrix(i as f64 / RAMP_STEPS as f64, &phase.q, 1.0, 0.0, &mut rhs);
                project_vector(equations.model, &mut rhs);
                let residual = largest_force(&rhs, scale.element);
                let Ok(kind) = equations.factor() else { break 'ramp };
                if residual <= options.tolerance * scale.force + scale.rounding {
                    let stable = matches!(kind, Definiteness::PositiveDefinite);
                    report = Some(EquilibriumReport { iterations: *done, residual, stable });
                    break;
                }
                equations.solve(&mut rhs);
                let slope = rhs.chunks_exact(6).flat_map(|x| &x[3..]).fold(0.0f64, |m, x| m.max(x.abs()));
                let damp = SLOPE_CAP / slope.max(SLOPE_CAP);
                if !damp.is_finite() {
                    break 'ramp;
                }
                phase.q.iter_mut().zip(&rhs).for_each(|(q, dq)| *q += damp * dq);
            }
            if report.is_none() {
                break;
            }
        }
        self.state.phase = phase;
        report
    }

    /// The iteration at a share `load` of the point loads.
    fn descend(
        &mut self,
        load: f64,
        options: EquilibriumOptions,
        done: &mut usize,
    ) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::of(&self.model, self.positions());
        let time = self.time();
        let n = self.positions().len();
        let mut phase = core::mem::take(&mut self.state.phase);
        let (mut equations, _) = self.equations();
        equations.prescribe(time, &mut phase.q, &mut phase.v);
        let (mut rhs, mut trial) = (vec![0.0; n], vec![0.0; n]);
        let mut mu = scale.mu;
        let mut merit = f64::INFINITY;
        let mut residual = f64::NAN;
        let mut cause = None;
        let mut report = None;
        for _ in 0..options.iterations {
            *done += 1;
            equations.force_and_matrix(load, &phase.q, 1.0, mu, &mut rhs);
            project_vector(equations.model, &mut rhs);
            residual = largest_force(&rhs, scale.element);
            if !residual.is_finite() {
                cause = Some(StepFailure::NotFinite { what: "force", node: 0 });
                break;
            }
            if !merit.is_finite() {
                merit = potential(&equations, load, &phase.q);
            }
            let small = residual <= options.tolerance * scale.force + scale.rounding;
            let kind = equations.factor();
            let definite = matches!(kind, Ok(Definiteness::PositiveDefinite));
            if small && mu == 0.0 {
                report = Some(EquilibriumReport { iterations: *done, residual, stable: definite });
                break;
            }
            if small {
                // converged in force: the last step is Newton's, to settle the shape and to judge stability
                mu = if definite { 0.0 } else { mu };
                if mu == 0.0 {
                    equations.force_and_matrix(load, &phase.q, 1.0, 0.0, &mut rhs);
                    let stable = matches!(equations.factor(), Ok(Definiteness::PositiveDefinite));
                    if !stable {
                        report = Some(EquilibriumReport { iterations: *done, residual, stable });
                        break;
                    }
                }
            }
            if !definite {
                cause = kind.err();
                mu = (4.0 * mu).max(scale.mu * 1e-6);
                if mu > scale.mu * 1e15 {
                    break;
                }
                continue;
            }
            equations.solve(&mut rhs);
            let slope = rhs.chunks_exact(6).flat_map(|x| &x[3..]).fold(0.0f64, |m, x| m.max(x.abs()));
            let move_ = rhs.chunks_exact(6).flat_map(|x| &x[..3]).fold(0.0f64, |m, x| m.max(x.abs()));
            let damp = (SLOPE_CAP / slope.max(SLOPE_CAP)).min(0.2 * scale.length / move_.max(0.2 * scale.length));
            for i in 0..n {
                trial[i] = phase.q[i] + damp * rhs[i];
            }
            equations.force(load, &trial, 1.0, &mut rhs);
            project_vector(equations.model, &mut rhs);
            let after = largest_force(&rhs, scale.element);
            let trial_merit = potential(&equations, load, &trial);
            let change = trial_merit - merit - load * moment_work(equations.model, &phase.q, &trial);
            // energies differ by less than their rounding near the end: then the residual decides
            let lower = change < -scale.energy_rounding || (change <= scale.energy_rounding && after <= residual);
            if lower {
                phase.q.copy_from_slice(&trial);
                merit = trial_merit;
                mu = if mu < scale.mu * 1e-9 || after < 1e-6 * scale.force { 0.0 } else { mu / 4.0 };
            } else if mu == 0.0 && after <= residual * 4.0 && small {
                report = Some(EquilibriumReport { iterations: *done, residual, stable: true });
                break;
            } else {
                mu = (10.0 * mu).max(scale.mu * 1e-6);
                if mu > scale.mu * 1e15 {
                    break;
                }
            }
        }
        self.state.phase = phase;
        report.ok_or(Failure { cause, residual, iterations: *done })
    }

    /// Dynamic relaxation with kinetic damping.
    fn relax(&mut self) -> Result<(), StepFailure> {
        let integrator = self.integrator();
        let scale = LoadScale::of(&self.model, self.positions());
        let step = 0.3 / scale.mu.sqrt();
        let method = Method::GeneralisedAlpha { rho: 0.0, newton: NewtonMode::Converged };
        let quiet = Integrator { method, control: StepControl::Substeps(1) };
        let time = self.time();
        let mut outcome = self.set_integrator(quiet);
        // the ramp is in "time": hold it at full load
        let loads = self.model.loads.clone();
        self.model.loads.iter_mut().for_each(|load| load.ramp = 0.0);
        let mut kinetic = 0.0;
        for _ in 0..RELAXATION_STEPS {
            if outcome.is_err() {
                break;
            }
            outcome = self.step(step);
            let now = self.energy().kinetic;
            if now < kinetic {
                self.state.phase.v.fill(0.0);
                self.disturb();
                kinetic = 0.0;
            } else {
                kinetic = now;
            }
        }
        self.model.loads = loads;
        self.state.phase.time = time;
        let restored = self.set_integrator(integrator);
        match outcome.and(restored) {
            Err(Error::StepRefused { failure, .. }) => Err(failure),
            _ => Ok(()),
        }
    }
}

struct Failure {
    cause: Option<StepFailure>,
    residual: f64,
    iterations: usize,
}

/// Sizes by which "small" is judged.
struct LoadScale {
    /// Sum of the loads, or the largest tension at the start if there are none, in N.
    force: f64,
    /// Force that rounding alone makes, in N.
    rounding: f64,
    /// Energy that rounding alone makes, in J.
    energy_rounding: f64,
    /// Start of mu in 1/s^2.
    mu: f64,
    /// Length of the cable in m.
    length: f64,
    /// Length of the shortest element in m.
    element: f64,
}

impl LoadScale {
    fn of(model: &Model, q: &[f64]) -> Self {
        let length = model.length();
        let mass: f64 = model.elements.iter().map(|e| e.length * e.section.mass_per_length).sum();
        let stiffest = model.elements.iter().map(|e| e.section.axial_stiffness).fold(0.0f64, f64::max);
        let shortest = model.elements.iter().map(|e| e.length).fold(f64::INFINITY, f64::min);
        let loads: f64 = model.loads.iter().map(|l| l.force.norm() + l.moment.norm() / length).sum();
        let strain = q
            .chunks_exact(6)
            .map(|x| 0.5 * (x[3] * x[3] + x[4] * x[4] + x[5] * x[5] - 1.0).abs())
            .fold(0.0f64, f64::max);
        let outer = loads + mass * model.gravity.norm();
        let force = if outer > 0.0 { outer } else { stiffest * strain.clamp(1e-9, 1.0) };
        let reach = q.chunks_exact(6).flat_map(|x| &x[..3]).fold(1.0f64, |m, x| m.max(x.abs()));
        let epsilon = f64::EPSILON * (1.0 + reach / shortest);
        LoadScale {
            force,
            rounding: 16.0 * stiffest * epsilon,
            energy_rounding: 16.0 * stiffest * length * f64::EPSILON,
            mu: 10.0 * force / (mass * length),
            length,
            element: shortest,
        }
    }
}

/// Largest force on a node in N: on its position, and on its slope over the length `arm` (m), which is where moments act.
fn largest_force(rhs: &[f64], arm: f64) -> f64 {
    rhs.chunks_exact(6).fold(0.0f64, |worst, x| {
        let force = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        let moment = (x[3] * x[3] + x[4] * x[4] + x[5] * x[5]).sqrt() / arm;
        let size = if force > moment || force.is_nan() { force } else { moment };
        if size > worst || size.is_nan() { size } else { worst }
    })
}

/// Work in J of the full moments while the tangents at their points turn from `from` to `to`: moment times angle about its axis.
fn moment_work(model: &Model, from: &[f64], to: &[f64]) -> f64 {
    let turn = |load: &PointLoad| {
        let size = load.moment.norm();
        if size == 0.0 {
            return 0.0;
        }
        let axis = load.moment / size;
        let (e, xi) = model.locate(load.arc_length);
        let weights = shape::slope(xi, model.elements[e].length);
        let normal = |q: &[f64]| {
            let n = &q[6 * e..6 * e + 12];
            let t: Vector3<f64> = (0..4).map(|k| weights[k] * Vector3::from_column_slice(&n[3 * k..3 * k + 3])).sum();
            t - axis * axis.dot(&t)
        };
        let (a, b) = (normal(from), normal(to));
        size * axis.dot(&a.cross(&b)).atan2(a.dot(&b))
    };
    model.loads.iter().map(turn).sum()
}

/// Potential energy in J, forces at a share `load`.
fn potential(equations: &Equations<'_>, load: f64, q: &[f64]) -> f64 {
    let (axial, bending) = equations.system.elements.energy(q);
    axial + bending - equations.system.gravity_work(q) - equations.system.load_work(equations.model, load, q)
}
