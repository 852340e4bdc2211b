//! How many Rapier steps a host step takes.
//!
//! ```text
//! h w <= 0.6,   w^2 = k/m,   k = sum of EA/l over the pins of a body
//! h v g/(1 + g) <= 1 mm,   g = 0.1 h^2 k/m
//! ```
//!
//! Between two Rapier steps a body in contact only learns what the contact did. Where h is long beside the period of the body on its taut
//! cables, what it learns comes too late: two jammed bodies of 1 kg under 1 kN swing by half of it, a body let go at once is thrown by what
//! it had learnt (a gap of F h^2/2m). So where a body that is near others, or has learnt a force, hangs on a cable that is taut
//! by [`TAUT`], the host step is split finer, up to [`Settings::most_rapier_steps`](crate::Settings). l is the cable's length
//! to its end: an upper bound of its stiffness. *Measured* (1 kg, jams of 1 and 5 kN, host steps of 1/30 to 1/240 s): h w = 2.6 fails, 1.8
//! holds, 0.9 fails where two bodies hang on each other and the cable hardly damps, 0.6 holds.
//!
//! *The first contact.* A body that strikes another at v deviates from its prediction by up to v h, and the cable, heavier than the body
//! over the step, does not follow by the share g/(1 + g) (`impedance`: h^2 k for its impedance, 0.1 of its own mobility for the body): a
//! gap. So what is coming counts, not only what is: pairs that a body reaches within the host step, those it flies into (`near`), and
//! cables that may become straight within it. All is looked at again before each Rapier step, and what is left of the host step split
//! finer. *Measured*: a cube of 1 kg drawn into its stop at 0.05 m/s by a steel wire, in host steps of 1/30 s: the pin opens by 2.0 mm
//! where only taut cables count, once per host step, by 7e-6 m so; a light ball that strikes another at 11 m/s, by 113 mm before.
//! *Rejected.* More steps always: a pile of 500 boxes costs 0.5 ms in each.

use crate::attachment::Attachment;
use crate::body::is_integrated;
use crate::near;
use crate::set::CableSet;
use ::nalgebra::Vector3;
use lariat_ancf::{At, Cable};
use rapier::pipeline::PhysicsWorld;

/// Strain from which a cable counts as taut.
const TAUT: f64 = 1e-5;
/// Greatest h w.
const RESOLVED: f64 = 0.6;
/// Gap in m that may open in a Rapier step.
const GAP: f64 = 1e-3;

impl CableSet {
    /// Rapier steps for a host step of `dt` (s).
    pub(crate) fn parts(&self, world: &PhysicsWorld, dt: f64) -> u32 {
        let least = self.settings.rapier_steps.max(1);
        let most = self.settings.most_rapier_steps;
        if most <= least {
            return least;
        }
        let mut fastest = None;
        let attached = || self.attachments.iter().flatten();
        let wanted = attached().map(|a| {
            let mut fastest = || *fastest.get_or_insert_with(|| near::fastest(world));
            let Some(speed) = self.may_deviate(world, a, dt, &mut fastest) else { return 0.0 };
            let inverse_mass = f64::from(world.bodies[a.body].mass_properties().local_mprops.inv_mass);
            let stiffness: f64 = attached().filter(|b| b.body == a.body).map(|b| self.stiffness(b)).sum();
            let ringing = dt * (stiffness * inverse_mass).sqrt() / RESOLVED;
            // what the body weighs less than its cables over a Rapier step is a gap
            let step = dt / f64::from(most);
            let heavy = 0.1 * step * step * stiffness * inverse_mass;
            let flight = dt * speed * heavy / (1.0 + heavy) / GAP;
            ringing.max(flight)
        });
        let wanted = wanted.fold(0.0, f64::max);
        // a ratio that is not a number, or too large, becomes the greatest
        (wanted.ceil().min(f64::from(most)) as u32).max(least)
    }

    /// Whether the body of an attachment hangs on a cable that is taut or becomes so within `dt` (s), and meets another or has learnt a
    /// force: at which speed (m/s).
    fn may_deviate(
        &self,
        world: &PhysicsWorld,
        a: &Attachment,
        dt: f64,
        fastest: &mut impl FnMut() -> f64,
    ) -> Option<f64> {
        let cable = self.cable_of(a)?;
        if !is_integrated(world, a.body) {
            return None;
        }
        let force = a.account.force.norm();
        let section = &cable.elements()[a.node.min(cable.elements().len() - 1)].section;
        let taut = force > TAUT * section.axial_stiffness;
        let own = f64::from(world.bodies[a.body].linvel().length());
        if !taut && !tightens(cable, a.node, dt, own + fastest()) {
            return None;
        }
        let learnt = taut && self.remembered(a.body).is_some_and(|m| m.force.norm() > 0.1 * force);
        near::closing(world, a.body, dt, fastest()).or(learnt.then_some(0.0))
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

/// Whether a part of a cable between a node and an end that something holds may become straight within `dt` (s), if the node's velocity
/// changes by `change` (m/s).
fn tightens(cable: &Cable, node: usize, dt: f64, change: f64) -> bool {
    let velocity = |n: usize| Vector3::from_column_slice(&cable.velocities()[6 * n..6 * n + 3]);
    let last = cable.elements().len();
    let held = |end: usize| cable.support(At::Node(end)).is_ok_and(|s| s.attached || s.position.is_some());
    [0, last].into_iter().filter(|end| *end != node && held(*end)).any(|end| {
        let length: f64 = cable.elements()[node.min(end)..node.max(end)].iter().map(|e| e.length).sum();
        let chord = (cable.node_position(node) - cable.node_position(end)).norm();
        let speed = (velocity(node) - velocity(end)).norm() + change;
        chord + speed * dt >= length
    })
}
