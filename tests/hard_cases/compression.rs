//! Ends pushed together, rods that buckle, a fold. The cases: `crates/lariat-bench/src/stability/cases/compression.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: Greenhill's height; bent, not squeezed.
#[test]
fn compressed_ropes_buckle() {
    check(Family::Compression);
}
