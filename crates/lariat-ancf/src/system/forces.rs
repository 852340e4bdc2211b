//! Elastic forces and effects: everything that acts on a cable but loads.

use super::elements::Elements;
use super::lanes::MatrixOutput;
use crate::diagnostics::Diagnostics;
use crate::effect::acts::{ForceInput, PointForce, SampledPoint};
use crate::effect::force_density::ForceDensityTable;
use crate::effect::tables::{ElementTables, PointTables};
use crate::element::kernel::GramState;
use crate::element::side::Side;
use crate::model::Model;
use fearless_simd::Level;
use nalgebra::Vector3;

/// Elements and the tables of the effects that act during an evaluation.
#[derive(Clone, Debug)]
pub(crate) struct Forces {
    pub elements: Elements,
    /// Effects within the element kernel, if there are any.
    pub in_element: Option<ElementTables>,
    /// Effects at Gauss points.
    pub at_points: PointTables,
    /// Forces per length of the user's own.
    pub densities: Option<ForceDensityTable>,
}

impl Forces {
    pub fn new(model: &Model) -> Self {
        Forces {
            elements: Elements::new(model),
            in_element: model.in_element(),
            at_points: model.effects.at_points(&model.target()),
            densities: densities(model),
        }
    }

    /// Adds all forces to `out`, and overwrites the step matrix if that is asked for; `material`
    /// has the velocities of the material, which the others are not [at the eye of a
    /// reel](super::reel).
    pub fn add(
        &mut self,
        level: Level,
        [input, material]: [ForceInput<'_>; 2],
        out: &mut [f64],
        to: Option<MatrixOutput<'_>>,
        diagnostics: &mut Diagnostics,
    ) {
        let (elements, effects) = (&self.elements, self.in_element.as_ref());
        let mut matrix = match to {
            None => {
                elements.add_force(level, effects, input, out);
                None
            }
            Some(MatrixOutput { matrix, mass_scale }) => {
                let to = MatrixOutput { matrix: &mut *matrix, mass_scale };
                elements.add_force_and_matrix(level, effects, input, out, to);
                Some(matrix)
            }
        };
        let count = self.elements.count as u64;
        let counts = &mut diagnostics.effects;
        if let Some(effects) = effects {
            effects.count(count, !input.v.is_empty(), counts);
        }
        self.at_points.add(level, material, out, matrix.as_deref_mut(), (count, counts));
        if let Some(densities) = &mut self.densities {
            densities.add(level, material, out, matrix);
            counts.force_densities += count;
        }
    }

    /// Returns axial and bending energy in J, from the rest shape.
    pub fn strain_energy(&self, q: &[f64]) -> (f64, f64) {
        let (axial, bending) = self.elements.energy(q);
        match &self.in_element {
            None => (axial, bending),
            Some(effects) => {
                let of_effects = self.elements.effect_energy(effects, q);
                (axial + of_effects.0, bending + of_effects.1)
            }
        }
    }

    /// Returns the strain that effects add to the one that makes tension.
    pub fn strain_of_effects(&self, element: usize, xi: f64, at: &GramState<'_, f64>) -> f64 {
        self.in_element.as_ref().map_or(0.0, |effects| effects.strain(element, xi, at))
    }

    /// Lets an axial law that cannot push do so, or not any more; returns whether there is one.
    pub fn push(&mut self, pushes: bool) -> bool {
        let law = self.in_element.as_mut().and_then(|effects| effects.axial_law.as_mut());
        law.is_some_and(|law| law.push(pushes))
    }

    /// Returns the curvature in 1/m that effects add to the one that makes the bending moment.
    pub fn curvature_of_effects(&self, at: &SampledPoint<'_>) -> Vector3<f64> {
        self.in_element.as_ref().map_or_else(Vector3::zeros, |effects| effects.curvature(at))
    }

    /// Returns whether anything acts at Gauss points.
    pub fn act_at_points(&self) -> bool {
        self.at_points.any() || self.densities.is_some()
    }

    /// Returns whether a force can move a cable at rest although it has no potential.
    pub fn drive(&self) -> bool {
        self.at_points.drive() || self.densities.is_some()
    }

    /// Makes all forces steady: as they are at `time` (s).
    pub fn hold(&mut self, time: f64) {
        self.at_points.hold(time);
        if let Some(densities) = &mut self.densities {
            densities.hold(time);
        }
    }

    /// Makes all forces steady as [`hold`](Self::hold) does, with a share of what drives them.
    pub fn hold_share(&mut self, model: &Model, time: f64, share: f64) {
        self.release(model);
        self.hold(time);
        self.at_points.drive_by(share);
        if let Some(densities) = &mut self.densities {
            densities.drive_by(share);
        }
    }

    /// Ends what [`hold`](Self::hold) began.
    pub fn release(&mut self, model: &Model) {
        self.at_points = model.effects.at_points(&model.target());
        let origin = self.densities.as_ref().map(ForceDensityTable::origin);
        self.densities = densities(model);
        if let (Some(densities), Some(origin)) = (&mut self.densities, origin) {
            densities.set_origin(origin);
        }
    }

    /// Takes over gravity, which acts on water too.
    pub fn weigh_water(&mut self, model: &Model) {
        if self.at_points.buoyancy.is_some() {
            self.at_points = model.effects.at_points(&model.target());
        }
    }

    /// The quantity of the last evaluation that was not finite and its node, if a function of the
    /// user's made it.
    pub fn not_finite(&self) -> Option<(&'static str, usize)> {
        self.densities.as_ref()?.not_finite().map(|element| ("force density", element))
    }
}

/// Returns the table of the forces per length of a cable.
fn densities(model: &Model) -> Option<ForceDensityTable> {
    model.force_densities.at_points(&model.elements, model.reels.get(Side::Start).is_some())
}
