//! Finds the islands of a set.

use super::island::Island;
use super::member::Member;
use super::wheels::Wheels;
use crate::body::is_integrated;
use crate::body::proximity;
use crate::contents::attachment::Attachment;
use crate::contents::table::Table;
use crate::contents::{Contents, Slot};
use crate::convert::vector;
use crate::error::Error;
use crate::handle::CableHandle;
use crate::mechanism;
use ::nalgebra::Vector3;
use lariat_ancf::contact::CablePair;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::PinConstraint;
use lariat_ancf::{At, SlopeSupport};
use rapier::dynamics::{RigidBodyHandle, RigidBodyType};
use rapier::math::AngVector;
use rapier::pipeline::PhysicsWorld;

/// How the body of an attachment takes part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// It is integrated together with the cable.
    Integrated,
    /// Its motion is prescribed, and rotates: the node and the tangent of a clamp are moved as
    /// those of an integrated body, along the arc.
    Driven,
    /// Its motion is prescribed: so is the position of the node.
    Support,
}

/// An attachment as it was when the islands were found.
#[derive(Clone, Copy, Debug, PartialEq)]
struct AttachedNode {
    attachment: usize,
    cable: usize,
    node: usize,
    body: RigidBodyHandle,
    role: Role,
    /// Anchor from the body's centre of mass, or from its origin if it is not integrated.
    anchor: Vector3<f64>,
    direction: Option<Vector3<f64>>,
}

/// What connects cables, beside junctions and wheels.
#[derive(Clone, Copy)]
struct Links<'a> {
    nodes: &'a [AttachedNode],
    touching: &'a [(usize, RigidBodyHandle)],
    /// Bodies of mechanisms, each with the first of its mechanism.
    jointed: &'a [[RigidBodyHandle; 2]],
    pairs: &'a [CablePair],
}

/// All islands of a set.
#[derive(Clone, Debug, Default)]
pub(crate) struct Islands {
    pub list: Vec<Island>,
    /// The attachments that they were found with.
    nodes: Vec<AttachedNode>,
    /// A buffer: the attachments as they are now.
    found: Vec<AttachedNode>,
    /// Cables and the integrated bodies that they can touch.
    touching: Vec<(usize, RigidBodyHandle)>,
    /// Cables that can touch each other.
    pairs: Vec<CablePair>,
    /// Bodies of mechanisms that several cables act on, each with the first of its mechanism.
    jointed: Vec<[RigidBodyHandle; 2]>,
}

impl Islands {
    /// Finds the islands of a set, unless nothing changed since they were last found; `touching`
    /// are cables and the integrated bodies that they can touch, `pairs` cables that can touch each
    /// other.
    pub fn update(
        &mut self,
        contents: &mut Contents,
        world: &PhysicsWorld,
        touching: &[(usize, RigidBodyHandle)],
        pairs: &[CablePair],
    ) -> Result<(), Error> {
        mark_rotating(contents, world);
        self.found.clear();
        self.found.extend(attached_nodes(contents, world));
        let jointed = jointed_bodies(world, &self.found, touching);
        let unchanged =
            self.found == self.nodes && self.touching == touching && self.pairs == pairs && self.jointed == jointed;
        let modified = contents.cables.values().any(|slot| slot.modified);
        if unchanged && !modified && !contents.changed && !self.list.is_empty() {
            return Ok(());
        }
        contents.changed = false;
        renumber(contents)?;
        self.nodes.clear();
        self.nodes.extend(attached_nodes(contents, world));
        self.touching.clear();
        self.touching.extend_from_slice(touching);
        self.pairs.clear();
        self.pairs.extend_from_slice(pairs);
        self.jointed = jointed;
        let mut order: Vec<(usize, &Slot)> = contents.cables.iter().collect();
        order.sort_by(|(a, one), (b, two)| one.order(two).then(a.cmp(b)));
        let order: Vec<usize> = order.into_iter().map(|(c, _)| c).collect();
        let mut ranks = vec![usize::MAX; contents.cables.len()];
        order.iter().enumerate().for_each(|(rank, &cable)| ranks[cable] = rank);
        let rank = |cable: usize| ranks.get(cable);
        let mut nodes = self.nodes.clone();
        nodes.sort_by_key(|n| (rank(n.cable), n.node));
        set_supports(contents, &nodes)?;
        let links = Links { nodes: &nodes, touching, jointed: &self.jointed, pairs };
        let mut seen = vec![false; contents.cables.len()];
        self.list.clear();
        for &first in &order {
            if !seen[first] {
                let mut cables = connected(contents, first, links, &mut seen);
                cables.sort_by_key(|&c| rank(c));
                self.list.push(connect(contents, cables, links));
            }
        }
        Ok(())
    }
}

