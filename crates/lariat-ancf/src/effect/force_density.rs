//! A force per length written outside the crate: any function of arc length, position, velocity and
//! time.
//!
//! # Equation
//!
//! ```text
//! F_k = int S_k f(s, r, r', t) ds        -dF_k/dx_m = int S_k S_m D ds        D = -df/dr - (dr'/dr) df/dr'
//! ```
//!
//! in N per m of unstretched cable, integrated at three Gauss points per element. The step matrix
//! takes the symmetric part of D (it is stored by one triangle); the whole of it is in
//! [`Cable::jacobians`](crate::coupling::Linearisation::jacobians). A function that gives no
//! derivatives gets central differences, over 1e-5 of the element's length and 1e-5 of the speed,
//! but at least 1e-5 m/s: six further calls per point and matrix, and six more if it depends on
//! velocity.
//!
//! # Validity
//!
//! Smooth functions that change little over a third of an element. Arc length is that of the
//! material, whatever reels do: what a reel at the start pays out has a negative one. Every
//! implicit method steps them to its own order; explicit methods keep their order if the force does
//! not depend on velocity (see [`explicit`](crate::integrate::explicit)), and do not know its
//! stiffness: [`Cable::frequency_bound`](crate::coupling::Linearisation::frequency_bound) is the
//! cable's alone. Statics follow the motion to rest, because no potential is known. The control of
//! spurious energy is off, because the work of an unknown force cannot be told from it.
//!
//! *Snapshots.* A [`Snapshot`](crate::Snapshot) holds the state and the work that the force has
//! done; the function stays with the cable. A *serialised* cable cannot hold a function: read back,
//! it refuses to step until as many functions are attached again, in the same order.
//!
//! # Alternatives considered
//!
//! No tangent where none is given: Newton's iteration then converges linearly, and not at all where
//! the force is stiffer than the step allows.

use super::acts::{ForceInput, PointForce};
use crate::dual::{Dual, constant};
use crate::element::assembly::add_tangent;
use crate::element::shape;
use crate::element::side::Side;
use crate::linalg::BlockTridiagonal;
use crate::quadrature::gauss_legendre;
use crate::scales::effect::{DIFFERENCE, POINTS};
use crate::section::Element;
use core::fmt::Debug;
use fearless_simd::Level;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

/// A force per length of your own, for
/// [`Cable::add_force_density`](crate::Cable::add_force_density).
pub trait ForceDensity: Debug + Send + Sync {
    /// Returns the force in N per m of unstretched cable, world axes. It must depend on its
    /// argument alone: steps are repeated.
    fn force(&self, at: &CablePoint) -> Vector3<f64>;

    /// Whether the force depends on velocity. If not, [`CablePoint::velocity`] is not always given.
    fn depends_on_velocity(&self) -> bool;

    /// Whether the force depends on time, or on anything else but arc length, position and
    /// velocity. A cable on which such a force acts never sleeps. Default: it does.
    fn depends_on_time(&self) -> bool {
        true
    }

    /// Returns the derivatives of the force. Default: none given, central differences are taken.
    fn derivatives(&self, _at: &CablePoint) -> Option<ForceDerivatives> {
        None
    }
}

/// A point of the cable at which a force per length is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CablePoint {
    /// Time in s.
    pub time: f64,
    /// Arc length of the unstretched cable in m, from the start that the cable had when the force
    /// was attached: a particle keeps its own, and what a reel at the start pays out later has a
    /// negative one.
    pub arc_length: f64,
    /// Position in m.
    pub position: Vector3<f64>,
    /// Velocity in m/s.
    pub velocity: Vector3<f64>,
}

/// Derivatives of a force per length, `[row][column]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceDerivatives {
    /// By position in N/m^2.
    pub position: Matrix3<f64>,
    /// By velocity in N s/m^2; zero if the force does not depend on it.
    pub velocity: Matrix3<f64>,
}

/// A function and where the cable that it acts on begins, as arc length of the cable that it was
/// attached to.
#[derive(Clone, Debug)]
struct Attached {
    force: Arc<dyn ForceDensity>,
    begin: f64,
}

/// The functions of a cable. Serialised are their begins alone.
#[derive(Clone, Debug, Default)]
pub(crate) struct ForceDensities {
    attached: Vec<Attached>,
    /// Begins of functions that were not attached again since the cable was read back.
    missing: Vec<f64>,
}

impl ForceDensities {
    /// Attaches a function, in place of the first one that is missing; `passed` m came through a
    /// reel at the start so far.
    pub fn attach(&mut self, force: Arc<dyn ForceDensity>, passed: f64) {
        let begin = if self.missing.is_empty() { passed } else { self.missing.remove(0) };
        self.attached.push(Attached { force, begin });
    }

