//! Twisted cables in a scene.

use lariat_scene::run::{self, Options, Summary};
use lariat_scene::{Purpose, Scene};
use std::f64::consts::PI;

/// A ball of J = 2/5 m r^2 = 0.004 kg m^2 that hangs on a twisted rope of 1 m, GJ = 0.02 N m^2.
const HOOK: &str = r#"
duration = 12.0

[[body]]
name = "hook"
shape = { ball = 0.1 }
mass = 1.0
position = [0.0, 1.9, 0.0]

[[cable]]
name = "rope"
points = [[0.0, 3.0, 0.0], [0.0, 2.0, 0.0]]
axial_stiffness = 1e4
bending_stiffness = 0.026
mass_per_length = 0.01
elements = 4

[cable.torsion]
stiffness = 0.02
initial_twist = 0.25

[[attachment]]
cable = "rope"
at = "start"
body = "world"
kind = "clamp"

[[attachment]]
cable = "rope"
at = "end"
body = "hook"
anchor = [0.0, 0.1, 0.0]
kind = "clamp"

[[probe]]
name = "twist"
torsion = "rope"

[[probe]]
name = "energy"
energy = "all"
"#;

type Rows = Vec<Vec<f64>>;

/// Runs the scene with replacements; returns the rows of both probes.
fn run(replaced: &[(&str, &str)]) -> Result<(Summary, [Rows; 2]), String> {
    run_text(HOOK, ["twist", "energy"], replaced)
}

