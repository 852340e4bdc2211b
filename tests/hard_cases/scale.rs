//! Far from the origin, tiny and huge. The cases: `crates/lariat-bench/src/stability/cases/scale.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: the resolution of single precision, Green's law.
#[test]
fn far_tiny_and_huge_cables_hold() {
    check(Family::Scale);
}
