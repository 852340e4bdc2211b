//! Scaling down the motion of an island that is not rigid, where a step makes energy.
//!
//! # Equation
//!
//! ```text
//! w = v - (V + W x (x - c))          a velocity beside a rigid motion; a slope's: t' - W x t
//! ```
//!
//! Of an island that nothing holds, the rigid motion is the projection of all velocities onto rigid
//! motions in the norm of the kinetic energy, so its momentum and its angular momentum stay; with
//! reels, with bodies that may not turn, or that carry others, which joints may hold, the
//! translation of its centre of mass. Of one that one point at rest holds, whose angular momentum
//! about it is restored, it is the rotation about that point with that angular momentum. Of one
//! whose driven bodies and supports all move as one rigid body, it is their motion. Of any other
//! there is none, and all velocities that nothing prescribes are scaled. Scaling those of cables
//! and bodies together keeps pinned points on their bodies.
//!
//! What joints hold of a body that carries others has 1e4 times its inertia, and an energy that no
//! body of the engine has. Of such a body, with inertia B and M of its own, only `B^-1 M w` is
//! scaled, which is next to nothing along what joints hold: what a step makes is not paid from
//! there.
//!
//! # Alternatives considered
//! The translation alone: of two balls on a stiff cable of which one was kicked, a step took 0.19
//! of the angular momentum.

use super::IslandStep;
use super::body::BodyStep;
use super::coupled::coupled_product;
use super::rigid::RigidMotion;
use crate::cable::Cable;
use crate::integrate::discrete_gradient::share_to_take;
use crate::island::hold::vector;
use crate::system::StepVectors;
use crate::system::{CableStep, Modes, dot, relative_velocities, solve_semidefinite as solve};
use crate::term::Balance;
use nalgebra::{Matrix6, Vector3, Vector6};

/// See
/// [`DiscreteGradientSystem::rescale`](crate::integrate::discrete_gradient::DiscreteGradientSystem::rescale).
pub(in crate::island) fn rescale(island: &mut IslandStep<'_, '_>, balance: &mut Balance, largest_share: f64) -> bool {
    if island.cables.len() == 1 && island.buffers.bodies.is_empty() {
        return rescale_alone(island.cables[0], balance, largest_share);
    }
    let rigid = rigid_motion(island);
    let (mut energy, mut product) = (0.0, 0.0);
    for body in &mut island.buffers.bodies {
        let (own, with_all) = body.take_relative(&rigid);
        energy += own;
        product += with_all;
    }
    let bodies = &island.buffers.bodies;
    for (cable, own) in island.cables.iter_mut().zip(&island.buffers.cables) {
        let CableStep { equations, state, buffers: b } = cable.step_parts();
        for i in 0..b.change.len() {
            b.external[i] = state.v[i] + b.velocity_change[i];
        }
        b.taken.clone_from(&b.external);
        for (at, w) in b.taken.chunks_exact_mut(6).enumerate() {
            let (q, change) = (&state.q[6 * at..], &b.change[6 * at..]);
            let (position, slope) = (rigid.at(&(vector(q) + vector(change))), vector(&q[3..]) + vector(&change[3..]));
            let slope = rigid.spin.cross(&slope);
            for x in 0..3 {
                w[x] -= position[x];
                w[3 + x] -= slope[x];
            }
        }
        for (node, support) in equations.model.supports.iter().filter(|(_, support)| !support.attached) {
            support.project(&mut b.taken[6 * node..6 * node + 6]);
        }
        for hold in &own.holds {
            let (body, anchor) = (&bodies[hold.body], &island.layout.pins[hold.pin].anchor);
            let held = &mut b.taken[hold.at..hold.at + 3];
            if body.is_driven() {
                held.fill(0.0);
            } else if body.carries() {
                let slope = hold.slope.then(|| vector(&state.q[hold.at..]) + vector(&b.change[hold.at..]));
                held.copy_from_slice(body.taken_at(anchor, slope, &vector(held)).as_slice());
            }
        }
        energy += 0.5 * equations.system.mass_square(&b.taken, &mut b.product);
        product += dot(&b.external, &b.product);
    }
    let coupled = &island.buffers.coupled;
    energy += 0.5 * coupled_product(coupled, |i| bodies[i].taken, |i| bodies[i].taken);
    product += coupled_product(coupled, |i| bodies[i].final_velocity(), |i| bodies[i].taken);
    let share = share_to_take(energy, product, balance.surplus(), largest_share);
    let factor = share.unwrap_or(0.0);
    for cable in island.cables.iter_mut() {
        cable.step_buffers.taken.iter_mut().for_each(|w| *w *= factor);
    }
    island.buffers.bodies.iter_mut().for_each(|body| body.taken *= factor);
    if share.is_some() {
        balance.rescaled += balance.surplus();
    }
    share.is_some()
}

