//! Scaling down the motion of an island that is not rigid, where a step makes energy.
//!
//! # Equation
//!
//! Of an island that nothing holds, the relative velocities are those beside the translation of its centre of mass, so its momentum stays;
//! of any other, all velocities that nothing prescribes. Scaling those of cables and bodies together keeps pinned points on their bodies.

use super::IslandStep;
use crate::integrate::discrete_gradient::{Balance, share_to_take};
use crate::system::{CableStep, dot};
use nalgebra::Vector3;

/// See [`DiscreteGradientSystem::rescale`](crate::integrate::discrete_gradient::DiscreteGradientSystem::rescale).
pub(in crate::island) fn rescale(island: &mut IslandStep<'_, '_>, balance: &mut Balance) -> bool {
    let velocity = mean_velocity(island);
    let (mut energy, mut product) = (0.0, 0.0);
    for cable in island.cables.iter_mut() {
        let CableStep { equations, state, buffers: b } = cable.step_parts();
        for i in 0..b.change.len() {
            b.external[i] = state.v[i] + b.velocity_change[i];
        }
        b.taken.clone_from(&b.external);
        for w in b.taken.chunks_exact_mut(6) {
            (0..3).for_each(|x| w[x] -= velocity[x]);
        }
        for (node, support) in equations.model.supports.iter().filter(|(_, support)| !support.attached) {
            support.project(&mut b.taken[6 * node..6 * node + 6]);
        }
        energy += 0.5 * equations.system.mass_square(&b.taken, &mut b.product);
        product += dot(&b.external, &b.product);
    }
    for body in &mut island.buffers.bodies {
        let (own, with_all) = body.take_relative(&velocity);
        energy += own;
        product += with_all;
    }
    let share = share_to_take(energy, product, balance.excess());
    let factor = share.unwrap_or(0.0);
    for cable in island.cables.iter_mut() {
        cable.step_buffers.taken.iter_mut().for_each(|w| *w *= factor);
    }
    island.buffers.bodies.iter_mut().for_each(|body| body.taken *= factor);
    if share.is_some() {
        balance.rescaled += balance.excess();
    }
    share.is_some()
}

/// Returns the velocity of the centre of mass of an island that nothing holds, at the end of the step; else zero.
fn mean_velocity(island: &mut IslandStep<'_, '_>) -> Vector3<f64> {
    let held = island.cables.iter().any(|cable| cable.model.supports.iter().any(|(_, support)| !support.attached))
        || island.buffers.bodies.iter().any(|body| body.free != [true; 6]);
    if held {
        return Vector3::zeros();
    }
    let (mut momentum, mut mass) = (Vector3::zeros(), 0.0);
    for cable in island.cables.iter_mut() {
        let CableStep { equations, state, buffers: b } = cable.step_parts();
        for i in 0..b.change.len() {
            b.external[i] = state.v[i] + b.velocity_change[i];
        }
        let system = &*equations.system;
        system.mass.multiply(system.level, &b.external, &mut b.product);
        for p in b.product.chunks_exact(6) {
            momentum += Vector3::new(p[0], p[1], p[2]);
        }
        mass += system.scales.mass;
    }
    for body in &island.buffers.bodies {
        let (of_body, own) = body.momentum();
        momentum += of_body;
        mass += own;
    }
    momentum / mass
}
