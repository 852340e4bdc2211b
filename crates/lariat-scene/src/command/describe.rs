//! Results as text for a terminal.

use crate::run::{BodyStatics, CableStatics, Summary};
use lariat_ancf::study::{ForceClaim, Target};
use std::fmt::Write as _;
use std::path::Path;

/// Describes a run in time.
pub fn run(summary: &Summary, folder: &Path) -> String {
    let energy = |x: Option<f64>| x.map_or("not finite".to_string(), |x| format!("{x:.6} J"));
    format!(
        "{}: {} s in {:.3} s ({:.1} times real time), {} steps, {} rejected, {} Newton iterations, energy {} -> {}\n{}{}",
        summary.name,
        summary.simulated_s,
        summary.wall_s,
        summary.real_time_factor,
        summary.steps,
        summary.rejected_steps,
        summary.newton_iterations,
        energy(summary.energy_start_j),
        energy(summary.energy_end_j),
        claim(summary),
        results(folder)
    )
}

/// Describes the static equilibrium of each cable.
pub fn statics(summary: &Summary, folder: &Path) -> String {
    let cables: String = summary.statics.iter().flatten().map(cable).collect();
    let bodies = summary.static_bodies.as_ref().map_or(String::new(), bodies);
    format!(
        "{}: static equilibrium in {:.3} s\n{cables}{bodies}{}{}",
        summary.name,
        summary.wall_s,
        claim(summary),
        results(folder)
    )
}

/// Describes what is claimed about the error that was asked for.
fn claim(summary: &Summary) -> String {
    let Some(error) = &summary.error else { return String::new() };
    let claim = &error.claim;
    let (target, claimed, mesh, time) = match &claim.forces {
        Some(ForceClaim { quantity, relative, asked, claimed, mesh, time, .. }) => {
            (Target { quantity: *quantity, error: *asked, relative: *relative }, *claimed, *mesh, Some(*time))
        }
        None => (Target::from(claim.asked_m.unwrap_or(f64::NAN)), claim.claimed_m, claim.mesh_m, claim.time_m),
    };
    let (of, asked) = (target.quantity, target.text(target.error));
    let text = |error: f64| match target.relative {
        true => format!("{:.1e} %", 100.0 * error),
        false => format!("{error:.1e} {}", target.unit()),
    };
    let verdict = match (claimed, claim.horizon_s) {
        (Some(claimed), _) => format!("error of {of} at most {}", text(claimed)),
        (None, Some(until)) => {
            format!("error of {of} at most {asked} before {} s, not proven from then on", short(until))
        }
        (None, None) => format!("error of {asked} not proven"),
    };
    let [mesh, time] = [mesh, time].map(|error| error.map_or("not known".to_string(), text));
    let elements: Vec<String> = error.elements_of.iter().map(|(name, n)| format!("{name:?} {n}")).collect();
    let tolerance = claim.tolerance_m.map_or(String::new(), |tolerance| format!(", tolerance {tolerance:.1e} m"));
    let parts = if claim.parts > 1 { format!(", host steps in {} parts", claim.parts) } else { String::new() };
    format!(
        "{verdict} (mesh {mesh}, time {time}{})\n  elements {}{tolerance}{parts}; {} runs, {:.1} times the cost of the last\n  not covered: {}\n",
        if claim.host_step_limits { ": the host step limits the steps" } else { "" },
        elements.join(", "),
        claim.runs,
        claim.cost,
        error.not_covered.join("; ")
    )
}

fn cable(statics: &CableStatics) -> String {
    let stable = if statics.stable { "stable" } else { "unstable or indifferent" };
    let sag = statics.sag_m.map_or(String::new(), |sag| format!(", sag {} m", short(sag)));
    let friction = match statics.friction_n {
        0.0 => String::new(),
        held => format!("\n  without friction, which could hold {held:.1e} N along it"),
    };
    let mut text = format!(
        "cable {:?}: {stable}, residual {:.1e} N after {} iterations\n  peak tension {} N at {} m{sag}{friction}\n",
        statics.name,
        statics.residual_n,
        statics.iterations,
        short(statics.peak_tension_n),
        short(statics.peak_tension_at_m)
    );
    let length = statics.reactions.last().map_or(0.0, |reaction| reaction.at_m);
    let moment = statics.peak_tension_n.abs() * length;
    for reaction in &statics.reactions {
        // writing to a String cannot fail
        let _ = writeln!(
            text,
            "  on {:?} at {} m: force {} N, moment {} N m",
            reaction.name,
            short(reaction.at_m),
            vector(&reaction.force_n, 0.0),
            vector(&reaction.moment_nm, moment)
        );
    }
    text
}

fn bodies(statics: &BodyStatics) -> String {
    let mut text = String::new();
    for body in &statics.moved {
        let (position, rotation) = (vector(&body.position_m, 1.0), vector(&body.rotation_rad, 1e4));
        // writing to a String cannot fail
        let _ = writeln!(text, "body {:?}: at {position} m, rotated by {rotation} rad", body.name);
    }
    for name in &statics.held {
        let _ = writeln!(text, "body {name:?}: held where it is drawn");
    }
    text
}

/// Returns three numbers, with zero for those that are rounding errors of the largest, or of a
/// quantity of size `scale`.
fn vector(x: &[f64; 3], scale: f64) -> String {
    let largest = x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let least = (1e-9 * largest).max(1e-12 * scale);
    let numbers = x.map(|x| if x.abs() <= least { "0".to_string() } else { short(x) });
    format!("[{}]", numbers.join(", "))
}

/// Returns a number with six significant digits.
fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

fn results(folder: &Path) -> String {
    format!("results in {}\n", folder.display())
}
