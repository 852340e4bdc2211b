//! The condensed matrix of a cable: symmetric, by groups of six columns of the border.
//!
//! # Equation
//!
//! Columns a and b of a border B are coupled, `b^T A^-1 a != 0`, only if there is a node to which
//! both reach: in which they, or what elimination makes of them, have entries. So a cable that is
//! [cut](super::cuts) at its pins has a number of blocks that is proportional to that of the pins.
//!
//! # References
//!
//! Davis, Direct Methods for Sparse Linear Systems (2006), chapter 4.

use crate::linalg::{Block, GROUP, Span};
use nalgebra::Matrix3;

/// Layout: number of triples of columns in a group.
const TRIPLES: usize = GROUP / 3;

/// W, in blocks of groups of columns.
#[derive(Clone, Debug, Default)]
pub(super) struct CoupledGroups {
    /// By triple, the nodes to which it reaches.
    reaches: Vec<Span>,
    /// Those for which the pairs were found.
    known: Vec<Span>,
    /// The groups that are coupled, the first at most the second, in ascending order.
    pub pairs: Vec<[usize; 2]>,
    /// By group, where its pairs begin; one more than there are groups.
    first: Vec<usize>,
    /// By pair, its block by rows. Of a group with itself it is the upper triangle that counts.
    pub blocks: Vec<Block>,
}

impl CoupledGroups {
    /// Begins anew for a number of triples.
    pub fn begin(&mut self, triples: usize) {
        self.reaches.clear();
        self.reaches.resize(triples, [usize::MAX, 0]);
    }

    /// Lets a triple of columns have entries in some nodes, those that are held included.
    pub fn reach(&mut self, triple: usize, nodes: Span) {
        let reach = &mut self.reaches[triple];
        *reach = [reach[0].min(nodes[0]), reach[1].max(nodes[1])];
    }

    /// Finds the groups that are coupled, if columns with entries in some nodes reach to those of
    /// `spread`, and sets their blocks to zero.
    pub fn arrange(&mut self, spread: impl Fn(Span) -> Span) {
        self.reaches.iter_mut().for_each(|reach| *reach = spread(*reach));
        if self.known != self.reaches || self.first.is_empty() {
            self.pairs.clear();
            self.first.clear();
            let groups = || self.reaches.chunks(TRIPLES).enumerate();
            for (a, own) in groups() {
                self.first.push(self.pairs.len());
                let couples = |other: &[Span]| own.iter().any(|one| other.iter().any(|two| meet(one, two)));
                let others = groups().skip(a).filter(|(b, other)| *b == a || couples(other));
                self.pairs.extend(others.map(|(b, _)| [a, b]));
            }
            self.first.push(self.pairs.len());
            self.known.clone_from(&self.reaches);
        }
        self.blocks.clear();
        self.blocks.resize(self.pairs.len(), Block::ZERO);
    }

    /// Returns the block of two triples, the first at most the second, with the row and column in
    /// it where they begin; `None` if they are not coupled.
    pub fn of(&mut self, row: usize, column: usize) -> Option<(&mut Block, [usize; 2])> {
        let [a, b] = [row, column].map(|triple| triple / TRIPLES);
        let (begin, end) = (self.first[a], self.first[a + 1]);
        let at = begin + self.pairs[begin..end].binary_search_by_key(&b, |pair| pair[1]).ok()?;
        Some((&mut self.blocks[at], [row, column].map(|triple| 3 * (triple % TRIPLES))))
    }

    /// Calls `f` with all coupled triples, the first at most the second, and their parts of W.
    pub fn for_each(&self, mut f: impl FnMut([usize; 2], Matrix3<f64>)) {
        let triples = |group: usize| TRIPLES * group..self.reaches.len().min(TRIPLES * (group + 1));
        for (&[a, b], block) in self.pairs.iter().zip(&self.blocks) {
            for (row, column) in triples(a).flat_map(|row| triples(b).map(move |column| (row, column))) {
                if row == column || row < column && meet(&self.reaches[row], &self.reaches[column]) {
                    let [r, c] = [row, column].map(|triple| 3 * (triple % TRIPLES));
                    let of = |x: usize, y: usize| block.0[r + x][c + y];
                    let upper = |x: usize, y: usize| if row == column { of(x.min(y), x.max(y)) } else { of(x, y) };
                    f([row, column], Matrix3::from_fn(upper));
                }
            }
        }
    }
}

/// Returns whether there is a node in both.
fn meet(one: &Span, other: &Span) -> bool {
    one[0].max(other[0]) < one[1].min(other[1])
}
