//! The numbers of one cable, ready to be evaluated: mass, loads, elements, the step matrix and its factors.
//!
//! Everything here is derived from a [`Model`] and rebuilt when the model changes; nothing of it is part of a snapshot.

use super::assembly::Elements;
use super::fluid::Fluid;
use super::kernel_effects::{KernelEffects, Rates};
use super::model::Model;
use super::projection::project_matrix;
use crate::diagnostics::Diagnostics;
use crate::effect::EffectWork;
use crate::element::{mass, shape};
use crate::error::StepFailure;
use crate::linalg::{BlockTridiagonal, Factorisation, MassFactorisation, MassMatrix};
use crate::load::{PointLoad, moment_on_slope};
use crate::support::SlopeSupport;
use fearless_simd::Level;
use nalgebra::Vector3;

/// Element of a point load, and the weights of its coordinates in position and slope there.
#[derive(Clone, Copy, Debug)]
struct Located {
    element: usize,
    position: [f64; 4],
    slope: [f64; 4],
}

/// Where the mass matrix is solved.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant)] // one per cable
pub(crate) enum MassSolver {
    /// The same 2x2 blocks for x, y and z.
    Scalar(MassFactorisation),
    /// 6x6 blocks, where a slope is held to a direction.
    Block(Factorisation),
}

/// Everything derived from a [`Model`], and the buffers to evaluate it.
#[derive(Clone, Debug)]
pub(crate) struct System {
    pub level: Level,
    pub elements: Elements,
    /// Damping and rest shape, if on.
    pub kernel: Option<KernelEffects>,
    /// Drag, if on.
    pub fluid: Option<Fluid>,
    /// Work of effects in the present host step.
    pub work: EffectWork,
    /// Time in s at which statics see a flow.
    pub static_time: f64,
    /// By point load of the model.
    located: Vec<Located>,
    mass: MassMatrix,
    pub mass_solver: MassSolver,
    gravity_force: Vec<f64>,
    /// Generalised force of line loads; empty without.
    pub line_force: Vec<f64>,
    /// Gravity and line loads.
    dead_force: Vec<f64>,
    /// Longest distance over which a slope acts: l/8 by node.
    arm: Vec<f64>,
    pub matrix: BlockTridiagonal,
    pub factorisation: Factorisation,
    pub rhs: Vec<f64>,
    pub product: Vec<f64>,
    pub z: Vec<f64>,
    /// Velocities of a stage; empty where no force depends on them.
    pub velocity: Vec<f64>,
    pub frequency_bound: f64,
    /// c2 of the stage whose matrix is factored; 0 = none.
    pub factored: f64,
    /// Smallest `L l rhoA/EA` in s^2: an acceleration k strains an element by this times k/l.
    pub stiff_time_squared: f64,
}

impl System {
    pub fn new(model: &Model) -> Result<Self, StepFailure> {
        Self::with_level(model, Level::new())
    }

    /// The same, for a SIMD level.
    pub fn with_level(model: &Model, level: Level) -> Result<Self, StepFailure> {
        let nodes = model.nodes();
        let mut mass = MassMatrix { diag: vec![[0.0; 3]; nodes], lower: vec![[0.0; 4]; nodes - 1] };
        let mut arm = vec![0.0f64; nodes];
        for (e, element) in model.elements.iter().enumerate() {
            let m = mass::consistent(model.inertia(e), element.length);
            for (node, k) in [(e, 0), (e + 1, 2)] {
                mass.diag[node][0] += m[k][k];
                mass.diag[node][1] += m[k][k + 1];
                mass.diag[node][2] += m[k + 1][k + 1];
                arm[node] = arm[node].max(element.length / 8.0);
            }
            mass.lower[e] = [m[2][0], m[2][1], m[3][0], m[3][1]];
        }
        let mut system = System {
            kernel: KernelEffects::new(model),
            fluid: Fluid::new(model),
            work: EffectWork::default(),
            static_time: 0.0,
            line_force: model.line_force(),
            dead_force: vec![0.0; 6 * nodes],
            velocity: vec![0.0; if model.effects.depends_on_velocity() { 6 * nodes } else { 0 }],
            located: Vec::new(),
            level,
            elements: Elements::new(model),
            mass_solver: MassSolver::Scalar(MassFactorisation::default()),
            mass,
            gravity_force: vec![0.0; 6 * nodes],
            arm,
            matrix: BlockTridiagonal::zeros(nodes),
            factorisation: Factorisation::default(),
            rhs: vec![0.0; 6 * nodes],
            product: vec![0.0; 6 * nodes],
            z: vec![0.0; 6 * nodes],
            frequency_bound: super::frequency::bound(model),
            factored: 0.0,
            stiff_time_squared: model.elements.iter().enumerate().fold(f64::INFINITY, |least, (i, e)| {
                least.min(model.length() * e.length * model.inertia(i) / e.section.axial_stiffness)
            }),
        };
        system.weigh(model);
        system.locate_loads(model);
        system.factor_mass(model)?;
        Ok(system)
    }

