//! What is fed with input from outside: each function takes any bytes, and must return, without a panic, soon, with little memory.
//!
//! `fuzz` at the root of the repository runs them by cargo-fuzz, `main.rs` over its corpus and mutations of it.

#![allow(dead_code, reason = "a fuzz target uses one of them")]

use lariat_ancf::Cable;
use lariat_scene::run::World;
use lariat_scene::{Purpose, Scene, mjcf};

/// Most elements of a scene that is built: more are no other code.
const ELEMENTS: usize = 64;
/// Time in s for which what can be built is stepped: stiff inputs take many steps for a longer one, which is no fault.
const TIME: f64 = 1e-9;

/// A scene file: parsed, and if it is a small scene, built and stepped.
pub fn scene(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    for purpose in [Purpose::Run, Purpose::Static] {
        // a message is made of every error
        let scene = match Scene::parse("fuzz.toml", &text, &[], purpose) {
            Ok(scene) => scene,
            Err(error) => return drop(error.to_string()),
        };
        if scene.cables.iter().map(|cable| cable.elements).sum::<usize>() > ELEMENTS {
            return;
        }
        let built = World::build(&scene).and_then(|mut world| world.advance(TIME).map(|()| world));
        let _ = built.map_err(|error| error.to_string());
    }
}

/// A model of MuJoCo: what is imported is a scene.
pub fn mjcf(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    match mjcf::import("fuzz.xml", &text) {
        Ok(scene) => drop(Scene::parse("fuzz.toml", &scene, &[], Purpose::Run).map_err(|error| error.to_string())),
        Err(error) => drop(error.to_string()),
    }
}

/// A mesh of a body.
pub fn mesh(data: &[u8]) {
    let Ok(folder) = tempfile::tempdir() else { return };
    let scene = "duration = 1.0\n[[body]]\nname = \"b\"\nkind = \"fixed\"\nshape = { mesh = \"fuzz.obj\" }\n";
    if std::fs::write(folder.path().join("fuzz.obj"), data).is_ok() {
        let file = folder.path().join("fuzz.toml");
        let read = Scene::parse(&file.display().to_string(), scene, &[], Purpose::Run);
        let _ = read.map_err(|error| error.to_string());
    }
}

/// A saved cable: what is read back is stepped, and saved again.
pub fn snapshot(data: &[u8]) {
    let Ok(mut cable) = serde_json::from_slice::<Cable>(data) else { return };
    if cable.elements().len() > ELEMENTS {
        return;
    }
    let _ = cable.step(TIME).map_err(|error| error.to_string());
    let _ = cable.sample(0.5 * cable.length()).map_err(|error| error.to_string());
    let _ = serde_json::to_vec(&cable);
}
