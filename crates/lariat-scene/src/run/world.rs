//! The cables and bodies of a scene while it runs.

use super::readings::pull;
use super::{BodyStatics, CableStatics, Parted};
use crate::error::Error;
use crate::physics::Physics;
use crate::scene::{Engine, Purpose, Scene};
use crate::warning::Warning;
use lariat_ancf::{At, AxialRule, Cable, EquilibriumReport, Support};

/// The cables and bodies of a scene in their present state.
#[derive(Clone)]
pub struct World {
    pub(super) scene: Scene,
    /// Cables that no body moves; empty once `physics` has taken them.
    pub(super) alone: Vec<Cable>,
    /// Bodies, with `engine = "rapier"`.
    pub(super) physics: Option<Box<Physics>>,
    /// Common time of cables and bodies in s.
    pub(super) time: f64,
    /// By cable of [`cables`](Self::cables), that of the file of which it is a part.
    pub(super) owners: Vec<usize>,
    /// By cable of the file, its parts, in their order along it.
    pub(super) order: Vec<Vec<usize>>,
    /// By cable of the file, whether its cut is done.
    cut: Vec<bool>,
    pub(super) breaks: Vec<Parted>,
    pub(super) warnings: Vec<Warning>,
    /// Iterations of the statics, which are Newton iterations too.
    pub(super) static_iterations: u64,
    pub(super) energy_start: f64,
    /// Equilibria of all cables, if the world was started for statics.
    pub(super) statics: Option<Vec<CableStatics>>,
    /// What statics did with the bodies.
    pub(super) static_bodies: Option<BodyStatics>,
}

impl World {
    /// Builds the cables and bodies of a scene as drawn.
    ///
    /// # Errors
    /// [`Error::Mechanics`], [`Error::Body`]; not for a checked scene.
    pub fn build(scene: &Scene) -> Result<Self, Error> {
        let cables = (0..scene.cables.len()).map(|i| scene.build_cable(i)).collect::<Result<Vec<_>, _>>()?;
        let physics = match scene.engine {
            Engine::None => None,
            Engine::Rapier => Some(Box::new(Physics::build(scene)?)),
        };
        let mut world = World {
            scene: scene.clone(),
            alone: cables,
            physics,
            time: 0.0,
            owners: (0..scene.cables.len()).map(|part| scene.whole(part)).collect(),
            order: scene.parts.clone(),
            cut: vec![false; scene.parts.len()],
            breaks: Vec::new(),
            warnings: Vec::new(),
            static_iterations: 0,
            energy_start: 0.0,
            statics: None,
            static_bodies: None,
        };
        for cable in &world.alone {
            if let Some(reason) = cable.rule().spare_modes() {
                let (rule, reason) = (cable.rule().to_string(), reason.to_string());
                world.warnings.push(Warning::RankDeficient { cable: cable.name().to_string(), rule, reason });
            }
        }
        Ok(world)
    }

