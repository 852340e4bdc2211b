//! Elements that are evaluated together: how their numbers are gathered from the nodes, and forces
//! and tangents added there.
//!
//! On x86-64 eight elements go together with AVX-512 and AVX2, and without them one by one;
//! elsewhere eight with what the processor has. The result is the same: see [`Real`].

use super::Elements;
use crate::Real;
use crate::element::gram::Control;
use crate::element::kernel::{Blocks, Load};
use crate::linalg::BlockTridiagonal;
use crate::simd::{LANES, load};
use fearless_simd::{Simd, SimdBase, SimdFrom, f64x8};

/// Elements that are evaluated together.
pub(super) trait Group: Load<Self::Number> + Copy {
    /// A number of each of them.
    type Number: Real;
    /// How many they are.
    const SIZE: usize;

    /// Returns the group that begins at element `first`.
    fn at(self, first: usize) -> Self;
    /// Gathers the control vectors from nodal coordinates, or their velocities from nodal
    /// velocities.
    fn control(self, elements: &Elements, q: &[f64]) -> Control<Self::Number>;
    /// Adds negative forces on control vectors to forces on the nodes.
    fn add_force(self, elements: &Elements, g: &Control<Self::Number>, out: &mut [f64]);
    /// Adds blocks over control vectors, and the mass, to the matrix over nodes.
    fn add_matrix(
        self,
        elements: &Elements,
        blocks: &Blocks<Self::Number>,
        mass_scale: f64,
        matrix: &mut BlockTridiagonal,
    );
    /// Adds a number of each element to a sum, in ascending order.
    fn add_to(self, elements: &Elements, value: Self::Number, sum: &mut f64);
}

/// Eight elements in lanes. Those beyond the last element have its second node at both ends; what
/// they give is dropped.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S> {
    pub simd: S,
    pub first: usize,
}

impl<S: Simd> Load<f64x8<S>> for Lanes<S> {
    #[inline(always)]
    fn load(&self, by_element: &[f64]) -> f64x8<S> {
        load(self.simd, by_element, self.first)
    }
}

impl<S: Simd> Group for Lanes<S> {
    type Number = f64x8<S>;
    /// Layout: all lanes.
    const SIZE: usize = LANES;

    #[inline(always)]
    fn at(self, first: usize) -> Self {
        Lanes { first, ..self }
    }

    #[inline(always)]
    fn control(self, elements: &Elements, q: &[f64]) -> Control<f64x8<S>> {
        let Lanes { simd, first } = self;
        let (nodes, _) = q.as_chunks::<6>();
        let node = |lane: usize| &nodes[(first + lane).min(elements.count)];
        let n = [node(0), node(1), node(2), node(3), node(4), node(5), node(6), node(7), node(8)];
        let s = self.load(&elements.scale);
        let mut d = [[<f64x8<S> as SimdBase<S>>::splat(simd, 0.0); 3]; 3];
        for x in 0..3 {
            let ([r0, r1], [t0, t1]) = (lanes(simd, &n, x), lanes(simd, &n, 3 + x));
            d[0][x] = t0;
            d[1][x] = (r1 - r0) * s;
            d[2][x] = t1;
        }
        d
    }

    // The sum at a node stays in registers until it is complete: a load of what has just been
    // stored in other parts waits for the store.
    #[inline(always)]
    fn add_force(self, elements: &Elements, g: &Control<f64x8<S>>, out: &mut [f64]) {
        let Lanes { first, .. } = self;
        let s = self.load(&elements.scale);
        let mut raw = [[[0.0f64; LANES]; 3]; 3];
        for x in 0..3 {
            g[0][x].store_slice(&mut raw[0][x]);
            (g[1][x] * s).store_slice(&mut raw[1][x]);
            g[2][x].store_slice(&mut raw[2][x]);
        }
        let count = LANES.min(elements.count - first);
        let (nodes, _) = out[6 * first..].as_chunks_mut::<6>();
        let mut sum = nodes[0];
        for (lane, pair) in (0..count).zip(1..) {
            for x in 0..3 {
                sum[x] += raw[1][x][lane];
                sum[3 + x] -= raw[0][x][lane];
            }
            nodes[lane] = sum;
            sum = nodes[pair];
            for x in 0..3 {
                sum[x] -= raw[1][x][lane];
                sum[3 + x] -= raw[2][x][lane];
            }
        }
        nodes[count] = sum;
    }

