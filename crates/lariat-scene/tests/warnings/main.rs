//! Warnings: each kind where it is due, none in the scenes of assets/scenes that are resolved.

mod bodies;
mod drawn;
mod edges;
mod levels;
mod mesh;
mod prying;
mod shipped;
mod through;
mod units;
mod unsolved;

use lariat_ancf::Level;
use lariat_scene::run::{self, Options, Summary};
use lariat_scene::{Error, Purpose, Scene, Warning};

/// Runs or settles a scene; returns all of its warnings.
fn warned(text: &str, purpose: Purpose) -> Vec<Warning> {
    summary_of(text, purpose, None).warnings
}

/// Runs or settles a scene that tells warnings up to a level; returns its summary.
fn summary_of(text: &str, purpose: Purpose, warn_level: Option<Level>) -> Summary {
    let scene = Scene::parse("scene.toml", text, &[], purpose).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let folder = tempfile::tempdir().unwrap();
    let mut told = Vec::new();
    let mut warn = |line: &str| told.push(line.to_string());
    let mut options = Options { warn: Some(&mut warn), warn_level, ..Options::default() };
    let outcome: Result<Summary, Error> = match purpose {
        Purpose::Run | Purpose::Resume => run::run(&scene, folder.path(), &mut options),
        Purpose::Static => run::statics(&scene, folder.path(), &mut options),
    };
    let json = std::fs::read_to_string(folder.path().join("summary.json")).unwrap();
    let summary: Summary = serde_json::from_str(&json).unwrap();
    // a run that fails tells and writes them, too
    told.sort();
    let mut lines = summary.told.clone();
    lines.sort();
    assert_eq!(lines, told, "{:?}", outcome.err());
    let texts: serde_json::Value = serde_json::from_str(&json).unwrap();
    for (warning, written) in summary.warnings.iter().zip(texts["warnings"].as_array().unwrap()) {
        assert_eq!(written["text"].as_str(), Some(warning.to_string().as_str()));
        assert_eq!(written["level"].as_str(), Some(warning.level().name()));
        assert!(written["kind"].is_string(), "{written}");
    }
    assert!(summary.warnings.is_sorted_by_key(Warning::level), "{:?}", summary.warnings);
    summary
}

/// A pendulum of a wire and a bob, `angle` rad from the vertical: wire `[length m, diameter m, E Pa]`.
fn pendulum([length, diameter, modulus]: [f64; 3], mass: f64, angle: f64, end: &str) -> String {
    let (x, y) = (length * angle.sin(), -length * angle.cos());
    format!(
        "duration = 0.2\n[[body]]\nname = \"bob\"\nshape = {{ ball = 0.05 }}\nmass = {mass}\nposition = [{x:?}, {y:?}, 0.0]\n\
         [[cable]]\nname = \"wire\"\npoints = [[0.0, 0.0, 0.0], [{x:?}, {y:?}, 0.0]]\nsection = {{ round = {diameter:?} }}\n\
         density = 7850.0\nyoungs_modulus = {modulus:?}\n[[attachment]]\ncable = \"wire\"\nat = \"start\"\nbody = \"world\"\n\
         [[attachment]]\ncable = \"wire\"\nat = \"end\"\nbody = \"{end}\"\n"
    )
}
