//! A winch in a scene.

use lariat_scene::run::{self, Options};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

/// Crate and winch of the scene, hoisted: the probe of the reel has what is out, the pull is the weight, and the total energy rises by the
/// work of the winch less what damping takes. A load and a probe below stay with their material.
///
/// *Source.* Statics and conservation of energy; 50 kg + 0.3 kg/m of rope.
#[test]
fn a_winch_of_a_scene_lifts_its_crate() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/winch.toml");
    for method in ["{ method = \"discrete-gradient\", max_step = 0.0041666 }", "{ tolerance = 1e-5 }"] {
        let overrides = ["duration=4.0".to_string(), format!("cable.rope.integrator={method}")];
        let scene = Scene::read(&path, &overrides, Purpose::Run).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let summary = run::run(&scene, folder.path(), &mut Options::default()).unwrap();
        assert!(summary.failed.is_none(), "{summary:?}");
        let rows = |name: &str| -> Vec<Vec<f64>> {
            let text = std::fs::read_to_string(folder.path().join(format!("probes/{name}.csv"))).unwrap();
            text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
        };
        let (reel, energy, body) = (rows("reel"), rows("energy"), rows("crate"));
        let (first, last) = (&reel[60], &reel[240]);
        // 0.5 m/s from 1 s on, reached within 0.5 s
        assert!((last[1] - (4.0 - 0.5 * 2.75)).abs() < 1e-6 && (last[2] + 0.5).abs() < 1e-9, "{last:?}");
        let weight: f64 = reel[180..].iter().map(|row| row[3] / ((50.0 + 0.3 * row[1]) * 9.81) / 61.0).sum();
        assert!((weight - 1.0).abs() < 5e-3, "{method}: {weight}");
        let rise = body[240][2] - body[60][2];
        assert!((rise - 0.5 * 2.75).abs() < 6e-3, "{rise} m");
        let gained = energy[240][7] - energy[60][7] + energy[240][5] - energy[60][5];
        let work = last[5] - first[5];
        println!("{method}: {gained} J of {work} J, pull over weight {weight}");
        assert!((gained - work).abs() < 5e-3 * work.abs(), "{method}: {gained} J of {work} J");
        let balance = summary.energy_balance.unwrap();
        assert!(balance.made() < 1e-3 && balance.lost() < 5e-3, "{method}: {balance:?}");
    }
}

/// The same winch with a clutch that is weaker than its acceleration asks for: it slips, never pulls more, and lifts the crate later.
///
/// *Source.* `m a = F - m g` for crate and rope.
#[test]
fn a_clutch_of_a_scene_slips() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/winch.toml");
    let overrides = ["duration=4.0".to_string(), "cable.rope.reel.max_force=530.0".to_string()];
    let scene = Scene::read(&path, &overrides, Purpose::Run).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let summary = run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    assert!(summary.failed.is_none(), "{summary:?}");
    let text = std::fs::read_to_string(folder.path().join("probes/reel.csv")).unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    let most = rows.iter().map(|row| row[3]).fold(0.0, f64::max);
    let last = &rows[240];
    // (530 N - 502 N)/51 kg is below the 1 m/s^2 of the table: out is more than without a clutch
    println!("{most} N, {last:?}");
    assert!(most < 530.0 * 1.02 && most > 529.0, "{most} N");
    assert!((last[2] + 0.5).abs() < 1e-6 && last[1] > 4.0 - 0.5 * 2.75 + 0.05, "{last:?}");
}

