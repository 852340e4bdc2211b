//! Start shapes that replace the present one after a support has jumped, or if the iteration failed
//! from the present one.
//!
//! Between two held positions a cable is laid out as when it is built (straight if taut, an arc if
//! slack), beyond the last one straight along gravity. If a support has moved by a small share of
//! the span, the cable is displaced linearly along the span instead.

use crate::cable::{Sag, along_polyline};
use crate::model::Model;
use crate::scales::statics::{MAX_SPAN_CHANGE, MIN_OPENING};
use crate::support::SlopeSupport;
use nalgebra::Vector3;
use std::ops::Range;

fn position(q: &[f64], node: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&q[6 * node..6 * node + 3])
}

fn set_position(q: &mut [f64], node: usize, r: Vector3<f64>) {
    q[6 * node..6 * node + 3].copy_from_slice(r.as_slice());
}

/// Sets the slope of a node, unless a support holds it.
fn set_slope(model: &Model, q: &mut [f64], node: usize, t: Vector3<f64>) {
    if model.support(node).is_none_or(|s| s.slope == SlopeSupport::Free) {
        q[6 * node + 3..6 * node + 6].copy_from_slice(t.as_slice());
    }
}

/// Returns the nodes whose position is held, ascending.
fn held(model: &Model) -> Vec<usize> {
    model.supports.iter().filter(|(_, s)| s.holds_position()).map(|(node, _)| *node).collect()
}

/// Moves the cable with supports that have jumped: in `q` they are at their positions, in `before`
/// at the previous ones.
pub(crate) fn move_with_supports(model: &Model, before: &[f64], q: &mut [f64]) {
    let held = held(model);
    let (Some(&first), Some(&last)) = (held.first(), held.last()) else { return };
    let jump = |q: &[f64], node: usize| position(q, node) - position(before, node);
    if held.iter().all(|&node| jump(q, node) == Vector3::zeros()) {
        return;
    }
    let s: Vec<f64> = model.node_arc_lengths().collect();
    for (end, nodes) in [(first, 0..first), (last, last + 1..model.nodes())] {
        let jump = jump(q, end);
        nodes.for_each(|node| set_position(q, node, position(before, node) + jump));
    }
    for ends in held.windows(2) {
        let (a, b) = (ends[0], ends[1]);
        let (from, to, length) = (jump(q, a), jump(q, b), s[b] - s[a]);
        let rate = (to - from) / length;
        if rate.norm() > MAX_SPAN_CHANGE {
            lay_out_span(model, &s, q, a..b);
            continue;
        }
        for node in a + 1..b {
            set_position(q, node, position(before, node) + from + (s[node] - s[a]) * rate);
            let t = Vector3::from_column_slice(&before[6 * node + 3..6 * node + 6]);
            set_slope(model, q, node, t + rate);
        }
    }
}

/// Lays out the whole cable.
pub(crate) fn lay_out(model: &Model, q: &mut [f64]) {
    let held = held(model);
    let (Some(&first), Some(&last)) = (held.first(), held.last()) else { return };
    let s: Vec<f64> = model.node_arc_lengths().collect();
    let down = model.gravity.try_normalize(0.0);
    for (end, nodes, sign) in [(first, 0..first, -1.0), (last, last + 1..model.nodes(), 1.0)] {
        let Some(down) = down.filter(|_| !nodes.is_empty()) else { continue };
        let from = position(q, end);
        for node in nodes.chain([end]) {
            set_position(q, node, from + down * (s[node] - s[end]).abs());
            set_slope(model, q, node, sign * down);
        }
    }
    held.windows(2).for_each(|ends| lay_out_span(model, &s, q, ends[0]..ends[1]));
}

/// Lays out the cable between two nodes at their positions.
fn lay_out_span(model: &Model, s: &[f64], q: &mut [f64], ends: Range<usize>) {
    let (a, b) = (position(q, ends.start), position(q, ends.end));
    let along: Vec<f64> = s[ends.start..=ends.end].iter().map(|x| x - s[ends.start]).collect();
    let length = along[along.len() - 1];
    // an arc needs two separate ends: a loop is laid out open, and closed linearly
    let open =
        if (b - a).norm() > MIN_OPENING * length { b } else { b + MIN_OPENING * length * normal(&model.gravity) };
    let laid = along_polyline(&[a, open], &along, Sag::along(model.gravity));
    for (i, node) in (ends.start..=ends.end).enumerate() {
        set_position(q, node, laid[i].position + (b - open) * (along[i] / length));
        set_slope(model, q, node, laid[i].slope);
    }
    set_position(q, ends.end, b);
}

/// Returns a unit vector normal to `v`.
fn normal(v: &Vector3<f64>) -> Vector3<f64> {
    let axis = if v.x.abs() <= v.y.abs() { Vector3::x() } else { Vector3::y() };
    let v = v.try_normalize(0.0).unwrap_or(Vector3::z());
    (axis - v * v.dot(&axis)).normalize()
}
