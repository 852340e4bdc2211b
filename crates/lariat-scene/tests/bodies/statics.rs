//! `lariat static` of scenes with bodies: they hang where forces and moments balance.

use lariat_ancf::Vector3;
use lariat_scene::run::{self, Summary};
use lariat_scene::{Error, Purpose, Scene, Warning};
use nalgebra::UnitQuaternion;

const ROPE: &str = r#"
section = { square = 0.01 }
density = 4000.0
youngs_modulus = 1000000000.0
"#;

pub(super) fn solve(text: &str) -> Result<(Summary, Vec<String>), Error> {
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::parse("statics.toml", text, &[], Purpose::Static)?;
    let summary = run::statics(&scene, folder.path(), &mut run::Options::default())?;
    let probes = scene.probes.iter().map(|p| folder.path().join("probes").join(format!("{}.csv", p.name)));
    Ok((summary, probes.map(|path| std::fs::read_to_string(path).unwrap()).collect()))
}

/// The last row of a probe.
pub(super) fn row(csv: &str) -> Vec<f64> {
    csv.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect()
}

/// A box of 50 kg, drawn beside the place where it hangs.
fn hung_box(rest: &str) -> String {
    format!(
        r#"
[[body]]
name = "box"
shape = {{ cuboid = [0.1, 0.1, 0.1] }}
mass = 50.0
position = [0.3, -2.0, 0.1]
[[cable]]
name = "c"
points = [[0.0, 0.0, 0.0], [0.3, -1.9, 0.1]]
length = 2.0
{ROPE}
[[attachment]]
name = "p"
cable = "c"
at = "start"
body = "world"
[[attachment]]
name = "hook"
cable = "c"
at = "end"
body = "box"
anchor = [0.0, 0.1, 0.0]
[[probe]]
name = "hook"
attachment = "hook"
[[probe]]
name = "place"
body = "box"
{rest}"#
    )
}

/// *Source.* The hook carries the box, the top box and cable; the Green law stretches the cable by (m + mu L/2) g L/EA, 1e-2 of
/// it.
#[test]
fn a_box_hangs_below_its_support() {
    let (summary, probes) = solve(&hung_box("")).unwrap();
    let hook = row(&probes[0]);
    assert!((hook[2] / (50.0 * 9.81) - 1.0).abs() < 1e-6 && hook[1].abs() < 1e-4 && hook[7] < 1e-9, "{hook:?}");
    let place = row(&probes[1]);
    let stretch = (50.0 + 0.4) * 9.81 * 2.0 / 1e5;
    assert!(place[1].abs() < 1e-6 && (place[2] + 2.1 + stretch).abs() < 3e-4, "{place:?}");
    let statics = &summary.statics.as_ref().unwrap()[0];
    assert!(statics.stable && (statics.reactions[0].force_n[1] / (-50.8 * 9.81) - 1.0).abs() < 1e-6, "{statics:?}");
    let bodies = summary.static_bodies.unwrap();
    assert!(bodies.moved[0].name == "box" && bodies.held.is_empty() && summary.warnings.is_empty(), "{bodies:?}");
}

