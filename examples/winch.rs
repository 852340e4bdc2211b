//! A winch lifts a crate of 50 kg by 3 m and lowers it again: `cargo run --release --example winch`.
//!
//! Runs assets/scenes/winch.toml, as `lariat run` does, and writes out/winch/view.html, a page that plays the motion.
//!
//! # References
//!
//! At a constant rate the winch pulls with the weight of crate and rope. The crate rises by what is wound up, and by the change of the
//! stretch (M + rho A L/2) g L/EA. What the winch works raises the crate and the rope.

use lariat_ancf::At;
use lariat_scene::run::{Options, World, run};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

const G: f64 = 9.81; // m/s^2

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::read(Path::new("assets/scenes/winch.toml"), &[], Purpose::Run)?;
    let out = Path::new("out/winch");
    let summary = run(&scene, out, &mut Options::default())?;
    println!("{} s in {:.2} s; open {}", summary.simulated_s, summary.wall_s, out.join("view.html").display());

    // the same without files: step a world and read it
    let mut world = World::build(&scene)?;
    world.start(Purpose::Run)?;
    let height = |world: &World| world.body(0).map_or(f64::NAN, |body| body.position.y);
    let (start, mut pull, mut top, mut highest) = (height(&world), 0.0, f64::NAN, 0.0f64);
    for step in 1..=900 {
        world.advance(f64::from(step) / 60.0)?;
        let Some(reel) = world.cables()[0].reel(At::End) else { continue };
        if (240..300).contains(&step) {
            // mean over a second of hoisting, of the pull beside the weight
            pull += reel.force / ((50.0 + 0.3 * reel.length_out) * G) / 60.0;
        }
        if step == 475 {
            top = height(&world) - start;
            println!("{:.4} m out, work {:.1} J", reel.length_out, reel.work);
        }
        highest = highest.max(reel.force);
    }
    let stretch = |l: f64| (50.0 + 0.15 * l) * G * l / 2.0e5;
    let expected = 3.0 + stretch(4.0) - stretch(1.0);
    let back = height(&world) - start;
    println!("lifted {top:.4} m of {expected:.4} m, back at {back:.5} m");
    println!("pull over weight {pull:.5} at a constant rate, at most {highest:.0} N");
    let fine = (top - expected).abs() < 2e-3 && back.abs() < 2e-3 && (pull - 1.0).abs() < 5e-3;
    if fine { Ok(()) } else { Err("height or pull differ from statics".into()) }
}
