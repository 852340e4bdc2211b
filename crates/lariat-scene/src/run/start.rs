//! How the world of a scene starts: as drawn, in equilibrium, or from a state that statics wrote.
//!
//! | start | cables | dynamic bodies | loads with a ramp |
//! |---|---|---|---|
//! | drawn | by `initial` of each, with bodies held | as drawn | begin at zero |
//! | `initial = "equilibrium"` of the scene | one equilibrium of all | as cables | begin at zero |
//! | statics, and a run from their state | one equilibrium of all | as cables | in full |

use super::readings::pull;
use super::state::State;
use super::{BodyStatics, CableStatics, World};
use crate::error::Error;
use crate::scene::water::without_wave;
use crate::scene::{Purpose, Scene};
use crate::warning::Warning;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, AxialRule, Cable, Effects, EquilibriumReport, Support};

impl World {
    /// Brings the cables to their start: static equilibrium where the scene asks for it, with
    /// bodies held where they are drawn, on which cables with contact lie; loads; initial motion.
    /// For a run with Rapier the cables are then attached to the bodies. For statics, and for a
    /// scene that starts in equilibrium, all cables go to equilibrium, and with Rapier the dynamic
    /// bodies attached to them, too.
    ///
    /// # Errors
    /// [`Error::Mechanics`] if there is no equilibrium, [`Error::Body`] for statics of a body with a contact, or a joint that they do not compute.
    pub fn start(&mut self, purpose: Purpose) -> Result<(), Error> {
        let fully = purpose == Purpose::Static;
        let settles = fully || self.scene.equilibrium;
        let World { scene, alone, warnings, static_iterations, physics, .. } = self;
        warnings.extend(scene.warnings(purpose));
        let mut held_by = vec![Default::default(); scene.attachments.len()];
        let (mut reports, mut twists) = (Vec::new(), Vec::new());
        // each cable finds its shape by itself first, wherever the others are
        let moves = settles || scene.cables.iter().any(|cable| cable.equilibrium);
        let drawn = if moves && physics.is_some() { alone.clone() } else { Vec::new() };
        for (i, cable) in alone.iter_mut().enumerate() {
            scene.add_loads(cable, i, false, fully)?;
            if fully {
                // what is read at rest is without the wave, too
                if let Some(still) = without_wave(cable.effects()) {
                    cable.set_effects(still)?;
                }
                scene.add_loads(cable, i, true, true)?;
            }
            if settles || scene.cables[i].equilibrium {
                scene.move_to_anchors(cable, i)?;
            }
            // what runs over a sheave, or is on a drum, has no equilibrium by itself: it begins as drawn
            let over_sheave = scene.sheaves.iter().any(|sheave| sheave.cables.contains(&i));
            let own = &scene.cables[i];
            // so does what a reel may not hold there, and holds together with bodies
            let slips = physics.is_some() && own.reel.as_ref().is_some_and(|reel| reel.max_force.is_some());
            let runs_on = settles && (over_sheave || own.drum.is_some() || slips);
            if (settles || scene.cables[i].equilibrium) && !runs_on {
                let report = match physics {
                    Some(physics) if !settles => Some(physics.equilibrium_among(scene, cable)?),
                    // where statics of all begin, on the side on which it was drawn, or as drawn
                    Some(physics) if cable.effects().contact.is_some() => {
                        let found = physics.equilibrium_among(scene, cable).ok();
                        if found.is_none() && !scene.reaches_anchors(cable, i) {
                            hang(cable)?;
                        }
                        found
                    }
                    _ => Some(cable.equilibrium()?),
                };
                *static_iterations += report.map_or(0, |report| report.iterations as u64);
                // with bodies this is where statics begin
                if report.is_some_and(|report| !report.stable) && !(settles && physics.is_some()) {
                    warnings.push(unstable(cable));
                }
                reports.extend(report);
            }
            if physics.is_none() && settles {
                if !fully {
                    scene.set_off(cable, i, true)?;
                }
                continue;
            }
            twists.push(cable.twists());
            release(scene, cable, i, &mut held_by)?;
            if !settles {
                scene.add_loads(cable, i, true, false)?;
                scene.set_in_motion(cable, i)?;
                if !scene.cables[i].equilibrium {
                    warnings.extend(scene.drawn_corner(i, cable));
                }
            }
        }
        if let Some(physics) = physics {
            physics.take(scene, std::mem::take(alone), &held_by)?;
            physics.keep_twists(twists);
            if settles {
                reports = self.settle(fully, drawn)?;
            } else if moves {
                physics.check_drawn(scene, drawn)?;
            }
        }
        if fully {
            if let Some(physics) = &mut self.physics {
                self.warnings.extend(physics.sunk(&self.scene));
            }
            return self.read_statics(&reports);
        }
        if let Some(physics) = self.physics.as_mut().filter(|_| settles) {
            physics.set_off(&self.scene)?;
        }
        self.look_at_start()
    }

