//! The falling pendulum of Bulín & Hajžman, released from horizontal and followed for 2 s: `cargo run --release --example falling_pendulum`.
//!
//! Compares the tip with the converged solution of an independent program, and writes out/falling_pendulum/{tip.csv, snapshots.svg, tip.svg}.

use cpu_time::ProcessTime;
use lariat::{At, Cable, Section, Vector3};
use lariat_figures::reference_pendulum as pendulum;
use lariat_figures::{self as figures, Shape, ShapeFigure};

const TOLERANCE: f64 = 1e-3; // m, largest allowed distance of the tip from the converged solution

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0)?) // side m, Young's modulus Pa, density kg/m^3
        .elements(16)
        .fix(At::Start)
        .build()?;
    let (mut tip, mut shapes, mut csv, mut cpu_ms) = (Vec::new(), Vec::new(), "t,x,y,z\n".to_string(), 0.0);
    for k in 0..=200 {
        let (t, clock) = (f64::from(k) / 100.0, ProcessTime::now());
        cable.step(t - cable.time())?;
        cpu_ms += 1e3 * clock.elapsed().as_secs_f64();
        let p = cable.sample(cable.length())?.position;
        tip.push(p);
        csv += &format!("{t:?},{:?},{:?},{:?}\n", p.x, p.y, p.z);
        if k % 20 == 0 {
            shapes.push(Shape::of(&cable));
        }
    }

    let beam = pendulum::beam();
    for k in [50, 100, 150, 200] {
        let (t, p, real) = (k as f64 / 100.0, tip[k], beam[k]);
        println!("t = {t:.1} s: tip {:+.6} {:+.6} m, converged {:+.6} {:+.6} m", p.x, p.y, real.x, real.y);
    }
    let (d, energy) = (cable.diagnostics(), cable.energy());
    println!("change of energy {:+.2e} J, work of gravity {:.3} J", energy.total(), -energy.gravity);
    println!("{} steps, {} rejected, {} Newton iterations", d.steps, d.rejected_steps, d.newton_iterations);
    println!(
        "{} factorisations, {} element evaluations, CPU {cpu_ms:.1} ms",
        d.factorisations,
        d.element_evaluations()
    );

    let out = std::path::Path::new("out/falling_pendulum");
    std::fs::create_dir_all(out)?;
    std::fs::write(out.join("tip.csv"), csv)?;
    let snapshots = ShapeFigure { title: "Falling pendulum, 2 m".into(), shapes };
    std::fs::write(out.join("snapshots.svg"), snapshots.svg()?)?;
    std::fs::write(out.join("tip.svg"), figures::pendulum_tip("16 elements, default rule", &tip)?.svg()?)?;

    let error = tip.iter().zip(&beam).map(|(p, real)| (p - real).norm()).fold(0.0, f64::max);
    println!(
        "largest distance from the converged solution {error:.1e} m, allowed {TOLERANCE:.0e} m; files in {}",
        out.display()
    );
    if error < TOLERANCE { Ok(()) } else { Err(format!("{error:.1e} m from the converged solution").into()) }
}
