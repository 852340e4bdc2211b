//! Attaching cables to bodies and to each other, and letting go.

use crate::attachment::{Account, Attachment, AttachmentHandle, AttachmentKind};
use crate::convert::{rotation, vector};
use crate::junction::{Junction, JunctionHandle};
use crate::set::CableSet;
use crate::{CableHandle, Error};
use ::nalgebra::Vector3;
use lariat_ancf::At;
use lariat_ancf::island::PinAccount;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Vector;
use rapier::pipeline::PhysicsWorld;

impl CableSet {
    /// Holds a point of a cable to a point of a body (body axes from its origin, in m). A node is placed there if there is none. A gap
    /// closes in the next step; a clamp keeps the angle that tangent and body have now.
    ///
    /// # Errors
    /// [`Error::NoCable`], [`Error::NoBody`], [`Error::AlreadyAttached`], [`Error::AnchorNotFinite`], or [`Error::Cable`] for a
    /// point that is not on the cable.
    pub fn attach(
        &mut self,
        world: &PhysicsWorld,
        cable: CableHandle,
        at: impl Into<At>,
        body: RigidBodyHandle,
        anchor: Vector,
        pin: AttachmentKind,
    ) -> Result<AttachmentHandle, Error> {
        let rigid = world.bodies.get(body).ok_or(Error::NoBody(body))?;
        let anchor = vector(anchor);
        if !anchor.iter().all(|x| x.is_finite()) {
            return Err(Error::AnchorNotFinite { body, anchor });
        }
        let node = self.free_node(cable, at.into())?;
        let held = self.get_mut(cable)?;
        let arc_length = held.node_arc_lengths()[node];
        let direction = match pin {
            AttachmentKind::Ball => {
                held.attach(At::Node(node))?;
                None
            }
            AttachmentKind::Clamp => {
                held.attach_clamped(At::Node(node))?;
                let slope = Vector3::from_column_slice(&held.positions()[6 * node + 3..6 * node + 6]);
                Some(rotation(*rigid.rotation()).inverse() * slope.normalize())
            }
        };
        self.attachments.push(Some(Attachment {
            cable,
            node,
            arc_length,
            body,
            anchor,
            direction,
            ledger: None,
            placed: None,
            account: Account::default(),
            steady: Vector3::zeros(),
            passed: PinAccount::default(),
        }));
        self.stale = true;
        Ok(AttachmentHandle(self.attachments.len() as u32 - 1))
    }

    /// [`attach`](Self::attach) to the point of the body where the point of the cable is now.
    ///
    /// # Errors
    /// As [`attach`](Self::attach).
    pub fn attach_here(
        &mut self,
        world: &PhysicsWorld,
        cable: CableHandle,
        at: impl Into<At>,
        body: RigidBodyHandle,
        pin: AttachmentKind,
    ) -> Result<AttachmentHandle, Error> {
        let at = at.into();
        let rigid = world.bodies.get(body).ok_or(Error::NoBody(body))?;
        let held = self.get(cable)?;
        let place = held.sample(held.arc_length(at)?)?.position;
        let local = rotation(*rigid.rotation()).inverse() * (place - vector(rigid.translation()));
        let handle = self.attach(world, cable, at, body, Vector::ZERO, pin)?;
        if let Some(attachment) = &mut self.attachments[handle.0 as usize] {
            attachment.anchor = local;
        }
        Ok(handle)
    }

    /// Ends an attachment; the node is free.
    ///
    /// # Errors
    /// [`Error::NoAttachment`].
    pub fn detach(&mut self, world: &mut PhysicsWorld, attachment: AttachmentHandle) -> Result<(), Error> {
        let Attachment { cable, node, .. } = *self.attachment(attachment)?;
        self.get(cable)?;
        self.end(world, attachment)?;
        self.get_mut(cable)?.detach(At::Node(node))?;
        Ok(())
    }

    /// Ends an attachment on the side of its body.
    pub(crate) fn end(&mut self, world: &mut PhysicsWorld, attachment: AttachmentHandle) -> Result<(), Error> {
        let slot = self.attachments.get_mut(attachment.0 as usize);
        let ended = slot.and_then(Option::take).ok_or(Error::NoAttachment(attachment))?;
        self.stale = true;
        if let Some(ledger) = ended.ledger {
            world.remove_body(ledger.body);
        }
        // what was learnt of the body was learnt with this cable
        let remembered = self.remember(ended.body);
        (remembered.force, remembered.torque) = (Vector3::zeros(), Vector3::zeros());
        if world.bodies.contains(ended.body) {
            world.islands.wake_up(&mut world.bodies, ended.body, true);
        }
        Ok(())
    }

    /// Cuts a cable at a point between its ends: `cable` keeps what is before it, the handle is that of the rest. Attachments and
    /// junctions go with their part, those at the cut stay with `cable`.
    ///
    /// # Errors
    /// [`Error::NoCable`], or [`Error::Cable`] for a point that is not between the ends.
    pub fn cut(&mut self, cable: CableHandle, at: impl Into<At>) -> Result<CableHandle, Error> {
        let held = self.get_mut(cable)?;
        let rest = held.cut(at)?;
        let s = held.length();
        let falls = self.cables[cable.0 as usize].as_ref().is_some_and(|slot| slot.falls);
        let tail = self.insert(rest);
        if let Some(slot) = &mut self.cables[tail.0 as usize] {
            slot.falls = falls;
        }
        let beyond = |at: f64| at > s * (1.0 + 1e-9);
        for a in self.attachments.iter_mut().flatten().filter(|a| a.cable == cable && beyond(a.arc_length)) {
            (a.cable, a.arc_length) = (tail, a.arc_length - s);
        }
        for junction in self.junctions.iter_mut().flatten() {
            for ((of, _), at) in junction.nodes.iter_mut().zip(&mut junction.arc_lengths) {
                if *of == cable && beyond(*at) {
                    (*of, *at) = (tail, *at - s);
                }
            }
        }
        Ok(tail)
    }

