//! The comparison with the known misses: what is worse, better, new or out of date is reported.

use super::check::known;
use lariat_bench::stability::family::Family;
use lariat_bench::stability::host::{CableModel, Host, Precision};
use lariat_bench::stability::job::{Selection, jobs, names};
use lariat_bench::stability::misses::{Miss, differences, of, run_name};
use lariat_bench::stability::outcome::{Check, Outcome, Row};
use std::collections::BTreeSet;

/// A run of a case that ends so.
fn row(outcome: Outcome, completed: f64) -> Row {
    Row {
        family: Family::Whip,
        case: "crack".to_string(),
        host: Host { rate: 60, iterations: 4, precision: Precision::Single, effects: false },
        model: CableModel::Lariat,
        outcome,
        told: Vec::new(),
        completed,
        energy_not_checked: None,
        energy: 0.0,
        energy_made: 0.0,
        energy_lost: 0.0,
        gap: 0.0,
        constraint: 0.0,
        stretch: 0.0,
        steps: 0,
        rejected: 0,
        evaluations: 0,
        micros: 0.0,
        seconds: 0.0,
    }
}

fn gap(value: f64) -> Row {
    row(Outcome::OutOfBounds(vec![Check::at_most("gap, m", value, 1e-3, "the contract")]), 1.0)
}

/// The differences of a run from the misses of another.
fn changes(before: &Row, now: &Row) -> Vec<String> {
    differences(std::slice::from_ref(now), &of(before))
}

/// A miss that grows or shrinks by more than a fifth is reported, a smaller change is not; NaN is
/// worse.
#[test]
fn a_miss_that_changes_by_more_than_a_fifth_is_reported() {
    assert_eq!(changes(&gap(2e-3), &gap(2e-3)), Vec::<String>::new());
    assert_eq!(changes(&gap(2e-3), &gap(2.3e-3)), Vec::<String>::new());
    assert_eq!(changes(&gap(2e-3), &gap(1.7e-3)), Vec::<String>::new());
    let worse = changes(&gap(2e-3), &gap(2.5e-3));
    assert!(worse.len() == 1 && worse[0].ends_with("worse"), "{worse:?}");
    let better = changes(&gap(2e-3), &gap(1.5e-3));
    assert!(better.len() == 1 && better[0].contains("better"), "{better:?}");
    let nan = changes(&gap(2e-3), &gap(f64::NAN));
    assert!(nan.len() == 1 && nan[0].ends_with("worse"), "{nan:?}");
}

/// A run over its budget counts by the share that is done: less is worse, more is better.
#[test]
fn a_run_over_budget_counts_by_the_share_that_is_done() {
    let over = |share| row(Outcome::OverBudget, share);
    assert_eq!(changes(&over(0.5), &over(0.45)), Vec::<String>::new());
    assert!(changes(&over(0.5), &over(0.35))[0].ends_with("worse"));
    assert!(changes(&over(0.5), &over(0.7))[0].contains("better"));
    assert!(changes(&over(0.5), &row(Outcome::Passed, 1.0))[0].contains("remove it"));
}

/// A miss that is not listed, another kind of miss, and a bound that was changed are reported.
#[test]
fn new_misses_other_kinds_and_changed_bounds_are_reported() {
    let passed = row(Outcome::Passed, 1.0);
    assert_eq!(changes(&passed, &passed), Vec::<String>::new());
    let new = changes(&passed, &gap(2e-3));
    assert!(new.len() == 1 && new[0].contains("new miss"), "{new:?}");
    for now in [Outcome::NotFinite, Outcome::Panicked("at".to_string()), Outcome::Failed("error".to_string())] {
        assert_eq!(changes(&gap(2e-3), &row(now, 0.5)).len(), 2);
    }
    let mut listed = of(&gap(2e-3));
    listed[0].bound = 1.5e-3;
    let bound = differences(&[gap(2e-3)], &listed);
    assert!(bound.len() == 1 && bound[0].contains("the bound is"), "{bound:?}");
}

/// Every listed miss is one of a run that is made, and is listed once.
#[test]
fn every_known_miss_belongs_to_a_run() {
    let mut runs = BTreeSet::new();
    for family in Family::ALL {
        let names = names(family);
        for job in jobs(family, Selection::Full).into_iter().filter(|job| job.model == CableModel::Lariat) {
            let run = Row { family, case: names[job.case].clone(), host: job.host, ..row(Outcome::Passed, 1.0) };
            runs.insert(run_name(&run));
        }
    }
    let mut seen = BTreeSet::new();
    for Miss { family, case, host, kind, value, bound, .. } in known() {
        let run = format!("{family}: {case} | {host}");
        assert!(runs.contains(&run), "no run {run}");
        assert!(value.is_finite() && bound.is_finite() && seen.insert((run, kind)));
    }
}

/// The page lists the bounds that Lariat misses; a rope of Rapier's that misses one is none of them.
#[test]
fn the_page_lists_no_misses_of_other_ropes() {
    let missed = |row: Row| {
        let (_, sections) = lariat_bench::stability::page::page(&[row], "", "").unwrap();
        let tables = sections.iter().flat_map(|section| section.tables());
        let of_misses = tables.filter(|table| table.name == "stability_misses");
        of_misses.map(|table| table.rows.len()).max().unwrap()
    };
    let ours = row(Outcome::NotFinite, 0.5);
    assert_eq!(missed(Row { model: CableModel::SoftRope, ..ours.clone() }), 0);
    assert_eq!(missed(ours), 1);
}
