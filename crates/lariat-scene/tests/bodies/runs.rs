//! Contact, statics, equilibrium at the start, probes between host times, failures.

use super::results::{Results, asset, free};
use lariat_scene::Warning;
use std::fs;

/// Returns a box on a slope of 0.5 rad (gravity is inclined instead), with the same friction on both.
fn slope(friction: f64, rest: &str) -> String {
    let (x, y) = (9.81 * 0.5f64.sin(), -9.81 * 0.5f64.cos());
    let body = format!(
        "shape = {{ cuboid = [0.2, 0.1, 0.2] }}\nmass = 3.0\nposition = [0.0, 0.1, 0.0]\nfriction = {friction}"
    );
    let floor = format!(
        "[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = {{ plane = [0.0, 1.0, 0.0] }}\nfriction = {friction}\n"
    );
    free(&body, &floor).replace("gravity = [0.0, 0.0, 0.0]", &format!("gravity = [{x}, {y}, 0.0]\n{rest}"))
}

/// *Source.* Coulomb: at rest if the coefficient is above tan 0.5 = 0.546, else `x = g t^2 (sin a - mu cos a)/2`.
#[test]
fn a_box_on_a_slope_slides_if_its_friction_is_small() {
    let still = Results::of_text("run", &slope(0.65, "")).done().last("b");
    assert!(still[1].abs() < 5e-3 && (still[2] - 0.1).abs() < 2e-3, "{still:?}");
    let slides = Results::of_text("run", &slope(0.2, "")).done().last("b");
    let x = 0.5 * 9.81 * (0.5f64.sin() - 0.2 * 0.5f64.cos());
    assert!((slides[1] / x - 1.0).abs() < 2e-2 && (slides[2] - 0.1).abs() < 2e-3, "{slides:?}, {x}");
}

/// Every shape comes to rest on a plane and on a mesh at the height of its size; contacts in single precision penetrate by 1 mm.
#[test]
fn shapes_rest_at_their_height() {
    let folder = tempfile::tempdir().unwrap();
    let square = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 4 3 2\n";
    let corners: String = (0..8)
        .map(|i| {
            format!(
                "v {} {} {}\n",
                (i & 1) as f64 * 0.4 - 0.2,
                f64::from(i >> 1 & 1) * 0.3,
                f64::from(i >> 2) * 0.4 - 0.2
            )
        })
        .collect();
    fs::write(folder.path().join("square.obj"), square).unwrap();
    fs::write(folder.path().join("brick.obj"), corners + "f 1 2 3\nf 4 5 6\nf 6 7 8\n").unwrap();
    for (shape, height) in [
        ("cuboid = [0.2, 0.15, 0.1]", 0.15),
        ("ball = 0.2", 0.2),
        ("cylinder = [0.1, 0.2]", 0.1),
        ("mesh = \"brick.obj\"", 0.0),
    ] {
        for floor in ["plane = [0.0, 2.0, 0.0]", "mesh = \"square.obj\""] {
            let body = format!("shape = {{ {shape} }}\nmass = 3.0\nposition = [0.0, {}, 0.0]", height + 0.02);
            let floor = format!("[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = {{ {floor} }}\n");
            let text = free(&body, &floor).replace("gravity = [0.0, 0.0, 0.0]", "gravity = [0.0, -10.0, 0.0]");
            let file = folder.path().join("scene.toml");
            fs::write(&file, text).unwrap();
            let row = Results::of("run", &file, &[]).done().last("b");
            assert!((row[2] - height).abs() < 3e-3 && row[9].abs() < 1e-3, "{shape} on {floor}: {row:?}");
        }
    }
    // a capsule stands as high as half its length and its radius, until it tips over
    let floor = "[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = { plane = [0.0, 1.0, 0.0] }\n";
    let body = "shape = { capsule = [0.1, 0.2] }\nmass = 3.0\nposition = [0.0, 0.3, 0.0]";
    let text = free(body, floor).replace("gravity = [0.0, 0.0, 0.0]", "gravity = [0.0, -10.0, 0.0]");
    let row = Results::of_text("run", &text).done().last("b");
    assert!((row[2] - 0.3).abs() < 3e-3, "{row:?}");
}

#[test]
fn the_number_of_solver_iterations_reaches_rapier() {
    let run = |n: usize| Results::of_text("run", &slope(0.2, &format!("solver_iterations = {n}"))).done().last("b");
    assert_eq!(run(4), Results::of_text("run", &slope(0.2, "")).done().last("b"));
    assert_ne!(run(1), run(4));
}

