//! Invalid scenes: each is an error with the line, the key and what is accepted, before anything is written.

mod bodies;
mod cables;
mod cases;
mod joints;
mod junctions;
mod mistakes;

use lariat_scene::{Error, Place, Problem, Purpose, Scene, SceneError};

const GOOD: &str = "duration = 1.0\n[[cable]]\nname = \"sling\"\npoints = [[0, 0, 0], [2, 0, 0]]\nsection = { round = 0.01 }\n\
                    density = 4000.0\nyoungs_modulus = 1e8\n";

fn error(text: &str) -> SceneError {
    match Scene::parse("scene.toml", text, &[], Purpose::Run) {
        Err(Error::Scene(error)) => *error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn problems_can_be_told_apart_by_type() {
    for (from, to, line, problem) in [
        ("duration = 1.0", "duration = 0.0", 1, Problem::OutOfRange(0.0)),
        ("duration = 1.0", "duration = \"long\"", 1, Problem::WrongType("the text \"long\"".to_string())),
        ("density", "densty", 6, Problem::UnknownKey("densty".to_string())),
        ("density = 4000.0", "", 2, Problem::MissingKey("density".to_string())),
        (
            "section = { round = 0.01 }",
            "section = {}",
            5,
            Problem::NoneGiven(&["square", "round", "tube", "nylon", "polyester", "hmpe", "wire_rope", "chain"]),
        ),
        ("name = \"sling\"", "name = \"all\"", 3, Problem::ReservedName("all".to_string())),
    ] {
        assert!(GOOD.contains(from));
        let error = error(&GOOD.replacen(from, to, 1));
        assert_eq!(
            (error.place, error.problem),
            (Place::Line { file: "scene.toml".to_string(), line }, problem),
            "{to}"
        );
    }
}

#[test]
fn the_nearest_key_value_or_name_is_suggested() {
    for (extra, suggestion) in [
        ("lenght = 2.0", Some("length")),
        ("integrator = { fidelity = \"gane\" }", Some("game")),
        ("initial = \"equilibrum\"", Some("equilibrium")),
        ("[[probe]]\nname = \"p\"\nenergy = \"slng\"", Some("sling")),
        ("[[attachment]]\ncable = \"sling\"\nat = \"ende\"\nbody = \"world\"", Some("end")),
        ("[[attachment]]\ncable = \"sling\"\nat = \"end\"\nbody = \"wrld\"", Some("world")),
        ("colour = \"red\"", None),
    ] {
        let error = error(&format!("{GOOD}{extra}\n"));
        assert_eq!(error.suggestion.as_deref(), suggestion, "{error}");
        assert_eq!(error.to_string().contains("Did you mean"), suggestion.is_some(), "{error}");
    }
    // the parsers of the mechanics suggest themselves
    for (extra, name) in [
        ("rule = \"projectd-3\"", "projected-3"),
        ("integrator = { method = \"esdirk5\", tolerance = 1e-6 }", "esdirk"),
    ] {
        let message = error(&format!("{GOOD}{extra}\n")).to_string();
        assert!(message.contains("did you mean") && message.contains(name), "{message}");
    }
}
