//! Nodes that coincide, slopes of zero, elements inside out. The cases: `crates/lariat-bench/src/stability/cases/collapse.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: the contract: an error that says why, the last good state, never a NaN.
#[test]
fn collapsed_elements_are_refused_or_recover() {
    check(Family::Collapse);
}
