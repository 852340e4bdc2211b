//! Sheaves along one cable: it runs over them and stays one cable for who counts along it; between
//! them it is computed in parts.

use crate::contents::reel::sheave::{Sheave, SheaveOptions};
use crate::convert::vector;
use crate::edit::reel::passing;
use crate::error::Error;
use crate::handle::{CableHandle, SheaveHandle};
use crate::set::CableSet;
use lariat_ancf::At;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Vector;
use rapier::pipeline::PhysicsWorld;

impl CableSet {
    /// Lets a cable run over a sheave at a point between its ends: an eye at `anchor` of a body, in
    /// its axes, within 1 mm of that point. Behind it the cable goes on in a part with a handle of
    /// its own, the second of [`Sheave::ends`](crate::Sheave::ends); all parts in order are
    /// [`parts`](Self::parts). An arc length in `at` counts along all of them, so several sheaves
    /// may be put along one cable; a node is one of `cable`. Attachments, junctions and loads stay
    /// with their material, and stop the cable before they come to the sheave. A cable that is
    /// drawn around a corner there needs a node at it
    /// ([`CableBuilder::node_at`](lariat_ancf::CableBuilder::node_at)); both parts start with the
    /// slopes of their own sides, so that even a fold holds no energy, unless the cable has moved
    /// since. Needs the integrator `discrete-gradient`. The sheave ends as one between [two
    /// cables](Self::add_sheave) does, which the parts are then.
    ///
    /// # Errors
    /// Nothing changes. [`Error::OtherWorld`], [`Error::NoCable`], [`Error::NoBody`],
    /// [`Error::AnchorNotFinite`]; [`Error::GapTooLong`]; [`Error::AlreadyAttached`] for a point
    /// that an attachment or a junction holds; [`Error::Cable`] for one that is not between the
    /// ends, or on the element at a reel, and for a cable that cannot run over a sheave. What makes
    /// no sheave beyond that is an error of the next step.
    pub fn add_sheave_at(
        &mut self,
        world: &PhysicsWorld,
        (cable, at): (CableHandle, impl Into<At>),
        (body, anchor): (RigidBodyHandle, Vector),
        options: SheaveOptions,
    ) -> Result<SheaveHandle, Error> {
        let (cable, at) = match at.into() {
            At::ArcLength(s) => self.part_at(cable, s).map(|(part, s)| (part, At::ArcLength(s)))?,
            at => (cable, at),
        };
        passing::add(&mut self.contents, world, (cable, at), (body, vector(anchor)), options)
    }

    /// Returns the parts of a cable that runs over [sheaves along it](Self::add_sheave_at), from
    /// start to end; the cable alone if it runs over none.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn parts(&self, cable: CableHandle) -> Result<Vec<CableHandle>, Error> {
        self.contents.cable(cable)?;
        let beside = |cable: CableHandle, side: usize| {
            let there = |sheave: &&Sheave| sheave.along.is_some() && sheave.ends[side] == (cable, side == 1);
            self.contents.wheels.sheaves.values().find(there).map(|sheave| sheave.ends[1 - side].0)
        };
        let mut first = cable;
        while let Some(before) = beside(first, 1) {
            first = before;
        }
        Ok(core::iter::successors(Some(first), |&part| beside(part, 0)).collect())
    }

    /// Returns the part of a cable at an arc length in m, which counts along [all its
    /// parts](Self::parts) as they are now, and the arc length on it. A sheave belongs to the part
    /// before it; what is beyond all is on the last one.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn part_at(&self, cable: CableHandle, arc_length: f64) -> Result<(CableHandle, f64), Error> {
        let (mut found, mut s) = (cable, arc_length);
        let parts = self.parts(cable)?;
        for (k, &part) in parts.iter().enumerate() {
            let length = self.contents.cable(part)?.length();
            found = part;
            if s <= length || k + 1 == parts.len() {
                break;
            }
            s -= length;
        }
        Ok((found, s))
    }
}
