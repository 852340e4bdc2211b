//! A load falls 1 m on a slack rope. The cases: `crates/lariat-bench/src/stability/cases/snatch.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: m g + sqrt((m g)^2 + k m v^2) with the wave of the rope; a fine run of the load on a massless rope.
#[test]
fn slack_ropes_snatch() {
    check(Family::Snatch);
}
