//! The energy balance of a run.
//!
//! # Equation
//!
//! That of [`lariat_ancf::warning::balance`], of all cables together, and of the dynamic bodies that nothing but cables, gravity and loads moves. The
//! work is that of effects (damping and drag take it), point loads, moving supports, loads on bodies, and of all other bodies on their cables.
//!
//! # Validity
//!
//! The energy law of the discrete gradient takes its place in a run in which all cables step by it. A body in a host step in which a collider
//! is near it, or with a joint, takes part by what its cables do on it: what contacts and joints take is not known. With reels the works are summed,
//! those of winches too; but with a cable that has contact and a reel, and in host steps in which a body is near another, the law is judged: what
//! impacts of cables take is in the law alone, and so is what a body that touches does on its cables within a step. Without the law the work of
//! such a body's cables in the step, all of it, bounds what is not known.

use super::World;
use crate::error::Error;
use crate::physics::BodyTerms;
use lariat_ancf::warning::balance::{EnergyBalance, ROUNDING, Sizes};

/// Energies and works up to a time, in J.
#[derive(Clone, Debug, Default)]
pub(super) struct Terms {
    pub kinetic: f64,
    pub strain: f64,
    pub gravity: f64,
    /// Weight of all cables and dynamic bodies in N.
    pub weight: f64,
    /// Sum of axial stiffness times length of all cables in J.
    pub stiffness: f64,
    pub dissipated: f64,
    /// Work on cables, but that of damping and drag.
    pub work: f64,
    /// Work of the forces by which joints and contacts take part in the energy law: on bodies, where these are predicted.
    pub reactions: f64,
    /// Whether a cable has contact and a reel: its works are not all known.
    pub unknown: bool,
    /// Whether a cable has a reel.
    pub winds: bool,
    /// Energy that the discrete gradient made, less what it lost; only if all cables step by it.
    pub by_law: Option<f64>,
    /// By how much the works may be wrong.
    pub uncertain: f64,
    /// Work that a rounding error of the positions of bodies is worth, with the present forces.
    pub rounding: f64,
    /// By dynamic body, in the order of the scene.
    pub bodies: Vec<BodyTerms>,
}

/// The balance of a run so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Account {
    start: Option<Terms>,
    last: Terms,
    /// Sum of [`Terms::rounding`] in J.
    steps_rounding: f64,
    /// Largest rounding error of the energies in J.
    largest_rounding: f64,
    pub balance: EnergyBalance,
}

impl Account {
    /// Reads the energy at a host time.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for a running scene.
    pub fn note(&mut self, world: &World) -> Result<(), Error> {
        let now = world.terms()?;
        if now.unknown && now.by_law.is_none() {
            self.start = None;
            return Ok(());
        }
        let Account { start, last, steps_rounding, largest_rounding, balance } = self;
        let start = start.get_or_insert_with(|| {
            last.clone_from(&now);
            now.clone()
        });
        // an island that changed its integrator changed which account has the forces on its bodies
        for (now, last_body) in now.bodies.iter().zip(&mut last.bodies) {
            let moved = last_body.gravity - last_body.loads;
            last.reactions += moved * (f64::from(now.in_law) - f64::from(last_body.in_law));
            last_body.in_law = now.in_law;
        }
        let is_summed = |t: &Terms| t.winds && !t.unknown && !t.bodies.iter().any(|body| body.near);
        let judged = !is_summed(&now) || !is_summed(last);
        let is_uncertain = now.winds && now.by_law.is_none();
        let by_law = now.by_law.zip(last.by_law).filter(|_| judged).map(|(now, last)| now - last);
        let cables = |t: &Terms| t.kinetic + t.strain + t.gravity + t.dissipated - t.work;
        let mut change = cables(&now) - cables(last);
        let mut work = now.work - last.work;
        for (now, last) in now.bodies.iter().zip(&last.bodies) {
            if now.free && last.free {
                change += now.kinetic + now.gravity - now.loads - (last.kinetic + last.gravity - last.loads);
                work += now.loads - last.loads;
            } else {
                change += now.cables - last.cables;
                work -= now.cables - last.cables;
                // within a step a winch pulls on a body as that lands, or not
                if is_uncertain && (now.near || last.near) {
                    *steps_rounding += (now.cables - last.cables).abs();
                }
            }
        }
        if let Some(by_law) = by_law {
            change = by_law;
            work += now.reactions - last.reactions;
        }
        let sum = |t: &Terms, of: fn(&BodyTerms) -> f64| t.bodies.iter().map(of).sum::<f64>();
        let kinetic = now.kinetic + sum(&now, |body| body.kinetic);
        let gravity = |t: &Terms| t.gravity + sum(t, |body| body.gravity);
        balance.work_j += work;
        let dissipated = now.dissipated - last.dissipated;
        balance.dissipated_j = now.dissipated - start.dissipated;
        let held = kinetic + now.strain.abs() + now.gravity.abs();
        let bodies = sum(&now, |body| body.kinetic + body.gravity.abs());
        *steps_rounding += now.rounding;
        let differences = ROUNDING * held + f64::from(f32::EPSILON) * bodies;
        *largest_rounding = largest_rounding.max(differences);
        balance.rounding_j = *largest_rounding + *steps_rounding + now.uncertain - start.uncertain;
        let sizes = Sizes {
            kinetic,
            strain: now.strain - start.strain,
            gravity: gravity(&now) - gravity(start),
            weight: now.weight,
            stiffness: now.stiffness,
        };
        balance.add(world.time(), change, by_law.map_or(0.0, |_| dissipated), &sizes);
        *last = now;
        Ok(())
    }
}
