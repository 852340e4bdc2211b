//! "Did you mean": the nearest of the known names.

/// Returns the known name that is nearest to an unknown one, if it is near enough to be a misspelling: about one edit in three
/// letters, capitals aside.
pub fn nearest<'n>(unknown: &str, known: impl IntoIterator<Item = &'n str>) -> Option<String> {
    let unknown = unknown.to_lowercase();
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
        ] {
            assert_eq!(nearest(unknown, keys).as_deref(), expected, "{unknown}");
        }
    }
}
