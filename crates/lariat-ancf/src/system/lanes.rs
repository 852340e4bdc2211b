//! From elements to nodes: the force of all elements and its tangent, eight elements at a time.
//!
//! # Equation
//!
//! Control vectors are gathered from the nodal coordinates (r, t), the kernel runs in lanes
//! ([`kernel`](crate::element::kernel)), and the result is scattered with d1 = s (r_j - r_i), s = 3/l:
//!
//! ```text
//! dU/dr_i = -s G1   dU/dt_i = G0   dU/dr_j = s G1   dU/dt_j = G2        G_k = dU/dd_k
//! ```
//!
//! # Validity
//!
//! Elements are added in ascending order whatever the width of the lanes, so sums round the same way everywhere. The last group is
//! padded with elements without length, which are computed and dropped. Effects are a type parameter of the loop: a cable without
//! any runs code that does not contain them.

pub(crate) mod discrete_gradient;

use super::elements::{Elements, with_bending};
use crate::effect::acts::ForceInput;
use crate::effect::tables::ElementTables;
use crate::element::bending::Bending;
use crate::element::gram::Control;
use crate::element::kernel::{Blocks, ElementState, GramForce, Kernel, Load, NoEffects, Stiffness};
use crate::linalg::{Block, BlockTridiagonal};
use crate::simd::{LANES, dispatch, load};
use fearless_simd::{Level, Simd, SimdBase, SimdFrom, f64x8};

/// Loads the numbers of the group of elements that begins at `first`.
#[derive(Clone, Copy)]
struct Group<S> {
    simd: S,
    first: usize,
}

impl<S: Simd> Load<f64x8<S>> for Group<S> {
    #[inline(always)]
    fn load(&self, by_element: &[f64]) -> f64x8<S> {
        load(self.simd, by_element, self.first)
    }
}

/// Where the tangent goes.
pub(crate) struct MatrixOutput<'a> {
    /// The matrix, which is overwritten.
    pub matrix: &'a mut BlockTridiagonal,
    /// Factor on the mass matrix in it.
    pub mass_scale: f64,
}

impl Elements {
    /// Adds the force of all elements to `out`, times the input's factor.
    pub fn add_force(&self, level: Level, effects: Option<&ElementTables>, input: ForceInput<'_>, out: &mut [f64]) {
        with_bending!(&self.bending, bending => match effects {
            None => dispatch!(level, simd => self.force_lanes(simd, bending, &NoEffects, input, out)),
            Some(effects) => dispatch!(level, simd => self.force_lanes(simd, bending, effects, input, out)),
        });
    }

    /// Adds the force of all elements to `out`, and overwrites the matrix by its negative derivative (the stiffness) plus the mass
    /// matrix, times their factors.
    pub fn add_force_and_matrix(
        &self,
        level: Level,
        effects: Option<&ElementTables>,
        input: ForceInput<'_>,
        out: &mut [f64],
        to: MatrixOutput<'_>,
    ) {
        with_bending!(&self.bending, bending => match effects {
            None => dispatch!(level, simd => self.matrix_lanes(simd, bending, &NoEffects, input, out, to)),
            Some(effects) => dispatch!(level, simd => self.matrix_lanes(simd, bending, effects, input, out, to)),
        });
    }

    #[inline(always)]
    fn force_lanes<S: Simd, B: Bending, E: GramForce>(
        &self,
        simd: S,
        bending: &B,
        effects: &E,
        input: ForceInput<'_>,
        out: &mut [f64],
    ) {
        let kernel = Kernel { table: &self.table, bending, effects };
        let moving = effects.needs_rates() && !input.v.is_empty();
        for first in (0..self.count).step_by(LANES) {
            let group = Group { simd, first };
            let force = kernel.force(&self.gather(group, input, moving), &group);
            self.scatter_force(simd, first, &force, out);
        }
    }

    #[inline(always)]
    fn matrix_lanes<S: Simd, B: Bending, E: GramForce>(
        &self,
        simd: S,
        bending: &B,
        effects: &E,
        input: ForceInput<'_>,
        out: &mut [f64],
        to: MatrixOutput<'_>,
    ) {
        let kernel = Kernel { table: &self.table, bending, effects };
        let moving = effects.needs_rates() && !input.v.is_empty();
        to.matrix.diag[0] = Block::ZERO;
        for first in (0..self.count).step_by(LANES) {
            let group = Group { simd, first };
            let state = self.gather(group, input, moving);
            let (force, blocks) = kernel.force_and_tangent(&state, input.dv_dq, &group);
            self.scatter_force(simd, first, &force, out);
            self.scatter_matrix(simd, first, &blocks, to.mass_scale, to.matrix);
        }
    }

    /// Gathers what the elements of a group are evaluated at.
    #[inline(always)]
    fn gather<S: Simd>(&self, group: Group<S>, input: ForceInput<'_>, moving: bool) -> ElementState<f64x8<S>> {
        let stiffness = Stiffness {
            axial: group.load(&self.axial) * input.scale,
            bending: group.load(&self.flexural) * input.scale,
        };
        let d = self.gather_control(group, input.q);
        let velocity = if moving { Some(self.gather_control(group, input.v)) } else { None };
        ElementState { stiffness, d, velocity }
    }

    /// Gathers the control vectors of a group from nodal coordinates, or their velocities from nodal velocities. Lanes beyond the last element
    /// have its second node at both ends.
    #[inline(always)]
    fn gather_control<S: Simd>(&self, Group { simd, first }: Group<S>, q: &[f64]) -> Control<f64x8<S>> {
        let (nodes, _) = q.as_chunks::<6>();
        let node = |lane: usize| &nodes[(first + lane).min(self.count)];
        let n = [node(0), node(1), node(2), node(3), node(4), node(5), node(6), node(7), node(8)];
        let s = load(simd, &self.scale, first);
        let mut d = [[f64x8::splat(simd, 0.0); 3]; 3];
        for x in 0..3 {
            let ([r0, r1], [t0, t1]) = (lanes(simd, &n, x), lanes(simd, &n, 3 + x));
            d[0][x] = t0;
            d[1][x] = (r1 - r0) * s;
            d[2][x] = t1;
        }
        d
    }

    /// Adds the forces of a group. The sum at a node stays in registers until it is complete: a load of what has just been stored in other parts
    /// waits for the store.
    #[inline(always)]
    fn scatter_force<S: Simd>(&self, simd: S, first: usize, g: &Control<f64x8<S>>, out: &mut [f64]) {
        let s = load(simd, &self.scale, first);
        let mut raw = [[[0.0f64; LANES]; 3]; 3];
        for x in 0..3 {
            g[0][x].store_slice(&mut raw[0][x]);
            (g[1][x] * s).store_slice(&mut raw[1][x]);
            g[2][x].store_slice(&mut raw[2][x]);
        }
        let count = LANES.min(self.count - first);
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

    /// Maps the 3x3 blocks over control vectors into 6x6 blocks over nodes, one column of one element per vector of lanes.
    #[inline(always)]
    fn scatter_matrix<S: Simd>(
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

/// Coordinate `i` of nine nodes: of the first eight, and of the last eight.
#[inline(always)]
fn lanes<S: Simd>(simd: S, n: &[&[f64; 6]; LANES + 1], i: usize) -> [f64x8<S>; 2] {
    let first = f64x8::simd_from(simd, [n[0][i], n[1][i], n[2][i], n[3][i], n[4][i], n[5][i], n[6][i], n[7][i]]);
    [first, first.slide::<1>(f64x8::splat(simd, n[8][i]))]
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
