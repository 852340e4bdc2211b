//! Reels: attachments and junctions follow the nodes of a cable, whose numbers and arc lengths change.

use crate::contents::Contents;
use crate::error::Error;
use crate::handle::CableHandle;
use lariat_ancf::At;

/// Splits and merges elements at the eyes of all reels, before a step.
pub(crate) fn remesh(contents: &mut Contents) -> Result<(), Error> {
    for i in 0..contents.cables.len() {
        let Some(cable) = contents.cables.get_mut(i).map(|slot| &mut slot.cable).filter(|cable| cable.has_reel())
        else {
            continue;
        };
        let (last, from_start) = (cable.nodes() - 1, cable.nodes_from_start());
        cable.remesh_reel()?;
        let (end, added) = (cable.nodes() - 1, cable.nodes_from_start() - from_start);
        if end == last && added == 0 {
            continue;
        }
        let eyes = [At::Start, At::End].map(|at| cable.reel_description(at).is_some());
        let renumbered = |node: usize| match node {
            0 if eyes[0] => 0,
            node if eyes[1] && node == last => end,
            inner => inner.saturating_add_signed(added as isize),
        };
        let attached = contents.attachments.values_mut().map(|a| (a.cable, &mut a.node));
        let tied = contents.junctions.values_mut().flat_map(|j| &mut j.nodes).map(|(c, n)| (*c, n));
        attached.chain(tied).filter(|(c, _)| c.0 as usize == i).for_each(|(_, node)| *node = renumbered(*node));
        contents.changed = true;
    }
    follow(contents);
    Ok(())
}

/// Moves the arc lengths of attachments and junctions to those of their nodes.
pub(crate) fn follow(contents: &mut Contents) {
    let Contents { cables, attachments, junctions, .. } = contents;
    let arc_length = |cable: CableHandle, node: usize| {
        let cable = &cables.get(cable.0 as usize)?.cable;
        cable.has_reel().then(|| cable.elements()[..node].iter().map(|element| element.length).sum())
    };
    let attached = attachments.values_mut().map(|a| (a.cable, a.node, &mut a.arc_length));
    let tied = junctions.values_mut().flat_map(|j| j.nodes.iter().zip(&mut j.arc_lengths));
    for (cable, node, at) in attached.chain(tied.map(|((cable, node), at)| (*cable, *node, at))) {
        *at = arc_length(cable, node).unwrap_or(*at);
    }
}
