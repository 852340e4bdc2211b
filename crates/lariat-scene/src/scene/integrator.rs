//! `integrator`: the time integrator of a cable and its step control.

use super::{AttachmentScene, Scene};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Choose, DISSIPATION, Kind, MANY, POSITIVE, SHARE, parse_as, table};
use lariat_ancf::integrate::OneStep;
use lariat_ancf::{ErrorNorm, Fidelity, Integrator, Method, StepControl};

/// Least tolerance over the length of the cable: some tens of roundings of a position.
const ROUNDING: f64 = 1e-14;

table! {
    /// A method with a step control; or `fidelity`, which chooses both.
    struct IntegratorTable("[cable.integrator]") {
        /// Name of a method, required by all but `tolerance` and `fidelity`.
        method: Option<Method> = ("`\"esdirk4\"`"), Kind::Parsed { accepted: "a name of `lariat integrators`", parse: parse_as::<Method> };
        /// Error of position per host step, for a method with an error estimate; at least 1e-14 of the length of the cable.
        tolerance: Option<f64> = (), Kind::Number(POSITIVE), "m";
        /// Which errors the tolerance bounds: `"every"` node and body with its vibrations, the `"motion"` that is slow beside the host step, or the free `"bodies"` that the cable moves. The method `"discrete-gradient"` knows the last alone, which without bodies is that of the motion.
        norm: Option<ErrorNorm> = ("`\"every\"`; `\"bodies\"` of the discrete gradient"), Kind::Choice(|| ErrorNorm::ALL.map(ErrorNorm::name).to_vec());
        /// Equal steps in each host step.
        substeps: Option<u32> = (), Kind::Whole(1, MANY);
        /// Longest step.
        max_step: Option<f64> = (), Kind::Number(POSITIVE), "s";
        /// Position error in 1/60 s that the method `"discrete-gradient"` keeps with 1 or 2 equal steps in that time; else it takes 4, or 8
        /// where these halve a large error. A cable shorter than 1 m may err by as much less.
        adaptive: Option<f64> = (), Kind::Number(POSITIVE), "m";
        /// Share of the stability limit, for an explicit method.
        stable: Option<f64> = (), Kind::Number(SHARE);
        /// How much the method `"discrete-gradient"` damps: a motion of angular frequency w loses
        /// the share a (h w)^3/2 of its amplitude per radian in steps of h; 0 to 1/16.
        dissipation: Option<f64> = ("1/16; 1/256 with `tolerance`"), Kind::Number(DISSIPATION);
        /// Choice of accuracy against time.
        fidelity: Option<Fidelity> = (), Kind::Choice(|| Fidelity::ALL.map(Fidelity::name).to_vec());
    }
    choose Choose::ExactlyOne(&["tolerance", "substeps", "max_step", "adaptive", "stable", "fidelity"]);
}

