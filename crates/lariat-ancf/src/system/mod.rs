//! The equations of one cable, derived from its [`Model`]: forces, loads, mass, step matrix.
//!
//! Everything here is rebuilt when the model changes; nothing of it is part of a snapshot. The
//! parts borrow apart: an evaluation reads forces and loads and writes the step matrix, while its
//! caller owns the [buffers](Buffers).
//!
//! | file | what it holds |
//! |---|---|
//! | [`elements`] | numbers of the elements |
//! | [`lanes`] | the loop over the elements, eight at a time |
//! | [`forces`] | elastic forces and effects |
//! | [`loads`], `potentials` | weight, constant forces, point loads; potentials of the user's own |
//! | [`mass`] | mass matrix and its factors |
//! | [`equations`] | one evaluation of everything, factorisation, solution |
//! | [`dynamics`] | the equations as integrators see them |
//! | [`energy_balance`] | work of effects and change of energy over a step |
//! | [`reel`] | the elements at the eyes of reels |
//! | [`torsion`], `torsion_motion`, `torsion_solve` | torsion in statics, in the stages of methods, and beside a factored matrix |
//! | [`jacobian`] | exact derivatives |
//! | [`frequency`] | a bound of the frequencies |
//! | [`reading`] | tension and strain, and the largest load |
//! | [`carried`] | tension and moment at the ends of an element, by equilibrium |
//! | [`projection`] | supports in vectors and matrices |

pub(crate) mod angular;
mod carried;
mod contacts;
mod discrete_gradient;
pub(crate) mod dynamics;
pub(crate) mod elements;
pub(crate) mod energy_balance;
pub(crate) mod equations;
pub(crate) mod forces;
mod frequency;
pub(crate) mod jacobian;
mod lanes;
pub(crate) mod loads;
pub(crate) mod mass;
mod meter;
mod potentials;
mod projection;
mod reading;
pub(crate) mod reel;
mod rigid_motion;
mod step_vectors;
mod store;
pub(crate) mod torsion;
mod torsion_motion;
mod torsion_solve;
mod vectors;

pub(crate) use carried::Carried;
pub(crate) use discrete_gradient::CableStep;
pub(crate) use dynamics::CableDynamics;
pub(crate) use equations::Equations;
pub(crate) use projection::{project_matrix, project_part, project_vector};
pub(crate) use reading::{NodeTension, Pull, Reading, missing_at_ends};
pub use reel::Sheave;
pub(crate) use reel::{FeedElement, Law, Motor, MotorState, Source, Unknowns, Wheel, Winch, rates, towards};
pub(crate) use rigid_motion::{Modes, relative_velocities, solve as solve_semidefinite};
pub(crate) use step_vectors::StepVectors;
pub(crate) use torsion::BodyEnd;
pub(crate) use vectors::dot;

use crate::contact::StaticContact;
use crate::error::StepFailure;
use crate::linalg::{BlockTridiagonal, Factorisation};
use crate::model::{Model, STANDARD_GRAVITY};
use crate::scales::LEAST_HEIGHT;
use crate::strength::LoadRecord;
use fearless_simd::Level;
use forces::Forces;
use loads::Loads;
use mass::Mass;
use meter::EnergyMeter;
use potentials::PointPotentials;
use reel::Feeds;

/// Everything derived from a [`Model`].
#[derive(Clone, Debug)]
pub(crate) struct System {
    pub level: Level,
    pub forces: Forces,
    pub loads: Loads,
    pub potentials: PointPotentials,
    pub mass: Mass,
    pub step: StepMatrix,
    pub scales: Scales,
    pub meter: EnergyMeter,
    /// The load of a cable with limits, in the present host step.
    pub load: LoadRecord,
    /// The elements at the eyes of reels.
    pub feeds: Feeds,
    /// Time in s at which statics evaluate forces that depend on it.
    pub static_time: f64,
    /// Contact in statics.
    pub static_contact: StaticContact,
    /// Torsion where forces are evaluated: in statics, and in the stages of methods.
    pub torsion_forces: Option<Box<torsion::TorsionForces>>,
}

/// The matrix of an implicit step and its factors; empty between two steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepMatrix {
    pub matrix: BlockTridiagonal,
    pub factorisation: Factorisation,
    /// c2 in s^2 of the stage whose matrix is factored; 0 = none.
    pub factored: f64,
}

/// Vectors of an evaluation or a step; empty between two steps, their contents are unspecified when
/// one begins.
#[derive(Clone, Debug, Default)]
pub(crate) struct Buffers {
    /// Residual of a stage, and its increment.
    pub rhs: Vec<f64>,
    pub product: Vec<f64>,
    /// Displacement of a stage from its explicit part.
    pub z: Vec<f64>,
    /// Velocities of a stage; empty where no force depends on them.
    pub velocity: Vec<f64>,
    /// Torsion, which the system has while it steps.
    pub torsion: Option<Box<torsion::TorsionForces>>,
}

