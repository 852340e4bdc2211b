//! Models of the kinds of MuJoCo's public cables (its cable.xml, belt.xml and coil.xml, and variations): each is imported
//! whole, or refused by name.
//!
//! *Source.* `tips.csv`, which `models.py` writes with MuJoCo 3.17: where a point is after 1 s, in the model as it is and in
//! the limit of many segments. MuJoCo's joints between rigid segments err in the first order of their length; the limit is
//! twice the point with twice as many segments, less that of the model.

use lariat_scene::run::{Options, collect};
use lariat_scene::{Error, Purpose, Scene, mjcf};
use std::path::PathBuf;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/mjcf")
}

fn import(name: &str) -> Result<mjcf::Import, Error> {
    let path = folder().join("models").join(format!("{name}.xml"));
    mjcf::read(&path.display().to_string(), &std::fs::read_to_string(&path).unwrap())
}

fn scene(text: &str) -> Scene {
    Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

struct Row {
    model: String,
    point: String,
    limit: [f64; 3],
    mass: f64,
}

fn rows() -> Vec<Row> {
    let text = std::fs::read_to_string(folder().join("tips.csv")).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |k: usize| cells[k].parse::<f64>().unwrap();
        Row { model: cells[0].to_string(), point: cells[1].to_string(), limit: [5, 6, 7].map(number), mass: number(8) }
    };
    lines.map(row).collect()
}

/// Returns a probe of the point that `tips.csv` names: a body, a site at an end, or the middle of a cable.
fn probe(point: &str, scene: &Scene) -> String {
    if point == "load" {
        return "\n[[probe]]\nname = \"tip\"\nbody = \"load\"\n".to_string();
    }
    let prefix = point.split('_').next().unwrap();
    let cable = scene.cables.iter().find(|cable| cable.name == prefix).unwrap_or(&scene.cables[0]);
    let at = if point.ends_with("last") {
        "end"
    } else if point.ends_with("first") {
        "start"
    } else {
        "50 %"
    };
    format!("\n[[probe]]\nname = \"tip\"\ncable = \"{}\"\nat = \"{at}\"\n", cable.name)
}

/// The tip is within 0.06 m of where many segments of MuJoCo have it. Misses: the points that differ by more, and why.
#[test]
fn tips_are_where_mujoco_has_them_after_a_second() {
    let rows = rows();
    assert!(rows.len() >= 16, "{} models", rows.len());
    let mut wrong = Vec::new();
    for row in &rows {
        let text = import(&row.model).unwrap_or_else(|error| panic!("{}: {error}", row.model)).scene;
        let text = format!("{text}{}", probe(&row.point, &scene(&text)));
        let run = collect(&scene(&text), Purpose::Run, &mut Options::default()).unwrap();
        assert!(run.failed.is_none(), "{}: {:?}", row.model, run.failed);
        let probe = &run.probes[0];
        let last = probe.rows.chunks(probe.columns.len()).last().unwrap();
        assert!((last[0] - 1.0).abs() < 1e-9);
        let off = (0..3).map(|k| (last[1 + k] - row.limit[k]).powi(2)).sum::<f64>().sqrt();
        println!("{:16} {off:.4} m", row.model);
        if off > 0.06 {
            wrong.push(format!("{}: {off:.3} m", row.model));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Masses are those of MuJoCo, which weighs the half balls at the ends of capsules.
#[test]
fn cables_weigh_what_they_do_in_mujoco() {
    for row in rows().iter().filter(|row| row.mass > 0.0) {
        let text = import(&row.model).unwrap().scene;
        let scene = scene(&text);
        let tables: toml::Table = text.parse().unwrap();
        let mut mass = 0.0;
        for (index, table) in tables["cable"].as_array().unwrap().iter().enumerate() {
            let number = |key: &str| table.get(key).and_then(toml::Value::as_float);
            let per_length = number("mass_per_length").unwrap_or_else(|| {
                let diameter = table["section"]["round"].as_float().unwrap();
                number("density").unwrap() * std::f64::consts::FRAC_PI_4 * diameter.powi(2)
            });
            mass += per_length * scene.build_cable(index).unwrap().length();
        }
        assert!((mass / row.mass - 1.0).abs() < 1e-6, "{}: {mass} kg, {} in MuJoCo", row.model, row.mass);
    }
}

/// What cannot be imported right names its file, line, element and attribute.
#[test]
fn models_that_no_scene_is_are_refused_by_name() {
    let refused = [
        ("belt", ["belt.xml:", "<geom>", "0.04 m by 0.003 m", "cylinder of the radius"]),
        ("coil", ["coil.xml:", "<joint>", "armature", "rotor"]),
        ("helix", ["helix.xml:", "<composite>", "twist", "flat"]),
        ("tendon", ["tendon.xml:", "<spatial>", "stiffness", "spring"]),
    ];
    for (name, words) in refused {
        let error = import(name).unwrap_err().to_string();
        for word in words {
            assert!(error.contains(word), "{name}: {word:?} in {error}");
        }
    }
}

/// What is left out is told, with its line, and in the scene.
#[test]
fn what_is_left_out_is_told() {
    let told = [("cable", "<motor>"), ("inactive", "not active"), ("wind", "viscosity"), ("arc", "no direction")];
    for (name, word) in told {
        let import = import(name).unwrap();
        let note = import.notes.iter().find(|note| note.text.contains(word));
        let note = note.unwrap_or_else(|| panic!("{name}: {word} in {:?}", import.notes));
        assert!(note.place.contains(&format!("{name}.xml:")), "{note}");
        assert!(import.scene.contains(&format!("# - {note}")), "{}", import.scene);
    }
}
