//! The consistent mass matrix of a cable, and its factors with the supports in place.

use super::project_matrix;
use crate::element::mass;
use crate::error::StepFailure;
use crate::linalg::{BlockTridiagonal, Factorisation, MassFactorisation, MassMatrix};
use crate::model::Model;
use crate::support::SlopeSupport;
use fearless_simd::Level;

/// Factors of the mass matrix.
#[derive(Clone, Debug)]
enum MassFactors {
    /// The same 2x2 blocks for x, y and z.
    Scalar(MassFactorisation),
    /// 6x6 blocks, where a slope is held to a direction.
    Block(Box<Factorisation>),
}

/// The mass matrix, added mass included.
#[derive(Clone, Debug)]
pub(crate) struct Mass {
    matrix: MassMatrix,
    factors: MassFactors,
}

impl Mass {
    /// Assembles the matrix and factors it.
    pub fn new(level: Level, model: &Model) -> Result<Self, StepFailure> {
        let nodes = model.nodes();
        let mut matrix = MassMatrix { diag: vec![[0.0; 3]; nodes], lower: vec![[0.0; 4]; nodes - 1] };
        for (e, element) in model.elements.iter().enumerate() {
            let m = mass::consistent(model.inertia(element), element.length);
            for (node, k) in [(e, 0), (e + 1, 2)] {
                matrix.diag[node][0] += m[k][k];
                matrix.diag[node][1] += m[k][k + 1];
                matrix.diag[node][2] += m[k + 1][k + 1];
            }
            matrix.lower[e] = [m[2][0], m[2][1], m[3][0], m[3][1]];
        }
        let mut mass = Mass { matrix, factors: MassFactors::Scalar(MassFactorisation::default()) };
        mass.factor(level, model)?;
        Ok(mass)
    }

    /// Sets the mass of element `e` to that of its length in m, with a mass in kg at each end of
    /// the cable; the factors stay.
    pub fn set_element(&mut self, model: &Model, e: usize, length: impl Fn(usize) -> f64, at_ends: [f64; 2]) {
        let of = |e: Option<usize>| match e.filter(|&e| e < model.elements.len()) {
            Some(e) => mass::consistent(model.inertia(&model.elements[e]), length(e)),
            None => [[0.0; 4]; 4],
        };
        let [before, m, after] = [e.checked_sub(1), Some(e), Some(e + 1)].map(of);
        for (node, [i, j]) in [(e, [&before, &m]), (e + 1, [&m, &after])] {
            let first = if node == 0 { at_ends[0] } else { 0.0 };
            let last = if node == model.elements.len() { at_ends[1] } else { 0.0 };
            self.matrix.diag[node] = [i[2][2] + j[0][0] + first + last, i[2][3] + j[0][1], i[3][3] + j[1][1]];
        }
        self.matrix.lower[e] = [m[2][0], m[2][1], m[3][0], m[3][1]];
    }

    /// Factors the matrix with the present supports.
    pub fn factor(&mut self, level: Level, model: &Model) -> Result<(), StepFailure> {
        let directed = model.supports.iter().any(|(_, s)| s.slope.is_direction());
        self.factors = if directed {
            let mut matrix = BlockTridiagonal::zeros(model.nodes());
            self.add_to(&mut matrix, 1.0);
            project_matrix(model, &mut matrix);
            let mut factorisation = Factorisation::default();
            factorisation.factor(level, &matrix)?;
            MassFactors::Block(Box::new(factorisation))
        } else {
            let mut factorisation = MassFactorisation::default();
            factorisation.factor(&self.with_held_rows(model))?;
            MassFactors::Scalar(factorisation)
        };
        Ok(())
    }

    /// The matrix with rows and columns of held coordinates replaced by those of the identity.
    fn with_held_rows(&self, model: &Model) -> MassMatrix {
        let mut held = self.matrix.clone();
        for (node, support) in &model.supports {
            for (held_here, row) in [(support.holds_position(), 0), (support.slope != SlopeSupport::Free, 1)] {
                if !held_here {
                    continue;
                }
                held.diag[*node][2 * row] = 1.0;
                held.diag[*node][1] = 0.0;
                if *node > 0 {
                    held.lower[node - 1][2 * row] = 0.0;
                    held.lower[node - 1][2 * row + 1] = 0.0;
                }
                if *node + 1 < model.nodes() {
                    held.lower[*node][row] = 0.0;
                    held.lower[*node][2 + row] = 0.0;
                }
            }
        }
        held
    }

    /// Returns the matrix.
    pub fn matrix(&self) -> &MassMatrix {
        &self.matrix
    }

    /// Returns the mass of all, added mass included.
    pub fn total(&self) -> f64 {
        self.matrix.total()
    }

    /// Solves with the factors, in place.
    pub fn solve(&self, level: Level, rhs: &mut [f64]) {
        match &self.factors {
            MassFactors::Scalar(factorisation) => factorisation.solve(level, rhs),
            MassFactors::Block(factorisation) => factorisation.solve(level, rhs),
        }
    }

    /// Computes `y = M x`.
    pub fn multiply(&self, level: Level, x: &[f64], y: &mut [f64]) {
        self.matrix.multiply_at(level, x, y);
    }

    /// Adds `scale M` to a matrix.
    pub fn add_to(&self, matrix: &mut BlockTridiagonal, scale: f64) {
        for (block, m) in matrix.diag.iter_mut().zip(&self.matrix.diag) {
            for x in 0..3 {
                block.0[x][x] += scale * m[0];
                block.0[x][3 + x] += scale * m[1];
                block.0[3 + x][x] += scale * m[1];
                block.0[3 + x][3 + x] += scale * m[2];
            }
        }
        for (block, m) in matrix.lower.iter_mut().zip(&self.matrix.lower) {
            for x in 0..3 {
                block.0[x][x] += scale * m[0];
                block.0[3 + x][x] += scale * m[1];
                block.0[x][3 + x] += scale * m[2];
                block.0[3 + x][3 + x] += scale * m[3];
            }
        }
    }
}
