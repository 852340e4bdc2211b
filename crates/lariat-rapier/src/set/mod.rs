//! The set of cables of a world: the interface of this crate.
//!
//! | file | calls of [`CableSet`] |
//! |---|---|
//! | this one | making a set, adding, changing and removing cables, statics |
//! | [`attach`] | attachments and junctions |
//! | [`slack`] | slack cables beside the bodies that they are tied to |
//! | [`contact`] | what cables may touch |
//! | [`reel`] | drums and sheaves |
//! | [`step`] | host steps |
//! | [`water`] | the water that bodies are in |
//! | [`read`] | events, totals and warnings |
//!
//! [`rope`] describes the usual rope, which [`CableSet::add_rope`] makes.

mod attach;
mod contact;
mod read;
mod reel;
pub(crate) mod rope;
mod slack;
mod step;
mod water;

use crate::contents::Contents;
use crate::contents::attachment::AttachmentKind;
use crate::edit::{self, world_mark};
use crate::error::Error;
use crate::handle::CableHandle;
use crate::statics::{self, BodyForce, Equilibrium};
use crate::step::Stepper;
use crate::step::settings::Settings;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::warning::Interface;
use lariat_ancf::{At, Cable, EquilibriumOptions, EquilibriumReport, Strength};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;
use rope::{Rope, RopeEnd, RopeHandles};
use serde::{Deserialize, Serialize};

/// The cables of a world, attached to its bodies and to each other.
///
/// # Limits
/// - Cables touch colliders and each other only if they are told to
///   ([`set_contact`](Self::set_contact)).
/// - A cable has a fixed natural length, but for [`cut`](Self::cut) and a reel
///   ([`Cable::add_reel`](lariat_ancf::Cable::add_reel) by [`get_mut`](Self::get_mut)). On a
///   dynamic body its stock rides along as a point mass at the eye, beside the mass that Rapier
///   knows: contacts of the body see that alone.
/// - All cables of a set share one number of Rapier steps per host step ([`Settings`]), which is
///   also that of the whole world: a pile of bodies costs as many Rapier steps as the cables need.
/// - The loads on the bodies of a mechanism (a multibody, or bodies joined by impulse joints) are
///   predicted only if none of those without a cable is near a body from outside. Otherwise they
///   are estimated from step to step; on chains of impulse joints forces may ripple by some per
///   cent then. Chains of impulse joints count up to 24 bodies.
/// - Cables that cannot step stand still with the bodies attached to them, and block others that
///   touch them; all else goes on.
///
/// # Snapshots
/// A set serialises with all of its state; a snapshot of (world, set) replays to the bit. JSON
/// needs `serde_json` with its feature `float_roundtrip`, without which numbers change in their
/// last digit. A [seal](lariat_ancf::seal) around the bytes refuses damaged ones, and those of
/// another version.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct CableSet {
    /// How the set steps.
    pub settings: Settings,
    pub(crate) contents: Contents,
    #[serde(skip)]
    pub(crate) stepper: Stepper,
    /// Whose names the log has.
    #[serde(skip)]
    pub(crate) interface: Interface,
}

impl CableSet {
    /// Returns an empty set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Lets the log name what a user sets as this interface does, for those who wrap the set.
    /// Default and after loading: Rust.
    pub fn set_interface(&mut self, interface: Interface) {
        self.interface = interface;
    }

    /// Adds a cable; its clock is set to that of the others. If its gravity is the builder's
    /// default, it follows the world's until the user sets it; else it keeps its own. If nobody
    /// chose its integrator, it takes that of [`Settings::fidelity`]; its [rule](Cable::rule)
    /// stays, so a cable for which [`Fidelity::Game`](lariat_ancf::Fidelity::Game) is written when
    /// it is built costs less.
    pub fn insert(&mut self, mut cable: Cable) -> CableHandle {
        if cable.has_default_integrator() {
            // the integrator of a fidelity fits every cable, but one with contact keeps the one
            // that can step it
            let _ = cable.set_integrator(cable.integrator_for(self.settings.fidelity));
        }
        if self.settings.watch && !cable.is_watched() {
            cable.set_watched(true);
        }
        self.contents.insert(cable)
    }

