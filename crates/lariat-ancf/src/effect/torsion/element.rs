//! The twist of the material of one element: gradient, Hessian and exact change over a step.
//!
//! # Equation
//!
//! With the slopes d_x, d_y of the nodes and m of the middle, and x, mu, y their directions,
//!
//! ```text
//! Phi = Psi(x, mu) + Psi(mu, y) - det(x, mu, y)/6        m = 3/(2 l) (r_j - r_i) - (t_i + t_j)/4
//! ```
//!
//! The twist along the cubic is that of the polyline of its directions less the area between both.
//! To leading order that area is 4/3 of the triangle x mu y beyond the polyline's own, of which
//! det/6 is the rest; the next term is of fifth order, so energy, torque and force are of fourth
//! order in the length of the elements. Over a step, with the exact secants of the trilinear form
//!
//! ```text
//! D det = e_x.Dx + e_m.Dmu + e_y.Dy        e_x = mu cross y + Dmu cross Dy/12 of the means, and cyclic
//! D Phi = sum c.D q + c_l D l               exactly
//! ```
//!
//! Where material runs through the element its length l changes: the middle slope does it by both,
//!
//! ```text
//! D m = 3/2 [D(r_j - r_i) (1/l)_m + (r_j - r_i)_m D(1/l)] - (D t_i + D t_j)/4
//! c_l = -3/2 c_m.(r_j - r_i)_m/(l0 l1)
//! ```
//!
//! The Hessian is the symmetric part of the Jacobian of the gradient: what is left is the holonomy
//! of the frames at both ends, which cancels between neighbours under one torque.
//!
//! # Validity
//!
//! Directions of neighbouring slopes (node, middle, node) within 120 degrees; beyond, twist slips
//! ([`pair`](super::pair)).
//!
//! # Alternatives considered
//!
//! Psi(x, y) of the nodes alone, as discrete elastic rods have it: order 2, 2.7 % off the critical
//! torque at 16 elements. Richardson's 4/3 of both halves less 1/3 of the whole: as accurate, but
//! singular where one element turns round.

use super::direction::{Direction, DirectionStep};
use super::pair::{change, cross, gradient, jacobians};

use nalgebra::{Matrix3, Vector3};

/// Layout: number of coordinates of an element.
pub(super) const COORDINATES: usize = 12;

/// A symmetric matrix over the coordinates of an element, as blocks of 3 by 3: those on and below
/// the diagonal.
pub(super) type Blocks = [[Matrix3<f64>; 4]; 4];

/// Returns the slopes at the first node, in the middle, and at the second node; `scale` is 3/2 over
/// the length.
fn slopes(q: &[f64], scale: f64) -> [Vector3<f64>; 3] {
    let at = |k: usize| Vector3::new(q[3 * k], q[3 * k + 1], q[3 * k + 2]);
    let (first, last) = (at(1), at(3));
    [first, (at(2) - at(0)) * scale - (first + last) * 0.25, last]
}

/// Returns their directions at coordinates `q`.
pub(super) fn directions(q: &[f64], length: f64) -> [Vector3<f64>; 3] {
    slopes(q, 1.5 / length).map(|slope| Direction::of(slope).at)
}

/// Writes the covector on the coordinates of covectors on the three slopes; `scale` is 3/2 over the
/// length.
fn write([x, m, y]: &[Vector3<f64>; 3], scale: f64, out: &mut [f64]) {
    let (along, quarter) = (m * scale, m * 0.25);
    for (part, value) in out.chunks_exact_mut(3).zip([-along, x - quarter, along, y - quarter]) {
        part.copy_from_slice(value.as_slice());
    }
}

/// Writes the gradient of Phi at coordinates `q` (r, t of two nodes) to `out`.
pub(super) fn twist_gradient(q: &[f64], length: f64, out: &mut [f64]) {
    let directions = slopes(q, 1.5 / length).map(Direction::of);
    let on_directions = covectors(&directions);
    let on_slopes = core::array::from_fn(|k| directions[k].pull(&on_directions[k]));
    write(&on_slopes, 1.5 / length, out);
}

/// Returns the derivatives of Phi by the three directions.
fn covectors(directions: &[Direction; 3]) -> [Vector3<f64>; 3] {
    let [x, m, y] = directions.map(|direction| direction.at);
    let (before, behind) = (gradient(&x, &m), gradient(&m, &y));
    [before - m.cross(&y) / 6.0, before + behind - y.cross(&x) / 6.0, behind - x.cross(&m) / 6.0]
}

