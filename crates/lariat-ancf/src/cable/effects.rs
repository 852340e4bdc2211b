//! Effects of a cable and forces of the user's own: read, and changed between steps.

use super::Cable;
use crate::effect::*;
use crate::error::{Error, Requirement};
use crate::integrate::{Fidelity, Integrator};
use crate::rule::BendingRule;
use nalgebra::Vector3;
use std::sync::Arc;

impl Cable {
    /// Returns the effects that are on.
    pub fn effects(&self) -> &Effects {
        &self.model.effects
    }

    /// Returns the work of effects since the cable was built.
    pub fn effect_work(&self) -> &EffectWork {
        &self.snapshot.work
    }

    /// Replaces all effects from the next step on. Positions and velocities stay as they are. Not
    /// meant for every step, because it builds tables and factors the mass matrix. A cable with the
    /// default integrator gets that of the fidelity `game` with [`Contact`] or [`Torsion`], one for
    /// which the fidelity `engineering` was chosen [`Integrator::COUPLED`].
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a number out of range, [`Error::MissingForEffect`] for an effect
    /// that needs a diameter, an area or a bending rule that the cable does not have,
    /// [`Error::EmptyRestPiece`] for a piece of a rest shape that covers no element,
    /// [`Error::WrongCount`] for samples of a flow that are not one per node,
    /// [`Error::ExplicitDamping`] for damping with an explicit integrator, [`Error::ContactMethod`]
    /// for contact with another method than `discrete-gradient`. [`Error::TorsionPlace`]
    /// for torsion with a reel and another one. The cable is then as before.
    pub fn set_effects(&mut self, effects: Effects) -> Result<(), Error> {
        let mut integrator = self.integrator();
        let coupled = effects.need_discrete_gradient();
        if coupled && self.default_integrator {
            integrator = self.integrator_for(Fidelity::Game);
        } else if coupled && integrator == Integrator::default() {
            integrator = Integrator::COUPLED;
        }
        self.redefine(self.rule(), effects, integrator)
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

    /// Returns the forces per length of your own, in the order in which they were attached.
    pub fn force_densities(&self) -> impl Iterator<Item = &Arc<dyn ForceDensity>> {
        self.model.force_densities.iter()
    }

    /// Attaches a force per length of your own; see [`ForceDensity`]. After a cable was read back
    /// from a file, attach its functions again in the same order.
    ///
    /// ```
    /// use lariat_ancf::{Cable, CablePoint, ForceDensity, Section, Vector3};
    /// use std::sync::Arc;
    ///
    /// /// Pulls towards the y axis, in proportion to the distance.
    /// #[derive(Debug)]
    /// struct Spring;
    ///
    /// impl ForceDensity for Spring {
    ///     fn force(&self, at: &CablePoint) -> Vector3<f64> {
    ///         -10.0 * Vector3::new(at.position.x, 0.0, at.position.z)
    ///     }
    ///     fn depends_on_velocity(&self) -> bool {
    ///         false
    ///     }
    /// }
    ///
    /// let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    /// let mut cable = Cable::builder().points(points).section(Section::round(0.01, 1e8, 4000.0)?).build()?;
    /// cable.add_force_density(Arc::new(Spring))?;
    /// cable.step(1.0 / 60.0)?;
    /// assert!(cable.effect_work().force_densities > 0.0);
    /// # Ok::<(), lariat_ancf::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix cannot be factored.
    pub fn add_force_density(&mut self, force: Arc<dyn ForceDensity>) -> Result<(), Error> {
        let mut model = self.model.clone();
        model.force_densities.attach(force, self.snapshot.passed_at_start());
        let as_before = self.model.force_densities.missing() > 0;
        model.check_effects().map_err(|e| e.of_cable(self.name()))?;
        self.rebuild(model)?;
        if !as_before {
            self.revise();
        }
        Ok(())
    }

    /// Removes all forces per length of your own, missing ones included.
    ///
    /// # Errors
    /// As [`add_force_density`](Self::add_force_density).
    pub fn clear_force_densities(&mut self) -> Result<(), Error> {
        let mut model = self.model.clone();
        model.force_densities.clear();
        self.rebuild(model)?;
        self.revise();
        Ok(())
    }

    /// Rejects a cable that was read back without its functions.
    pub(crate) fn check_forces(&self) -> Result<(), Error> {
        match self.model.force_densities.missing() + self.model.potentials.missing() {
            0 => Ok(()),
            count => Err(Error::MissingForceDensities { cable: self.name().to_string(), count }),
        }
    }

    /// Samples a flow of your own at the nodes, valid until the next call: for wind zones, gusts,
    /// computed currents. Call it before every step, or as often as the flow changes; `field`
    /// returns the velocity in m/s at a position (m), for the middle of the time until the next
    /// call if it changes in time. The samples are added to the drag's [`Flow`], linear between
    /// nodes. Allocates at the first call only; samples that do not differ from the last ones cost
    /// nothing.
    ///
    /// ```
    /// # use lariat_ancf::{Cable, Drag, Flow, Section, Vector3};
    /// # let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    /// let mut cable = Cable::builder().points(points).section(Section::round(0.01, 1e8, 4000.0)?).build()?;
    /// cable.set_drag(Drag::new(1.2, 1.2, 0.01, Flow::default()))?;
    /// for _ in 0..10 {
    ///     let time = cable.time() + 0.5 / 60.0;
    ///     cable.sample_flow(|r| if r.x > 1.0 { Vector3::new(0.0, 0.0, 8.0 * time) } else { Vector3::zeros() })?;
    ///     cable.step(1.0 / 60.0)?;
    /// }
    /// # Ok::<(), lariat_ancf::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::MissingForEffect`] for a cable without drag, [`Error::NotWithReel`] for one with a
    /// reel, [`Error::InvalidValue`] for a velocity that is not finite; the samples are then as
    /// before.
    pub fn sample_flow(&mut self, mut field: impl FnMut(Vector3<f64>) -> Vector3<f64>) -> Result<(), Error> {
        if self.has_reel() {
            return Err(Error::NotWithReel { cable: self.name().to_string(), what: "a sampled flow" });
        }
        let (Some(drag), Some(table)) = (&mut self.model.effects.drag, &mut self.system.forces.at_points.drag) else {
            let (cable, effect) = (self.model.name.clone(), "a sampled flow");
            return Err(Error::MissingForEffect { cable, effect, requirement: Requirement::Drag });
        };
        let positions = self.snapshot.state.q.chunks_exact(6).map(|q| Vector3::new(q[0], q[1], q[2]));
        let changed = table.sample(&mut drag.flow.samples, positions.map(&mut field));
        if changed.map_err(|e| e.of_cable(&self.model.name))? {
            // accelerations change, the length of the next step does not
            self.revision += 1;
            self.snapshot.state.memory.valid = false;
            self.snapshot.state.memory.revision = self.revision;
        }
        Ok(())
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn set_least_damping(&mut self, time: f64) {
        let time = if time.is_finite() { time.max(0.0) } else { 0.0 };
        if self.model.least_damping != time {
            self.model.least_damping = time;
            self.system.forces.in_element = self.model.in_element();
            self.buffers.resize(&self.model);
        }
        let memory = &mut self.snapshot.state.memory;
        if memory.least_damping != time {
            (memory.least_damping, memory.valid) = (time, false);
        }
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn damping_at_mode(&mut self, ratio: f64, mode: usize) -> Result<Damping, Error> {
        let frequencies = self.natural_frequencies();
        let still = 1e-7 * frequencies.last().copied().unwrap_or(0.0);
        let elastic: Vec<f64> = frequencies.into_iter().filter(|omega| *omega > still).collect();
        let Some(&omega) = mode.checked_sub(1).and_then(|i| elastic.get(i)) else {
            let (cable, what) = (self.name().to_string(), "mode, counted from 1");
            return Err(Error::OutOfRange { cable, what, value: mode as f64, limit: elastic.len() as f64 });
        };
        let damping = Damping::from_ratio(ratio, omega)?;
        let no_bending = self.rule().bending == BendingRule::None;
        Ok(if no_bending { Damping { bending: 0.0, ..damping } } else { damping })
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
