//! Energies, works, momenta and forces of the cables and bodies of a scene.

use super::World;
use super::balance::Terms;
use crate::error::Error;
use crate::physics::BodyState;
use crate::scene::{AttachmentScene, CableScene};
use lariat_ancf::contact::PairTouch;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::integrate::OneStep;
use lariat_ancf::{Cable, Energy, Momentum, ReasonCounts, Vector3};
use std::collections::BTreeMap;

impl World {
    fn chosen(&self, cable: Option<usize>) -> Vec<&Cable> {
        let all = self.cables().into_iter().zip(self.pieces());
        all.filter(|(_, piece)| cable.is_none_or(|cable| cable == piece.cable)).map(|(cable, _)| cable).collect()
    }

    /// Returns the energy of a cable, or of all cables and dynamic bodies.
    pub fn energy(&self, cable: Option<usize>) -> Energy {
        let mut sum = Energy::default();
        for e in self.chosen(cable).into_iter().map(Cable::energy) {
            sum += e;
        }
        if let (None, Some(physics)) = (cable, &self.physics) {
            let (kinetic, gravity) = physics.energy(&self.scene);
            sum.kinetic += kinetic;
            sum.gravity += gravity;
        }
        sum
    }

    /// Returns the energy in J that damping, drag, friction and impacts have taken from a cable, or from all. Contacts of cables that are
    /// solved together count for the first of them.
    pub fn dissipated(&self, cable: Option<usize>) -> f64 {
        self.chosen(cable).into_iter().map(dissipated).sum()
    }

    /// Returns the number of elements evaluated by effect, summed over the cables that have it; zero for effects that act by
    /// constant vectors or the mass matrix.
    pub fn effect_evaluations(&self) -> BTreeMap<String, u64> {
        let mut counts = BTreeMap::new();
        for cable in self.cables() {
            for key in cable.effects().present() {
                let count = cable.diagnostics().effects.by_key().find(|(k, _)| *k == key).map_or(0, |(_, count)| count);
                *counts.entry(key.to_string()).or_insert(0) += count;
            }
        }
        counts
    }

    /// Returns Newton iterations and divisions of steps of all cables, by the reason for them; only
    /// reasons for which there are any.
    pub fn reasons(&self) -> [BTreeMap<String, u64>; 2] {
        let mut sums = [ReasonCounts::default(); 2];
        for cable in self.cables() {
            sums[0] += cable.diagnostics().iterations_for;
            sums[1] += cable.diagnostics().divisions_for;
        }
        let any = |(key, count): (&str, u64)| (count > 0).then(|| (key.to_string(), count));
        sums.map(|sum| sum.by_key().filter_map(any).collect())
    }

    /// Returns the work in J that a cable, or all, have done on the bodies that they are attached to.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for a running scene.
    pub fn interface_work(&self, cable: Option<usize>) -> Result<f64, Error> {
        let Some(physics) = &self.physics else { return Ok(0.0) };
        let mut sum = 0.0;
        for (k, _) in self
            .scene
            .attachments
            .iter()
            .enumerate()
            .filter(|(_, a)| cable.is_none_or(|c| c == self.scene.whole(a.cable)))
        {
            sum += physics.reading(k, self.time)?.map_or(0.0, |reading| reading.work);
        }
        Ok(sum)
    }

    /// Returns the energies and works of the energy balance.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for a running scene.
    pub(super) fn terms(&self) -> Result<Terms, Error> {
        let mut terms = Terms::default();
        let mut by_law = 0.0;
        for cable in self.cables() {
            let (energy, effects, law) = (cable.energy(), cable.effect_work(), cable.energy_law());
            terms.kinetic += energy.kinetic;
            terms.strain += energy.axial + energy.bending + energy.torsion;
            terms.gravity += energy.gravity;
            let dissipated = dissipated(cable);
            terms.dissipated += dissipated;
            let work = effects.total() + law.loads - law.bodies + law.supports + cable.inserted_energy();
            terms.reactions += law.bodies;
            // impacts do no work: they take energy
            terms.work += work + dissipated - law.impacts;
            terms.uncertain += law.uncertain;
            terms.unknown |= cable.has_reel() && cable.effects().contact.is_some();
            terms.winds |= cable.has_reel();
            terms.work += cable.reels().map(|reel| reel.work + reel.remeshed).sum::<f64>();
            by_law += law.residual - law.numerical - law.rescaled - law.shortened;
        }
        if let Some(physics) = &self.physics {
            terms.rounding = physics.bodies_balance(&self.scene, self.time, &mut terms.bodies)?;
            terms.weight = physics.weight(&self.scene);
        }
        let masses = self.scene.cables.iter().map(CableScene::mass);
        terms.weight += self.scene.gravity.norm() * masses.sum::<f64>();
        let stiffness = self.scene.cables.iter().map(|cable| cable.mean_of(|s| s.axial_stiffness) * cable.length);
        terms.stiffness = stiffness.sum();
        // the law has the work of gravity and loads on bodies, too
        let in_law = terms.bodies.iter().filter(|body| body.in_law);
        terms.reactions += in_law.map(|body| body.gravity - body.loads).sum::<f64>();
        terms.by_law = self.has_energy_law().then_some(by_law);
        Ok(terms)
    }

