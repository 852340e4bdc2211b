//! Breaking a scene in one place, and reading what is said about it.

use lariat_scene::{Purpose, Scene};

/// What is replaced in a good scene (or appended, if the first text is empty), by what, the line of the error, and fragments of it.
pub type Case = (&'static str, &'static str, usize, &'static [&'static str]);

/// A scene with one change.
pub fn changed(good: &str, from: &str, to: &str) -> String {
    assert!(good.contains(from), "{from}");
    if from.is_empty() { format!("{good}{to}\n") } else { good.replacen(from, to, 1) }
}

/// What is said about a scene: the error, which must be one of bad input, or that it is accepted.
pub fn message(text: &str) -> String {
    match Scene::parse("scene.toml", text, &[], Purpose::Run) {
        Ok(_) => format!("accepted:\n{text}"),
        Err(error) => {
            assert_eq!(error.exit_code(), 2, "{error}");
            error.to_string()
        }
    }
}

/// The good scene is accepted; every case is refused at its line, in its words.
pub fn all_are_refused(good: &str, cases: &[Case]) {
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

/// Every change is accepted.
pub fn all_are_accepted(good: &str, changes: &[(&str, &str)]) {
    for (from, to) in changes {
        if let Err(error) = Scene::parse("scene.toml", &changed(good, from, to), &[], Purpose::Run) {
            panic!("{to}: {error}");
        }
    }
}
