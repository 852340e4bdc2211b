//! Sheaves along one cable, which is cut at each of them and runs on.

use super::sheaves;
use crate::contents::Contents;
use crate::contents::attachment::{AttachmentKind, Gap};
use crate::contents::reel::sheave::SheaveOptions;
use crate::edit::attach::{attach, check};
use crate::edit::part::part;
use crate::error::Error;
use crate::handle::{CableHandle, SheaveHandle};
use ::nalgebra::Vector3;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Reel};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Puts a sheave at a point of a cable.
pub(crate) fn add(
    contents: &mut Contents,
    world: &PhysicsWorld,
    (cable, at): (CableHandle, At),
    (body, anchor): (RigidBodyHandle, Vector3<f64>),
    options: SheaveOptions,
) -> Result<SheaveHandle, Error> {
    check(contents, world, (cable, at), (body, anchor), Gap::default())?;
    // what could fail below is tried on a copy
    let mut before = contents.cable(cable)?.clone();
    let mut behind = before.cut(at)?;
    for (half, end) in [(&mut before, At::End), (&mut behind, At::Start)] {
        half.attach(end)?;
        half.add_reel(end, Reel::over_sheave())?;
    }
    let cut = |cable: &mut Cable| {
        let (mut rest, how) = cable.divide_at(at)?;
        cable.open_corner(At::End);
        rest.open_corner(At::Start);
        Ok(Some((rest, how)))
    };
    let rest = part(contents, cable, cut, &mut Vec::new())?.ok_or(Error::NoCable(cable))?;
    // both ends are where they are beside the anchor
    let held = AttachmentKind::Ball.with_gap(Gap::Close);
    for end in [(cable, At::End), (rest, At::Start)] {
        attach(contents, world, end, (body, anchor), held)?;
    }
    let options = SheaveOptions { along: options.along.or(Some(0.0)), ..options };
    sheaves::add(contents, (cable, At::End), (rest, At::Start), options)
}