    /// Returns whether all cables step by the discrete gradient.
    pub(super) fn has_energy_law(&self) -> bool {
        match &self.physics {
            Some(physics) if self.alone.is_empty() => physics.all_have_law(),
            _ => self.alone.iter().all(|cable| cable.integrator().method.uses_discrete_gradients()),
        }
    }

    /// Returns the momentum of a cable, or of all cables and dynamic bodies.
    pub fn momentum(&self, cable: Option<usize>) -> Momentum {
        let zero = Momentum { linear: Vector3::zeros(), angular: Vector3::zeros() };
        let bodies = self.physics.as_ref().filter(|_| cable.is_none()).map(|physics| physics.momentum(&self.scene));
        self.chosen(cable)
            .into_iter()
            .map(Cable::momentum)
            .chain(bodies)
            .fold(zero, |sum, p| Momentum { linear: sum.linear + p.linear, angular: sum.angular + p.angular })
    }

    /// Returns the state of a body; `None` without bodies.
    pub fn body(&self, index: usize) -> Option<BodyState> {
        self.physics.as_ref().map(|physics| physics.body(&self.scene, index, self.time))
    }

    /// Returns the largest distance so far between the two sides of an attachment, in m.
    pub fn max_gap(&self) -> f64 {
        self.physics.as_ref().map_or(0.0, |physics| physics.max_gap())
    }

    /// Returns force (N) and moment (N m) of the cable on the body or world that an attachment holds it to, and the gap (m)
    /// between the two.
    ///
    /// # Errors
    /// [`Error::Mechanics`] if the present state has no finite acceleration.
    pub fn attachment(&mut self, index: usize) -> Result<(Vector3<f64>, Vector3<f64>, f64), Error> {
        let (mut force, mut moment, mut gap) = self.one_side(index)?;
        for other in 0..self.scene.attachments.len() {
            if self.scene.attachments[other].other_side_of == Some(index) {
                let side = self.one_side(other)?;
                (force, moment, gap) = (force + side.0, moment + side.1, gap.max(side.2));
            }
        }
        Ok((force, moment, gap))
    }

    /// Returns the same of one side of a kink.
    fn one_side(&mut self, index: usize) -> Result<(Vector3<f64>, Vector3<f64>, f64), Error> {
        if let Some(physics) = &self.physics
            && let Some(reading) = physics.reading(index, self.time)?
        {
            return Ok((reading.force, reading.moment, reading.gap.norm()));
        }
        let AttachmentScene { cable, arc_length, .. } = self.scene.attachments[index];
        // a copy, because reading reactions modifies a cable, which wakes it
        let behind_kink = self.scene.attachments[index].other_side_of.is_some();
        let (part, arc_length) = if behind_kink { (cable, 0.0) } else { self.part_of(cable, arc_length) };
        let (force, moment) = match self.alone.get_mut(part) {
            Some(cable) => pull(cable, arc_length, &[])?,
            None => pull(&mut self.cables()[part].clone(), arc_length, &self.cables())?,
        };
        Ok((force, moment, 0.0))
    }
}

/// Returns the energy in J that damping, drag, friction and impacts have taken from a cable.
fn dissipated(cable: &Cable) -> f64 {
    cable.effect_work().dissipated() + cable.energy_law().dissipated()
}

/// Returns force (N) and moment (N m) of a cable on its support at an arc length; zero without one. It is among `all` with which it may have
/// contacts.
pub(super) fn pull(cable: &mut Cable, arc_length: f64, all: &[&Cable]) -> Result<(Vector3<f64>, Vector3<f64>), Error> {
    let (node, key) = (cable.node(arc_length)?, cable.contact_key());
    let others = all.iter().filter(|other| other.contact_key() != key).flat_map(|other| {
        let kept = other.cable_contacts().filter(|touch| touch.other == key);
        kept.map(|touch| touch.mirrored(other.contact_key()))
    });
    let kept: Vec<PairTouch> = others.collect();
    let Some(held) = cable.reactions()?.into_iter().find(|reaction| reaction.node == node) else {
        return Ok(Default::default());
    };
    if kept.is_empty() {
        // 0 - 0 is 0, not -0
        return Ok((Vector3::zeros() - held.force, Vector3::zeros() - held.moment));
    }
    // its accelerations are not those of its own forces
    let own = cable.pull(node);
    let shares = kept.iter().map(|touch| cable.share_of_contact(node, touch));
    Ok(shares.fold(own, |(force, moment), share| (force + share.0, moment + share.1)))
}