/// The same winch with its reel at the first point of the rope, drawn downwards: the crate moves as before, and a probe below the winch stays
/// with its material.
///
/// *Source.* The scene with the reel at the end.
#[test]
fn a_reel_at_the_first_point_is_one_at_the_last_of_the_rope_drawn_the_other_way() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/winch.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let probe = |at: f64| format!("\n[[probe]]\nname = \"point\"\ncable = \"rope\"\nat = {at}\n");
    let reversed = text
        .replace("points = [[0.0, 0.99, 0.0], [0.0, 5.0, 0.0]]", "points = [[0.0, 5.0, 0.0], [0.0, 0.99, 0.0]]")
        .replace("[cable.reel]", "[cable.reel]\nend = \"start\"")
        .replace("at = \"end\"", "at = \"START\"")
        .replace("at = \"start\"", "at = \"end\"")
        .replace("at = \"START\"", "at = \"start\"")
        .replace("end = \"end\"", "end = \"start\"");
    let rows = [text + &probe(0.75), reversed + &probe(3.25)].map(|text| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, text).unwrap();
        let scene = Scene::read(&path, &["duration=3.0".to_string()], Purpose::Run).unwrap();
        let out = folder.path().join("out");
        let summary = run::run(&scene, &out, &mut Options::default()).unwrap();
        assert!(summary.failed.is_none(), "{summary:?}");
        ["crate", "reel", "point"].map(|name| {
            let text = std::fs::read_to_string(out.join(format!("probes/{name}.csv"))).unwrap();
            let last = text.lines().last().unwrap();
            last.split(',').map(|x| x.parse::<f64>().unwrap()).collect::<Vec<_>>()
        })
    });
    let [one, other] = rows;
    assert!(one[1][1] < 3.3 && (one[1][1] - other[1][1]).abs() < 1e-9, "{:?} {:?}", one[1], other[1]);
    for (k, columns) in [(0, 1..4), (1, 3..6), (2, 1..4)] {
        for i in columns {
            assert!((one[k][i] - other[k][i]).abs() < 1e-3 * one[k][i].abs().max(1.0), "{:?} {:?}", one[k], other[k]);
        }
    }
}

/// The run of a tackle finds neither energy made nor lost beside what its sheaves take, and a load that outweighs the
/// block has no equilibrium.
///
/// *Source.* Conservation of energy.
#[test]
fn a_tackle_of_a_scene_keeps_its_energy() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/tackle.toml");
    let overrides = ["duration=0.5".to_string()];
    let scene = Scene::read(&path, &overrides, Purpose::Run).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let balance = run::run(&scene, folder.path(), &mut Options::default()).unwrap().energy_balance.unwrap();
    println!("{balance:?}");
    assert!(balance.scale_j > 20.0 && balance.made() < 1e-3 && balance.lost() < 1e-2, "{balance:?}");
    let scene = Scene::read(&path, &overrides, Purpose::Static).unwrap();
    let error = run::World::build(&scene).and_then(|mut world| world.start(Purpose::Static)).unwrap_err().to_string();
    assert!(error.contains("equilibrium"), "{error}");
}

/// Tables that make no sheave are refused with the key that is wrong.
#[test]
fn sheaves_that_do_not_fit_are_refused() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/tackle.toml");
    for (change, words) in [
        ("sheave.sheave-0.from=\"part-7\"", "part-7"),
        ("sheave.sheave-0.from=\"part-1\"", "different bodies"),
        ("sheave.sheave-0.from=\"part-2\"", "at a sheave"),
        ("sheave.sheave-0.to=\"part-3\"", "at a sheave"),
        ("sheave.sheave-0.friction=-0.1", "friction"),
        ("cable.part-0.integrator={ tolerance = 1e-5 }", "a cable over a sheave"),
    ] {
        let error = Scene::read(&path, &[change.to_string()], Purpose::Run).unwrap_err().to_string();
        assert!(error.contains(words), "{change}: {error}");
    }
}