/// 1000 kg on two slings at 60 degrees; and with supports apart, a load at a point of it that moves, tilts and turns it.
///
/// *Source.* T = W/(2 sin 60). Force and moment balance of the body: the hooks carry weight and load, and their moments about the centre
/// of mass are opposite to that of the load at its point.
#[test]
fn a_load_on_two_slings_balances_with_loads_at_its_points() {
    let text = |top: f64, loads: &str| {
        let sling = |name: &str, x: f64| {
            format!(
                "[[cable]]\nname = \"{name}\"\npoints = [[{:?}, 0.0, 0.0], [{x:?}, -1.7320508075688772, 0.0]]\nelements = 5\n\
                 axial_stiffness = 5.0e6\nbending_stiffness = 1.0\nmass_per_length = 0.6\n\
                 [[attachment]]\ncable = \"{name}\"\nat = \"start\"\nbody = \"world\"\n\
                 [[attachment]]\nname = \"{name}\"\ncable = \"{name}\"\nat = \"end\"\nbody = \"load\"\n\
                 [[probe]]\nname = \"{name}\"\nattachment = \"{name}\"\n",
                top * x
            )
        };
        format!(
            "[[body]]\nname = \"load\"\nshape = {{ cuboid = [1.2, 0.3, 0.5] }}\nmass = 1000.0\n\
             position = [0.0, -2.032050807568877, 0.0]\n{}{}{loads}",
            sling("left", -1.0),
            sling("right", 1.0)
        )
    };
    let (summary, probes) = solve(&text(0.0, "")).unwrap();
    for probe in &probes {
        let force = row(probe);
        let size = force[1].hypot(force[2]);
        let expected = 1000.0 * 9.81 / (2.0 * 60f64.to_radians().sin());
        assert!((size / expected - 1.0).abs() < 2e-3 && force[7] < 1e-9, "{size} N of {expected}");
    }
    assert!(summary.static_bodies.unwrap().moved[0].rotation_rad.iter().all(|x| x.abs() < 1e-6));
    let load = "[[load]]\nbody = \"load\"\npoint = [0.5, 0.2, 0.1]\nforce = [300.0, 0.0, 50.0]\nramp = 2.0\n";
    let (summary, probes) = solve(&text(0.3, load)).unwrap();
    let (left, right) = (row(&probes[0]), row(&probes[1]));
    let rotation =
        UnitQuaternion::from_scaled_axis(Vector3::from(summary.static_bodies.unwrap().moved[0].rotation_rad));
    assert!(rotation.angle() > 1e-3, "{rotation:?}");
    let hooks = [(&left, [-1.0, 0.3, 0.0]), (&right, [1.0, 0.3, 0.0])];
    let (mut force, mut moment) = (Vector3::new(0.0, -9810.0, 0.0), Vector3::zeros());
    let forces = hooks.map(|(row, at)| (Vector3::new(row[1], row[2], row[3]), Vector3::from(at)));
    for (f, at) in forces.into_iter().chain([(Vector3::new(300.0, 0.0, 50.0), Vector3::new(0.5, 0.2, 0.1))]) {
        force += f;
        moment += (rotation * at).cross(&f);
    }
    // Rapier holds the attitude, and so the lever, in single precision
    assert!(force.norm() < 1e-3 && moment.norm() < 1e-2, "{force:?} {moment:?}");
}

/// A plank on two ropes that are drawn past it, with contact and without, is found in the same place, 0.4 m below where they hold it.
///
/// *Source.* Both halves of a rope are straight under a load of 32 times its weight, to 1 % of the sag.
#[test]
fn a_plank_is_found_that_its_ropes_are_not_drawn_to() {
    let rope = |z: f64, contact: &str| {
        let end = |at: &str, body: &str, anchor: String| {
            format!("[[attachment]]\ncable = \"r{z}\"\nat = {at}\nbody = \"{body}\"\n{anchor}")
        };
        format!(
            "[[cable]]\nname = \"r{z}\"\npoints = [[0.0, 0.0, {z:?}], [6.0, 0.0, {z:?}]]\nlength = 6.4\nelements = 16\nsection = {{ round = 0.03 }}\n\
             density = 1400.0\nyoungs_modulus = 2e9\n{contact}{}{}{}",
            end("\"start\"", "world", String::new()),
            end("\"end\"", "world", String::new()),
            end("3.2", "plank", format!("anchor = [0.0, 0.4, {z:?}]\n"))
        )
    };
    let scene = |contact: &str| {
        let plank = "[[body]]\nname = \"plank\"\nshape = { cuboid = [0.2, 0.02, 0.6] }\nmass = 400.0\nposition = [3.1, -1.2, 0.0]\n";
        format!("{plank}{}{}[[probe]]\nname = \"place\"\nbody = \"plank\"\n", rope(-0.5, contact), rope(0.5, contact))
    };
    let place = |contact: &str| row(&solve(&scene(contact)).unwrap().1[0]);
    let (without, with) = (place(""), place("contact = { friction = 0.4 }\n"));
    println!("{without:?}\n{with:?}");
    let sag = (3.2f64.powi(2) - 3.0f64.powi(2)).sqrt();
    assert!((without[1] - 3.0).abs() < 1e-6 && (without[2] + 0.4 + sag).abs() < 0.01 * sag, "{without:?}");
    assert!(without.iter().zip(&with).all(|(a, b)| (a - b).abs() < 1e-6), "{without:?} and {with:?}");
}

