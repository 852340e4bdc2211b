//! The table: Markdown for readers, CSV for programs.

use super::Family;
use super::host::{Host, Make, RATES};
use super::outcome::{Outcome, Row};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Heading of the list of misses, which the tests read.
pub const MISSES: &str = "## Targets missed";

/// One line of the list of misses: what identifies a run.
pub fn key(row: &Row) -> String {
    format!("{}: {} | {}", row.family, row.case, row.host)
}

/// Keys of the misses listed in a report, but for runs over their budget of time, which depend on the machine.
pub fn listed_misses(markdown: &str) -> Vec<String> {
    let list = markdown.split_once(MISSES).map_or("", |(_, rest)| rest);
    let rows = list.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| case"));
    let rows = rows.filter(|line| !line.contains(" | over budget | "));
    rows.filter_map(|line| {
        let mut cells = line.trim_start_matches("| ").split(" | ");
        Some(format!("{} | {}", cells.next()?, cells.next()?))
    })
    .collect()
}

fn number(x: f64) -> String {
    if !x.is_finite() {
        "-".to_string()
    } else if x == 0.0 {
        "0".to_string()
    } else if (0.01..1e4).contains(&x.abs()) {
        format!("{x:.3}")
    } else {
        format!("{x:.1e}")
    }
}

/// How some runs ended, in a word or two.
fn summary(rows: &[&Row]) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in rows {
        *counts.entry(row.outcome.word()).or_default() += 1;
    }
    match counts.len() {
        1 => counts.keys().next().map_or(String::new(), |word| (*word).to_string()),
        _ => counts.iter().map(|(word, n)| format!("{n} {word}")).collect::<Vec<_>>().join(", "),
    }
}

fn rival(row: Option<&&Row>) -> String {
    row.map_or("-".to_string(), |r| match &r.outcome {
        Outcome::Held => format!("{} %, {} m", number(100.0 * r.stretch), number(r.gap)),
        outcome => match outcome {
            Outcome::Failed(_) => format!("flies apart ({} %)", number(100.0 * r.stretch)),
            Outcome::OverBudget(_) => format!("over budget, {} %, {} m", number(100.0 * r.stretch), number(r.gap)),
            _ => outcome.word().to_string(),
        },
    })
}

/// The report; `machine` and `command` say how it was made.
pub fn markdown(rows: &[Row], machine: &str, command: &str) -> String {
    let mut out = format!(
        "# Hard cases\n\nMade by `{command}`; do not edit. {machine}\n\n\
         A case is run at four host steps, with 1, 4 and 8 solver iterations, over rapier3d and rapier3d-f64 (24 hosts), and with all \
         effects on at 4 iterations (8 hosts: damping, drag in a wind, buoyancy and added mass, a curled rest shape, a line load, \
         gravity times 0.9; there only what holds for all cases is asked). A line sums up the hosts with one step: *outcome* \
         counts them, numbers are the worst of them. *Energy* is the change of kinetic, strain and gravity energy, less the work put in \
         by moved bodies, loads and a flow and what damping and drag took, over the largest kinetic and strain energy of the run (or what the \
         weight of all does over 1 mm, if that is more); *gap* the widest \
         of an attachment; *constraint* the worst error of Rapier's own joints, which are Rapier's to keep; *rejected* steps of the \
         integrator, of those taken and rejected; *cost* is CPU time of the thread per host step, measuring included, runs side by side: \
         indicative.\n\n\
         What holds for all: every number finite; gap <= 1e-3 m (the contract; other bounds stand with the case); energy made <= 1 % \
         (conservation; jams and joints, which Rapier corrects by position, 10 %). The bounds particular to a case, and their sources, stand \
         in `crates/lariat-bench/src/stability/cases`. *Refused*: the step ended in an error that names the culprit, where a case \
         allows that, and the last good state was intact.\n\n\
         Beside it, in single precision with 4 iterations and the same split of the host step in four, what Rapier's soft rope (edges of 1e6 Hz), \
         and chains of capsules on spherical joints do: largest stretch, widest gap at their ends. The bodies and what is done to them are the same; \
         they have no bending and no material, so no more is asked of them than not to fly apart. `-`: cannot be asked.\n"
    );
    let kept = rows.iter().filter(|r| r.make == Make::Lariat && r.outcome.is_kept()).count();
    let ours = rows.iter().filter(|r| r.make == Make::Lariat).count();
    let _ = writeln!(
        out,
        "\n{kept} of {ours} runs held or were refused as they should; the others are listed at the end.\n"
    );
    for family in Family::ALL {
        let of: Vec<&Row> = rows.iter().filter(|r| r.family == family.name()).collect();
        if !of.is_empty() {
            table(&mut out, family, &of);
        }
    }
    let _ = write!(out, "{MISSES}\n\n| case | host | outcome | number |\n|---|---|---|---|\n");
    for row in rows.iter().filter(|r| r.make == Make::Lariat && !r.outcome.is_kept()) {
        let reason = row.outcome.reason().replace('|', "/");
        let _ = writeln!(out, "| {} | {} | {reason} |", key(row), row.outcome.word());
    }
    out
}

