//! Shapes that are strained as drawn.

use crate::warned;
use lariat_scene::{Purpose, Scene, Warning};

/// A rope without weight, at rest, through these points, of a bending stiffness that does nothing; without any, it has kinks where it is held.
fn rope(points: &[[f64; 2]], elements: usize, stiffness: f64, rest: &str) -> String {
    let points: Vec<[f64; 3]> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    format!(
        "duration = 1e-3\ndt = 1e-3\ngravity = [0.0, 0.0, 0.0]\n[[cable]]\nname = \"rope\"\npoints = {points:?}\nelements = {elements}\n\
         axial_stiffness = {stiffness:?}\nbending_stiffness = 1e-14\nmass_per_length = 0.1\nintegrator = {{ fidelity = \"game\" }}\n{rest}"
    )
}

/// Two legs of 1 m with this angle between their directions.
fn corner(turn: f64) -> Vec<[f64; 2]> {
    vec![[-1.0, 0.0], [0.0, 0.0], [turn.cos(), turn.sin()]]
}

fn told(text: &str) -> Option<Warning> {
    warned(text, Purpose::Run).into_iter().find(|w| matches!(w, Warning::DrawnCorner { .. }))
}

/// The start, a point (m) and the end are held by the world.
fn held_at(arc_length: f64) -> String {
    let at = ["\"start\"".to_string(), format!("{arc_length:?}"), "\"end\"".to_string()];
    at.map(|at| format!("[[attachment]]\ncable = \"rope\"\nat = {at}\nbody = \"world\"\n")).concat()
}

/// A rope that lies unstretched around a corner, with a node there or not, starts without energy; one that is held at the corner holds energy that no rope has,
/// which is told.
///
/// *Source.* An unstretched rope without bending stiffness at rest has no energy: all that it starts with is that of the corner.
#[test]
fn a_rope_held_at_a_corner_is_told_with_the_energy_it_starts_with() {
    for (turn, elements, stiffness) in [(1.0, 10, 1e5), (1.6, 11, 1e6), (2.2, 20, 3e3), (2.8, 7, 1e7), (0.7, 9, 2e4)] {
        let free = rope(&corner(turn), elements, stiffness, "");
        let energy = |text: &str| {
            let scene = Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap();
            scene.build_cable(0).unwrap().energy().total()
        };
        assert!(energy(&free) < 1e-6 * 2.0 * stiffness, "{:e} J", energy(&free));
        assert_eq!(told(&free), None);
        let text = rope(&corner(turn), elements, stiffness, &held_at(1.0));
        let energy = energy(&text);
        let Some(Warning::DrawnCorner { cable, corner, turn_rad, slack: false, energy_j, speed_m_s }) = told(&text)
        else {
            panic!("not told: {text}")
        };
        assert_eq!((cable.as_str(), corner), ("rope", 1));
        assert!((turn_rad / turn - 1.0).abs() < 1e-12, "{turn_rad} {turn}");
        assert!((energy_j / energy - 1.0).abs() < 1e-9, "{energy_j} {energy}");
        assert_eq!(told(&text.replace("1e-14", "0.0")), None);
        // kinetic energy of 0.2 kg
        assert!((0.1 * speed_m_s * speed_m_s / energy - 1.0).abs() < 1e-9, "{speed_m_s}");
    }
}

#[test]
fn straight_stretched_and_round_ropes_are_not_told() {
    let arc = |radius: f64| {
        let angles = (0..=24).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2 / 24.0);
        let mut points = vec![[-1.0 - radius, 0.0]];
        points.extend(angles.map(|a| [radius * (a.sin() - 1.0), radius * (1.0 - a.cos())]));
        points.push([0.0, 1.0 + radius]);
        points
    };
    let held = "[[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
                [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"\n";
    for (points, elements, rest) in [
        (vec![[-1.0, 0.0], [1.0, 0.0]], 10, "length = 2.5\n"),
        (vec![[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]], 10, "length = 1.99\n"),
        (arc(0.4), 10, ""),
        (arc(0.2), 20, ""),
        (corner(0.1), 10, ""),
        (corner(2.0), 10, &format!("initial = \"equilibrium\"\nlength = 1.0\n{held}")),
    ] {
        assert_eq!(told(&rope(&points, elements, 1e6, rest)), None, "{elements} {rest}");
    }
}

/// Segments of a slack rope are arcs that meet at an angle, even on a straight line: told if it is held there.
#[test]
fn a_slack_rope_held_between_its_arcs_is_told() {
    let points = [[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]];
    assert_eq!(told(&rope(&points, 10, 1e6, "length = 2.5\n")), None);
    let warning = told(&rope(&points, 10, 1e6, &format!("length = 2.5\n{}", held_at(1.25))));
    assert!(matches!(warning, Some(Warning::DrawnCorner { slack: true, .. })), "{warning:?}");
}