    pub fn clear(&mut self) {
        *self = Self::default();
    }

    pub fn iter(&self) -> impl Iterator<Item = &Arc<dyn ForceDensity>> {
        self.attached.iter().map(|attached| &attached.force)
    }

    /// Number of functions that were not attached again.
    pub fn missing(&self) -> usize {
        self.missing.len()
    }

    pub fn is_empty(&self) -> bool {
        self.attached.is_empty()
    }

    pub fn depend_on_velocity(&self) -> bool {
        self.iter().any(|force| force.depends_on_velocity())
    }

    pub fn depend_on_time(&self) -> bool {
        self.iter().any(|force| force.depends_on_time())
    }

    /// The functions of a part that begins at an arc length (m).
    pub fn behind(&self, arc_length: f64) -> Self {
        let mut part = self.clone();
        part.attached.iter_mut().for_each(|attached| attached.begin += arc_length);
        part.missing.iter_mut().for_each(|begin| *begin += arc_length);
        part
    }

    /// Tables for the evaluation, if there is a function; `at_reel` says whether the first element
    /// is at the eye of a reel.
    pub fn at_points(&self, elements: &[Element], at_reel: bool) -> Option<ForceDensityTable> {
        let mut begin = if at_reel { -elements[0].length } else { 0.0 };
        let numbers = elements.iter().map(|element| {
            begin += element.length;
            (begin - element.length, element.length)
        });
        (!self.is_empty()).then(|| ForceDensityTable {
            attached: self.attached.clone(),
            elements: numbers.collect(),
            origin: 0.0,
            points: gauss_legendre(POINTS),
            held: None,
            share: 1.0,
            not_finite: None,
        })
    }
}

impl PartialEq for ForceDensities {
    /// Compares functions by identity.
    fn eq(&self, other: &Self) -> bool {
        let same = |(a, b): (&Attached, &Attached)| Arc::ptr_eq(&a.force, &b.force) && a.begin == b.begin;
        self.missing == other.missing
            && self.attached.len() == other.attached.len()
            && self.attached.iter().zip(&other.attached).all(same)
    }
}

impl Serialize for ForceDensities {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let attached = self.attached.iter().map(|attached| attached.begin);
        attached.chain(self.missing.iter().copied()).collect::<Vec<f64>>().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for ForceDensities {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(ForceDensities { attached: Vec::new(), missing: Vec::deserialize(deserializer)? })
    }
}

/// The functions of a cable, as the evaluation needs them.
#[derive(Clone, Debug)]
pub(crate) struct ForceDensityTable {
    attached: Vec<Attached>,
    /// Arc length of the begin, and length, by element, in m: from the start, or where a reel is
    /// there from the second node, whose material stays.
    elements: Vec<(f64, f64)>,
    /// Arc length in m of the second node along its material, where a reel is at the start.
    origin: f64,
    /// Gauss points and weights.
    points: Vec<(f64, f64)>,
    /// The time in s at which all forces are held, if they are.
    held: Option<f64>,
    /// The share of all forces that acts.
    share: f64,
    /// The first element of the last evaluation where a force or a derivative was not finite.
    not_finite: Option<usize>,
}

/// A Gauss point of an element: the element's length, weights of the coordinates, and weight of the
/// point in m.
struct Point {
    begin: f64,
    xi: f64,
    length: f64,
    shape: [f64; 4],
    weight: f64,
}

impl Point {
    fn combine(&self, x: &[f64]) -> Vector3<f64> {
        (0..4).map(|k| self.shape[k] * Vector3::new(x[3 * k], x[3 * k + 1], x[3 * k + 2])).sum()
    }
}

impl ForceDensityTable {
    /// The element where the last evaluation was not finite.
    pub fn not_finite(&self) -> Option<usize> {
        self.not_finite
    }

    /// Sets the length of an element at the eye of a reel in m.
    pub fn set_length(&mut self, side: Side, length: f64) {
        let element = side.element(self.elements.len());
        let (begin, own) = &mut self.elements[element];
        *own = length;
        if side == Side::Start {
            *begin = -length;
        }
    }

    /// Returns the arc length in m of the second node along its material, where a reel is at the
    /// start.
    pub fn origin(&self) -> f64 {
        self.origin
    }

    /// Sets the arc length in m of the second node along its material, where a reel is at the
    /// start.
    pub fn set_origin(&mut self, origin: f64) {
        self.origin = origin;
    }

    fn point(&self, element: usize, k: usize) -> Point {
        let ((begin, length), (xi, weight)) = (self.elements[element], self.points[k]);
        Point { begin, xi, length, shape: shape::position(xi, length), weight: weight * length }
    }

