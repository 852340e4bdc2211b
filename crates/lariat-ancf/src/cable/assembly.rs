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
use crate::element::kernel::{self, Blocks, Stiffness};
use crate::element::mass;
use crate::linalg::{Block, BlockTridiagonal};
use crate::rule::BendingRule;
use fearless_simd::{Level, Simd, SimdBase, SimdFrom, dispatch, f64x8};

/// Elements evaluated together.
pub(super) const LANES: usize = 8;

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

pub(super) use with_bending;

/// The numbers of all elements, ready for the kernels.
#[derive(Clone, Debug)]
pub(crate) struct Elements {
    pub(super) table: AxialTable,
    pub(super) bending: BendingKernel,
    pub(super) count: usize,
    /// 3/l, EA l/4 and 2 EI/l by element, padded to a multiple of [`LANES`].
    scale: Vec<f64>,
    pub(super) axial: Vec<f64>,
    pub(super) flexural: Vec<f64>,
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
        let padded = |f: &dyn Fn(&crate::section::Element) -> f64| {
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
                let entry = |(i, e): (usize, &crate::section::Element)| {
                    mass::consistent(model.inertia(i), e.length)[row][column]
                };
                let mut values: Vec<f64> = model.elements.iter().enumerate().map(entry).collect();
                values.resize(values.len().next_multiple_of(LANES), values[values.len() - 1]);
                values
            }),
        }
    }

    /// Whether a bending rule runs.
    pub fn bends(&self) -> bool {
        !with_bending!(&self.bending, b => absent(b))
    }

    /// 3/l of element `e`.
    pub fn slope_scale(&self, e: usize) -> f64 {
        self.scale[e]
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
            let (axial, bending) = with_bending!(&self.bending, b => kernel::energy(&self.table, b, stiffness, &d));
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
    pub(super) fn gather<S: Simd>(
        &self,
        simd: S,
        first: usize,
        q: &[f64],
        scale: f64,
    ) -> (Control<f64x8<S>>, Stiffness<f64x8<S>>) {
        let node = |lane: usize| -> &[f64; 12] {
            let e = (first + lane).min(self.count - 1);
            q[6 * e..6 * e + 12].try_into().expect("twelve coordinates")
        };
        let n = [node(0), node(1), node(2), node(3), node(4), node(5), node(6), node(7)];
        let s = load(simd, &self.scale, first);
        let zero = f64x8::splat(simd, 0.0);
        let mut d = [[zero; 3]; 3];
        for x in 0..3 {
            d[0][x] = lanes(simd, &n, 3 + x);
            d[1][x] = (lanes(simd, &n, 6 + x) - lanes(simd, &n, x)) * s;
            d[2][x] = lanes(simd, &n, 9 + x);
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
    pub(super) fn scatter_force<S: Simd>(&self, simd: S, first: usize, g: &Control<f64x8<S>>, out: &mut [f64]) {
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
    pub(super) fn scatter_matrix<S: Simd>(
        &self,
        simd: S,
        first: usize,
        blocks: &Blocks<f64x8<S>>,
        mass_scale: f64,
        a: &mut BlockTridiagonal,
    ) {
        let mut mass = [f64x8::splat(simd, 0.0); 10];
        for i in 0..10 {
            mass[i] = load(simd, &self.mass[i], first) * mass_scale;
        }
        let s = load(simd, &self.scale, first);
        let count = LANES.min(self.count - first);
        self.scatter_columns::<S, 0>(simd, first, count, blocks, &mass, s, a);
        self.scatter_columns::<S, 1>(simd, first, count, blocks, &mass, s, a);
        self.scatter_columns::<S, 2>(simd, first, count, blocks, &mass, s, a);
    }

    /// Columns `C` (of the position) and `3 + C` (of the slope).
    #[inline(always)]
    fn scatter_columns<S: Simd, const C: usize>(
        &self,
        simd: S,
        first: usize,
        count: usize,
        [k00, k01, k02, k11, k12, k22]: &Blocks<f64x8<S>>,
        mass: &[f64x8<S>; 10],
        s: f64x8<S>,
        a: &mut BlockTridiagonal,
    ) {
        let rr = [k11[0][C] * s * s, k11[1][C] * s * s, k11[2][C] * s * s];
        // rows of the position, then of the slope
        let (ii_r, ii_t) = (
            [rr[0], rr[1], rr[2], -(k01[0][C] * s), -(k01[1][C] * s), -(k01[2][C] * s)],
            [-(k01[C][0] * s), -(k01[C][1] * s), -(k01[C][2] * s), k00[0][C], k00[1][C], k00[2][C]],
        );
        let (ji_r, ji_t) = (
            [-rr[0], -rr[1], -rr[2], -(k12[C][0] * s), -(k12[C][1] * s), -(k12[C][2] * s)],
            [k01[C][0] * s, k01[C][1] * s, k01[C][2] * s, k02[C][0], k02[C][1], k02[C][2]],
        );
        let (jj_r, jj_t) = (
            [rr[0], rr[1], rr[2], k12[C][0] * s, k12[C][1] * s, k12[C][2] * s],
            [k12[0][C] * s, k12[1][C] * s, k12[2][C] * s, k22[0][C], k22[1][C], k22[2][C]],
        );
        let ii = [
            transpose(simd, with_mass::<S, C>(ii_r, mass[0], mass[1])),
            transpose(simd, with_mass::<S, C>(ii_t, mass[1], mass[2])),
        ];
        let ji = [
            transpose(simd, with_mass::<S, C>(ji_r, mass[3], mass[5])),
            transpose(simd, with_mass::<S, C>(ji_t, mass[4], mass[6])),
        ];
        let jj = [
            transpose(simd, with_mass::<S, C>(jj_r, mass[7], mass[8])),
            transpose(simd, with_mass::<S, C>(jj_t, mass[8], mass[9])),
        ];
        for lane in 0..count {
            let e = first + lane;
            let lower = &mut a.lower[e].0;
            ji[0][lane].store_slice(&mut lower[C]);
            ji[1][lane].store_slice(&mut lower[3 + C]);
            // the left neighbour wrote its share of the diagonal block before
            let diagonal = &mut a.diag[e].0;
            (f64x8::from_slice(simd, &diagonal[C]) + ii[0][lane]).store_slice(&mut diagonal[C]);
            (f64x8::from_slice(simd, &diagonal[3 + C]) + ii[1][lane]).store_slice(&mut diagonal[3 + C]);
            let next = &mut a.diag[e + 1].0;
            jj[0][lane].store_slice(&mut next[C]);
            jj[1][lane].store_slice(&mut next[3 + C]);
        }
    }
}

/// Adds the mass of axis `C`: `r` to the position's row, `t` to the slope's.
#[inline(always)]
fn with_mass<S: Simd, const C: usize>(mut column: [f64x8<S>; 6], r: f64x8<S>, t: f64x8<S>) -> [f64x8<S>; 6] {
    column[C] += r;
    column[3 + C] += t;
    column
}

/// Coordinate `i` of eight elements.
#[inline(always)]
fn lanes<S: Simd>(simd: S, n: &[&[f64; 12]; LANES], i: usize) -> f64x8<S> {
    f64x8::simd_from(simd, [n[0][i], n[1][i], n[2][i], n[3][i], n[4][i], n[5][i], n[6][i], n[7][i]])
}

/// Eight consecutive values from `first` on.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, values: &[f64], first: usize) -> f64x8<S> {
    f64x8::from_slice(simd, &values[first..first + LANES])
}

/// Transposes six rows and two of zeros: three rounds of a perfect shuffle rotate the six address bits by three.
#[inline(always)]
fn transpose<S: Simd>(simd: S, m: [f64x8<S>; 6]) -> [f64x8<S>; LANES] {
    let zero = f64x8::splat(simd, 0.0);
    shuffle(shuffle(shuffle([m[0], m[1], m[2], m[3], m[4], m[5], zero, zero])))
}

#[inline(always)]
fn shuffle<S: Simd>(m: [f64x8<S>; LANES]) -> [f64x8<S>; LANES] {
    [
        m[0].zip_low(m[4]),
        m[0].zip_high(m[4]),
        m[1].zip_low(m[5]),
        m[1].zip_high(m[5]),
        m[2].zip_low(m[6]),
        m[2].zip_high(m[6]),
        m[3].zip_low(m[7]),
        m[3].zip_high(m[7]),
    ]
}

fn absent<B: Bending>(_: &B) -> bool {
    B::ABSENT
}
