//! Reading the energy balance of a cable. Equation: [`EnergyBalance`].

use crate::cable::Cable;
use crate::integrate::OneStep;
use crate::watch::{CableAccount, Last};

pub use crate::scales::term::TOLERANCE as ROUNDING;
pub use crate::watch::{CableTerms, EnergyBalance, IslandChange, Sizes, Verdict};

/// Returns the weight of a cable in N and its axial stiffness times its length in J.
pub fn weight_and_stiffness(cable: &Cable) -> (f64, f64) {
    let gravity = cable.gravity().norm();
    let of_element =
        |e: &crate::Element| (e.section.mass_per_length * e.length * gravity, e.section.axial_stiffness * e.length);
    cable.elements().iter().map(of_element).fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1))
}

impl CableTerms {
    /// Reads the works on a cable, without its energies.
    pub fn of_works(cable: &Cable) -> Self {
        let (effects, law) = (cable.effect_work(), cable.energy_law());
        let dissipated = effects.dissipated() + law.dissipated();
        let reels: f64 = cable.reels().map(|reel| reel.work + reel.remeshed).sum();
        // impacts do no work: they take energy
        let of_effects = effects.total() + dissipated - law.impacts;
        CableTerms {
            dissipated,
            work: of_effects + law.loads + law.supports + cable.inserted_energy() + reels,
            on_bodies: law.bodies,
            by_law: law.residual - law.numerical - law.rescaled - law.shortened,
            uncertain: law.uncertain,
            ..CableTerms::default()
        }
    }

    /// Reads energies and works of a cable; `buffer` is for its momenta.
    pub fn of(cable: &Cable, buffer: &mut Vec<f64>) -> Self {
        let energy = cable.energy_in(buffer);
        let (kinetic, strain, gravity) =
            (energy.kinetic, energy.axial + energy.bending + energy.potentials, energy.gravity);
        CableTerms { kinetic, strain, gravity, ..CableTerms::of_works(cable) }
    }
}

impl CableAccount {
    /// Reads the cable at a host time.
    pub fn note(&mut self, cable: &Cable) {
        let terms = CableTerms::of(cable, &mut self.buffer);
        let now = Last { revision: cable.revision, terms, strain: terms.strain, gravity: terms.gravity };
        let Some(last) = self.last.replace(now).filter(|last| last.revision == now.revision) else { return };
        self.last = Some(Last { strain: last.strain, gravity: last.gravity, ..now });
        // the sum has the work of winches, too, but what impacts take is in the law alone
        let summed = cable.has_reel() && cable.effects().contact.is_none();
        let by_law = cable.integrator().method.uses_discrete_gradients() && !summed;
        let change = if by_law { terms.by_law - last.terms.by_law } else { terms.sum() - last.terms.sum() };
        let dissipated = terms.dissipated - last.terms.dissipated;
        self.balance.dissipated_j += dissipated;
        self.balance.work_j += terms.work - last.terms.work;
        self.note_errors(
            terms.kinetic + terms.strain.abs() + terms.gravity.abs(),
            terms.uncertain - last.terms.uncertain,
        );
        let (weight, stiffness) = weight_and_stiffness(cable);
        let sizes = Sizes {
            kinetic: terms.kinetic,
            strain: terms.strain - last.strain,
            gravity: terms.gravity - last.gravity,
            weight,
            stiffness,
        };
        self.balance.add(cable.time(), change, if by_law { dissipated } else { 0.0 }, &sizes);
    }
}

impl Cable {
    /// Returns the energy balance since the cable is [watched](Self::set_watched): its own, or of
    /// the first cable of an [island](crate::island) that of all that moves together with it;
    /// `None` if it is not watched.
    pub fn energy_balance(&self) -> Option<EnergyBalance> {
        self.watch.as_deref().map(|watch| watch.account.balance)
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn note_island(&mut self, step: &IslandChange) {
        let time = self.time();
        if let Some(watch) = &mut self.watch {
            watch.account.add(time, step);
        }
    }
}
