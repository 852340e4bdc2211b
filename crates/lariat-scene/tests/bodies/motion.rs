//! Bodies without cables: mass, motion, loads, paths.

use super::results::{Results, free};
use std::fs;

/// *Source.* Newton: `x = F t^2/2m`, with a ramp `x = F (t^2/2 - r t/2 + r^2/6)/m`, `I w = M t`.
#[test]
fn a_load_accelerates_and_rotates_a_body() {
    let body = "shape = \"none\"\nmass = 2.0\ninertia = [1.0, 1.0, 0.5]";
    for (load, x, w) in [
        ("force = [4.0, 0.0, 0.0]", 1.0, 0.0),
        ("force = [4.0, 0.0, 0.0]\nramp = 0.5", 2.0 * (0.5 - 0.25 + 0.25 / 6.0), 0.0),
        ("moment = [0.0, 0.0, 1.0]", 0.0, 2.0),
        ("force = [0.0, 0.0, 1.0]\npoint = [0.0, 0.01, 0.0]\nmoment = [-0.01, 0.0, 0.0]", 0.0, 0.0),
    ] {
        let text = free(body, &format!("[[load]]\nbody = \"b\"\n{load}"));
        let row = Results::of_text("run", &text).done().last("b");
        assert!((row[1] - x).abs() < 1e-2 * x.max(0.1) && (row[13] - w).abs() < 1e-4, "{load}: {row:?}");
        assert!(row[11].abs() < 1e-4, "{load}: {row:?}");
    }
}

/// *Source.* The area under the history, F/m of it; a ramp is a factor beside it.
#[test]
fn a_load_with_a_history_gives_its_impulse() {
    let body = "shape = \"none\"\nmass = 2.0\ninertia = [1.0, 1.0, 0.5]";
    for (history, share) in [
        ("history = [[0.0, 0.0], [0.5, 1.0], [1.0, 0.0]]", 0.5),
        ("history = [[0.2, 0.0], [0.3, -2.0], [0.4, 0.0]]", -0.2),
        ("history = [[0.5, 0.5]]", 0.5),
        ("ramp = 0.5\nhistory = [[0.5, 1.0], [0.55, 0.0]]", 0.25 + 0.025),
    ] {
        let load = format!("[[load]]\nbody = \"b\"\nforce = [4.0, 0.0, 0.0]\nmoment = [0.0, 0.0, 1.0]\n{history}");
        let text = free(body, &load).replace("duration", "dt = 0.0125\nduration");
        let row = Results::of_text("run", &text).done().last("b");
        assert!((row[8] - 2.0 * share).abs() < 1e-4 && (row[13] - 2.0 * share).abs() < 1e-4, "{history}: {row:?}");
    }
}

/// *Source.* `m v^2/2 + I w^2/2`, `m v`, `r x m v + I w`; volumes of ball, cylinder and capsule; the hull of a tetrahedron.
#[test]
fn a_body_has_the_mass_of_its_shape_and_its_initial_velocity() {
    let pi = std::f64::consts::PI;
    for (shape, volume) in [
        ("cuboid = [0.1, 0.2, 0.3]", 8.0 * 0.006),
        ("ball = 0.3", 4.0 / 3.0 * pi * 0.027),
        ("cylinder = [0.5, 0.2]", pi * 0.04),
        ("capsule = [0.5, 0.2]", pi * 0.04 + 4.0 / 3.0 * pi * 0.008),
    ] {
        let body =
            format!("shape = {{ {shape} }}\ndensity = 100.0\nposition = [0.0, 2.0, 0.0]\nvelocity = [3.0, 0.0, 0.0]");
        let results = Results::of_text("run", &free(&body, "")).done();
        let (mass, momentum, energy) = (100.0 * volume, &results.rows("momentum")[0], &results.rows("energy")[0]);
        assert!((momentum[1] / (3.0 * mass) - 1.0).abs() < 1e-4, "{shape}: {momentum:?}");
        assert!((momentum[6] / (-6.0 * mass) - 1.0).abs() < 1e-4, "{shape}: {momentum:?}");
        assert!((energy[1] / (4.5 * mass) - 1.0).abs() < 1e-4, "{shape}: {energy:?}");
        assert!((results.last("b")[1] - 3.0).abs() < 1e-4, "{shape}");
    }
    let spin = "shape = { ball = 0.1 }\nmass = 2.0\ninertia = [0.3, 0.4, 0.5]\nrotation = [0.0, 0.0, 1.5707963267948966]\n\
                angular_velocity = [2.0, 0.0, 0.0]";
    // turned by 90 degrees about z, the body's y lies along x
    let results = Results::of_text("run", &free(spin, "")).done();
    let row = &results.rows("momentum")[0];
    assert!((row[4] - 0.8).abs() < 1e-6 && row[5].abs() < 1e-6 && (results.rows("energy")[0][1] - 0.8).abs() < 1e-6);
}

/// Rapier limits velocities by default.
///
/// *Source.* Newton's first law.
#[test]
fn a_fast_body_is_not_slowed_down() {
    let fast = free(
        "shape = { ball = 0.1 }\nmass = 1.0\nvelocity = [1000.0, 0.0, 0.0]\nangular_velocity = [0.0, 0.0, 1000.0]",
        "",
    );
    let row = Results::of_text("run", &fast).done().last("b");
    assert!((row[1] / 1000.0 - 1.0).abs() < 1e-4 && (row[8] - 1000.0).abs() < 0.1, "{row:?}");
    assert!((row[13] / 1000.0 - 1.0).abs() < 1e-3, "{row:?}");
}

