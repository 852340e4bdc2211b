//! Where the way of a point meets a surface, by distances.
//!
//! # References
//!
//! Hart, The Visual Computer 12 (1996) 527 (tracing by distances).

use super::surface::{Nearest, Surface};
use crate::scales::obstacle::{PAST, TRACES};
use nalgebra::Vector3;

/// Returns the surface where the way from `start` to `end` comes within `reach` of a part that
/// `counts`; past others it goes on.
pub(crate) fn trace(
    surface: &dyn Surface,
    [start, end]: [&Vector3<f64>; 2],
    reach: f64,
    counts: impl Fn(&Nearest) -> bool,
) -> Option<Nearest> {
    let way = end - start;
    let length = way.norm();
    let (mut done, close) = (0.0, 0.02 * reach);
    for _ in 0..TRACES {
        if done >= length {
            return None;
        }
        let nearest = surface.nearest(&(start + way * (done / length)));
        let gap = nearest.distance - reach;
        if gap <= close && counts(&nearest) {
            return Some(nearest);
        }
        done += gap.max(PAST * reach);
    }
    let nearest = surface.nearest(end);
    (nearest.distance <= reach && counts(&nearest)).then_some(nearest)
}
