//! The cables and bodies of a scene while it runs.

use super::fine::with_chosen;
use super::{BodyStatics, CableStatics, Parted};
use crate::error::Error;
use crate::physics::Physics;
use crate::scene::{Engine, Scene};
use crate::warning::{Warning, lines};
use lariat_ancf::warning::fold;
use lariat_ancf::{Cable, Level};

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
    pub(super) cut: Vec<bool>,
    pub(super) breaks: Vec<Parted>,
    pub(super) warnings: Vec<Warning>,
    /// Up to which level warnings are told, if that was asked for.
    pub(super) warn_level: Option<Level>,
    /// Whether cables and bodies start at different velocities where they are attached.
    pub(super) velocities_jump: bool,
    /// Iterations of the statics, which are Newton iterations too.
    pub(super) static_iterations: u64,
    pub(super) energy_start: f64,
    /// Equilibria of all cables, if the world was started for statics.
    pub(super) statics: Option<Vec<CableStatics>>,
    /// What statics did with the bodies.
    pub(super) static_bodies: Option<BodyStatics>,
}

impl World {
    /// Builds the cables and bodies of a scene as drawn, on the meshes that statics choose where it says so.
    ///
    /// # Errors
    /// [`Error::NoChosenMesh`] where such a scene has no equilibrium; [`Error::Mechanics`], [`Error::Body`], not for a checked scene.
    pub fn build(scene: &Scene) -> Result<Self, Error> {
        Self::drawn(with_chosen(scene)?.as_ref())
    }

    /// Builds them on the meshes of the scene; those that statics are to choose are even.
    ///
    /// # Errors
    /// [`Error::Mechanics`], [`Error::Body`]; not for a checked scene.
    pub(super) fn drawn(scene: &Scene) -> Result<Self, Error> {
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
            warn_level: None,
            velocities_jump: false,
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

    /// Sorts the warnings by level, and returns what they tell. Up to which level a cable is warned
    /// of by default is its own choice, and what is about the run is told if it is of any cable.
    pub(super) fn told(&mut self) -> Vec<String> {
        fold::sort(&mut self.warnings);
        // what fidelity game leaves out is about steps for a bounded cost, and statics have none
        let level = |cable: &Cable| if self.statics.is_some() { Level::Coarse } else { cable.warn_level() };
        let levels: Vec<(&str, Level)> = self.cables().iter().map(|c| (c.name(), level(c))).collect();
        let most = levels.iter().map(|(_, level)| *level).max().unwrap_or(Level::Coarse);
        let of = |name: &str| levels.iter().find(|(cable, _)| *cable == name).map_or(most, |(_, level)| *level);
        let tells = |w: &Warning| w.level() <= self.warn_level.unwrap_or_else(|| w.cable().map_or(most, of));
        lines(&self.warnings, tells)
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
