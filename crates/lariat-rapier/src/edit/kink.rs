//! A point of a cable at which its slope is free on both sides.

use super::attach::check_free;
use super::{join, part};
use crate::contents::Contents;
use crate::contents::attachment::Gap;
use crate::error::Error;
use crate::handle::{CableHandle, JunctionHandle};
use lariat_ancf::{At, Cable};

/// Makes two cables of one, which share the point.
pub(crate) fn kink(
    contents: &mut Contents,
    cable: CableHandle,
    at: At,
) -> Result<(CableHandle, JunctionHandle), Error> {
    let at = At::ArcLength(contents.cable(cable)?.arc_length(at)?);
    check_free(contents, cable, at)?;
    // no break: its event is nobody's
    let cut = |cable: &mut Cable| cable.break_at(at).map(Some);
    let rest = part::part(contents, cable, cut, &mut Vec::new())?.ok_or(Error::NoCable(cable))?;
    let junction = join::join(contents, (cable, At::End), (rest, At::Start), Gap::default())?;
    Ok((rest, junction))
}
