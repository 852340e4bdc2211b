//! What a list of warnings tells: its lines, and its form in `summary.json`.

use super::Warning;
use lariat_ancf::Level;
use lariat_ancf::warning::fold;
use serde::{Serialize, Serializer};

/// Returns the lines to tell of sorted warnings, those that `tells` lets through.
pub(crate) fn lines(warnings: &[Warning], tells: impl Fn(&Warning) -> bool) -> Vec<String> {
    fold::lines(warnings, |warning| warning.cable().map(String::from), tells)
}

/// Serialises sorted warnings with their texts, their levels, and the kinds of those that explain
/// them.
///
/// # Errors
/// As the serialiser.
pub(crate) fn with_texts<S: Serializer>(warnings: &[Warning], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct WithText<'a> {
        text: String,
        level: Level,
        #[serde(skip_serializing_if = "Option::is_none")]
        explained_by: Option<String>,
        #[serde(flatten)]
        warning: &'a Warning,
    }
    let kind = |cause: usize| {
        let value = serde_json::to_value(&warnings[cause]).ok()?;
        Some(value.get("kind")?.as_str()?.to_string())
    };
    let explained = fold::explained(warnings, |warning| warning.cable().map(String::from), |_| true);
    serializer.collect_seq(warnings.iter().zip(explained).map(|(warning, cause)| WithText {
        text: warning.to_string(),
        level: warning.level(),
        explained_by: cause.and_then(kind),
        warning,
    }))
}