#[test]
fn without_bodies_rapier_changes_nothing_but_its_steps() {
    let run = |engine: &str| {
        Results::of("run", &asset("falling_pendulum"), &[&format!("engine={engine}"), "duration=1.0"]).done()
    };
    let (alone, rapier) = (run("none"), run("rapier"));
    assert_eq!(alone.rows("tip").len(), rapier.rows("tip").len());
    for (a, b) in alone.rows("tip").iter().zip(rapier.rows("tip")) {
        // both tolerances are 1e-6 m in each host step
        assert!(a[0] == b[0] && (1..4).all(|i| (a[i] - b[i]).abs() < 2e-4), "{a:?} {b:?}");
    }
    assert_eq!(rapier.summary().simulated_s, 1.0);
}

/// A post and a ball at the ends of a slack cable; in statics both are held where they are drawn.
const CATENARY: &str = r#"
duration = 0.2
[[body]]
name = "post"
kind = "fixed"
shape = { cuboid = [0.1, 0.1, 0.1] }
position = [-0.1, 0.0, 0.0]
rotation = [0.0, 0.0, 0.5]
[[body]]
name = "ball"
shape = { ball = 0.1 }
mass = 2.0
position = [2.1, 0.5, 0.0]
[[cable]]
name = "line"
points = [[0.0, 0.0, 0.0], [2.0, 0.5, 0.0]]
length = 3.0
initial = "equilibrium"
elements = 40
axial_stiffness = 1.0e5
bending_stiffness = 1.0e-5
mass_per_length = 0.5
[[attachment]]
name = "left"
cable = "line"
at = "start"
body = "post"
[[attachment]]
name = "right"
cable = "line"
at = "end"
body = "ball"
[[probe]]
name = "middle"
cable = "line"
at = 1.5
[[probe]]
name = "ball"
body = "ball"
[[probe]]
name = "energy"
energy = "all"
"#;

/// The cable has the shape of the catenary scene between the same points, at the start; then the ball falls, and
/// the cable pulls it.
///
/// *Source.* The catenary scene, which is compared with the analytic catenary; free fall.
#[test]
fn a_start_from_equilibrium_holds_the_bodies_until_the_run_begins() {
    let catenary = Results::of("static", &asset("catenary"), &[]).done().last("middle");
    let run = Results::of_text("run", CATENARY).done();
    let middle = &run.rows("middle")[0];
    assert!((1..4).all(|i| (middle[i] - catenary[i]).abs() < 1e-8), "{middle:?} {catenary:?}");
    let (first, last) = (&run.rows("ball")[0], run.last("ball"));
    assert!((first[2] - 0.5).abs() < 1e-7 && first[8..11] == [0.0; 3], "{first:?}");
    let fallen = 0.5 - last[2];
    let free = 0.5 * 9.81 * 0.04;
    assert!(fallen > free && fallen < 1.3 * free, "{fallen} m of {free}");
    let energy = run.rows("energy");
    assert!((energy.last().unwrap()[7] - energy[0][7]).abs() < 1e-3, "{energy:?}");
}

/// *Source.* The same run without the probe, within its tolerance.
#[test]
fn probes_between_host_times_see_the_same_motion() {
    let probe = "\n[[probe]]\nname = \"often\"\nevery = 0.003\nbody = \"crate\"\n";
    let text =
        fs::read_to_string(asset("payload_pendulum")).unwrap().replace("duration = 2.0", "duration = 0.5") + probe;
    let often = Results::of_text("run", &text).done();
    let plain = Results::of("run", &asset("payload_pendulum"), &["duration=0.5"]).done();
    assert_eq!(often.rows("often").len(), 167);
    assert_eq!(often.rows("often")[7][0], 0.021);
    for (a, b) in often.rows("crate").iter().zip(plain.rows("crate")) {
        assert!(a[0] == b[0] && (1..3).all(|i| (a[i] - b[i]).abs() < 2e-4), "{a:?} {b:?}");
    }
}

