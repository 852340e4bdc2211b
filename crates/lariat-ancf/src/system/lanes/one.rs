//! Elements one by one, for x86-64 processors without AVX2.
//!
//! # Alternatives considered
//!
//! Eight elements in lanes with SSE2, four registers a number: the force alone in 0.55 of the time,
//! forces with tangents and whole steps within a tenth; a third more of the compiler's memory for
//! the whole crate.

use super::Elements;
use super::group::{Columns, Group, mass};
use crate::element::gram::Control;
use crate::element::kernel::{Blocks, Load};
use crate::linalg::BlockTridiagonal;

/// The element with this number.
#[derive(Clone, Copy)]
pub(super) struct One(pub usize);

impl Load<f64> for One {
    #[inline(always)]
    fn load(&self, by_element: &[f64]) -> f64 {
        by_element[self.0]
    }
}

impl Group for One {
    type Number = f64;
    /// Layout: one lane.
    const SIZE: usize = 1;

    #[inline(always)]
    fn at(self, first: usize) -> Self {
        One(first)
    }

    #[inline(always)]
    fn control(self, elements: &Elements, q: &[f64]) -> Control<f64> {
        elements.control(self.0, q)
    }

    #[inline(always)]
    fn add_force(self, elements: &Elements, g: &Control<f64>, out: &mut [f64]) {
        let s = self.load(&elements.scale);
        let n = &mut out[6 * self.0..6 * self.0 + 12];
        for x in 0..3 {
            n[x] += g[1][x] * s;
            n[3 + x] -= g[0][x];
            n[6 + x] -= g[1][x] * s;
            n[9 + x] -= g[2][x];
        }
    }

    #[inline(always)]
    fn add_matrix(self, elements: &Elements, blocks: &Blocks<f64>, mass_scale: f64, matrix: &mut BlockTridiagonal) {
        let mass = mass(self, elements, mass_scale);
        let s = self.load(&elements.scale);
        self.add_columns(0, Columns::new::<0>(blocks, &mass, s), matrix);
        self.add_columns(1, Columns::new::<1>(blocks, &mass, s), matrix);
        self.add_columns(2, Columns::new::<2>(blocks, &mass, s), matrix);
    }

    #[inline(always)]
    fn add_to(self, _: &Elements, value: f64, sum: &mut f64) {
        *sum += value;
    }
}

impl One {
    /// Adds columns `c` (of the position) and `3 + c` (of the slope).
    fn add_columns(self, c: usize, Columns { ii, ji, jj }: Columns<f64>, a: &mut BlockTridiagonal) {
        for k in 0..2 {
            let column = 3 * k + c;
            a.lower[self.0].0[column] = padded(&ji[k]);
            // the left neighbour wrote its share of the diagonal block before
            let diagonal = &mut a.diag[self.0].0[column];
            diagonal.iter_mut().zip(padded(&ii[k])).for_each(|(entry, x)| *entry += x);
            a.diag[self.0 + 1].0[column] = padded(&jj[k]);
        }
    }
}

/// Returns a column with the two zeros that fill its lanes.
fn padded([a, b, c, d, e, f]: &[f64; 6]) -> [f64; 8] {
    [*a, *b, *c, *d, *e, *f, 0.0, 0.0]
}