    /// Brings the cables to their start: static equilibrium where the scene asks for it, with
    /// bodies held where they are drawn, on which cables with contact lie; loads; initial motion.
    /// For a run with Rapier the cables are then attached to the bodies. For statics, all cables go
    /// to equilibrium, and with Rapier the dynamic bodies attached to them, too.
    ///
    /// # Errors
    /// [`Error::Mechanics`] if there is no equilibrium, [`Error::Body`] for statics of a body with a joint or a contact.
    pub fn start(&mut self, purpose: Purpose) -> Result<(), Error> {
        let fully = purpose == Purpose::Static;
        let World { scene, alone, warnings, static_iterations, physics, .. } = self;
        if fully && let Some(sheave) = scene.sheaves.first() {
            let cable = scene.cables[sheave.cables[0]].name.clone();
            let reason = "its end is at a sheave, whose equilibrium is not computed: run the scene until it rests";
            return Err(lariat_ancf::Error::ReelPlace { cable, reason }.into());
        }
        warnings.extend(scene.warnings(purpose));
        let mut held_by = vec![Default::default(); scene.attachments.len()];
        let mut reports = Vec::new();
        for (i, cable) in alone.iter_mut().enumerate() {
            scene.add_loads(cable, i, false, fully)?;
            if fully {
                scene.add_loads(cable, i, true, true)?;
            }
            if fully || scene.cables[i].equilibrium {
                scene.move_to_anchors(cable, i)?;
                let report = match physics {
                    // statics of bodies begin without what the cable can touch
                    Some(physics) if !fully => physics.equilibrium_among(scene, cable)?,
                    _ => cable.equilibrium()?,
                };
                *static_iterations += report.iterations as u64;
                // with bodies this is where statics begin
                if !(report.stable || fully && physics.is_some()) {
                    warnings.push(unstable(cable));
                }
                reports.push(report);
            }
            if fully && physics.is_none() {
                continue;
            }
            let by_bodies = |k: &usize| scene.attachments[*k].cable == i && scene.attachments[*k].body.is_some();
            for k in (0..scene.attachments.len()).filter(by_bodies) {
                held_by[k] = pull(cable, scene.attachments[k].arc_length)?;
            }
            for k in (0..scene.attachments.len()).filter(by_bodies) {
                let at = At::ArcLength(scene.attachments[k].arc_length);
                cable.set_support(at, Support::default())?;
            }
            for &(_, arc_length) in scene.tied(i) {
                cable.set_support(At::ArcLength(arc_length), Support::default())?;
            }
            if !fully {
                scene.add_loads(cable, i, true, false)?;
                scene.set_in_motion(cable, i)?;
                if !scene.cables[i].equilibrium {
                    warnings.extend(scene.drawn_corner(i, cable));
                }
            }
        }
        if let Some(physics) = physics {
            physics.take(scene, std::mem::take(alone), &held_by)?;
            if fully {
                reports = self.settle()?;
            } else {
                warnings.extend(physics.jolts(scene)?);
                warnings.extend(physics.inside(scene));
            }
        }
        if fully {
            self.read_statics(&reports)?;
        }
        Ok(())
    }

    /// Moves cables and bodies to equilibrium, and returns the reports of the cables.
    fn settle(&mut self) -> Result<Vec<EquilibriumReport>, Error> {
        let Some(physics) = &mut self.physics else { return Ok(Vec::new()) };
        let settled = physics.settle(&self.scene)?;
        self.static_iterations += settled.cables.iter().map(|report| report.iterations as u64).sum::<u64>();
        let unstable =
            self.cables().into_iter().zip(&settled.cables).filter(|(_, r)| !r.stable).map(|(c, _)| unstable(c));
        let loose =
            settled.unattached.iter().map(|&i| Warning::LeftAsDrawn { body: self.scene.bodies[i].name.clone() });
        let warnings: Vec<Warning> = unstable.chain(loose).collect();
        let Some(physics) = &mut self.physics else { return Ok(Vec::new()) };
        let through = physics.passing(&self.scene, 0.0);
        self.warnings.extend(warnings.into_iter().chain(through));
        self.static_bodies = Some(BodyStatics::read(self, &settled));
        Ok(settled.cables)
    }

    /// Reads the equilibrium of each cable.
    fn read_statics(&mut self, reports: &[EquilibriumReport]) -> Result<(), Error> {
        // copies, because reading reactions modifies a cable
        let mut cables: Vec<Cable> = self.cables().into_iter().cloned().collect();
        let each = cables.iter_mut().zip(reports).enumerate();
        let read = each.map(|(i, (cable, report))| CableStatics::read(&self.scene, i, cable, report));
        self.statics = Some(read.collect::<Result<Vec<_>, _>>()?);
        Ok(())
    }

    /// Records the energy at the start.
    pub(super) fn note_start(&mut self) {
        self.energy_start = self.energy(None).total();
    }