/// Returns all attachments as they are now.
fn attached_nodes(contents: &Contents, world: &PhysicsWorld) -> impl Iterator<Item = AttachedNode> {
    contents.attachments.iter().map(|(i, a)| attached_node(contents, world, i, a))
}

/// Returns the integrated bodies that share a mechanism with one before them, each with the first
/// of it.
fn jointed_bodies(
    world: &PhysicsWorld,
    nodes: &[AttachedNode],
    touching: &[(usize, RigidBodyHandle)],
) -> Vec<[RigidBodyHandle; 2]> {
    let (mut first, mut jointed): (Vec<(RigidBodyHandle, Vec<RigidBodyHandle>)>, _) = (Vec::new(), Vec::new());
    let attached = nodes.iter().filter(|n| n.role == Role::Integrated).map(|n| n.body);
    for body in attached.chain(touching.iter().map(|(_, body)| *body)).filter(|b| !proximity::is_unjointed(world, *b)) {
        match first.iter().find(|(_, bodies)| bodies.contains(&body)) {
            Some((known, _)) if *known != body => jointed.push([body, *known]),
            Some(_) => {}
            None => first.push((body, mechanism::bodies(world, body))),
        }
    }
    jointed
}

/// Remembers which kinematic bodies with attachments rotate.
fn mark_rotating(contents: &mut Contents, world: &PhysicsWorld) {
    for a in contents.attachments.values() {
        let Some(body) = world.bodies.get(a.body).filter(|body| body.is_enabled()) else { continue };
        let rotates = match body.body_type() {
            RigidBodyType::KinematicPositionBased => body.next_position().rotation != body.position().rotation,
            RigidBodyType::KinematicVelocityBased => body.angvel() != AngVector::default(),
            _ => false,
        };
        if rotates {
            contents.records.record_mut(a.body).rotates = true;
        }
    }
}

fn attached_node(contents: &Contents, world: &PhysicsWorld, attachment: usize, a: &Attachment) -> AttachedNode {
    let rotates = || contents.records.get(a.body).is_some_and(|record| record.rotates);
    let role = if is_integrated(world, a.body) {
        Role::Integrated
    } else if a.direction.is_some() || rotates() {
        Role::Driven
    } else {
        Role::Support
    };
    let centre =
        if role == Role::Integrated { vector(world.bodies[a.body].local_center_of_mass()) } else { Vector3::zeros() };
    let (cable, node, body) = (a.cable.0 as usize, a.node, a.body);
    AttachedNode { attachment, cable, node, body, role, anchor: a.anchor - centre, direction: a.direction }
}

/// Finds the nodes of attachments and junctions by their arc lengths, since the user may have
/// inserted others.
fn renumber(contents: &mut Contents) -> Result<(), Error> {
    let node = |cables: &Table<Slot>, cable: CableHandle, s: f64| {
        cables.get(cable.0 as usize).map_or(Ok(0), |slot| slot.cable.node(s))
    };
    for a in contents.attachments.values_mut() {
        a.node = node(&contents.cables, a.cable, a.arc_length)?;
    }
    for junction in contents.junctions.values_mut() {
        for ((cable, index), s) in junction.nodes.iter_mut().zip(&junction.arc_lengths) {
            *index = node(&contents.cables, *cable, *s)?;
        }
    }
    Ok(())
}

/// Tells the cables which of their nodes are moved by an island, and with what.
fn set_supports(contents: &mut Contents, nodes: &[AttachedNode]) -> Result<(), Error> {
    for n in nodes.iter().filter(|n| n.role != Role::Support) {
        let Some(slot) = contents.cables.get_mut(n.cable) else { continue };
        let support = slot.cable.support(At::Node(n.node))?;
        let clamped = matches!(support.slope, SlopeSupport::Attached(_));
        if !support.attached || clamped != n.direction.is_some() {
            if n.direction.is_some() {
                slot.cable.attach_clamped(At::Node(n.node), None)?;
            } else {
                slot.cable.attach(At::Node(n.node))?;
            }
        }
        if let (Role::Integrated, Some(a)) = (n.role, contents.attachments.get_mut(n.attachment)) {
            a.last_anchor = None;
        }
    }
    for (cable, node) in contents.junctions.values().flat_map(|j| &j.nodes) {
        if let Some(slot) = contents.cables.get_mut(cable.0 as usize)
            && !slot.cable.support(At::Node(*node))?.attached
        {
            slot.cable.attach(At::Node(*node))?;
        }
    }
    Ok(())
}