/// The windlass of its scene hoists: bucket, drum and reel move as their equation says, also with the reel at the last point; and the run
/// finds no energy made or lost.
///
/// *Source.* `(J/R^2 + rho S + m) L'' = g (rho L + m) + M/R`, L within 1.2 m of rope of 0.1 kg/m.
#[test]
fn a_windlass_of_a_scene_hoists_its_bucket() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/windlass.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let reversed = text
        .replace("points = [[0.0, 0.0, 0.0], [0.0, -4.002, 0.0]]", "points = [[0.0, -4.002, 0.0], [0.0, 0.0, 0.0]]")
        .replace("at = \"end\"", "at = \"END\"")
        .replace("at = \"start\"", "at = \"end\"")
        .replace("at = \"END\"", "at = \"start\"")
        .replace("end = \"start\"", "end = \"end\"");
    for (text, mass, torque) in [(&text, 10.0, -18.0), (&reversed, 10.0, -18.0), (&text, 6.0, 0.0)] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, text).unwrap();
        let overrides = [format!("body.bucket.mass={mass:?}"), format!("load.0.moment=[0.0, 0.0, {torque:?}]")];
        let scene = Scene::read(&path, &overrides, Purpose::Run).unwrap();
        let out = folder.path().join("out");
        let summary = run::run(&scene, &out, &mut Options::default()).unwrap();
        // let go, the rope runs out with 0.53 of the speed of its waves at last, where its frequencies are wrong
        let told = summary.warnings.iter().all(|warning| format!("{warning:?}").contains("FastReel"));
        let fast = usize::from(torque == 0.0);
        assert!(summary.failed.is_none() && told && summary.warnings.len() == fast, "{summary:?}");
        let last = ["bucket", "drum", "reel"].map(|name| {
            let text = std::fs::read_to_string(out.join(format!("probes/{name}.csv"))).unwrap();
            let row = text.lines().last().unwrap();
            row.split(',').map(|x| x.parse::<f64>().unwrap()).collect::<Vec<_>>()
        });
        let moved = 0.5 * 8.0 + 0.1 * 12.0 + mass;
        let at = |length: f64| (9.81 * (0.1 * length + mass) + torque / 0.15) / moved * 1.5;
        let (speed, rate) = (-last[0][9], last[2][2]);
        let spun = last[1][13] * 0.15;
        let bounds = [at(4.0), at(last[2][1])];
        let [low, high] = [bounds[0].min(bounds[1]), bounds[0].max(bounds[1])];
        println!("{speed}, {spun}, {rate} of {low} to {high} m/s");
        let margin = 0.01 * high.abs();
        assert!([speed, spun, rate].iter().all(|v| (low - margin..high + margin).contains(v)), "{last:?}");
    }
}

/// A lure that is cast takes line off a free spool, 25 m/s out of elements of 33 mm, in host steps of 1/60 and 1/240 s; and without a
/// direction at the tip, which nothing gives a line without bending stiffness there, that is told.
///
/// *Source.* Conservation of energy of the lure on a straight line from a bag, with the weight of both along it: integrated below.
#[test]
fn a_lure_is_cast() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/cast.toml");
    // (m + w s) v^2/2 + (m + w s/2) g y = const, s the way of the lure, y its rise
    let (m, w, g) = (0.02, 8e-5, 9.81);
    let (mut x, mut v) = ([0.5f64.sqrt(); 2], [12.5 * 2.0f64.sqrt(); 2]);
    let (mut time, h) = (0.0, 1e-5);
    while time < 0.6 {
        let s = x[0].hypot(x[1]);
        let speed = (x[0] * v[0] + x[1] * v[1]) / s;
        // what is out moves with the lure, and what comes out takes half of its momentum flux
        let pull = 0.5 * w * speed * speed;
        for i in 0..2 {
            let weight = [0.0, g * (m + 0.5 * w * s)][i];
            v[i] -= h * (weight + pull * x[i] / s) / (m + w * s);
            x[i] += h * v[i];
        }
        time += h;
    }
    let expected = x[0].hypot(x[1]);
    for (held, dt) in [(true, 1.0 / 60.0), (true, 1.0 / 240.0), (false, 1.0 / 60.0)] {
        let folder = tempfile::tempdir().unwrap();
        let kind = if held { "clamp" } else { "ball" };
        let overrides = [format!("dt={dt:?}"), format!("attachment.tip.kind=\"{kind}\"")];
        let scene = Scene::read(&path, &overrides, Purpose::Run).unwrap();
        let run = run::run(&scene, folder.path(), &mut Options::default());
        if !held {
            let text = format!("{run:?}") + &std::fs::read_to_string(folder.path().join("summary.json")).unwrap();
            assert!(text.contains("fast_reel") && text.contains("\"undirected\": true"), "{text}");
            continue;
        }
        let summary = run.unwrap();
        assert!(summary.failed.is_none() && summary.warnings.is_empty(), "{summary:?}");
        let text = std::fs::read_to_string(folder.path().join("probes/reel.csv")).unwrap();
        let row: Vec<f64> = text.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
        println!("{dt}: {} m of {expected}", row[1]);
        assert!((row[1] / expected - 1.0).abs() < 2e-3, "{} m of {expected}", row[1]);
    }
}