    /// Advances all cables and bodies to a time in s, a host time: cables that are overloaded then break, and cuts that are due are made.
    ///
    /// # Errors
    /// [`Error::Mechanics`] names the cable and the time; that cable is then at the last good state. [`Error::Body`] names the body.
    pub fn advance(&mut self, time: f64) -> Result<(), Error> {
        if let Some(physics) = &mut self.physics {
            physics.advance(&self.scene, self.time, time)?;
            self.warnings.extend(physics.passing(&self.scene, time));
            self.time = time;
        } else {
            for i in 0..self.alone.len() {
                let dt = time - self.alone[i].time();
                if dt > 0.0 {
                    self.alone[i].step(dt)?;
                }
                if let Some((rest, how)) = self.alone[i].break_overloaded()? {
                    self.alone.push(rest);
                    self.note_break(i, &how);
                }
            }
        }
        self.note_breaks();
        for cable in 0..self.cut.len() {
            if let Some((_, s)) = self.scene.cables[cable].breaking.cut.filter(|(t, _)| *t <= time)
                && !core::mem::replace(&mut self.cut[cable], true)
            {
                self.cut(cable, s)?;
            }
        }
        Ok(())
    }

    /// Cuts a cable at an arc length in m, unless it broke there before.
    fn cut(&mut self, cable: usize, arc_length: f64) -> Result<(), Error> {
        let (part, s) = self.part(cable, arc_length);
        let length = self.cables()[part].length();
        if s <= 1e-9 * length || s >= length * (1.0 - 1e-9) {
            return Ok(());
        }
        if let Some(physics) = self.physics.as_mut().filter(|_| self.alone.is_empty()) {
            physics.cut(&self.scene, self.time, part, s)?;
            self.note_breaks();
        } else {
            let (rest, how) = self.alone[part].break_at(s)?;
            self.alone.push(rest);
            self.note_break(part, &how);
        }
        Ok(())
    }

    /// Notes the breaks of cables with bodies.
    fn note_breaks(&mut self) {
        let parted = self.physics.as_mut().map_or(Vec::new(), |physics| physics.take_breaks());
        for (part, how) in parted {
            self.note_break(part, &how);
        }
    }

    /// Returns a copy whose cables do not break, for times between host times.
    pub(super) fn unbreakable(&self) -> World {
        let mut copy = self.clone();
        copy.cut.fill(true);
        // no limit is a strength that every cable takes
        copy.alone.iter_mut().for_each(|cable| drop(cable.set_strength(None)));
        if let Some(physics) = &mut copy.physics {
            physics.withstand_all();
        }
        copy
    }

    /// Returns of a sheave: length passed in m, rate in m/s, tensions at its cables in N, friction in N, energy lost in J; `None` if it ended.
    pub fn sheave(&self, sheave: usize) -> Option<[f64; 6]> {
        self.physics.as_ref()?.sheave(sheave)
    }

    /// Returns whether a sheave stands because its cable cannot run on.
    pub(super) fn sheave_stopped(&self, sheave: usize) -> bool {
        self.physics.as_ref().is_some_and(|physics| physics.sheave_stopped(sheave))
    }

    /// Returns the scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the cables, in the order of the scene, and after them the [parts](Self::pieces) of those that broke.
    pub fn cables(&self) -> Vec<&Cable> {
        match &self.physics {
            Some(physics) if self.alone.is_empty() => physics.cables(),
            _ => self.alone.iter().collect(),
        }
    }

    /// Returns the time that all cables and bodies have reached, in s.
    pub fn time(&self) -> f64 {
        match &self.physics {
            Some(_) => self.time,
            None => self.alone.iter().map(Cable::time).fold(f64::INFINITY, f64::min),
        }
    }
}

/// Returns the warning about an equilibrium that is not stable.
fn unstable(cable: &Cable) -> Warning {
    let strain = |s: f64| cable.sample(s).map_or(0.0, |sample| sample.green_strain);
    let compressed = cable.node_arc_lengths().into_iter().map(strain).fold(0.0, f64::min);
    let beyond = compressed < -1e-3 && cable.rule().axial == AxialRule::Projected;
    let (rule, compression) = (cable.rule().to_string(), beyond.then_some(-compressed));
    Warning::UnstableEquilibrium { cable: cable.name().to_string(), rule, compression }
}