    /// Makes the flow that of a time, for ever.
    pub fn hold_flow(&mut self, time: f64) {
        if let Some(fluid) = &mut self.fluid {
            fluid.hold(time);
        }
    }

    /// Puts the flow back that the model has.
    pub fn release_flow(&mut self, model: &Model) {
        self.fluid = Fluid::new(model);
    }

    /// Sums the weight of the elements, and the line loads.
    pub fn weigh(&mut self, model: &Model) {
        self.gravity_force.fill(0.0);
        for (e, element) in model.elements.iter().enumerate() {
            let gravity = model.weight(e);
            for (k, weight) in mass::load_weights(element.length).iter().enumerate() {
                for x in 0..3 {
                    self.gravity_force[6 * e + 3 * k + x] += weight * gravity[x];
                }
            }
        }
        self.dead_force.copy_from_slice(&self.gravity_force);
        self.dead_force.iter_mut().zip(&self.line_force).for_each(|(f, line)| *f += line);
    }

    /// Finds the elements of the point loads.
    pub fn locate_loads(&mut self, model: &Model) {
        self.located.clear();
        self.located.extend(model.loads.iter().map(|load| {
            let (element, xi) = model.locate(load.arc_length);
            let length = model.elements[element].length;
            Located { element, position: shape::position(xi, length), slope: shape::slope(xi, length) }
        }));
    }

    /// Factors the mass matrix with the supports in place.
    pub fn factor_mass(&mut self, model: &Model) -> Result<(), StepFailure> {
        let directed = model.supports.iter().any(|(_, s)| s.slope.is_direction());
        self.mass_solver = if directed {
            self.matrix.clear();
            self.add_mass(1.0);
            project_matrix(model, &mut self.matrix);
            let mut factorisation = Factorisation::default();
            factorisation.factor(self.level, &self.matrix)?;
            MassSolver::Block(factorisation)
        } else {
            let mut held = self.mass.clone();
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
            let mut factorisation = MassFactorisation::default();
            factorisation.factor(&held)?;
            MassSolver::Scalar(factorisation)
        };
        Ok(())
    }

    /// Work of gravity from the origin to `q`, in J.
    pub fn gravity_work(&self, q: &[f64]) -> f64 {
        self.gravity_force.iter().zip(q).map(|(f, q)| f * q).sum()
    }

    /// Work of line loads from the origin to `q`, in J.
    pub fn line_work(&self, q: &[f64]) -> f64 {
        self.line_force.iter().zip(q).map(|(f, q)| f * q).sum()
    }

    /// Axial and bending energy in J.
    pub fn strain_energy(&self, q: &[f64]) -> (f64, f64) {
        let (axial, bending) = self.elements.energy(q);
        match self.kernel.as_ref().filter(|kernel| kernel.rests()) {
            None => (axial, bending),
            Some(kernel) => {
                let rest = self.elements.rest_energy(kernel, q);
                (axial + rest.0, bending + rest.1)
            }
        }
    }

    /// `out = scale F` without point loads and gravity: elastic force and the effects that depend on the state.
    pub fn add_force(
        &mut self,
        time: f64,
        q: &[f64],
        rates: Rates<'_>,
        scale: f64,
        mass_scale: Option<f64>,
        out: &mut [f64],
        diagnostics: &mut Diagnostics,
    ) {
        let System { level, elements, kernel, fluid, matrix, .. } = self;
        let level = *level;
        match (&kernel, mass_scale) {
            (None, None) => elements.add_force(level, q, scale, out),
            (None, Some(mass)) => elements.add_force_and_matrix(level, q, scale, mass, out, matrix),
            (Some(kernel), None) => elements.add_force_with(level, kernel, q, rates.v, scale, out),
            (Some(kernel), Some(mass)) => {
                elements.add_force_and_matrix_with(level, kernel, q, rates, scale, mass, out, matrix);
            }
        }
        let count = elements.count as u64;
        if let Some(kernel) = kernel {
            diagnostics.effects.damping += if kernel.damps() && !rates.v.is_empty() { count } else { 0 };
            diagnostics.effects.rest_shape += if kernel.rests() { count } else { 0 };
        }
        if let Some(fluid) = fluid {
            diagnostics.effects.drag += count;
            match mass_scale {
                None => fluid.add_force(level, time, q, rates.v, scale, out),
                Some(_) => fluid.add_force_and_matrix(level, time, q, rates, scale, out, matrix),
            }
        }
    }

