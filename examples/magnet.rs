//! A force of your own: a magnet beside a hanging rope pulls it, `cargo run --release --example magnet`. The energy must stay constant.

use lariat::{At, Cable, CablePoint, Fidelity, ForceDensity, Section, Vector3};
use std::sync::Arc;

/// A magnet with the potential `-strength/(distance^2 + size^2)` per length of rope.
#[derive(Debug)]
struct Magnet {
    position: Vector3<f64>, // m
    strength: f64,          // N m^2
    size: f64,              // m
}

impl Magnet {
    /// Returns the potential energy of a piece of rope in J/m.
    fn potential(&self, r: Vector3<f64>) -> f64 {
        -self.strength / ((r - self.position).norm_squared() + self.size * self.size)
    }
}

impl ForceDensity for Magnet {
    fn force(&self, at: &CablePoint) -> Vector3<f64> {
        let away = at.position - self.position;
        away * (-2.0 * self.strength / (away.norm_squared() + self.size * self.size).powi(2))
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let magnet = Arc::new(Magnet { position: Vector3::new(0.3, -0.8, 0.1), strength: 0.05, size: 0.1 });
    let mut rope = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -1.0, 0.0)])
        .section(Section::round(0.008, 1.0e7, 1200.0)?)
        .elements(20)
        .fix(At::Start)
        .fidelity(Fidelity::Reference)
        .force_density(magnet.clone())
        .build()?;
    // kinetic, strain and gravity energy, and that in the field of the magnet
    let energies = |rope: &Cable| -> Result<(f64, f64), lariat::Error> {
        let at = |i: u32| rope.sample((f64::from(i) + 0.5) / 2000.0);
        let field =
            (0..2000).map(|i| Ok(magnet.potential(at(i)?.position) / 2000.0)).sum::<Result<f64, lariat::Error>>()?;
        Ok((rope.energy().total(), field))
    };
    let (start, field) = energies(&rope)?;
    (0..120).try_for_each(|_| rope.step(1.0 / 60.0))?;
    let (end, field_end) = energies(&rope)?;
    let (tip, work) = (rope.sample(1.0)?.position, rope.effect_work().force_densities);
    println!("tip after {:.1} s at ({:.3}, {:.3}, {:.3}) m", rope.time(), tip.x, tip.y, tip.z);
    println!(
        "work of the magnet {work:.6} J, its field gave {:.6} J, the rope gained {:.6} J",
        field - field_end,
        end - start
    );
    let missing = (end + field_end - start - field).abs().max((work - (field - field_end)).abs());
    if missing < 1e-3 * work.abs() { Ok(()) } else { Err(format!("{missing:.2e} J are missing").into()) }
}
