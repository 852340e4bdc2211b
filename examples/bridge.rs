//! A suspension bridge: two main cables, hangers tied to them, five deck plates. `cargo run --release --example bridge`
//!
//! Runs 2 s of assets/scenes/bridge.toml, as `lariat run` does, and writes out/bridge/view.html, a page that plays the motion.
//!
//! # References
//!
//! Equal loads P at equal distances d make a parabola, `H f = w L^2/8` with `w = P/d`: here 4.5 P d; the main cable's own weight
//! (0.08 kg/m x 12.47 m) adds its weight times L/8. Cubic elements cannot have the kinks of a light cable at the hangers, which accounts
//! for 0.35 %.

use lariat_scene::run::{Options, World, run};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

const G: f64 = 9.81; // m/s^2
const DECK: f64 = 40.0; // kg, of one plate on two hangers

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::read(Path::new("assets/scenes/bridge.toml"), &["duration=2.0".to_string()], Purpose::Run)?;
    let out = Path::new("out/bridge");
    let summary = run(&scene, out, &mut Options::default())?;
    println!("{} s in {:.2} s; open {}", summary.simulated_s, summary.wall_s, out.join("view.html").display());

    // the same without files: step a world and read it
    let mut world = World::build(&scene)?;
    world.start(Purpose::Run)?;
    let number = |name: &str| scene.attachments.iter().position(|a| a.name == name).ok_or(format!("no {name}"));
    let (tower, hanger) = (number("north left")?, number("north 3")?);
    let (mut pull, mut lift, mut sag) = (0.0, 0.0, 0.0);
    for step in 1..=240 {
        world.advance(f64::from(step) / 60.0)?;
        if step > 120 {
            // mean over the last 2 s: the deck still bounces by half a millimetre
            pull += world.attachment(tower)?.0.x / 120.0;
            lift += world.attachment(hanger)?.0.y / 120.0;
            let main = world.cables()[0];
            sag += (4.0 - main.sample(0.5 * main.length())?.position.y) / 120.0;
        }
    }
    let moment = 4.5 * (0.5 * DECK + 0.02 * 1.8) * G * 2.0 + 0.08 * G * 12.47 * 12.0 / 8.0;
    println!("sag {sag:.4} m, force at the tower {pull:.1} N, parabola {:.1} N", moment / sag);
    println!("hanger {lift:.2} N, half a plate weighs {:.2} N", 0.5 * DECK * G);
    let fine = (pull * sag / moment - 1.0).abs() < 5e-3 && (lift / (0.5 * DECK * G) - 1.0).abs() < 2e-3;
    if fine { Ok(()) } else { Err("force or sag differ from the parabola".into()) }
}
