//! Effects of a cable: read, switched on and off between steps, accounted.

use super::model::Model;
use super::{Cable, Equations};
use crate::effect::work::{POINTS, hermite};
use crate::effect::*;
use crate::element::{mass, shape};
use crate::error::{Error, Requirement};
use crate::integrate::{OneStep, State};
use crate::quadrature::gauss_legendre;
use crate::rule::BendingRule;
use nalgebra::Vector3;

impl Cable {
    /// Effects that are on.
    pub fn effects(&self) -> &Effects {
        &self.model.effects
    }

    /// Work of effects since the cable was built.
    pub fn effect_work(&self) -> &EffectWork {
        &self.state.work
    }

    /// Replaces all effects from the next step on. Not for every step: tables are built anew and the mass matrix is factored. Position
    /// and velocity stay as they are.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a number out of range, [`Error::MissingForEffect`] for an effect that needs a diameter, an area or
    /// a bending rule that the cable does not have, [`Error::EmptyRestPiece`] for a piece of a rest shape that covers no element,
    /// [`Error::WrongCount`] for samples of a flow that are not one per node, [`Error::ExplicitDamping`] for damping with an explicit
    /// integrator.
    /// The cable is then as before.
    pub fn set_effects(&mut self, effects: Effects) -> Result<(), Error> {
        self.redefine(self.rule(), effects, self.integrator())
    }

    fn change_effects(&mut self, change: impl FnOnce(&mut Effects)) -> Result<(), Error> {
        let mut effects = self.model.effects.clone();
        change(&mut effects);
        self.set_effects(effects)
    }

    /// Adds a force per length.
    ///
    /// # Errors
    /// As [`set_effects`](Self::set_effects).
    pub fn add_line_load(&mut self, load: LineLoad) -> Result<(), Error> {
        self.change_effects(|effects| effects.line_loads.get_or_insert_default().0.push(load))
    }

    /// Samples a flow of your own at the nodes, from now until the next call: for wind zones, gusts, currents from elsewhere. Call it
    /// before every step, or as often as the flow changes; `field` gives the velocity in m/s at a place (m), for the middle of the time
    /// until the next call if it changes in time. On top of what the drag's [`Flow`](crate::Flow) gives; linear between nodes. Allocates at
    /// the first call only, and samples that are those there are cost nothing.
    ///
    /// ```
    /// # use lariat_ancf::{Cable, Drag, Flow, Section, Vector3};
    /// # let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    /// let mut cable = Cable::builder().points(points).section(Section::round(0.01, 1e8, 4000.0)?).build()?;
    /// cable.set_drag(Drag::new(1.2, 1.2, 0.01, Flow::default()))?;
    /// for _ in 0..10 {
    ///     let time = cable.time() + 0.5 / 60.0;
    ///     cable.sample_flow(|place| if place.x > 1.0 { Vector3::new(0.0, 0.0, 8.0 * time) } else { Vector3::zeros() })?;
    ///     cable.step(1.0 / 60.0)?;
    /// }
    /// # Ok::<(), lariat_ancf::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::MissingForEffect`] for a cable without drag, [`Error::InvalidValue`] for a velocity that is not finite; the samples are then as
    /// before.
    pub fn sample_flow(&mut self, mut field: impl FnMut(Vector3<f64>) -> Vector3<f64>) -> Result<(), Error> {
        let (Some(drag), Some(fluid)) = (&mut self.model.effects.drag, &mut self.system.fluid) else {
            let (cable, effect) = (self.model.name.clone(), "a sampled flow");
            return Err(Error::MissingForEffect { cable, effect, requirement: Requirement::Drag });
        };
        let places = self.state.phase.q.chunks_exact(6).map(|q| Vector3::new(q[0], q[1], q[2]));
        let changed = fluid.sample(&mut drag.flow.samples, places.map(&mut field));
        if changed.map_err(|e| e.of_cable(&self.model.name))? {
            // accelerations change, the length of the next step does not
            self.revision += 1;
            self.state.phase.memory.valid = false;
            self.state.phase.memory.revision = self.revision;
        }
        Ok(())
    }

