//! Runs the cases of a family and compares them with the known misses.

use lariat_bench::misses::read;
use lariat_bench::stability::family::Family;
use lariat_bench::stability::job::{Selection, jobs, run};
use lariat_bench::stability::misses::{Miss, differences};
use lariat_bench::stability::outcome::Row;
use std::collections::BTreeSet;
use std::io::Write;

/// Returns the known misses.
pub fn known() -> Vec<Miss> {
    read(include_str!("../../crates/lariat-bench/stability_misses.csv")).expect("a file of misses")
}

/// Returns whether the long tests are asked for.
pub fn long() -> bool {
    std::env::var_os("LARIAT_LONG_TESTS").is_some_and(|value| value == "1")
}

/// Prints a line although tests capture what is printed.
pub fn tell(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Runs a family, each case on one of its hosts. Every bound must hold except those that are listed
/// as missed, and those must be missed by what is listed, so that improvements and regressions both
/// show.
pub fn check(family: Family) {
    let all = jobs(family, Selection::Long);
    let jobs = if long() { all.clone() } else { jobs(family, Selection::Quick) };
    let rows: Vec<Row> = jobs.iter().map(|job| run(*job)).collect();
    let differences = differences(&rows, &known());
    assert!(differences.is_empty(), "{}", differences.join("\n"));
    let hosts: BTreeSet<_> = rows.iter().map(|r| r.host).collect();
    let skipped = all.len() - jobs.len();
    tell(&format!("{}: {} runs on {} hosts, {skipped} skipped", family.name(), rows.len(), hosts.len()));
    assert!(family == Family::Long || rows.iter().any(|r| r.host.effects), "no run with effects");
}
