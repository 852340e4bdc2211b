//! Ending drums, and keeping them with the end of a cable that is cut.

use crate::contents::Contents;
use crate::contents::reel::drum::Wound;
use crate::error::Error;
use crate::handle::CableHandle;

/// Ends the drums that `ends` names, and the reels on them.
pub(crate) fn remove_where(contents: &mut Contents, mut ends: impl FnMut(&Wound) -> bool) -> Result<(), Error> {
    for i in (0..contents.wheels.drums.len()).rev() {
        let wound = contents.wheels.drums[i];
        if ends(&wound) {
            contents.wheels.drums.remove(i);
            contents.changed = true;
            if let Ok(cable) = contents.cable_mut(wound.cable) {
                cable.remove_reel(wound.at())?;
            }
        }
    }
    Ok(())
}

/// Gives the drum at the end of a cable that was cut to the part behind the cut.
pub(crate) fn follow_cut(contents: &mut Contents, cable: CableHandle, tail: CableHandle) {
    for wound in contents.wheels.drums.iter_mut().filter(|wound| wound.cable == cable && !wound.start) {
        wound.cable = tail;
    }
}
