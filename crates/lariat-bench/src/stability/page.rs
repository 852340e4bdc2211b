//! The results as a page: a summary by family, Rapier's own ropes beside it, and the bounds that
//! are missed; every run as CSV.

use super::family::Family;
use super::host::{CableModel, Host, Precision};
use super::misses::{self, Miss};
use super::outcome::{Outcome, Row};
use crate::error::Error;
use crate::page::{self, Section};
use crate::table::{Cell, Format, Table, hidden, shown};
use lariat_figures::{Curve, LogLog};
use std::collections::BTreeSet;

/// Says what is measured and what must hold.
const INTRODUCTION: &str = "\
Each case runs at four host steps (1/30, 1/60, 1/240 and 1/1000 s), with 1, 4 and 8 solver iterations, over rapier3d (`f32`) and \
rapier3d-f64: 24 hosts. With 4 iterations it runs once more with all effects (damping, drag in a wind, buoyancy and added mass, a rest \
curvature, a line load, gravity times 0.9, torsion between two clamps), where only the bounds common to all cases are checked: 8 hosts. Random scenes have one host \
each.\n\n\
Every run must keep every number finite, gaps of attachments below 1e-3 m, and the energy balance: energy made beyond the work from \
outside, and energy lost beyond what damping and drag dissipated, each below 1 % of the largest kinetic and strain energy of the run. \
Other bounds are stated with their reasons in the case (`crates/lariat-bench/src/stability/cases`), and so are the checks particular to \
it. Some cases may end in an error of the step; it must name the cable or the body, and leave the state bitwise as it was before the \
Rapier step that failed. A run may take a number of element evaluations (20 million unless the case says otherwise, about 4 s of CPU \
time); what is not done by then is *over budget*. Evaluations are the same on every machine, CPU times are not.";

/// Returns the page; `machine` and `command` say how it was made.
///
/// # Errors
/// [`Error::Figure`].
pub fn page(rows: &[Row], machine: &str, command: &str) -> Result<(String, Vec<Section>), Error> {
    let ours = || rows.iter().filter(|r| r.model == CableModel::Lariat);
    let missed: Vec<Miss> = ours().flat_map(misses::of).collect();
    let good = ours().filter(|r| r.outcome.is_good()).count();
    let introduction = format!(
        "Made by `{command}`; do not edit. {machine}\n\n{good} of {} runs of Lariat passed or ended in an error that their case allows.\n\n\
         {INTRODUCTION}",
        ours().count()
    );
    let mut summary = Section::new("Summary");
    summary.text(
        "*Error* counts runs that ended in an error that their case allows. *Energy made* and *lost* are the largest of the runs that \
         passed, as shares of the largest kinetic and strain energy of their run. *Rejected* is the share of integration steps that were tried and rejected.",
    );
    summary.excerpt(summary_table(rows));
    if let Some(text) = not_checked(rows) {
        summary.text(text);
    }

    summary.data(table(rows));
    let mut peers = Section::new("Beside the ropes of Rapier");
    peers.text(
        "The same bodies on ropes that Rapier itself offers: a soft rope with edges of 1e6 Hz, and chains of capsules on spherical joints. \
         They have no bending stiffness and no material, so that it is only counted how many fly apart (ten times their length, or NaN), \
         and how wide the gap at their ends becomes. Single precision, 4 solver iterations, and the host step split in four as in Lariat; \
         cases that they cannot do are left out.",
    );
    if let Some(svg) = figure(rows)? {
        let caption =
            "Stretch of a steel wire under a hanging load, 1/60 s; that of Lariat is the stretch of the material";
        peers.figure("stability", caption, svg);
    }
    peers.excerpt(peer_table(rows));
    let mut misses = Section::new("Bounds that are missed");
    if missed.is_empty() {
        misses.text("None.");
    } else {
        misses.text(
            "Bounds that Lariat misses by case, with the worst run. A run that ended before its time shows the share of it that was done. The tests compare with the \
             list in `crates/lariat-bench/stability_misses.csv`: they fail if a value of it becomes worse by more than 20 %, and also if \
             one becomes better, so that the list remains true.",
        );
        misses.excerpt(misses::summary(&missed));
    }
    misses.data(misses::table(&missed));
    let sections = vec![summary, peers, misses];
    Ok((page::markdown("Hard cases", &introduction, &sections), sections))
}