    fn at(
        &self,
        point: &Point,
        attached: &Attached,
        time: f64,
        position: Vector3<f64>,
        velocity: Vector3<f64>,
    ) -> CablePoint {
        let arc_length = attached.begin + self.origin + (point.begin + point.xi * point.length);
        CablePoint { time: self.held.unwrap_or(time), arc_length, position, velocity }
    }

    fn force(&self, point: &Point, time: f64, position: Vector3<f64>, velocity: Vector3<f64>) -> Vector3<f64> {
        let of = |a: &Attached| a.force.force(&self.at(point, a, time, position, velocity));
        self.attached.iter().map(of).sum::<Vector3<f64>>() * self.share
    }

    fn derivatives(
        &self,
        point: &Point,
        time: f64,
        position: Vector3<f64>,
        velocity: Vector3<f64>,
    ) -> ForceDerivatives {
        let mut sum = ForceDerivatives { position: Matrix3::zeros(), velocity: Matrix3::zeros() };
        for attached in &self.attached {
            let at = self.at(point, attached, time, position, velocity);
            let one =
                attached.force.derivatives(&at).unwrap_or_else(|| differences(&*attached.force, &at, point.length));
            sum.position += one.position;
            sum.velocity += one.velocity;
        }
        (sum.position, sum.velocity) = (sum.position * self.share, sum.velocity * self.share);
        sum
    }
}

/// Derivatives by central differences.
fn differences(force: &dyn ForceDensity, at: &CablePoint, length: f64) -> ForceDerivatives {
    let column = |step: f64, moved: &dyn Fn(f64) -> CablePoint| {
        (force.force(&moved(step)) - force.force(&moved(-step))) / (2.0 * step)
    };
    let unit = |x: usize, size: f64| Vector3::from_fn(|i, _| if i == x { size } else { 0.0 });
    let mut out = ForceDerivatives { position: Matrix3::zeros(), velocity: Matrix3::zeros() };
    for x in 0..3 {
        let moved = |step: f64| CablePoint { position: at.position + unit(x, step), ..*at };
        out.position.set_column(x, &column(DIFFERENCE * length, &moved));
        if force.depends_on_velocity() {
            let moved = |step: f64| CablePoint { velocity: at.velocity + unit(x, step), ..*at };
            out.velocity.set_column(x, &column(DIFFERENCE * at.velocity.norm().max(1.0), &moved));
        }
    }
    out
}

impl PointForce for ForceDensityTable {
    fn add(&mut self, _: Level, input: ForceInput<'_>, out: &mut [f64], mut matrix: Option<&mut BlockTridiagonal>) {
        let ForceInput { time, q, v, dv_dq, scale } = input;
        self.not_finite = None;
        for e in 0..self.elements.len() {
            let nodes = 6 * e..6 * e + 12;
            for k in 0..self.points.len() {
                let point = self.point(e, k);
                let position = point.combine(&q[nodes.clone()]);
                let velocity = if v.is_empty() { Vector3::zeros() } else { point.combine(&v[nodes.clone()]) };
                let force = self.force(&point, time, position, velocity) * (scale * point.weight);
                for (i, f) in out[nodes.clone()].iter_mut().enumerate() {
                    *f += point.shape[i / 3] * force[i % 3];
                }
                let mut finite = force.iter().all(|x| x.is_finite());
                if let Some(matrix) = matrix.as_deref_mut() {
                    let of = self.derivatives(&point, time, position, velocity);
                    let block = (of.position + of.velocity * dv_dq) * (-scale * point.weight);
                    add_tangent(matrix, e, &point.shape, &((block + block.transpose()) * 0.5));
                    finite &= block.iter().all(|x| x.is_finite());
                }
                if !finite && self.not_finite.is_none() {
                    self.not_finite = Some(e);
                }
            }
        }
    }

    fn add_dual(&self, element: usize, time: f64, q: &[Dual; 12], v: &[Dual; 12], out: &mut [Dual; 12]) {
        for k in 0..self.points.len() {
            let point = self.point(element, k);
            let mix = |x: &[Dual; 12], part: fn(&Dual) -> f64| point.combine(&x.each_ref().map(part));
            let (position, velocity) = (mix(q, |x| x.value), mix(v, |x| x.value));
            let force = self.force(&point, time, position, velocity);
            let of = self.derivatives(&point, time, position, velocity);
            let slope = of.position * mix(q, |x| x.slope) + of.velocity * mix(v, |x| x.slope);
            for i in 0..12 {
                let f = Dual { value: force[i % 3], slope: slope[i % 3] };
                out[i] = out[i] + f * constant(point.shape[i / 3] * point.weight);
            }
        }
    }

    /// Returns true: no potential is known.
    fn drives(&self) -> bool {
        true
    }

    fn hold(&mut self, time: f64) {
        self.held = Some(time);
    }

    fn drive_by(&mut self, share: f64) {
        self.share = share;
    }
}
