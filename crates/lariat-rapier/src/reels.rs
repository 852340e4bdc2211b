//! The eyes of reels: attachments and junctions there follow the last node of the cable, whose number and arc length change.

use crate::contents::Contents;
use crate::error::Error;

/// Splits and merges elements at the eyes of all reels, before a step.
pub(crate) fn remesh(contents: &mut Contents) -> Result<(), Error> {
    for i in 0..contents.cables.len() {
        let Some(cable) = contents.cables.get_mut(i).map(|slot| &mut slot.cable).filter(|cable| cable.has_reel())
        else {
            continue;
        };
        let eye = cable.nodes() - 1;
        cable.remesh_reel()?;
        for attachment in contents.attachments.values_mut().filter(|a| a.cable.0 as usize == i) {
            attachment.at_eye = attachment.node == eye;
        }
    }
    follow(contents);
    Ok(())
}

/// Moves the attachments at eyes to the last node of their cables.
pub(crate) fn follow(contents: &mut Contents) {
    let Contents { cables, attachments, changed, .. } = contents;
    for attachment in attachments.values_mut().filter(|a| a.at_eye) {
        let Some(slot) = cables.get(attachment.cable.0 as usize).filter(|slot| slot.cable.has_reel()) else { continue };
        let eye = slot.cable.nodes() - 1;
        *changed |= attachment.node != eye;
        (attachment.node, attachment.arc_length) = (eye, slot.cable.length());
    }
}