    /// Kelvin-Voigt times that damp the `mode`-th lowest natural frequency, counted from 1, by this damping ratio (share of critical):
    /// [`natural_frequencies`](Self::natural_frequencies) at the present state, motions without stiffness left out, and
    /// [`Damping::from_ratio`]. In space a bending mode comes twice, once per plane. The curvature's time is 0 for a cable without bending.
    ///
    /// ```
    /// # use lariat_ancf::{At, Cable, Section, Vector3};
    /// # let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    /// # let mut cable = Cable::builder().points(points).section(Section::round(0.01, 1e8, 4000.0)?).clamp(At::Start).build()?;
    /// let damping = cable.damping_at_mode(0.05, 1)?;
    /// cable.set_damping(damping)?;
    /// # Ok::<(), lariat_ancf::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a mode that the cable does not have, [`Error::InvalidValue`] for a ratio below 0 or not finite.
    pub fn damping_at_mode(&mut self, ratio: f64, mode: usize) -> Result<Damping, Error> {
        let frequencies = self.natural_frequencies();
        let still = 1e-7 * frequencies.last().copied().unwrap_or(0.0);
        let elastic: Vec<f64> = frequencies.into_iter().filter(|omega| *omega > still).collect();
        let Some(&omega) = mode.checked_sub(1).and_then(|i| elastic.get(i)) else {
            let (cable, what) = (self.name().to_string(), "mode, counted from 1");
            return Err(Error::OutOfRange { cable, what, value: mode as f64, limit: elastic.len() as f64 });
        };
        let damping = Damping::from_ratio(ratio, omega)?;
        let limp = self.rule().bending == BendingRule::None;
        Ok(if limp { Damping { bending: 0.0, ..damping } } else { damping })
    }

    /// Takes over the work of effects in a host step that succeeded, `before` being the positions when it began.
    pub(crate) fn settle(&mut self, before: &[f64]) {
        let Cable { system, state, .. } = self;
        state.work += core::mem::take(&mut system.work);
        if !system.line_force.is_empty() {
            let moved = state.phase.q.iter().zip(before);
            state.work.line_loads += system.line_force.iter().zip(moved).map(|(f, (q, q0))| f * (q - q0)).sum::<f64>();
        }
    }
}

macro_rules! setters {
    ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => {
        impl Cable {
            $(
                #[doc = concat!("Sets one effect, or removes it with `None`: ", $summary)]
                ///
                /// # Errors
                /// As [`set_effects`](Self::set_effects).
                pub fn $set(&mut self, effect: impl Into<Option<$type>>) -> Result<(), Error> {
                    self.change_effects(|effects| effects.$field = effect.into())
                }
            )*
        }
    };
}

crate::for_each_effect!(setters);

/// Checks that a cable has an implicit method where an effect needs one.
pub(crate) fn check_integrator(model: &Model, method: &dyn OneStep) -> Result<(), Error> {
    if model.effects.needs_implicit_integrator() && method.stability_limit().is_some() {
        return Err(Error::ExplicitDamping { cable: model.name.clone(), method: method.name() });
    }
    Ok(())
}

impl Model {
    /// Displaced fluid in kg/m.
    fn displaced(&self, element: usize) -> f64 {
        self.effects.buoyancy.map_or(0.0, |buoyancy| buoyancy.displaced(&self.elements[element].section))
    }

    /// Factor on gravity.
    fn gravity_scale(&self) -> f64 {
        self.effects.gravity_scale.map_or(1.0, |scale| scale.0)
    }

    /// Mass per length in kg/m that resists acceleration, added mass included.
    pub(crate) fn inertia(&self, element: usize) -> f64 {
        let own = self.elements[element].section.mass_per_length;
        match &self.effects.buoyancy {
            None => own,
            Some(buoyancy) => own + buoyancy.added_mass * self.displaced(element),
        }
    }

    /// Weight per length in N/m: scaled gravity less buoyancy.
    pub(crate) fn weight(&self, element: usize) -> Vector3<f64> {
        let own = self.elements[element].section.mass_per_length;
        if self.effects.buoyancy.is_none() && self.gravity_scale() == 1.0 {
            return own * self.gravity;
        }
        (self.gravity_scale() * (own - self.displaced(element))) * self.gravity
    }

