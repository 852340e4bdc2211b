//! What a run says about itself: the mesh, the tension and the energy at all host times.

use super::World;
use super::balance::{Account, EnergyBalance, LOST, MADE};
use crate::error::Error;
use crate::scene::{Purpose, Scene};
use crate::warning::Warning;
use lariat_ancf::Cable;

/// Largest estimate of the error of position without a warning, as a share of the length.
const MESH: f64 = 2e-3;
/// Largest estimate of the error of a displacement without a warning, as a share of the largest displacement.
const MOTION: f64 = 0.1;
/// Errors of a displacement below this share of the length are those of integrators and statics.
const ROUNDING: f64 = 1e-5;
/// Largest angle in rad between the end slopes of an element that no node judges.
const TURN: f64 = 0.2;
/// Largest tension over EA.
const STRAIN: f64 = 0.05;
/// Largest rate of a reel over the speed of transverse waves.
const REEL: f64 = 0.3;
/// Largest number of elements that is advised.
const MOST: f64 = 1e6;

/// The worst readings of the cables of a run so far, and its energy balance.
pub(super) struct Watch {
    cables: Vec<Worst>,
    account: Account,
}

#[derive(Default)]
struct Worst {
    /// Positions that displacements are counted from; `None` if they are a guess of the shape.
    start: Option<Vec<f64>>,
    /// Estimate of the error of position in m.
    position: f64,
    /// Estimate of the error of the displacement in m: the less of those of the shape and of its change.
    motion: f64,
    /// Largest displacement in m.
    displacement: f64,
    /// Angle in rad between the end slopes of an element.
    turn: f64,
    /// Largest tension in N, and its time in s.
    tension: (f64, f64),
    /// Largest rate of a reel over the speed of transverse waves, and its time in s.
    reel: (f64, f64),
}

impl Watch {
    /// Begins with the cables as they are: for a run at t = 0, for statics as drawn. A cable that is not drawn straight is drawn near the
    /// equilibrium that statics find, and its displacement says nothing.
    pub fn new(world: &World, purpose: Purpose) -> Self {
        let drawn = world.scene.cables.iter().map(|cable| purpose == Purpose::Run || cable.points.len() == 2);
        let worst = |(cable, known): (&Cable, bool)| Worst {
            start: known.then(|| cable.positions().to_vec()),
            ..Worst::default()
        };
        Watch { cables: world.cables().into_iter().zip(drawn).map(worst).collect(), account: Account::default() }
    }

    /// Reads the cables at a host time.
    ///
    /// # Errors
    /// [`Error::Mechanics`]; not for cables that keep their meshes.
    pub fn note(&mut self, world: &World) -> Result<(), Error> {
        self.account.note(world)?;
        for (worst, cable) in self.cables.iter_mut().zip(world.cables()) {
            let shape = cable.mesh_indicator();
            worst.position = worst.position.max(shape.position);
            worst.turn = worst.turn.max(shape.turn);
            // a part of a cable is another one, and its displacement that of its flight
            worst.start = worst.start.take().filter(|start| start.len() == cable.positions().len());
            if let Some(start) = &worst.start {
                let motion = cable.motion_indicator(start)?;
                worst.motion = worst.motion.max(motion.error.min(shape.position));
                worst.displacement = worst.displacement.max(motion.displacement);
            }
            let ratio = cable.reels().map(|reel| reel.speed_ratio).fold(0.0, f64::max);
            if ratio.is_finite() && ratio > worst.reel.0 && cable.effects().damping.is_none() {
                worst.reel = (ratio, cable.time());
            }
            let (_, tension) = cable.peak_tension();
            if tension > worst.tension.0 {
                worst.tension = (tension, cable.time());
            }
        }
        Ok(())
    }

    /// Returns the energy balance.
    pub fn balance(&self) -> EnergyBalance {
        self.account.balance
    }

    fn energy_warning(&self) -> Option<Warning> {
        let balance = self.account.balance;
        let EnergyBalance { made_j, made_at_s, lost_j, lost_at_s, scale_j, .. } = balance;
        if balance.made() > MADE {
            return Some(Warning::EnergyMade { time_s: made_at_s, made_j, scale_j });
        }
        (balance.lost() > LOST).then_some(Warning::EnergyLost { time_s: lost_at_s, lost_j, scale_j })
    }

    /// Returns the warnings about the energy and the cables. If an error is asked for, that is the limit of the mesh, and only of its indicator: the runs
    /// judge what nodes cannot.
    pub fn warnings(&self, scene: &Scene, error: Option<f64>) -> Vec<Warning> {
        self.cables
            .iter()
            .zip(&scene.cables)
            .flat_map(|(worst, cable)| {
                let (elements, name) = (cable.elements, || cable.name.clone());
                let (position, motion) = (worst.position, worst.motion);
                let limit = error.unwrap_or(MESH * cable.length);
                let mesh = if position > limit {
                    let enough = more(elements, position / (0.5 * limit));
                    Some(Warning::CoarseMesh { cable: name(), error_m: position, elements, enough })
                } else if error.is_none() && motion > MOTION * worst.displacement && motion > ROUNDING * cable.length {
                    let enough = more(elements, motion / (0.5 * MOTION * worst.displacement));
                    let displacement_m = worst.displacement;
                    Some(Warning::CoarseMotion { cable: name(), error_m: motion, displacement_m, elements, enough })
                } else {
                    None
                };
                let turn = (error.is_none() && worst.turn > TURN).then(|| {
                    // an arc of this angle, divided into k elements, has the indicator h turn^3/(96 k^4), h its length
                    let parts = (worst.turn.powi(3) / (96.0 * 0.5 * MESH)).powf(0.25).max(2.0);
                    let enough = (elements as f64 * parts).ceil().clamp(4.0, MOST) as usize;
                    Warning::CoarseElement { cable: name(), turn_rad: worst.turn, elements, enough }
                });
                let ea = cable.section.axial_stiffness;
                let strain = (worst.tension.0 > STRAIN * ea).then(|| {
                    let (tension_n, time_s) = worst.tension;
                    Warning::LargeStrain { cable: name(), time_s, tension_n, axial_stiffness_n: ea }
                });
                let (ratio, time_s) = worst.reel;
                let reel = (ratio > REEL).then(|| Warning::FastReel { cable: name(), time_s, ratio });
                [strain, mesh, turn, reel].into_iter().flatten()
            })
            .chain(self.energy_warning())
            .collect()
    }
}

/// Returns a number of elements that makes an error `factor` times smaller, if it falls with the power 2.5 of the element length: smooth
/// shapes that are resolved converge with 3 to 4, the falling pendulum from 2 to 8 elements with 2 to 3.
fn more(elements: usize, factor: f64) -> usize {
    (elements as f64 * factor.powf(0.4)).ceil().min(MOST) as usize
}