    /// Ties a point of a cable to a point of another, or of itself: they share one position, like a shackle without mass. Nodes are placed
    /// there if there are none; a gap closes in the next step. A point that is tied already takes the other into its junction.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::AlreadyAttached`] for a node that holds to a body, or both to junctions; [`Error::Cable`] for a
    /// point that is not on its cable.
    pub fn join(
        &mut self,
        (first, at_first): (CableHandle, At),
        (second, at_second): (CableHandle, At),
    ) -> Result<JunctionHandle, Error> {
        // arc lengths do not move when nodes are inserted
        let lengths = [self.get(first)?.arc_length(at_first)?, self.get(second)?.arc_length(at_second)?];
        let [at_first, at_second] = lengths.map(At::ArcLength);
        let tied = |set: &Self, cable: CableHandle, at: At| {
            let node = set.get(cable).ok()?.node(at).ok()?;
            set.junctions.iter().position(|j| j.as_ref().is_some_and(|j| j.nodes.contains(&(cable, node))))
        };
        let existing = tied(self, first, at_first);
        if existing.is_none() && tied(self, second, at_second).is_some() {
            return self.join((second, at_second), (first, at_first));
        }
        let index = match existing {
            Some(index) => index,
            None => {
                let node = self.free_node(first, at_first)?;
                self.get_mut(first)?.attach(At::Node(node))?;
                self.junctions.push(Some(Junction {
                    nodes: vec![(first, node)],
                    arc_lengths: vec![lengths[0]],
                    memory: None,
                }));
                self.junctions.len() - 1
            }
        };
        self.stale = true;
        let joined = self.free_node(second, at_second).and_then(|node| {
            self.get_mut(second)?.attach(At::Node(node))?;
            Ok(node)
        });
        match joined {
            Ok(node) => {
                let junction = self.junctions[index].as_mut().expect("found or made above");
                junction.nodes.push((second, node));
                junction.arc_lengths.push(lengths[1]);
                junction.memory = None;
                Ok(JunctionHandle(index as u32))
            }
            Err(error) => {
                if existing.is_none() {
                    let junction = self.junctions.pop().flatten().expect("made above");
                    self.get_mut(first)?.detach(At::Node(junction.nodes[0].1))?;
                }
                Err(error)
            }
        }
    }

    /// Unties a cable from a junction; one that is left with a single node ends.
    ///
    /// # Errors
    /// [`Error::NoJunction`]; [`Error::NoCable`] for one that is not in it.
    pub fn leave(&mut self, junction: JunctionHandle, cable: CableHandle) -> Result<(), Error> {
        let tied = self.junction(junction)?.clone();
        if !tied.nodes.iter().any(|(c, _)| *c == cable) {
            return Err(Error::NoCable(cable));
        }
        self.stale = true;
        // all of it wakes
        for (other, _) in &tied.nodes {
            self.get_mut(*other)?;
        }
        let of = |own: bool| tied.nodes.iter().zip(&tied.arc_lengths).filter(move |((c, _), _)| (*c == cable) == own);
        let mut left: Vec<(CableHandle, usize)> = of(true).map(|(n, _)| *n).collect();
        let nodes: Vec<(CableHandle, usize)> = of(false).map(|(n, _)| *n).collect();
        let arc_lengths = of(false).map(|(_, s)| *s).collect();
        self.junctions[junction.0 as usize] = if nodes.len() < 2 {
            left.extend(nodes);
            None
        } else {
            Some(Junction { nodes, arc_lengths, memory: None })
        };
        for (cable, node) in left {
            self.get_mut(cable)?.detach(At::Node(node))?;
        }
        Ok(())
    }

    /// The node at a point, placed there if there is none; it must not hold to anything yet.
    fn free_node(&mut self, cable: CableHandle, at: At) -> Result<usize, Error> {
        let before = self.get(cable)?.nodes();
        let held = self.get_mut(cable)?;
        let node = held.insert_node(at)?;
        let name = held.name().to_string();
        if self.get(cable)?.nodes() > before {
            let behind = |(c, n): (CableHandle, &mut usize)| {
                if c == cable && *n >= node {
                    *n += 1;
                }
            };
            self.attachments.iter_mut().flatten().map(|a| (a.cable, &mut a.node)).for_each(behind);
            self.junctions.iter_mut().flatten().flat_map(|j| &mut j.nodes).map(|(c, n)| (*c, n)).for_each(behind);
            self.stale = true;
        }
        let attached = self.attachments().any(|(_, a)| a.cable == cable && a.node == node);
        let tied = self.junctions.iter().flatten().any(|j| j.nodes.contains(&(cable, node)));
        if attached || tied { Err(Error::AlreadyAttached { cable: name, node }) } else { Ok(node) }
    }
}
