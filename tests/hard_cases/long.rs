//! An hour, ten minutes, sleep. The cases: `crates/lariat-bench/src/stability/cases/long.rs`.

use super::suite::check;
use lariat_bench::stability::Family;

/// Each case on one of its hosts, the first with all effects too.
///
/// *Source.* By case: statics, conservation of energy.
#[test]
fn long_runs_neither_drift_nor_heat() {
    check(Family::Long);
}
