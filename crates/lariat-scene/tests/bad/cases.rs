//! A valid scene with one invalid change, and the message about it.

use lariat_scene::{Purpose, Scene};

/// A text of the valid scene to replace (empty: append), its replacement, the line of the error, and fragments of its message.
pub type Case = (&'static str, &'static str, usize, &'static [&'static str]);

/// Returns a scene with one change.
pub fn changed(good: &str, from: &str, to: &str) -> String {
    assert!(good.contains(from), "{from}");
    if from.is_empty() { format!("{good}{to}\n") } else { good.replacen(from, to, 1) }
}

/// Returns the error message of a scene, which must be one of invalid input, or that it is accepted.
pub fn message(text: &str) -> String {
    match Scene::parse("scene.toml", text, &[], Purpose::Run) {
        Ok(_) => format!("accepted:\n{text}"),
        Err(error) => {
            assert_eq!(error.exit_code(), 2, "{error}");
            error.to_string()
        }
    }
}

/// Checks that the valid scene is accepted, and that every case is an error at its line with its fragments.
pub fn all_are_errors(good: &str, cases: &[Case]) {
    Scene::parse("scene.toml", good, &[], Purpose::Run).unwrap();
    let mut wrong = Vec::new();
    for (from, to, line, fragments) in cases {
        let message = message(&changed(good, from, to));
        let missing: Vec<_> = fragments.iter().filter(|fragment| !message.contains(**fragment)).collect();
        if !message.starts_with(&format!("scene.toml:{line}: ")) || !missing.is_empty() {
            wrong.push(format!("{to:?} (line {line}, lacks {missing:?}):\n    {message}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

/// Checks that every change is accepted.
pub fn all_are_accepted(good: &str, changes: &[(&str, &str)]) {
    for (from, to) in changes {
        if let Err(error) = Scene::parse("scene.toml", &changed(good, from, to), &[], Purpose::Run) {
            panic!("{to}: {error}");
        }
    }
}