/// Reads the integrator at a path.
pub(super) fn read(doc: &Document<'_>, at: &KeyPath, row: &IntegratorTable) -> Result<Fidelity, Error> {
    if let Some(fidelity) = row.fidelity {
        return match (row.method, row.norm) {
            (None, None) if row.dissipation.is_some() => {
                Err(doc.error(at, Problem::TooManyGiven(vec!["dissipation", "fidelity"])))
            }
            (None, None) => Ok(fidelity),
            (Some(_), _) => Err(doc.error(at, Problem::TooManyGiven(vec!["method", "fidelity"]))),
            (None, Some(_)) => Err(doc.error(at, Problem::TooManyGiven(vec!["norm", "fidelity"]))),
        };
    }
    let controls = [
        (
            "tolerance",
            row.tolerance.map(|tolerance| match row.norm {
                None => StepControl::Tolerance(tolerance),
                Some(norm) => StepControl::ToleranceOf(tolerance, norm),
            }),
        ),
        ("substeps", row.substeps.map(StepControl::Substeps)),
        ("max_step", row.max_step.map(StepControl::MaxStep)),
        ("adaptive", row.adaptive.map(StepControl::Adaptive)),
        ("stable", row.stable.map(StepControl::Stable)),
    ];
    let Some((key, control)) = controls.into_iter().find_map(|(key, control)| control.map(|c| (key, c))) else {
        return Err(
            doc.error(at, Problem::NoneGiven(&["tolerance", "substeps", "max_step", "adaptive", "stable", "fidelity"]))
        );
    };
    if row.norm.is_some() && key != "tolerance" {
        return Err(doc.missing(&at.key("tolerance")));
    }
    let method = match row.method {
        Some(method) => method,
        None if key == "tolerance" => Integrator::default().method,
        None => return Err(doc.missing(&at.key("method"))),
    };
    let method = match (method, row.dissipation, control) {
        (Method::DiscreteGradient, Some(dissipation), _) => Method::DiscreteGradientWith { dissipation },
        (Method::DiscreteGradient, None, StepControl::Tolerance(_) | StepControl::ToleranceOf(..)) => {
            Integrator::COUPLED.method
        }
        (_, Some(_), _) => {
            let problem = Problem::Conflict(format!("{method} has none"));
            return Err(doc.error_accepting(&at.key("dissipation"), problem, "the method \"discrete-gradient\""));
        }
        (method, None, _) => method,
    };
    let checked = Integrator { method, control }.checked();
    checked.map(Fidelity::from).map_err(|error| doc.conflict(&at.key(key), error.to_string()))
}

/// Checks that a tolerance is above the rounding of positions on a cable of this length (m): below, steps get ever shorter for nothing.
pub(super) fn check_tolerance(
    doc: &Document<'_>,
    at: &KeyPath,
    row: &IntegratorTable,
    length: f64,
) -> Result<(), Error> {
    let least = ROUNDING * length;
    match row.tolerance.filter(|tolerance| *tolerance < least) {
        Some(tolerance) => Err(doc.error_accepting(
            at,
            Problem::Conflict(format!("{tolerance:e} m is below the rounding of positions on a cable of {length} m")),
            format!("at least {least:.1e} m, 1e-14 of the length"),
        )),
        None => Ok(()),
    }
}

/// Returns the integrator of a cable with something that only the discrete gradient steps: the one at a path if it is that, and the
/// default if none is written there.
pub(super) fn by_discrete_gradient(
    doc: &Document<'_>,
    at: &KeyPath,
    written: Fidelity,
    what: &str,
) -> Result<Fidelity, Error> {
    let method = written.integrator(f64::INFINITY).method;
    match written {
        _ if method.uses_discrete_gradients() => Ok(written),
        _ if !doc.contains(at) => Ok(Fidelity::Game),
        Fidelity::Engineering => Ok(Integrator::COUPLED.into()),
        _ => Err(doc.error_accepting(
            at,
            Problem::Conflict(format!("{method} cannot step {what}")),
            "{ fidelity = \"game\" } or \"engineering\", or the method \"discrete-gradient\" with tolerance, substeps, max_step or adaptive",
        )),
    }
}

/// Refuses torsion by another method than the discrete gradient where a cable is not by itself.
pub(super) fn check_torsion(doc: &Document<'_>, scene: &mut Scene) -> Result<(), Error> {
    for c in 0..scene.cables.len() {
        let on_body = |attachment: &AttachmentScene| attachment.cable == c && attachment.body.is_some();
        let by_itself = scene.cables[c].reel.is_none()
            && scene.cables[c].drum.is_none()
            && scene.tied(c).next().is_none()
            && !scene.attachments.iter().any(on_body);
        if scene.cables[c].effects.torsion.is_some() && !by_itself {
            let key = KeyPath::root("cable").item(scene.whole(c)).key("integrator");
            let what = "torsion on a body, at a junction or with a reel";
            scene.cables[c].integrator = by_discrete_gradient(doc, &key, scene.cables[c].integrator, what)?;
        }
    }
    Ok(())
}
