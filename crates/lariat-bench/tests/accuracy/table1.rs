//! The paper's Table 1, compared with an independent solver
//! (`assets/reference/table1_reproduction.csv`).

use approx::assert_relative_eq;
use lariat_bench::table1;

#[test]
fn table_1_agrees_with_an_independent_solver() {
    let table = table1::measure(1).unwrap();
    let row =
        |rule: &str, elements: usize| table.rows.iter().find(|r| r.rule == rule && r.elements == elements).unwrap();
    for (rule, difference, tolerance) in
        [("G2-2", 3.367e-1, 0.02), ("G3-3", 4.094e-3, 0.02), ("G4-4", 1.604e-4, 0.02), ("ST2", 9.617e-5, 0.05)]
    {
        assert_relative_eq!(row(rule, 10).difference_m, difference, max_relative = tolerance);
    }
    assert!(row("G5-5", 10).difference_m < 1e-7);
    assert_eq!(row("G10-10", 10).difference_m, 0.0);
    assert_relative_eq!(row("G5-5", 10).beam_m, 1.085e-2, max_relative = 0.02);
    assert!(row("projected-3", 10).beam_m < 3e-3);
    assert!(table.time_error_m < 1e-11, "{:e}", table.time_error_m);
    assert_eq!(table.table().csv().lines().count(), 1 + table.rows.len());
    assert!(table.text().contains("time error"));
}
