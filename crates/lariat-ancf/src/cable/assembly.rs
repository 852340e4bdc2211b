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
use crate::linalg::{Block, BlockTridiagonal};
use crate::rule::BendingRule;
use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x8};

/// Elements evaluated together.
const LANES: usize = 8;

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

    /// Adds `scale` times the elastic force to `out` and `scale` times its negative derivative (the stiffness) to `a`.
    pub fn add_force_and_tangent(
        &self,
        level: Level,
        q: &[f64],
        scale: f64,
        out: &mut [f64],
        a: &mut BlockTridiagonal,
    ) {
        with_bending!(&self.bending, b => dispatch!(level, simd => self.tangent_lanes(simd, b, q, scale, out, a)));
    }

    /// Gathers control vectors and stiffness of the group of elements that begins at `first`.
    #[inline(always)]
    fn gather<S: Simd>(
        &self,
        simd: S,
        first: usize,
        q: &[f64],
        scale: f64,
    ) -> (Control<f64x8<S>>, Stiffness<f64x8<S>>, f64x8<S>) {
        let mut raw = [[[0.0f64; LANES]; 3]; 3];
        for lane in 0..LANES {
            let e = (first + lane).min(self.count - 1);
            let n: &[f64; 12] = q[6 * e..6 * e + 12].try_into().expect("twelve coordinates");
            let s = self.scale[e];
            for x in 0..3 {
                raw[0][x][lane] = n[3 + x];
                raw[1][x][lane] = s * (n[6 + x] - n[x]);
                raw[2][x][lane] = n[9 + x];
            }
        }
        let load = |values: &[f64]| f64x8::from_slice(simd, &values[..LANES]);
        let d = core::array::from_fn(|k| core::array::from_fn(|x| load(&raw[k][x])));
        let stiffness =
            Stiffness { axial: load(&self.axial[first..]) * scale, bending: load(&self.flexural[first..]) * scale };
        (d, stiffness, load(&self.scale[first..]))
    }

    #[inline(always)]
    fn force_lanes<S: Simd, B: Bending>(&self, simd: S, bending: &B, q: &[f64], scale: f64, out: &mut [f64]) {
        for first in (0..self.count).step_by(LANES) {
            let (d, stiffness, s) = self.gather(simd, first, q, scale);
            let force = kernel::force(&self.table, bending, stiffness, &d);
            self.scatter_force(first, &force, s, out);
        }
    }

    #[inline(always)]
    fn tangent_lanes<S: Simd, B: Bending>(
        &self,
        simd: S,
        bending: &B,
        q: &[f64],
        scale: f64,
        out: &mut [f64],
        a: &mut BlockTridiagonal,
    ) {
        for first in (0..self.count).step_by(LANES) {
            let (d, stiffness, s) = self.gather(simd, first, q, scale);
            let (force, blocks) = kernel::force_and_tangent(&self.table, bending, stiffness, &d);
            self.scatter_force(first, &force, s, out);
            self.scatter_tangent(first, blocks, s, a);
        }
    }

    #[inline(always)]
    fn scatter_force<S: Simd>(&self, first: usize, g: &Control<f64x8<S>>, s: f64x8<S>, out: &mut [f64]) {
        let store = |v: &[f64x8<S>; 3]| -> [[f64; LANES]; 3] { v.map(|x| x.into()) };
        let (g0, g1, g2) = (store(&g[0]), store(&g[1].map(|x| x * s)), store(&g[2]));
        for lane in 0..LANES.min(self.count - first) {
            let n: &mut [f64; 12] =
                (&mut out[6 * (first + lane)..6 * (first + lane) + 12]).try_into().expect("twelve coordinates");
            for x in 0..3 {
                n[x] += g1[x][lane];
                n[3 + x] -= g0[x][lane];
                n[6 + x] -= g1[x][lane];
                n[9 + x] -= g2[x][lane];
            }
        }
    }

    #[inline(always)]
    fn scatter_tangent<S: Simd>(
        &self,
        first: usize,
        blocks: Blocks<f64x8<S>>,
        s: f64x8<S>,
        a: &mut BlockTridiagonal,
    ) {
        let store = |b: [[f64x8<S>; 3]; 3]| -> [[[f64; LANES]; 3]; 3] { b.map(|row| row.map(|x| x.into())) };
        let times = |b: [[f64x8<S>; 3]; 3], f: f64x8<S>| b.map(|row| row.map(|x| x * f));
        let [k00, k01, k02, k11, k12, k22] = blocks;
        let (k00, k02, k22) = (store(k00), store(k02), store(k22));
        let (k01, k12, k11) = (store(times(k01, s)), store(times(k12, s)), store(times(times(k11, s), s)));
        for lane in 0..LANES.min(self.count - first) {
            let e = first + lane;
            let at = |k: &[[[f64; LANES]; 3]; 3], r: usize, c: usize| k[r][c][lane];
            let lower = &mut a.lower[e].0;
            for c in 0..3 {
                for r in 0..3 {
                    lower[c][r] -= at(&k11, r, c);
                    lower[3 + c][r] += at(&k01, c, r);
                    lower[c][3 + r] -= at(&k12, c, r);
                    lower[3 + c][3 + r] += at(&k02, c, r);
                }
            }
            let (head, tail) = a.diag.split_at_mut(e + 1);
            let (i, j): (&mut Block, &mut Block) = (&mut head[e], &mut tail[0]);
            for c in 0..3 {
                for r in 0..3 {
                    i.0[c][r] += at(&k11, r, c);
                    i.0[c][3 + r] -= at(&k01, r, c);
                    i.0[3 + c][r] -= at(&k01, c, r);
                    i.0[3 + c][3 + r] += at(&k00, r, c);
                    j.0[c][r] += at(&k11, r, c);
                    j.0[c][3 + r] += at(&k12, c, r);
                    j.0[3 + c][r] += at(&k12, r, c);
                    j.0[3 + c][3 + r] += at(&k22, r, c);
                }
            }
        }
    }
}

fn absent<B: Bending>(_: &B) -> bool {
    B::ABSENT
}

