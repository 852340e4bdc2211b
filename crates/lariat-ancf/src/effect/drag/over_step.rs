//! Drag over a step of the [discrete gradient](crate::integrate::discrete_gradient): linear in the
//! mean velocity, with coefficients of the iterate about which the step is linearised.
//!
//! # Equation
//!
//! ```text
//! f = -D (v^ - u),   D = k_n |w_n| (I - e e^T) + k_t |w.e| e e^T,   w = v - u of that iterate, e its direction
//! ```
//!
//! D is positive semi-definite, so the power in a fluid at rest is never positive, at any step and
//! any iterate, and the step matrix stays definite. At convergence w = v^ - u, and this is the
//! force of [`drag`](super).

use super::lanes::{DragTable, Lanes, PAIRS, combine, times, wetted};
use super::law::Split;
use crate::effect::acts::StepInput;
use crate::element::gram::dot;
use crate::linalg::BlockTridiagonal;
use crate::simd::{LANES, load};
use fearless_simd::{Simd, SimdBase};

impl DragTable {
    #[inline(always)]
    pub(super) fn over_step<S: Simd>(
        &self,
        simd: S,
        step: StepInput<'_>,
        out: &mut [f64],
        mut matrix: Option<&mut BlockTridiagonal>,
    ) {
        let base = self.flow.in_time(step.time);
        let zero = Lanes::splat(simd, 0.0);
        for first in (0..self.count).step_by(LANES) {
            let length = load(simd, &self.length, first);
            let inverse = Lanes::splat(simd, 1.0) / length;
            let x = self.gather(simd, first, step.middle_before, length);
            let about = self.gather(simd, first, step.velocity_before, length);
            let velocity = self.gather(simd, first, step.velocity, length);
            let kn = load(simd, &self.normal, first) * length;
            let kt = load(simd, &self.tangential, first) * length;
            let mut force = [[zero; 3]; 4];
            let mut blocks = [[[zero; 3]; 3]; 10];
            for point in &self.points {
                let place = combine(&x, &point.position);
                let slope = times(&combine(&x, &point.slope), inverse);
                let (flow, share) = self.fluid(simd, (step.time, &base), first, point.xi, &place);
                let about = relative(&combine(&about, &point.position), &flow);
                let (kn, kt) = wetted((kn * point.weight, kt * point.weight), share);
                let drag = Split::new(&about, &slope).resistance(kn, kt);
                let v = relative(&combine(&velocity, &point.position), &flow);
                let f = [dot(&drag[0], &v), dot(&drag[1], &v), dot(&drag[2], &v)];
                for k in 0..4 {
                    for c in 0..3 {
                        force[k][c] -= f[c] * point.position[k];
                    }
                }
                if matrix.is_some() {
                    for (block, (k, m)) in blocks.iter_mut().zip(PAIRS) {
                        let hh = step.leg.b * step.h * point.position[k] * point.position[m];
                        for r in 0..3 {
                            for c in 0..3 {
                                block[r][c] += drag[r][c] * hh;
                            }
                        }
                    }
                }
            }
            self.scatter_by_length(first, length, (&mut force, &mut blocks), out, matrix.as_deref_mut());
        }
    }
}

#[inline(always)]
fn relative<S: Simd>(v: &[Lanes<S>; 3], flow: &[Lanes<S>; 3]) -> [Lanes<S>; 3] {
    [v[0] - flow[0], v[1] - flow[1], v[2] - flow[2]]
}
