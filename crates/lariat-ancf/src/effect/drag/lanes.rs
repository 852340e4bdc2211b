//! Drag, from Gauss points to nodes, eight elements at a time.
//!
//! # Equation
//!
//! In coordinates (r_i, l t_i, r_j, l t_j) the weights of position and slope are constants H_k and
//! S_k/l of a unit element, so
//!
//! ```text
//! F_k = sum_q w_q l H_k f_q        -dF_k/dx_m = sum_q w_q l (H_k H_m rate D_q - 1/2 (H_k S_m A_q + S_k H_m A_q^T)/l)
//! ```
//!
//! D = -df/dv and A = df/dt ([`drag`](super)); rows and columns of slopes are multiplied by l at
//! the end. Elements are added in ascending order whatever the width of the lanes.

use super::law::{Drag, Split};
use crate::dual::{Dual, constant};
use crate::effect::acts::{ForceInput, PointForce, StepInput};
use crate::effect::{Flow, Target};
use crate::element::shape;
use crate::error::{Error, require_finite};
use crate::linalg::BlockTridiagonal;
use crate::quadrature::gauss_legendre;
use crate::scales::SMALLEST;
use crate::scales::effect::{DIFFERENCE, POINTS};
use crate::section::Element;
use crate::simd::{LANES, dispatch, load, padded};
use crate::water::{Sea, Surface, wet};
use fearless_simd::{Level, Simd, SimdBase, SimdFrom, f64x8};
use nalgebra::Vector3;

/// Layout: pairs (k, m), k >= m, of the coordinates (r_i, t_i, r_j, t_j).
pub(super) const PAIRS: [(usize, usize); 10] =
    [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 0), (3, 1), (3, 2), (3, 3)];

/// A Gauss point: weight, and weights of position and slope on a unit element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub xi: f64,
    pub weight: f64,
    pub position: [f64; 4],
    pub slope: [f64; 4],
}

/// Drag of all elements, as the evaluation needs it.
#[derive(Clone, Debug)]
pub(crate) struct DragTable {
    pub(super) points: Vec<Point>,
    pub(super) count: usize,
    pub(super) flow: Flow,
    /// Free surface, and by element the radius in m over which a section comes out of it.
    pub(super) sea: Option<Sea>,
    pub(super) radius: Vec<f64>,
    /// Length in m, k_n and k_t in kg/m^2 by element, padded.
    pub(super) length: Vec<f64>,
    pub(super) normal: Vec<f64>,
    pub(super) tangential: Vec<f64>,
}

pub(super) type Lanes<S> = f64x8<S>;

/// Forces on the four nodal vectors of elements, and the blocks of their derivative.
type ForceAndBlocks<'a, S> = (&'a mut [[Lanes<S>; 3]; 4], &'a mut [[[Lanes<S>; 3]; 3]; PAIRS.len()]);

impl DragTable {
    pub fn new(drag: &Drag, cable: &Target<'_>) -> Self {
        let diameter = |e: &Element| drag.diameter.or(e.section.diameter).unwrap_or(0.0);
        let factor = |coefficient: f64| move |e: &Element| 0.5 * drag.fluid_density * diameter(e) * coefficient;
        let points = gauss_legendre(POINTS).into_iter().map(|(xi, weight)| Point {
            xi,
            weight,
            position: shape::position(xi, 1.0),
            slope: shape::slope(xi, 1.0),
        });
        DragTable {
            points: points.collect(),
            count: cable.elements.len(),
            flow: drag.flow.clone(),
            sea: drag.flow.surface.as_deref().map(Surface::sea),
            radius: cable.elements.iter().map(|e| 0.5 * diameter(e)).collect(),
            length: padded(cable.elements.iter().map(|e| e.length)),
            normal: padded(cable.elements.iter().map(factor(drag.normal))),
            tangential: padded(cable.elements.iter().map(factor(drag.tangential))),
        }
    }

    /// Takes samples of the flow at the nodes, and returns whether they differ from the `old` ones.
    ///
    /// # Errors
    /// [`Error::InvalidValue`](crate::Error::InvalidValue) for a sample that is not finite; the
    /// samples are then as before.
    pub fn sample(
        &mut self,
        old: &mut Vec<Vector3<f64>>,
        new: impl Iterator<Item = Vector3<f64>>,
    ) -> Result<bool, Error> {
        let samples = &mut self.flow.samples;
        samples.clear();
        samples.extend(new);
        if let Err(error) = samples.iter().try_for_each(|sample| require_finite("sampled flow (m/s)", sample)) {
            samples.clone_from(old);
            return Err(error);
        }
        let changed = samples != old;
        old.clone_from(samples);
        Ok(changed)
    }

