//! The effect tables of a scene, against independent values.

use lariat_scene::{Purpose, Scene, run};
use std::path::PathBuf;

/// Runs a scene and returns its summary and the rows of one probe.
fn results(name: &str, text: &str, purpose: Purpose) -> (run::Summary, Vec<Vec<f64>>) {
    let out: PathBuf = std::env::temp_dir().join(format!("lariat-effects-{name}-{}", std::process::id()));
    let scene = Scene::parse("effects.toml", text, &[], purpose).unwrap();
    let summary = match purpose {
        Purpose::Run | Purpose::Resume => run::run(&scene, &out, &mut run::Options::default()).unwrap(),
        Purpose::Static => run::statics(&scene, &out, &mut run::Options::default()).unwrap(),
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

/// A free horizontal cable falls with v = v_T tanh(g t/v_T), v_T^2 = 2 w/(rho d C_n); the energy taken by drag is in `dissipated`.
///
/// *Source.* Free fall with quadratic drag; conservation of energy.
#[test]
fn drag_of_a_scene_slows_a_falling_cable_and_is_in_the_energy_balance() {
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

/// A neutrally buoyant cable stays at rest, and every effect that is on has its entry.
///
/// *Source.* Archimedes.
#[test]
fn buoyancy_of_a_scene_balances_the_weight() {
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

/// Runs a scene and returns the last row of its probe, and the effects that it counts.
fn last(name: &str, text: &str) -> (Vec<f64>, Vec<String>) {
    let (summary, mut rows) = results(name, text, Purpose::Run);
    (rows.pop().unwrap(), summary.effect_evaluations.into_keys().collect())
}

/// A free cable falls with half of gravity and is accelerated by its line load.
///
/// *Source.* Uniform acceleration, 1/2 (scale g + f/m) t^2.
#[test]
fn gravity_scale_and_line_load_of_a_scene_accelerate_a_free_cable() {
    let text = format!(
        "{CABLE}gravity_scale = 0.5\n[[cable.line_load]]\nforce = [0.0, 0.0, 0.3]\n\
         [[probe]]\nname = \"p\"\ncable = \"line\"\nat = 1.0\n"
    );
    let (end, effects) = last("accelerated", &text);
    let mass = 4000.0 * std::f64::consts::FRAC_PI_4 * 1e-4;
    assert!((end[2] + 0.5 * 0.5 * 9.81 * 4.0).abs() < 1e-6, "{end:?}");
    assert!((end[3] - 0.5 * 0.3 / mass * 4.0).abs() < 1e-6, "{end:?}");
    assert_eq!(effects, ["gravity_scale", "line_load"]);
}

/// A cantilever under a force per length on its outer half, by `lariat static`.
///
/// *Source.* 41 q L^4/(384 EI) (superposition of Timoshenko 1930).
#[test]
fn a_line_load_of_a_scene_bends_a_cantilever() {
    let text = r#"
gravity = [0.0, 0.0, 0.0]
[[cable]]
name = "rod"
points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
axial_stiffness = 1.0e4
bending_stiffness = 1.0
mass_per_length = 1.0
[[cable.line_load]]
from = 0.5
force = [0.0, 0.0, 1e-3]
[[attachment]]
cable = "rod"
at = "start"
body = "world"
kind = "clamp"
[[probe]]
name = "p"
cable = "rod"
at = "end"
"#;
    let (_, rows) = results("cantilever", text, Purpose::Static);
    let expected = 41e-3 / 384.0;
    assert!((rows[0][3] / expected - 1.0).abs() < 1e-4, "{:?}", rows[0]);
}

/// A cable held at its unstretched length with a stress-free stretch of 0.98 is under tension; one with a stress-free curvature takes it.
///
/// *Source.* N = EA (1 - f_0^2)/2 at stretch 1 (the Green law); an elastic rod without load has its natural curvature.
#[test]
fn the_rest_shape_of_a_scene_is_taken_or_causes_tension() {
    let text = r#"
duration = 0.1
gravity = [0.0, 0.0, 0.0]
[[cable]]
name = "string"
points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
axial_stiffness = 1.0e4
bending_stiffness = 1e-4
mass_per_length = 0.1
[cable.rest_shape]
stretch = 0.98
[[attachment]]
cable = "string"
at = "start"
body = "world"
[[attachment]]
cable = "string"
at = "end"
body = "world"
[[probe]]
name = "p"
cable = "string"
at = 0.37
"#;
    let (end, effects) = last("string", text);
    let expected = 1e4 * 0.5 * (1.0 - 0.98 * 0.98);
    assert!((end[10] / expected - 1.0).abs() < 1e-9, "{end:?}");
    assert_eq!(effects, ["rest_shape"]);
    // drawn finely: corners of a coarse polyline may stay as wrinkles, which no curvature without direction resists
    let k = 1.6f64;
    let arc = |s: f64| [(k * s).sin() / k, (1.0 - (k * s).cos()) / k, 0.0];
    let points: Vec<_> = (0..=200).map(|i| arc(f64::from(i) / 200.0)).collect();
    let rod = |rest: &str| {
        format!(
            "duration = 3.0\ngravity = [0.0, 0.0, 0.0]\n[[cable]]\nname = \"rod\"\npoints = {points:?}\nlength = 1.0\n\
             axial_stiffness = 1e5\nbending_stiffness = 1.0\nmass_per_length = 1.0\nelements = 20\n[cable.damping]\nbending = 0.05\n\
             {rest}[[probe]]\nname = \"p\"\ncable = \"rod\"\nat = 0.775\n"
        )
    };
    let pieces = "[[cable.rest_shape.piece]]\nfrom = 0.0\ncurvature = 1.5\n\
                  [[cable.rest_shape.piece]]\nfrom = 0.5\ncurvature = 1.2\n";
    for rest in ["[cable.rest_shape]\ncurvature = 1.2\n", pieces] {
        let (end, _) = last("rod", &rod(rest));
        assert!((end[11] / 1.2 - 1.0).abs() < 5e-4 && end[12].abs() < 5e-4, "{rest}: {end:?}");
    }
}

/// A free cable is accelerated by a wind after the power law at its height, and by a wind that grows with time.
///
/// *Source.* v' = k (u - v)^2 with k = rho d C_n/(2 m): v = u - u/(1 + k u t) for a steady wind; for u = a t,
/// v = a t - sqrt(a/k) tanh(sqrt(a k) t).
#[test]
fn the_wind_of_a_scene_changes_with_height_and_time() {
    let run = |name: &str, flow: &str| {
        let text = format!(
            "duration = 2.0\ngravity = [0.0, 0.0, 0.0]\n[[cable]]\nname = \"line\"\npoints = [[0.0, 40.0, 0.0], [2.0, 40.0, 0.0]]\n\
             section = {{ round = 0.01 }}\ndensity = 1000.0\nyoungs_modulus = 1.0e8\nelements = 4\n\
             [cable.drag]\nfluid_density = 1.2\nnormal = 1.1\nflow = {flow}\n\
             [[probe]]\nname = \"p\"\ncable = \"line\"\nat = 1.0\n"
        );
        last(name, &text).0[6]
    };
    let k = 1.2 * 0.01 * 1.1 / (2.0 * 1000.0 * std::f64::consts::FRAC_PI_4 * 1e-4);
    let law = "{ velocity = [0, 0, 10], power_law = { reference = 10, exponent = 0.14, top = 100 } }";
    let u = 10.0 * 4.0f64.powf(0.14);
    let expected = u - u / (1.0 + k * u * 2.0);
    let found = run("law", law);
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    let table =
        "{ velocity = [0, 0, 2], profile = { up = [0, 2, 0], rows = [[0, 1], [80, 3]] }, history = [[0, 0], [2, 5]] }";
    let a = 2.0 * 2.0 * 2.5;
    let expected = a * 2.0 - (a / k).sqrt() * ((a * k).sqrt() * 2.0).tanh();
    let found = run("table", table);
    assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
}

/// Damping by the kind of rope is the damping that the mechanics give it; a misspelt kind is answered with the nearest, and a kind
/// beside times is a conflict.
///
/// *Source.* `RopeKind::damping` for the same section and length, itself tested against the logarithmic decrement.
#[test]
fn damping_by_the_kind_of_rope() {
    let text = |damping: &str| {
        format!(
            "duration = 1.0\n[[cable]]\nname = \"c\"\npoints = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]]\naxial_stiffness = 1.0e6\n\
             bending_stiffness = 2.0\nmass_per_length = 0.5\ndamping = {{ {damping} }}\n"
        )
    };
    let read = |damping: &str| Scene::parse("rope.toml", &text(damping), &[], Purpose::Run);
    let section = lariat_ancf::Section::from_stiffness(1e6, 2.0, 0.5).unwrap();
    for kind in lariat_ancf::RopeKind::ALL {
        let scene = read(&format!("rope = \"{kind}\"")).unwrap();
        assert_eq!(scene.cables[0].effects.damping, Some(kind.damping(&section, 3.0).unwrap()));
    }
    let misspelt = read("rope = \"wire_rope\"").unwrap_err().to_string();
    assert!(misspelt.contains("wire-rope") && misspelt.contains("Did you mean"), "{misspelt}");
    let both = read("rope = \"wire-rope\", axial = 0.1").unwrap_err().to_string();
    assert!(both.contains("both a kind of rope and times"), "{both}");
    assert!(read("").is_err());
}

const FLOOR: &str =
    "[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = { cuboid = [2.0, 0.1, 2.0] }\nposition = [1.0, -0.4, 0.0]\n";

/// A cable with contact falls on a fixed box and lies on it: what contact and damping took of its energy is `dissipated`. Its integrator is that of games.
///
/// *Source.* Geometry: the top of the box is at -0.3 m, the radius 5 mm; conservation of energy.
#[test]
fn contact_of_a_scene_holds_a_cable_on_a_floor() {
    let text = format!(
        "{CABLE}[cable.damping]\naxial = 1e-3\nbending = 1e-3\n[cable.contact]\nfriction = 0.3\n{FLOOR}\
         [[probe]]\nname = \"p\"\nenergy = \"line\"\n[[probe]]\nname = \"end\"\ncable = \"line\"\nat = \"end\"\n"
    );
    let (summary, rows) = results("contact", &text, Purpose::Run);
    let mass = 2.0 * 4000.0 * std::f64::consts::FRAC_PI_4 * 1e-4;
    let end = rows.last().unwrap();
    let (lost, fall) = (rows[0][7] - end[7], mass * 9.81 * 0.295);
    assert!((lost / fall - 1.0).abs() < 1e-3, "{lost} {fall}");
    // the rest is numerical: the impact excites what the steps do not resolve
    assert!(end[5] > 0.3 * lost && end[5] < 1.001 * lost && end[1] < 1e-6, "{end:?}");
    assert!(summary.effect_evaluations["contact"] > 0);
    // an impact is not elastic: integration damps what it does not resolve, and may say so
    let told = |warning: &lariat_scene::Warning| matches!(warning, lariat_scene::Warning::EnergyLost { .. });
    assert!(summary.warnings.iter().all(told), "{:?}", summary.warnings);
}

/// `self_contact` stands for `cables` and `itself`, each of which wins where it is given; a scene without bodies gets an engine for them.
///
/// *Source.* The contract of the scene file.
#[test]
fn self_contact_is_contact_with_cables_and_with_itself() {
    let cases = [
        ("", [false, false]),
        ("self_contact = false", [false, false]),
        ("self_contact = true", [true, true]),
        ("self_contact = true\nitself = false", [true, false]),
        ("self_contact = true\ncables = false", [false, true]),
        ("self_contact = false\ncables = true", [true, false]),
        ("itself = true", [false, true]),
    ];
    let read = |keys: &str| {
        let text = format!("{CABLE}[cable.contact]\n{keys}\n");
        Scene::parse("rope.toml", &text, &[], Purpose::Run)
    };
    for (keys, [cables, itself]) in cases {
        let scene = read(keys);
        if !(cables || itself) {
            let nothing = scene.unwrap_err().to_string();
            assert!(nothing.contains("nothing that the cable could touch"), "{keys}: {nothing}");
            continue;
        }
        let contact = scene.unwrap().cables[0].effects.contact.unwrap();
        assert_eq!([contact.cables, contact.itself], [cables, itself], "{keys}");
    }
    let wrong = read("self_contact = 1").unwrap_err().to_string();
    assert!(wrong.contains("self_contact"), "{wrong}");
}

/// Without contact the same cable passes through the floor, and is told once, with the time; with it, it rests on one that is a dynamic body.
///
/// *Source.* Free fall of 0.3 m takes 0.247 s, and a radius more 0.25 s.
#[test]
fn a_cable_that_passes_through_a_body_is_told_once() {
    use lariat_scene::Warning;
    let dynamic = FLOOR.replace("kind = \"fixed\"", "mass = 1.0\nangular_velocity = [0.0, 0.0, 0.0]");
    let resting = "[[body]]\nname = \"ground\"\nkind = \"fixed\"\nshape = { cuboid = [2.0, 0.1, 2.0] }\nposition = [1.0, -0.6, 0.0]\n";
    for (contact, bodies) in [(false, FLOOR.to_string()), (true, dynamic + resting)] {
        let table = if contact { "[cable.contact]\n" } else { "" };
        let text = format!(
            "{}{table}{bodies}[[probe]]\nname = \"p\"\ncable = \"line\"\nat = \"end\"\n",
            CABLE.replace("duration = 2.0", "duration = 0.4")
        );
        let (summary, _) = results("passing", &text, Purpose::Run);
        let passes: Vec<_> = summary.warnings.iter().filter(|w| matches!(w, Warning::PassesThrough { .. })).collect();
        if contact {
            assert!(passes.is_empty(), "{passes:?}");
            continue;
        }
        let [Warning::PassesThrough { cable, body, time_s }] = passes[..] else { panic!("{:?}", summary.warnings) };
        assert_eq!((cable.as_str(), body.as_str()), ("line", "floor"));
        assert!((0.24..0.28).contains(time_s), "{time_s}");
    }
}

/// A rope that falls flat on a body bounces to e^2 times the height of its fall, e the mean of both coefficients; off another, which gives none, it does not.
///
/// *Source.* Newton's law of restitution, free fall; the error of a step of 1/480 s is below 2 %.
#[test]
fn restitution_of_a_scene_lets_a_rope_bounce() {
    for (own, body, height) in [(0.6, 0.8, 0.49 * 0.5), (0.0, 0.0, 0.0)] {
        let text = format!(
            "{CABLE}integrator = {{ method = \"discrete-gradient\", max_step = 2.0833333333333333e-3 }}\n\
             [cable.contact]\nfriction = 0.3\nrestitution = {own}\n\
             [[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = {{ cuboid = [3.0, 0.1, 3.0] }}\nposition = [0.0, -0.605, 0.0]\nrestitution = {body}\n\
             [[probe]]\nname = \"p\"\ncable = \"line\"\nat = \"end\"\n"
        );
        let text = text.replace("duration = 2.0", "duration = 0.65");
        let (_, rows) = results(&format!("restitution{own}"), &text, Purpose::Run);
        let fallen = rows.iter().position(|row| row[2] < -0.49).unwrap();
        let top = rows[fallen + 8..].iter().map(|row| row[2] + 0.5).fold(f64::MIN, f64::max);
        assert!((top - height).abs() < 0.02 * height + 2e-3, "{own}, {body}: {top} for {height}");
    }
    let text = format!("{CABLE}[cable.contact]\nrestitution = 1.2\n");
    let error = Scene::parse("effects.toml", &text, &[], Purpose::Run).unwrap_err().to_string();
    assert!(error.contains("restitution") && error.contains("from 0 to 1"), "{error}");
}

/// A hanging load strains a rope by its axial law, and a point may be written as a share of the length.
///
/// *Source.* The law: 1000 N at EA = 1e4 N is a strain of 0.1; a row of the curve.
#[test]
fn an_axial_law_of_a_scene_strains_a_rope_by_its_rows() {
    for law in ["\"hooke\"", "\"rope\"", "{ curve = [[0.0, 0.0], [0.1, 1000.0], [0.2, 1800.0]] }"] {
        let text = format!(
            "gravity = [0.0, 0.0, 0.0]\n[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]\n\
             axial_stiffness = 1.1e4\nbending_stiffness = 0.1\nmass_per_length = 0.1\naxial_law = {law}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"0 %\"\nbody = \"world\"\n\
             [[load]]\ncable = \"rope\"\nat = \"100%\"\nforce = [0.0, -1000.0, 0.0]\n\
             [[probe]]\nname = \"p\"\ncable = \"rope\"\nat = \"50 %\"\n"
        );
        let (_, rows) = results("law", &text, Purpose::Static);
        let strain = if law.starts_with('{') { 0.1 } else { 1000.0 / 1.1e4 };
        assert!((rows[0][2] + 1.0 + strain).abs() < 1e-9, "{law}: {:?}", rows[0]);
        let refused = text.replace("\"50 %\"", "\"150 %\"");
        assert!(Scene::parse("effects.toml", &refused, &[], Purpose::Static).is_err());
    }
}

/// A clamp holds the direction that is given, in the axes of its body.
#[test]
fn a_clamp_of_a_scene_has_a_direction() {
    let text = format!(
        "{CABLE}length = 2.2\n[[body]]\nname = \"post\"\nkind = \"fixed\"\nshape = \"none\"\nrotation = [0.0, 0.0, 0.5]\n\
         [[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"post\"\nkind = \"clamp\"\ndirection = [2.0, 0.0, 0.0]\n\
         [[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\n\
         [[probe]]\nname = \"p\"\ncable = \"line\"\nat = \"start\"\n"
    );
    let (_, rows) = results("direction", &text, Purpose::Run);
    // t, position, velocity, slope
    assert!(rows.iter().all(|row| (row[8].atan2(row[7]) - 0.5).abs() < 1e-6), "{:?}", rows[0]);
    let ball = text.replace("kind = \"clamp\"\n", "");
    assert!(Scene::parse("effects.toml", &ball, &[], Purpose::Run).is_err());
}
