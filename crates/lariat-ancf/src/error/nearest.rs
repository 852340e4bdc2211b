//! The name that a misspelt one may have meant.

/// The candidate nearest to `text` by Jaro-Winkler similarity, case ignored, if one is similar
/// enough to be meant.
pub(crate) fn nearest(text: &str, candidates: impl IntoIterator<Item = String>) -> Option<String> {
    /// Similarity (0 to 1) below which a name is not proposed.
    const LEAST_SIMILARITY: f64 = 0.8;
    let text = text.to_lowercase();
    let similarity = |name: &str| strsim::jaro_winkler(&text, &name.to_lowercase());
    candidates
        .into_iter()
        .map(|name| (similarity(&name), name))
        .filter(|(similarity, _)| *similarity >= LEAST_SIMILARITY)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}
