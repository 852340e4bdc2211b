//! How many Rapier steps a host step takes.
//!
//! ```text
//! h w <= 0.6,   w^2 = (sum of EA/l over the pins of a body)/m
//! ```
//!
//! Between two Rapier steps a body in contact only learns what the contact did. Where h is long beside the period of the body on its taut
//! cables, what it learns comes too late: two jammed bodies of 1 kg under 1 kN swing by half of it, a body let go at once is thrown by what
//! it had learnt (a gap of F h^2/2m). So where a body near others, or one that has learnt a force, hangs on a cable that is taut
//! by [`TAUT`], the host step is split finer, up to [`Settings::most_rapier_steps`](crate::Settings). l is the cable's length
//! to its end: an upper bound of its stiffness. *Measured* (1 kg, jams of 1 and 5 kN, host steps of 1/30 to 1/240 s): h w = 2.6 fails, 1.8
//! holds, 0.9 fails where two bodies hang on each other and the cable hardly damps, 0.6 holds. Not cured: the gap that opens in the step in
//! which a body first meets another. *Rejected.* More steps always: a pile of 500 boxes costs 0.5 ms in each.

use crate::attachment::Attachment;
use crate::body::is_integrated;
use crate::impedance::touches;
use crate::set::CableSet;
use lariat_ancf::Cable;
use rapier::pipeline::PhysicsWorld;

/// Strain from which a cable counts as taut.
const TAUT: f64 = 1e-5;
/// Greatest h w.
const RESOLVED: f64 = 0.6;

impl CableSet {
    /// Rapier steps for a host step of `dt` (s).
    pub(crate) fn parts(&self, world: &PhysicsWorld, dt: f64) -> u32 {
        let least = self.settings.rapier_steps.max(1);
        let most = self.settings.most_rapier_steps;
        if most <= least {
            return least;
        }
        let attached = || self.attachments.iter().flatten();
        let fastest = attached().filter(|a| self.may_deviate(world, a)).map(|a| {
            let stiffness: f64 = attached().filter(|b| b.body == a.body).map(|b| self.stiffness(b)).sum();
            stiffness * f64::from(world.bodies[a.body].mass_properties().local_mprops.inv_mass)
        });
        let fastest = fastest.fold(0.0, f64::max).sqrt();
        // a ratio that is not a number, or too large, becomes the greatest
        ((dt * fastest / RESOLVED).ceil().min(f64::from(most)) as u32).max(least)
    }

    /// Whether the body of an attachment hangs on a taut cable, and is near others or has learnt a force.
    fn may_deviate(&self, world: &PhysicsWorld, a: &Attachment) -> bool {
        let Some(section) = self.cable_of(a).map(|c| c.elements()[a.node.min(c.elements().len() - 1)].section) else {
            return false;
        };
        let force = a.account.force.norm();
        force > TAUT * section.axial_stiffness
            && is_integrated(world, a.body)
            && (touches(world, a.body) || self.remembered(a.body).is_some_and(|m| m.force.norm() > 0.1 * force))
    }

    fn cable_of(&self, a: &Attachment) -> Option<&Cable> {
        self.cables.get(a.cable.0 as usize).and_then(Option::as_ref).map(|slot| &slot.cable)
    }

    /// Stiffness of the parts of a cable at an attachment, in N/m.
    fn stiffness(&self, a: &Attachment) -> f64 {
        let Some(cable) = self.cable_of(a) else { return 0.0 };
        let side = |elements: core::ops::Range<usize>| {
            let compliances = elements.map(|e| &cable.elements()[e]).map(|e| e.length / e.section.axial_stiffness);
            let compliance: f64 = compliances.sum();
            if compliance > 0.0 { 1.0 / compliance } else { 0.0 }
        };
        let count = cable.elements().len();
        side(0..a.node.min(count)) + side(a.node.min(count)..count)
    }
}
