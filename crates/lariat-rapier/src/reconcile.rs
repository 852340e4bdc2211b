//! After a Rapier step: bodies and cables are settled, and what passed between them is accounted.

use crate::convert::{rotation, vector};
use crate::islands::{IslandStep, Member};
use crate::predict::pick;
use crate::set::CableSet;
use crate::{bear, hand_over, impedance};
use ::nalgebra::Vector3;
use rapier::pipeline::PhysicsWorld;

impl CableSet {
    pub(crate) fn reconcile_island(&mut self, world: &mut PhysicsWorld, island: &mut IslandStep, h: f64) {
        if island.idle {
            return;
        }
        if self.stale {
            // cables or attachments changed since the prediction: the bodies alone are settled
            self.settle_members(world, island, h);
            return;
        }
        if self.fell_asleep(world, island) {
            self.undo_for_sleep(world, island, h);
            return;
        }
        if !island.members.is_empty() {
            self.settle_members(world, island, h);
            self.account(world, island, h);
        }
        self.account_ends(world, island);
        self.keep_awake(world, island);
    }

    /// Whether Rapier put all bodies of an island to sleep instead of stepping them.
    fn fell_asleep(&self, world: &PhysicsWorld, island: &IslandStep) -> bool {
        island.handles().next().is_some()
            && island.handles().all(|b| world.bodies.get(b).is_some_and(rapier::dynamics::RigidBody::is_sleeping))
    }

    /// They did not move: neither do the cables.
    fn undo_for_sleep(&mut self, world: &mut PhysicsWorld, island: &IslandStep, h: f64) {
        self.restore_cables(island);
        pick(&mut self.cables, &island.cables).into_iter().for_each(|cable| cable.rest(h));
        for ((member, given), linkage) in island.members.iter().zip(&island.given).zip(&island.linkages) {
            if let (Member::Body(handle), Some(given)) = (member, given) {
                hand_over::fall_asleep(world, *handle, (given, linkage.as_ref()), self.remember(*handle));
            }
        }
    }

    /// Bodies as Rapier left them, and the impulses of motors into the cables.
    fn settle_members(&mut self, world: &mut PhysicsWorld, island: &mut IslandStep, h: f64) {
        island.impulses.clear();
        for (pin, driven) in island.motors.iter().enumerate() {
            let attachment = island.attachments[pin].and_then(|a| self.attachments[a].as_ref());
            let passed = attachment.filter(|_| *driven).map(|a| impedance::passed(world, a));
            island.impulses.push(passed.unwrap_or_else(Vector3::zeros));
        }
        for (b, member) in island.members.iter().enumerate() {
            let (Member::Body(handle), Some(given)) = (member, &island.given[b]) else { continue };
            let linkage = island.linkages[b].as_ref();
            if !world.bodies.contains(*handle) {
                if let Some(linkage) = linkage {
                    bear::restore(world, linkage.borne());
                }
                continue;
            }
            if world.bodies[*handle].is_sleeping() {
                hand_over::fall_asleep(world, *handle, (given, linkage), self.remember(*handle));
                continue;
            }
            let end = &island.bodies[b];
            let mut total = (Vector3::zeros(), Vector3::zeros());
            for (pin, p) in island.pins.iter().zip(&island.impulses).filter(|(p, _)| p.body == b) {
                total.0 += p;
                total.1 += (end.rotation * pin.anchor).cross(p);
            }
            let deviated = hand_over::settle(world, *handle, end, (given, linkage), self.remember(*handle), total, h);
            if !deviated {
                for (_, p) in island.pins.iter().zip(&mut island.impulses).filter(|(p, _)| p.body == b) {
                    *p = Vector3::zeros();
                }
            }
        }
        if !self.stale && island.impulses.iter().any(|p| *p != Vector3::zeros()) {
            for (c, cable) in pick(&mut self.cables, &island.cables).into_iter().enumerate() {
                let of = |(p, _): &(&lariat_ancf::island::PinConstraint, &Vector3<f64>)| p.cable == c;
                let own: Vec<Vector3<f64>> =
                    island.pins.iter().zip(&island.impulses).filter(of).map(|(_, p)| *p).collect();
                island.impedances[c].apply_impulses(cable, &own);
            }
        }
    }

    /// Force, moment, gap, work and its residual at each pin.
    fn account(&mut self, world: &PhysicsWorld, island: &IslandStep, h: f64) {
        for (i, pin) in island.pins.iter().enumerate() {
            let Some(index) = island.attachments[i] else { continue };
            let exact = match island.members[pin.body] {
                Member::Body(handle) => {
                    self.remembered(handle).and_then(|m| m.exact.as_ref()).map(|e| (e.position, e.rotation))
                }
                _ => None,
            };
            let Some(a) = self.attachments[index].as_mut() else { continue };
            let Some(body) = world.bodies.get(a.body) else { continue };
            let Some(slot) = &self.cables[a.cable.0 as usize] else { continue };
            let (anchor, attitude) = match exact {
                Some((position, attitude)) => (position + attitude * pin.anchor, attitude),
                None => {
                    let attitude = rotation(*body.rotation());
                    (vector(body.translation()) + attitude * a.anchor, attitude)
                }
            };
            let start = &island.start[pin.body];
            let landed = exact.is_some() || island.given[pin.body].is_none();
            let mean = (a.passed.impulse + island.impulses[i]) / h;
            let gap = slot.cable.node_position(a.node) - anchor;
            let account = &mut a.account;
            account.work += if landed {
                a.passed.work
            } else {
                let turned = (attitude * start.rotation.inverse()).scaled_axis();
                mean.dot(&(anchor - start.point(&pin.anchor))) + a.passed.angular_impulse.dot(&turned) / h
            };
            account.residual += mean.dot(&(account.gap - gap));
            account.force = a.passed.force + island.impulses[i] / h;
            account.moment = a.passed.moment;
            account.gap = gap;
            if let Member::Driven(_) = island.members[pin.body] {
                a.placed = Some(anchor);
            }
        }
    }
}
