//! The paper's Table 1 and its two figures.

use super::options::Options;
use crate::error::Error;
use crate::page::Section;
use crate::table::{Format, hidden, shown};
use crate::table1;
use lariat_ancf::{Integrator, Rule};
use lariat_figures::reference_pendulum::{self as pendulum, INTERVAL, SAMPLES};
use lariat_figures::{Shape, ShapeFigure};

/// Title of the section.
pub const TITLE: &str = "The paper's Table 1 and figures";

/// Measures the section.
///
/// # Errors
/// [`Error::Mechanics`] if a run fails, [`Error::Figure`].
pub fn section(options: &Options) -> Result<Section, Error> {
    let measured = table1::measure(options.repeats.least)?;
    let ms = Format::Fixed(2);
    let mut table = measured.table();
    table.columns.push(hidden("time_error_m"));
    table.rows.iter_mut().for_each(|row| row.push(measured.time_error_m.into()));
    let view = [
        shown("rule", "rule", Format::Plain),
        shown("elements", "elements", Format::Plain),
        shown("cpu_ms", "CPU ms", ms),
        shown("longitudinal_ms", "longitudinal ms", ms),
        shown("transverse_ms", "transverse ms", ms),
        shown("difference_m", "difference m", Format::Scientific(3)),
        shown("paper_m", "paper m", Format::Scientific(2)),
        shown("beam_m", "beam m", Format::Scientific(3)),
    ];
    let mut section = Section::new(TITLE);
    section.text(
        "Force strategies of Bulin & Hajzman on their falling pendulum, 2 s, with a negligible error in time: rkn6 at half its stable step. \
         *Difference* is the largest vertical tip difference from the 10-element G10-10 run; *paper* is the same as the paper prints it \
         (3.29e-5 for G5-5 is their error in time; they do not define L2, ours is the mean Green strain); *beam* is the largest distance \
         from the real beam. *Longitudinal* and *transverse* are the force evaluations of the run times the time of one without bending, \
         and times the additional time of one with bending.",
    );
    section.excerpt(table.select(&view, |_| true));
    section.data(table);

    let mut cable = pendulum::cable(Rule::default(), 20, Integrator::default())?;
    let (mut shapes, mut tip) = (Vec::new(), Vec::new());
    for k in 0..SAMPLES {
        cable.step((k as f64 * INTERVAL - cable.time()).max(0.0))?;
        tip.push(cable.node_position(cable.nodes() - 1));
        if k % 20 == 0 {
            shapes.push(Shape::of(&cable));
        }
    }
    let figure = ShapeFigure { title: "Falling pendulum, 2 m, 20 elements".to_string(), shapes };
    section.figure("figure_1", "The pendulum every 0.2 s (figure 1 of the paper)", figure.svg()?);
    let figure = lariat_figures::pendulum_tip("20 elements, projected-3", &tip)?;
    let caption = "Displacement of the tip, and its distance from references (figure 2 of the paper)";
    section.figure("figure_2", caption, figure.svg()?);
    Ok(section)
}
