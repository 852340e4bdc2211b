//! What a run would need, found before it begins.

use super::probe;
use crate::error::Error;
use crate::scene::{Purpose, Scene};

/// Bytes of a number in a file, with its comma: the shortest text of most f64 has 17 digits, point, sign and exponent.
const BYTES_PER_NUMBER: f64 = 20.0;
/// Most bytes of all probe files together.
const MOST_BYTES: f64 = 4e9;
/// Most elements of all cables together: they take 3.6 kB each (`elements = 100000` against 10000, largest resident set).
const MOST_ELEMENTS: usize = 1_000_000;

/// Checks a scene.
///
/// # Errors
/// [`Error::TooLarge`] for probes that would write more than 4 GB together, and for more than a million elements.
pub(super) fn check(scene: &Scene, purpose: Purpose) -> Result<(), Error> {
    let elements: usize = scene.cables.iter().map(|cable| cable.elements).sum();
    if elements > MOST_ELEMENTS {
        let problem =
            format!("its cables have {elements} elements, which take some {:.1} GB", 3.6e-6 * elements as f64);
        return Err(Error::TooLarge { problem, accepted: format!("{MOST_ELEMENTS} elements in all") });
    }
    if purpose == Purpose::Static {
        return Ok(());
    }
    let rows = |every: Option<f64>| scene.duration / every.unwrap_or(scene.dt) + 1.0;
    let of = scene.probes.iter().map(|p| BYTES_PER_NUMBER * rows(p.every) * probe::columns(p.target).len() as f64);
    let bytes: f64 = of.sum();
    if bytes > MOST_BYTES {
        let problem = format!("its {} probes would write some {:.0} GB", scene.probes.len(), 1e-9 * bytes);
        return Err(Error::TooLarge { problem, accepted: "at most 4 GB: take a longer `every`".to_string() });
    }
    Ok(())
}