/// Drums that do not fit are refused with the key that is wrong, and their statics by name.
#[test]
fn drums_that_do_not_fit_are_refused() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/windlass.toml");
    for (change, words) in [
        ("cable.rope.reel.drum.body=\"windlas\"", "windlas"),
        ("cable.rope.reel.drum.radius=0.0", "radius"),
        ("cable.rope.reel.drum.axis=[0.0, 0.0, 0.0]", "no direction"),
        ("cable.rope.reel.rate=[[0.0, 1.0]]", "rate"),
        ("cable.rope.reel.max_force=10.0", "that of its body"),
        ("cable.rope.reel.acceleration=2.0", "that of its body"),
        ("attachment.0.body=\"drum\"", "holds the end of the cable itself"),
        ("attachment.0.at=1.0", "no attachment holds the end"),
        ("joint.0.to=\"bucket\"", "to a dynamic body"),
        ("cable.rope.integrator={ tolerance = 1e-5 }", "a cable on a drum"),
        ("cable.rope.reel.drum.body=\"bucket\"", ""),
    ] {
        let read = Scene::read(&path, &[change.to_string()], Purpose::Run);
        if words.is_empty() {
            read.unwrap();
            continue;
        }
        let error = read.unwrap_err().to_string();
        assert!(error.contains(words), "{change}: {error}");
    }
    let scene = Scene::read(&path, &[], Purpose::Static).unwrap();
    let error = run::World::build(&scene).and_then(|mut world| world.start(Purpose::Static)).unwrap_err().to_string();
    assert!(error.contains("on a drum") && error.contains("balances the pull"), "{error}");
}

/// A reel that moves more than half an element in a host step is stepped in shorter ones: hoisting at 7 m/s at 1/15 s, and a free spool.
///
/// *Source.* Ramps of the rate by hand; free fall with the rope that is out.
#[test]
fn a_fast_reel_divides_the_host_step() {
    let text = |reel: &str, dt: f64, duration: f64| {
        format!(
            "duration = {duration:?}\ndt = {dt:?}\n[[body]]\nname = \"b\"\nshape = {{ ball = 0.1 }}\nmass = 6.0\nposition = [0.0, -2.1, 0.0]\n\
             [[cable]]\nname = \"c\"\npoints = [[0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]\naxial_stiffness = 3e5\nbending_stiffness = 1e-3\nmass_per_length = 0.05\n\
             elements = 24\nintegrator = {{ fidelity = \"game\" }}\ndamping = {{ axial = 4e-3 }}\n[cable.reel]\nend = \"start\"\n{reel}\n\
             [[attachment]]\nname = \"eye\"\ncable = \"c\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"c\"\nat = \"end\"\nbody = \"b\"\nanchor = [0.0, 0.1, 0.0]\n[[probe]]\nname = \"r\"\nreel = \"c\"\n"
        )
    };
    let out = |text: &str| -> f64 {
        let scene = Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap();
        let recording = run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
        assert!(recording.failed.is_none(), "{:?}", recording.failed);
        let probe = &recording.probes[0];
        let last = &probe.rows[probe.rows.len() - probe.columns.len()..];
        last[probe.columns.iter().position(|name| *name == "length_out").unwrap()]
    };
    for dt in [1.0 / 15.0, 1.0 / 30.0, 1.0 / 60.0] {
        // 9 m/s^2 to 7 m/s, then 7 m/s, in 1.2 s
        let paid = out(&text("rate = [[0.0, 7.0]]\nacceleration = 9.0", dt, 1.2)) - 2.0;
        let expected = 7.0 * (1.2 - 0.5 * 7.0 / 9.0);
        println!("{dt}: paid out {paid} of {expected}");
        assert!((paid / expected - 1.0).abs() < 1e-3, "{dt}: {paid} {expected}");
        let free = out(&text("rate = [[0.0, 0.0]]\nmax_force = 0.0", dt, 1.2)) - 2.0;
        let fall = 0.5 * 9.81 * 1.44;
        println!("{dt}: a free spool {free} of {fall}");
        assert!((free / fall - 1.0).abs() < 0.05, "{dt}: {free} {fall}");
    }
}
