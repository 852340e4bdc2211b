//! Errors of rules, separated from errors of the mesh.
//!
//! With n elements the distance of the tip of a rule from the real beam has two parts: that of n
//! elements with the exact energy (G10-10 from the beam: *discretisation*), and the change by the
//! rule on the same mesh (the rule from G10-10: *model*, the paper's measure). T1 neglects the
//! stretch in the curvature and does not converge with the mesh; T2, mean strain and few Gauss
//! points differ from the full energy by what varies inside an element, and converge.

use super::options::Options;
use crate::error::Error;
use crate::page::Section;
use crate::table::{Table, hidden};
use lariat_ancf::{Integrator, Method, Rule, StepControl};
use lariat_figures::reference_pendulum::{self as pendulum, Trace};
use lariat_figures::{Curve, LogLog};

const MESHES: [usize; 4] = [10, 20, 40, 80];
const RULES: [(&str, &str); 6] = [
    ("exact-T1", "T1: bending without the stretch"),
    ("ST2", "T2: mean stretch in bending"),
    ("L2T1", "mean strain, T1"),
    ("L2T2", "mean strain, T2"),
    ("G3-3", "three Gauss points"),
    ("projected-3", "projected strain (default)"),
];
/// Integrator with a negligible error in time.
const EXACT: Integrator = Integrator { method: Method::Rkn4, control: StepControl::Stable(0.95) };

/// Title of the section.
pub const TITLE: &str = "Errors of the rules, separated from errors of the mesh";

/// Measures the section.
///
/// # Errors
/// [`Error::Mechanics`] if a run fails, [`Error::Figure`].
pub fn section(options: &Options) -> Result<Section, Error> {
    let beam = pendulum::beam();
    let columns = vec![
        hidden("rule"),
        hidden("what"),
        hidden("elements"),
        hidden("model_m"),
        hidden("discretisation_m"),
        hidden("total_m"),
    ];
    let mut table = Table { name: "model_error", columns, rows: Vec::new() };
    let mut curves = vec![Curve { name: "discretisation: G10-10 from beam".to_string(), points: Vec::new() }];
    curves.extend(RULES.map(|(name, _)| Curve { name: format!("model: {name} from G10-10"), points: Vec::new() }));
    for &elements in options.rungs(&MESHES) {
        let run = |rule: Rule| Trace::run(pendulum::cable(rule, elements, EXACT)?);
        let full = run(Rule::gauss(10, 10)?)?;
        let discretisation = full.distance(&beam);
        curves[0].points.push((elements as f64, discretisation));
        for (i, (name, what)) in RULES.iter().enumerate() {
            let trace = run(name.parse()?)?;
            let model = trace.distance(&full.tip);
            curves[i + 1].points.push((elements as f64, model));
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
    let mut section = Section::new(TITLE);
    section.text(
        "The paper's pendulum with a negligible error in time (rkn4 at 0.95 of its stable step). *Discretisation* is the largest tip distance of \
         the full energy (G10-10) from the real beam; *model* that of a rule from G10-10 on the same mesh. A rule whose curve remains level \
         is another material; one whose curve falls is a quadrature. The difference of the default rule from G10-10 is no error: it \
         removes a part of the discretisation error (column `total_m` of the file).",
    );
    let title = "Pendulum: change by a rule, and error of the mesh".to_string();
    let axes = ["elements".to_string(), "largest tip distance [m]".to_string()];
    let svg = LogLog { title, axes, curves, floor: None }.svg();
    section.figure("model_error", "Model and discretisation error against the number of elements", svg?);
    section.data(table);
    Ok(section)
}
