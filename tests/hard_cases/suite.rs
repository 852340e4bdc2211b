//! Runs the part of the hard cases that every change must pass, and compares with docs/stability.md.

use lariat_bench::stability::outcome::Outcome;
use lariat_bench::stability::{Family, quick_jobs, report, run_in_turn};
use std::collections::BTreeSet;

/// Runs a family, each case on one of its hosts: what does not hold must be exactly what docs/stability.md lists, so that improvements
/// and regressions both show. A run over its budget of CPU time is neither: it depends on the machine.
pub fn check(family: Family) {
    let jobs = quick_jobs(family);
    assert!(!jobs.is_empty());
    let rows = run_in_turn(&jobs);
    let listed = report::listed_misses(include_str!("../../docs/stability.md"));
    let mut failures = Vec::new();
    for row in &rows {
        let key = report::key(row);
        if matches!(row.outcome, Outcome::OverBudget(_)) {
            println!("{key}: {}", row.outcome.reason());
            continue;
        }
        match (row.outcome.is_kept(), listed.contains(&key)) {
            (true, true) => failures.push(format!("{key}: holds now, docs/stability.md lists it as missed")),
            (false, false) => failures.push(format!("{key}: {}: {}", row.outcome.word(), row.outcome.reason())),
            _ => {}
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    let hosts: BTreeSet<_> = rows.iter().map(|r| r.host).collect();
    println!("{}: {} runs on {} hosts", family.name(), rows.len(), hosts.len());
    assert!(family == Family::Long || rows.iter().any(|r| r.host.effects), "none with effects");
}
