//! Evenly spaced samples of a run of unknown length, never more than a limit.

/// Keeps at most `limit` samples at even distances, and the last one: when it is full, every other sample is dropped and the
/// distance doubles.
pub struct Decimator<T> {
    limit: usize,
    /// One of this many samples is kept.
    every: u64,
    /// Number of samples so far.
    seen: u64,
    kept: Vec<T>,
    last: T,
}

impl<T: Default> Decimator<T> {
    pub fn new(limit: usize) -> Self {
        Decimator { limit: limit.max(2), every: 1, seen: 0, kept: Vec::new(), last: T::default() }
    }

    /// Returns whether the next sample is to be kept.
    pub fn is_due(&self) -> bool {
        self.seen.is_multiple_of(self.every)
    }

    /// Skips a sample that is not due.
    pub fn skip(&mut self) {
        self.seen += 1;
    }

    /// Keeps a sample that is due.
    pub fn push(&mut self, sample: T) {
        if self.kept.len() == self.limit {
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

    /// Appends a last sample, whether it is due or not.
    pub fn append(&mut self, sample: T) {
        self.kept.push(sample);
    }

    /// Returns the samples that were kept, in order.
    pub fn kept(&self) -> &[T] {
        &self.kept
    }
}

impl Decimator<Vec<f64>> {
    /// Keeps a row if it is due, and stores it as the last one.
    pub fn offer(&mut self, row: &[f64]) {
        if self.is_due() {
            self.push(row.to_vec());
        } else {
            self.skip();
        }
        self.last.clear();
        self.last.extend_from_slice(row);
    }

    /// Returns the rows that were kept, and the last one.
    pub fn rows(&self) -> impl Iterator<Item = &Vec<f64>> {
        let missing = self.kept.last() != Some(&self.last) && !self.last.is_empty();
        self.kept.iter().chain(missing.then_some(&self.last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For any number of rows: the first and the last are kept, distances are even, and the number is between half the limit and
    /// the limit.
    #[test]
    fn rows_of_any_run_are_even_and_limited() {
        for n in [1, 2, 9, 10, 11, 20, 21, 22, 999, 1000, 1024, 12_345] {
            let mut decimator = Decimator::new(10);
            (0..n).for_each(|k| decimator.offer(&[f64::from(k)]));
            let rows: Vec<f64> = decimator.rows().map(|row| row[0]).collect();
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
