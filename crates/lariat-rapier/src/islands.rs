//! Which cables, bodies and junctions move together: the connected sets over pins.
//!
//! The order within an island, and of islands, is that of the cables' names and first places, not of their handles: the order of
//! insertion does not change a bit. Islands are found anew only when attachments or the kind of a body change.

use crate::attachment::Attachment;
use crate::body::is_integrated;
use crate::convert::vector;
use crate::linkage::Linkage;
use crate::set::{CableSet, Slot};
use crate::{CableHandle, Error};
use ::nalgebra::Vector3;
use lariat_ancf::island::{Impedance, PinConstraint, RigidBody};
use lariat_ancf::{At, SlopeSupport, Snapshot};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{AngVector, Vector};
use rapier::pipeline::PhysicsWorld;

/// What a body is to its cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// It moves with the cable.
    Integrated,
    /// It moves as it likes, and turns the tangent of a clamp.
    Driven,
    /// It moves as it likes: the end of the cable is prescribed.
    Support,
}

/// An attachment as the islands were found with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    attachment: usize,
    cable: usize,
    node: usize,
    body: RigidBodyHandle,
    role: Role,
    /// From the body's centre of mass, or its origin if it is driven.
    anchor: Vector3<f64>,
    direction: Option<Vector3<f64>>,
}

/// Something that pins hold to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Member {
    /// An integrated body.
    Body(RigidBodyHandle),
    /// A body that feels nothing.
    Driven(RigidBodyHandle),
    /// A junction, by its index.
    Junction(usize),
}

/// One island during a Rapier step.
#[derive(Clone, Debug, Default)]
pub(crate) struct IslandStep {
    /// Cables, as indices into the set.
    pub cables: Vec<usize>,
    pub members: Vec<Member>,
    /// Pins, with indices into the two lists above.
    pub pins: Vec<PinConstraint>,
    /// The attachment of each pin; none at a junction.
    pub attachments: Vec<Option<usize>>,
    /// Attachments whose ends are prescribed.
    pub supports: Vec<usize>,
    /// Members before the step, and as predicted at its end.
    pub start: Vec<RigidBody>,
    pub bodies: Vec<RigidBody>,
    /// By member, what it moves with.
    pub linkages: Vec<Option<Linkage>>,
    /// The cables before the step.
    pub before: Vec<Snapshot>,
    /// By member, what Rapier was given.
    pub given: Vec<Option<Given>>,
    /// By cable, its answer to impulses, where a body of the island is near others.
    pub impedances: Vec<Impedance>,
    /// By pin, whether its motors run, and what they passed in N s.
    pub motors: Vec<bool>,
    pub impulses: Vec<Vector3<f64>>,
    /// Whether an end moved or a cable was changed.
    pub stirred: bool,
    /// Asleep, or not stepped for another reason.
    pub idle: bool,
}

impl IslandStep {
    /// Handles of its integrated bodies.
    pub fn handles(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.members.iter().filter_map(|m| if let Member::Body(h) = m { Some(*h) } else { None })
    }
}

/// What Rapier was given for a body in place of its own state, and what to restore.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Given {
    pub linvel: Vector,
    pub angvel: AngVector,
    /// Centre of mass in body axes.
    pub centre: Vector,
    /// Whether it touches nothing and no joint holds it.
    pub alone: bool,
    /// Whether it is a link of a multibody, or joined to a dynamic body.
    pub linked: bool,
    /// Velocities in m/s that balancing its forces adds and takes within Rapier's step.
    pub rounding: f64,
    pub own_linvel: Vector,
    pub own_angvel: AngVector,
    pub user_force: Vector,
    pub user_torque: AngVector,
    pub gyroscopic: bool,
    pub fast_rotation: bool,
    pub linear_damping: rapier::math::Real,
    pub angular_damping: rapier::math::Real,
}

fn hold(world: &PhysicsWorld, attachment: usize, a: &Attachment) -> Held {
    let role = match (is_integrated(world, a.body), a.direction) {
        (true, _) => Role::Integrated,
        (false, Some(_)) => Role::Driven,
        (false, None) => Role::Support,
    };
    let centre =
        if role == Role::Integrated { vector(world.bodies[a.body].local_center_of_mass()) } else { Vector3::zeros() };
    let (cable, node, body) = (a.cable.0 as usize, a.node, a.body);
    Held { attachment, cable, node, body, role, anchor: a.anchor - centre, direction: a.direction }
}

impl CableSet {
    /// Sorts cables into islands, unless they are sorted.
    pub(crate) fn find_islands(&mut self, world: &PhysicsWorld) -> Result<(), Error> {
        let attached = || self.attachments.iter().enumerate().filter_map(|(i, a)| a.as_ref().map(|a| (i, a)));
        let same = attached().map(|(i, a)| hold(world, i, a)).eq(self.held.iter().copied());
        let stirred = self.cables.iter().flatten().any(|slot| slot.stirred);
        if same && !stirred && !self.stale && !self.islands.is_empty() {
            return Ok(());
        }
        self.stale = false;
        self.renumber()?;
        let attached = || self.attachments.iter().enumerate().filter_map(|(i, a)| a.as_ref().map(|a| (i, a)));
        self.held = attached().map(|(i, a)| hold(world, i, a)).collect();
        let mut order: Vec<usize> = (0..self.cables.len()).filter(|&c| self.cables[c].is_some()).collect();
        let slot = |c: usize| self.cables[c].as_ref().expect("filtered above");
        order.sort_by(|&a, &b| slot(a).rank(slot(b)).then(a.cmp(&b)));
        let mut held = self.held.clone();
        held.sort_by_key(|h| (order.iter().position(|&c| c == h.cable), h.node));
        self.give_nodes(&held)?;
        let mut seen = vec![false; self.cables.len()];
        self.islands.clear();
        for &first in &order {
            if seen[first] {
                continue;
            }
            let mut island = self.reach(first, &held, &mut seen);
            // the order of cables is that of their ranks, that of members the one in which the cables meet them
            let place = |c: &usize| order.iter().position(|o| o == c);
            island.cables.sort_by_key(place);
            self.pin(&mut island, &held);
            self.islands.push(island);
        }
        Ok(())
    }

