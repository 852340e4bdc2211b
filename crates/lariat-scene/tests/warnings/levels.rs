//! The order of warnings, and what follows from what.

use crate::summary_of;
use lariat_ancf::Level;
use lariat_scene::{Purpose, Warning};

/// Ropes that a kinematic body holds at one end and moves along them from the first instant on, by
/// a method that damps.
fn thrown(names: &[&str], velocity: f64) -> String {
    let one = |(i, name): (usize, &&str)| {
        let z = i as f64;
        format!(
            "[[cable]]\nname = \"{name}\"\npoints = [[0.0, 0.0, {z:?}], [1.0, 0.0, {z:?}]]\nelements = 8\naxial_stiffness = 1e5\n\
             bending_stiffness = 0.1\nmass_per_length = 0.1\nintegrator = {{ method = \"generalised-alpha-0\", substeps = 1 }}\n\
             [[attachment]]\ncable = \"{name}\"\nat = \"start\"\nbody = \"mover\"\nanchor = [0.0, 0.0, {z:?}]\n"
        )
    };
    let cables: String = names.iter().enumerate().map(one).collect();
    format!(
        "duration = 0.3\ndt = 0.01\n[[body]]\nname = \"mover\"\nkind = \"kinematic\"\nshape = \"none\"\n\
         path = [[0.0, 0.0, 0.0, 0.0], [1.0, {velocity:?}, 0.0, 0.0]]\n{cables}"
    )
}

/// A shock is told alone: the steps and the energy that it costs follow from it, and stay in the
/// summary. Without one they are told.
///
/// *Source.* A wave of the force v sqrt(EA m) = 100 N s/m v in a cable of 1 N.
#[test]
fn a_shock_is_told_in_place_of_what_follows_from_it() {
    let summary = summary_of(&thrown(&["rope"], -3.0), Purpose::Run, Some(Level::Coarse));
    let follows = |w: &&Warning| w.level() == Level::Coarse;
    assert!(summary.warnings.iter().filter(follows).count() > 0, "{:?}", summary.warnings);
    let [Warning::VelocityJump { force_n, difference_m_s, cable, .. }, ..] = &summary.warnings[..] else {
        panic!("{:?}", summary.warnings)
    };
    assert!((force_n - 100.0 * difference_m_s).abs() < 1e-3 * force_n && cable == "rope", "{force_n}");
    assert_eq!(summary.told, [summary.warnings[0].to_string()]);
    // too slow for a shock, 0.05 N, and one element, which cannot bend as a falling rope does
    let text = thrown(&["rope"], -5e-4).replace("elements = 8", "elements = 1");
    let slow = summary_of(&text, Purpose::Run, Some(Level::Coarse));
    assert!(!slow.warnings.iter().any(|w| matches!(w, Warning::VelocityJump { .. })), "{:?}", slow.warnings);
    let coarse = slow.warnings.iter().filter(follows).count();
    assert!(coarse > 0 && !slow.told.is_empty(), "{:?} {:?}", slow.warnings, slow.told);
    // what is coarse is kept, but told only up to its level
    let quiet = summary_of(&text, Purpose::Run, Some(Level::Wrong));
    assert_eq!((quiet.warnings, quiet.told), (slow.warnings, vec![]));
}

/// One kind of warning about several cables is one line, that of the worst.
#[test]
fn many_cables_with_one_cause_are_one_line() {
    let summary = summary_of(&thrown(&["a", "b", "c"], -3.0), Purpose::Run, Some(Level::Coarse));
    let jumps = summary.warnings.iter().filter(|w| matches!(w, Warning::VelocityJump { .. })).count();
    assert_eq!(jumps, 3, "{:?}", summary.warnings);
    assert_eq!(summary.told.len(), 1, "{:?}", summary.told);
    assert!(summary.told[0].starts_with("3 times, the worst: attachment "), "{:?}", summary.told);
}

/// Fidelity game tells nothing of mesh and steps unless it is asked to; other methods do.
#[test]
fn cables_with_fidelity_game_are_told_of_what_is_wrong() {
    let game = thrown(&["rope"], -5e-4)
        .replace("{ method = \"generalised-alpha-0\", substeps = 1 }", "{ fidelity = \"game\" }");
    let coarse = game.replace("elements = 8", "elements = 1");
    let summary = summary_of(&coarse, Purpose::Run, None);
    assert!(summary.warnings.iter().any(|w| w.level() == Level::Coarse), "{:?}", summary.warnings);
    assert!(summary.told.is_empty(), "{:?}", summary.told);
    assert!(!summary_of(&coarse, Purpose::Run, Some(Level::Coarse)).told.is_empty());
    let own = coarse.replace("{ fidelity = \"game\" }", "{ method = \"discrete-gradient\", substeps = 1 }");
    assert!(!summary_of(&own, Purpose::Run, None).told.is_empty());
}
