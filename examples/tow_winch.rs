//! A winch on a floating tug draws in a floating barge: `cargo run --release --example tow_winch`.
//!
//! Runs assets/scenes/tow_winch.toml, as `lariat run` does, and writes out/tow_winch/view.html, a page that plays the motion.
//!
//! # References
//!
//! Conservation of momentum: with the stock S and the length L that is out, the barge moves with (m_tug + rho (S - L)) r/(m_tug + m_barge + rho S)
//! where the winch takes in with the rate r.

use lariat_ancf::At;
use lariat_scene::run::{Options, World, run};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::read(Path::new("assets/scenes/tow_winch.toml"), &[], Purpose::Run)?;
    let out = Path::new("out/tow_winch");
    let summary = run(&scene, out, &mut Options::default())?;
    println!("{} s in {:.2} s; open {}", summary.simulated_s, summary.wall_s, out.join("view.html").display());

    // the same without files: step a world and read it
    let mut world = World::build(&scene)?;
    world.start(Purpose::Run)?;
    let (mut most, mut drift, mut ratio) = (0.0f64, 0.0f64, f64::NAN);
    for step in 1..=900 {
        world.advance(f64::from(step) / 60.0)?;
        let Some(reel) = world.cables()[0].reel(At::End) else { continue };
        let speed = world.body(0).map_or(f64::NAN, |barge| barge.velocity.x);
        most = most.max(reel.force);
        drift = drift.max(world.momentum(None).linear.norm());
        if step == 900 {
            let expected = (800.0 + 0.8 * (60.0 - reel.length_out)) * -reel.rate / (3800.0 + 0.8 * 60.0);
            ratio = speed / expected;
            println!("{:.3} m out at {:.3} m/s; barge {speed:.5} m/s of {expected:.5} m/s", reel.length_out, reel.rate);
        }
    }
    println!("largest pull {most:.2} N, momentum at most {drift:.1e} kg m/s of {:.0}", 3000.0 * 0.1);
    let fine = (ratio - 1.0).abs() < 5e-3 && most < 250.0 * 1.02 && drift < 0.05;
    if fine { Ok(()) } else { Err("speed, pull or momentum differ from what they must be".into()) }
}
