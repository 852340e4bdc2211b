//! Drag of a fluid or wind on the moving cable: Morison's formula, normal and tangential.
//!
//! # Equation
//!
//! ```text
//! f = -1/2 rho_f d (C_n |v_n| v_n + C_t |v_t| v_t)        F = int S^T f ds
//! v = r' - u(r, t)      v_t = (v.e) e      v_n = v - v_t      e = t/|t|
//! -df/dv = k_n (|v_n| (I - e e^T) + v_n v_n^T/|v_n|) + 2 k_t |v.e| e e^T                               k = 1/2 rho_f d C
//! df/dt = (1/|t|) [k_n (|v_n| (e v_n^T + c P) + c v_n v_n^T/|v_n|) - k_t (2 |c| e v_n^T + |c| c P)]         c = v.e, P = I - e e^T
//! ```
//!
//! (here r' is the velocity, t the slope dr/ds.) f is a force per length of the unstretched cable,
//! integrated at three Gauss points. Both coefficients refer to the diameter.
//!
//! The derivative by velocity is exact and symmetric. By the slope the formula above is exact, of
//! which the step takes the symmetric half (its matrix is stored by one triangle); the gradient of
//! the flow in space is left out. Newton's iteration is then linear with a small factor, which its
//! stopping test knows. The exact derivative is
//! [`Cable::jacobians`](crate::coupling::Linearisation::jacobians)'s.
//!
//! # Validity
//!
//! A slender cable, stretch near 1; steady coefficients; no lift, no shedding of vortices; added
//! mass is [`buoyancy`](super::buoyancy)'s.
//!
//! # References
//!
//! Morison, O'Brien, Johnson & Schaaf 1950; Faltinsen 1990, ch. 7 (the cross-flow principle).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/elements.md.

mod lanes;
mod law;
mod over_step;

pub(crate) use lanes::DragTable;
pub use law::Drag;

use super::acts::{Acts, Nothing};
use super::{Cut, Effect, Target};
use crate::error::{Error, Requirement, require};

impl Effect for Drag {
    const DISSIPATIVE: bool = true;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        require("fluid density (kg/m^3)", self.fluid_density, self.fluid_density > 0.0, "> 0")?;
        require("normal drag coefficient", self.normal, self.normal >= 0.0, ">= 0")?;
        require("tangential drag coefficient", self.tangential, self.tangential >= 0.0, ">= 0")?;
        if let Some(diameter) = self.diameter {
            require("drag diameter (m)", diameter, diameter > 0.0, "> 0")?;
        }
        self.flow.check()?;
        let samples = self.flow.samples.len();
        if samples != 0 && samples != cable.nodes() {
            let (cable, expected) = (cable.name.to_string(), cable.nodes());
            return Err(Error::WrongCount { cable, what: "samples of the flow", count: samples, expected });
        }
        if self.diameter.is_none() && cable.elements.iter().any(|e| e.section.diameter.is_none()) {
            return Err(cable.missing("drag", Requirement::Diameter));
        }
        Ok(())
    }

    fn depends_on_velocity(&self) -> bool {
        true
    }

    fn has_exact_tangent(&self) -> bool {
        false
    }

    fn needs_implicit_integrator(&self) -> bool {
        false
    }

    fn is_steady(&self, from: f64, to: f64) -> bool {
        self.flow.is_steady(from, to)
    }

    fn cut(&self, Cut { node, .. }: Cut<'_>) -> [Option<Self>; 2] {
        let [mut head, mut tail] = [self.clone(), self.clone()];
        if !self.flow.samples.is_empty() {
            head.flow.samples.truncate(node + 1);
            tail.flow.samples.drain(..node);
        }
        [Some(head), Some(tail)]
    }

    fn refine(&mut self, element: usize, xi: f64) {
        let samples = &mut self.flow.samples;
        if !samples.is_empty() {
            let between = samples[element] * (1.0 - xi) + samples[element + 1] * xi;
            samples.insert(element + 1, between);
        }
    }
}

impl Acts for Drag {
    type InElement = Nothing;
    type AtPoints = DragTable;

    fn at_points(&self, cable: &Target<'_>) -> Option<DragTable> {
        Some(DragTable::new(self, cable))
    }
}