/// Runs a scene of assets/scenes, likewise.
fn run_asset(name: &str, probes: [&str; 2], replaced: &[(&str, &str)]) -> (Summary, [Rows; 2]) {
    let file = format!("{}/../../assets/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let (summary, rows) = run_text(&std::fs::read_to_string(file).unwrap(), probes, replaced).unwrap();
    assert!(summary.failed.is_none() && summary.warnings.is_empty(), "{name}: {summary:?}");
    (summary, rows)
}

fn run_text(text: &str, probes: [&str; 2], replaced: &[(&str, &str)]) -> Result<(Summary, [Rows; 2]), String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let text = replaced.iter().fold(text.to_string(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    std::fs::write(&file, text).unwrap();
    let scene = Scene::read(&file, &[] as &[String], Purpose::Run).map_err(|error| error.to_string())?;
    let out = folder.path().join("out");
    let summary = run::run(&scene, &out, &mut Options::default()).map_err(|error| error.to_string())?;
    let rows = |name: &str| -> Rows {
        let text = std::fs::read_to_string(out.join(format!("probes/{name}.csv"))).unwrap_or_default();
        text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
    };
    Ok((summary, probes.map(rows)))
}

/// The probe has twist, torque, rate and energy; the hook turns with the frequency of a torsional
/// pendulum, and the balance closes.
///
/// *Source.* sqrt(GJ/(L J)); conservation of energy.
#[test]
fn a_hook_of_a_scene_turns_on_its_rope() {
    let (summary, [twist, energy]) = run(&[]).unwrap();
    assert!(summary.failed.is_none(), "{summary:?}");
    for (all, own) in energy.iter().zip(&twist) {
        let [_, kinetic, axial, bending, gravity, _, _, total, torsion] = all[..] else { panic!("{all:?}") };
        assert!((torsion - own[4]).abs() < 1e-9 && torsion >= 0.0, "{all:?} {own:?}");
        assert!((kinetic + axial + bending + gravity + torsion - total).abs() < 1e-9, "{all:?}");
    }
    for row in &twist {
        let [_, torque, twist, rate, energy] = row[..] else { panic!("{row:?}") };
        assert!((torque - 0.02 * twist).abs() < 1e-9 && (rate - twist).abs() < 1e-9, "{row:?}");
        assert!((energy - 0.01 * twist * twist).abs() < 1e-9, "{row:?}");
    }
    let passages: Vec<f64> = twist
        .windows(2)
        .filter(|pair| pair[0][2] * pair[1][2] < 0.0)
        .map(|pair| pair[0][0] + pair[0][2] / (pair[0][2] - pair[1][2]) * (pair[1][0] - pair[0][0]))
        .collect();
    let count = passages.len() - 1;
    let (own, exact) = (PI * count as f64 / (passages[count] - passages[0]), f64::sqrt(0.02 / 0.004));
    println!("{own} of {exact} rad/s");
    assert!((own / exact - 1.0).abs() < 1e-4, "{own} of {exact} rad/s");
    let balance = summary.energy_balance.unwrap();
    assert!(balance.made() < 1e-6, "{balance:?}");
}

/// A motor turns the hook on, by a Poisson number with EI = 0.026 N m^2 for the same GJ, and
/// damping lets it rest.
///
/// *Source.* The turns of the motor, once it has stopped; damping of Kelvin-Voigt.
#[test]
fn a_motor_of_a_scene_turns_the_hook() {
    let motor = "poisson = 0.3\ndamping = 0.3\nstart = { rate = 0.5, from = 0.5, until = 1.5 }\n";
    let (summary, [twist, _]) = run(&[("stiffness = 0.02\ninitial_twist = 0.25", motor)]).unwrap();
    assert!(summary.failed.is_none(), "{summary:?}");
    let most = twist.iter().map(|row| row[2].abs()).fold(0.0, f64::max);
    let last = twist.last().unwrap();
    println!("{most} rad, {last:?}");
    assert!(most > 1.0 && last[2].abs() < 1e-2, "{most} {last:?}");
    let first = twist.iter().find(|row| row[2].abs() > 0.1).unwrap();
    assert!((first[1] / first[2] - 0.02).abs() < 1e-9, "{first:?}");
}

/// A motor with a course twists the rope by it while the hook is too heavy to follow.
///
/// *Source.* The rows, a parabola, less what the hook turns by: GJ/(L J) times the double integral of the
/// twist, 2 pi t^2/16, that is 0.2 pi t^4/96 for the hook of 100 kg, J = 0.4 kg m^2.
#[test]
fn a_motor_of_a_scene_has_a_course() {
    let motor = "stiffness = 0.02\nend = \"held\"\nstart = { rows = [[0.0, 0.0], [0.5, -0.015625], [1.0, -0.0625], [2.0, -0.25]] }\n";
    let heavy = ("mass = 1.0\n", "mass = 100.0\n");
    let short = ("duration = 12.0", "duration = 2.0");
    let stiff = ("axial_stiffness = 1e4", "axial_stiffness = 1e6");
    let (summary, [twist, _]) = run(&[("stiffness = 0.02\ninitial_twist = 0.25", motor), heavy, short, stiff]).unwrap();
    assert!(summary.failed.is_none(), "{summary:?}");
    for row in &twist {
        let t = row[0];
        let exact = PI * t * t / 8.0 - 0.05 * PI / 8.0 * t.powi(4) / 12.0;
        assert!((row[2] - exact).abs() < 2e-3 * (0.1 + exact), "{row:?} {exact}");
    }
}

/// Of a cable that no body holds the integrator may be another: it comes to where the discrete
/// gradient does.
///
/// *Source.* The discrete gradient, whose torsion is other code.
#[test]
fn a_cable_by_itself_may_have_another_integrator() {
    let text = r#"
duration = 0.5
engine = "none"

[[cable]]
name = "rope"
points = [[0.0, 0.0, 0.0], [0.5, -0.2, 0.1], [1.0, 0.0, 0.0]]
axial_stiffness = 200.0
bending_stiffness = 0.03
mass_per_length = 0.1
elements = 6

[cable.torsion]
stiffness = 0.02
initial_twist = 1.0
end = { rate = 1.0, from = 0.0, until = 1.0 }

[[attachment]]
cable = "rope"
at = "start"
body = "world"
kind = "clamp"

[[attachment]]
cable = "rope"
at = "end"
body = "world"
kind = "clamp"

[[probe]]
name = "twist"
torsion = "rope"

[[probe]]
name = "energy"
energy = "all"
"#;
    let twists = |integrator: &str| {
        let chosen = format!("elements = 6\nintegrator = {integrator}");
        let (_, [twist, _]) = run_text(text, ["twist", "energy"], &[("elements = 6", chosen.as_str())]).unwrap();
        println!("{integrator}: {:?}", twist.last());
        twist[twist.len() - 1].clone()
    };
    let [gradient, esdirk, explicit] = [
        "{ method = \"discrete-gradient\", substeps = 128 }",
        "{ method = \"esdirk4\", tolerance = 1e-6 }",
        "{ method = \"rkn4\", stable = 0.5 }",
    ]
    .map(twists);
    for other in [&esdirk, &explicit] {
        let apart = gradient.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 2e-2, "{gradient:?} {other:?}");
    }
}

/// What cannot be right is an error at its key, or a warning.
///
/// *Source.* The contract.
#[test]
fn what_is_wrong_with_torsion_in_a_scene_is_told() {
    let wrong = [
        ("\nstiffness = 0.02", "\nstiffness = 0.02\npoisson = 0.3", "Poisson"),
        ("\nstiffness = 0.02", "", "poisson"),
        ("\nstiffness = 0.02", "\npoisson = 0.7", "poisson"),
        ("\nstiffness = 0.02", "\nstiffness = -1.0", "stiffness"),
        ("\nstiffness = 0.02", "\nstiffness = 0.02\nstart = \"free\"", "start"),
        ("\nstiffness = 0.02", "\nstiffness = 0.02\nstart = { rate = 1.0, from = 2.0, until = 1.0 }", "stops before"),
        ("\nstiffness = 0.02", "\nstiffness = 0.02\nstart = { from = 2.0 }", "rows"),
        ("\nstiffness = 0.02", "\nstiffness = 0.02\nstart = { rate = 1.0, rows = [[0.0, 0.0]] }", "rate"),
        ("\nstiffness = 0.02", "\nstiffness = 0.02\nstart = { rows = [[1.0, 0.0], [0.0, 1.0]] }", "follows"),
        ("elements = 4\n", "elements = 4\nintegrator = { method = \"esdirk4\", tolerance = 1e-5 }\n", "torsion"),
        ("[cable.torsion]\nstiffness = 0.02\ninitial_twist = 0.25\n", "", "no torsion"),
    ];
    for (from, to, told) in wrong {
        match run(&[(from, to)]) {
            Err(error) => assert!(error.contains(told), "{to}: {error}"),
            Ok((summary, _)) => panic!("{to}: {summary:?}"),
        }
    }
    // statics turn the hook to where no torque is left, and it stays there
    let (_, [twist, _]) = run(&[("duration = 12.0", "duration = 12.0\ninitial = \"equilibrium\"")]).unwrap();
    assert!(twist.iter().all(|row| row[2].abs() < 1e-6), "{:?}", twist.last());
    let (summary, [twist, _]) = run(&[("kind = \"clamp\"", "kind = \"ball\"")]).unwrap();
    assert!(format!("{:?}", summary.warnings).contains("IdleTorsion"), "{:?}", summary.warnings);
    assert!(twist.iter().all(|row| row[1..] == [0.0; 4]));
}

/// A rope whose tension makes torque turns its hook; with a reel it is refused.
///
/// *Source.* k T L/GJ with the weight over the stretch.
#[test]
fn a_stranded_rope_of_a_scene_turns_its_hook() {
    let stranded = "\nstiffness = 0.02\ndamping = 0.3\ntorque_per_tension = 5e-4";
    let (summary, [twist, energy]) = run(&[("\nstiffness = 0.02\ninitial_twist = 0.25", stranded)]).unwrap();
    assert!(summary.failed.is_none(), "{summary:?}");
    let mean = twist[twist.len() - 300..].iter().map(|row| row[2]).sum::<f64>() / 300.0;
    let exact = -5e-4 * 9.81 / 0.02;
    println!("{mean} of {exact} rad");
    assert!((mean / exact - 1.0).abs() < 0.02, "{mean} {exact}");
    for (all, own) in energy.iter().zip(&twist) {
        assert!((all[8] - own[4]).abs() < 1e-9 && own[4] >= 0.0, "{all:?} {own:?}");
    }
    assert!(summary.energy_balance.unwrap().made() < 1e-6, "{:?}", summary.energy_balance);
    let reel = "elements = 4\nreel = { end = \"start\", rate = [[0.0, 0.1]] }\n";
    let error = run(&[("\nstiffness = 0.02\ninitial_twist = 0.25", stranded), ("elements = 4\n", reel)]).unwrap_err();
    assert!(error.contains("torque_per_tension"), "{error}");
}

/// The load of assets/scenes/hook.toml turns about where no torque is left, and comes to rest there.
///
/// *Source.* -k L (W + w L/2)/GJ; half of the period of a torsional pendulum, pi sqrt(L J/GJ), which damping shortens.
#[test]
fn the_load_of_the_hook_scene_rests_where_the_lay_has_no_torque() {
    let (_, [twist, _]) = run_asset("hook", ["twist", "energy"], &[]);
    let exact = -1.08e-3 * 5.0 * (981.0 + 0.5 * 0.55 * 9.81 * 5.0) / 8.0;
    let last = twist.last().unwrap();
    println!("{} of {exact} rad", last[2]);
    assert!((last[2] / exact - 1.0).abs() < 2e-3, "{last:?} {exact}");
    let through: Vec<f64> = twist
        .windows(2)
        .filter(|pair| (pair[0][2] - exact) * (pair[1][2] - exact) < 0.0)
        .map(|pair| pair[0][0])
        .collect();
    let half = PI * f64::sqrt(5.0 * 0.9 / 8.0);
    assert!(((through[3] - through[0]) / (3.0 * half) - 1.0).abs() < 0.08, "{through:?} {half}");
}

/// The pipe of assets/scenes/drill_string.toml lags behind its motor by J a L/GJ while it gains speed, and by M L/GJ
/// on the rock.
///
/// *Source.* Strength of materials; EI and GJ of the tube by its diameters.
#[test]
fn the_drill_string_is_twisted_by_the_torque_of_its_bit() {
    let (_, [twist, _]) = run_asset("drill_string", ["twist", "bit"], &[]);
    let gj = 2.1e11 * PI / 64.0 * (0.06f64.powi(4) - 0.05f64.powi(4)) / 1.3;
    let mean = |from: f64, to: f64| {
        let rows: Vec<f64> = twist.iter().filter(|row| from < row[0] && row[0] < to).map(|row| row[2]).collect();
        rows.iter().sum::<f64>() / rows.len() as f64
    };
    let (speeding, drilling) = (mean(2.0, 3.9), mean(14.0, 16.0));
    let exact = [7.5 * PI / 4.0 * 100.0 / gj, 300.0 * 100.0 / gj];
    println!("{speeding} {drilling} of {exact:?} rad");
    assert!((speeding / exact[0] + 1.0).abs() < 0.15, "{speeding} {exact:?}");
    assert!((drilling / exact[1] + 1.0).abs() < 3e-3, "{drilling} {exact:?}");
}

/// The hose of assets/scenes/hose.toml stays straight at 0.97 of Greenhill's torque, and kinks at 1.03 of it.
///
/// *Source.* Greenhill 1883: the least m = M L/EI at which a clamped rod under T L^2/EI = 10 is unstable, as the
/// experiment `twist` of cosseratbench 0.3.0 computes it from B w'''' - i M w''' - T w'' = 0: 10.42886.
#[test]
fn the_hose_kinks_at_the_torque_of_greenhill() {
    let critical = 10.42886 * 0.03 / 0.02 / (2.0 * PI);
    let way = |share: f64| {
        let turns = format!("[6.5, {0}], [7.0, {0}]", share * critical);
        let replaced = [("[6.5, 3.0], [7.0, 3.0]", turns.as_str()), ("duration = 12.0", "duration = 25.0")];
        let (_, [middle, _]) = run_asset("hose", ["middle", "twist"], &replaced);
        let off = |row: &Vec<f64>| row[2].hypot(row[3]);
        middle[middle.len() - 60..].iter().map(off).fold(0.0, f64::max)
    };
    let [below, above] = [0.97, 1.03].map(way);
    println!("{below} m, {above} m");
    assert!(below < 2e-3 && above > 0.1, "{below} {above}");
}

/// Statics keep the initial twist of a rope that bodies clamp: a fixed one, and one that a slider lets move along the rope alone; the rope held by
/// the world gives the same. So do runs that start in equilibrium, all together or rope by rope.
///
/// *Source.* A torsion spring: the torque GJ 2 pi n/L; a rope along a slack arc in a plane has it, too.
#[test]
fn statics_keep_the_twist_that_bodies_hold() {
    let slider = "[[joint]]\nkind = \"slider\"\nbody = \"chuck\"\nto = \"world\"\nat = [1.0, 0.0, 0.0]\naxis = [1.0, 0.0, 0.0]\n";
    let dynamic = "shape = \"none\"\nmass = 0.05\ninertia = [1e-4, 1e-4, 1e-4]\n";
    let shaft = |turns: f64, body: &str, joint: &str, head: &str, start: &str, end: &str| {
        format!(
            "gravity = [0.0, 0.0, 0.0]\nduration = 0.05\n{head}[[body]]\nname = \"chuck\"\n{body}position = [1.0, 0.0, 0.0]\n{joint}\
             [[cable]]\nname = \"rod\"\npoints = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\nelements = 8\naxial_stiffness = 2e4\nbending_stiffness = 0.05\n\
             mass_per_length = 0.1\ndamping = {{ axial = 0.01, bending = 0.02 }}\ntorsion = {{ stiffness = 0.04, initial_twist = {turns:?} }}\n{start}\
             [[attachment]]\ncable = \"rod\"\nat = \"start\"\nbody = \"world\"\nkind = \"clamp\"\n\
             [[attachment]]\ncable = \"rod\"\nat = \"end\"\nbody = \"{end}\"\nkind = \"clamp\"\n[[probe]]\nname = \"twist\"\ntorsion = \"rod\"\n"
        )
    };
    let fixed = "shape = \"none\"\nkind = \"fixed\"\n";
    let (all, own) = ("initial = \"equilibrium\"\n", "initial = \"equilibrium\"\n");
    // below 8.99 EI/L = 0.45 N m, at which a rod between clamps goes into a loop
    for turns in [0.2, 1.0, -1.6] {
        let expected = 0.04 * 2.0 * PI * turns;
        for (body, joint, head, start, end) in [
            (fixed, "", "", "", "chuck"),
            (dynamic, slider, "", "", "chuck"),
            (fixed, "", "", "", "world"),
            (fixed, "", all, "", "chuck"),
            (dynamic, slider, all, "", "chuck"),
            (fixed, "", "", own, "chuck"),
        ] {
            let text = shaft(turns, body, joint, head, start, end);
            let purpose = if head.is_empty() && start.is_empty() { Purpose::Static } else { Purpose::Run };
            let scene =
                Scene::parse("shaft.toml", &text, &[], purpose).unwrap_or_else(|error| panic!("{error}\n{text}"));
            let found = run::collect(&scene, purpose, &mut Options::default()).unwrap();
            let probe = &found.probes[0];
            for row in probe.rows.chunks(probe.columns.len()) {
                assert!((row[1] / expected - 1.0).abs() < 1e-4, "{turns} turns, {joint:?} {head:?} {start:?}: {row:?}");
            }
        }
    }
}
