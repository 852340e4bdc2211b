//! The tip figure of the falling pendulum: a run against the real beam, and the paper's rules
//! against G10-10.

use crate::error::Error;
use crate::reference_pendulum::{self as pendulum, Trace};
use crate::{Curve, TipFigure};
use lariat_ancf::{Integrator, Method, Rule, StepControl, Vector3};

/// Returns the figure of a run called `name`, with the positions `tip` of its tip in m, every 0.01
/// s from 0 on.
///
/// The paper's rules are run here with 10 elements and a negligible error in time (rkn6 at half its
/// stable step).
///
/// # Errors
/// [`Error::Mechanics`] if one of the paper's runs fails.
pub fn pendulum_tip(name: &str, tip: &[Vector3<f64>]) -> Result<TipFigure, Error> {
    let beam = pendulum::beam();
    let exact = Integrator { method: Method::Rkn6, control: StepControl::Stable(0.5) };
    let paper = |rule| Trace::run(pendulum::cable(rule, 10, exact)?).map(|trace| trace.tip);
    let g10 = paper(Rule::gauss(10, 10)?)?;
    let at = |k: usize, y: f64| (k as f64 / 100.0, y);
    let distance = |name: &str, a: &[Vector3<f64>], b: &[Vector3<f64>]| Curve {
        name: name.to_string(),
        points: a.iter().zip(b).enumerate().map(|(k, (a, b))| at(k, (a - b).norm())).collect(),
    };
    let component = |name: &str, i: usize| Curve {
        name: name.to_string(),
        points: tip.iter().enumerate().map(|(k, p)| at(k, p[i])).collect(),
    };
    Ok(TipFigure {
        title: "Tip of the falling pendulum".to_string(),
        positions: vec![component("x", 0), component("y", 1)],
        distances: vec![
            distance(&format!("{name}, from the real beam"), tip, &beam),
            distance("10 elements, G10-10, from the real beam", &g10, &beam),
            distance("10 elements, G3-3, from G10-10", &paper(Rule::gauss(3, 3)?)?, &g10),
            distance("10 elements, ST2, from G10-10", &paper(Rule::ST2)?, &g10),
        ],
    })
}
