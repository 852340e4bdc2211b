//! The effect tables of a scene, run and read back against outside values.

use lariat_lab::{Purpose, Scene, run};
use std::path::PathBuf;

/// Runs a scene and returns its summary and the rows of one probe.
fn results(name: &str, text: &str, purpose: Purpose) -> (run::Summary, Vec<Vec<f64>>) {
    let out: PathBuf = std::env::temp_dir().join(format!("lariat-effects-{name}-{}", std::process::id()));
    let scene = Scene::parse("effects.toml", text, &[], purpose).unwrap();
    let summary = match purpose {
        Purpose::Run => run::run(&scene, &out, &mut run::Options::default()).unwrap(),
        Purpose::Static => run::statics(&scene, &out).unwrap(),
    };
    let csv = std::fs::read_to_string(out.join("probes/p.csv")).unwrap();
    std::fs::remove_dir_all(&out).unwrap();
    let rows = csv.lines().skip(1).map(|row| row.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    (summary, rows)
}

const CABLE: &str = r#"
duration = 2.0
[[cable]]
name = "line"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
section = { round = 0.01 }
density = 4000.0
youngs_modulus = 1.0e8
elements = 4
"#;

/// A free horizontal cable reaches the speed that drag allows: v = v_T tanh(g t/v_T), v_T^2 = 2 w/(rho d C_n); what it lost is in
/// `dissipated`.
///
/// *Source.* Free fall with quadratic drag; conservation of energy.
#[test]
fn drag_of_a_scene_slows_a_falling_cable_and_is_accounted() {
    let text = format!(
        "{CABLE}integrator = {{ tolerance = 1e-8 }}\n[cable.drag]\nfluid_density = 1.2\nnormal = 1.1\ntangential = 0.02\n\
         [[probe]]\nname = \"p\"\nenergy = \"line\"\n"
    );
    let (summary, rows) = results("drag", &text, Purpose::Run);
    let mass = 4000.0 * std::f64::consts::FRAC_PI_4 * 1e-4;
    let terminal = (2.0 * mass * 9.81 / (1.2 * 0.01 * 1.1)).sqrt();
    let end = rows.last().unwrap();
    let speed = (2.0 * end[1] / (2.0 * mass)).sqrt();
    let expected = terminal * (9.81 * 2.0 / terminal).tanh();
    assert!((speed - expected).abs() < 1e-5 * expected, "{speed} {expected}");
    let (dissipated, total) = (end[5], end[7]);
    assert!(dissipated > 1.0 && (total + dissipated - rows[0][7]).abs() < 1e-5 * dissipated, "{dissipated} {total}");
    assert_eq!(summary.effect_evaluations.keys().collect::<Vec<_>>(), ["drag"]);
    assert_eq!(summary.effect_evaluations["drag"], summary.element_evaluations);
}

/// A neutrally buoyant cable floats, damping does nothing to it, and every effect that is on has its entry.
///
/// *Source.* Archimedes.
#[test]
fn buoyancy_of_a_scene_carries_the_cable() {
    let text = format!(
        "{CABLE}[cable.buoyancy]\nfluid_density = 4000.0\n[cable.damping]\naxial = 1e-3\nbending = 1e-2\n\
         [[probe]]\nname = \"p\"\ncable = \"line\"\nat = \"end\"\n"
    );
    let (summary, rows) = results("buoyancy", &text, Purpose::Run);
    let end = rows.last().unwrap();
    assert!(end[2].abs() < 1e-9 && end[3].abs() < 1e-9, "{end:?}");
    assert_eq!(summary.effect_evaluations.keys().collect::<Vec<_>>(), ["buoyancy", "damping"]);
    assert!(summary.effect_evaluations["damping"] > 0);
}

/// `lariat static` finds the critical angle of a cable in a cross flow; without section shape the table names the diameter.
///
/// *Source.* f cos^2 a = w sin a, a from the vertical, tangential drag zero (Pode 1951; Berteaux 1976).
#[test]
fn statics_of_a_scene_see_the_flow() {
    let text = r#"
[[cable]]
name = "line"
points = [[0.0, 0.0, 0.0], [0.0, -10.0, 0.0]]
axial_stiffness = 1.0e5
bending_stiffness = 0.0
mass_per_length = 0.2
rule = "G5-none"
[cable.drag]
fluid_density = 1000.0
normal = 1.2
tangential = 0.0
diameter = 0.01
flow = [0.5, 0.0, 0.0]
[[attachment]]
cable = "line"
at = "start"
body = "world"
[[probe]]
name = "p"
cable = "line"
at = 5.0
"#;
    let (_, rows) = results("static", text, Purpose::Static);
    let (w, f): (f64, f64) = (0.2 * 9.81, 0.5 * 1000.0 * 0.01 * 1.2 * 0.25);
    let sine = (-w + (w * w + 4.0 * f * f).sqrt()) / (2.0 * f);
    let (sx, sy) = (rows[0][7], rows[0][8]);
    assert!((sx / (sx * sx + sy * sy).sqrt() - sine).abs() < 1e-4, "{sx} {sy} {sine}");
}
