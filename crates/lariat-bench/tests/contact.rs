//! The scenes of cables that touch, each against its formula or its bound.

use lariat_bench::report::contact::cases;

/// *Source.* Formulas in `report/contact.rs`: Euler-Eytelwein, rigid bodies, Coulomb's law, the energy law.
#[test]
fn every_scene_keeps_its_bound() {
    let outcomes: Vec<_> = cases().iter().map(|case| case.run().unwrap()).collect();
    for outcome in &outcomes {
        println!("{outcome:?}");
    }
    let missed: Vec<_> =
        outcomes.iter().filter(|outcome| outcome.deviation > outcome.bound || outcome.deviation.is_nan()).collect();
    assert!(missed.is_empty(), "{missed:#?}");
}
