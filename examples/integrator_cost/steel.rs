//! A steel cable, whose axial modes are 10^5 times faster than its swing.

use crate::Outcome;
use crate::measure::{readings, run};
use lariat::{At, Cable, Integrator, Method, NewtonMode, Preset, Section, StepControl, Vector3};
use std::fmt::Write as _;

const SECONDS: f64 = 2.0;

fn steel(integrator: Integrator) -> Outcome<Cable> {
    let section = Section::round(0.01, 2.1e11, 7850.0)?;
    let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    Ok(Cable::builder().points(points).section(section).elements(20).fix(At::Start).integrator(integrator).build()?)
}

fn settings(cable: &Cable) -> Vec<Integrator> {
    let alpha = Method::GeneralisedAlpha { rho: 0.0, newton: NewtonMode::Converged };
    let tolerances = [1e-4, 1e-5, 1e-6].map(StepControl::Tolerance);
    let fixed = [1, 4].map(StepControl::Substeps);
    let methods = [Method::Esdirk3, Method::Esdirk4, Method::TrBdf2, alpha];
    let adaptive = methods.into_iter().flat_map(|method| tolerances.map(|control| Integrator { method, control }));
    let fixed = fixed.map(|control| Integrator { method: alpha, control });
    adaptive.chain(fixed).chain([Preset::Game.integrator(cable.frequency_bound())]).collect()
}

/// Steel at two host steps.
pub fn report() -> Outcome<String> {
    let mut out = String::from(
        "\n## Steel\n\n2 m, round, 10 mm, E = 2.1e11 Pa, 7850 kg/m^3, 20 elements, released from horizontal, 2 s. *Tension* is the \
         largest force at the support at the host's steps.\n",
    );
    for rate in [60.0, 240.0] {
        let host = 1.0 / rate;
        let count = (SECONDS * rate) as usize;
        let fine = |tolerance| -> Outcome<_> {
            readings(&mut steel(Integrator::tolerance(Method::Esdirk4, tolerance)?)?, host, count)
        };
        let (exact, check) = (fine(1e-8)?, fine(1e-7)?);
        let own = exact.iter().zip(&check).map(|(a, b)| (a.tip - b.tip).norm()).fold(0.0, f64::max);
        let tension = exact.iter().map(|r| r.tension).fold(0.0, f64::max);
        let kinetic = exact.iter().map(|r| r.kinetic).fold(0.0, f64::max);
        write!(
            out,
            "\n### Host step 1/{rate} s\n\nReference: esdirk4 at 1e-8 m per step; at 1e-7 its tip differs by {own:.1e} m. Its largest \
             tension is {tension:.1} N, its largest kinetic energy {kinetic:.1} J.\n\n\
             | integrator | control | ms per simulated s | tip error m | tension N | energy J | steps | rejected | Newton | \
             factorisations |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n"
        )?;
        let cable = steel(Integrator::default())?;
        for integrator in settings(&cable) {
            let row = run(&cable, integrator, host, &exact, 5)?;
            let d = &row.diagnostics;
            let result = match &row.outcome {
                None => format!(
                    "{:.2} | {:.1e} | {:.1} | {:+.0e}",
                    row.milliseconds / SECONDS,
                    row.error,
                    row.tension,
                    row.energy
                ),
                Some(_) => format!("refused at {:.2} s | - | - | -", d.host_steps as f64 * host),
            };
            writeln!(
                out,
                "| {} | {result} | {} | {} | {} | {} |",
                row.setting(),
                d.steps,
                d.rejected_steps,
                d.newton_iterations,
                d.factorisations
            )?;
        }
    }
    Ok(out)
}
