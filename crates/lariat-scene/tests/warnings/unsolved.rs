//! Steps that are accepted unsolved are told, and the account of energy says what happened.

use crate::summary_of;
use lariat_ancf::Warning as OfCable;
use lariat_scene::{Purpose, Warning};

/// Two thin ropes with contact on a body that turns by a radian in a host step: contacts come to no solution in the shortest divisions. They are said to
/// have taken what the energy lost, and what their laws say beyond it is told.
///
/// *Source.* The work-energy theorem; without it the account misses what is told as hidden, up to a third of the energy.
#[test]
fn steps_that_are_not_solved_are_told_and_the_account_closes() {
    let mut most = 0.0f64;
    for dt in [0.05, 0.033333, 0.02] {
        let text = include_str!("spun_ropes.toml").replace("dt = 0.033333", &format!("dt = {dt:?}"));
        let summary = summary_of(&text, Purpose::Run, None);
        let balance = summary.energy_balance.unwrap();
        let told = |warning: &Warning| match warning {
            Warning::Cable(OfCable::UnsolvedSteps { steps, hidden_j, .. }) => Some((*steps, *hidden_j)),
            _ => None,
        };
        let [(steps, hidden)] = summary.warnings.iter().filter_map(told).collect::<Vec<_>>()[..] else {
            panic!("{dt} s: {:?}", summary.warnings)
        };
        println!("{dt} s: {steps} steps, {hidden:.1e} J of {:.1e} J, made {:.1e}", balance.scale_j, balance.made());
        assert!(steps > 0 && balance.made() < 1e-2, "{dt} s: {balance:?}");
        assert!(!summary.warnings.iter().any(|w| matches!(w, Warning::EnergyMade { .. })), "{:?}", summary.warnings);
        most = most.max(hidden / balance.scale_j);
    }
    // what is hidden would otherwise be energy that the account makes
    assert!(most > 0.02, "{most}");
}
