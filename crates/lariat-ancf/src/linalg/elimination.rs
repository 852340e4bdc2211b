//! The order in which the blocks of a sparse symmetric matrix are eliminated, and where its factors
//! have entries.
//!
//! # Equation
//!
//! Elimination of an unknown joins all of its neighbours to each other. The next one is always one
//! that has the fewest neighbours left; of several, the first.
//!
//! # Validity
//!
//! Any graph. Sets of neighbours are bits, so that the memory is n^2/8 bytes for n blocks, and the
//! time is O(n^2) beside that of the factorisation; it is spent only when the graph has changed.
//!
//! # References
//!
//! George & Liu, The evolution of the minimum degree ordering algorithm, SIAM Review 31 (1989) 1.
//!
//! # Alternatives considered
//!
//! - The order of the bodies as they come: right for a chain, not for a net.
//! - Nested dissection: less fill from some thousands of blocks on; most islands have hundreds.
//! - Quotient graphs: they save the memory of the bits, which is 45 kB for 600 blocks.

/// The order, and the pattern of the factors; positions are numbers in the order of elimination.
#[derive(Clone, Debug, Default)]
pub(super) struct Elimination {
    /// By block, its position.
    pub position: Vec<usize>,
    /// By position, the block.
    pub block: Vec<usize>,
    /// By position, where its column begins in `rows`; one more than there are blocks.
    pub start: Vec<usize>,
    /// The positions below the diagonal, in ascending order by column.
    pub rows: Vec<usize>,
    /// By block, the bits of its neighbours that are left.
    near: Vec<u64>,
    degree: Vec<u32>,
}

impl Elimination {
    /// Orders a number of blocks; `pairs` are those with an entry off the diagonal.
    pub fn order(&mut self, count: usize, pairs: impl Iterator<Item = (usize, usize)>) {
        let words = count.div_ceil(64);
        self.near.clear();
        self.near.resize(count * words, 0);
        for (a, b) in pairs.filter(|(a, b)| a != b) {
            self.near[a * words + b / 64] |= 1 << (b % 64);
            self.near[b * words + a / 64] |= 1 << (a % 64);
        }
        self.degree.clear();
        self.degree.extend(
            (0..count).map(|i| self.near[i * words..(i + 1) * words].iter().map(|bits| bits.count_ones()).sum::<u32>()),
        );
        self.position.clear();
        self.position.resize(count, usize::MAX);
        self.block.clear();
        self.start.clear();
        self.start.push(0);
        self.rows.clear();
        for position in 0..count {
            let left = (0..count).filter(|&i| self.position[i] == usize::MAX);
            let Some(k) = left.min_by_key(|&i| self.degree[i]) else { break };
            self.position[k] = position;
            self.block.push(k);
            let begin = self.rows.len();
            let own = &self.near[k * words..(k + 1) * words];
            self.rows.extend((0..count).filter(|i| own[i / 64] >> (i % 64) & 1 == 1));
            for r in begin..self.rows.len() {
                let i = self.rows[r];
                let mut degree = 0;
                for w in 0..words {
                    let mut bits = self.near[i * words + w] | self.near[k * words + w];
                    for gone in [i, k].into_iter().filter(|gone| gone / 64 == w) {
                        bits &= !(1 << (gone % 64));
                    }
                    self.near[i * words + w] = bits;
                    degree += bits.count_ones();
                }
                self.degree[i] = degree;
            }
            self.start.push(self.rows.len());
        }
        for column in self.start.windows(2) {
            let rows = &mut self.rows[column[0]..column[1]];
            rows.iter_mut().for_each(|row| *row = self.position[*row]);
            rows.sort_unstable();
        }
    }

    /// Returns the place in `rows` of an entry below the diagonal that the factors have.
    pub fn find(&self, row: usize, column: usize) -> Option<usize> {
        let begin = self.start[column];
        self.rows[begin..self.start[column + 1]].binary_search(&row).ok().map(|at| begin + at)
    }
}
