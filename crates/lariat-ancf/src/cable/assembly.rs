//! From elements to nodes: the elastic force of a cable and its tangent, eight elements at a time.
//!
//! Control vectors are gathered from the nodal coordinates (r, t), the kernel runs in lanes
//! ([`kernel`](crate::element::kernel)), and the result is scattered with d1 = s (r_j - r_i), s = 3/l:
//!
//! ```text
//! dU/dr_i = -s G1   dU/dt_i = G0   dU/dr_j = s G1   dU/dt_j = G2        G_k = dU/dd_k
//! ```
//!
//! Elements are added in ascending order whatever the width of the lanes, so sums round the same way everywhere.
//! The last group is padded with copies of the last element, which are computed and dropped.

use super::model::Model;
use crate::axial::AxialTable;
use crate::bending::gauss::Gauss;
use crate::bending::t1::T1;
use crate::bending::t2::T2;
use crate::bending::{Bending, NoBending};
use crate::element::gram::Control;
use crate::element::mass;
use crate::element::kernel::{self, Blocks, Stiffness};
use crate::linalg::{Block, BlockTridiagonal};
use crate::rule::BendingRule;
use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x8};

/// Elements evaluated together.
const LANES: usize = 8;

/// Rows and columns, over (r_i, t_i, r_j, t_j), of the entries of the mass matrix that lanes load.
const MASS_ENTRIES: [(usize, usize); 10] =
    [(0, 0), (0, 1), (1, 1), (2, 0), (2, 1), (3, 0), (3, 1), (2, 2), (2, 3), (3, 3)];

/// A bending rule with its numbers.
#[derive(Clone, Debug)]
pub(crate) enum BendingKernel {
    None(NoBending),
    T1(T1),
    T2(T2),
    Gauss(Gauss),
}

/// Runs `$body` with `$kernel` bound to the concrete bending rule.
macro_rules! with_bending {
    ($bending:expr, $kernel:ident => $body:expr) => {
        match $bending {
            BendingKernel::None($kernel) => $body,
            BendingKernel::T1($kernel) => $body,
            BendingKernel::T2($kernel) => $body,
            BendingKernel::Gauss($kernel) => $body,
        }
    };
}

/// The numbers of all elements, ready for the kernels.
#[derive(Clone, Debug)]
pub(crate) struct Elements {
    table: AxialTable,
    bending: BendingKernel,
    count: usize,
    /// 3/l, EA l/4 and 2 EI/l by element, padded to a multiple of [`LANES`].
    scale: Vec<f64>,
    axial: Vec<f64>,
    flexural: Vec<f64>,
    /// Entries of the element's mass matrix: (i, i) rr, rt, tt; (j, i) rr, rt, tr, tt; (j, j) rr, rt, tt. Padded likewise.
    mass: [Vec<f64>; 10],
}

impl Elements {
    pub fn new(model: &Model) -> Self {
        let bending = match model.rule.bending {
            BendingRule::None => BendingKernel::None(NoBending),
            BendingRule::T1 => BendingKernel::T1(T1),
            BendingRule::T2 => BendingKernel::T2(T2::default()),
            BendingRule::Gauss(points) => BendingKernel::Gauss(Gauss::new(points as usize)),
        };
        let padded = |f: &dyn Fn(&super::model::Element) -> f64| {
            let mut values: Vec<f64> = model.elements.iter().map(f).collect();
            values.resize(values.len().next_multiple_of(LANES), values[values.len() - 1]);
            values
        };
        Elements {
            table: model.rule.axial_table(),
            bending,
            count: model.elements.len(),
            scale: padded(&|e| 3.0 / e.length),
            axial: padded(&|e| 0.25 * e.section.axial_stiffness * e.length),
            flexural: padded(&|e| 2.0 * e.section.bending_stiffness / e.length),
            mass: MASS_ENTRIES.map(|(row, column)| {
                padded(&|e| mass::consistent(e.section.mass_per_length, e.length)[row][column])
            }),
        }
    }

    /// Whether a bending rule runs.
    pub fn bends(&self) -> bool {
        !with_bending!(&self.bending, b => absent(b))
    }

    /// Control vectors of element `e`.
    pub fn control(&self, e: usize, q: &[f64]) -> Control<f64> {
        let n = &q[6 * e..6 * e + 12];
        let s = self.scale[e];
        [[n[3], n[4], n[5]], core::array::from_fn(|x| s * (n[6 + x] - n[x])), [n[9], n[10], n[11]]]
    }

