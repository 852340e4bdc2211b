//! Samples in even distances, never more than a limit, of a run whose length nobody knows: when they are full every other one goes.

/// At most `most` samples, and the last beside.
pub struct Thin<T> {
    most: usize,
    /// One of so many samples is kept.
    every: u64,
    /// Samples seen.
    seen: u64,
    kept: Vec<T>,
    last: T,
}

impl<T: Default> Thin<T> {
    pub fn new(most: usize) -> Self {
        Thin { most: most.max(2), every: 1, seen: 0, kept: Vec::new(), last: T::default() }
    }

    /// True if the next sample is one to keep.
    pub fn is_due(&self) -> bool {
        self.seen.is_multiple_of(self.every)
    }

    /// Passes over a sample that is not due.
    pub fn skip(&mut self) {
        self.seen += 1;
    }

    /// Keeps a sample that is due.
    pub fn push(&mut self, sample: T) {
        if self.kept.len() == self.most {
            let mut number = 0;
            self.kept.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.every *= 2;
            if !self.is_due() {
                return self.skip();
            }
        }
        self.kept.push(sample);
        self.seen += 1;
    }

    /// Adds a sample after all others, whether due or not.
    pub fn append(&mut self, sample: T) {
        self.kept.push(sample);
    }

    /// What was kept, in order.
    pub fn kept(&self) -> &[T] {
        &self.kept
    }
}

impl Thin<Vec<f64>> {
    /// Takes a row, and remembers it as the last.
    pub fn offer(&mut self, row: &[f64]) {
        if self.is_due() {
            self.push(row.to_vec());
        } else {
            self.skip();
        }
        self.last.clear();
        self.last.extend_from_slice(row);
    }

    /// The rows that were kept, and the last if it is not among them.
    pub fn rows(&self) -> impl Iterator<Item = &Vec<f64>> {
        let missing = self.kept.last() != Some(&self.last) && !self.last.is_empty();
        self.kept.iter().chain(missing.then_some(&self.last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However long the run: the first and last row are there, distances are even, and there are neither too many nor too few.
    #[test]
    fn rows_of_any_run_are_even_and_limited() {
        for n in [1, 2, 9, 10, 11, 20, 21, 22, 999, 1000, 1024, 12_345] {
            let mut thin = Thin::new(10);
            (0..n).for_each(|k| thin.offer(&[f64::from(k)]));
            let rows: Vec<f64> = thin.rows().map(|row| row[0]).collect();
            assert_eq!((rows[0], rows.last()), (0.0, Some(&f64::from(n - 1))), "{n}: {rows:?}");
            assert!(rows.len() <= 11 && rows.len() >= n.min(6) as usize, "{n}: {rows:?}");
            let steps: Vec<f64> = rows.windows(2).map(|w| w[1] - w[0]).collect();
            assert!(
                steps.iter().rev().skip(1).all(|&d| d == steps[0]) && steps.iter().all(|&d| d <= steps[0]),
                "{rows:?}"
            );
        }
    }
}
