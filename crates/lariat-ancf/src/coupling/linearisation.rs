//! The matrices of a cable, and what is told of its mesh.

use crate::cable::Cable;
pub use crate::cable::linearise::TwistBorder;
use crate::cable::mesh::{MeshIndicator, MotionIndicator};
use crate::effect::Damping;
use crate::error::Error;
use crate::linalg::BlockTridiagonal;
use crate::system::jacobian::Jacobians;
use fearless_simd::Level;

/// The matrices of a cable at its present state, bounds of its frequencies, and what is told of its
/// mesh: for control, for integrators of your own, and for tests.
pub trait Linearisation {
    /// Applies the supports to a matrix: held rows and columns become those of the identity.
    fn apply_supports(&self, matrix: &mut BlockTridiagonal);

    /// Returns the damping matrix -dF/dq' at the present state over all coordinates (N s/m, N s, N
    /// m s); supports are not applied.
    fn damping_matrix(&mut self) -> BlockTridiagonal;

    /// Computes [`force`](Self::force) into a slice of 6 numbers per node; allocates nothing.
    fn evaluate(&mut self, force: &mut [f64]);

    /// Computes the force into a slice of 6 numbers per node, and the stiffness as
    /// [`stiffness_matrix`](Self::stiffness_matrix) does; allocates nothing after the first time,
    /// when the cable gets a matrix of its own.
    fn evaluate_with_stiffness(&mut self, force: &mut [f64]) -> &BlockTridiagonal;

    /// Returns the generalised force at the present state: elastic, gravity, loads and effects (N
    /// on positions, N m on slopes); no reactions.
    fn force(&mut self) -> Vec<f64>;

    /// Returns the exact derivatives of the force at the present state, supports not applied.
    /// Dense, and some ten times the work of [`stiffness_matrix`](Self::stiffness_matrix): for tens
    /// or hundreds of nodes.
    fn jacobians(&self) -> Jacobians;

    /// Returns the consistent mass matrix over all coordinates (kg, kg m, kg m^2); supports are not
    /// applied.
    fn mass_matrix(&mut self) -> BlockTridiagonal;

    /// Returns the tangent stiffness -dF/dq at the present state over all coordinates (N/m, N, N
    /// m); supports are not applied. Of damping, drag and forces of your own the part that the step
    /// matrix takes, see [`damping`](crate::effect::damping), [`drag`](crate::effect::drag) and
    /// [`force_density`](crate::effect::force_density); all of it: [`jacobians`](Self::jacobians).
    fn stiffness_matrix(&mut self) -> BlockTridiagonal;

    /// Returns what [torsion](crate::Torsion) adds to stiffness and damping beyond
    /// [`stiffness_matrix`](Self::stiffness_matrix), which has the part M d2 Phi of its torque;
    /// none without torsion, or where no two nodes hold the spin.
    fn twist_borders(&self) -> Vec<TwistBorder>;

    /// Returns an upper bound of the cable's angular frequencies in rad/s; effects and forces of
    /// your own are not in it, but added mass and the rest stretch.
    fn frequency_bound(&self) -> f64;

    /// Forces a SIMD level, for benchmarks and for the test that all levels agree. Not part of the
    /// state.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix cannot be factored.
    #[doc(hidden)]
    fn set_simd_level(&mut self, level: Level) -> Result<(), Error>;

    /// Returns an indicator of the error of the mesh for the present shape.
    fn mesh_indicator(&self) -> MeshIndicator;

    /// Returns the indicator for the displacement from the positions `start`, as
    /// [`positions`](Cable::positions) returned them: for a small motion of a cable whose shape is
    /// resolved.
    ///
    /// # Errors
    /// [`Error::WrongCount`] for positions of another number of nodes.
    fn motion_indicator(&self, start: &[f64]) -> Result<MotionIndicator, Error>;

    /// Returns the Kelvin-Voigt times that damp the `mode`-th lowest natural frequency, counted
    /// from 1, by this damping ratio (fraction of critical):
    /// [`natural_frequencies`](Cable::natural_frequencies) at the present state without
    /// zero-frequency modes, and [`Damping::from_ratio`]. In space a bending mode comes twice, once
    /// per plane. The curvature's time is 0 for a cable without bending.
    ///
    /// ```
    /// # use lariat_ancf::coupling::Linearisation;
    /// # use lariat_ancf::{At, Cable, Section, Vector3};
    /// # let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    /// # let mut cable = Cable::builder().points(points).section(Section::round(0.01, 1e8, 4000.0)?).clamp(At::Start).build()?;
    /// let damping = cable.damping_at_mode(0.05, 1)?;
    /// cable.set_damping(damping)?;
    /// # Ok::<(), lariat_ancf::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a mode that the cable does not have, [`Error::InvalidValue`] for a
    /// ratio below 0 or not finite.
    fn damping_at_mode(&mut self, ratio: f64, mode: usize) -> Result<Damping, Error>;
}

impl Linearisation for Cable {
    fn apply_supports(&self, matrix: &mut BlockTridiagonal) {
        Cable::apply_supports(self, matrix)
    }

    fn damping_matrix(&mut self) -> BlockTridiagonal {
        Cable::damping_matrix(self)
    }

    fn evaluate(&mut self, force: &mut [f64]) {
        Cable::evaluate(self, force)
    }

    fn evaluate_with_stiffness(&mut self, force: &mut [f64]) -> &BlockTridiagonal {
        Cable::evaluate_with_stiffness(self, force)
    }

    fn force(&mut self) -> Vec<f64> {
        Cable::force(self)
    }

    fn jacobians(&self) -> Jacobians {
        Cable::jacobians(self)
    }

    fn mass_matrix(&mut self) -> BlockTridiagonal {
        Cable::mass_matrix(self)
    }

    fn stiffness_matrix(&mut self) -> BlockTridiagonal {
        Cable::stiffness_matrix(self)
    }

    fn twist_borders(&self) -> Vec<TwistBorder> {
        Cable::twist_borders(self)
    }

    fn frequency_bound(&self) -> f64 {
        Cable::frequency_bound(self)
    }

    fn set_simd_level(&mut self, level: Level) -> Result<(), Error> {
        Cable::set_simd_level(self, level)
    }

    fn mesh_indicator(&self) -> MeshIndicator {
        Cable::mesh_indicator(self)
    }

    fn motion_indicator(&self, start: &[f64]) -> Result<MotionIndicator, Error> {
        Cable::motion_indicator(self, start)
    }

    fn damping_at_mode(&mut self, ratio: f64, mode: usize) -> Result<Damping, Error> {
        Cable::damping_at_mode(self, ratio, mode)
    }
}
