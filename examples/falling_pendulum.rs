//! The falling pendulum of Bulin & Hajzman: released from horizontal, followed for 2 s, checked against the real beam.
//!
//! `cargo run --release --example falling_pendulum` prints the tip and writes out/falling_pendulum/{tip.csv, snapshots.svg, tip.svg}.

use lariat::ancf::{At, Cable, Integrator, Method, Rule, Section, StepControl, Vector3};
use lariat_lab::figures::{self, Curve, Snapshot, TipFigure};
use lariat_lab::pendulum::{self, Trace};
use std::time::Instant;

const TOLERANCE: f64 = 1e-3; // m, largest distance of the tip from the real beam

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0)?) // side m, Young's modulus Pa, density kg/m^3
        .elements(16)
        .fix(At::Start)
        .build()?;
    let (out, beam, start) = (std::path::Path::new("out/falling_pendulum"), pendulum::beam(), Instant::now());
    let (mut tip, mut shots, mut csv) = (Vec::new(), Vec::new(), "t,x,y,z\n".to_string());
    for k in 0..=200 {
        let t = f64::from(k) / 100.0;
        cable.step(t - cable.time())?;
        let p = cable.sample(cable.length())?.position;
        tip.push(p);
        csv += &format!("{t:?},{:?},{:?},{:?}\n", p.x, p.y, p.z);
        if k % 20 == 0 {
            shots.push(Snapshot::of(&cable));
        }
        if k % 50 == 0 && k > 0 {
            println!(
                "t = {t:.1} s   tip x {:+.6} m, y {:+.6} m   real beam {:+.6}, {:+.6}",
                p.x, p.y, beam[k as usize].x, beam[k as usize].y
            );
        }
    }
    let (d, ms) = (*cable.diagnostics(), 1e3 * start.elapsed().as_secs_f64());
    println!("energy drift {:.2e} J of {:.2} J that fell", cable.energy().total(), -cable.energy().gravity);
    println!(
        "{} steps, {} rejected, {} Newton iterations, {} element evaluations, {ms:.1} ms",
        d.steps,
        d.rejected_steps,
        d.newton_iterations,
        d.element_evaluations()
    );

    std::fs::create_dir_all(out)?;
    std::fs::write(out.join("tip.csv"), csv)?;
    figures::snapshots(&out.join("snapshots.svg"), "Falling pendulum, 2 m", &shots)?;
    let exact = Integrator { method: Method::Rkn6, control: StepControl::Stable(0.5) };
    let paper = |rule: Rule| Trace::run(pendulum::cable(rule, 10, exact)?).map(|trace| trace.tip);
    let (g10, g3, st2) = (paper(Rule::gauss(10, 10)?)?, paper(Rule::gauss(3, 3)?)?, paper(Rule::ST2)?);
    let curve = |name: &str, y: &dyn Fn(usize) -> f64| Curve {
        name: name.into(),
        points: (0..=200).map(|k| (k as f64 / 100.0, y(k))).collect(),
    };
    let positions = vec![curve("x", &|k| tip[k].x), curve("y", &|k| tip[k].y)];
    let distances = vec![
        curve("16 elements, default rule, from the real beam", &|k| (tip[k] - beam[k]).norm()),
        curve("10 elements, G10-10, from the real beam", &|k| (g10[k] - beam[k]).norm()),
        curve("10 elements, G3-3, from G10-10", &|k| (g3[k] - g10[k]).norm()),
        curve("10 elements, ST2, from G10-10", &|k| (st2[k] - g10[k]).norm()),
    ];
    figures::tip(
        &out.join("tip.svg"),
        &TipFigure { title: "Tip of the falling pendulum".into(), positions, distances },
    )?;
    let error = (0..=200).map(|k| (tip[k] - beam[k]).norm()).fold(0.0, f64::max);
    println!(
        "largest distance from the real beam {error:.2e} m (allowed {TOLERANCE:.0e}); figures in {}",
        out.display()
    );
    if error < TOLERANCE { Ok(()) } else { Err(format!("{error:.2e} m from the real beam").into()) }
}