    /// Returns the sampled flow at a point of element `e`.
    fn sampled(&self, e: usize, xi: f64) -> Vector3<f64> {
        match self.flow.samples.get(e..e + 2) {
            None => Vector3::zeros(),
            Some(ends) => ends[0] * (1.0 - xi) + ends[1] * xi,
        }
    }

    #[inline(always)]
    pub(super) fn gather<S: Simd>(&self, simd: S, first: usize, x: &[f64], length: Lanes<S>) -> [[Lanes<S>; 3]; 4] {
        let zero = Lanes::splat(simd, 0.0);
        let mut out = [[zero; 3]; 4];
        if x.is_empty() {
            return out;
        }
        let at = |lane: usize, i: usize| x[6 * (first + lane).min(self.count - 1) + i];
        for k in 0..4 {
            for c in 0..3 {
                let i = 3 * k + c;
                let lanes: [f64; 8] = [at(0, i), at(1, i), at(2, i), at(3, i), at(4, i), at(5, i), at(6, i), at(7, i)];
                let value = Lanes::simd_from(simd, lanes);
                out[k][c] = if k % 2 == 1 { value * length } else { value };
            }
        }
        out
    }

    /// Returns the velocity of the fluid at a point of eight elements, and the share of their
    /// sections that is wet.
    #[inline(always)]
    pub(super) fn fluid<S: Simd>(
        &self,
        simd: S,
        (time, base): (f64, &Vector3<f64>),
        first: usize,
        xi: f64,
        place: &[Lanes<S>; 3],
    ) -> ([Lanes<S>; 3], Option<Lanes<S>>) {
        let mut flow = self.flow(simd, base, first, xi, place);
        let Some(sea) = &self.sea else { return (flow, None) };
        let (mut raw, mut wave, mut share) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3], [0.0; LANES]);
        for c in 0..3 {
            place[c].store_slice(&mut raw[c]);
        }
        for lane in 0..LANES {
            let at = sea.at(time, &Vector3::new(raw[0][lane], raw[1][lane], raw[2][lane]));
            let element = (first + lane).min(self.count - 1);
            share[lane] = wet::share(at.depth / self.radius[element]);
            for c in 0..3 {
                wave[c][lane] = at.velocity[c];
            }
        }
        for c in 0..3 {
            flow[c] += Lanes::simd_from(simd, wave[c]);
        }
        (flow, Some(Lanes::simd_from(simd, share)))
    }

    /// Returns the velocity of the fluid at a point of eight elements, without that of a wave.
    #[inline(always)]
    fn flow<S: Simd>(
        &self,
        simd: S,
        base: &Vector3<f64>,
        first: usize,
        xi: f64,
        place: &[Lanes<S>; 3],
    ) -> [Lanes<S>; 3] {
        let mut flow = self.profiled(simd, base, place);
        if !self.flow.samples.is_empty() {
            let mut raw = [[0.0; LANES]; 3];
            for lane in 0..LANES {
                let sample = self.sampled((first + lane).min(self.count - 1), xi);
                for c in 0..3 {
                    raw[c][lane] = sample[c];
                }
            }
            for c in 0..3 {
                flow[c] += Lanes::simd_from(simd, raw[c]);
            }
        }
        flow
    }

    /// Returns the part of it that the tables give.
    #[inline(always)]
    fn profiled<S: Simd>(&self, simd: S, base: &Vector3<f64>, place: &[Lanes<S>; 3]) -> [Lanes<S>; 3] {
        let splat = [Lanes::splat(simd, base.x), Lanes::splat(simd, base.y), Lanes::splat(simd, base.z)];
        let Some(profile) = &self.flow.profile else { return splat };
        let mut raw = [[0.0; LANES]; 3];
        for c in 0..3 {
            place[c].store_slice(&mut raw[c]);
        }
        let factor = |lane: usize| profile.factor(&Vector3::new(raw[0][lane], raw[1][lane], raw[2][lane]));
        let factors = [factor(0), factor(1), factor(2), factor(3), factor(4), factor(5), factor(6), factor(7)];
        let factors = Lanes::simd_from(simd, factors);
        [splat[0] * factors, splat[1] * factors, splat[2] * factors]
    }

    #[inline(always)]
    fn run<S: Simd>(&self, simd: S, input: ForceInput<'_>, out: &mut [f64], mut matrix: Option<&mut BlockTridiagonal>) {
        let ForceInput { time, q, v, dv_dq, scale } = input;
        let base = self.flow.in_time(time);
        let zero = Lanes::splat(simd, 0.0);
        for first in (0..self.count).step_by(LANES) {
            let length = load(simd, &self.length, first);
            let inverse = Lanes::splat(simd, 1.0) / length;
            let (x, w) = (self.gather(simd, first, q, length), self.gather(simd, first, v, length));
            let kn = load(simd, &self.normal, first) * length * scale;
            let kt = load(simd, &self.tangential, first) * length * scale;
            let mut force = [[zero; 3]; 4];
            let mut blocks = [[[zero; 3]; 3]; 10];
            for point in &self.points {
                let place = combine(&x, &point.position);
                let slope = times(&combine(&x, &point.slope), inverse);
                let velocity = combine(&w, &point.position);
                let (flow, share) = self.fluid(simd, (time, &base), first, point.xi, &place);
                let relative = [velocity[0] - flow[0], velocity[1] - flow[1], velocity[2] - flow[2]];
                let split = Split::new(&relative, &slope);
                let (kn, kt) = wetted((kn * point.weight, kt * point.weight), share);
                let f = split.force(kn, kt);
                for k in 0..4 {
                    for c in 0..3 {
                        force[k][c] += f[c] * point.position[k];
                    }
                }
                if matrix.is_some() {
                    let [d, t] = split.tangents(kn, kt);
                    for (block, (k, m)) in blocks.iter_mut().zip(PAIRS) {
                        let hh = dv_dq * point.position[k] * point.position[m];
                        let (hs, sh) = (
                            inverse * (-0.5 * point.position[k] * point.slope[m]),
                            inverse * (-0.5 * point.slope[k] * point.position[m]),
                        );
                        for r in 0..3 {
                            for c in 0..3 {
                                block[r][c] += d[r][c] * hh + hs * t[r][c] + sh * t[c][r];
                            }
                        }
                    }
                }
            }
            self.scatter_by_length(first, length, (&mut force, &mut blocks), out, matrix.as_deref_mut());
        }
    }

    /// Adds forces and blocks of the matrix by length of the slopes' shape functions, which are
    /// multiples of the element's.
    #[inline(always)]
    pub(super) fn scatter_by_length<S: Simd>(
        &self,
        first: usize,
        length: Lanes<S>,
        (force, blocks): ForceAndBlocks<'_, S>,
        out: &mut [f64],
        matrix: Option<&mut BlockTridiagonal>,
    ) {
        for k in [1, 3] {
            force[k] = times(&force[k], length);
        }
        self.scatter_force(first, force, out);
        if let Some(a) = matrix {
            for (block, (k, m)) in blocks.iter_mut().zip(PAIRS) {
                for _ in 0..k % 2 + m % 2 {
                    for row in &mut *block {
                        *row = times(row, length);
                    }
                }
            }
            self.scatter_matrix(first, blocks, a);
        }
    }

    #[inline(always)]
    pub(super) fn scatter_force<S: Simd>(&self, first: usize, force: &[[Lanes<S>; 3]; 4], out: &mut [f64]) {
        let mut raw = [[0.0; LANES]; 12];
        for i in 0..12 {
            force[i / 3][i % 3].store_slice(&mut raw[i]);
        }
        for lane in 0..LANES.min(self.count - first) {
            let n = &mut out[6 * (first + lane)..6 * (first + lane) + 12];
            for i in 0..12 {
                n[i] += raw[i][lane];
            }
        }
    }

    #[inline(always)]
    pub(super) fn scatter_matrix<S: Simd>(
        &self,
        first: usize,
        blocks: &[[[Lanes<S>; 3]; 3]; 10],
        a: &mut BlockTridiagonal,
    ) {
        let mut raw = [[0.0; LANES]; 9];
        for (block, (k, m)) in blocks.iter().zip(PAIRS) {
            for i in 0..9 {
                block[i / 3][i % 3].store_slice(&mut raw[i]);
            }
            let (row, column) = (3 * (k % 2), 3 * (m % 2));
            for lane in 0..LANES.min(self.count - first) {
                let e = first + lane;
                let to = match (k / 2, m / 2) {
                    (0, 0) => &mut a.diag[e].0,
                    (1, 1) => &mut a.diag[e + 1].0,
                    _ => &mut a.lower[e].0,
                };
                for i in 0..9 {
                    to[column + i % 3][row + i / 3] += raw[i][lane];
                    // the mirror image inside a diagonal block
                    if k != m && k / 2 == m / 2 {
                        to[row + i / 3][column + i % 3] += raw[i][lane];
                    }
                }
            }
        }
    }
}