/// A hull whose centre of mass is not its origin: velocity is that of the origin, and the momentum that of the centre.
///
/// *Source.* Tetrahedron of legs a: volume a^3/6, centre of mass at a/4 along each.
#[test]
fn the_velocity_of_a_mesh_is_that_of_its_origin() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("corner.obj"),
        "v 0 0 0\nv 0.4 0 0\nv 0 0.4 0\nv 0 0 0.4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    )
    .unwrap();
    let body = "shape = { mesh = \"corner.obj\" }\ndensity = 3000.0\nangular_velocity = [0.0, 0.0, 2.0]";
    let file = folder.path().join("scene.toml");
    fs::write(&file, free(body, "")).unwrap();
    let results = Results::of("run", &file, &["duration=0.05"]).done();
    let (row, state, mass) = (&results.rows("momentum")[0], &results.rows("b")[0], 3000.0 * 0.064 / 6.0);
    assert!((row[1] / (-0.2 * mass) - 1.0).abs() < 1e-4 && (row[2] / (0.2 * mass) - 1.0).abs() < 1e-4, "{row:?}");
    assert!(state[8..11].iter().all(|v| v.abs() < 1e-6) && state[1..4].iter().all(|x| x.abs() < 1e-6), "{state:?}");
}

/// A scene without gravity of a kinematic body that holds the start of a cable, with a probe of each.
fn moved(head: &str, body: &str, points: [[f64; 3]; 2]) -> String {
    format!(
        "{head}\ngravity = [0.0, 0.0, 0.0]\n[[body]]\nname = \"b\"\nkind = \"kinematic\"\nshape = \"none\"\n{body}\n\
         [[cable]]\nname = \"c\"\npoints = {points:?}\nsection = {{ round = 0.01 }}\ndensity = 1000.0\nyoungs_modulus = 1e7\n\
         [[attachment]]\ncable = \"c\"\nat = \"start\"\nbody = \"b\"\n[[probe]]\nname = \"b\"\nbody = \"b\"\n\
         [[probe]]\nname = \"start\"\ncable = \"c\"\nat = \"start\"\n"
    )
}

/// *Source.* The path; `exp(w t)`.
#[test]
fn a_kinematic_body_follows_its_path_and_moves_the_cable() {
    let body = "angular_velocity = [0.0, 0.0, 1.0]\npath = [[0.2, 0.0, 0.0, 0.0], [0.6, 0.0, 0.0, 0.8]]";
    let text = moved("duration = 1.0\ndt = 0.05", body, [[1.0, 0.0, 0.0], [1.5, 0.0, 0.0]]);
    let results = Results::of_text("run", &text).done();
    let (arm, start) = (results.rows("b"), results.rows("start"));
    assert_eq!(arm.len(), 21);
    for (arm, start) in arm.iter().zip(&start) {
        let t = arm[0];
        let z = 2.0 * (t.clamp(0.2, 0.6) - 0.2);
        assert!((arm[3] - z).abs() < 1e-6 && (arm[6] - (0.5 * t).sin()).abs() < 1e-6, "{arm:?}");
        let expected = [t.cos(), t.sin(), z];
        let off = (0..3).map(|i| (start[1 + i] - expected[i]).powi(2)).sum::<f64>().sqrt();
        assert!(off < 1e-6, "{off:.1e} m at {t} s");
        assert!((arm[10] - if (0.2..0.6 - 1e-9).contains(&t) { 2.0 } else { 0.0 }).abs() < 1e-9, "{arm:?}");
    }
}

/// A file of places and rotations, as a motion tracker writes it: heave and roll of a deck.
///
/// *Source.* The functions that the rows are of; cubics between them are of the third order.
#[test]
fn a_smooth_path_of_a_file_moves_and_turns_the_body() {
    let roll = |t: f64| (0.4 * (2.0 * t).sin(), 0.8 * (2.0 * t).cos());
    let heave = |t: f64| (0.3 * (3.0 * t).cos(), -0.9 * (3.0 * t).sin());
    let folder = tempfile::tempdir().unwrap();
    let rows = (0..=40).map(|i| 0.025 * f64::from(i)).map(|t| format!("{t},1,{},0,0,0,{}\n", heave(t).0, roll(t).0));
    fs::write(folder.path().join("deck.csv"), "t,x,y,z,rx,ry,rz\n".to_string() + &rows.collect::<String>()).unwrap();
    let text = moved("duration = 0.9\ndt = 0.01", "path = { csv = \"deck.csv\" }", [[2.0, 0.3, 0.0], [2.5, 0.3, 0.0]]);
    let file = folder.path().join("scene.toml");
    fs::write(&file, text).unwrap();
    let results = Results::of("run", &file, &[]).done();
    for (deck, start) in results.rows("b").iter().zip(results.rows("start")) {
        let t = deck[0];
        let ((y, v), (angle, spin)) = (heave(t), roll(t));
        assert!((deck[2] - y).abs() < 3e-5 && (deck[9] - v).abs() < 5e-3, "{deck:?}");
        assert!((deck[6] - (0.5 * angle).sin()).abs() < 3e-5 && (deck[13] - spin).abs() < 5e-3, "{deck:?}");
        let expected = [1.0 + angle.cos(), y + angle.sin(), 0.0];
        let off = (0..3).map(|i| (start[1 + i] - expected[i]).powi(2)).sum::<f64>().sqrt();
        assert!(off < 1e-4, "{off:.1e} m at {t} s");
    }
}