/// Returns every run as a table.
fn table(rows: &[Row]) -> Table {
    let columns = vec![
        hidden("family"),
        hidden("case"),
        hidden("host_steps_per_s"),
        hidden("solver_iterations"),
        hidden("precision"),
        hidden("effects"),
        hidden("model"),
        hidden("outcome"),
        hidden("completed"),
        hidden("energy"),
        hidden("energy_made"),
        hidden("energy_lost"),
        hidden("gap_m"),
        hidden("constraint_m"),
        hidden("stretch"),
        hidden("steps"),
        hidden("rejected_steps"),
        hidden("element_evaluations"),
        hidden("cpu_us_per_host_step"),
        hidden("cpu_s"),
        hidden("details"),
    ];
    let rows = rows.iter().map(|r| {
        let Host { rate, iterations, precision, effects } = r.host;
        vec![
            r.family.name().into(),
            r.case.clone().into(),
            u64::from(rate).into(),
            iterations.into(),
            if precision == Precision::Single { "f32" } else { "f64" }.into(),
            effects.to_string().into(),
            r.model.name().into(),
            r.outcome.name().into(),
            r.completed.into(),
            r.energy.into(),
            r.energy_made.into(),
            r.energy_lost.into(),
            r.gap.into(),
            r.constraint.into(),
            r.stretch.into(),
            r.steps.into(),
            r.rejected.into(),
            r.evaluations.into(),
            r.micros.into(),
            r.seconds.into(),
            r.outcome.details().into(),
        ]
    });
    Table { name: "stability", columns, rows: rows.collect() }
}

/// Returns the families that were run, with their runs of a model.
fn families(rows: &[Row], model: CableModel) -> impl Iterator<Item = (Family, Vec<&Row>)> {
    Family::ALL.into_iter().filter_map(move |family| {
        let of: Vec<&Row> = rows.iter().filter(|r| r.family == family && r.model == model).collect();
        (!of.is_empty()).then_some((family, of))
    })
}

fn largest(rows: &[&Row], value: impl Fn(&Row) -> f64) -> Cell {
    rows.iter().map(|r| value(r)).fold(None, |most: Option<f64>, x| Some(most.map_or(x, |m| m.max(x)))).into()
}

fn summary_table(rows: &[Row]) -> Table {
    let columns = vec![
        shown("family", "family", Format::Plain),
        shown("runs", "runs", Format::Plain),
        shown("passed", "passed", Format::Plain),
        shown("errors", "error", Format::Plain),
        shown("over_budget", "over budget", Format::Plain),
        shown("out_of_bounds", "out of bounds", Format::Plain),
        shown("failed", "failed", Format::Plain),
        shown("energy_made", "energy made", Format::Scientific(1)),
        shown("energy_lost", "energy lost", Format::Scientific(1)),
        shown("gap_m", "gap m", Format::Scientific(1)),
        shown("rejected", "rejected %", Format::Fixed(1)),
        shown("cpu_s", "CPU s", Format::Fixed(0)),
    ];
    let row = |(family, of): (Family, Vec<&Row>)| {
        let count = |fits: fn(&Outcome) -> bool| Cell::from(of.iter().filter(|r| fits(&r.outcome)).count());
        let passed: Vec<&Row> = of.iter().copied().filter(|r| r.outcome == Outcome::Passed).collect();
        let checked: Vec<&Row> = passed.iter().copied().filter(|r| r.energy_not_checked.is_none()).collect();
        let (steps, rejected) = of.iter().fold((0, 0), |a, r| (a.0 + r.steps + r.rejected, a.1 + r.rejected));
        vec![
            family.name().into(),
            of.len().into(),
            passed.len().into(),
            count(|o| matches!(o, Outcome::StepError(_))),
            count(|o| *o == Outcome::OverBudget),
            count(|o| matches!(o, Outcome::OutOfBounds(_))),
            count(|o| matches!(o, Outcome::Failed(_) | Outcome::Panicked(_) | Outcome::NotFinite)),
            largest(&checked, |r| r.energy_made),
            largest(&checked, |r| r.energy_lost),
            largest(&passed, |r| r.gap),
            (100.0 * rejected as f64 / (steps as f64).max(1.0)).into(),
            of.iter().map(|r| r.seconds).sum::<f64>().into(),
        ]
    };
    Table { name: "stability_summary", columns, rows: families(rows, CableModel::Lariat).map(row).collect() }
}