    #[inline(always)]
    fn add_matrix(
        self,
        elements: &Elements,
        blocks: &Blocks<f64x8<S>>,
        mass_scale: f64,
        matrix: &mut BlockTridiagonal,
    ) {
        let mass = mass(self, elements, mass_scale);
        let s = self.load(&elements.scale);
        let count = LANES.min(elements.count - self.first);
        self.add_columns::<0>(count, blocks, &mass, s, matrix);
        self.add_columns::<1>(count, blocks, &mass, s, matrix);
        self.add_columns::<2>(count, blocks, &mass, s, matrix);
    }

    #[inline(always)]
    fn add_to(self, elements: &Elements, value: f64x8<S>, sum: &mut f64) {
        let mut raw = [0.0; LANES];
        value.store_slice(&mut raw);
        for lane in 0..LANES.min(elements.count - self.first) {
            *sum += raw[lane];
        }
    }
}

impl<S: Simd> Lanes<S> {
    /// Adds columns `C` (of the position) and `3 + C` (of the slope), one column of one element per
    /// vector of lanes.
    #[inline(always)]
    fn add_columns<const C: usize>(
        self,
        count: usize,
        blocks: &Blocks<f64x8<S>>,
        mass: &[f64x8<S>; 10],
        s: f64x8<S>,
        a: &mut BlockTridiagonal,
    ) {
        let Lanes { simd, first } = self;
        let Columns { ii, ji, jj } = Columns::new::<C>(blocks, mass, s);
        let ii = [transpose(simd, ii[0]), transpose(simd, ii[1])];
        let ji = [transpose(simd, ji[0]), transpose(simd, ji[1])];
        let jj = [transpose(simd, jj[0]), transpose(simd, jj[1])];
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

/// Loads the entries of the mass matrices, times a factor.
#[inline(always)]
pub(super) fn mass<G: Group>(group: G, elements: &Elements, factor: f64) -> [G::Number; 10] {
    let mut mass = [group.load(&elements.mass[0]); 10];
    for i in 0..10 {
        mass[i] = group.load(&elements.mass[i]) * factor;
    }
    mass
}

/// Columns of a position and of a slope, in the blocks of the nodes (i, i), (j, i) and (j, j).
pub(super) struct Columns<T> {
    pub ii: [[T; 6]; 2],
    pub ji: [[T; 6]; 2],
    pub jj: [[T; 6]; 2],
}

impl<T: Real> Columns<T> {
    /// Maps 3x3 blocks over control vectors to columns `C` and `3 + C` over nodes, and adds the
    /// mass.
    #[inline(always)]
    pub fn new<const C: usize>([k00, k01, k02, k11, k12, k22]: &Blocks<T>, mass: &[T; 10], s: T) -> Self {
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
        Columns {
            ii: [with_mass::<T, C>(ii_r, mass[0], mass[1]), with_mass::<T, C>(ii_t, mass[1], mass[2])],
            ji: [with_mass::<T, C>(ji_r, mass[3], mass[5]), with_mass::<T, C>(ji_t, mass[4], mass[6])],
            jj: [with_mass::<T, C>(jj_r, mass[7], mass[8]), with_mass::<T, C>(jj_t, mass[8], mass[9])],
        }
    }
}

/// Adds the mass of axis `C`: `r` to the position's row, `t` to the slope's.
#[inline(always)]
fn with_mass<T: Real, const C: usize>(mut column: [T; 6], r: T, t: T) -> [T; 6] {
    column[C] = column[C] + r;
    column[3 + C] = column[3 + C] + t;
    column
}

/// Coordinate `i` of nine nodes: of the first eight, and of the last eight.
#[inline(always)]
fn lanes<S: Simd>(simd: S, n: &[&[f64; 6]; LANES + 1], i: usize) -> [f64x8<S>; 2] {
    let first = f64x8::simd_from(simd, [n[0][i], n[1][i], n[2][i], n[3][i], n[4][i], n[5][i], n[6][i], n[7][i]]);
    [first, first.slide::<1>(<f64x8<S> as SimdBase<S>>::splat(simd, n[8][i]))]
}

/// Transposes six rows and two of zeros: three rounds of a perfect shuffle rotate the six address
/// bits by three.
#[inline(always)]
fn transpose<S: Simd>(simd: S, m: [f64x8<S>; 6]) -> [f64x8<S>; LANES] {
    let zero = <f64x8<S> as SimdBase<S>>::splat(simd, 0.0);
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
