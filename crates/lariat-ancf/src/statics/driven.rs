//! Continuation in what drives a shape: the velocity of a flow, forces of the user's own.
//!
//! # Scheme
//!
//! A shape in a strong flow is far from the one that is drawn, and has no potential to descend in.
//! Where the search from the drawing finds none, it begins without what drives, and follows the
//! equilibrium as the share of it grows to 1: by a quarter at first, twice as much after each shape
//! that is found, half as much after each that is not.
//!
//! # Validity
//!
//! Shapes that depend on the share without jumps; of several shapes at the full share it is the one
//! that grows out of that at rest. Drag grows with the square of a velocity, so that the first
//! quarter of it is a sixteenth of the force.
//!
//! # References
//!
//! Allgower & Georg 1990 (continuation).

use crate::scales::statics::{FIRST_SHARE, LEAST_SHARE};

/// Follows a shape from nothing that drives it to all. `at` searches from the present shape with a
/// share, and keeps that shape where it finds none.
pub(crate) fn in_shares<R, E>(mut at: impl FnMut(f64) -> Result<R, E>) -> Option<R> {
    at(0.0).ok()?;
    let (mut share, mut step) = (0.0, FIRST_SHARE);
    while step >= LEAST_SHARE {
        let next: f64 = f64::min(share + step, 1.0);
        match at(next) {
            Ok(found) if next == 1.0 => return Some(found),
            Ok(_) => (share, step) = (next, 2.0 * step),
            Err(_) => step *= 0.5,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A search that follows no more than 0.03 at a time above 0.5 ends at 1, and one that finds
    /// nothing above 0.7 ends without a shape.
    #[test]
    fn shares_grow_where_shapes_are_found() {
        let mut last = 0.0;
        let mut tries = 0;
        let found = in_shares(|share| {
            tries += 1;
            if share > 0.5 && share - last > 0.03 {
                return Err(());
            }
            last = share;
            Ok(share)
        });
        assert!(found == Some(1.0) && tries < 80, "{tries}");
        assert_eq!(in_shares(|share| if share < 0.7 { Ok(share) } else { Err(()) }), None);
    }
}
