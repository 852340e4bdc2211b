//! Steps of a cable without effects, for counting instructions:
//! `valgrind --tool=callgrind target/release/examples/bare_steps N`, once with N = 0 and once with N = 1000. On the x86-64 baseline
//! instruction set, because valgrind does not know the newer ones.

use fearless_simd::Level;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{At, Cable, Integrator, Method, Section, Vector3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let steps = std::env::args().nth(1).map_or(Ok(1000), |n| n.parse::<u32>())?;
    let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0), Vector3::new(2.0, 1.0, 0.3)];
    let builder = Cable::builder().points(points).section(Section::square(0.01, 1.0e8, 4000.0)?);
    let mut cable = builder.elements(64).fix(At::Start).build()?;
    cable.set_integrator(Integrator::substeps(Method::DiscreteGradient, 1)?)?;
    cable.set_simd_level(Level::baseline())?;
    for _ in 0..steps {
        cable.step(1e-4)?;
    }
    println!("{:?}", cable.diagnostics());
    Ok(())
}
