//! The cables of a scene while it runs.

use crate::error::Error;
use crate::scene::{AttachmentScene, Purpose, Scene};
use lariat_ancf::{Cable, Energy, Momentum, Reaction, Vector3};

/// The cables of a scene in their present state.
#[derive(Clone, Debug)]
pub struct World {
    pub(super) scene: Scene,
    pub(super) cables: Vec<Cable>,
    pub(super) warnings: Vec<String>,
    /// Iterations of the statics, which are Newton iterations too.
    pub(super) static_iterations: u64,
    pub(super) energy_start: f64,
}

impl World {
    /// Builds the cables of a scene as drawn.
    ///
    /// # Errors
    /// [`Error::Mechanics`]; not for a checked scene.
    pub fn build(scene: &Scene) -> Result<Self, Error> {
        let cables = (0..scene.cables.len()).map(|i| scene.build_cable(i)).collect::<Result<Vec<_>, _>>()?;
        let mut world =
            World { scene: scene.clone(), cables, warnings: Vec::new(), static_iterations: 0, energy_start: 0.0 };
        for cable in &world.cables {
            if let Some(reason) = cable.rule().spare_modes() {
                world.warnings.push(format!(
                    "cable {:?}: rule {} leaves modes without energy, as allowed: {reason}",
                    cable.name(),
                    cable.rule()
                ));
            }
        }
        Ok(world)
    }

    /// Puts the cables into their start: static equilibrium where the scene asks for it, loads, initial motion.
    ///
    /// # Errors
    /// [`Error::Mechanics`] if there is no equilibrium.
    pub fn start(&mut self, purpose: Purpose) -> Result<(), Error> {
        let World { scene, cables, warnings, static_iterations, .. } = self;
        for (i, cable) in cables.iter_mut().enumerate() {
            let fully = purpose == Purpose::Static;
            let settle = fully || scene.cables[i].equilibrium;
            scene.add_loads(cable, i, false, fully)?;
            if fully {
                scene.add_loads(cable, i, true, true)?;
            }
            if settle {
                scene.move_to_anchors(cable, i)?;
                let report = cable.equilibrium()?;
                *static_iterations += report.iterations as u64;
                if !report.stable {
                    warnings.push(format!(
                        "cable {:?}: the equilibrium found is unstable or indifferent (stiffness not positive definite)",
                        cable.name()
                    ));
                }
            }
            if !fully {
                scene.add_loads(cable, i, true, false)?;
                scene.set_in_motion(cable, i)?;
            }
        }
        Ok(())
    }

    /// Remembers the energy at the start.
    pub(super) fn note_start(&mut self) {
        self.energy_start = self.energy(None).total();
    }

    /// Advances all cables to a time in s.
    ///
    /// # Errors
    /// [`Error::Mechanics`] names the cable and the time; that cable is then at the last good state.
    pub fn advance(&mut self, time: f64) -> Result<(), Error> {
        for cable in &mut self.cables {
            let dt = time - cable.time();
            if dt > 0.0 {
                cable.step(dt)?;
            }
        }
        Ok(())
    }

    /// Cables of the scene, in its order.
    pub fn cables(&self) -> &[Cable] {
        &self.cables
    }

    /// Time that all cables have reached, in s.
    pub fn time(&self) -> f64 {
        self.cables.iter().map(Cable::time).fold(f64::INFINITY, f64::min)
    }

    fn chosen(&self, cable: Option<usize>) -> impl Iterator<Item = &Cable> {
        self.cables.iter().enumerate().filter(move |(i, _)| cable.is_none_or(|c| c == *i)).map(|(_, cable)| cable)
    }

    /// Energy of a cable, or of all.
    pub fn energy(&self, cable: Option<usize>) -> Energy {
        self.chosen(cable).map(Cable::energy).fold(Energy::default(), |sum, e| Energy {
            kinetic: sum.kinetic + e.kinetic,
            axial: sum.axial + e.axial,
            bending: sum.bending + e.bending,
            gravity: sum.gravity + e.gravity,
        })
    }

    /// Momentum of a cable, or of all.
    pub fn momentum(&self, cable: Option<usize>) -> Momentum {
        let zero = Momentum { linear: Vector3::zeros(), angular: Vector3::zeros() };
        self.chosen(cable)
            .map(Cable::momentum)
            .fold(zero, |sum, p| Momentum { linear: sum.linear + p.linear, angular: sum.angular + p.angular })
    }

    /// Force (N) and moment (N m) of the cable on what an attachment holds it to.
    ///
    /// # Errors
    /// [`Error::Mechanics`] if the present state has no finite acceleration.
    pub fn attachment(&mut self, index: usize) -> Result<(Vector3<f64>, Vector3<f64>), Error> {
        let AttachmentScene { cable, arc_length, .. } = self.scene.attachments[index];
        let cable = &mut self.cables[cable];
        let node = cable.node(arc_length)?;
        let held = |reaction: &&Reaction| reaction.node == node;
        let on_cable = cable.reactions()?.iter().find(held).map(|r| (r.force, r.moment));
        let (force, moment) = on_cable.unwrap_or_default();
        // 0 - 0 is 0, not -0
        Ok((Vector3::zeros() - force, Vector3::zeros() - moment))
    }
}
