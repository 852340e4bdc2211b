//! Errors of rules drawn apart from errors of the mesh.
//!
//! With n elements the tip of a rule is off the real beam by two parts: what n elements with the exact energy are off (G10-10 from the
//! beam: *discretisation*), and what the rule changes on the same mesh (the rule from G10-10: *model*, the paper's measure). T1 leaves
//! out the stretch in the curvature and stays off however fine the mesh; T2, mean strain and few Gauss points differ from the full
//! energy by what varies inside an element, and converge.

use super::section::{Format, Section, Table, both, raw};
use super::{Bench, failed};
use crate::error::Error;
use lariat_ancf::{Integrator, Method, Rule, StepControl};
use lariat_figures::reference_pendulum::{self as pendulum, Trace};
use lariat_figures::{LogLog, Series};

const MESHES: [usize; 4] = [10, 20, 40, 80];
const RULES: [(&str, &str); 6] = [
    ("exact-T1", "T1: bending without the stretch"),
    ("ST2", "T2: mean stretch in bending"),
    ("L2T1", "mean strain, T1"),
    ("L2T2", "mean strain, T2"),
    ("G3-3", "three Gauss points"),
    ("projected-3", "projected strain (default)"),
];
/// Exact in time: see the references at the end of the report.
const EXACT: Integrator = Integrator { method: Method::Rkn4, control: StepControl::Stable(0.95) };

/// The section.
///
/// # Errors
/// [`Error::Mechanics`] if a run fails, [`Error::Figure`].
pub fn section(bench: &mut Bench<'_>) -> Result<Section, Error> {
    let beam = pendulum::beam();
    let columns = vec![
        both("rule", "rule", Format::Plain),
        raw("what"),
        both("elements", "elements", Format::Plain),
        both("model_m", "model m", Format::Scientific(1)),
        both("discretisation_m", "discretisation m", Format::Scientific(1)),
        both("total_m", "together, from the beam m", Format::Scientific(1)),
    ];
    let mut table = Table { name: "model_error", columns, rows: Vec::new(), folded: false };
    let mut series = vec![Series { name: "discretisation: G10-10 from beam".to_string(), points: Vec::new() }];
    series.extend(RULES.map(|(name, _)| Series { name: format!("model: {name} from G10-10"), points: Vec::new() }));
    for &elements in bench.rungs(&MESHES) {
        bench.tell(&format!("model error, {elements} elements"));
        let run = |rule: Rule| Trace::run(pendulum::cable(rule, elements, EXACT)?);
        let full = run(Rule::gauss(10, 10)?)?;
        let discretisation = full.distance(&beam);
        series[0].points.push((elements as f64, discretisation));
        for (i, (name, what)) in RULES.iter().enumerate() {
            let trace = run(name.parse()?)?;
            let model = trace.distance(&full.tip);
            series[i + 1].points.push((elements as f64, model));
            table.rows.push(vec![
                (*name).into(),
                (*what).into(),
                elements.into(),
                model.into(),
                discretisation.into(),
                trace.distance(&beam).into(),
            ]);
        }
    }
    let mut section = Section::new("Errors of the model, apart from errors of the mesh");
    section.text(
        "The paper's pendulum, exact in time (rkn4 at 0.95 of its stable step). *Discretisation* is the largest tip distance of the full \
         energy (G10-10) from the real beam with that many elements; *model* that of a rule from G10-10 on the same mesh. A model whose \
         curve stays level is another material; one that falls is a quadrature. The default rule's difference from G10-10 is not an error: \
         it takes out part of the discretisation, see the last column.",
    );
    let title = "Pendulum: what a rule changes, and what the mesh does".to_string();
    let axes = ["elements".to_string(), "largest tip distance [m]".to_string()];
    let svg = LogLog { title, axes, series, floor: None }.svg();
    section.figure(
        "model_error",
        "Model and discretisation error against the number of elements",
        failed("model_error", svg)?,
    );
    section.table(table);
    Ok(section)
}