/// Without bodies, the rotations about the one point that is held are rigid motions too.
fn rescale_alone(cable: &mut Cable, balance: &mut Balance, largest_share: f64) -> bool {
    let CableStep { equations, state, buffers } = cable.step_parts();
    // the other buffers are free now
    let StepVectors { velocity_change, change, rhs, external, product, taken, linearised, .. } = buffers;
    for i in 0..change.len() {
        product[i] = state.q[i] + change[i];
        rhs[i] = state.v[i] + velocity_change[i];
    }
    taken.clone_from(rhs);
    relative_velocities(equations.model, equations.system, product, taken, external, linearised);
    let energy = 0.5 * equations.system.mass_square(taken, external);
    let share = share_to_take(energy, dot(rhs, external), balance.surplus(), largest_share);
    if let Some(share) = share {
        taken.iter_mut().for_each(|x| *x *= share);
        balance.rescaled += balance.surplus();
    } else {
        taken.clear();
    }
    share.is_some()
}

/// Returns the rigid motion that an island may keep, at the end of the step.
fn rigid_motion(island: &mut IslandStep<'_, '_>) -> RigidMotion {
    let reels = island.cables.iter().any(|cable| !cable.system.feeds.is_empty());
    let first = &island.cables[0].step_buffers;
    if first.before.is_some() && !reels {
        let pivot = first.pivot;
        return projection(island, pivot);
    }
    let mut common = None;
    for cable in island.cables.iter_mut() {
        let CableStep { equations, state, buffers: b } = cable.step_parts();
        for (_, support) in equations.model.supports.iter().filter(|(_, support)| !support.attached) {
            let (mut q, mut v) = ([0.0; 6], [0.0; 6]);
            support.prescribe(state.time + b.h, &mut q, &mut v);
            let translation = RigidMotion { velocity: vector(&v), ..RigidMotion::default() };
            if vector(&v[3..]) != Vector3::zeros() || !translation.agrees_with(common.get_or_insert(translation)) {
                return RigidMotion::default();
            }
        }
    }
    for body in island.buffers.bodies.iter().filter(|body| body.free[..3] != [true; 3]) {
        let motion = motion_of(body);
        if !body.is_driven() || !motion.agrees_with(common.get_or_insert(motion)) {
            return RigidMotion::default();
        }
    }
    common.unwrap_or_else(|| {
        let turns = |body: &BodyStep| body.free == [true; 6] && !body.carries();
        if reels || !island.buffers.bodies.iter().all(turns) {
            RigidMotion { velocity: mean_velocity(island), ..RigidMotion::default() }
        } else {
            projection(island, None)
        }
    })
}

/// Returns the rigid motion with the momenta of an island that nothing holds, at the end of the
/// step, or the rotation about the one point that holds it.
fn projection(island: &mut IslandStep<'_, '_>, pivot: Option<Vector3<f64>>) -> RigidMotion {
    let (mut matrix, mut momenta) = (Matrix6::zeros(), Vector6::zeros());
    let of_body = || island.buffers.bodies.first().map(|body| body.position + body.displacement());
    let centre = pivot.or_else(of_body).unwrap_or_else(Vector3::zeros);
    for cable in island.cables.iter_mut() {
        let CableStep { equations, state, buffers } = cable.step_parts();
        // the other buffers are free now
        let StepVectors { velocity_change, change, rhs, external, product, taken, .. } = &mut *buffers;
        for i in 0..change.len() {
            rhs[i] = state.v[i] + velocity_change[i];
        }
        taken.clear();
        taken.extend(state.q.iter().zip(&*change).map(|(q, change)| q + change));
        let modes = Modes { q: taken, origin: centre };
        modes.add_momenta(equations.system, (0, rhs), [product, external], (&mut matrix, &mut momenta));
    }
    for body in island.buffers.bodies.iter().filter(|body| !body.is_driven()) {
        for k in 0..6 {
            let momentum = body.momentum_of(&body.velocity_in(k, &centre));
            momenta[k] += momentum.dot(&body.final_velocity());
            (0..6).for_each(|j| matrix[(j, k)] += momentum.dot(&body.velocity_in(j, &centre)));
        }
    }
    if pivot.is_some() {
        matrix.fixed_rows_mut::<3>(0).fill(0.0);
        matrix.fixed_columns_mut::<3>(0).fill(0.0);
        momenta.fixed_rows_mut::<3>(0).fill(0.0);
    }
    let motion = solve(&mut matrix, momenta);
    let [velocity, spin] = [0, 3].map(|k| motion.fixed_rows::<3>(k).into_owned());
    RigidMotion { centre, velocity, spin }
}

/// Returns the velocity of the centre of mass of an island at the end of the step.
fn mean_velocity(island: &mut IslandStep<'_, '_>) -> Vector3<f64> {
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
        mass += if system.feeds.is_empty() {
            system.scales.mass
        } else {
            b.external.iter_mut().enumerate().for_each(|(i, x)| *x = if i % 6 == 0 { 1.0 } else { 0.0 });
            system.mass_square(&b.external, &mut b.product)
        };
    }
    for body in &island.buffers.bodies {
        let (of_body, own) = body.momentum();
        momentum += of_body;
        mass += own;
    }
    momentum / mass
}

/// Returns the rigid motion of a body at the end of the step.
fn motion_of(body: &BodyStep) -> RigidMotion {
    let [velocity, spin] = body.end_velocity();
    RigidMotion { centre: body.position + body.displacement(), velocity, spin }
}