    /// Stress-free stretch and curvature (1/m) of an element.
    pub(crate) fn rest(&self, element: usize) -> (f64, f64) {
        let Some(rest) = &self.effects.rest_shape else { return (1.0, 0.0) };
        let begin: f64 = self.elements[..element].iter().map(|e| e.length).sum();
        rest.at(begin + 0.5 * self.elements[element].length)
    }

    fn line_loads(&self) -> &[LineLoad] {
        self.effects.line_loads.as_ref().map_or(&[], |loads| &loads.0)
    }

    /// Generalised force of the line loads; empty without.
    pub(crate) fn line_force(&self) -> Vec<f64> {
        let mut force = Vec::new();
        for load in self.line_loads() {
            force.resize(6 * self.nodes(), 0.0);
            let mut begin = 0.0;
            for (e, element) in self.elements.iter().enumerate() {
                let l = element.length;
                let (a, b) = (((load.from - begin) / l).clamp(0.0, 1.0), ((load.to - begin) / l).clamp(0.0, 1.0));
                begin += l;
                if a == b {
                    continue;
                }
                let weights = if (a, b) == (0.0, 1.0) { mass::load_weights(l) } else { partial_weights(l, a, b) };
                for (i, f) in force[6 * e..6 * e + 12].iter_mut().enumerate() {
                    *f += weights[i / 3] * load.force[i % 3];
                }
            }
        }
        force
    }

    /// Sum of weights and line loads in N, and the sum of their sizes.
    pub(crate) fn dead_resultant(&self) -> (Vector3<f64>, f64) {
        let mut sum = (Vector3::zeros(), 0.0);
        for (e, element) in self.elements.iter().enumerate() {
            let weight = element.length * self.weight(e);
            // a neutrally buoyant cable is measured by what it weighs in air
            let size = element.length * element.section.mass_per_length * self.gravity.norm();
            sum = (sum.0 + weight, sum.1 + size * self.gravity_scale().abs());
        }
        for load in self.line_loads() {
            let force = (load.to.min(self.length()) - load.from) * load.force;
            sum = (sum.0 + force, sum.1 + force.norm());
        }
        sum
    }
}

/// Weights of a load per length on the piece from `a` to `b` (shares of the length) of an element.
fn partial_weights(length: f64, a: f64, b: f64) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for (x, w) in gauss_legendre(2) {
        let at = shape::position(a + (b - a) * x, length);
        for k in 0..4 {
            sum[k] += w * (b - a) * length * at[k];
        }
    }
    sum
}

impl Equations<'_> {
    /// Adds the work of effects in a step from `before` to `after`.
    pub(crate) fn add_effect_work(&mut self, before: &State, after: &State, h: f64, range: core::ops::Range<usize>) {
        let system = &mut *self.system;
        let damps = system.kernel.as_ref().is_some_and(|kernel| kernel.damps());
        if !damps && system.fluid.is_none() {
            return;
        }
        let (mut q, mut v) = (core::mem::take(&mut system.rhs), core::mem::take(&mut system.z));
        for (weights, share) in hermite().into_iter().zip(POINTS) {
            for (i, k) in range.clone().enumerate() {
                let mix = |x0: f64, d0: f64, x1: f64, d1: f64| {
                    weights[0] * x0 + weights[1] * h * d0 + weights[2] * x1 + weights[3] * h * d1
                };
                q[i] = mix(before.q[k], before.v[k], after.q[k], after.v[k]);
                v[i] = mix(before.v[k], before.memory.acceleration[k], after.v[k], after.memory.acceleration[k]);
            }
            if let Some(kernel) = system.kernel.as_ref().filter(|_| damps) {
                system.work.damping -= 0.5 * h * system.elements.damping_power(kernel, &q, &v);
            }
            if let Some(fluid) = &mut system.fluid {
                system.work.drag -= 0.5 * h * fluid.power(system.level, before.time + share * h, &q, &v);
            }
        }
        system.rhs = q;
        system.z = v;
    }
}
