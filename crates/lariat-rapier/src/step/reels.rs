//! Reels: the arc lengths of attachments and junctions follow the nodes of a cable that a step
//! moves; their nodes are found anew where elements are split or merged.

use crate::body::proximity;
use crate::contents::Contents;
use crate::error::Error;
use crate::handle::CableHandle;
use crate::islands::Island;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable};
use rapier::pipeline::PhysicsWorld;

/// Refuses drums that something else than cables moves.
pub(crate) fn check(world: &PhysicsWorld, island: &Island) -> Result<(), Error> {
    let mut bodies = island.wheels.drums.iter().filter_map(|drum| island.members[drum.body].body());
    match bodies.find(|body| proximity::is_linked(world, *body)) {
        Some(body) => Err(Error::DrumJoined(body)),
        None => Ok(()),
    }
}

/// Splits and merges elements at the eyes of all reels, before a step. Arc lengths stay, numbers of
/// nodes change.
pub(crate) fn remesh(contents: &mut Contents) -> Result<(), Error> {
    let Contents { cables, attachments, changed, .. } = contents;
    for cable in cables.values_mut().map(|slot| &mut slot.cable).filter(|cable| cable.has_reel()) {
        let before = (cable.nodes(), cable.nodes_from_start());
        cable.remesh_reel()?;
        *changed |= before != (cable.nodes(), cable.nodes_from_start());
    }
    // the host may have restored a cable of another length
    for attachment in attachments.values_mut().filter(|a| a.at_eye) {
        let slot = cables.get(attachment.cable.0 as usize);
        if let Some(slot) = slot.filter(|slot| slot.cable.reel_description(At::End).is_some()) {
            attachment.arc_length = slot.cable.length();
        }
    }
    Ok(())
}

/// Notes which nodes of cables with reels are attached, before a step: a cable that moves no body
/// splits and merges elements within it.
pub(crate) fn mark(contents: &mut Contents) {
    let Contents { cables, attachments, .. } = contents;
    for attachment in attachments.values_mut() {
        let Some(slot) = cables.get(attachment.cable.0 as usize).filter(|slot| slot.cable.has_reel()) else { continue };
        attachment.at_eye = attachment.node + 1 == slot.cable.nodes();
        attachment.from_start = slot.cable.nodes_from_start();
    }
}

/// Moves attachments and junctions to where a step has moved their nodes.
pub(crate) fn follow(contents: &mut Contents) {
    let Contents { cables, attachments, junctions, changed, .. } = contents;
    let reeled =
        |cable: CableHandle| cables.get(cable.0 as usize).map(|slot| &slot.cable).filter(|cable| cable.has_reel());
    let arc_length =
        |cable: &Cable, node: usize| cable.elements().iter().take(node).map(|element| element.length).sum::<f64>();
    for attachment in attachments.values_mut() {
        let Some(cable) = reeled(attachment.cable) else { continue };
        let [start, end] = [At::Start, At::End].map(|at| cable.reel_description(at).is_some());
        let added = cable.nodes_from_start() - attachment.from_start;
        let node = match attachment.node {
            _ if attachment.at_eye && end => cable.nodes() - 1,
            0 if start => 0,
            node => node.saturating_add_signed(added as isize),
        };
        *changed |= node != attachment.node;
        (attachment.node, attachment.from_start) = (node, cable.nodes_from_start());
        attachment.arc_length = arc_length(cable, node);
    }
    for junction in junctions.values_mut() {
        for (&(cable, node), s) in junction.nodes.iter().zip(&mut junction.arc_lengths) {
            *s = reeled(cable).map_or(*s, |cable| arc_length(cable, node));
        }
    }
}
