//! "Did you mean": the nearest of the known names, or what a scene calls what others call otherwise.

/// What other programs, and people, call something, and what scenes call it; of several the first that is known where it stands.
const OTHERWISE: [(&str, &[&str]); 34] = [
    ("stiffness", &["youngs_modulus", "axial_stiffness"]),
    ("modulus", &["youngs_modulus"]),
    ("young", &["youngs_modulus"]),
    ("e", &["youngs_modulus"]),
    ("ea", &["axial_stiffness"]),
    ("ei", &["bending_stiffness"]),
    ("gj", &["torsion"]),
    ("rho", &["density"]),
    ("linear_density", &["mass_per_length"]),
    ("diameter", &["section", "round"]),
    ("radius", &["section", "round", "ball"]),
    ("thickness", &["section", "round"]),
    ("segments", &["elements"]),
    ("nodes", &["elements"]),
    ("vertices", &["points"]),
    ("vertex", &["points"]),
    ("path", &["points"]),
    ("strength", &["break"]),
    ("winch", &["reel"]),
    ("wind", &["drag"]),
    ("current", &["drag"]),
    ("collision", &["contact"]),
    ("fidelity", &["integrator"]),
    ("method", &["integrator"]),
    ("timestep", &["dt"]),
    ("time_step", &["dt"]),
    ("fps", &["dt"]),
    ("time", &["duration"]),
    ("end_time", &["duration"]),
    ("type", &["kind"]),
    ("pos", &["position"]),
    ("box", &["cuboid"]),
    ("sphere", &["ball"]),
    ("static", &["fixed"]),
];

/// Returns the known name of what an unknown one is elsewhere, or the one that is nearest to it, if it is near enough to be a misspelling: about
/// one edit in three letters, capitals aside.
pub fn nearest<'n>(unknown: &str, known: impl IntoIterator<Item = &'n str>) -> Option<String> {
    let unknown = unknown.to_lowercase();
    let known: Vec<&str> = known.into_iter().collect();
    let otherwise = OTHERWISE.iter().filter(|(name, _)| *name == unknown).flat_map(|(_, own)| *own);
    if let Some(own) = otherwise.into_iter().find(|own| known.contains(own)) {
        return Some(own.to_string());
    }
    let allowed = (unknown.chars().count() / 3).max(1);
    let edits = |name: &str| strsim::damerau_levenshtein(&unknown, &name.to_lowercase());
    let near = known.into_iter().map(|name| (edits(name), name)).filter(|(n, name)| *n <= allowed && *n < name.len());
    near.min_by_key(|(n, _)| *n).map(|(_, name)| name.to_string())
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn misspelt_names_are_recognised_and_others_are_not() {
        let keys = ["name", "length", "elements", "dt", "gravity", "fluid_density"];
        for (unknown, expected) in [
            ("lenght", Some("length")),
            ("Elements", Some("elements")),
            ("fluid_densty", Some("fluid_density")),
            ("dr", Some("dt")),
            ("colour", None),
            ("x", None),
            ("timestep", Some("dt")),
            ("Segments", Some("elements")),
            ("sphere", None),
        ] {
            assert_eq!(nearest(unknown, keys).as_deref(), expected, "{unknown}");
        }
    }
}
