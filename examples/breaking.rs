//! A bridge loses a cable: `cargo run --release --example breaking`.
//!
//! The suspension bridge of assets/scenes/bridge.toml; after 2 s its north cable is cut in the middle. Writes out/breaking/view.html, a
//! page that plays the motion.
//!
//! # References
//!
//! The cut changes no energy but what it reports. Then the middle plate, of half width b = 1.1 m, hangs on its south hanger alone, at
//! a = 1 m from its centre, and turns about it. A bar held by a string that stays upright has the angular acceleration
//! `m g a/(m b^2/3 + m a^2)`, so its centre falls by `1/2 g t^2 a^2/(a^2 + b^2/3)` while the angle is small.

use lariat_ancf::Fidelity;
use lariat_scene::run::{Options, World, run};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

const G: f64 = 9.81; // m/s^2

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let overrides = ["duration=3.0", "cable.north.break={ time = 2.0, at = 6.0 }"].map(String::from);
    let mut scene = Scene::read(Path::new("assets/scenes/bridge.toml"), &overrides, Purpose::Run)?;
    for cable in &mut scene.cables {
        // the ends whip: a step that is controlled by its error follows every crack
        cable.integrator = Fidelity::Game;
    }
    let out = Path::new("out/breaking");
    let summary = run(&scene, out, &mut Options::default())?;
    println!("{} s in {:.2} s; open {}", summary.simulated_s, summary.wall_s, out.join("view.html").display());
    for parted in &summary.breaks {
        let Some(start) = summary.energy_start_j else { continue };
        println!(
            "{} is cut at {:.3} s under {:.0} N: {:.2} J of strain, {:.1e} J added by the edit, of {start:.0} J in all",
            parted.cable, parted.time_s, parted.tension_n, parted.strain_energy_j, parted.inserted_energy_j
        );
    }

    // the same without files: step a world and read it
    let mut world = World::build(&scene)?;
    world.start(Purpose::Run)?;
    let plate = scene.bodies.iter().position(|body| body.name == "deck 3").ok_or("no deck 3")?;
    let height = |world: &World| world.body(plate).map_or(f64::NAN, |body| body.position.y);
    (1..=120).try_for_each(|step| world.advance(f64::from(step) / 60.0))?;
    let (before, time) = (height(&world), 12.0 / 60.0);
    (121..=132).try_for_each(|step| world.advance(f64::from(step) / 60.0))?;
    let (fallen, hinged) = (before - height(&world), 0.5 * G * time * time / (1.0 + 1.1 * 1.1 / 3.0));
    println!("the middle plate falls {:.1} mm in {time} s, a hinged bar {:.1} mm", 1e3 * fallen, 1e3 * hinged);
    let fine = world.cables().len() == scene.cables.len() + 1 && (fallen / hinged - 1.0).abs() < 0.05;
    if fine { Ok(()) } else { Err("the plate does not fall as a hinged bar".into()) }
}