    /// Starts from a state that statics of the same scene wrote, with velocities as the scene says;
    /// all loads act in full.
    ///
    /// # Errors
    /// [`Error::State`] for the state of another scene.
    pub fn resume(&mut self, state: &State) -> Result<(), Error> {
        self.warnings.extend(self.scene.warnings(Purpose::Resume));
        state.put(self)?;
        for (i, cable) in self.alone.iter_mut().enumerate() {
            self.scene.add_wave(cable, i)?;
            self.scene.set_off(cable, i, false)?;
        }
        if let Some(physics) = &mut self.physics {
            physics.set_off(&self.scene)?;
        }
        self.look_at_start()
    }

    /// Warns of what the start of a run with bodies shows.
    fn look_at_start(&mut self) -> Result<(), Error> {
        if let Some(physics) = &mut self.physics {
            let (differ, jolts) = physics.jolts(&self.scene)?;
            self.velocities_jump = differ;
            self.warnings.extend(jolts);
            self.warnings.extend(physics.inside(&self.scene));
        }
        Ok(())
    }

    /// Moves cables and bodies to equilibrium, and returns the reports of the cables.
    fn settle(&mut self, fully: bool, drawn: Vec<Cable>) -> Result<Vec<EquilibriumReport>, Error> {
        let Some(physics) = &mut self.physics else { return Ok(Vec::new()) };
        let settled = physics.settle(&self.scene, fully, drawn)?;
        self.static_iterations += settled.cables.iter().map(|report| report.iterations as u64).sum::<u64>();
        let unstable =
            self.cables().into_iter().zip(&settled.cables).filter(|(_, r)| !r.stable).map(|(c, _)| unstable(c));
        let loose =
            settled.unattached.iter().map(|&i| Warning::LeftAsDrawn { body: self.scene.bodies[i].name.clone() });
        let warnings: Vec<Warning> = unstable.chain(loose.filter(|_| fully)).collect();
        let Some(physics) = &mut self.physics else { return Ok(Vec::new()) };
        let through = physics.passing(&self.scene, 0.0);
        self.warnings.extend(warnings.into_iter().chain(through));
        if fully {
            self.static_bodies = Some(BodyStatics::read(self, &settled));
        }
        Ok(settled.cables)
    }

    /// Reads the equilibrium of each cable.
    fn read_statics(&mut self, reports: &[EquilibriumReport]) -> Result<(), Error> {
        // copies, because reading reactions modifies a cable
        let all = self.cables();
        let mut cables: Vec<Cable> = all.iter().map(|&cable| cable.clone()).collect();
        let each = cables.iter_mut().zip(reports).enumerate();
        let read = each.map(|(i, (cable, report))| CableStatics::read(&self.scene, i, (cable, &all), report));
        self.statics = Some(read.collect::<Result<Vec<_>, _>>()?);
        Ok(())
    }
}

/// Frees the points of a cable that bodies or junctions hold from now on, and notes what held them.
fn release(
    scene: &Scene,
    cable: &mut Cable,
    index: usize,
    held_by: &mut [(lariat_ancf::Vector3<f64>, lariat_ancf::Vector3<f64>)],
) -> Result<(), Error> {
    let by_bodies = |k: &usize| scene.attachments[*k].cable == index && scene.attachments[*k].body.is_some();
    for k in (0..scene.attachments.len()).filter(by_bodies) {
        held_by[k] = pull(cable, scene.attachments[k].arc_length, &[])?;
    }
    for k in (0..scene.attachments.len()).filter(by_bodies) {
        cable.set_support(At::ArcLength(scene.attachments[k].arc_length), Support::default())?;
    }
    for &(_, arc_length) in scene.tied(index) {
        cable.set_support(At::ArcLength(arc_length), Support::default())?;
    }
    Ok(())
}

/// Hangs a cable from its anchors as if it touched nothing, if that has an equilibrium: statics of
/// all begin there.
fn hang(cable: &mut Cable) -> Result<(), Error> {
    let mut free = cable.clone();
    free.set_effects(Effects { contact: None, ..free.effects().clone() })?;
    if free.equilibrium().is_ok() {
        cable.set_coordinates(free.positions(), free.velocities())?;
    }
    Ok(())
}

/// Returns the warning about an equilibrium that is not stable.
fn unstable(cable: &Cable) -> Warning {
    let strain = |s: f64| cable.sample(s).map_or(0.0, |sample| sample.green_strain);
    let compressed = cable.node_arc_lengths().into_iter().map(strain).fold(0.0, f64::min);
    let beyond = compressed < -1e-3 && cable.rule().axial == AxialRule::Projected;
    let (rule, compression) = (cable.rule().to_string(), beyond.then_some(-compressed));
    Warning::UnstableEquilibrium { cable: cable.name().to_string(), rule, compression }
}
