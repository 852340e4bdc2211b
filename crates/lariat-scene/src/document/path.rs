//! Paths of keys and array positions into a scene file.

/// One step of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Key(String),
    Item(usize),
}

/// A path of keys and array positions from the root of a scene.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KeyPath(pub(super) Vec<Step>);

impl KeyPath {
    /// Returns the path of a key at the root.
    pub fn root(key: &str) -> Self {
        KeyPath::default().key(key)
    }

    /// Returns the path of a key of the table at this path.
    pub fn key(&self, key: &str) -> Self {
        self.with(Step::Key(key.to_string()))
    }

    /// Returns the path of an item of the array at this path.
    pub fn item(&self, index: usize) -> Self {
        self.with(Step::Item(index))
    }

    fn with(&self, step: Step) -> Self {
        KeyPath(self.0.iter().cloned().chain([step]).collect())
    }

    /// Returns the keys of the path, as the schema has them.
    pub(super) fn keys(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter_map(|step| match step {
            Step::Key(key) => Some(key.as_str()),
            Step::Item(_) => None,
        })
    }

    /// Returns the last key of the path; empty at the root.
    pub(super) fn last_key(&self) -> &str {
        self.keys().last().unwrap_or_default()
    }
}