    /// Work of a share of the point forces from the origin to `q`, in J; moments have none in general.
    pub fn load_work(&self, model: &Model, share: f64, q: &[f64]) -> f64 {
        let work = |load: &PointLoad| {
            let (e, xi) = model.locate(load.arc_length);
            let weights = shape::position(xi, model.elements[e].length);
            (0..12).map(|i| weights[i / 3] * load.force[i % 3] * q[6 * e + i]).sum::<f64>()
        };
        model.loads.iter().map(|load| share * work(load)).sum()
    }

    /// `y = M x`.
    pub fn multiply_mass(&self, x: &[f64], y: &mut [f64]) {
        self.mass.multiply_at(self.level, x, y);
    }

    /// Adds `scale M` to the step matrix.
    pub fn add_mass(&mut self, scale: f64) {
        for (block, m) in self.matrix.diag.iter_mut().zip(&self.mass.diag) {
            for x in 0..3 {
                block.0[x][x] += scale * m[0];
                block.0[x][3 + x] += scale * m[1];
                block.0[3 + x][x] += scale * m[1];
                block.0[3 + x][3 + x] += scale * m[2];
            }
        }
        for (block, m) in self.matrix.lower.iter_mut().zip(&self.mass.lower) {
            for x in 0..3 {
                block.0[x][x] += scale * m[0];
                block.0[3 + x][x] += scale * m[1];
                block.0[x][3 + x] += scale * m[2];
                block.0[3 + x][3 + x] += scale * m[3];
            }
        }
    }

    /// Adds `scale` times gravity, line and point loads at `time` to `out`, and `scale` times their negative tangent if asked.
    pub fn add_loads(
        &mut self,
        model: &Model,
        time: f64,
        q: &[f64],
        scale: f64,
        out: &mut [f64],
        tangent: bool,
        diagnostics: &mut Diagnostics,
    ) {
        for (out, g) in out.iter_mut().zip(&self.dead_force) {
            *out += scale * g;
        }
        for (load, &Located { element: e, position, slope: weights }) in model.loads.iter().zip(&self.located) {
            diagnostics.load_evaluations += 1;
            let factor = scale * load.factor(time);
            let n = &mut out[6 * e..6 * e + 12];
            for (k, weight) in position.into_iter().enumerate() {
                for x in 0..3 {
                    n[3 * k + x] += factor * weight * load.force[x];
                }
            }
            if load.moment == Vector3::zeros() {
                continue;
            }
            let slope: Vector3<f64> =
                (0..4).map(|k| weights[k] * Vector3::from_column_slice(&q[6 * e + 3 * k..6 * e + 3 * k + 3])).sum();
            let (force, derivative) = moment_on_slope(&load.moment, &slope);
            for k in 0..4 {
                for x in 0..3 {
                    n[3 * k + x] += factor * weights[k] * force[x];
                }
            }
            if !tangent {
                continue;
            }
            for (k, m) in (0..4).flat_map(|k| (0..4).map(move |m| (k, m))) {
                let weight = -factor * weights[k] * weights[m];
                // rows of coordinate k, columns of coordinate m; only one triangle of blocks is stored
                let block = match (k / 2, m / 2) {
                    (0, 0) => &mut self.matrix.diag[e],
                    (1, 1) => &mut self.matrix.diag[e + 1],
                    (1, 0) => &mut self.matrix.lower[e],
                    _ => continue,
                };
                for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
                    block.0[3 * (m % 2) + c][3 * (k % 2) + r] += weight * derivative[(r, c)];
                }
            }
        }
    }

    /// Largest component of a nodal vector as a displacement in m (of r, and of t over l/8), and the largest |t|.
    pub fn extent(&self, x: &[f64]) -> (f64, f64) {
        let (mut displacement, mut slope, mut not_finite) = (0.0f64, 0.0f64, 0.0f64);
        for (x, arm) in x.chunks_exact(6).zip(&self.arm) {
            let r = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
            let t = x[3] * x[3] + x[4] * x[4] + x[5] * x[5];
            displacement = displacement.max(r).max(arm * arm * t);
            slope = slope.max(t);
            // a sum carries the NaN that max drops
            not_finite += 0.0 * (r + t);
        }
        (displacement.sqrt() + not_finite, slope.sqrt() + not_finite)
    }
}
