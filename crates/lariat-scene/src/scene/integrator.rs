//! `integrator`: the time integrator of a cable and its step control.

use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Choose, Kind, MANY, POSITIVE, SHARE, parse_as, table};
use lariat_ancf::{Fidelity, Integrator, IntegratorChoice, Method, StepControl};

table! {
    /// A method with a step control; or `fidelity`, which chooses both.
    struct IntegratorTable("[cable.integrator]") {
        /// Name of a method, required by all but `tolerance` and `fidelity`.
        method: Option<Method> = ("`\"esdirk4\"`"), Kind::Parsed { accepted: "a name of `lariat integrators`", parse: parse_as::<Method> };
        /// Error of position per host step, for a method with an error estimate.
        tolerance: Option<f64> = (), Kind::Number(POSITIVE), "m";
        /// Equal steps in each host step.
        substeps: Option<u32> = (), Kind::Whole(1, MANY);
        /// Longest step.
        max_step: Option<f64> = (), Kind::Number(POSITIVE), "s";
        /// Share of the stability limit, for an explicit method.
        stable: Option<f64> = (), Kind::Number(SHARE);
        /// Choice of accuracy against time.
        fidelity: Option<Fidelity> = (), Kind::Choice(|| Fidelity::ALL.map(Fidelity::name).to_vec());
    }
    choose Choose::ExactlyOne(&["tolerance", "substeps", "max_step", "stable", "fidelity"]);
}

/// Reads the integrator at a path.
pub(super) fn read(doc: &Document<'_>, at: &KeyPath, row: &IntegratorTable) -> Result<IntegratorChoice, Error> {
    if let Some(fidelity) = row.fidelity {
        return match row.method {
            None => Ok(fidelity.into()),
            Some(_) => Err(doc.error(at, Problem::TooManyGiven(vec!["method", "fidelity"]))),
        };
    }
    let controls = [
        ("tolerance", row.tolerance.map(StepControl::Tolerance)),
        ("substeps", row.substeps.map(StepControl::Substeps)),
        ("max_step", row.max_step.map(StepControl::MaxStep)),
        ("stable", row.stable.map(StepControl::Stable)),
    ];
    let Some((key, control)) = controls.into_iter().find_map(|(key, control)| control.map(|c| (key, c))) else {
        return Err(doc.error(at, Problem::NoneGiven(&["tolerance", "substeps", "max_step", "stable", "fidelity"])));
    };
    let method = match row.method {
        Some(method) => method,
        None if key == "tolerance" => Integrator::default().method,
        None => return Err(doc.missing(&at.key("method"))),
    };
    let checked = Integrator { method, control }.checked();
    checked.map(IntegratorChoice::from).map_err(|error| doc.conflict(&at.key(key), error.to_string()))
}