    /// Axial and bending energy in J.
    pub fn energy(&self, q: &[f64]) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for e in 0..self.count {
            let stiffness = Stiffness { axial: self.axial[e], bending: self.flexural[e] };
            let d = self.control(e, q);
            let (axial, bending) =
                with_bending!(&self.bending, b => kernel::energy(&self.table, b, stiffness, &d));
            sum = (sum.0 + axial, sum.1 + bending);
        }
        sum
    }

    /// Adds `scale` times the elastic force at `q` to `out`.
    pub fn add_force(&self, level: Level, q: &[f64], scale: f64, out: &mut [f64]) {
        with_bending!(&self.bending, b => dispatch!(level, simd => self.force_lanes(simd, b, q, scale, out)));
    }

    /// Adds `scale` times the elastic force to `out`, and overwrites `a` by `scale` times its negative derivative (the
    /// stiffness) plus `mass_scale` times the mass matrix.
    pub fn add_force_and_matrix(
        &self,
        level: Level,
        q: &[f64],
        scale: f64,
        mass_scale: f64,
        out: &mut [f64],
        a: &mut BlockTridiagonal,
    ) {
        with_bending!(&self.bending, b => dispatch!(level, simd => {
            self.matrix_lanes(simd, b, q, scale, mass_scale, out, a)
        }));
    }

    /// Gathers control vectors and stiffness of the group of elements that begins at `first`.
    #[inline(always)]
    fn gather<S: Simd>(&self, simd: S, first: usize, q: &[f64], scale: f64) -> (Control<f64x8<S>>, Stiffness<f64x8<S>>) {
        let mut raw = [[[0.0f64; LANES]; 3]; 3];
        for lane in 0..LANES {
            let e = (first + lane).min(self.count - 1);
            let n = &q[6 * e..6 * e + 12];
            let s = self.scale[e];
            for x in 0..3 {
                raw[0][x][lane] = n[3 + x];
                raw[1][x][lane] = s * (n[6 + x] - n[x]);
                raw[2][x][lane] = n[9 + x];
            }
        }
        let mut d = [[f64x8::splat(simd, 0.0); 3]; 3];
        for k in 0..3 {
            for x in 0..3 {
                d[k][x] = f64x8::from_slice(simd, &raw[k][x]);
            }
        }
        let stiffness = Stiffness {
            axial: load(simd, &self.axial, first) * scale,
            bending: load(simd, &self.flexural, first) * scale,
        };
        (d, stiffness)
    }

    #[inline(always)]
    fn force_lanes<S: Simd, B: Bending>(&self, simd: S, bending: &B, q: &[f64], scale: f64, out: &mut [f64]) {
        for first in (0..self.count).step_by(LANES) {
            let (d, stiffness) = self.gather(simd, first, q, scale);
            let force = kernel::force(&self.table, bending, stiffness, &d);
            self.scatter_force(simd, first, &force, out);
        }
    }

    #[inline(always)]
    fn matrix_lanes<S: Simd, B: Bending>(
        &self,
        simd: S,
        bending: &B,
        q: &[f64],
        scale: f64,
        mass_scale: f64,
        out: &mut [f64],
        a: &mut BlockTridiagonal,
    ) {
        a.diag[0] = Block::ZERO;
        for first in (0..self.count).step_by(LANES) {
            let (d, stiffness) = self.gather(simd, first, q, scale);
            let (force, blocks) = kernel::force_and_tangent(&self.table, bending, stiffness, &d);
            self.scatter_force(simd, first, &force, out);
            self.scatter_matrix(simd, first, &blocks, mass_scale, a);
        }
    }

    #[inline(always)]
    fn scatter_force<S: Simd>(&self, simd: S, first: usize, g: &Control<f64x8<S>>, out: &mut [f64]) {
        let s = load(simd, &self.scale, first);
        let mut raw = [[[0.0f64; LANES]; 3]; 3];
        for x in 0..3 {
            g[0][x].store_slice(&mut raw[0][x]);
            (g[1][x] * s).store_slice(&mut raw[1][x]);
            g[2][x].store_slice(&mut raw[2][x]);
        }
        for lane in 0..LANES.min(self.count - first) {
            let n = &mut out[6 * (first + lane)..6 * (first + lane) + 12];
            for x in 0..3 {
                n[x] += raw[1][x][lane];
                n[3 + x] -= raw[0][x][lane];
                n[6 + x] -= raw[1][x][lane];
                n[9 + x] -= raw[2][x][lane];
            }
        }
    }

    /// Turns the 3x3 blocks over control vectors into 6x6 blocks over nodes, one column of one element per vector of lanes.
    #[inline(always)]
    fn scatter_matrix<S: Simd>(
        &self,
        simd: S,
        first: usize,
        blocks: &Blocks<f64x8<S>>,
        mass_scale: f64,
        a: &mut BlockTridiagonal,
    ) {
        let [k00, k01, k02, k11, k12, k22] = blocks;
        let zero = f64x8::splat(simd, 0.0);
        let s = load(simd, &self.scale, first);
        let mut mass = [zero; 10];
        for (m, values) in mass.iter_mut().zip(&self.mass) {
            *m = load(simd, values, first) * mass_scale;
        }
        let count = LANES.min(self.count - first);
        for c in 0..3 {
            // columns of r_i and t_i, then of r_j and t_j
            let (mut ii_r, mut ii_t) = ([zero; LANES], [zero; LANES]);
            let (mut ji_r, mut ji_t) = ([zero; LANES], [zero; LANES]);
            let (mut jj_r, mut jj_t) = ([zero; LANES], [zero; LANES]);
            for r in 0..3 {
                let rr = k11[r][c] * s * s;
                ii_r[r] = rr;
                jj_r[r] = rr;
                ji_r[r] = -rr;
                ii_r[3 + r] = -(k01[r][c] * s);
                ii_t[r] = -(k01[c][r] * s);
                ii_t[3 + r] = k00[r][c];
                ji_r[3 + r] = -(k12[c][r] * s);
                ji_t[r] = k01[c][r] * s;
                ji_t[3 + r] = k02[c][r];
                jj_r[3 + r] = k12[c][r] * s;
                jj_t[r] = k12[r][c] * s;
                jj_t[3 + r] = k22[r][c];
            }
            ii_r[c] = ii_r[c] + mass[0];
            ii_r[3 + c] = ii_r[3 + c] + mass[1];
            ii_t[c] = ii_t[c] + mass[1];
            ii_t[3 + c] = ii_t[3 + c] + mass[2];
            ji_r[c] = ji_r[c] + mass[3];
            ji_t[c] = ji_t[c] + mass[4];
            ji_r[3 + c] = ji_r[3 + c] + mass[5];
            ji_t[3 + c] = ji_t[3 + c] + mass[6];
            jj_r[c] = jj_r[c] + mass[7];
            jj_r[3 + c] = jj_r[3 + c] + mass[8];
            jj_t[c] = jj_t[c] + mass[8];
            jj_t[3 + c] = jj_t[3 + c] + mass[9];
            for (column, ii, ji, jj) in [(c, ii_r, ji_r, jj_r), (3 + c, ii_t, ji_t, jj_t)] {
                let (ii, ji, jj) = (transpose(ii), transpose(ji), transpose(jj));
                for lane in 0..count {
                    let e = first + lane;
                    ji[lane].store_slice(&mut a.lower[e].0[column]);
                    // the left neighbour wrote its share of the diagonal block before
                    let diagonal = &mut a.diag[e].0[column];
                    (f64x8::from_slice(simd, diagonal) + ii[lane]).store_slice(diagonal);
                    jj[lane].store_slice(&mut a.diag[e + 1].0[column]);
                }
            }
        }
    }
}

/// Eight consecutive values from `first` on.
#[inline(always)]
fn load<S: Simd>(simd: S, values: &[f64], first: usize) -> f64x8<S> {
    f64x8::from_slice(simd, &values[first..first + LANES])
}

/// Transposes an 8x8 matrix: three rounds of a perfect shuffle rotate the six address bits by three.
#[inline(always)]
fn transpose<S: Simd>(mut m: [f64x8<S>; LANES]) -> [f64x8<S>; LANES] {
    for _ in 0..3 {
        let mut next = m;
        for i in 0..4 {
            next[2 * i] = m[i].zip_low(m[i + 4]);
            next[2 * i + 1] = m[i].zip_high(m[i + 4]);
        }
        m = next;
    }
    m
}

fn absent<B: Bending>(_: &B) -> bool {
    B::ABSENT
}