#[test]
fn an_end_that_starts_at_another_velocity_than_its_body_is_a_warning() {
    let moving =
        Results::of("run", &asset("payload_pendulum"), &["body.crate.velocity=[1,0,0]", "duration=0.1"]).done();
    let warnings = moving.summary().warnings;
    assert!(
        matches!(&warnings[..], [Warning::VelocityJump { attachment, difference_m_s, .. }, ..]
            if attachment == "hook" && (difference_m_s - 1.0).abs() < 1e-6),
        "{warnings:?}"
    );
    for name in ["payload_pendulum", "dumbbell", "hoist"] {
        let warnings = Results::of("run", &asset(name), &["duration=0.1"]).done().summary().warnings;
        let jump = |w: &Warning| matches!(w, Warning::VelocityJump { .. });
        assert!(!warnings.iter().any(jump), "{name}: {warnings:?}");
    }
}

/// A taut, stiff, damped rope on an arm that turns, held at 40 m from the axis and at 0.4 m.
#[test]
fn rounding_that_pulls_at_a_rope_far_from_the_axis_is_a_warning() {
    for (x, warned) in [(40.0, true), (0.4, false)] {
        let attachment = |at: &str, x: f64| {
            format!("[[attachment]]\ncable = \"stay\"\nat = \"{at}\"\nbody = \"arm\"\nanchor = [{x:?}, 0.0, 0.0]\n")
        };
        let text = format!(
            "duration = 0.5\ndt = 0.01\ngravity = [0.0, 0.0, 0.0]\n[[body]]\nname = \"arm\"\nkind = \"kinematic\"\nshape = \"none\"\n\
             angular_velocity = [0.0, 0.0, 0.1]\n[[cable]]\nname = \"stay\"\npoints = [[{x:?}, 0.0, 0.0], [{:?}, 0.0, 0.0]]\n\
             length = 0.7999\naxial_stiffness = 3e6\nbending_stiffness = 0.1\nmass_per_length = 0.1\n\
             damping = {{ axial = 0.01, bending = 0.01 }}\n{}{}",
            x + 0.8,
            attachment("start", x),
            attachment("end", x + 0.8)
        );
        let results = Results::of_text("run", &text).done();
        let rounded = |w: &Warning| matches!(w, Warning::Cable(lariat_ancf::Warning::RoundedEnds { cable, .. }) if cable == "stay");
        let warnings = results.summary().warnings;
        assert_eq!(warnings.iter().any(rounded), warned, "{x}: {warnings:?}");
        assert_eq!(String::from_utf8_lossy(&results.output.stderr).contains("the rounding of what holds it"), warned);
    }
}

/// A load beyond the stability limit of an explicit method; a load beyond the single precision of a body.
#[test]
fn a_run_that_fails_exits_with_3_names_cable_or_body_and_time_and_keeps_its_samples() {
    let text = fs::read_to_string(asset("payload_pendulum")).unwrap();
    let pulled = text.clone() + "\n[[load]]\nbody = \"crate\"\nforce = [3.0e6, 0.0, 0.0]\nramp = 1.0\n";
    let pulled = pulled.replace("rule = ", "integrator = { method = \"verlet\", stable = 0.9 }\nrule = ");
    let shot = "\n[[body]]\nname = \"loose\"\nshape = \"none\"\nmass = 1e-10\n[[load]]\nbody = \"loose\"\nforce = [3e38, 0, 0]\nramp = 1.0\n";
    for (text, name) in [(pulled, "cable \"sling\""), (text + shot, "body \"loose\"")] {
        let results = Results::of_text("run", &text);
        let message = String::from_utf8_lossy(&results.output.stderr).into_owned();
        assert_eq!(results.output.status.code(), Some(3), "{message}");
        assert!(message.contains(name) && message.contains("t = "), "{message}");
        let summary = results.summary();
        assert_eq!(summary.failed.as_deref(), message.lines().last().map(|line| line.trim_start_matches("error: ")));
        assert!((results.last("crate")[0] - summary.simulated_s).abs() < 1e-9);
        assert!(results.rows("crate").iter().flatten().all(|x| x.is_finite()));
    }
}

#[test]
fn an_invalid_body_exits_with_2_and_writes_nothing() {
    let results = Results::of("run", &asset("payload_pendulum"), &["body.crate.mass=-1"]);
    let message = String::from_utf8_lossy(&results.output.stderr).into_owned();
    assert_eq!(results.output.status.code(), Some(2), "{message}");
    assert!(message.contains("--set body.crate.mass=-1: body.crate.mass: -1 is out of range"), "{message}");
    assert!(fs::read_dir(results.folder.path()).unwrap().next().is_none());
}
