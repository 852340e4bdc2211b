//! From a checked scene to cables: elements, supports, loads and motion at the start.

use super::{AttachmentScene, LoadScene, Scene};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Error, Motion, PointLoad, Vector3};
use lariat_rapier::Gap;

impl Scene {
    /// Builds a cable as drawn, supported at its attachments and junctions, without loads, sheaves and drums.
    ///
    /// # Errors
    /// As [`CableBuilder::build`](lariat_ancf::CableBuilder::build).
    pub fn build_cable(&self, index: usize) -> Result<Cable, Error> {
        let scene = &self.cables[index];
        let mut builder = Cable::builder()
            .name(self.name_of(index))
            .points(scene.points.iter().copied())
            .length(scene.length)
            .rule(scene.rule)
            .effects(scene.effects.clone())
            .allow_rank_deficient()
            .gravity(self.gravity)
            .velocity(scene.velocity)
            .angular_velocity(scene.angular_velocity)
            .integrator(scene.integrator);
        builder = scene.sections.iter().fold(builder, |builder, (from, section)| builder.section_from(*from, *section));
        builder = scene.mesh(builder);
        for attachment in self.attachments.iter().filter(|a| a.cable == index) {
            let at = At::ArcLength(attachment.arc_length);
            let turn = |along: Vector3<f64>| attachment.body.map_or(along, |body| self.bodies[body].turned(&along));
            builder = match attachment.direction.map(turn) {
                Some(direction) => builder.clamp_along(at, direction),
                None if attachment.clamp => builder.clamp(at),
                None => builder.fix(at),
            };
        }
        for &(_, arc_length) in self.tied(index) {
            builder = builder.fix(At::ArcLength(arc_length));
        }
        let loads = self.loads.iter().filter(|load| load.cable == index && scene.nodes_at_loads);
        builder = loads.fold(builder, |builder, load| builder.node_at(load.load.arc_length));
        let mut cable = builder.build()?;
        cable.set_strength(scene.breaking.strength)?;
        // a drum brings its reel
        if let (Some(reel), None) = (&scene.reel, scene.drum) {
            cable.add_reel(if scene.reel_at_start { At::Start } else { At::End }, reel.clone())?;
        }
        Ok(cable)
    }

    /// Returns the name of a cable, with the number of its part behind a sheave.
    fn name_of(&self, index: usize) -> String {
        let name = &self.cables[index].name;
        match self.parts[self.whole(index)].iter().position(|&part| part == index) {
            None | Some(0) => name.clone(),
            Some(k) => format!("{name}, part {}", k + 1),
        }
    }

    /// Returns whether material runs through the first and the last point of a cable: at a reel or a sheave.
    pub fn eyes(&self, index: usize) -> [bool; 2] {
        let cable = &self.cables[index];
        let at_sheave = |k: usize| self.sheaves.iter().any(|sheave| sheave.cables[k] == index);
        let reel = |at_start: bool| cable.reel.is_some() && cable.reel_at_start == at_start;
        [reel(true) || at_sheave(1), reel(false) || at_sheave(0)]
    }

    /// Returns the arc length in m at which a point of a cable is that was at one at t = 0: material that comes through an eye at the start
    /// moves it, and the points at eyes stay there.
    pub fn present(&self, index: usize, cable: &Cable, arc_length: f64) -> f64 {
        let [at_start, at_end] = self.eyes(index);
        if at_start && arc_length == 0.0 {
            0.0
        } else if at_end && arc_length >= self.cables[index].length * (1.0 - 1e-9) {
            cable.length()
        } else {
            arc_length + cable.length_from_start()
        }
    }

    /// Returns the points of a cable that junctions tie to others.
    pub fn tied(&self, index: usize) -> impl Iterator<Item = &(usize, f64)> {
        self.junctions.iter().flat_map(|j| &j.points).filter(move |(cable, _)| *cable == index)
    }

    /// Adds the point loads of a cable: those with a ramp, or those without. `at_once` drops the ramps.
    ///
    /// # Errors
    /// As [`Cable::add_load`].
    pub fn add_loads(&self, cable: &mut Cable, index: usize, ramped: bool, at_once: bool) -> Result<(), Error> {
        let chosen = |load: &&LoadScene| load.cable == index && (load.load.ramp > 0.0) == ramped;
        for LoadScene { load, .. } in self.loads.iter().filter(chosen) {
            cable.add_load(PointLoad { ramp: if at_once { 0.0 } else { load.ramp }, ..load.clone() })?;
        }
        Ok(())
    }

    /// Returns the anchor of an attachment in the world at t = 0, in m; `None` = where the cable point is.
    pub fn anchor(&self, attachment: &AttachmentScene) -> Option<Vector3<f64>> {
        let body = attachment.body.map(|body| &self.bodies[body]);
        attachment.anchor.map(|anchor| body.map_or(anchor, |body| body.to_world(&anchor)))
    }

    /// Moves the supports of a cable to their anchors.
    ///
    /// # Errors
    /// As [`Cable::set_support`].
    pub fn move_to_anchors(&self, cable: &mut Cable, index: usize) -> Result<(), Error> {
        for attachment in self.attachments.iter().filter(|a| a.cable == index) {
            let Some(anchor) = self.anchor(attachment) else { continue };
            let mut support = cable.support(attachment.arc_length)?;
            support.position = Some(Motion::fixed(anchor));
            cable.set_support(attachment.arc_length, support)?;
        }
        Ok(())
    }

    /// Returns whether a cable is no further from its anchors than their gaps allow.
    pub fn reaches_anchors(&self, cable: &Cable, index: usize) -> bool {
        self.attachments.iter().filter(|a| a.cable == index).all(|a| {
            let (Gap::Refuse(limit), Some(anchor)) = (a.gap, self.anchor(a)) else { return true };
            let point = cable.node(a.arc_length).map(|node| cable.node_position(node));
            point.is_ok_and(|point| (point - anchor).norm() <= limit)
        })
    }

    /// Sets a cable that is in equilibrium in motion, if the scene says so; with `ramps`, adds the loads that have one.
    ///
    /// # Errors
    /// [`lariat_ancf::Error`]; not for a checked scene.
    pub fn set_off(&self, cable: &mut Cable, index: usize, ramps: bool) -> Result<(), Error> {
        if ramps {
            self.add_loads(cable, index, true, false)?;
        }
        let moves = (self.cables[index].velocity, self.cables[index].angular_velocity) != Default::default();
        if moves { self.set_in_motion(cable, index) } else { Ok(()) }
    }

    /// Sets the initial rigid motion of a cable, with supported points at rest.
    ///
    /// # Errors
    /// As [`Cable::set_rigid_motion`](lariat_ancf::coupling::Coupling::set_rigid_motion).
    pub fn set_in_motion(&self, cable: &mut Cable, index: usize) -> Result<(), Error> {
        let scene = &self.cables[index];
        cable.set_rigid_motion(scene.velocity, scene.angular_velocity)
    }
}