    /// Adds the usual rope between two points of the world, held there by bodies or by the world:
    /// it is straight, or sags by its slack.
    ///
    /// ```
    /// use lariat_rapier::{CableSet, Rope};
    /// use rapier::prelude::*;
    ///
    /// let mut world = PhysicsWorld::new();
    /// let cube = ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0);
    /// let (load, _) = world.insert(RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -2.1, 0.0)), cube);
    /// let mut cables = CableSet::new();
    /// // a steel rope of 8 mm that breaks at 20 kN; `.slack(0.05)` makes it 5 % longer
    /// let rope = Rope::steel(0.008).strength(20e3);
    /// let rope = cables.add_rope(&world, [0.0, 0.0, 0.0], (load, [0.0, -2.0, 0.0]), rope)?;
    /// for _ in 0..300 {
    ///     cables.step(&mut world)?;
    /// }
    /// assert!((world.bodies[load].translation().y + 2.1).abs() < 0.01);
    /// # Ok::<(), lariat_rapier::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoBody`]; [`Error::OtherWorld`]; [`Error::Cable`] for two ends at one point, or a
    /// section or slack that is not possible.
    pub fn add_rope(
        &mut self,
        world: &PhysicsWorld,
        from: impl Into<RopeEnd<RigidBodyHandle>>,
        to: impl Into<RopeEnd<RigidBodyHandle>>,
        rope: Rope,
    ) -> Result<RopeHandles, Error> {
        let ends = [from.into(), to.into()];
        for body in ends.iter().filter_map(|end| end.body) {
            if !world_mark::is_own(&self.contents, world) {
                return Err(Error::OtherWorld);
            }
            world.bodies.get(body).ok_or(Error::NoBody(body))?;
        }
        let cable = self.insert(rope.build(&ends, self.settings.fidelity)?);
        let mut attach = |at, end: &RopeEnd<RigidBodyHandle>| {
            end.body.map(|body| self.attach_here(world, cable, at, body, AttachmentKind::Ball)).transpose()
        };
        // the bodies exist and the ends are free: neither fails
        let (start, end) = (attach(At::Start, &ends[0])?, attach(At::End, &ends[1])?);
        Ok(RopeHandles { cable, start, end })
    }

    /// Sets what a cable withstands: a [`Strength`] or a tension in N, compared with the load after
    /// each integration step, at whose end it breaks; `None` and it does not break. It breaks at
    /// the inner node nearest to its largest load, and the host step goes on with the parts, in
    /// another Rapier step: where
    /// [`Settings::max_rapier_steps`](crate::Settings::max_rapier_steps) allows no more of them, it
    /// breaks at the end of the last. The event is
    /// [`Event::Broken`](crate::Event::Broken); the parts have the same strength. A sleeping cable
    /// sleeps on unless it breaks.
    ///
    /// # Errors
    /// [`Error::NoCable`], or [`Error::Cable`] for a limit that is not positive or a cable of one
    /// element.
    pub fn set_strength(&mut self, cable: CableHandle, strength: impl Into<Strength>) -> Result<(), Error> {
        let slot = self.contents.cables.get_mut(cable.0 as usize).ok_or(Error::NoCable(cable))?;
        let before = slot.cable.strength();
        slot.cable.set_strength(strength)?;
        slot.compared &= slot.cable.strength() == before;
        Ok(())
    }

