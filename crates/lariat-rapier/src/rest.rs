//! Sleep: a cable sleeps with the bodies that it holds, and wakes with them.
//!
//! Rapier puts a body to sleep that was slower than 0.05 m/s for half a second. On a cable that is too soon: a steel wire that bounces
//! so slowly is far from the tension at which it will rest. So a body's patience begins anew as long as a cable or a body of its
//! island is faster than [`Settings::sleep_speed`](crate::Settings), the force at a pin leaves the one with which the patience began
//! by more than [`STEADY`] of it, a load is ramping, or an end is moved. An island all of whose bodies sleep is not stepped: time
//! passes over it. Any body that wakes, an end that moves, a change to a cable, gravity, or an attachment wakes all of it.
//! *Validity.* The cable must come to rest: without damping it never does.

use crate::CableHandle;
use crate::event::Event;
use crate::islands::{IslandStep, Member};
use crate::set::CableSet;
use rapier::pipeline::PhysicsWorld;

/// Share by which the force at a pin may change while a body falls asleep.
const STEADY: f64 = 2e-3;

impl CableSet {
    /// Whether an island sleeps through the coming step; wakes all of it if anything in it stirs.
    pub(crate) fn sleeps(&mut self, world: &mut PhysicsWorld, island: &mut IslandStep, h: f64) -> bool {
        let bodies = island.handles().count();
        let asleep = island.handles().filter(|&b| world.bodies[b].is_sleeping()).count();
        let mut stirred = bodies > 0 && self.is_pulled(world, island, h);
        for &c in &island.cables {
            let Some(slot) = &mut self.cables[c] else { continue };
            stirred |= core::mem::take(&mut slot.stirred);
        }
        island.stirred = stirred;
        let sleeps = asleep > 0 && asleep == bodies && !stirred && self.is_quiet(world, island);
        if asleep > 0 && !sleeps && (stirred || !self.is_quiet(world, island)) {
            for body in island.handles() {
                world.islands.wake_up(&mut world.bodies, body, true);
            }
        }
        for &c in &island.cables {
            let Some(slot) = &mut self.cables[c] else { continue };
            if slot.asleep != sleeps {
                slot.asleep = sleeps;
                let cable = CableHandle(c as u32);
                self.events.push(if sleeps { Event::Asleep(cable) } else { Event::Awake(cable) });
            }
        }
        sleeps
    }

    /// After a step: bodies whose cables still move or change their pull must not fall asleep.
    pub(crate) fn keep_awake(&mut self, world: &mut PhysicsWorld, island: &IslandStep) {
        if island.handles().next().is_none()
            || !island.stirred && self.is_steady(island) && self.is_quiet(world, island)
        {
            return;
        }
        for index in island.attachments.iter().flatten() {
            if let Some(a) = &mut self.attachments[*index] {
                a.steady = a.account.force;
            }
        }
        for member in &island.members {
            if let Member::Body(handle) = member
                && let Some(body) = world.bodies.get_mut(*handle)
                && !body.is_sleeping()
            {
                body.activation_mut().time_since_can_sleep = 0.0;
            }
        }
    }

    /// Whether the forces at the pins of an island are those with which its patience began.
    fn is_steady(&self, island: &IslandStep) -> bool {
        island.attachments.iter().flatten().filter_map(|&i| self.attachments[i].as_ref()).all(|a| {
            let force = a.account.force;
            (force - a.steady).norm() <= STEADY * force.norm()
        })
    }

    /// Whether cables and bodies of an island are slow, and all loads at their full value.
    fn is_quiet(&self, world: &PhysicsWorld, island: &IslandStep) -> bool {
        let most = self.settings.sleep_speed;
        let still = |i: usize, member: &Member| match member {
            Member::Body(handle) => world.bodies.get(*handle).is_none_or(|body| {
                let of_body = island.pins.iter().filter(|p| p.body == i);
                let lever = of_body.map(|p| p.anchor.norm()).fold(0.0, f64::max);
                f64::from(body.linvel().length()) + f64::from(body.angvel().length()) * lever < most
            }),
            _ => true,
        };
        island.members.iter().enumerate().all(|(i, member)| still(i, member))
            && island.cables.iter().filter_map(|&c| self.cables[c].as_ref()).all(|slot| {
                slot.asleep
                    || slot.cable.speed() < most && slot.cable.is_loaded_steadily() && slot.cable.is_held_still()
            })
    }
}
