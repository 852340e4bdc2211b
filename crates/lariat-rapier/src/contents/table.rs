//! Items at indices that stay valid when other items are removed.

use serde::{Deserialize, Serialize};

/// Items by index; the index of a removed item is not used again.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Table<T>(Vec<Option<T>>);

impl<T> Default for Table<T> {
    fn default() -> Self {
        Table(Vec::new())
    }
}

impl<T> Table<T> {
    /// Adds an item and returns its index.
    pub fn push(&mut self, item: T) -> usize {
        self.0.push(Some(item));
        self.0.len() - 1
    }

    /// Removes the item with the last index, which is then free again.
    pub fn pop(&mut self) -> Option<T> {
        self.0.pop().flatten()
    }

    /// Number of indices given out so far.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns an item.
    pub fn get(&self, index: usize) -> Option<&T> {
        self.0.get(index)?.as_ref()
    }

    /// Returns an item, to change it.
    pub fn get_mut(&mut self, index: usize) -> Option<&mut T> {
        self.0.get_mut(index)?.as_mut()
    }

    /// Returns all items by their indices, to change them.
    pub fn all_mut(&mut self) -> impl Iterator<Item = Option<&mut T>> {
        self.0.iter_mut().map(Option::as_mut)
    }

    /// Removes an item.
    pub fn remove(&mut self, index: usize) -> Option<T> {
        self.0.get_mut(index)?.take()
    }

    /// Returns all items with their indices.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &T)> {
        self.0.iter().enumerate().filter_map(|(i, item)| Some((i, item.as_ref()?)))
    }

    /// Returns all items.
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.0.iter().flatten()
    }

    /// Returns all items, to change them.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.0.iter_mut().flatten()
    }
}