impl PointForce for DragTable {
    fn add(&mut self, level: Level, input: ForceInput<'_>, out: &mut [f64], matrix: Option<&mut BlockTridiagonal>) {
        match matrix {
            None => dispatch!(level, simd => self.run(simd, input, out, None)),
            Some(matrix) => dispatch!(level, simd => self.run(simd, input, out, Some(matrix))),
        }
    }

    /// Adds the drag over a step, linear in its mean velocity: see [`over_step`](super::over_step).
    fn add_over_step(
        &mut self,
        level: Level,
        step: StepInput<'_>,
        out: &mut [f64],
        matrix: Option<&mut BlockTridiagonal>,
    ) {
        dispatch!(level, simd => self.over_step(simd, step, out, matrix));
    }

    fn add_dual(&self, e: usize, time: f64, q: &[Dual; 12], v: &[Dual; 12], out: &mut [Dual; 12]) {
        let length = self.length[e];
        let arm = |k: usize| if k % 2 == 1 { length } else { 1.0 };
        let mix = |x: &[Dual; 12], weights: &[f64; 4]| -> [Dual; 3] {
            core::array::from_fn(|c| (0..4).fold(constant(0.0), |sum, k| sum + x[3 * k + c] * (weights[k] * arm(k))))
        };
        let base = self.flow.in_time(time);
        for point in &self.points {
            let place = mix(q, &point.position);
            let at = Vector3::from_fn(|c, _| place[c].value);
            let (factor, along) = match &self.flow.profile {
                None => (1.0, Vector3::zeros()),
                Some(profile) => (profile.factor(&at), profile.gradient(&at)),
            };
            let slope = (0..3).map(|c| along[c] * place[c].slope).sum::<f64>();
            let mut flow = base * factor + self.sampled(e, point.xi);
            let mut rate = base * slope;
            let mut share = constant(1.0);
            if let Some(sea) = &self.sea {
                let (way, radius) = (Vector3::from_fn(|c, _| place[c].slope), self.radius[e]);
                let step = DIFFERENCE * radius / way.norm().max(SMALLEST);
                let ends = [at + way * step, at - way * step].map(|place| sea.at(time, &place));
                let here = sea.at(time, &at);
                flow += here.velocity;
                rate += (ends[0].velocity - ends[1].velocity) / (2.0 * step);
                let [above, below] = ends.map(|end| end.depth / radius);
                let depth = here.depth / radius;
                share = Dual { value: wet::share(depth), slope: wet::slope(depth) * (above - below) / (2.0 * step) };
            }
            let velocity = mix(v, &point.position);
            let relative: [Dual; 3] = core::array::from_fn(|c| velocity[c] - Dual { value: flow[c], slope: rate[c] });
            let direction = mix(q, &point.slope).map(|c| c * (1.0 / length));
            let [kn, kt] = [self.normal[e], self.tangential[e]].map(|k| share * (k * length * point.weight));
            let force = Split::new(&relative, &direction).force(kn, kt);
            for i in 0..12 {
                out[i] = out[i] + force[i % 3] * (point.position[i / 3] * arm(i / 3));
            }
        }
    }

