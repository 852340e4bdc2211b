//! Ranges of the `flow` of a `[cable.drag]`.

use super::check::{number, vector};
use super::document::{Document, KeyPath};
use super::value::FlowValue;
use crate::error::Error;
use lariat_ancf::effect::Profile;
use lariat_ancf::{Flow, Vector3};

pub(super) fn flow(doc: &Document<'_>, at: &KeyPath, value: Option<&FlowValue>) -> Result<Flow, Error> {
    let table = match value {
        None => return Ok(Flow::default()),
        Some(FlowValue::Uniform(velocity)) => return Ok(Flow::uniform(vector(doc, at, *velocity)?)),
        Some(FlowValue::Table(table)) => table,
    };
    let velocity = vector(doc, &at.key("velocity"), table.velocity)?;
    let mut flow = match (&table.profile, &table.power_law) {
        (None, None) => Flow::uniform(velocity),
        (Some(_), Some(_)) => return Err(doc.error(&at.key("profile"), "both profile and power_law")),
        (Some(profile), None) => {
            let at = at.key("profile");
            let rows = rows(doc, &at.key("rows"), &profile.rows)?;
            Flow { profile: Some(Profile { up: up(doc, &at, profile.up)?, rows }), ..Flow::uniform(velocity) }
        }
        (None, Some(law)) => {
            let at = at.key("power_law");
            let positive = |key: &str, x: f64| number(doc, &at.key(key), x, |x| x > 0.0);
            let reference = positive("reference", law.reference)?;
            let exponent = number(doc, &at.key("exponent"), law.exponent, |x| x >= 0.0)?;
            let flow = Flow::power_law(velocity, up(doc, &at, law.up)?, reference, exponent, positive("top", law.top)?);
            match &flow.profile {
                Some(profile) if profile.rows.iter().flatten().all(|x| x.is_finite()) => flow,
                _ => {
                    return Err(doc.error(&at.key("exponent"), format!("{exponent} makes factors that are not finite")));
                }
            }
        }
    };
    if let Some(history) = &table.history {
        flow = flow.with_history(rows(doc, &at.key("history"), history)?);
    }
    Ok(flow)
}

fn up(doc: &Document<'_>, at: &KeyPath, value: Option<[f64; 3]>) -> Result<Vector3<f64>, Error> {
    let at = at.key("up");
    let up = vector(doc, &at, value.unwrap_or([0.0, 1.0, 0.0]))?;
    if up == Vector3::zeros() { Err(doc.error(&at, "no direction")) } else { Ok(up) }
}

/// Finite rows of ascending first numbers, at least one.
fn rows(doc: &Document<'_>, at: &KeyPath, rows: &[[f64; 2]]) -> Result<Vec<[f64; 2]>, Error> {
    if rows.is_empty() {
        return Err(doc.error(at, "no row"));
    }
    if let Some(x) = rows.iter().flatten().find(|x| !x.is_finite()) {
        return Err(doc.error(at, format!("{x} is not finite")));
    }
    match rows.windows(2).find(|r| r[1][0] <= r[0][0]) {
        None => Ok(rows.to_vec()),
        Some(r) => Err(doc.error(at, format!("{} after {}", r[1][0], r[0][0]))),
    }
}
