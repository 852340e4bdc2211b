//! Numbers that are written with a unit: `"12 mm"`, `"200 GPa"`, `"0.6 kg/m"`.
//!
//! # Validity
//!
//! For keys of one physical quantity that has a table of units in the crate `uom`; of others, as bending stiffnesses in N m^2, the number in
//! SI units is the only form. Powers may be written as `m^3` or `m³`, products as `N m` or `N · m`, degrees as `deg` or `°`.

use std::str::FromStr;
use uom::si::f64::{
    Acceleration, Angle, AngularVelocity, Area, Force, Length, LinearMassDensity, Mass, MassDensity, MomentOfInertia,
    Pressure, Time, Torque, Velocity, Volume,
};

/// Reads a number that is written with a unit, in the SI unit of a key.
///
/// # Errors
/// In words, for another text.
pub fn quantity(text: &str, unit: &str) -> Result<f64, String> {
    let parse: fn(&str) -> Option<f64> = match unit {
        "m" => |text| Length::from_str(text).ok().map(|x| x.value),
        "m^2" => |text| Area::from_str(text).ok().map(|x| x.value),
        "m^3" => |text| Volume::from_str(text).ok().map(|x| x.value),
        "s" => |text| Time::from_str(text).ok().map(|x| x.value),
        "m/s" => |text| Velocity::from_str(text).ok().map(|x| x.value),
        "m/s^2" => |text| Acceleration::from_str(text).ok().map(|x| x.value),
        "rad" => |text| Angle::from_str(text).ok().map(|x| x.value),
        "rad/s" => |text| AngularVelocity::from_str(text).ok().map(|x| x.value),
        "kg" => |text| Mass::from_str(text).ok().map(|x| x.value),
        "kg/m" => |text| LinearMassDensity::from_str(text).ok().map(|x| x.value),
        "kg/m^3" => |text| MassDensity::from_str(text).ok().map(|x| x.value),
        "kg m^2" => |text| MomentOfInertia::from_str(text).ok().map(|x| x.value),
        "N" => |text| Force::from_str(text).ok().map(|x| x.value),
        "N m" => |text| Torque::from_str(text).ok().map(|x| x.value),
        "Pa" => |text| Pressure::from_str(text).ok().map(|x| x.value),
        "" => return Err(format!("{text:?} is no number")),
        _ => return Err(format!("{text:?} is no number; units are not read here, numbers are in {unit}")),
    };
    split(text)
        .and_then(|(number, of)| parse(&format!("{number} {of}")))
        .ok_or_else(|| format!("{text:?} is no number with a unit that {unit} can be, as \"1 {unit}\""))
}

/// Divides a text into a number and a unit as `uom` writes it.
fn split(text: &str) -> Option<(&str, String)> {
    let text = text.trim();
    // no "inf" and no "nan"
    text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)).then_some(())?;
    let ends = text.char_indices().map(|(i, _)| i).rev();
    let number = ends.map(|i| &text[..i]).find(|number| number.parse::<f64>().is_ok_and(f64::is_finite))?;
    let unit = text[number.len()..].trim().replace("^2", "²").replace("^3", "³").replace("deg", "°");
    let product = unit.split_whitespace().filter(|factor| *factor != "·").collect::<Vec<_>>().join(" · ");
    (!product.is_empty()).then_some((number, product))
}

#[cfg(test)]
mod tests {
    use super::quantity;

    /// *Source.* The definitions of the units: inch, pound and nautical mile of 1959, the degree.
    #[test]
    fn units_are_converted() {
        let pi = std::f64::consts::PI;
        for (text, unit, expected) in [
            ("12 mm", "m", 0.012),
            ("12mm", "m", 0.012),
            ("  -1.5e1 cm ", "m", -0.15),
            ("0.5 in", "m", 0.0127),
            ("40 m", "m", 40.0),
            ("200 GPa", "Pa", 2e11),
            ("7.85 g/cm^3", "kg/m^3", 7850.0),
            ("7850 kg/m³", "kg/m^3", 7850.0),
            ("0.6 kg/m", "kg/m", 0.6),
            ("5 kN", "N", 5e3),
            ("2 t", "kg", 2e3),
            ("2 kN m", "N m", 2e3),
            ("2 kN · m", "N m", 2e3),
            ("36 km/h", "m/s", 10.0),
            ("3 kn", "m/s", 3.0 * 1852.0 / 3600.0),
            ("45 deg", "rad", pi / 4.0),
            ("45 °", "rad", pi / 4.0),
            ("250 ms", "s", 0.25),
            ("2 min", "s", 120.0),
            ("3 kg m^2", "kg m^2", 3.0),
            ("2 cm^2", "m^2", 2e-4),
        ] {
            let read = quantity(text, unit).unwrap();
            assert!((read - expected).abs() <= 1e-14 * expected.abs(), "{text}: {read} for {expected}");
        }
    }

    #[test]
    fn what_is_no_quantity_of_the_key_is_refused() {
        let refused =
            [("12 kg", "m"), ("12", "m"), ("mm", "m"), ("inf m", "m"), ("1e999 m", "m"), ("1 M", "m"), ("5 kN", "kg")];
        for (text, unit) in refused.into_iter().chain([("", "m"), ("3 N m^2", "N m^2"), ("3 m", ""), ("1 2 m", "m")]) {
            let error = quantity(text, unit).unwrap_err();
            assert!(error.starts_with(&format!("{text:?} is no number")), "{error}");
        }
    }
}
