//! A tackle of four with friction at its sheaves: `cargo run --release --example tackle`.
//!
//! Runs assets/scenes/tackle.toml, as `lariat run` does, and writes out/tackle/view.html, a page that plays the motion.
//!
//! # References
//!
//! Light rope, k = exp(mu pi) at each of the four sheaves, T the tension of the first part: `P (g - v') = k^4 T` and
//! `T (1 + k + k^2 + k^3) = W (g + v'/4)`.

use lariat_scene::run::{Options, World, run};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

const G: f64 = 9.81; // m/s^2

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::read(Path::new("assets/scenes/tackle.toml"), &[], Purpose::Run)?;
    let out = Path::new("out/tackle");
    let summary = run(&scene, out, &mut Options::default())?;
    println!("{} s in {:.2} s; open {}", summary.simulated_s, summary.wall_s, out.join("view.html").display());

    // the same without files: step a world and read it
    let mut world = World::build(&scene)?;
    world.start(Purpose::Run)?;
    let speed = |world: &World, body: usize| world.body(body).map_or(f64::NAN, |body| body.velocity.y);
    let mut before = f64::NAN;
    for step in 1..=54 {
        world.advance(f64::from(step) / 60.0)?;
        if step == 24 {
            // the ropes are stretched
            before = speed(&world, 1);
        }
    }
    let k = (0.05 * std::f64::consts::PI).exp();
    let (sum, load, block) = (1.0 + k + k * k + k * k * k, 16.0, 24.0);
    let expected = (load * G * sum / k.powi(4) - block * G) / (load * sum / k.powi(4) + block / 4.0);
    let acceleration = (before - speed(&world, 1)) / 0.5;
    let ratio = -speed(&world, 1) / speed(&world, 0);
    let tensions = world.sheave(3).map_or(f64::NAN, |sheave| sheave[3] / sheave[2]);
    println!(
        "the load falls with {acceleration:.4} m/s^2 of {expected:.4} m/s^2, {ratio:.3} times as fast as the block rises"
    );
    println!("ratio of tensions at the last sheave {tensions:.5} of {k:.5}");
    let fine =
        (acceleration / expected - 1.0).abs() < 0.01 && (ratio - 4.0).abs() < 0.04 && (tensions / k - 1.0).abs() < 2e-3;
    if fine { Ok(()) } else { Err("the tackle does not move as its equation says".into()) }
}
