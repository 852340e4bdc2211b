//! Leaving an unstable equilibrium along its softest mode.
//!
//! # Equation
//!
//! `K x = lambda M x` with the lowest lambda, by inverse iteration with `K + mu M`, mu the least of
//! a geometric sequence that makes it positive definite. If lambda is negative beyond rounding the
//! equilibrium is a saddle of the potential energy: a straight column above its critical load. A
//! small displacement along x, to the side to which the residual force points, leads down to a
//! stable shape.
//!
//! # Validity
//!
//! Shapes under forces, which have a potential. A mode without energy (lambda = 0) is not followed:
//! the shape is indifferent.
//!
//! # References
//!
//! Parlett 1998, section 4.2 (inverse iteration); Wriggers, Wagner & Miehe 1988 (perturbation by
//! the eigenvector at a bifurcation).

use super::attempt::{Budget, largest_change};
use super::pseudo_transient::Minimisation;
use crate::linalg::Definiteness;
use crate::scales::statics::{DISPLACEMENT, GROWTH, INVERSE_ITERATIONS, NEGATIVE, SMALL_SHARE};
use crate::system::project_vector;

impl Minimisation<'_> {
    /// Displaces `q` along its softest mode, and returns whether it has one of negative stiffness.
    pub(super) fn leave_saddle(&mut self, q: &mut [f64], budget: &mut Budget) -> bool {
        let first = self.scale.mu;
        let mut mu = 1e-6 * first;
        loop {
            if !budget.take() || mu > 1e9 * first {
                return false;
            }
            self.mu = mu;
            self.evaluate(q);
            if matches!(self.equations.factor(), Ok(Definiteness::PositiveDefinite)) {
                break;
            }
            mu *= GROWTH;
        }
        let Self { equations, rhs, step, inertia, .. } = self;
        // a start with a share of every mode, the same in every run; of equal modes the one that
        // the residual force points to
        let force = rhs.iter().fold(0.0f64, |most, f| most.max(f.abs())).max(f64::MIN_POSITIVE);
        let mut seed = 1u64;
        for (x, f) in step.iter_mut().zip(rhs.iter()) {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            *x = f / force + SMALL_SHARE * ((seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5);
        }
        project_vector(equations.model, step);
        let downhill: Vec<f64> = rhs.clone();
        let mut lambda = 0.0;
        for _ in 0..INVERSE_ITERATIONS {
            equations.system.mass.multiply(equations.system.level, step, inertia);
            let square: f64 = step.iter().zip(inertia.iter()).map(|(a, b)| a * b).sum();
            rhs.copy_from_slice(inertia);
            equations.solve(rhs);
            let product: f64 = rhs.iter().zip(inertia.iter()).map(|(a, b)| a * b).sum();
            lambda = square / product - mu;
            let (displacement, slope) = largest_change(rhs);
            let size = slope.max(displacement / self.scale.length);
            step.iter_mut().zip(rhs.iter()).for_each(|(x, y)| *x = y / size);
        }
        let rounding = self.scale.rounding / (self.scale.mass * self.scale.element);
        let is_saddle = lambda < NEGATIVE * first - rounding && step.iter().all(|x| x.is_finite());
        if is_saddle {
            let along: f64 = step.iter().zip(&downhill).map(|(a, b)| a * b).sum();
            let size = DISPLACEMENT.copysign(along);
            q.iter_mut().zip(step.iter()).for_each(|(q, x)| *q += size * x);
        }
        is_saddle
    }
}