/// Sizes by which increments and steps are judged.
#[derive(Clone, Debug)]
pub(crate) struct Scales {
    /// Largest distance in m over which the slope of a node acts: l/8.
    slope_lever: Vec<f64>,
    /// An upper bound of the angular frequencies in rad/s.
    pub frequency_bound: f64,
    /// Energy in J of the mass 1 mm above the ground: what a cable at rest is measured by.
    pub weight_energy: f64,
    /// Mass in kg, added mass included.
    pub mass: f64,
    /// Smallest `L l rhoA/EA` in s^2: an acceleration k strains an element by this times k/l.
    pub stiff_time_squared: f64,
    /// Of all elements but the first and the last, whose lengths reels change: mass in kg, length
    /// in m, smallest `l rhoA/EA` in s^2/m.
    inner: [f64; 3],
}

impl System {
    pub fn new(model: &Model) -> Result<Self, StepFailure> {
        Self::with_level(model, Level::new())
    }

    /// Creates the system for a SIMD level.
    pub fn with_level(model: &Model, level: Level) -> Result<Self, StepFailure> {
        Ok(System {
            level,
            forces: Forces::new(model),
            loads: Loads::new(model),
            potentials: PointPotentials::new(model),
            mass: Mass::new(level, model)?,
            step: StepMatrix::default(),
            scales: Scales::new(model),
            meter: EnergyMeter::default(),
            load: LoadRecord::default(),
            feeds: Feeds::new(model),
            static_time: 0.0,
            static_contact: StaticContact::default(),
            torsion_forces: None,
        })
    }

    /// Factors the mass matrix with the present supports.
    pub fn factor_mass(&mut self, model: &Model) -> Result<(), StepFailure> {
        self.mass.factor(self.level, model)
    }
}

impl StepMatrix {
    /// Makes room for the matrix of a cable, and forgets the factors of another.
    pub fn begin(&mut self, nodes: usize) {
        self.matrix.resize(nodes);
        self.factored = 0.0;
    }
}

impl Buffers {
    /// Makes room for the vectors of a cable.
    pub fn resize(&mut self, model: &Model) {
        let size = 6 * model.nodes();
        for vector in [&mut self.rhs, &mut self.product, &mut self.z] {
            vector.resize(size, 0.0);
        }
        self.velocity.resize(if model.depends_on_velocity() { size } else { 0 }, 0.0);
    }
}

/// Adds an element to the sums of [`Scales::inner`].
fn add_element(model: &Model, [mass, length, stiff]: [f64; 3], e: usize) -> [f64; 3] {
    let element = &model.elements[e];
    let own = model.inertia(element) * element.length;
    [mass + own, length + element.length, stiff.min(own / element.section.axial_stiffness)]
}

impl Scales {
    fn new(model: &Model) -> Self {
        let mut scales = Scales {
            slope_lever: Vec::new(),
            weight_energy: 0.0,
            mass: 0.0,
            frequency_bound: frequency::bound(model),
            stiff_time_squared: 0.0,
            inner: [0.0, 0.0, f64::INFINITY],
        };
        scales.slope_lever.resize(model.nodes(), 0.0);
        let last = model.elements.len() - 1;
        for (e, element) in model.elements.iter().enumerate() {
            for node in [e, e + 1] {
                scales.slope_lever[node] = scales.slope_lever[node].max(element.length / 8.0);
            }
            if e > 0 && e < last {
                scales.inner = add_element(model, scales.inner, e);
            }
        }
        scales.measure_ends(model);
        scales
    }

    /// Sets all but the bound of the frequencies to the present lengths of the first and the last
    /// element, which reels change.
    pub fn measure_ends(&mut self, model: &Model) {
        let last = model.elements.len() - 1;
        let lever = |e: usize| model.elements[e].length / 8.0;
        for node in [0, 1, last, last + 1] {
            self.slope_lever[node] = lever(node.saturating_sub(1)).max(lever(node.min(last)));
        }
        let mut sums = add_element(model, self.inner, 0);
        if last > 0 {
            sums = add_element(model, sums, last);
        }
        let [mass, length, stiff] = sums;
        (self.mass, self.stiff_time_squared) = (mass, length * stiff);
        self.weight_energy = mass * STANDARD_GRAVITY.norm() * LEAST_HEIGHT;
    }

    /// Returns the largest component of a nodal vector as a displacement in m (of r, and of t over
    /// l/8), and the largest |t|.
    pub fn extent(&self, x: &[f64]) -> (f64, f64) {
        let (mut displacement, mut slope, mut not_finite) = (0.0f64, 0.0f64, 0.0f64);
        for (x, lever) in x.chunks_exact(6).zip(&self.slope_lever) {
            let r = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
            let t = x[3] * x[3] + x[4] * x[4] + x[5] * x[5];
            displacement = displacement.max(r).max(lever * lever * t);
            slope = slope.max(t);
            // a sum carries the NaN that max drops
            not_finite += 0.0 * (r + t);
        }
        (displacement.sqrt() + not_finite, slope.sqrt() + not_finite)
    }
}