/// A box that reaches the floor rests on it by its motion; with a ball that rolls off the edge of the floor the world never rests, and what
/// touches is named.
///
/// *Source.* The contract.
#[test]
fn what_touches_comes_to_rest_or_is_named_and_held_bodies_are_named() {
    let floor = "[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = { cuboid = [2.0, 0.1, 2.0] }\nposition = [0.0, -2.3, 0.0]\n";
    let (summary, _) = solve(&hung_box(floor)).unwrap();
    let bodies = summary.static_bodies.unwrap();
    assert!(bodies.relaxation_steps.is_some() && (bodies.moved[0].position_m[1] + 2.1).abs() < 2e-3, "{bodies:?}");
    let falls = "[[body]]\nname = \"ball\"\nshape = { ball = 0.1 }\nmass = 1.0\nposition = [9.0, 0.0, 0.0]\n";
    match solve(&hung_box(&format!("{floor}{falls}"))) {
        Err(Error::Body { body, problem, .. }) => {
            assert!(body == "box" && problem.contains("touches body \"floor\""), "{problem}")
        }
        outcome => panic!("{:?}", outcome.map(|(summary, _)| summary)),
    }
    let others = "[[body]]\nname = \"mast\"\nkind = \"fixed\"\nshape = \"none\"\nposition = [1.0, 0.0, 0.0]\n\
                  [[body]]\nname = \"bystander\"\nshape = { ball = 0.1 }\nmass = 1.0\nposition = [9.0, 0.0, 0.0]\n\
                  [[attachment]]\ncable = \"c\"\nat = 1.0\nbody = \"mast\"\nanchor = [-0.5, -0.5, 0.0]\n";
    let (summary, _) = solve(&hung_box(others)).unwrap();
    let bodies = summary.static_bodies.unwrap();
    assert_eq!((bodies.held, bodies.unattached), (vec!["mast".to_string()], vec!["bystander".to_string()]));
    assert_eq!(summary.warnings, [Warning::LeftAsDrawn { body: "bystander".to_string() }]);
}

/// A mooring line of 850 m on its seabed: anchor at the origin, fairlead at 780 m, 186 m up.
fn mooring(elements: usize, effects: &str) -> String {
    format!(
        r#"
duration = 10.0
dt = 0.05
[[body]]
name = "bed"
kind = "fixed"
shape = {{ plane = [0.0, 1.0, 0.0] }}
friction = 0.5
[[cable]]
name = "line"
points = [[0.0, 0.05, 0.0], [500.0, 0.05, 0.0], [780.0, 186.05, 0.0]]
length = 850.0
elements = {elements}
axial_stiffness = 7.536e8
bending_stiffness = 0.0
mass_per_length = 113.35
initial = "equilibrium"
[cable.contact]
radius = 0.05
friction = 0.5
{effects}
[[attachment]]
name = "anchor"
cable = "line"
at = "start"
body = "world"
[[attachment]]
name = "fairlead"
cable = "line"
at = "end"
body = "world"
[[probe]]
name = "fairlead"
attachment = "fairlead"
[[probe]]
name = "middle"
cable = "line"
at = 600.0
"#
    )
}

fn start_and_run(text: &str) -> (Summary, Vec<Vec<Vec<f64>>>) {
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::parse("run.toml", text, &[], Purpose::Run).unwrap();
    let summary = run::run(&scene, folder.path(), &mut run::Options::default()).unwrap();
    let read = |p: &lariat_scene::scene::probe::ProbeScene| {
        let path = folder.path().join("probes").join(format!("{}.csv", p.name));
        let text = std::fs::read_to_string(path).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
    };
    let rows = scene.probes.iter().map(read).collect();
    (summary, rows)
}

/// `initial = "equilibrium"` knows the seabed, with and without a current: the line starts where
/// `lariat static` finds it, with the tension of the catenary, and stays there.
///
/// *Source.* The elastic catenary with touchdown: 467 786 N at the fairlead
/// (tests/contact/statics.rs of lariat-ancf); Newton's first law.
#[test]
fn a_mooring_line_starts_at_rest_on_its_seabed() {
    for effects in ["", "[cable.drag]\nfluid_density = 1025.0\ndiameter = 0.153\nflow = [0.0, 0.0, 1.0]\n"] {
        let text = mooring(40, effects);
        let (found, probes) = solve(&text).unwrap();
        let (summary, rows) = start_and_run(&text);
        let tension = |row: &[f64]| Vector3::new(row[1], row[2], row[3]).norm();
        let (first, last) = (&rows[0][0], rows[0].last().unwrap());
        let still = row(&probes[0]);
        println!("static {:.1} N, start {:.1} N, end {:.1} N", tension(&still), tension(first), tension(last));
        // the two searches begin from different shapes, and end where the residual is within 1e-9
        // of the loads
        assert!((tension(first) / tension(&still) - 1.0).abs() < 1e-6);
        if effects.is_empty() {
            assert!((tension(first) / 467_786.0 - 1.0).abs() < 1e-3, "{}", tension(first));
        }
        let (a, b) = (&rows[1][0], rows[1].last().unwrap());
        let moved = (0..3).map(|x| (a[1 + x] - b[1 + x]).abs()).fold(0.0, f64::max);
        println!("moved {moved:.1e} m in 10 s, {:?}", summary.warnings);
        assert!(moved < 1e-6, "{moved}");
        for warnings in [&found.warnings, &summary.warnings] {
            let inside = |w: &Warning| matches!(w, Warning::StartsInside { .. });
            assert!(!warnings.iter().any(inside), "{warnings:?}");
        }
    }
}
