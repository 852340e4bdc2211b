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

    /// Returns the items at distinct `indices`, in that order, to change them; without those that are not there.
    pub fn get_many_mut(&mut self, indices: &[usize]) -> Vec<&mut T> {
        let mut ascending: Vec<usize> = (0..indices.len()).collect();
        ascending.sort_by_key(|&k| indices[k]);
        let mut found: Vec<Option<&mut T>> = indices.iter().map(|_| None).collect();
        let (mut rest, mut first) = (&mut self.0[..], 0);
        for k in ascending {
            let ahead = indices[k].saturating_sub(first);
            let Some((_, [item, behind @ ..])) = rest.split_at_mut_checked(ahead) else { break };
            found[k] = item.as_mut();
            (rest, first) = (behind, indices[k] + 1);
        }
        found.into_iter().flatten().collect()
    }

    /// Returns all items by their indices, to change them.
    pub fn all_mut(&mut self) -> Vec<Option<&mut T>> {
        self.0.iter_mut().map(Option::as_mut).collect()
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

#[cfg(test)]
mod tests {
    use super::Table;

    /// *Source.* The items one by one.
    #[test]
    fn many_items_come_in_the_order_of_their_indices() {
        let mut table = Table::default();
        (0..6).for_each(|i| assert_eq!(table.push(10 * i), i));
        table.remove(2);
        assert_eq!(table.get_many_mut(&[4, 0, 2, 5, 9]), [&mut 40, &mut 0, &mut 50]);
        assert_eq!(table.get_many_mut(&[]), Vec::<&mut usize>::new());
        assert_eq!(table.all_mut().into_iter().flatten().count(), 5);
    }
}
