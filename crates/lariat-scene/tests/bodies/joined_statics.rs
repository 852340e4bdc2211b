//! Statics of bodies on joints and of cables over sheaves, and runs from there: what is in
//! equilibrium stays where it is.

use lariat_ancf::Vector3;
use lariat_scene::run::{self, Options};
use lariat_scene::{Purpose, Scene};

const GRAVITY: f64 = 9.81;

/// Returns a cable between a point of the world and one of a body, its attachment there named after it, with a probe.
fn rope(name: &str, [from, to]: [[f64; 3]; 2], length: f64, (body, anchor): (&str, [f64; 3])) -> String {
    format!(
        "[[cable]]\nname = \"{name}\"\npoints = [{from:?}, {to:?}]\nlength = {length:?}\nelements = 6\n\
         axial_stiffness = 2.0e5\nbending_stiffness = 0.01\nmass_per_length = 0.05\nintegrator = {{ fidelity = \"game\" }}\n\
         [[attachment]]\ncable = \"{name}\"\nat = \"start\"\nbody = \"world\"\n\
         [[attachment]]\nname = \"{name}\"\ncable = \"{name}\"\nat = \"end\"\nbody = \"{body}\"\nanchor = {anchor:?}\n\
         [[probe]]\nname = \"{name}\"\nattachment = \"{name}\"\n"
    )
}

fn body(name: &str, half: [f64; 3], mass: f64, position: [f64; 3]) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nshape = {{ cuboid = {half:?} }}\nmass = {mass:?}\nposition = {position:?}\n\
         [[probe]]\nname = \"{name}\"\nbody = \"{name}\"\n"
    )
}

/// Runs 10 s from equilibrium, and returns the first rows of all probes, and how far the bodies moved in m.
fn rests(text: &str, bodies: &[&str]) -> (Vec<Vec<f64>>, f64) {
    let text = format!("duration = 10.0\ninitial = \"equilibrium\"\n{text}");
    let scene = Scene::parse("rests.toml", &text, &[], Purpose::Run).unwrap();
    let recording = run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
    assert!(recording.failed.is_none(), "{:?}", recording.failed);
    let rows =
        |probe: &run::ProbeRecord| probe.rows.chunks(probe.columns.len()).map(<[f64]>::to_vec).collect::<Vec<_>>();
    let mut moved = 0.0f64;
    for probe in recording.probes.iter().filter(|probe| bodies.contains(&probe.name.as_str())) {
        let rows = rows(probe);
        for row in &rows {
            (1..4).for_each(|x| moved = moved.max((row[x] - rows[0][x]).abs()));
        }
    }
    (recording.probes.iter().map(|probe| rows(probe).swap_remove(0)).collect(), moved)
}

/// Force of the first rows at an attachment.
fn force(row: &[f64]) -> Vector3<f64> {
    Vector3::new(row[1], row[2], row[3])
}

/// A boom on a hinge and an arm on a ball joint, held by a rope.
///
/// *Source.* Moments about the joint: that of the rope at the tip against that of the weight.
#[test]
fn a_boom_and_an_arm_rest_on_their_joint_and_a_rope() {
    let cases: [(&str, [f64; 3], f64); 3] = [
        ("kind = \"hinge\"\naxis = [0.0, 0.0, 1.0]", [0.0, 1.5, 0.0], 2.0),
        ("kind = \"hinge\"\naxis = [0.0, 0.0, 1.0]\nmultibody = true", [0.0, 1.5, 0.0], 2.0),
        ("kind = \"ball\"", [0.2, 0.8, 0.3], 1.0),
    ];
    for (kind, from, tip) in cases {
        let half = 0.5 * tip;
        let length = 0.98 * ((from[0] - tip).powi(2) + from[1] * from[1] + from[2] * from[2]).sqrt();
        let text = body("boom", [half, 0.05, 0.05], 20.0, [half, 0.0, 0.0])
            + &format!("[[joint]]\nbody = \"boom\"\nto = \"world\"\nat = [0.0, 0.0, 0.0]\n{kind}\n")
            + &rope("rope", [from, [tip, 0.0, 0.0]], length, ("boom", [half, 0.0, 0.0]));
        let (rows, moved) = rests(&text, &["boom"]);
        let [boom, hook] = [&rows[0], &rows[1]];
        let centre = Vector3::new(boom[1], boom[2], boom[3]);
        // the tip is as far behind the centre as the joint is before it
        let moments = (2.0 * centre).cross(&force(hook)) + centre.cross(&Vector3::new(0.0, -20.0 * GRAVITY, 0.0));
        let held = if kind.contains("hinge") { moments.z.abs() } else { moments.norm() };
        let size = 20.0 * GRAVITY * centre.xz().norm();
        println!("{kind}: moments {held:e} of {size} N m, moved {moved:e} m");
        assert!((centre.norm() - half).abs() < 1e-6, "{centre:?}");
        assert!(held < 1e-4 * size, "{held} of {size} N m");
        assert!(moved < 1e-6, "{moved} m");
    }
}

