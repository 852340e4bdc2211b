//! Numbers that are written with a unit: `"12 mm"`, `"200 GPa"`, `"0.6 kg/m"`.
//!
//! # Validity
//!
//! For keys of one physical quantity of which the crate `uom` knows the units, and for those of its units that nobody takes for another: its
//! `M` is a nautical mile. Of other keys, as bending stiffnesses in N m^2, the number in SI units is the only form. Powers may be written as `m^3` or `m³`, products as `N m` or `N · m`, degrees as `deg` or `°`.

use std::str::FromStr;
use uom::si::f64::{
    Acceleration, Angle, AngularVelocity, Area, Force, Length, LinearMassDensity, Mass, MassDensity, MomentOfInertia,
    Pressure, Time, Torque, Velocity, Volume,
};

/// What a key of an SI unit may be written in: those units that nobody takes for another, as `uom` writes them, and its parser.
type Units = (&'static [&'static str], fn(&str) -> Option<f64>);

/// Returns the units of a key, by its SI unit.
fn units(si: &str) -> Option<Units> {
    macro_rules! of {
        ($quantity:ty: $($name:literal)*) => { (&[$($name),*], |text| <$quantity>::from_str(text).ok().map(|x| x.value)) };
    }
    Some(match si {
        "m" => of!(Length: "m" "µm" "mm" "cm" "km" "in" "ft"),
        "m^2" => of!(Area: "m²" "mm²" "cm²"),
        "m^3" => of!(Volume: "m³" "L"),
        "s" => of!(Time: "s" "ms" "min" "h"),
        "m/s" => of!(Velocity: "m/s" "mm/s" "cm/s" "km/h" "kn"),
        "m/s^2" => of!(Acceleration: "m/s²"),
        "rad" => of!(Angle: "rad" "°"),
        "rad/s" => of!(AngularVelocity: "rad/s" "°/s" "rpm"),
        "kg" => of!(Mass: "kg" "g" "t" "lb"),
        "kg/m" => of!(LinearMassDensity: "kg/m" "lb/ft"),
        "kg/m^3" => of!(MassDensity: "kg/m³" "g/cm³" "t/m³"),
        "kg m^2" => of!(MomentOfInertia: "kg · m²"),
        "N" => of!(Force: "N" "mN" "kN" "MN" "lbf"),
        "N m" => of!(Torque: "N · m" "kN · m" "MN · m"),
        "Pa" => of!(Pressure: "Pa" "kPa" "MPa" "GPa" "bar" "psi"),
        _ => return None,
    })
}

/// Returns whether a text begins as a number does.
pub fn is_quantity(text: &str) -> bool {
    text.trim_start().starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
}

/// Reads a number that is written with a unit, in the SI unit of a key.
///
/// # Errors
/// In words, for another text.
pub fn quantity(text: &str, si: &str) -> Result<f64, String> {
    let Some((names, parse)) = units(si) else {
        let of = if si.is_empty() { "none" } else { si };
        return Err(format!("{text:?} is no number; its unit is {of}, and no other is read here"));
    };
    split(text)
        .filter(|(_, unit)| names.contains(&unit.as_str()))
        .and_then(|(number, unit)| parse(&format!("{number} {unit}")))
        .ok_or_else(|| format!("{text:?} is no number with one of the units {}", names.join(", ")))
}

/// Divides a text into a number and a unit as `uom` writes it.
fn split(text: &str) -> Option<(&str, String)> {
    let text = text.trim();
    // no "inf" and no "nan"
    is_quantity(text).then_some(())?;
    let ends = text.char_indices().map(|(i, _)| i).rev();
    let number = ends.map(|i| &text[..i]).find(|number| number.parse::<f64>().is_ok_and(f64::is_finite))?;
    let unit = text[number.len()..].trim().replace("^2", "²").replace("^3", "³").replace("deg", "°");
    let product = unit.split_whitespace().filter(|factor| *factor != "·").collect::<Vec<_>>().join(" · ");
    (!product.is_empty()).then_some((number, product))
}

#[cfg(test)]
mod tests {
    use super::{quantity, units};

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
            ("1 L", "m^3", 1e-3),
        ] {
            let read = quantity(text, unit).unwrap();
            assert!((read - expected).abs() <= 1e-14 * expected.abs(), "{text}: {read} for {expected}");
        }
    }

    /// Every unit is one of `uom`, and the first is the SI unit.
    #[test]
    fn all_units_are_known() {
        for si in
            ["m", "m^2", "m^3", "s", "m/s", "m/s^2", "rad", "rad/s", "kg", "kg/m", "kg/m^3", "kg m^2", "N", "N m", "Pa"]
        {
            let (names, parse) = units(si).unwrap();
            assert_eq!(quantity(&format!("1 {si}"), si), Ok(1.0));
            assert_eq!(parse(&format!("1 {}", names[0])), Some(1.0), "{si}");
            names.iter().for_each(|name| assert!(parse(&format!("1 {name}")).is_some(), "{name}"));
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
