//! Tying cables to each other and untying them.

use super::attach::free_node;
use crate::contents::Contents;
use crate::contents::attachment::Gap;
use crate::contents::junction::Junction;
use crate::error::Error;
use crate::handle::{CableHandle, JunctionHandle};
use lariat_ancf::At;
use lariat_ancf::coupling::Coupling;

/// Ties a point of a cable to a point of another, or of itself.
pub(crate) fn join(
    contents: &mut Contents,
    (first, at_first): (CableHandle, At),
    (second, at_second): (CableHandle, At),
    gap: Gap,
) -> Result<JunctionHandle, Error> {
    // arc lengths stay the same when nodes are inserted
    let lengths = [contents.cable(first)?.arc_length(at_first)?, contents.cable(second)?.arc_length(at_second)?];
    let [at_first, at_second] = lengths.map(At::ArcLength);
    let [a, b] = [contents.cable(first)?, contents.cable(second)?];
    gap.check(a, &a.sample(lengths[0])?.position, &b.sample(lengths[1])?.position)?;
    let existing = junction_at(contents, first, at_first);
    if existing.is_none() && junction_at(contents, second, at_second).is_some() {
        return join(contents, (second, at_second), (first, at_first), gap);
    }
    let index = match existing {
        Some(index) => index,
        None => {
            let node = attach_node(contents, first, at_first)?;
            contents.junctions.push(Junction {
                nodes: vec![(first, node)],
                arc_lengths: vec![lengths[0]],
                memory: None,
            })
        }
    };
    contents.changed = true;
    match attach_node(contents, second, at_second) {
        Ok(node) => {
            if let Some(junction) = contents.junctions.get_mut(index) {
                junction.nodes.push((second, node));
                junction.arc_lengths.push(lengths[1]);
                junction.memory = None;
            }
            Ok(JunctionHandle(index as u32))
        }
        Err(error) => {
            if existing.is_none()
                && let Some(junction) = contents.junctions.pop()
            {
                contents.cable_mut(first)?.detach(At::Node(junction.nodes[0].1))?;
            }
            Err(error)
        }
    }
}

/// Returns the index of the junction at a point of a cable.
fn junction_at(contents: &Contents, cable: CableHandle, at: At) -> Option<usize> {
    let node = contents.cable(cable).ok()?.node(at).ok()?;
    contents.junctions.iter().find(|(_, junction)| junction.nodes.contains(&(cable, node))).map(|(i, _)| i)
}

/// Attaches the node at a point of a cable, inserting one if there is none.
fn attach_node(contents: &mut Contents, cable: CableHandle, at: At) -> Result<usize, Error> {
    let node = free_node(contents, cable, at)?;
    contents.cable_mut(cable)?.attach(At::Node(node))?;
    Ok(node)
}

/// Unties a cable from a junction; a junction with a single node left ends.
pub(crate) fn leave(contents: &mut Contents, handle: JunctionHandle, cable: CableHandle) -> Result<(), Error> {
    let before = contents.junction(handle)?.clone();
    if !before.nodes.iter().any(|(c, _)| *c == cable) {
        return Err(Error::NoCable(cable));
    }
    // all of its cables wake up
    for (other, _) in &before.nodes {
        contents.cable_mut(*other)?;
    }
    let nodes = before.nodes.into_iter().zip(before.arc_lengths);
    let (removed, kept): (Vec<_>, Vec<_>) = nodes.partition(|((c, _), _)| *c == cable);
    let mut freed: Vec<(CableHandle, usize)> = removed.into_iter().map(|(node, _)| node).collect();
    let (mut nodes, arc_lengths): (Vec<_>, Vec<_>) = kept.into_iter().unzip();
    if nodes.len() < 2 {
        freed.append(&mut nodes);
        contents.junctions.remove(handle.0 as usize);
    } else if let Some(junction) = contents.junctions.get_mut(handle.0 as usize) {
        *junction = Junction { nodes, arc_lengths, memory: None };
    }
    contents.changed = true;
    for (cable, node) in freed {
        contents.cable_mut(cable)?.detach(At::Node(node))?;
    }
    Ok(())
}