/// Returns the Hessian of Phi at coordinates `q` times a factor.
pub(super) fn twist_hessian(q: &[f64], length: f64, factor: f64) -> Blocks {
    let directions = slopes(q, 1.5 / length).map(Direction::of);
    let [x, m, y] = directions.map(|direction| direction.at);
    let v = covectors(&directions);
    let t = directions.map(|direction| direction.jacobian());
    let [a, b] = jacobians(&x, &m);
    let [c, d] = jacobians(&m, &y);
    let symmetric = |matrix: Matrix3<f64>| (matrix + matrix.transpose()) * (0.5 * factor);
    let own = |k: usize, h: Matrix3<f64>| {
        let (j, bend) = (&t[k], directions[k].curvature(&v[k]));
        j * symmetric(h) * j + bend * factor
    };
    let between = |one: usize, other: usize, h: Matrix3<f64>| t[one] * h * t[other] * factor;
    let sixth = 1.0 / 6.0;
    let (xx, mm, yy) = (own(0, a), own(1, b + c), own(2, d));
    let mx = between(1, 0, (a + b.transpose()) * 0.5 - cross(&y) * sixth);
    let ym = between(2, 1, (c + d.transpose()) * 0.5 - cross(&x) * sixth);
    let yx = between(2, 0, cross(&m) * sixth);
    let along = 1.5 / length;
    let (quarter, sixteenth) = (mm * 0.25, mm * 0.0625);
    let rr = mm * (along * along);
    let zero = Matrix3::zeros();
    let sum = |matrix: &Matrix3<f64>| (matrix + matrix.transpose()) * 0.25;
    // rows and columns: r_i, t_i, r_j, t_j
    let (mx_less, my_less) = ((mx - quarter) * along, (ym.transpose() - quarter) * along);
    [
        [rr, zero, zero, zero],
        [-mx_less.transpose(), xx - sum(&mx) + sixteenth, zero, zero],
        [-rr, mx_less, rr, zero],
        [-my_less.transpose(), yx - (mx + ym) * 0.25 + sixteenth, my_less.transpose(), yy - sum(&ym) + sixteenth],
    ]
}

/// What the twist of an element changes over a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct TwistChange {
    /// D Phi.
    pub angle: f64,
    /// c_l.
    pub by_length: f64,
    /// Number of pairs that slip.
    pub slips: u64,
}

/// Returns the direction of the slope of a node over a step, from its coordinates and their change.
pub(super) fn node_step(q: &[f64], step: &[f64]) -> DirectionStep {
    DirectionStep::of(Vector3::new(q[3], q[4], q[5]), &Vector3::new(step[3], step[4], step[5]))
}

/// Returns D Phi from coordinates `q` over `step` between the [directions](node_step) of its nodes,
/// and writes the secant c to `secant`; `lengths` are those at both ends of the step.
pub(super) fn twist_change(
    q: &[f64],
    step: &[f64],
    [x, y]: [&DirectionStep; 2],
    lengths: [f64; 2],
    secant: &mut [f64],
) -> TwistChange {
    let [first, last] = lengths.map(|length| 1.5 / length);
    let scale = 0.5 * (first + last);
    let chord = |x: &[f64]| Vector3::new(x[6] - x[0], x[7] - x[1], x[8] - x[2]);
    let mean_chord = chord(q) + chord(step) * 0.5;
    let (start, mut change_of) = (slopes(q, first)[1], slopes(step, scale)[1]);
    change_of += mean_chord * (last - first);
    let m = DirectionStep::of(start, &change_of);
    let before = change([&x.start, &x.end], [&m.start, &m.end]);
    let behind = change([&m.start, &m.end], [&y.start, &y.end]);
    let (dx, dm, dy) = (x.change(), m.change(), y.change());
    let (mean_x, mean_m, mean_y) = (x.mean(), m.mean(), y.mean());
    let ex = mean_m.cross(&mean_y) + dm.cross(&dy) / 12.0;
    let em = mean_y.cross(&mean_x) + dy.cross(&dx) / 12.0;
    let ey = mean_x.cross(&mean_m) + dx.cross(&dm) / 12.0;
    let on_slopes = [
        x.pull(&(before.secant - ex / 6.0)),
        m.pull(&(before.secant + behind.secant - em / 6.0)),
        y.pull(&(behind.secant - ey / 6.0)),
    ];
    write(&on_slopes, scale, secant);
    let det = ex.dot(&dx) + em.dot(&dm) + ey.dot(&dy);
    TwistChange {
        angle: before.angle + behind.angle - det / 6.0,
        by_length: on_slopes[1].dot(&mean_chord) * (-2.0 / 3.0 * first * last),
        slips: u64::from(before.slips) + u64::from(behind.slips),
    }
}
