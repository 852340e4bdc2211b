//! The scenes that version 0.1 got wrong without a word.

use lariat_bench::coupling::hard;
use lariat_bench::table::Cell;

/// Each is right within 5 %, refused, or warned of.
///
/// Reference: that of the table; formulas, and fine runs.
#[test]
fn no_hard_scene_is_silently_wrong() {
    let table = hard::table(&mut |line| println!("{line}")).unwrap();
    assert!(table.rows.len() > 20);
    for row in &table.rows {
        let [scene, quantity, reference, _, _, now, said] = &row[..] else { panic!("{row:?}") };
        let is_spoken_of = matches!(said, Cell::Text(text) if !text.is_empty());
        let is_right = match (reference, now) {
            // a share of the whole
            (Cell::Number(0.0), Cell::Number(now)) => now.abs() < 0.05,
            (Cell::Number(expected), Cell::Number(now)) => (now / expected - 1.0).abs() < 0.05,
            _ => false,
        };
        assert!(is_right || is_spoken_of, "{scene:?}: {quantity:?}: {now:?}, not {reference:?}");
    }
}