/// Ten planks on hinges, hung from four ropes.
///
/// *Source.* The ropes carry the weight, each of four a quarter, and their level pull is that of a chain of equal links: it does not
/// change from hinge to hinge. In the run Rapier's impulse joints yield under the load, in single precision: within 1e-5 m.
#[test]
fn a_bridge_of_ten_planks_hangs_as_a_chain_of_links() {
    let mut text = String::new();
    for k in 0..10 {
        let x = 0.4 * f64::from(k);
        text += &body(&format!("plank-{k}"), [0.2, 0.02, 0.4], 8.0, [0.2 + x, 0.0, 0.0]);
        if k > 0 {
            text += &format!(
                "[[joint]]\nkind = \"hinge\"\nbody = \"plank-{k}\"\nto = \"plank-{}\"\nat = [{x:?}, 0.0, 0.0]\naxis = [0.0, 0.0, 1.0]\n",
                k - 1
            );
        }
    }
    for (i, (from, to, plank, anchor)) in
        [(-1.0, 0.0, "plank-0", -0.2), (5.0, 4.0, "plank-9", 0.2)].into_iter().enumerate()
    {
        for z in [-0.4, 0.4] {
            let name = format!("rope-{i}-{}", if z > 0.0 { "b" } else { "a" });
            text += &rope(&name, [[from, 0.6, z], [to, 0.0, z]], 1.3, (plank, [anchor, 0.0, z]));
        }
    }
    let planks: Vec<String> = (0..10).map(|k| format!("plank-{k}")).collect();
    let names: Vec<&str> = planks.iter().map(String::as_str).collect();
    let (rows, moved) = rests(&text, &names);
    let ropes: Vec<Vector3<f64>> = rows[10..].iter().map(|row| force(row)).collect();
    println!("moved {moved:e} m, ropes {ropes:?}");
    assert!(ropes.iter().all(|pull| (pull.y / (20.0 * GRAVITY) - 1.0).abs() < 1e-5), "{ropes:?}");
    // a plank turns so that the pulls at its ends, level H and the weights beyond, have no moment
    let level = ropes[0].x + ropes[1].x;
    let slope = |k: usize| {
        let [z, w] = [rows[k][6], rows[k][7]];
        (2.0 * z.atan2(w)).tan()
    };
    for k in 0..10 {
        let expected = 8.0 * GRAVITY * (4.5 - k as f64) / level;
        assert!((slope(k) - expected).abs() < 1e-4, "{k}: {} for {expected}", slope(k));
    }
    assert!(moved < 1e-5, "{moved} m");
}

/// A load on a rope of two falls over a sheave, drawn with the sheave beside the middle of the rope.
///
/// *Source.* Without friction both falls carry half of the load, and the sheave hangs in the middle; with it nothing runs while the
/// pulls differ by less than it holds.
#[test]
fn a_load_on_a_tackle_hangs_on_equal_falls() {
    let text = |friction: f64| {
        "[[body]]\nname = \"load\"\nshape = { cuboid = [0.1, 0.1, 0.1] }\nmass = 30.0\nposition = [0.1, -2.1, 0.0]\n\
         [[probe]]\nname = \"load\"\nbody = \"load\"\n\
         [[cable]]\nname = \"rope\"\npoints = [[-0.5, 0.0, 0.0], [0.1, -2.0, 0.0], [0.5, 0.0, 0.0]]\nelements = 12\n\
         axial_stiffness = 2.0e5\nbending_stiffness = 1.0e-3\nmass_per_length = 0.02\n\
         [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
         [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"\n"
            .to_string()
            + &format!(
                "[[sheave]]\nname = \"block\"\ncable = \"rope\"\nat = {:?}\nbody = \"load\"\nanchor = [0.0, 0.1, 0.0]\nfriction = {friction:?}\n\
                 [[probe]]\nname = \"block\"\nsheave = \"block\"\n",
                (0.6f64 * 0.6 + 4.0).sqrt()
            )
    };
    let (rows, moved) = rests(&text(0.0), &["load"]);
    println!("moved {moved:e} m, {rows:?}");
    let [load, block] = [&rows[0], &rows[1]];
    assert!(load[1].abs() < 1e-5, "{load:?}");
    let fall = 0.5f64.hypot(load[2] + 0.1);
    let expected = 0.5 * 30.0 * GRAVITY * fall / (load[2] + 0.1).abs();
    assert!(
        (block[3] / expected - 1.0).abs() < 1e-3 && (block[4] / expected - 1.0).abs() < 1e-3,
        "{block:?} {expected}"
    );
    assert!(moved < 1e-6, "{moved} m");
}

/// A rope between two points of the world over an eye of the world, drawn with unequal falls.
///
/// *Source.* Pulls over an eye without friction are equal; with friction and all of it needed nothing runs.
#[test]
fn a_rope_over_a_fixed_eye_has_equal_pulls() {
    for friction in [0.0, 2.0] {
        let text = format!(
            "[[cable]]\nname = \"rope\"\npoints = [[-1.0, 0.0, 0.0], [0.3, 0.5, 0.0], [1.0, -0.2, 0.0]]\nelements = 12\n\
             axial_stiffness = 2.0e4\nbending_stiffness = 1.0e-4\nmass_per_length = 0.2\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"\n\
             [[sheave]]\nname = \"eye\"\ncable = \"rope\"\nat = {:?}\nbody = \"world\"\nanchor = [0.3, 0.5, 0.0]\nfriction = {friction:?}\n\
             [[probe]]\nname = \"eye\"\nsheave = \"eye\"\n",
            1.3f64.hypot(0.5)
        );
        let (rows, _) = rests(&text, &[]);
        let [a, b] = [rows[0][3], rows[0][4]];
        println!("friction {friction}: {a} and {b} N");
        assert!(a > 0.1 && b > 0.1, "{a} {b}");
        assert!(friction > 0.0 || (a / b - 1.0).abs() < 1e-3, "{a} {b}");
        assert!(friction == 0.0 || (a / b).ln().abs() < friction * std::f64::consts::PI, "{a} {b}");
    }
}
