//! The tables of the README, from the same run as the report.

use crate::Outcome;
use crate::measure::Row;
use lariat::{Integrator, Method, NewtonMode, StepControl};
use std::fmt::Write as _;

/// Settings that the README shows.
fn shown() -> Vec<Integrator> {
    let tolerance = |method, t| Integrator { method, control: StepControl::Tolerance(t) };
    let default = Integrator::default().method;
    let game = Method::GeneralisedAlpha { rho: 0.5, newton: NewtonMode::Once };
    let mut settings = [1e-5, 1e-6, 1e-7, 1e-8].map(|t| tolerance(default, t)).to_vec();
    settings.extend([Method::Esdirk3, Method::TrBdf2, Method::Trapezoid].map(|method| tolerance(method, 1e-6)));
    settings.push(Integrator { method: game, control: StepControl::Substeps(8) });
    settings
        .extend([Method::Verlet, Method::Rkn4].map(|method| Integrator { method, control: StepControl::Stable(0.95) }));
    settings
}

fn cost(rows: &[&Row]) -> Outcome<String> {
    let mut out = String::from(
        "| integrator | control | time ms | tip error m | steps | tip error / tolerance |\n|---|---|---:|---:|---:|---:|\n",
    );
    for integrator in shown() {
        let row =
            rows.iter().find(|r| r.integrator == integrator).ok_or("a setting of the README is not in the report")?;
        let ratio = match integrator.control {
            StepControl::Tolerance(t) => format!("{:.0}", row.error / t),
            _ => String::new(),
        };
        let default = if integrator == Integrator::default() { "**" } else { "" };
        writeln!(
            out,
            "| {default}{}{default} | {} | {:.2} | {:.1e} | {} | {ratio} |",
            integrator.method,
            row.control(),
            row.milliseconds,
            row.error,
            row.diagnostics.steps
        )?;
    }
    Ok(out)
}

/// Replaces what stands between `<!-- name -->` and `<!-- /name -->`.
fn replace(text: &str, name: &str, new: &str) -> Outcome<String> {
    let (open, close) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let (before, rest) = text.split_once(&open).ok_or(format!("no {open:?}"))?;
    let (_, after) = rest.split_once(&close).ok_or(format!("no {close:?}"))?;
    Ok(format!("{before}{open}{new}{close}{after}"))
}

/// Puts the tables and the machine into a file.
pub fn update(file: &str, machine: &str, kernels: &str, rows: &[&Row]) -> Outcome<()> {
    let text = std::fs::read_to_string(file)?;
    let text = replace(&text, "cost", &format!("{}\n{machine}\n", cost(rows)?))?;
    Ok(std::fs::write(file, replace(&text, "kernels", kernels)?)?)
}
