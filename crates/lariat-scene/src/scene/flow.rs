//! `flow`: the velocity of a fluid, by three numbers or by a table with a profile in height and a history in time.

use crate::document::{Document, KeyPath};
use crate::error::Error;
use crate::schema::{Default, Key, Kind, NOT_NEGATIVE, POSITIVE, VECTOR, table};
use lariat_ancf::effect::Profile;
use lariat_ancf::{Flow, Vector3};
use toml::Value;

table! {
    /// A flow that changes with height and time: velocity x factor of height x factor of time. Height is measured from the origin
    /// along `up`. A flow that is a function of a program is given in Rust, by `Cable::sample_flow`.
    keys FLOW for Flow("[cable.drag.flow]") {
        /// Velocity where the factors are 1.
        velocity = required, VECTOR, "m/s";
        /// Factor by height, by rows.
        profile = ("1"), Kind::Table(&PROFILE);
        /// Factor of time, linear between rows, constant outside.
        history = ("1"), Kind::Ascending(&["t", "factor"]), "s, 1";
    }
    without samples;
    without surface;
    plus &[Key {
        name: "power_law",
        kind: Kind::Table(&PowerLawTable::TABLE),
        unit: "",
        default: Default::Absent("1"),
        meaning: "Factor by height after the power law of wind, instead of `profile`.",
    }];
}

table! {
    /// A factor by height.
    keys PROFILE for Profile("[cable.drag.flow.profile]") {
        /// Direction of height, not zero.
        up = [0.0, 1.0, 0.0], VECTOR;
        /// Factor by height, linear between rows, constant outside.
        rows = required, Kind::Ascending(&["height", "factor"]), "m, 1";
    }
}

table! {
    /// The factor (height/reference)^exponent from height 0 to `top`, constant above, 0 below.
    struct PowerLawTable("[cable.drag.flow.power_law]") {
        /// Direction of height, not zero.
        up: Vector3<f64> = [0.0, 1.0, 0.0], VECTOR;
        /// Height where the factor is 1.
        reference: f64 = required, Kind::Number(POSITIVE), "m";
        /// Exponent.
        exponent: f64 = required, Kind::Number(NOT_NEGATIVE);
        /// Height above which the factor is constant.
        top: f64 = required, Kind::Number(POSITIVE), "m";
    }
}

/// Writes a flow out as the table that the mechanics reads.
pub(super) fn write_out(doc: &Document<'_>, at: &KeyPath, value: &mut Value) -> Result<(), Error> {
    let flow = match value {
        Value::Table(flow) => flow,
        uniform => {
            *uniform = Value::Table([("velocity".to_string(), uniform.clone())].into_iter().collect());
            return Ok(());
        }
    };
    if let Some(profile) = flow.get("profile") {
        let at = at.key("profile");
        check_up(doc, &at, &doc.typed::<Profile>(&at, profile.clone())?.up)?;
    }
    let Some(law) = flow.remove("power_law") else { return Ok(()) };
    if flow.contains_key("profile") {
        return Err(doc.conflict(&at.key("profile"), "both profile and power_law are given"));
    }
    let at = at.key("power_law");
    let PowerLawTable { up, reference, exponent, top } = doc.typed(&at, law)?;
    check_up(doc, &at, &up)?;
    let profile = Flow::power_law(Vector3::zeros(), up, reference, exponent, top).profile;
    if !profile.iter().flat_map(|profile| &profile.rows).flatten().all(|x| x.is_finite()) {
        let problem = format!("{exponent} makes factors that are not finite");
        return Err(doc.conflict(&at.key("exponent"), problem));
    }
    let profile = Value::try_from(profile).map_err(|error| doc.conflict(&at, error.to_string()))?;
    flow.insert("profile".to_string(), profile);
    Ok(())
}

fn check_up(doc: &Document<'_>, at: &KeyPath, up: &Vector3<f64>) -> Result<(), Error> {
    if *up == Vector3::zeros() {
        return Err(doc.conflict(&at.key("up"), "it has no direction"));
    }
    Ok(())
}
