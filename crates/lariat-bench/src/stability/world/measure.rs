//! Reads a world into its monitor after each step.

use super::convert::from_rapier;
use super::monitor::{Checks, Reading};
use super::test_world::{HEAVIEST_BODY, Rope, TestWorld};
use lariat_ancf::Cable;

impl TestWorld {
    /// Begins the energy balance anew and checks everything: a user changed the world.
    pub fn restart_balance(&mut self) {
        let now = self.read();
        self.monitor.restart_balance(&now);
    }

    /// Checks nothing until [`restart_balance`](Self::restart_balance): a user changes the world,
    /// which does work and opens gaps.
    pub fn suspend_checks(&mut self) {
        self.monitor.checks = Checks::None;
    }

    /// Checks gaps but no energy until [`restart_balance`](Self::restart_balance).
    ///
    /// The work of a winch is computed from the forces at the ends of Rapier's steps, between which
    /// a stiff cable vibrates.
    pub fn suspend_energy_check(&mut self) {
        self.monitor.checks = Checks::Gaps;
    }

    /// Measures a world after a host step.
    pub fn measure(&mut self) {
        let now = self.read();
        // what the weight of all that moves does over 1 mm
        let least_scale = 9.81e-3 * self.mass();
        self.monitor.record(&now, least_scale);
    }

    fn read(&self) -> Reading {
        let (energy, kinetic_and_strain) = self.energy();
        let attachment = |handle| {
            let Ok(a) = self.set.attachment(handle) else { return (0.0, false) };
            let free = self.physics.bodies.get(a.body()).is_some_and(|b| b.is_dynamic() && b.is_enabled());
            (a.work(), !free)
        };
        let gaps = self.attachments.iter().filter_map(|a| self.set.attachment(*a).ok()).map(|a| a.gap());
        let peer_gaps = self.ropes.iter().map(|rope| match rope {
            Rope::Peer(rope) => rope.gap(&self.physics),
            Rope::Cable(_) => 0.0,
        });
        Reading {
            energy,
            kinetic_and_strain,
            attachment_work: self.attachments.iter().map(|handle| attachment(*handle)).collect(),
            known_work: self.known_forces.iter().map(|(body, force)| force.dot(&self.position(*body))).sum(),
            effect_work: self.set.iter().map(|(_, c)| c.effect_work().line_loads + c.effect_work().drag.max(0.0)).sum(),
            dissipated: self.set.iter().map(|(_, c)| (-c.effect_work().drag).max(0.0) - c.effect_work().damping).sum(),
            gap: gaps.chain(peer_gaps).fold(0.0, f64::max),
            constraint: self.joint_error(),
            stretch: (0..self.ropes.len()).map(|i| self.stretch(i)).fold(f64::NEG_INFINITY, f64::max),
            forces: (0..self.attachments.len()).map(|i| self.force(i)).collect(),
        }
    }

    /// Returns the total energy, and its kinetic and strain part, in J.
    pub fn energy(&self) -> (f64, f64) {
        let Ok(e) = self.set.energy(&self.physics) else { return (f64::NAN, f64::NAN) };
        let c = &e.cables;
        let mut sum = (e.total(), e.bodies_kinetic + c.kinetic + c.axial + c.bending);
        for rope in &self.ropes {
            if let Rope::Peer(rope) = rope {
                let (total, kinetic) = rope.energy(&self.physics);
                sum = (sum.0 + total, sum.1 + kinetic);
            }
        }
        sum
    }

    /// Returns the mass of all bodies and cables that move, in kg.
    pub fn mass(&self) -> f64 {
        let bodies = self.physics.bodies.iter().filter(|(_, b)| b.is_dynamic()).map(|(_, b)| f64::from(b.mass()));
        let bodies: f64 = bodies.filter(|mass| *mass < HEAVIEST_BODY).sum();
        let of = |c: &Cable| c.elements().iter().map(|e| e.length * e.section.mass_per_length).sum::<f64>();
        let cables: f64 = self.set.iter().map(|(_, c)| of(c)).sum();
        bodies + cables
    }

    /// Returns the elements that all cables evaluated so far.
    pub fn element_evaluations(&self) -> u64 {
        self.set.iter().map(|(_, c)| c.diagnostics().element_evaluations()).sum()
    }

    /// Returns whether every number of the state is finite.
    pub fn is_finite(&self) -> bool {
        let bodies = self.physics.bodies.iter().all(|(_, b)| {
            [b.translation(), b.linvel(), b.angvel()].iter().all(|x| from_rapier(*x).iter().all(|x| x.is_finite()))
        });
        let cables = self.set.iter().all(|(_, c)| c.positions().iter().chain(c.velocities()).all(|x| x.is_finite()));
        let peers = self.ropes.iter().all(|rope| match rope {
            Rope::Peer(rope) => rope.is_finite(&self.physics),
            Rope::Cable(_) => true,
        });
        bodies && cables && peers
    }

    /// Returns the length of a rope through nodes, particles or joints over its unstretched length,
    /// minus 1.
    pub fn stretch(&self, rope: usize) -> f64 {
        match &self.ropes[rope] {
            Rope::Cable(handle) => self.set.get(*handle).map_or(0.0, |c| {
                let length: f64 = (1..c.nodes()).map(|k| (c.node_position(k) - c.node_position(k - 1)).norm()).sum();
                length / c.length() - 1.0
            }),
            Rope::Peer(rope) => rope.stretch(&self.physics),
        }
    }

    /// Returns the largest distance in m of the anchors of a joint along the axes that it locks.
    fn joint_error(&self) -> f64 {
        let joints = self.physics.impulse_joints.iter().filter_map(|(_, j)| {
            let (a, b) = (self.physics.bodies.get(j.body1())?, self.physics.bodies.get(j.body2())?);
            let (one, two) = (*a.position() * j.data.local_frame1, *b.position() * j.data.local_frame2);
            let distance = from_rapier(one.rotation.inverse() * (two.translation - one.translation));
            let locked = j.data.locked_axes.bits();
            let along = (0..3).filter(|k| locked & (1 << k) != 0).map(|k| distance[k] * distance[k]).sum::<f64>();
            Some(along.sqrt())
        });
        joints.fold(0.0, f64::max)
    }
}
