//! What a run says about itself: its cables and its energy at all host times.

use super::World;
use super::balance::Account;
use super::hinges::Hinge;
use super::wheels::WheelWatch;
use crate::error::Error;
use crate::scene::Purpose;
use crate::warning::Warning;
use lariat_ancf::warning::balance::{EnergyBalance, Verdict};
use lariat_ancf::warning::breaks_again;
use lariat_ancf::warning::fold::Judged;

/// Returns what is to be said of the parts of cables that break again and again.
fn broken_again(world: &World) -> impl Iterator<Item = Warning> {
    world.cables().into_iter().zip(&world.scene.cables).filter_map(|(cable, own)| {
        let breaks = world.breaks.iter().filter(|parted| parted.cable == own.name).map(|parted| parted.breaks);
        breaks_again(cable, breaks.max()?).map(Warning::Cable)
    })
}

/// Returns whether two warnings are of one kind and about one cable.
fn is_same(one: &Warning, other: &Warning) -> bool {
    one.same_kind(other) && one.cable() == other.cable()
}

/// The readings of the cables of a run so far, and its energy balance.
pub(super) struct Watch {
    cables: Vec<lariat_ancf::Watch>,
    wheels: Vec<WheelWatch>,
    hinges: Vec<Hinge>,
    /// By sheave, when it was first found stopped.
    stopped: Vec<Option<f64>>,
    account: Account,
}

impl Watch {
    /// Begins with the cables as they are: for a run at t = 0, for statics as drawn. A cable that is not drawn straight is drawn near the
    /// equilibrium that statics find, and its displacement says nothing.
    pub fn new(world: &World, purpose: Purpose) -> Self {
        let drawn = world.scene.cables.iter().map(|cable| purpose != Purpose::Static || cable.points.len() == 2);
        let watch = |(cable, known)| {
            if known { lariat_ancf::Watch::new(cable) } else { lariat_ancf::Watch::from_guess() }
        };
        Watch {
            cables: world.cables().into_iter().zip(drawn).map(watch).collect(),
            wheels: WheelWatch::all(world),
            hinges: Hinge::all(world),
            stopped: vec![None; world.scene.sheaves.len()],
            account: Account::default(),
        }
    }

    /// Reads the cables at a host time.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for a running scene.
    pub fn note(&mut self, world: &World) -> Result<(), Error> {
        self.account.note(world)?;
        self.wheels.iter_mut().for_each(|wheel| wheel.note(world));
        self.hinges.iter_mut().for_each(|hinge| hinge.note(world));
        for (sheave, stopped) in self.stopped.iter_mut().enumerate() {
            *stopped = stopped.or(world.sheave_stopped(sheave).then(|| world.time()));
        }
        // the part of a broken cable that comes first keeps its place
        self.cables.iter_mut().zip(world.cables()).for_each(|(watch, cable)| watch.note(cable));
        Ok(())
    }

    /// Returns the energy balance.
    pub fn balance(&self) -> EnergyBalance {
        self.account.balance
    }

    fn energy_warning(&self, world: &World) -> Option<Warning> {
        let discrete_gradient = world.has_energy_law();
        Some(match self.account.balance.verdict()? {
            Verdict::Made(time_s, made_j, scale_j) => {
                Warning::EnergyMade { time_s, made_j, scale_j, discrete_gradient }
            }
            Verdict::Lost(time_s, lost_j, scale_j) => Warning::EnergyLost { time_s, lost_j, scale_j },
        })
    }

    /// Returns the warnings about the cables and the energy, if an error of positions (m) is asked for against that.
    pub fn warnings(&self, world: &World, error: Option<f64>) -> Vec<Warning> {
        let of_cables = self.cables.iter().zip(world.cables()).flat_map(|(watch, cable)| watch.warnings(cable, error));
        let of_stops = self.stopped.iter().zip(&world.scene.sheaves).filter_map(|(stopped, sheave)| {
            stopped.map(|time_s| Warning::SheaveStopped { sheave: sheave.name.clone(), time_s })
        });
        let of_hinges = self.hinges.iter().filter_map(|hinge| hinge.warning(world));
        let of_wheels = self.wheels.iter().filter_map(|wheel| wheel.warning(world));
        let of_gaps = world.physics.iter().flat_map(|physics| physics.open_gaps(&world.scene));
        let of_joints = world.physics.iter().flat_map(|physics| physics.unsettled(&world.scene));
        let name = |key| world.physics.as_ref()?.name_of_obstacle(&world.scene, key);
        let mut of_cables: Vec<_> = of_cables.map(|warning| Warning::Cable(warning.with_body(name))).collect();
        let of_parts: Vec<_> =
            broken_again(world).filter(|part| !of_cables.iter().any(|own| is_same(own, part))).collect();
        of_cables.extend(of_parts);
        of_cables
            .into_iter()
            .chain(self.energy_warning(world))
            .chain(of_wheels)
            .chain(of_hinges)
            .chain(of_stops)
            .chain(of_gaps)
            .chain(of_joints)
            .collect()
    }
}