    /// Finds the nodes of attachments and junctions by their arc lengths: a user may have placed others.
    fn renumber(&mut self) -> Result<(), Error> {
        let node = |cables: &[Option<Box<Slot>>], cable: CableHandle, s: f64| {
            cables[cable.0 as usize].as_ref().map_or(Ok(0), |slot| slot.cable.node(s))
        };
        for a in self.attachments.iter_mut().flatten() {
            a.node = node(&self.cables, a.cable, a.arc_length)?;
        }
        for junction in self.junctions.iter_mut().flatten() {
            for ((cable, index), s) in junction.nodes.iter_mut().zip(&junction.arc_lengths) {
                *index = node(&self.cables, *cable, *s)?;
            }
        }
        Ok(())
    }

    /// Tells nodes who moves them.
    fn give_nodes(&mut self, held: &[Held]) -> Result<(), Error> {
        for h in held {
            let Some(slot) = &mut self.cables[h.cable] else { continue };
            let support = slot.cable.support(At::Node(h.node))?;
            let clamped = matches!(support.slope, SlopeSupport::Attached(_));
            match h.role {
                Role::Support => continue,
                _ if support.attached && clamped == h.direction.is_some() => {}
                _ if h.direction.is_some() => {
                    slot.cable.attach_clamped(At::Node(h.node))?;
                }
                _ => {
                    slot.cable.attach(At::Node(h.node))?;
                }
            }
            if let (Role::Integrated, Some(a)) = (h.role, &mut self.attachments[h.attachment]) {
                a.placed = None;
            }
        }
        for (cable, node) in self.junctions.iter().flatten().flat_map(|j| &j.nodes) {
            if let Some(slot) = &mut self.cables[cable.0 as usize]
                && !slot.cable.support(At::Node(*node))?.attached
            {
                slot.cable.attach(At::Node(*node))?;
            }
        }
        Ok(())
    }

    /// The cables that are connected to `first`.
    fn reach(&self, first: usize, held: &[Held], seen: &mut [bool]) -> IslandStep {
        let mut island = IslandStep { cables: vec![first], ..IslandStep::default() };
        seen[first] = true;
        let mut next = 0;
        while next < island.cables.len() {
            let cable = island.cables[next];
            next += 1;
            let bodies = held.iter().filter(|h| h.cable == cable && h.role == Role::Integrated).map(|h| h.body);
            let over_bodies = bodies
                .flat_map(|b| held.iter().filter(move |h| h.body == b && h.role == Role::Integrated).map(|h| h.cable));
            let handle = CableHandle(cable as u32);
            let tied = self.junctions.iter().flatten().filter(|j| j.nodes.iter().any(|(c, _)| *c == handle));
            let over_junctions = tied.flat_map(|j| j.nodes.iter().map(|(c, _)| c.0 as usize));
            for other in over_bodies.chain(over_junctions) {
                if !seen[other] {
                    seen[other] = true;
                    island.cables.push(other);
                }
            }
        }
        island
    }

    /// Members and pins of an island, by cable and node.
    fn pin(&self, island: &mut IslandStep, held: &[Held]) {
        let mut add = |cable: usize, node: usize, member: Member, shared: bool, held: Option<&Held>| {
            let found = island.members.iter().position(|m| shared && *m == member);
            let body = found.unwrap_or_else(|| {
                island.members.push(member);
                island.members.len() - 1
            });
            let anchor = held.map_or_else(Vector3::zeros, |h| h.anchor);
            island.pins.push(PinConstraint { cable, node, body, anchor, direction: held.and_then(|h| h.direction) });
            island.attachments.push(held.map(|h| h.attachment));
        };
        for (c, &cable) in island.cables.iter().enumerate() {
            for h in held.iter().filter(|h| h.cable == cable) {
                match h.role {
                    Role::Integrated => add(c, h.node, Member::Body(h.body), true, Some(h)),
                    Role::Driven => add(c, h.node, Member::Driven(h.body), false, Some(h)),
                    Role::Support => island.supports.push(h.attachment),
                }
            }
            for (j, junction) in self.junctions.iter().enumerate() {
                let Some(junction) = junction else { continue };
                for (_, node) in junction.nodes.iter().filter(|(c, _)| c.0 as usize == cable) {
                    add(c, *node, Member::Junction(j), true, None);
                }
            }
        }
    }
}

impl Slot {
    /// The order of two cables: by name, then by where they were first.
    fn rank(&self, other: &Slot) -> core::cmp::Ordering {
        let places = self.first.iter().zip(&other.first);
        let by_place = places.fold(core::cmp::Ordering::Equal, |o, (a, b)| o.then(a.total_cmp(b)));
        self.cable.name().cmp(other.cable.name()).then(by_place)
    }
}