fn table(out: &mut String, family: Family, rows: &[&Row]) {
    let _ = write!(
        out,
        "## {}\n\n| case | host step | outcome | energy | gap m | constraint m | rejected | cost us | soft rope | capsules, impulse | \
         capsules, multibody |\n|---|---|---|---:|---:|---:|---:|---:|---|---|---|\n",
        family.name()
    );
    let mut cases: Vec<&str> = Vec::new();
    for row in rows {
        let name = if family == Family::Random { "scenes" } else { row.case.as_str() };
        if !cases.contains(&name) {
            cases.push(name);
        }
    }
    for case in cases {
        for rate in RATES {
            for effects in [false, true] {
                let same = |r: &&&Row| {
                    (family == Family::Random || r.case == case) && r.host.rate == rate && r.host.effects == effects
                };
                let here: Vec<&Row> = rows.iter().filter(same).copied().collect();
                let ours: Vec<&Row> = here.iter().filter(|r| r.make == Make::Lariat).copied().collect();
                if ours.is_empty() {
                    continue;
                }
                let worst = |of: &dyn Fn(&Row) -> f64| {
                    ours.iter().map(|r| of(r)).fold(0.0, |a: f64, b: f64| if b.abs() > a.abs() { b } else { a })
                };
                let (steps, rejected) = ours.iter().fold((0, 0), |a, r| (a.0 + r.steps, a.1 + r.rejected));
                let peer = |make: Make| rival(here.iter().find(|r| r.make == make));
                let _ = writeln!(
                    out,
                    "| {case}{} | 1/{rate} | {} | {} | {} | {} | {rejected} of {} | {} | {} | {} | {} |",
                    if effects { ", effects" } else { "" },
                    summary(&ours),
                    number(worst(&|r| r.energy)),
                    number(worst(&|r| r.gap)),
                    number(worst(&|r| r.constraint)),
                    steps + rejected,
                    number(ours.iter().map(|r| r.micros).sum::<f64>() / ours.len() as f64),
                    peer(Make::SoftRope),
                    peer(Make::Capsules),
                    peer(Make::Multibody),
                );
            }
        }
    }
    out.push('\n');
}

/// Every run, as CSV.
pub fn csv(rows: &[Row]) -> String {
    let mut out = String::from(
        "family,case,rate,iterations,precision,effects,make,outcome,energy,gap_m,constraint_m,stretch,steps,rejected,us_per_host_step,cpu_s,reason\n",
    );
    for r in rows {
        let Host { rate, iterations, precision, effects } = r.host;
        let _ = writeln!(
            out,
            "{},\"{}\",{rate},{iterations},{precision:?},{effects},{},{},{:e},{:e},{:e},{:e},{},{},{:.2},{:.4},\"{}\"",
            r.family,
            r.case,
            r.make.name().replace(',', ""),
            r.outcome.word(),
            r.energy,
            r.gap,
            r.constraint,
            r.stretch,
            r.steps,
            r.rejected,
            r.micros,
            r.seconds,
            r.outcome.reason().replace('"', "'"),
        );
    }
    out
}