    fn set_length(&mut self, e: usize, length: f64) {
        self.length[e] = length;
        if e + 1 == self.count {
            // lanes beyond the last element repeat it
            self.length[e..].fill(length);
        }
    }

    /// Returns whether the fluid moves, somewhere and at some time.
    fn drives(&self) -> bool {
        self.sea.is_some_and(|sea| sea.has_wave())
            || self.flow.velocity != Vector3::zeros()
            || self.flow.samples.iter().any(|u| *u != Vector3::zeros())
    }

    fn hold(&mut self, time: f64) {
        self.flow.velocity = self.flow.in_time(time);
        self.flow.history.clear();
        // statics are in water without a wave
        self.sea = self.flow.surface.as_ref().map(|surface| Surface { wave: None, ..**surface }.sea());
    }

    fn drive_by(&mut self, share: f64) {
        self.flow.velocity *= share;
        self.flow.samples.iter_mut().for_each(|velocity| *velocity *= share);
    }
}

/// Returns k_n and k_t of sections of which a share is wet.
#[inline(always)]
pub(super) fn wetted<S: Simd>((kn, kt): (Lanes<S>, Lanes<S>), share: Option<Lanes<S>>) -> (Lanes<S>, Lanes<S>) {
    share.map_or((kn, kt), |share| (kn * share, kt * share))
}

#[inline(always)]
pub(super) fn combine<S: Simd>(x: &[[Lanes<S>; 3]; 4], weights: &[f64; 4]) -> [Lanes<S>; 3] {
    let mut out = x[0];
    for c in 0..3 {
        out[c] = x[0][c] * weights[0] + x[1][c] * weights[1] + x[2][c] * weights[2] + x[3][c] * weights[3];
    }
    out
}

/// Returns `factor x`.
#[inline(always)]
pub(super) fn times<S: Simd>(x: &[Lanes<S>; 3], factor: Lanes<S>) -> [Lanes<S>; 3] {
    [x[0] * factor, x[1] * factor, x[2] * factor]
}