/// Returns the cables that are connected to `first`, and marks them as seen.
fn connected(
    contents: &Contents,
    first: usize,
    Links { nodes, touching, jointed, pairs }: Links<'_>,
    seen: &mut [bool],
) -> Vec<usize> {
    let mut cables = vec![first];
    seen[first] = true;
    let mut next = 0;
    while next < cables.len() {
        let cable = cables[next];
        next += 1;
        let pinned = || nodes.iter().filter(|n| n.role == Role::Integrated).map(|n| (n.cable, n.body));
        let wound = || contents.wheels.bodies().map(|(cable, body)| (cable.0 as usize, body));
        let first = |body: RigidBodyHandle| jointed.iter().find(|[b, _]| *b == body).map_or(body, |[_, first]| *first);
        let integrated = || pinned().chain(wound()).chain(touching.iter().copied()).map(|(c, body)| (c, first(body)));
        let bodies = integrated().filter(|(c, _)| *c == cable).map(|(_, body)| body);
        let over_bodies = bodies.flat_map(|b| integrated().filter(move |(_, body)| *body == b).map(|(c, _)| c));
        let handle = CableHandle(cable as u32);
        let tied = contents.junctions.values().filter(|j| j.nodes.iter().any(|(c, _)| *c == handle));
        let over_junctions = tied.flat_map(|j| j.nodes.iter().map(|(c, _)| c.0 as usize));
        let over_wheels = contents.wheels.beside(handle).map(|c| c.0 as usize);
        let met = pairs.iter().filter(|pair| pair.cables.contains(&cable)).flat_map(|pair| pair.cables);
        for other in over_bodies.chain(over_junctions).chain(over_wheels).chain(met) {
            if !seen[other] {
                seen[other] = true;
                cables.push(other);
            }
        }
    }
    cables
}

/// Returns the island of `cables`, its members and pins in the order of cables and nodes.
fn connect(contents: &Contents, cables: Vec<usize>, Links { nodes, touching, pairs, .. }: Links<'_>) -> Island {
    let place = |cable: usize| cables.iter().position(|&c| c == cable);
    let within = pairs.iter().filter_map(|pair| {
        let [Some(a), Some(b)] = pair.cables.map(place) else { return None };
        Some(CablePair { cables: [a.min(b), a.max(b)], ..*pair })
    });
    let pairs = within.collect();
    let mut island = Island { cables, pairs, ..Island::default() };
    let mut add = |cable: usize, node: usize, member: Member, attached: Option<&AttachedNode>| {
        // each attachment to a body with prescribed motion has a member of its own
        let shared = !matches!(member, Member::Driven(_));
        let found = island.members.iter().position(|m| shared && *m == member);
        let body = found.unwrap_or_else(|| {
            island.members.push(member);
            island.members.len() - 1
        });
        let anchor = attached.map_or_else(Vector3::zeros, |n| n.anchor);
        island.pins.push(PinConstraint { cable, node, body, anchor, direction: attached.and_then(|n| n.direction) });
        island.attachments.push(attached.map(|n| n.attachment));
    };
    for (c, &cable) in island.cables.iter().enumerate() {
        for n in nodes.iter().filter(|n| n.cable == cable) {
            match n.role {
                Role::Integrated => add(c, n.node, Member::Body(n.body), Some(n)),
                Role::Driven => add(c, n.node, Member::Driven(n.body), Some(n)),
                Role::Support => island.supports.push(n.attachment),
            }
        }
        for (j, junction) in contents.junctions.iter() {
            for (_, node) in junction.nodes.iter().filter(|(c, _)| c.0 as usize == cable) {
                add(c, *node, Member::Junction(j), None);
            }
        }
    }
    for &cable in &island.cables {
        for (_, body) in touching.iter().filter(|(c, _)| *c == cable) {
            let member = Member::Body(*body);
            if !island.members.contains(&member) {
                island.members.push(member);
            }
        }
    }
    island.wheels = Wheels::of(contents, &island.cables, &mut island.members);
    island
}