    /// Removes a cable with its attachments, and takes it out of its junctions.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn remove(&mut self, world: &mut PhysicsWorld, cable: CableHandle) -> Result<Cable, Error> {
        edit::remove::remove(&mut self.contents, world, cable)
    }

    /// Cuts a cable at a point between its ends; `cable` keeps the part before it. Returns the
    /// handle of the other part. Attachments and junctions go with their part; those at the cut
    /// stay with `cable`. The event is [`Event::Broken`](crate::Event::Broken).
    ///
    /// # Errors
    /// [`Error::NoCable`], or [`Error::Cable`] for a point that is not between the ends.
    pub fn cut(&mut self, cable: CableHandle, at: impl Into<At>) -> Result<CableHandle, Error> {
        let cut = |cable: &mut Cable| cable.break_at(at).map(Some);
        edit::part::part(&mut self.contents, cable, cut, &mut self.stepper.events)?.ok_or(Error::NoCable(cable))
    }

    /// Returns a cable.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn get(&self, cable: CableHandle) -> Result<&Cable, Error> {
        self.contents.cable(cable)
    }

    /// Returns a cable, to change it; a sleeping one wakes up.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn get_mut(&mut self, cable: CableHandle) -> Result<&mut Cable, Error> {
        self.contents.cable_mut(cable)
    }

    /// Returns all cables.
    pub fn iter(&self) -> impl Iterator<Item = (CableHandle, &Cable)> {
        self.contents.cables.iter().map(|(i, slot)| (CableHandle(i as u32), &slot.cable))
    }

    /// Returns whether a cable is asleep with the bodies attached to it.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn is_asleep(&self, cable: CableHandle) -> Result<bool, Error> {
        self.contents.slot(cable).map(|slot| slot.asleep).ok_or(Error::NoCable(cable))
    }

    /// Moves all cables, and the dynamic bodies attached to them, to static equilibrium under
    /// gravity, loads and the users' forces; velocities become zero, readings of attachments are
    /// those at rest. Returns what was moved, what was held, and what nothing is attached to.
    /// Bodies that joints connect to those of cables move with them, and over sheaves runs what the
    /// pulls ask for. Cables with contact lie, without friction, on the colliders of bodies that
    /// stay where they are: fixed and kinematic ones, and dynamic ones that no cable is attached
    /// to. Where bodies of cables touch others, or would fall on them, or cables touch each other,
    /// themselves or bodies that they move, all of the world comes to rest by its motion instead,
    /// from where it is, with friction: [`Equilibrium::relaxed`](crate::Equilibrium::relaxed).
    /// Slack that lies in a body that it is tied to is turned out of it first, as before a step.
    ///
    /// # Errors
    /// [`Error::Cable`] with [`NoEquilibrium`](lariat_ancf::Error::NoEquilibrium) if an island has
    /// none; [`Error::NotHeldInStatics`] for bodies that nothing holds, and that come to rest on
    /// nothing; [`Error::JointInStatics`] for joints that drive or are springs;
    /// [`Error::ContactInStatics`], [`Error::CablesPassInStatics`],
    /// [`Error::CablePassesBodyInStatics`] or [`Error::MovesInStatics`] for a world with contact
    /// that does not come to rest in 30 s, or in which something changes with time;
    /// [`Error::CableTouchesInStatics`] for a cable with contact that would run through a collider;
    /// [`Error::OtherWorld`]. Set and world are then as before, but for such slack.
    pub fn equilibrium(&mut self, world: &mut PhysicsWorld) -> Result<Equilibrium, Error> {
        self.equilibrium_under(world, &[])
    }

    /// Moves cables and bodies to static equilibrium as [`equilibrium`](Self::equilibrium) does,
    /// under further forces that keep their direction and act at points of bodies, whose torque
    /// turns with the body. Forces that Rapier's bodies have are constant, with their torque. A run
    /// that is to stay there must apply the further forces itself.
    ///
    /// # Errors
    /// As [`equilibrium`](Self::equilibrium); [`Error::Cable`] for numbers that are not finite.
    pub fn equilibrium_under(&mut self, world: &mut PhysicsWorld, forces: &[BodyForce]) -> Result<Equilibrium, Error> {
        self.equilibrium_from(world, forces, &[])
    }

    /// Moves cables and bodies to static equilibrium as
    /// [`equilibrium_under`](Self::equilibrium_under) does, of cables that were `drawn` otherwise
    /// than they are now: that is the side on which they must be found of what they touch.
    ///
    /// # Errors
    /// As [`equilibrium_under`](Self::equilibrium_under).
    pub fn equilibrium_from(
        &mut self,
        world: &mut PhysicsWorld,
        forces: &[BodyForce],
        drawn: &[(CableHandle, Cable)],
    ) -> Result<Equilibrium, Error> {
        world_mark::check(&mut self.contents, world)?;
        slack::draw_all_outside(&mut self.contents, world)?;
        let own = |(handle, cable): &(CableHandle, Cable)| {
            let turned = slack::outside(&self.contents, world, (*handle, cable));
            (*handle, turned.unwrap_or_else(|| cable.clone()))
        };
        let drawn: Vec<_> = drawn.iter().map(own).collect();
        let options = EquilibriumOptions::default();
        statics::equilibrium(&mut self.contents, &mut self.stepper.finder, world, (forces, &drawn), options)
    }

    /// Looks whether cables are on the side of what they touch on which they were `drawn`: after
    /// each was moved to equilibrium by itself.
    ///
    /// # Errors
    /// [`Error::CablesPassInStatics`].
    pub fn check_drawn(&self, world: &PhysicsWorld, drawn: &[(CableHandle, Cable)]) -> Result<(), Error> {
        statics::check_drawn(&self.contents, &self.stepper.finder, world, drawn)
    }

    /// Moves a cable that is not in the set to static equilibrium, at its supports, before it is
    /// inserted and attached: with contact it lies on all colliders of the world, as they stand,
    /// without friction.
    ///
    /// # Errors
    /// [`Error::Cable`] as [`Cable::equilibrium`]; [`Error::CableTouchesInStatics`] if it would run
    /// through a collider.
    pub fn equilibrium_among(&mut self, world: &PhysicsWorld, cable: &mut Cable) -> Result<EquilibriumReport, Error> {
        statics::among(&mut self.stepper.finder, world, cable)
    }
}
