//! The name that a misspelt one may have meant.

use crate::scales::cable::LEAST_SIMILARITY;

/// The candidate nearest to `text` by Jaro-Winkler similarity, case ignored, if one is similar
/// enough to be meant.
pub(crate) fn nearest(text: &str, candidates: impl IntoIterator<Item = String>) -> Option<String> {
    let text = text.to_lowercase();
    let similarity = |name: &str| strsim::jaro_winkler(&text, &name.to_lowercase());
    candidates
        .into_iter()
        .map(|name| (similarity(&name), name))
        .filter(|(similarity, _)| *similarity >= LEAST_SIMILARITY)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}
