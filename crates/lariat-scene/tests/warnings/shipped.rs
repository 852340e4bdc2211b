//! What the scenes that come with the library tell.

use crate::summary_of;
use lariat_scene::Purpose;
use std::collections::BTreeMap;
use std::path::Path;

/// The kinds that scenes are there to show, by file; all others tell nothing. Each file says so.
const MEANT: [(&str, &[&str]); 9] = [
    ("scenes/payload_pendulum", &["coarse_mesh"]),
    ("hard/silent_gpa", &["soft_material"]),
    ("hard/tolerance_1m_heats", &["large_tolerance"]),
    ("hard/silent_mm", &["stubby"]),
    ("hard/silent_unattached_bob", &["falls_freely", "passes_through"]),
    ("hard/static_stub_inverts", &["stubby"]),
    ("hard/boom_multibody_ga0", &["energy_made"]),
    ("hard/midpoint_heats", &["energy_made"]),
    ("hard/payload_midpoint_1", &["energy_made"]),
];

/// What a chaotic scene tells by the last bit of its motion: friction of the heap lags in none or in some 14 of 1200 steps.
const MAY: (&str, &str) = ("contact/heap", "friction_lags");

/// Scenes that take longer than all others together: a bridge of 8 cables, and a rope that must
/// rest for a minute.
const SLOW: [&str; 2] = ["scenes/bridge", "contact/stick"];

/// A scene tells what it is there to show, and nothing else.
#[test]
fn shipped_scenes_tell_what_they_are_there_to_show() {
    let mut seen = 0;
    let meant: BTreeMap<&str, &[&str]> = MEANT.into_iter().collect();
    let mut wrong = Vec::new();
    for folder in ["scenes", "contact", "hard"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(folder);
        for file in std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()) {
            let name = format!("{folder}/{}", file.file_stem().unwrap().to_str().unwrap());
            if SLOW.contains(&name.as_str()) {
                continue;
            }
            let summary = summary_of(&std::fs::read_to_string(&file).unwrap(), Purpose::Run, None);
            let expected = meant.get(name.as_str()).copied().unwrap_or(&[]);
            let json: serde_json::Value = serde_json::from_str(&summary.to_json()).unwrap();
            let kind = |line: &String| {
                let all = json["warnings"].as_array().unwrap();
                let own = all.iter().find(|w| line.ends_with(w["text"].as_str().unwrap())).unwrap();
                own["kind"].as_str().unwrap().to_string()
            };
            let may = |kind: &String| (name.as_str(), kind.as_str()) == MAY;
            let told: Vec<String> = summary.told.iter().map(kind).filter(|kind| !may(kind)).collect();
            if told != expected {
                wrong.push(format!("{name}: {told:?}"));
            }
            seen += 1;
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen > 50, "{seen}");
}
