//! The paper's Table 1 and its two figures.

use super::section::{Format, Section, Table, both, raw};
use super::{Bench, failed};
use crate::error::Error;
use crate::table1;
use lariat_ancf::{Integrator, Rule};
use lariat_figures::Snapshot;
use lariat_figures::reference_pendulum::{self as pendulum, INTERVAL, SAMPLES};

/// The section.
///
/// # Errors
/// [`Error::Mechanics`] if a run fails, [`Error::Figure`].
pub fn section(bench: &mut Bench<'_>) -> Result<Section, Error> {
    bench.tell("Table 1");
    let measured = table1::measure(bench.options.least_runs)?;
    let (ms, e) = (Format::Fixed(2), Format::Scientific(3));
    let columns = vec![
        both("rule", "rule", Format::Plain),
        both("elements", "elements", Format::Plain),
        both("cpu_ms", "CPU ms", ms),
        both("cpu_least_ms", "least", ms),
        both("cpu_most_ms", "most", ms),
        both("longitudinal_ms", "longitudinal ms", ms),
        both("transverse_ms", "transverse ms", ms),
        both("steps", "steps", Format::Plain),
        both("element_evaluations", "element evaluations", Format::Plain),
        both("difference_m", "difference from G10-10 m", e),
        both("paper_m", "the paper's m", Format::Scientific(2)),
        both("beam_m", "from the real beam m", e),
        raw("beam_vertical_m"),
        raw("time_error_m"),
    ];
    let rows = measured.rows.iter().map(|r| {
        vec![
            r.rule.clone().into(),
            r.elements.into(),
            r.cpu_ms.into(),
            r.cpu_least_ms.into(),
            r.cpu_most_ms.into(),
            r.longitudinal_ms.into(),
            r.transverse_ms.into(),
            r.steps.into(),
            r.element_evaluations.into(),
            r.difference_m.into(),
            r.paper_m.into(),
            r.beam_m.into(),
            r.beam_vertical_m.into(),
            measured.time_error.halved_m.into(),
        ]
    });
    let mut section = Section::new("The paper's Table 1 and figures");
    section.text(
        "Force strategies of Bulin & Hajzman on their falling pendulum, 2 s, exact in time: rkn6 at half its stable step (with half of \
         that step G10-10 moves by `time_error_m` of the file). *Difference* is the largest vertical tip difference from the 10-element \
         G10-10 run; *the paper's* is the same as they print it, whose 3.29e-5 for G5-5 is their own error in time, and whose L2 is not \
         defined there (ours: mean Green strain). *Longitudinal* and *transverse* are the force evaluations of the run times the time of \
         one without bending, and what bending adds to one.",
    );
    section.table(Table { name: "table1", columns, rows: rows.collect(), folded: false });

    bench.tell("figures of the paper");
    let mut cable = pendulum::cable(Rule::default(), 20, Integrator::default())?;
    let (mut shots, mut tip) = (Vec::new(), Vec::new());
    for k in 0..SAMPLES {
        cable.step((k as f64 * INTERVAL - cable.time()).max(0.0))?;
        tip.push(cable.node_position(cable.nodes() - 1));
        if k % 20 == 0 {
            shots.push(Snapshot::of(&cable));
        }
    }
    let svg = lariat_figures::snapshots_svg("Falling pendulum, 2 m, 20 elements", &shots);
    section.figure("figure_1", "The pendulum every 0.2 s (figure 1 of the paper)", failed("figure_1", svg)?);
    let figure = lariat_figures::pendulum_tip("20 elements, projected-3", &tip)?;
    let caption = "Displacement of the tip, and its distance from references (figure 2 of the paper)";
    section.figure("figure_2", caption, failed("figure_2", lariat_figures::tip_svg(&figure))?);
    Ok(section)
}