/// Lists the cases whose energy balance is not checked, with the reasons.
fn not_checked(rows: &[Row]) -> Option<String> {
    let reason = |r: &Row| Some(format!("- {}: {}: {}", r.family.name(), r.case, r.energy_not_checked?));
    let lines: BTreeSet<String> = rows.iter().filter_map(reason).collect();
    let list = lines.into_iter().collect::<Vec<_>>().join("\n");
    (!list.is_empty()).then(|| format!("The energy balance has no bounds in:\n\n{list}"))
}

fn peer_table(rows: &[Row]) -> Table {
    let columns = vec![
        shown("family", "family", Format::Plain),
        shown("runs", "runs", Format::Plain),
        shown("lariat_gap_m", "Lariat: gap m", Format::Scientific(1)),
        shown("soft_failed", "soft rope: fly apart", Format::Plain),
        shown("soft_gap_m", "gap m", Format::Scientific(1)),
        shown("capsules_failed", "capsules, impulse joints: fly apart", Format::Plain),
        shown("capsules_gap_m", "gap m", Format::Scientific(1)),
        shown("multibody_failed", "capsules, multibody joints: fly apart", Format::Plain),
        shown("multibody_gap_m", "gap m", Format::Scientific(1)),
    ];
    let row = |(family, soft): (Family, Vec<&Row>)| {
        let same = |r: &&Row| soft.iter().any(|s| s.case == r.case && s.host == r.host);
        let of = |model| rows.iter().filter(|r| r.family == family && r.model == model).filter(same).collect();
        let mut row: Vec<Cell> = vec![family.name().into(), soft.len().into()];
        for model in CableModel::ALL {
            let of: Vec<&Row> = of(model);
            let broken =
                |r: &&&Row| matches!(r.outcome, Outcome::Failed(_) | Outcome::Panicked(_) | Outcome::NotFinite);
            if model != CableModel::Lariat {
                row.push(of.iter().filter(broken).count().into());
            }
            let whole: Vec<&Row> = of.iter().copied().filter(|r| !broken(&r)).collect();
            row.push(largest(&whole, |r| r.gap));
        }
        row
    };
    Table { name: "stability_peers", columns, rows: families(rows, CableModel::SoftRope).map(row).collect() }
}

/// Draws the stretch of a hanging load against its mass, if those cases were run.
fn figure(rows: &[Row]) -> Result<Option<String>, Error> {
    let curve = |model: CableModel| {
        let hanging = rows.iter().filter(|r| r.family == Family::MassRatio && r.model == model);
        let hanging = hanging.filter(|r| r.host.compares_peers() && r.host.rate == 60);
        let point = |r: &Row| Some((r.case.strip_prefix("hanging ")?.parse().ok()?, r.stretch));
        Curve { name: model.name().to_string(), points: hanging.filter_map(point).collect() }
    };
    let curves: Vec<Curve> = CableModel::ALL.map(curve).into();
    if curves.iter().any(|c| c.points.is_empty()) {
        return Ok(None);
    }
    let axes = ["mass of the load over that of the cable".to_string(), "largest stretch".to_string()];
    let title = "A hanging load on 2 m of steel wire".to_string();
    Ok(Some(LogLog { title, axes, curves, floor: None }.svg()?))
}
